// SPDX-License-Identifier: MIT
// Contacts of soft bodies with one another.
#include "core/collision/pair_contact_solver.h"

#include "core/base/constants.h"
#include "core/geometry/circle.h"
#include "core/geometry/segment.h"

#include <algorithm>
#include <array>
#include <bit>

namespace softbody {

void PairContactSolver::begin_substep(Real h) {
	h_ = h;
}

namespace {

// Factor by which bodies may become faster in a step before candidates are listed anew, and the least path for which
// they are listed, as a share of the smaller radius.
constexpr Real FASTER = Real(1.5);
constexpr Real LEAST_PATH = Real(0.001);

// Path of both bodies from the start of this substep of `h` for which candidates are listed [length]; 0 if a list would
// not pay. A body goes the way of this substep, and as far in the others as it did before: contacts take back what
// forces push a body into others, in each substep.
Real path_ahead(const SolverBody &a, const SolverBody &b, Real h, int substeps_left) {
	const Real way = a.way + b.way;
	const Real later = (a.pace + b.pace) * h * Real(substeps_left);
	const Real wanted = FASTER * (way + later) + LEAST_PATH * std::min(a.rest_radius, b.rest_radius);
	const Real most = SWEEP_SHARE * std::min(a.width, b.width);
	return substeps_left > 0 && most > FASTER * way ? std::min(wanted, most) : Real(0);
}

} // namespace

std::size_t PairContactSolver::handle(SolverBody &a, SolverBody &b, PairCandidates &candidates, int substeps_left) {
	impulse_ = 0;
	push_ = {};
	const Real way = a.way + b.way;
	const Real path = a.path + b.path;
	if (candidates.holds_at(path + way)) {
		return handle_candidates(a, b, candidates);
	}
	candidates.clear();
	const Real margin = path_ahead(a, b, h_, substeps_left);
	const Real reach = a.radius + b.radius + margin;
	const Real distance_squared = length_squared(a.center - b.center);
	const bool are_near = a.box.grown(margin).overlaps(b.box) && distance_squared <= reach * reach;
	const bool are_fast = way > SWEEP_SHARE * std::min(a.width, b.width);
	const Real near = std::max(a.radius, b.radius);
	if (are_near && !are_fast && distance_squared < near * near && handle_crossing(a, b)) {
		return 1;
	}
	if (margin > 0) {
		if (are_near) {
			list_candidates(a, b, margin, candidates);
			candidates.begin_second();
			list_candidates(b, a, margin, candidates);
		}
		candidates.hold_until(path + margin);
		if (candidates.holds_at(path + way)) {
			return handle_candidates(a, b, candidates);
		}
	}
	return are_near ? handle_points(a, b, are_fast) : 0;
}

// Two hulls can cross without a point of either inside the other; then contacts of points cannot separate them.
bool PairContactSolver::handle_crossing(SolverBody &a, SolverBody &b) {
	const Vec2 middle_a = mean_of(a.hull());
	const Vec2 middle_b = mean_of(b.hull());
	// Both middles must lie inside both bodies. The middle of a bent body may be outside it, and a ball may be pressed
	// onto the middle of a plank.
	for (const SolverBody *body : { &a, &b }) {
		edges_.assign(body->hull());
		if (!edges_.contains(middle_a) || !edges_.contains(middle_b)) {
			return false;
		}
	}
	const Vec2 way = middle_a - middle_b;
	const Real distance = length(way);
	const Real most = std::min(a.reach(), b.reach());
	const Vec2 direction = distance > DEGENERATE_LENGTH * most ? way * (1 / distance) : Vec2{ 1, 0 };
	if (!part_bodies(a, b, direction, most)) {
		return false;
	}
	if (a.is_monitored || b.is_monitored) {
		log_.add({ a.body_index, ContactOther::Kind::SOFT_BODY, b.body_index, ContactPoint::WHOLE, 0, 0,
				(middle_a + middle_b) * Real(0.5), direction, 0, most });
	}
	return true;
}

namespace {

// Number of points of each body that are filtered before the near ones are handled.
constexpr std::uint32_t NEAR_BITS = 32;

// Bit mask of up to NEAR_BITS hull points from `first` on that are nearer than `reach` to `center`. Few points are near
// the other body; the filter skips the others several at a time.
std::uint32_t near_points(std::span<const Vec2> hull, std::uint32_t first, Vec2 center, Real reach) {
	const BasicVec2<RealPack> middle = in_all_lanes<RealPack>(center);
	const std::uint32_t end = std::min(std::uint32_t(hull.size()), first + NEAR_BITS);
	std::uint32_t near = 0;
	std::uint32_t i = first;
	for (; i + PACK_WIDTH <= end; i += PACK_WIDTH) {
		const RealPack distance = length_squared(consecutive(&hull[i]) - middle);
		near |= bits(distance < RealPack(reach * reach)) << (i - first);
	}
	for (; i < end; ++i) {
		near |= std::uint32_t(length_squared(hull[i] - center) < reach * reach) << (i - first);
	}
	return near;
}

} // namespace

namespace {

// Contact of a point that passed edges from outside in this substep, both moving. Only a point still behind such an
// edge has a contact. It must go back through the first edge that it crossed.
std::optional<HullContact> find_passage(const SolverBody &body, const SolverBody &other, std::uint32_t point) {
	const Motion path{ body.before[point], body.positions[point] };
	std::optional<HullContact> first;
	Real first_time = 2;
	const std::span<const Vec2> hull = other.hull();
	for (std::uint32_t i = 0; i < hull.size(); ++i) {
		const std::uint32_t next = i + 1 == hull.size() ? 0 : i + 1;
		const Motion start{ other.before[i], hull[i] };
		const Motion end{ other.before[next], hull[next] };
		if (cross(end.from - start.from, path.from - start.from) > 0) {
			continue; // the point came from inside
		}
		const std::optional<SegmentImpact> impact = point_segment_impact(path, start, end);
		if (!impact || impact->time >= first_time) {
			continue;
		}
		const Vec2 edge = end.to - start.to;
		const Real size = length(edge);
		const Vec2 normal{ edge.y, -edge.x };
		const Real depth = size > 0 ? -dot(normal, path.to - start.to) / size : Real(0);
		if (depth > 0) {
			first_time = impact->time;
			first = HullContact{ i, impact->parameter, normal * (1 / size), depth };
		}
	}
	return first;
}

} // namespace

std::size_t PairContactSolver::handle_points(SolverBody &a, SolverBody &b, bool are_fast) {
	edges_of_ = nullptr;
	return handle_points_of(a, b, are_fast, 1) + handle_points_of(b, a, are_fast, -1);
}

std::size_t PairContactSolver::handle_points_of(SolverBody &body, SolverBody &other, bool are_fast, Real side) {
	const Real reach = other.radius + (are_fast ? body.way : Real(0));
	std::size_t contacts = 0;
	for (std::uint32_t first = 0; first < body.hull().size(); first += NEAR_BITS) {
		for (std::uint32_t near = near_points(body.hull(), first, other.center, reach); near != 0; near &= near - 1) {
			const std::uint32_t point = first + std::uint32_t(std::countr_zero(near));
			std::optional<HullContact> found = are_fast ? find_passage(body, other, point) : std::nullopt;
			const bool is_fresh = found.has_value();
			if (!found) {
				read_edges(other);
				found = edges_.find(body.positions[point], outward_at(body.hull(), point));
			}
			if (found) {
				solve(body, other, point, *found, side, is_fresh);
				++contacts;
			}
		}
	}
	return contacts;
}

namespace {

// Up to PACK_WIDTH points out of a bit mask, taken from it.
struct PointPack {
	PointPack(std::span<const Vec2> points, std::uint32_t first, std::uint32_t &mask) {
		for (; mask != 0 && count < PACK_WIDTH; mask &= mask - 1) {
			index[count++] = first + std::uint32_t(std::countr_zero(mask));
		}
		std::fill(index.begin() + std::ptrdiff_t(count), index.end(), index[0]);
		places = gather<const Vec2>({ &points[index[0]], &points[index[1]], &points[index[2]], &points[index[3]] }, 0);
	}

