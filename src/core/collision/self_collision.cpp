// SPDX-License-Identifier: MIT
// Contacts of a body with itself.
#include "core/collision/self_collision.h"

#include "core/base/constants.h"
#include "core/base/elementary.h"
#include "core/collision/point_edge_constraint.h"
#include "core/geometry/polygon.h"
#include "core/geometry/segment.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

namespace softbody {

namespace {

Real sign_of(double value) {
	return value > 0 ? Real(1) : Real(-1);
}

// Whether segments ab and cd cross, with each end clearly on one side of the other segment. Touching is not crossing.
bool cross_properly(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
	const double of_c = signed_double_area(a, b, c);
	const double of_d = signed_double_area(a, b, d);
	const double of_a = signed_double_area(c, d, a);
	const double of_b = signed_double_area(c, d, b);
	return ((of_c > 0 && of_d < 0) || (of_c < 0 && of_d > 0)) && ((of_a > 0 && of_b < 0) || (of_a < 0 && of_b > 0));
}

// About the moving origin, to keep the precision of the body's own size.
double angular_momentum(const SoftBodyData &body, std::span<const Vec2> hull, Vec2 origin) {
	double sum = 0;
	for (std::size_t i = 0; i < body.point_count(); ++i) {
		const Vec2d arm = i < body.shape().hull_count() ? difference(hull[i], {}) : difference(body.positions()[i], origin);
		sum += cross(arm, difference(body.velocities()[i], {})) / double(body.inverse_masses()[i]);
	}
	return sum;
}

// Restores the angular momentum as spin of the whole body. Moving points across their velocities has changed it.
void restore_angular_momentum(SoftBodyData &body, std::span<const Vec2> hull, Vec2 origin, double wanted) {
	const auto arm_of = [&](std::size_t i) {
		return i < body.shape().hull_count() ? difference(hull[i], {}) : difference(body.positions()[i], origin);
	};
	Vec2d center;
	double mass = 0;
	for (std::size_t i = 0; i < body.point_count(); ++i) {
		const double own = 1 / double(body.inverse_masses()[i]);
		center = center + arm_of(i) * own;
		mass += own;
	}
	center = center * (1 / mass);
	double inertia = 0;
	for (std::size_t i = 0; i < body.point_count(); ++i) {
		const Vec2d arm = arm_of(i) - center;
		inertia += dot(arm, arm) / double(body.inverse_masses()[i]);
	}
	if (!(inertia > 0)) {
		return;
	}
	const double spin = (wanted - angular_momentum(body, hull, origin)) / inertia;
	for (std::size_t i = 0; i < body.point_count(); ++i) {
		const Vec2d arm = arm_of(i) - center;
		body.mutable_velocities()[i] += Vec2(Vec2d{ -arm.y, arm.x } * spin);
	}
}

} // namespace

std::size_t SelfCollision::handle(SoftBodyData &body, std::span<const Vec2> before, Real h) {
	if (!begin(body, before)) {
		return 0;
	}
	std::size_t contacts = 0;
	double spin = 0;
	bool is_left_alone = false;
	for (int pass = 0; pass < SELF_CONTACT_PASSES; ++pass) {
		const std::size_t known = contacts;
		build_boxes();
		visit_candidates(gap_, [&](std::uint32_t point, std::uint32_t edge) {
			if (is_left_alone) {
				return;
			}
			const std::optional<Contact> contact = find_contact(point, edge, gap_);
			if (!contact) {
				return;
			}
			if (contacts == 0) {
				is_left_alone = was_folded();
				if (is_left_alone) {
					return;
				}
				spin = !body.is_free() ? 0 : angular_momentum(body, to_, origin_);
			}
			++contacts;
			solve(body, point, edge, *contact, h);
		});
		if (contacts == known) {
			break;
		}
		if (pass + 1 == SELF_CONTACT_PASSES) {
			hold_zones(body);
		}
	}
	if (contacts > 0) {
		if (!body.has_pins()) {
			restore_angular_momentum(body, to_, origin_, spin);
		}
		end(body);
	}
	return contacts;
}

bool SelfCollision::begin(const SoftBodyData &body, std::span<const Vec2> before) {
	const std::span<const Vec2> hull = body.hull();
	const std::size_t count = hull.size();
	count_ = std::uint32_t(count);
	from_.resize(run_count() * PACK_WIDTH + 1);
	to_.resize(from_.size());
	is_moved_.assign(count, 0);
	const Vec2 start = before[0];
	Vec2 way;
	for (std::size_t i = 0; i < count; ++i) {
		way += (hull[i] - before[i]) * (1 / Real(count));
	}
	if (!is_finite(way) || !is_finite(start)) {
		return false; // the step resets the body
	}
	origin_ = start + way;
	shift_ = origin_ - start;
	for (std::size_t i = 0; i < count; ++i) {
		from_[i] = before[i] - start;
		to_[i] = hull[i] - origin_;
	}
	std::fill(from_.begin() + count_, from_.end(), from_[0]);
	// Far from the world's origin, positions are too coarse for a small gap.
	const Real farthest = std::max(std::abs(origin_.x), std::abs(origin_.y)) + body.shape().radius();
	gap_ = std::max(SELF_GAP * body.shape().shortest_hull_edge(), 16 * std::numeric_limits<Real>::epsilon() * farthest);
	return true;
}

void SelfCollision::end(SoftBodyData &body) {
	for (std::size_t i = 0; i < count_; ++i) {
		if (is_moved_[i]) {
			body.mutable_positions()[i] = origin_ + to_[i];
		}
	}
}

namespace {

Vec2 lesser_of(Vec2 a, Vec2 b) {
	return { std::min(a.x, b.x), std::min(a.y, b.y) };
}
Vec2 greater_of(Vec2 a, Vec2 b) {
	return { std::max(a.x, b.x), std::max(a.y, b.y) };
}

template <class Boxes>
std::uint32_t overlaps(const Boxes &boxes, Vec2 min, Vec2 max) {
	const PackMask beside = both(!(boxes.max.x < RealPack(min.x)), !(RealPack(max.x) < boxes.min.x));
	const PackMask above = both(!(boxes.max.y < RealPack(min.y)), !(RealPack(max.y) < boxes.min.y));
	return bits(both(beside, above));
}

} // namespace

// Boxes of the edges of a run, along the paths of their ends.
SelfCollision::Boxes SelfCollision::edge_boxes(std::uint32_t run) const {
	const std::size_t i = run * PACK_WIDTH;
	Boxes boxes;
	boxes.min = boxes.max = consecutive(&from_[i]);
	for (const Vec2 *other : { &from_[i + 1], &to_[i], &to_[i + 1] }) {
		const BasicVec2<RealPack> p = consecutive(other);
		boxes.min = { lesser(boxes.min.x, p.x), lesser(boxes.min.y, p.y) };
		boxes.max = { greater(boxes.max.x, p.x), greater(boxes.max.y, p.y) };
	}
	return boxes;
}

// A tree of boxes in hull order, PACK_WIDTH boxes under each. Unsorted: neighbors on the hull are near in the plane.
void SelfCollision::build_boxes() {
	std::fill(to_.begin() + count_, to_.end(), to_[0]);
	boxes_.clear();
	level_count_ = 0;
	constexpr Real FAR = std::numeric_limits<Real>::max();
	const Boxes nowhere{ in_all_lanes<RealPack>({ FAR, FAR }), in_all_lanes<RealPack>({ -FAR, -FAR }) };
	std::size_t entries = run_count();
	do {
		const std::size_t begin = boxes_.size();
		boxes_.resize(begin + (entries + PACK_WIDTH - 1) / PACK_WIDTH, nowhere);
		for (std::size_t i = 0; i < entries; ++i) {
			const Boxes below = level_count_ == 0 ? edge_boxes(std::uint32_t(i)) : boxes_[levels_[level_count_ - 1] + i];
			Vec2 min = lane_of(below.min, 0);
			Vec2 max = lane_of(below.max, 0);
			for (std::size_t lane = 1; lane < PACK_WIDTH; ++lane) {
				min = lesser_of(min, lane_of(below.min, lane));
				max = greater_of(max, lane_of(below.max, lane));
			}
			set_lane(boxes_[begin + i / PACK_WIDTH].min, i % PACK_WIDTH, min);
			set_lane(boxes_[begin + i / PACK_WIDTH].max, i % PACK_WIDTH, max);
		}
		levels_[level_count_++] = begin;
		entries = boxes_.size() - begin;
	} while (entries > 1);
}

// Whether two adjacent runs go on in one direction at the start and end of the substep, and so at all times between.
// Such a chain cannot meet itself. Most adjacent runs are straight, and need no other test though their boxes overlap.
bool SelfCollision::is_straight(std::uint32_t run, std::uint32_t next) const {
	const std::uint32_t last = std::min(std::uint32_t((next + 1) * PACK_WIDTH), count_);
	const std::uint32_t first = run * PACK_WIDTH;
	const Vec2 direction = (from_[last] - from_[first]) + (to_[last] - to_[first]);
	const BasicVec2<RealPack> along = in_all_lanes<RealPack>(direction);
	std::uint32_t backwards = 0;
	for (const std::uint32_t each : { run, next }) {
		const std::size_t i = each * PACK_WIDTH;
		const RealPack before = dot(along, consecutive(&from_[i + 1]) - consecutive(&from_[i]));
		const RealPack now = dot(along, consecutive(&to_[i + 1]) - consecutive(&to_[i]));
		std::uint32_t lanes = bits(!both(before > RealPack(0), now > RealPack(0)));
		if (i + PACK_WIDTH > count_) {
			lanes &= (1u << (count_ - i)) - 1; // padding of the last run
		}
		backwards |= lanes;
	}
	return backwards == 0;
}

template <class Visit>
void SelfCollision::visit_runs(const Aabb &box, std::size_t level, std::size_t pack, const Visit &visit) const {
	for (std::uint32_t hits = overlaps(boxes_[levels_[level] + pack], box.min, box.max); hits != 0; hits &= hits - 1) {
		const std::size_t child = pack * PACK_WIDTH + std::size_t(std::countr_zero(hits));
		if (level == 0) {
			visit(std::uint32_t(child));
		} else {
			visit_runs(box, level - 1, child, visit);
		}
	}
}

template <class Visit>
void SelfCollision::visit_run_pairs(Real gap, const Visit &visit) const {
	const std::uint32_t runs = run_count();
	bool was_straight = runs > 2 && is_straight(runs - 1, 0);
	for (std::uint32_t run = 0; run < runs; ++run) {
		const std::uint32_t next = run + 1 == runs ? 0 : run + 1;
		const bool goes_straight = runs > 2 && is_straight(run, next);
		if (!goes_straight && !was_straight) {
			visit(run, run);
		}
		if (!goes_straight && (runs > 2 || run < next)) {
			visit(std::min(run, next), std::max(run, next));
		}
		was_straight = goes_straight;
		if (runs <= 3) {
			continue; // all runs are adjacent
		}
		const Boxes &own = boxes_[run / PACK_WIDTH];
		const Aabb box{ lane_of(own.min, run % PACK_WIDTH), lane_of(own.max, run % PACK_WIDTH) };
		visit_runs(box.grown(gap), level_count_ - 1, 0, [&](std::uint32_t other) {
			if (other > run + 1 && !(run == 0 && other + 1 == runs)) {
				visit(run, other);
			}
		});
	}
}

template <class Visit>
void SelfCollision::visit_candidates(Real gap, const Visit &visit) const {
	const auto visit_points = [&](std::uint32_t of_points, std::uint32_t of_edges) {
		const Boxes edges = edge_boxes(of_edges);
		const std::uint32_t first = of_points * PACK_WIDTH;
		for (std::uint32_t point = first; point < std::min(first + std::uint32_t(PACK_WIDTH), count_); ++point) {
			const Vec2 min = lesser_of(from_[point], to_[point]) - Vec2{ gap, gap };
			const Vec2 max = greater_of(from_[point], to_[point]) + Vec2{ gap, gap };
			for (std::uint32_t hits = overlaps(edges, min, max); hits != 0; hits &= hits - 1) {
				const std::uint32_t edge = of_edges * PACK_WIDTH + std::uint32_t(std::countr_zero(hits));
				if (edge < count_ && edge != point && after(edge) != point) {
					visit(point, edge);
				}
			}
		}
	};
	visit_run_pairs(gap, [&](std::uint32_t a, std::uint32_t b) {
		visit_points(a, b);
		if (a != b) {
			visit_points(b, a);
		}
	});
}

bool SelfCollision::was_folded() const {
	double twice_area = 0;
	for (std::uint32_t i = 0; i < count_; ++i) {
		twice_area += cross(difference(from_[i], {}), difference(from_[i + 1], {}));
	}
	bool is_crossed = false;
	visit_run_pairs(0, [&](std::uint32_t a, std::uint32_t b) {
		for (std::uint32_t i = a * PACK_WIDTH; !is_crossed && i < std::min<std::uint32_t>((a + 1) * PACK_WIDTH, count_); ++i) {
			for (std::uint32_t j = b * PACK_WIDTH; !is_crossed && j < std::min<std::uint32_t>((b + 1) * PACK_WIDTH, count_); ++j) {
				is_crossed = cross_properly(from_[i], from_[i + 1], from_[j], from_[j + 1]);
			}
		}
	});
	return is_crossed || !(twice_area > 0);
}

// With a, b the ends of the edge and p the point, all in uniform motion, p is on the line ab when
//   f(t) = cross(b - a, p - a) = 0,
// a quadratic. If its three Bernstein coefficients have one sign, f has that sign too. Nearly all candidates end here.
std::optional<SelfCollision::Contact> SelfCollision::find_contact(std::uint32_t point, std::uint32_t edge,
		Real gap) const {
	const std::uint32_t next = after(edge);
	const Vec2d edge_from = difference(from_[next], from_[edge]);
	const Vec2d edge_to = difference(to_[next], to_[edge]);
	const Vec2d offset_from = difference(from_[point], from_[edge]);
	const Vec2d offset_to = difference(to_[point], to_[edge]);
	const double first = cross(edge_from, offset_from);
	const double middle = (cross(edge_from, offset_to) + cross(edge_to, offset_from)) / 2;
	const double last = cross(edge_to, offset_to);
	if ((first > 0 && middle > 0 && last > 0) || (first < 0 && middle < 0 && last < 0)) {
		return find_near_contact(point, edge, sign_of(first), gap);
	}
	const std::optional<SegmentImpact> impact = point_segment_impact({ from_[point], to_[point] },
			{ from_[edge], to_[edge] }, { from_[next], to_[next] });
	if (!impact) {
		return find_near_contact(point, edge, sign_of(last), gap); // the point passed beside the edge, if at all
	}
	// The point started on the side given by f at the start. If there are two roots, a point that meets the edge at the
	// second one crossed the line beside the edge before.
	Real side = first == 0 ? side_of_chain(point, edge) : sign_of(first);
	const double bend = first - 2 * middle + last;
	if (first * last > 0 && double(impact->time) > (first - middle) / bend + 1e-5) {
		side = -side;
	}
	// Depth beyond the place of impact, along the edge's normal at the impact.
	const Vec2d edge_then = edge_from + (edge_to - edge_from) * double(impact->time);
	const double size_then = length(edge_then);
	if (!(size_then > 0)) {
		return Contact{}; // left to an impact zone
	}
	const Vec2d normal = Vec2d{ -edge_then.y, edge_then.x } * (double(side) / size_then);
	const Real depth = gap - Real(dot(normal, offset_to - edge_to * double(impact->parameter)));
	return Contact{ impact->parameter, Vec2(normal), std::max(depth, Real(0)) };
}

// Contact of a point that stays on its side of the edge, but nearer than the gap.
std::optional<SelfCollision::Contact> SelfCollision::find_near_contact(std::uint32_t point, std::uint32_t edge, Real side,
		Real gap) const {
	const std::uint32_t next = after(edge);
	const Vec2 way = to_[next] - to_[edge];
	const Vec2 offset = to_[point] - to_[edge];
	const Real size_squared = length_squared(way);
	if (!(size_squared > 0)) {
		return {}; // the adjacent edges find the contact
	}
	const Real along = dot(offset, way) / size_squared;
	if (along > 0 && along < 1) {
		const Real size = std::sqrt(size_squared);
		const Vec2 normal = perpendicular(way) * (side / size);
		const Real depth = gap - dot(offset, normal);
		return depth > 0 ? std::optional(Contact{ along, normal, depth }) : std::nullopt;
	}
	const std::uint32_t end = along > 0 ? next : edge;
	if (after(point) == end || after(end) == point) {
		return {}; // an edge may have any length
	}
	const Vec2 apart = to_[point] - to_[end];
	const Real distance = length(apart);
	if (!(distance < gap && distance > 0)) {
		return {};
	}
	return Contact{ end == next ? Real(1) : Real(0), apart * (1 / distance), gap - distance };
}

// Side of a point that starts on the edge, by its two neighbors on the hull.
Real SelfCollision::side_of_chain(std::uint32_t point, std::uint32_t edge) const {
	double sum = 0;
	for (const std::uint32_t neighbor : { point == 0 ? count_ - 1 : point - 1, after(point) }) {
		sum += signed_double_area(from_[edge], from_[after(edge)], from_[neighbor]);
	}
	return sum < 0 ? Real(-1) : Real(1); // inner side in doubt
}

void SelfCollision::solve(SoftBodyData &body, std::uint32_t point, std::uint32_t edge, const Contact &contact, Real h) {
	const std::uint32_t next = after(edge);
	const PointAgainstEdge sides{ point, body.inverse_masses()[point],
		PointOnEdge({ edge, next, contact.t }, body.inverse_masses()) };
	if (!(sides.inverse_mass() > 0)) {
		return; // pinned
	}
	const std::span<Vec2> velocities = body.mutable_velocities();
	const Vec2 relative = velocities[point] - sides.edge.of(velocities);
	// As between bodies: the approach loses the part that made the depth.
	const Real normal_change = std::max(Real(0), std::min(-dot(relative, contact.normal), contact.depth / h));
	const ContactChange<Real> change =
			contact_change(relative, contact.normal, contact.depth, normal_change, body.settings().friction, h);
	const Real per_impulse = 1 / sides.inverse_mass();
	sides.part(to_, to_, change.position * per_impulse);
	sides.part(velocities, velocities, change.velocity * per_impulse);
	is_moved_[point] = is_moved_[edge] = is_moved_[next] = 1;
}

// Each round joins at least two zones, so the loop ends. A hull that is one zone has its start shape, moved and turned.
void SelfCollision::hold_zones(SoftBodyData &body) {
	zones_.resize(count_);
	std::iota(zones_.begin(), zones_.end(), 0u);
	// Points nearer than this might be rounded onto the other side.
	const Real sliver = gap_ / 4;
	for (bool has_joined = true; has_joined;) {
		has_joined = false;
		is_joined_.assign(count_, 0);
		build_boxes();
		visit_candidates(sliver, [&](std::uint32_t point, std::uint32_t edge) {
			const std::uint32_t next = after(edge);
			if (zones_[point] == zones_[edge] && zones_[point] == zones_[next]) {
				return;
			}
			if (!find_contact(point, edge, sliver)) {
				return;
			}
			const std::uint32_t zone = std::min({ zones_[point], zones_[edge], zones_[next] });
			for (const std::uint32_t old : { zones_[point], zones_[edge], zones_[next] }) {
				std::ranges::replace(zones_, old, zone);
			}
			is_joined_[zone] = 1;
			has_joined = true;
		});
		for (std::uint32_t zone = 0; zone < zones_.size(); ++zone) {
			if (is_joined_[zone] && zones_[zone] == zone) { // not joined to another zone since
				move_zone(body, zone);
			}
		}
	}
}

// Moves the zone as a rigid piece from its start shape, with the momentum and angular momentum of its points.
void SelfCollision::move_zone(SoftBodyData &body, std::uint32_t zone) {
	const std::span<Vec2> velocities = body.mutable_velocities();
	Vec2d center_from;
	Vec2d center_to;
	Vec2d momentum;
	double mass = 0;
	bool is_pinned = false;
	const auto for_points = [&](const auto &work) {
		for (std::uint32_t i = 0; i < zones_.size(); ++i) {
			if (zones_[i] == zone) {
				work(i, 1 / double(body.inverse_masses()[i]));
			}
		}
	};
	for_points([&](std::uint32_t i, double own) {
		is_pinned |= body.inverse_masses()[i] == 0;
		center_from = center_from + difference(from_[i], {}) * own;
		center_to = center_to + difference(to_[i], {}) * own;
		momentum = momentum + difference(velocities[i], {}) * own;
		mass += own;
	});
	if (is_pinned) {
		for_points([&](std::uint32_t i, double) {
			to_[i] = from_[i] - shift_;
			velocities[i] = {};
			is_moved_[i] = 1;
		});
		return;
	}
	center_from = center_from * (1 / mass);
	center_to = center_to * (1 / mass);
	const Vec2d velocity = momentum * (1 / mass);
	double along = 0;
	double across = 0;
	double angular = 0;
	double inertia = 0;
	for_points([&](std::uint32_t i, double own) {
		const Vec2d q = difference(from_[i], {}) - center_from;
		const Vec2d r = difference(to_[i], {}) - center_to;
		along += own * dot(q, r);
		across += own * cross(q, r);
		angular += own * cross(r, difference(velocities[i], {}) - velocity);
		inertia += own * dot(q, q);
	});
	const double norm = hypotenuse(along, across);
	const double c = norm > 0 ? along / norm : 1.0;
	const double s = norm > 0 ? across / norm : 0.0;
	const double spin = inertia > 0 ? angular / inertia : 0.0;
	for_points([&](std::uint32_t i, double) {
		const Vec2d q = difference(from_[i], {}) - center_from;
		const Vec2d r{ c * q.x - s * q.y, s * q.x + c * q.y };
		to_[i] = Vec2(center_to + r);
		velocities[i] = Vec2(velocity + Vec2d{ -r.y, r.x } * spin);
		is_moved_[i] = 1;
	});
}

} // namespace softbody
