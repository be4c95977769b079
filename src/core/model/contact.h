// SPDX-License-Identifier: MIT
// Contacts of a step, and the beginnings and ends of touches.
#pragma once

#include "core/base/vec2.h"
#include "core/model/world_data.h"

#include <cstdint>

namespace softbody {

/// The other side of a contact: another soft body, or a part of the environment.
struct ContactOther {
	enum class Kind : std::uint8_t {
		SOFT_BODY,
		BORDER,
		COLLIDER, ///< also a collider of a rigid body
	};
	Kind kind = Kind::SOFT_BODY;
	BodyId body; ///< the soft body
	std::uint32_t index = UINT32_MAX; ///< of the border or collider in the world's list during the step
	std::uint32_t rigid_body = NO_RIGID_BODY; ///< owner of that collider, by index during the step
	std::uint64_t tag = 0; ///< of its surface; identifies environment from step to step
};

/// One place where a body was touched during a step: a hull point of it in the other, or a corner or hull point of the
/// other in it. Contacts of several substeps at one place are one record, with the sum of their impulses and the last
/// place. Two soft bodies that both monitor have a mirrored contact each.
struct Contact {
	BodyId body; ///< the monitoring body (BodySettings::contact_monitor)
	ContactOther other;
	std::uint32_t hull_point = 0; ///< of the body, the nearest to the place
	Vec2 point; ///< in the world, after the two were moved apart [length]
	Vec2 normal; ///< unit, out of the other, towards the body
	/// Impulse between them along the normal, summed over the step [mass·length/s], >= 0. Divided by the length of the
	/// step it is a force. 0 where they overlapped but were already parting.
	Real normal_impulse = 0;
	Real depth = 0; ///< overlap before they were moved apart [length], >= 0
};

/// A body and a thing that it touches now, awake or asleep. The other is a soft body by its id, or everything in the
/// environment with one tag, or all without a tag. Its indices are meaningless here.
struct Touch {
	BodyId body;
	ContactOther other;
	Real apart = 0; ///< time since the last step that found a contact [s]
};

/// A touch has begun or ended.
struct ContactEvent {
	enum class Kind : std::uint8_t {
		BEGIN,
		END,
	};
	Kind kind = Kind::BEGIN;
	BodyId body; ///< may have been removed, if this is the end
	ContactOther other; ///< may have been removed, if this is the end; by body or tag, as in `Touch`
};

} // namespace softbody
