// SPDX-License-Identifier: MIT
// A character above a soft body, as the proxy of that body sees it.
#pragma once

#include "core/geometry/aabb.h"
#include "core/model/body_frame.h"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace softbody {

/// A character that stands on soft bodies or falls onto them, where the coming tick will find it.
struct Rider {
	Aabb box; ///< around its shapes in the world [px]
	Vec2 up; ///< unit vector, out of the floor
	Real speed = 0; ///< along `up` after the last step [px/s]
	Real reach = 0; ///< way to either side that it may go in a tick [px]
	bool stood = false; ///< on a soft body before the last step
	Real gap = 0; ///< between the soles and the highest place of a floor for it [px]

	/// The side of the box that faces the floor, with a margin of `above` and `below` it [px]. A quarter is left out at
	/// either end, where walls touch it.
	Aabb sole(Real above, Real below) const;

	friend bool operator==(const Rider &, const Rider &);
};

/// Mean velocity of the hull where it is at the soles, from `above` to `below` them [px]; nothing where it is not.
/// O(points).
std::optional<Vec2> velocity_at_soles(std::span<const Vec2> hull, std::span<const Vec2> velocities, const Rider &rider,
		Real above, Real below);

/// Whether the rider presses the hull from above in this tick, or may. O(points).
bool sinks_in(std::span<const Vec2> hull, const Rider &rider);

/// Marks the ends of all edges of the hull that come within `margin` [px] of a rider. O(points × riders).
void mark_at_riders(std::span<const Vec2> hull, std::span<const Rider> riders, Real margin, std::vector<bool> &r_marks);

/// Changes the velocity and spin of `frame` so that the places at the soles of riders that stand on the hull move along
/// their `up` as they do, and across it as the hull there: exactly for one rider, and along `up` for two on different
/// places; by least squares for more.
void move_with_riders(std::span<const Vec2> hull, std::span<const Vec2> velocities, std::span<const Rider> riders,
		BodyFrame &r_frame);

/// Number of pieces that `cut_for_riders` makes of one outline.
inline std::size_t pieces_for(std::size_t riders) {
	return 2 * riders + 1;
}
/// Cuts a convex outline so that riders find a floor at their soles and no wall beside them: all of it that is above the
/// soles of a rider is left out as far as the rider reaches. Writes `pieces_for(riders.size())` convex pieces of
/// positive winding, some of them empty. Riders stand side by side; all of them have the `up` of the first.
void cut_for_riders(std::span<const Vec2> outline, std::span<const Rider> riders, std::vector<std::vector<Vec2>> &r_pieces);

} // namespace softbody
