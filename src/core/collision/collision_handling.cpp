// SPDX-License-Identifier: MIT
// Finds and answers the contacts of bodies with their surroundings.
#include "core/collision/collision_handling.h"

#include "core/base/constants.h"
#include "core/collision/convex_query.h"
#include "core/geometry/triangle.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace softbody {

namespace {

bool notices(const BodySettings &settings, const Surface &surface) {
	return (settings.collision_mask & surface.layer) != 0;
}

// A collider's corner or round end against the hull: how far the hull must retreat from it.
std::optional<SurfaceContact> find_edge_contact(std::span<const Vec2> hull, Vec2 corner, Real radius) {
	std::size_t nearest = 0;
	Real nearest_t = 0;
	Real least = std::numeric_limits<Real>::max();
	for (std::size_t i = 0; i < hull.size(); ++i) {
		const Vec2 a = hull[i];
		const Vec2 b = hull[(i + 1) % hull.size()];
		const Real t = closest_parameter_on_segment(corner, a, b);
		const Real distance = length_squared(corner - (a + (b - a) * t));
		if (distance < least) {
			least = distance;
			nearest = i;
			nearest_t = t;
		}
	}
	const bool inside = point_in_polygon(corner, hull);
	const Real distance = std::sqrt(least);
	const Real depth = inside ? radius + distance : radius - distance;
	if (!(depth > 0)) {
		return {};
	}
	const std::size_t next = (nearest + 1) % hull.size();
	const Vec2 edge = hull[next] - hull[nearest];
	const Vec2 closest = hull[nearest] + edge * nearest_t;
	const Vec2 away = (closest - corner) * (inside ? Real(-1) : Real(1));
	// The hull must move so that the corner comes out through its nearest place: against the way from
	// the corner to that place when inside, along it when outside. On the line itself: the inward normal.
	Vec2 normal = perpendicular(edge);
	if (distance > Real(1e-4) * length(edge)) {
		normal = away;
	}
	const Real size = length(normal);
	if (!(size > 0)) {
		return {};
	}
	return SurfaceContact{ { nearest, next, nearest_t }, normal * (1 / size), depth };
}

} // namespace

void SurroundingsIndex::update(const WorldData &world) {
	world_ = &world;
	bounds_.clear();
	for (const ConvexCollider &collider : world.colliders()) {
		bounds_.push_back(collider.bounds());
	}
}

bool SurroundingsIndex::has_collider_in(const Aabb &box) const {
	return std::ranges::any_of(bounds_, [&](const Aabb &bounds) { return bounds.overlaps(box); });
}

namespace {

Real fastest(std::span<const Vec2> velocities) {
	Real most = 0;
	for (const Vec2 v : velocities) {
		most = std::max(most, length_squared(v));
	}
	return std::sqrt(most);
}

} // namespace

// The box may be outgrown within the step, as springs accelerate points.
Aabb sweep_box(std::span<const Vec2> hull, std::span<const Vec2> velocities, Real dt) {
	Aabb box = bounding_box(hull);
	const Vec2 size = box.max - box.min;
	const Real way = fastest(velocities) * dt;
	// A body that is about to be reset must not be near everything.
	return std::isfinite(way) ? box.grown(way + std::max(size.x, size.y) / 16) : box;
}

void CollisionHandling::begin_body(const SurroundingsIndex &surroundings, const SoftBodyData &body, Real dt) {
	surroundings_ = &surroundings;
	nearby_.clear();
	if (!surroundings.bounds().empty()) {
		margin_ = fastest(body.velocities()) * dt + body.shape().radius() / 4;
		gather(body, margin_);
	}
}

void CollisionHandling::gather(const SoftBodyData &body, Real margin) {
	nearby_.clear();
	reach_ = bounding_box(body.hull()).grown(margin);
	const std::span<const Aabb> bounds = surroundings_->bounds();
	for (std::uint32_t i = 0; i < bounds.size(); ++i) {
		if (notices(body.settings(), surroundings_->world().colliders()[i].surface) && reach_.overlaps(bounds[i])) {
			nearby_.push_back(i);
		}
	}
}

std::size_t CollisionHandling::handle(SoftBodyData &body, std::span<const Vec2> before, Vec2 gravity, Real h) {
	bounce_threshold_ = RESTITUTION_SUBSTEPS * length(gravity) * h;
	h_ = h;
	load_ = {};
	handle_borders(body);
	if (!surroundings_->bounds().empty()) {
		handle_colliders(body, before);
	}
	resist_rolling<Real>(lanes_of(body), load_);
	give_back_bounce(body, load_, bounce_threshold_, h);
	return std::size_t(load_.contacts);
}

