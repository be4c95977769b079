// SPDX-License-Identifier: MIT
// Groups of bodies that touch one another, directly or through others.
#pragma once

#include <cstdint>
#include <vector>

namespace softbody {

/// Disjoint sets of the numbers 0..n-1 (union by the smaller number, path halving), near O(1) for each operation. The
/// name of a set is its smallest member, so it does not depend on the order of joining.
class Islands {
public:
	/// Makes each number a set of its own.
	void reset(std::uint32_t count) {
		parents_.resize(count);
		for (std::uint32_t i = 0; i < count; ++i) {
			parents_[i] = i;
		}
	}
	std::uint32_t find(std::uint32_t i) {
		while (parents_[i] != i) {
			parents_[i] = parents_[parents_[i]];
			i = parents_[i];
		}
		return i;
	}
	void join(std::uint32_t a, std::uint32_t b) {
		a = find(a);
		b = find(b);
		parents_[a < b ? b : a] = a < b ? a : b;
	}

private:
	std::vector<std::uint32_t> parents_;
};

} // namespace softbody
