// SPDX-License-Identifier: MIT
// Colliders that hold from one side only.
#include "core/collision/one_way.h"

#include "core/base/constants.h"
#include "core/base/hash.h"
#include "core/collision/convex_query.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace softbody {

namespace {

constexpr Real NOWHERE = -std::numeric_limits<Real>::max();

/// Coordinates of a place: across the collider's one-way direction, and along it.
struct Place {
	Real across = 0;
	Real along = 0;
};

Place place_of(Vec2 p, Vec2 direction) {
	return { dot(p, perpendicular(direction)), dot(p, direction) };
}

// Largest extent of the collider along its one-way direction at the coordinate `across`: of its edges, moved out by the
// radius, and of its round corners.
Real front_at(Real across, const Collider &collider) {
	const std::vector<Vec2> &vertices = collider.vertices;
	Real front = NOWHERE;
	for (std::size_t i = 0; i < vertices.size(); ++i) {
		const Place corner = place_of(vertices[i], collider.one_way);
		const Real aside = across - corner.across;
		if (std::abs(aside) <= collider.radius) {
			front = std::max(front, corner.along + std::sqrt(collider.radius * collider.radius - aside * aside));
		}
		if (vertices.size() == 1) {
			continue;
		}
		const Vec2 end = vertices[(i + 1) % vertices.size()];
		const Vec2 way = end - vertices[i];
		const Vec2 normal = Vec2{ way.y, -way.x } * (collider.radius / length(way)); // outwards
		const Place a = place_of(vertices[i] + normal, collider.one_way);
		const Place b = place_of(end + normal, collider.one_way);
		if (across < std::min(a.across, b.across) || across > std::max(a.across, b.across)) {
			continue;
		}
		const Real span = b.across - a.across;
		const Real t = span != 0 ? std::clamp((across - a.across) / span, Real(0), Real(1)) : Real(0);
		front = std::max(front, span != 0 ? a.along + (b.along - a.along) * t : std::max(a.along, b.along));
	}
	return front;
}

// Distance from a place inside the hull back to the outline, against `direction`. 0 outside the hull.
Real hull_behind(std::span<const Vec2> hull, const Place &from, Vec2 direction) {
	Real behind = std::numeric_limits<Real>::max();
	bool is_inside = false;
	Place a = place_of(hull.back(), direction);
	for (const Vec2 p : hull) {
		const Place b = place_of(p, direction);
		if ((a.across > from.across) != (b.across > from.across)) {
			const Real along = a.along + (b.along - a.along) * ((from.across - a.across) / (b.across - a.across));
			if (along < from.along) {
				is_inside = !is_inside;
				behind = std::min(behind, from.along - along);
			}
		}
		a = b;
	}
	return is_inside ? behind : Real(0);
}

} // namespace

std::uint64_t one_way_name(const Collider &collider) {
	Hash hash;
	for (const Vec2 vertex : collider.vertices) {
		hash.add(vertex);
	}
	hash.add(collider.radius);
	hash.add(collider.one_way);
	hash.add(collider.surface.tag);
	return hash.value();
}

Real one_way_depth(std::span<const Vec2> hull, const Collider &collider, Real raised) {
	if (!bounding_box(hull).overlaps(collider.bounds().grown(raised))) {
		return 0;
	}
	Real deepest = 0;
	const auto look_at = [&](Real across) {
		const Real front = front_at(across, collider);
		if (front > NOWHERE) {
			deepest = std::max(deepest, hull_behind(hull, { across, front + raised }, collider.one_way));
		}
		return front;
	};
	for (const Vec2 p : hull) {
		const Place place = place_of(p, collider.one_way);
		const Real front = look_at(place.across);
		if (front > place.along && surface_distance(collider, p).distance < 0) {
			deepest = std::max(deepest, front - place.along);
		}
	}
	for (const Vec2 vertex : collider.vertices) {
		look_at(place_of(vertex, collider.one_way).across);
	}
	return deepest;
}

