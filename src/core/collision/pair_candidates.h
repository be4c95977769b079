// SPDX-License-Identifier: MIT
// The hull points of two bodies that may touch the other one in the rest of a step.
#pragma once

#include "core/base/real.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace softbody {

/// A hull point that is inside or near another hull.
struct PairCandidate {
	std::uint16_t point = 0;
	std::uint8_t side = 0; ///< 0: a point of the first body, 1: of the second
	std::uint16_t edge = 0; ///< of the other hull, the one that the point is nearest to
};

/// The candidates of a pair of bodies. While the points of both bodies have moved little since the list was made, no
/// other point can have come into contact.
class PairCandidates {
public:
	/// More candidates than that are not listed; then every substep searches anew.
	static constexpr std::size_t MOST = 9;

	/// Empties the list, which then holds at no path.
	void clear() { *this = {}; }
	/// Adds a candidate; past MOST the list can no longer become complete.
	void add(PairCandidate candidate) {
		overflows_ |= count_ == MOST;
		if (!overflows_) {
			list_[count_++] = candidate;
		}
	}
	/// Declares the list complete while the summed paths of both bodies [length] are at most `path`.
	void hold_until(Real path) { path_ = overflows_ ? Real(-1) : path; }
	/// Whether the list is complete after a summed path of both bodies [length], >= 0.
	bool holds_at(Real path) const { return path <= path_; }

	std::span<PairCandidate> list() { return { list_.data(), count_ }; }

private:
	Real path_ = -1;
	std::uint8_t count_ = 0;
	bool overflows_ = false;
	std::array<PairCandidate, MOST> list_;
};

} // namespace softbody
