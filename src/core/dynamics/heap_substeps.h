// SPDX-License-Identifier: MIT
// How many contact substeps each heap of bodies takes.
#pragma once

#include "core/collision/heap_turn.h"
#include "core/dynamics/islands.h"

#include <cstdint>
#include <span>
#include <vector>

namespace softbody {

/// Bodies that may touch, or are joined, advance in common substeps: as many as the one of them takes that needs most. Who
/// has nothing to do with them takes no more than it needs itself, and what it does depends on its own heap alone.
/// Bodies go by their row in a list of active bodies.
class HeapSubsteps {
public:
	/// Everybody takes `count` (1..65535): nothing need be known of heaps. O(1).
	void set_common(int count);

	/// Begins with `rows` bodies, each of them alone and in no heap that takes substeps together. O(rows).
	void begin(std::uint32_t rows);
	/// Puts two bodies into one heap.
	void join(std::uint32_t a, std::uint32_t b) { islands_.join(a, b); }
	/// A body of a heap needs at least `count` (1..65535) substeps. Once all have been joined.
	void need(std::uint32_t row, int count);
	/// Gives every body that has a need what its heap needs. O(rows).
	void finish();
	/// Lets a body that is in no heap take `count` substeps, one of `counts()`, beside those who do.
	void add(std::uint32_t row, int count) { of_rows_[row] = std::uint16_t(count); }

	/// The different numbers of substeps, ascending.
	std::span<const int> counts() const { return counts_; }
	bool are_common() const { return of_rows_.empty(); }
	/// How many the body takes; 0: it is in no heap. With a common count, that.
	int of(std::uint32_t row) const { return of_rows_.empty() ? counts_[0] : of_rows_[row]; }
	/// Those who take `count`.
	HeapTurn turn(int count) const { return { of_rows_, std::uint16_t(count) }; }

private:
	Islands islands_;
	std::vector<std::uint16_t> of_rows_; ///< empty with a common count
	std::vector<std::uint16_t> needs_; ///< of heaps, by name
	std::vector<std::uint32_t> needing_; ///< rows
	std::vector<int> counts_;
};

} // namespace softbody
