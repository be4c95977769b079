// SPDX-License-Identifier: MIT
// Banded systems are solved as elimination with pivoting solves them.
#include "core/dynamics/band_system.h"
#include "support/random.h"

#include <cmath>
#include <doctest/doctest.h>
#include <vector>

using namespace softbody;
using namespace softbody::testing;

namespace {

// Gauss with row pivoting on the full matrix: another way, without L D Lᵀ or a band.
std::vector<double> eliminate(std::vector<std::vector<double>> a, std::vector<double> b) {
	const std::size_t n = b.size();
	for (std::size_t k = 0; k < n; ++k) {
		std::size_t pivot = k;
		for (std::size_t i = k; i < n; ++i) {
			pivot = std::abs(a[i][k]) > std::abs(a[pivot][k]) ? i : pivot;
		}
		std::swap(a[k], a[pivot]);
		std::swap(b[k], b[pivot]);
		for (std::size_t i = k + 1; i < n; ++i) {
			const double factor = a[i][k] / a[k][k];
			for (std::size_t j = k; j < n; ++j) {
				a[i][j] -= factor * a[k][j];
			}
			b[i] -= factor * b[k];
		}
	}
	for (std::size_t k = n; k-- > 0;) {
		for (std::size_t j = k + 1; j < n; ++j) {
			b[k] -= a[k][j] * b[j];
		}
		b[k] /= a[k][k];
	}
	return b;
}

} // namespace

TEST_CASE("a random system of masses and constraints has the solution that elimination finds") {
	Random random(7);
	const auto any = [&] { return double(random.real(-1, 1)); };
	for (const std::size_t n : { 1, 5, 7, 40 }) {
		BandSystem system;
		system.begin(n);
		std::vector<std::vector<double>> full(n, std::vector<double>(n, 0));
		std::vector<double> right(n);
		for (std::size_t i = 0; i < n; ++i) {
			right[i] = any();
			system.add_right(i, right[i]);
			for (std::size_t j = i > BandSystem::BAND ? i - BandSystem::BAND : 0; j <= i; ++j) {
				// Every third unknown is a tension: its diagonal is negative.
				const double value = i != j ? any() : i % 3 == 2 ? -6.0 : 6.0;
				system.add(i, j, value);
				full[i][j] = full[j][i] = value;
			}
		}
		const std::vector<double> wanted = eliminate(full, right);
		const std::vector<double> &found = system.solve();
		for (std::size_t i = 0; i < n; ++i) {
			CHECK(found[i] == doctest::Approx(wanted[i]).epsilon(1e-9));
		}
	}
}

TEST_CASE("a prescribed value is kept, and acts on the others as a known term") {
	BandSystem system;
	system.begin(2);
	system.prescribe(1, 3);
	system.add(0, 0, 2);
	system.add(0, 1, 1);
	system.add(1, 1, 5);
	system.add_right(0, 7);
	system.add_right(1, 100);
	const std::vector<double> &found = system.solve();
	CHECK(found[0] == 2); // 2 x + 3 = 7
	CHECK(found[1] == 3);
}

TEST_CASE("an unknown in no equation is 0") {
	BandSystem system;
	system.begin(2);
	system.add(0, 0, 4);
	system.add_right(0, 2);
	CHECK(system.solve() == std::vector<double>{ 0.5, 0 });
}
