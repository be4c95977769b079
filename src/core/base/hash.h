// SPDX-License-Identifier: MIT
// A hash over the bits of values.
#pragma once

#include "core/base/vec2.h"

#include <bit>
#include <cstdint>

namespace softbody {

/// Spreads a key over the slots of a hash table.
constexpr std::uint64_t mixed(std::uint64_t key) {
	key ^= key >> 31;
	key *= 0x9e3779b97f4a7c15u; // 2^64 over the golden ratio (Knuth's multiplicative hash)
	return key ^ (key >> 29);
}

/// FNV-1a over the bits of values.
class Hash {
public:
	void add(std::uint64_t bits) { state_ = (state_ ^ bits) * 0x100000001b3u; }
	void add(Real value) { add(std::uint64_t(std::bit_cast<std::uint64_t>(double(value)))); }
	void add(Vec2 value) {
		add(value.x);
		add(value.y);
	}
	std::uint64_t value() const { return state_ ^ state_ >> 32; }

private:
	std::uint64_t state_ = 0xcbf29ce484222325u;
};

} // namespace softbody