OneWay::OneWay(SoftBodyData &body, const Collider &collider, const ColliderMotion &motion, Real length_unit) :
		body_(body), collider_(collider), motion_(motion), name_(one_way_name(collider)),
		margin_(collider.one_way_margin < 0 ? ONE_WAY_MARGIN * length_unit : collider.one_way_margin) {
	recall();
}

OneWayMemory *OneWay::memory() const {
	const auto found = std::ranges::find(body_.one_ways(), name_, &OneWayMemory::collider);
	return found != body_.one_ways().end() ? &*found : nullptr;
}

void OneWay::recall() {
	const OneWayMemory *known = memory();
	passes_ = known != nullptr && !known->held;
	is_held_ = known != nullptr && known->held;
}

Real OneWay::depth_of(std::span<const Vec2> hull, const Pose &pose, Real raised, std::vector<Vec2> &scratch) const {
	if (motion_.is_still) {
		return one_way_depth(hull, collider_, raised);
	}
	scratch.clear();
	for (const Vec2 p : hull) {
		scratch.push_back(pose.apply_inverse(p));
	}
	return one_way_depth(scratch, collider_, raised);
}

void OneWay::begin_substep(std::span<const Vec2> hull_before, std::vector<Vec2> &scratch) {
	const Real depth = depth_of(hull_before, motion_.from, 0, scratch);
	const bool is_over = !(depth > 0) && (passes_ || (is_held_ && !(depth_of(hull_before, motion_.from, margin_, scratch) > 0)));
	if (is_over) {
		std::erase_if(body_.one_ways(), [this](const OneWayMemory &each) { return each.collider == name_; });
	} else if (!passes_ && !is_held_ && depth > margin_) {
		body_.one_ways().push_back({ name_, false });
	}
	recall();
}

Vec2 OneWay::start_of(Vec2 before) const {
	const Vec2 own = motion_.own_from(before);
	const Place place = place_of(own, collider_.one_way);
	const Real front = front_at(place.across, collider_);
	const Real sunk = front - place.along;
	const Real farthest = std::max(margin_, is_held_ ? 4 * margin_ : Real(0));
	if (!(front > NOWHERE) || !(sunk >= 0) || sunk > farthest) {
		return before;
	}
	return motion_.world_from(own + collider_.one_way * (sunk + Real(0.1) * margin_));
}

bool OneWay::counts(const SurfaceContact &contact, const HullMotion &hull) const {
	const Vec2 direction = motion_.turned(collider_.one_way);
	const Real facing = dot(contact.normal, direction);
	if (!(facing > ONE_WAY_FACING)) {
		return false;
	}
	const Vec2 from = position_of(contact.place, hull.from);
	const Vec2 own_from = motion_.own_from(from);
	if (is_held_) {
		return true;
	}
	if (contact.place.a == contact.place.b) { // a hull point beside the collider's core meets a face, not a round end
		const auto across = [&](Vec2 p) { return place_of(p, collider_.one_way).across; };
		const auto [least, most] = std::ranges::minmax(collider_.vertices, {}, across);
		if (across(own_from) >= across(least) && across(own_from) <= across(most)) {
			return true;
		}
	}
	// The place counts if it came down on the collider at least as fast as from the side.
	const Vec2 to = position_of(contact.place, hull.to);
	const Vec2 moved = to - (motion_.is_still ? from : motion_.to.apply(own_from));
	const Vec2 side = perpendicular(direction);
	return -dot(moved, direction) * facing >= -dot(moved, side) * dot(contact.normal, side);
}

void OneWay::hold(std::span<const Vec2> hull_now, std::vector<Vec2> &scratch) {
	if (memory() == nullptr && depth_of(hull_now, motion_.to, 0, scratch) <= margin_) {
		body_.one_ways().push_back({ name_, true });
	}
}

bool is_passing(const SoftBodyData &body, const Collider &collider) {
	if (!collider.is_one_way() || body.one_ways().empty()) {
		return false;
	}
	const std::uint64_t name = one_way_name(collider);
	return std::ranges::any_of(body.one_ways(), [&](const OneWayMemory &each) { return each.collider == name && !each.held; });
}

} // namespace softbody
