// SPDX-License-Identifier: MIT
// Finds and solves the contacts of bodies with the environment.
#include "core/collision/environment_contact_solver.h"

#include "core/collision/convex_query.h"
#include "core/geometry/segment.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace softbody {

Real fastest(std::span<const Vec2> velocities) {
	RealPack most(0);
	for (std::size_t i = 0; i < packs_for(velocities.size()); ++i) {
		most = greater(length_squared(pack_of(velocities, i)), most);
	}
	return std::sqrt(greatest_lane(most));
}

namespace {

// Whether a collider is one segment of a chain.
bool is_link(const Collider &collider) {
	return collider.vertices.size() == 2 && (collider.ghost_at_first || collider.ghost_at_second);
}

// Start positions of the hull points of a body that was placed across colliders: the path of each point starts at the middle of
// the body if it runs inside the hull. A point that it does not reach, as behind the dent of a concave body, stays where it is.
void start_from_middle(std::span<const Vec2> hull, std::span<const Vec2> before, std::vector<Vec2> &starts) {
	starts.assign(before.begin(), before.begin() + std::ptrdiff_t(hull.size()));
	const Vec2 middle = mean_of(hull);
	if (!point_in_polygon(middle, hull)) {
		return;
	}
	const std::size_t count = hull.size();
	for (std::size_t i = 0; i < count; ++i) {
		bool is_clear = true;
		for (std::size_t edge = 0; is_clear && edge < count; ++edge) {
			const std::size_t next = (edge + 1) % count;
			is_clear = edge == i || next == i || !segment_intersection(middle, hull[i], hull[edge], hull[next]);
		}
		if (is_clear) {
			starts[i] = middle;
		}
	}
}

constexpr Aabb NOWHERE{ { std::numeric_limits<Real>::quiet_NaN(), 0 }, { std::numeric_limits<Real>::quiet_NaN(), 0 } };

} // namespace

// The sweep box has a margin, as springs accelerate points within the step.
Aabb sweep_box(std::span<const Vec2> hull, std::span<const Vec2> velocities, Real dt) {
	Aabb box = bounding_box(hull);
	const Vec2 size = box.max - box.min;
	const Real way = fastest(velocities) * dt;
	// A body that is about to be reset must not be near everything.
	if (!is_finite(size)) {
		return NOWHERE;
	}
	return std::isfinite(way) ? box.grown(way + std::max(size.x, size.y) / 16) : box;
}

Circle sweep_circle(std::span<const Vec2> hull, Real pace, Real dt) {
	const Circle circle = circle_around(hull);
	const Real way = pace * dt;
	return std::isfinite(way) ? Circle{ circle.center, circle.radius * Real(1.125) + way } : circle;
}

bool EnvironmentContactSolver::begin_body(const ColliderIndex &surroundings, SoftBodyData &body, Real elapsed, Real dt,
		std::size_t lane) {
	surroundings_ = &surroundings;
	lane_ = lane;
	near().elapsed = elapsed;
	near().colliders.clear();
	if (surroundings.has_colliders()) {
		near().margin = fastest(body.velocities()) * dt + body.shape().radius() / 4;
		gather(body, near().margin);
	}
	near().is_placed = body.is_placed();
	body.set_placed(false);
	if (!body.one_ways().empty()) {
		forget_one_ways(body);
	}
	return !near().colliders.empty();
}

// Removes one-way colliders that are no longer near.
void EnvironmentContactSolver::forget_one_ways(SoftBodyData &body) const {
	const std::vector<Collider> &colliders = surroundings_->world().colliders();
	std::erase_if(body.one_ways(), [&](const OneWayMemory &memory) {
		return std::ranges::none_of(near().colliders, [&](std::uint32_t i) {
			return colliders[i].is_one_way() && one_way_name(colliders[i]) == memory.collider;
		});
	});
}

void EnvironmentContactSolver::gather(const SoftBodyData &body, Real margin) {
	near().reach = bounding_box(body.hull()).grown(margin);
	surroundings_->collect(near().reach, near().colliders);
	std::erase_if(near().colliders, [&](std::uint32_t i) {
		return !notices(body, surroundings_->world().colliders()[i].surface);
	});
	near().has_one_way = std::ranges::any_of(near().colliders, [&](std::uint32_t i) { return surroundings_->world().colliders()[i].is_one_way(); });
}

std::size_t EnvironmentContactSolver::handle(SoftBodyData &body, std::span<const Vec2> before, Vec2 gravity, Real h,
		std::size_t lane, Real implicit_share) {
	lane_ = lane;
	bounce_threshold_ = RESTITUTION_SUBSTEPS * length(gravity) * h;
	h_ = h;
	slide_time_ = h * implicit_share;
	load_ = {};
	handle_borders(body);
	if (surroundings_->has_colliders()) {
		handle_colliders(body, before);
	}
	near().elapsed += h;
	resist_rolling<Real>(lanes_of(body), load_);
	follow_bounce(body, load_, bounce_threshold_, h);
	return std::size_t(load_.contacts);
}