	std::size_t count = 0;
	std::array<std::uint32_t, PACK_WIDTH> index; ///< beyond the count, that of the first
	BasicVec2<RealPack> places;
};

// Whether a point is on the outer side of an edge, or came in there by the direction out of its own body.
bool may_leave_through(std::size_t edge, std::span<const Vec2> hull, std::span<const Vec2> points, std::size_t point) {
	const Vec2 way = hull[edge + 1 == hull.size() ? 0 : edge + 1] - hull[edge];
	return !(cross(way, points[point] - hull[edge]) > 0) || cross(outward_at(points, point), way) < 0;
}

} // namespace

// Adds the points of `body` that were inside `other` or nearer than the margin when the substep began: contacts push
// hulls about within a substep, and between the starts of two substeps they are seen to have moved little.
void PairContactSolver::list_candidates(const SolverBody &body, const SolverBody &other, Real margin, PairCandidates &candidates) {
	const std::span<const Vec2> points = body.before;
	const Aabb reach = other.box.grown(margin);
	edges_of_ = nullptr; // `edges_` may become the hull at the start of the substep
	bool has_edges = false;
	for (std::uint32_t first = 0; first < points.size(); first += POINT_BITS) {
		std::uint32_t mask = points_in(reach, points, first);
		if (mask != 0 && !has_edges) {
			near_edges_.assign(other.before, body.box.grown(margin));
			has_edges = true;
		}
		while (mask != 0) {
			const PointPack pack(points, first, mask);
			const NearestEdge nearest = near_edges_.find(pack.places);
			const std::uint32_t near = bits(nearest.distance < RealPack(margin * margin));
			// A point inside the hull, far from its edges, is in the circle around the hull.
			const RealPack from_center = length_squared(pack.places - in_all_lanes<RealPack>(other.center));
			const std::uint32_t deep = bits(from_center < RealPack(other.radius * other.radius));
			for (std::uint32_t left = (near | deep) & ((1u << pack.count) - 1); left != 0; left &= left - 1) {
				const std::size_t lane = std::size_t(std::countr_zero(left));
				const std::uint32_t point = pack.index[lane];
				std::optional<std::uint32_t> edge;
				if ((near >> lane & 1) != 0) {
					edge = std::uint32_t(nearest.edge[lane]);
				}
				if (!edge || !may_leave_through(*edge, other.before, points, point)) {
					edge = way_out(body, other, point, edge);
				}
				if (edge) {
					candidates.add({ std::uint16_t(point), std::uint16_t(*edge) });
				}
			}
		}
	}
}

// Edge of the hull at the start of the substep through which a point inside it leaves; `nearest` for one outside.
std::optional<std::uint32_t> PairContactSolver::way_out(const SolverBody &body, const SolverBody &other, std::uint32_t point,
		std::optional<std::uint32_t> nearest) {
	const Vec2 p = body.before[point];
	edges_.assign(other.before);
	if (!edges_.contains(p)) {
		return nearest;
	}
	const std::optional<HullContact> contact = edges_.find(p, outward_at(body.before, point));
	return contact ? contact->edge : nearest;
}

std::size_t PairContactSolver::handle_candidates(SolverBody &a, SolverBody &b, PairCandidates &candidates) {
	std::size_t contacts = 0;
	edges_of_ = nullptr;
	for (PairCandidate &candidate : candidates.of_first()) {
		contacts += handle_candidate(a, b, candidate, 1);
	}
	for (PairCandidate &candidate : candidates.of_second()) {
		contacts += handle_candidate(b, a, candidate, -1);
	}
	return contacts;
}

bool PairContactSolver::handle_candidate(SolverBody &body, SolverBody &other, PairCandidate &candidate, Real side) {
	HullContact contact;
	contact.edge = candidate.edge;
	const Vec2 p = body.positions[candidate.point];
	const Followed followed = follow_contact(other.hull(), p, contact);
	candidate.edge = std::uint16_t(contact.edge);
	if (followed == Followed::APART) {
		return false;
	}
	if (followed == Followed::LOST) {
		read_edges(other);
		const std::optional<HullContact> found = edges_.find(p, outward_at(body.hull(), candidate.point));
		if (!found) {
			return false;
		}
		contact = *found;
		candidate.edge = std::uint16_t(contact.edge);
	}
	solve(body, other, candidate.point, contact, side, false);
	return true;
}

void PairContactSolver::read_edges(const SolverBody &body) {
	if (edges_of_ != &body) {
		edges_.assign(body.hull());
		edges_of_ = &body;
	}
}

void PairContactSolver::solve(SolverBody &body, SolverBody &other, std::uint32_t point, const HullContact &contact, Real side,
		bool is_fresh) {
	const std::uint32_t end = contact.edge + 1 == other.before.size() ? 0 : contact.edge + 1;
	edges_of_ = nullptr; // both hulls change
	const Real impulse = solve_pair_contact(body, other,
			{ point, contact.edge, end, contact.t, contact.normal, contact.depth, is_fresh }, h_);
	impulse_ += impulse;
	push_ += contact.normal * (impulse * side);
	if (body.is_monitored || other.is_monitored) {
		log_.add({ body.body_index, ContactOther::Kind::SOFT_BODY, other.body_index, point, point, contact.t < Real(0.5) ? contact.edge : end,
				body.positions[point], contact.normal, impulse, contact.depth });
	}
}

} // namespace softbody
