// SPDX-License-Identifier: MIT
// What a step tells about touch: contacts, and when they begin and end.
#pragma once

#include "core/base/vec2.h"
#include "core/model/world_data.h"

#include <cstdint>

namespace softbody {

/// What a body touches: another soft body, or a part of the surroundings.
struct ContactOther {
	enum class Kind : std::uint8_t {
		SOFT_BODY,
		BORDER,
		COLLIDER, ///< also of a rigid body
	};
	Kind kind = Kind::SOFT_BODY;
	BodyId body; ///< the soft body
	std::uint32_t index = UINT32_MAX; ///< of the border or collider in the world's list, as it was during the step
	std::uint32_t rigid_body = NO_RIGID_BODY; ///< to which that collider belongs, likewise
	std::uint64_t tag = 0; ///< of its surface; how surroundings are known from step to step
};

/// One place where a body was touched during a step: a hull point of it in the other, or a corner or hull point of the
/// other in it. Several substeps in which that happened are one contact, with the impulses of all of them and the place
/// of the last.
///
/// Two soft bodies that both monitor have a contact each, mirrored: the same place, impulse and depth, opposite normals.
struct Contact {
	BodyId body; ///< the one that monitors (BodySettings::contact_monitor)
	ContactOther other;
	std::uint32_t hull_point = 0; ///< of the body, the nearest to the place
	Vec2 point; ///< in the world, once the two had been moved apart [length]
	Vec2 normal; ///< unit, out of the other, towards the body
	/// With which they pressed on each other along the normal, summed over the step [mass·length/s], >= 0. Divided by the
	/// length of the step it is a force. 0 where they overlapped but were already parting.
	Real normal_impulse = 0;
	Real depth = 0; ///< how far one was inside the other before they were moved apart [length], >= 0
};

/// A body and what it touches now, at rest or asleep too. The other is a soft body by its id, or everything in the
/// surroundings with one tag; what has no tag counts as one. Its indices are meaningless here.
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
	ContactOther other; ///< likewise; by body or tag, as in `Touch`
};

} // namespace softbody
