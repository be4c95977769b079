// SPDX-License-Identifier: MIT
// A symmetric system of linear equations whose matrix is a narrow band, with values that may be prescribed.
#pragma once

#include <cstddef>
#include <vector>

namespace softbody {

/// Solves A x = b for a symmetric matrix A in which entries further than BAND from the diagonal are 0, by L D Lᵀ without
/// pivoting. A may be indefinite, as a matrix of masses beside constraints is: then its leading minors must not be 0. In double,
/// as masses of a rope and of its load differ a thousand times. It owns scratch memory, which grows to the largest system.
class BandSystem {
public:
	static constexpr std::size_t BAND = 6;

	/// A of zeros, b of zeros, nothing prescribed.
	void begin(std::size_t size);
	std::size_t size() const { return right_.size(); }
	/// Prescribes x_i. Call it before `add`.
	void prescribe(std::size_t i, double value);
	/// Adds to the entries (i, j) and (j, i) of A. Precondition: they are in the band.
	void add(std::size_t i, std::size_t j, double value);
	void add_right(std::size_t i, double value) { right_[i] += value; }
	/// Factors A and returns x. O(size).
	const std::vector<double> &solve();

private:
	double &at(std::size_t i, std::size_t j) { return band_[i * (BAND + 1) + (i - j)]; }
	void factor();

	std::vector<double> band_; ///< row i holds the entries (i, i) to (i, i - BAND); of L after `factor`
	std::vector<double> inverse_diagonal_; ///< of D
	std::vector<double> right_;
	std::vector<double> known_;
	std::vector<char> is_known_;
};

} // namespace softbody
