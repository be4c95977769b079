// SPDX-License-Identifier: MIT
// Prefetches the state of bodies that are stepped soon.
#pragma once

#include "core/base/vec2.h"
#include "core/dynamics/batch.h"

#include <array>
#include <cstddef>

namespace softbody {

/// Prefetches the state of a few bodies. A core tracks about a dozen cache lines in flight and waits beyond that. So
/// bodies are prefetched one or two at a time, between other work. Changes only the time that a step takes.
class StatePrefetch {
public:
	/// Adds a body of `point_count` points, at most WIDE_WIDTH of them.
	void add(const Vec2 *state, std::size_t point_count) {
		bytes_ = (2 * point_count + 1) * sizeof(Vec2); // the bodies of a batch have one size, and so have most of the next batch
		states_[count_++] = reinterpret_cast<const char *>(state);
	}
	/// Prefetches up to `bodies` more bodies.
	void ask(std::size_t bodies) {
#if defined(__GNUC__) || defined(__clang__)
		constexpr std::size_t LINE = 64; // bytes of a cache line on nearly all processors
		for (; bodies > 0 && asked_ < count_; --bodies, ++asked_) {
			for (std::size_t at = 0; at < bytes_; at += LINE) {
				__builtin_prefetch(states_[asked_] + at, 1);
			}
		}
#else
		(void)bodies;
#endif
	}
	void ask_all() { ask(count_); }

private:
	std::array<const char *, WIDE_WIDTH> states_;
	std::size_t count_ = 0;
	std::size_t asked_ = 0;
	std::size_t bytes_ = 0; ///< of a body
};

} // namespace softbody