void EnvironmentContactSolver::handle_colliders(SoftBodyData &body, std::span<const Vec2> before) {
	const Aabb swept = HullMotion{ before, body.hull() }.box();
	if (!near().reach.contains(swept)) {
		// Search around the whole path of this substep, which may already have left the old box.
		const Vec2 way = swept.max - swept.min;
		gather(body, near().margin + std::max(way.x, way.y));
	}
	if (near().has_one_way) {
		begin_one_ways(body, before, swept);
	}
	starts_from_middle_.clear();
	if (std::exchange(near().is_placed, false)) {
		start_from_middle(body.hull(), before, starts_from_middle_);
	}
	// Points of all colliders first. An edge between a point that has been moved out and one that has not dips into the
	// seam of two colliders, and a corner there would push it back.
	for (const Part part : { Part::POINTS, Part::ROUND_EDGES, Part::CORNERS }) {
		if (part == Part::ROUND_EDGES && !has_round_edges(body.shape(), body.settings())) {
			continue;
		}
		pressing_links_ = 0;
		const Aabb reached = part == Part::ROUND_EDGES ? swept.grown(body.shape().greatest_bulge()) : swept;
		for (const std::uint32_t i : near().colliders) {
			handle_collider(body, before, reached, i, part);
		}
		// In a corner of a chain, a point that one segment has moved out may have passed an earlier one.
		if (part == Part::POINTS && pressing_links_ > 1) {
			for (const std::uint32_t i : near().colliders) {
				if (is_link(surroundings_->world().colliders()[i])) {
					handle_collider(body, before, swept, i, part);
				}
			}
		}
	}
}

void EnvironmentContactSolver::handle_collider(SoftBodyData &body, std::span<const Vec2> before, const Aabb &swept,
		std::uint32_t index, Part part) {
	const bool corners = part == Part::CORNERS;
	const Collider &collider = surroundings_->world().colliders()[index];
	collider_ = index;
	const Aabb bounds = surroundings_->bounds(index).grown(slop());
	if (!swept.overlaps(bounds)) {
		return;
	}
	const HullMotion hull{ starts_from_middle_.empty() || collider.is_one_way() ? before : starts_from_middle_, body.hull() };
	if (collider.rigid_body == NO_RIGID_BODY) {
		solve_collider(body, hull, collider, collider.surface, {}, corners ? bounding_box(hull.to) : bounds, part);
		return;
	}
	const ColliderMotion motion = motion_of(collider);
	const Surface surface = surface_in_motion(collider.surface, surroundings_->world().rigid_bodies()[collider.rigid_body], motion.to);
	solve_collider(body, hull, collider, surface, motion, corners ? hull.box() : collider.bounds().grown(slop()), part);
}

ColliderMotion EnvironmentContactSolver::motion_of(const Collider &collider) const {
	if (collider.rigid_body == NO_RIGID_BODY) {
		return {};
	}
	const RigidBody &mover = surroundings_->world().rigid_bodies()[collider.rigid_body];
	return { mover.pose_after(near().elapsed), mover.pose_after(near().elapsed + h_), false };
}

// `box` is the hull's box for the collider's corners, else the collider's box in its own frame.
void EnvironmentContactSolver::solve_collider(SoftBodyData &body, const HullMotion &hull, const Collider &collider,
		const Surface &surface, const ColliderMotion &motion, const Aabb &box, Part part) {
	std::optional<OneWay> one_way;
	HullMotion seen = hull;
	if (collider.is_one_way()) {
		one_way.emplace(body, collider, motion, surroundings_->world().length_unit());
		if (one_way->passes() || (!one_way->is_held() && is_beside_passed(body, collider))) {
			return;
		}
		starts_.resize(hull.to.size());
		std::ranges::transform(hull.from.first(hull.to.size()), starts_.begin(), [&](Vec2 p) { return one_way->start_of(p); });
		seen.from = starts_;
	}
	const auto find = [&](std::uint32_t i) -> std::optional<SurfaceContact> {
		switch (part) {
			case Part::POINTS:
				return find_contact_of_point(seen, i, collider, motion, box, slop());
			case Part::ROUND_EDGES: {
				const Real bulge = body.shape().bulges()[i];
				return bulge > 0 ? find_contact_of_edge(hull, i, bulge, collider, motion, box, slop()) : std::nullopt;
			}
			case Part::CORNERS:
				return find_contact_of_corner(hull, box, collider, i, motion, slop());
		}
		return {};
	};
	Real pressed = 0;
	// A point in an inner corner of a concave outline has passed two of its edges, and leaves through one after the other.
	const int most = collider.concave && part == Part::POINTS ? 2 : 1;
	const std::size_t count = part == Part::CORNERS ? collider.vertices.size() : hull.to.size();
	for (std::uint32_t i = 0; i < count; ++i) {
		for (int edge = 0; edge < most; ++edge) {
			const std::optional<SurfaceContact> contact = find(i);
			if (!contact || (one_way && !one_way->counts(*contact, hull))) {
				break;
			}
			pressed += solve(body, *contact, surface, part == Part::CORNERS ? ContactPoint::CORNER | i : nearest_point(contact->place));
		}
	}
	pressing_links_ += is_link(collider) && pressed > 0 ? 1 : 0;
	if (one_way && pressed > 0) {
		one_way->hold(body.hull(), own_hull_);
	}
}

