// SPDX-License-Identifier: MIT
// Asks memory for the state of bodies whose turn comes soon.
#pragma once

#include "core/base/pack.h"
#include "core/dynamics/batch_builder.h"

#include <array>
#include <cstddef>

namespace softbody {

/// Where bodies are too many for the cache, a step waits for memory: their state is asked for some batches ahead. A core
/// keeps track of a dozen or so lines on their way, and whoever asks for more waits: so a few bodies at a time, between
/// other work. Changes nothing but the time that a step takes.
class StatePrefetch {
public:
	/// Of one or two batches.
	void add(const Batch &batch) {
		bytes_ = (2 * batch.shape->point_count() + 1) * sizeof(Vec2); // velocities follow positions, and a rotation them
		for (std::uint32_t lane = 0; lane < batch.count; ++lane) {
			states_[count_++] = reinterpret_cast<const char *>(batch.positions[lane]);
		}
	}
	/// Asks for so many bodies more, as far as there are any.
	void ask(std::size_t bodies) {
#if defined(__GNUC__) || defined(__clang__)
		constexpr std::size_t LINE = 64; // bytes of a line of the cache, on nearly all processors
		for (; bodies > 0 && asked_ < count_; --bodies, ++asked_) {
			for (std::size_t at = 0; at < bytes_; at += LINE) {
				__builtin_prefetch(states_[asked_] + at, 1);
			}
		}
#else
		(void)bodies;
#endif
	}
	void prefetch_all() { ask(count_); }

private:
	std::array<const char *, 2 * PACK_WIDTH> states_;
	std::size_t count_ = 0;
	std::size_t asked_ = 0;
	std::size_t bytes_ = 0; ///< of a body; batches in a row are mostly alike
};

} // namespace softbody
