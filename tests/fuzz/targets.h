// SPDX-License-Identifier: MIT
// What is fuzzed: functions that take any bytes and claim something about what the core makes of them.
#pragma once

#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>

namespace softbody::fuzzing {

// Each returns if all its claims hold, else it throws `Broken`. `scripts/fuzz.sh` lets libFuzzer look for bytes that break
// one; tests/fuzz/test_fuzz.cpp runs them on seeded ones in every test run.

struct Broken : std::logic_error {
	using std::logic_error::logic_error;
};

inline void require(bool holds, const char *claim) {
	if (!holds) {
		throw Broken(claim);
	}
}

/// Hulls and structures of any numbers: either refused by name, or a body with sane derived values that can be stepped.
void fuzz_shape(std::span<const std::uint8_t> data);
/// The loader of saved states, of any bytes, with and without a right checksum.
void fuzz_state(std::span<const std::uint8_t> data);
/// Geometry on the integer grid, against exact answers by other formulas.
void fuzz_geometry(std::span<const std::uint8_t> data);
/// Any sequence of calls of the public interface of a world; if their bytes are a multiple of four, in two worlds whose tasks
/// run in different orders.
void fuzz_world(std::span<const std::uint8_t> data);
/// Cuts of any body along any line: refused by name, or simple pieces that lose nothing.
void fuzz_cut(std::span<const std::uint8_t> data);

} // namespace softbody::fuzzing