void CollisionHandling::handle_colliders(SoftBodyData &body, std::span<const Vec2> before) {
	Aabb swept = bounding_box(body.hull());
	for (std::size_t i = 0; i < body.shape().hull_count(); ++i) {
		swept.include(before[i]);
	}
	if (!reach_.contains(swept)) {
		// Gather around the whole way of this substep, which may already have left the old box.
		const Vec2 way = swept.max - swept.min;
		gather(body, margin_ + std::max(way.x, way.y));
	}
	const WorldData &world = surroundings_->world();
	for (const std::uint32_t i : nearby_) {
		const Aabb &bounds = surroundings_->bounds()[i];
		if (swept.overlaps(bounds.grown(LINEAR_SLOP * world.length_unit()))) {
			handle_points(body, world.colliders()[i], bounds, before);
			handle_edges(body, world.colliders()[i]);
		}
	}
}

void CollisionHandling::answer(SoftBodyData &body, const SurfaceContact &contact, const Surface &surface) {
	const Real impulse = answer_contact(body, contact, surface, bounce_threshold_, h_);
	const Vec2 place = body.positions()[contact.place.a];
	load_.add(impulse, contact.normal, place, surface, combined_restitution(body.settings(), surface));
	load_.contacts += 1;
}

void CollisionHandling::handle_borders(SoftBodyData &body) {
	for (const Border &border : surroundings_->world().borders()) {
		if (notices(body.settings(), border.surface)) {
			answer_border<Real>(lanes_of(body), border, bounce_threshold_, h_, load_);
		}
	}
}

RealPack handle_borders_side_by_side(const BodyLanes<RealPack> &bodies, std::span<const Border> borders, Real h) {
	BasicContactLoad<RealPack> load;
	for (const Border &border : borders) {
		if (notices(bodies.model.settings, border.surface)) {
			answer_border<RealPack>(bodies, border, std::numeric_limits<Real>::infinity(), h, load);
		}
	}
	resist_rolling<RealPack>(bodies, load);
	return load.contacts;
}

void CollisionHandling::handle_points(SoftBodyData &body, const ConvexCollider &collider, const Aabb &bounds,
		std::span<const Vec2> before) {
	const Real slop = LINEAR_SLOP * surroundings_->world().length_unit();
	const Aabb thick = bounds.grown(slop);
	for (std::size_t i = 0; i < body.shape().hull_count(); ++i) {
		Aabb path;
		path.include(before[i]);
		path.include(body.positions()[i]);
		if (!path.overlaps(thick)) {
			continue;
		}
		if (const auto contact = find_point_contact(collider, before[i], body.positions()[i], slop)) {
			answer(body, { { i, i, 0 }, contact->normal, contact->depth }, collider.surface);
		}
	}
}

void CollisionHandling::handle_edges(SoftBodyData &body, const ConvexCollider &collider) {
	const Aabb box = bounding_box(body.hull()).grown(collider.radius);
	for (const Vec2 corner : collider.vertices) {
		if (!box.overlaps({ corner, corner })) {
			continue;
		}
		if (const auto contact = find_edge_contact(body.hull(), corner, collider.radius)) {
			answer(body, *contact, collider.surface);
		}
	}
}

Real measure_penetration(const WorldData &world, const SoftBodyData &body) {
	Real deepest = 0;
	for (const Border &border : world.borders()) {
		for (const Vec2 p : body.hull()) {
			if (notices(body.settings(), border.surface)) {
				deepest = std::max(deepest, -signed_distance(border.plane, p));
			}
		}
	}
	const Aabb box = bounding_box(body.hull());
	for (const ConvexCollider &collider : world.colliders()) {
		if (!notices(body.settings(), collider.surface) || !box.overlaps(collider.bounds())) {
			continue;
		}
		for (const Vec2 p : body.hull()) {
			deepest = std::max(deepest, -surface_distance(collider, p).distance);
		}
		for (const Vec2 corner : collider.vertices) {
			if (const auto contact = find_edge_contact(body.hull(), corner, collider.radius)) {
				deepest = std::max(deepest, contact->depth);
			}
		}
	}
	return deepest;
}

} // namespace softbody
