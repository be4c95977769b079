// SPDX-License-Identifier: MIT
// A symmetric system of linear equations whose matrix is a narrow band.
#include "core/dynamics/band_system.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace softbody {

void BandSystem::begin(std::size_t size) {
	band_.assign(size * (BAND + 1), 0.0);
	inverse_diagonal_.assign(size, 0.0);
	right_.assign(size, 0.0);
	known_.assign(size, 0.0);
	is_known_.assign(size, 0);
}

void BandSystem::prescribe(std::size_t i, double value) {
	is_known_[i] = 1;
	known_[i] = value;
}

void BandSystem::add(std::size_t i, std::size_t j, double value) {
	if (i < j) {
		std::swap(i, j);
	}
	if (is_known_[i] == 0 && is_known_[j] == 0) {
		at(i, j) += value;
	} else if (is_known_[i] == 0) {
		right_[i] -= value * known_[j];
	} else if (is_known_[j] == 0) {
		right_[j] -= value * known_[i];
	}
}

// Row by row: w_j = A_ij - sum over k < j of w_k L_jk, L_ij = w_j / D_j, and D_i = A_ii - sum of w_j L_ij.
void BandSystem::factor() {
	std::array<double, BAND> w{};
	for (std::size_t i = 0; i < size(); ++i) {
		const std::size_t first = i > BAND ? i - BAND : 0;
		double diagonal = at(i, i);
		for (std::size_t j = first; j < i; ++j) {
			double sum = at(i, j);
			for (std::size_t k = std::max(first, j > BAND ? j - BAND : 0); k < j; ++k) {
				sum -= w[k - first] * at(j, k);
			}
			w[j - first] = sum;
			at(i, j) = sum * inverse_diagonal_[j];
			diagonal -= sum * at(i, j);
		}
		// An unknown in no equation stays 0.
		inverse_diagonal_[i] = std::abs(diagonal) > std::numeric_limits<double>::min() ? 1 / diagonal : 0;
	}
}

const std::vector<double> &BandSystem::solve() {
	for (std::size_t i = 0; i < size(); ++i) {
		if (is_known_[i] != 0) {
			at(i, i) = 1;
			right_[i] = known_[i];
		}
	}
	factor();
	for (std::size_t i = 0; i < size(); ++i) {
		for (std::size_t j = i > BAND ? i - BAND : 0; j < i; ++j) {
			right_[i] -= at(i, j) * right_[j];
		}
	}
	for (std::size_t i = 0; i < size(); ++i) {
		right_[i] *= inverse_diagonal_[i];
	}
	for (std::size_t i = size(); i-- > 0;) {
		for (std::size_t j = i + 1; j < std::min(size(), i + BAND + 1); ++j) {
			right_[i] -= at(j, i) * right_[j];
		}
	}
	return right_;
}

} // namespace softbody
