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
	std::uint16_t edge = 0; ///< of the other hull, the one that the point is nearest to
};

/// The candidates of a pair of bodies, the points of the first body before those of the second. While the points of
/// both bodies have moved little since the list was made, no other point can have come into contact.
class PairCandidates {
public:
	/// More candidates than that are not listed; then every substep searches anew. With so many, a list fills a cache
	/// line.
	static constexpr std::size_t MOST = 14;

	/// Empties the list, which then holds at no path.
	void clear() { *this = {}; }
	/// Adds a candidate; past MOST the list can no longer become complete.
	void add(PairCandidate candidate) {
		overflows_ |= count_ == MOST;
		if (!overflows_) {
			list_[count_++] = candidate;
		}
	}
	/// Declares that the points added later belong to the second body.
	void begin_second() { first_count_ = count_; }
	/// Declares the list complete while the summed paths of both bodies [length] are at most `path`.
	void hold_until(Real path) { path_ = overflows_ ? Real(-1) : path; }
	/// Whether the list is complete after a summed path of both bodies [length], >= 0.
	bool holds_at(Real path) const { return path <= path_; }

	std::span<PairCandidate> of_first() { return { list_.data(), first_count_ }; }
	std::span<PairCandidate> of_second() { return std::span(list_).first(count_).subspan(first_count_); }

private:
	Real path_ = -1;
	std::uint8_t count_ = 0;
	std::uint8_t first_count_ = 0;
	bool overflows_ = false;
	std::array<PairCandidate, MOST> list_;
};

} // namespace softbody
