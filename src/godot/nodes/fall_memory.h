// SPDX-License-Identifier: MIT
// Remembers what a fall does to a body, so that warnings about it may be asked for at any time.
#pragma once

#include "core/base/vec2.h"
#include "core/dynamics/fall_trial.h"
#include "core/model/body_settings.h"
#include "core/model/soft_body_shape.h"

#include <memory>
#include <optional>

namespace softbody {

/// The outcome of `try_falls` for the last shape and settings that it was asked about. One trial takes 1 to 30 ms for up to 64
/// hull points, and up to 2 s for a network of 256 that collapses.
class FallMemory {
public:
	const FallOutcome &outcome_of(const std::shared_ptr<const SoftBodyShape> &shape, const BodySettings &settings, Vec2 gravity, Real length_unit, Real dt) {
		const Question asked{ shape, settings, gravity, length_unit, dt };
		if (!(asked_ == asked)) {
			asked_ = asked;
			const auto body = SoftBodyData::create(shape, settings, {});
			outcome_ = body ? try_falls(body.value(), gravity, length_unit, dt) : FallOutcome{};
		}
		return outcome_;
	}

private:
	struct Question {
		std::shared_ptr<const SoftBodyShape> shape; ///< kept, so that no other shape gets its address
		BodySettings settings;
		Vec2 gravity;
		Real length_unit = 0;
		Real dt = 0;

		friend bool operator==(const Question &, const Question &) = default;
	};

	std::optional<Question> asked_;
	FallOutcome outcome_;
};

} // namespace softbody