// For a platform made of many pieces: a body that passes one piece passes adjacent pieces too; otherwise they would
// catch its sides.
bool EnvironmentContactSolver::is_beside_passed(const SoftBodyData &body, const Collider &collider) const {
	if (std::ranges::none_of(body.one_ways(), [](const OneWayMemory &each) { return !each.held; })) {
		return false;
	}
	const WorldData &world = surroundings_->world();
	const Aabb box = collider.bounds().grown(slop());
	return std::ranges::any_of(near().colliders, [&](std::uint32_t i) {
		const Collider &other = world.colliders()[i];
		return &other != &collider && other.rigid_body == collider.rigid_body && other.one_way == collider.one_way &&
				box.overlaps(other.bounds()) && is_passing(body, other);
	});
}

void EnvironmentContactSolver::begin_one_ways(SoftBodyData &body, std::span<const Vec2> before, const Aabb &swept) {
	const WorldData &world = surroundings_->world();
	for (const std::uint32_t i : near().colliders) {
		const Collider &collider = world.colliders()[i];
		if (collider.is_one_way() && swept.overlaps(surroundings_->bounds(i).grown(slop()))) {
			const ColliderMotion motion = motion_of(collider);
			OneWay(body, collider, motion, world.length_unit()).begin_substep(before.first(body.hull().size()), own_hull_);
		}
	}
}

// Returns the normal impulse.
Real EnvironmentContactSolver::solve(SoftBodyData &body, const SurfaceContact &contact, const Surface &surface,
		std::uint32_t feature) {
	const SurfaceImpulse impulse = solve_surface_contact(body, contact, surface, bounce_threshold_, slide_time_);
	const Vec2 place = body.positions()[contact.place.a];
	load_.add(impulse.normal, contact.normal, impulse.sliding, place, surface, combined_restitution(body.settings(), surface));
	load_.contacts += 1;
	if (body.settings().contact_monitor) {
		log_.add({ index_of(body), ContactOther::Kind::COLLIDER, collider_, feature, nearest_point(contact.place), 0,
				position_of(contact.place, body.positions()), contact.normal, impulse.normal, contact.depth });
	}
	return impulse.normal;
}

void EnvironmentContactSolver::handle_borders(SoftBodyData &body) {
	const std::vector<Border> &borders = surroundings_->world().borders();
	const bool is_monitored = body.settings().contact_monitor;
	for (std::uint32_t i = 0; i < borders.size(); ++i) {
		if (!notices(body, borders[i].surface)) {
			continue;
		}
		solutions_.assign(is_monitored ? body.shape().hull_count() : 0, {});
		solve_border<Real>(lanes_of(body), borders[i], bounce_threshold_, slide_time_, load_, solutions_);
		for (std::uint32_t point = 0; point < solutions_.size(); ++point) {
			if (solutions_[point].depth > 0) {
				log_.add({ index_of(body), ContactOther::Kind::BORDER, i, point, point, 0, body.positions()[point],
						borders[i].plane.normal, solutions_[point].normal_impulse, solutions_[point].depth });
			}
		}
	}
}

std::uint32_t EnvironmentContactSolver::index_of(const SoftBodyData &body) const {
	return std::uint32_t(&body - surroundings_->world().soft_bodies().data());
}

Real measure_penetration(const WorldData &world, const SoftBodyData &body) {
	Real deepest = 0;
	for (const Border &border : world.borders()) {
		for (const Vec2 p : body.hull()) {
			if (notices(body, border.surface)) {
				deepest = std::max(deepest, -signed_distance(border.plane, p));
			}
		}
	}
	const Aabb box = bounding_box(body.hull());
	for (const Collider &collider : world.colliders()) {
		if (!notices(body, collider.surface) || is_passing(body, collider)) {
			continue;
		}
		ColliderMotion motion;
		if (collider.rigid_body != NO_RIGID_BODY) {
			const Pose &pose = world.rigid_bodies()[collider.rigid_body].pose;
			motion = { pose, pose, false };
		} else if (!box.overlaps(collider.bounds())) {
			continue;
		}
		for (const Vec2 p : body.hull()) {
			deepest = std::max(deepest, -surface_distance(collider, motion.own_to(p)).distance);
		}
		for (std::size_t corner = 0; corner < collider.vertices.size(); ++corner) {
			if (const auto contact = find_contact_of_corner({ body.hull(), body.hull() }, box, collider, corner, motion)) {
				deepest = std::max(deepest, contact->depth);
			}
		}
	}
	return deepest;
}

} // namespace softbody
