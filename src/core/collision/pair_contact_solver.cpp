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

// Path of both bodies for which candidates are listed in this substep [length]; 0 if a list would not pay.
Real path_ahead(const SolverBody &a, const SolverBody &b, int substeps_left) {
	const Real way = a.way + b.way;
	const Real wanted = FASTER * way * Real(substeps_left + 1) + LEAST_PATH * std::min(a.rest_radius, b.rest_radius);
	const Real most = SWEEP_SHARE * std::min(a.width, b.width);
	return substeps_left > 0 && most > 2 * FASTER * way ? std::min(wanted, most) : Real(0);
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
	const Real margin = path_ahead(a, b, substeps_left);
	const Real reach = a.radius + b.radius + margin;
	const Real distance_squared = length_squared(a.center - b.center);
	std::size_t contacts = 0;
	if (a.box.grown(margin).overlaps(b.box) && distance_squared <= reach * reach) {
		const bool are_fast = way > SWEEP_SHARE * std::min(a.width, b.width);
		const Real near = std::max(a.radius, b.radius);
		if (!are_fast && distance_squared < near * near && handle_crossing(a, b)) {
			return 1;
		}
		contacts = handle_points(a, b, are_fast, margin, candidates);
	}
	if (margin > 0) {
		// What the contacts take back of the way of this substep counts once more in its path.
		candidates.hold_until(path - way + margin);
	}
	return contacts;
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

// One loop for the points of both bodies: processors mispredict the end of a loop.
std::size_t PairContactSolver::handle_points(SolverBody &a, SolverBody &b, bool are_fast, Real margin, PairCandidates &candidates) {
	const std::array<SolverBody *, 2> bodies = { &a, &b };
	constexpr std::array<Real, 2> SIDES = { 1, -1 };
	const Real reach_a = b.radius + (are_fast ? a.way : margin);
	const Real reach_b = a.radius + (are_fast ? b.way : margin);
	std::size_t contacts = 0;
	edges_of_ = nullptr;
	const std::uint32_t count = std::uint32_t(std::max(a.hull().size(), b.hull().size()));
	for (std::uint32_t first = 0; first < count; first += NEAR_BITS) {
		std::uint64_t near = near_points(a.hull(), first, b.center, reach_a) |
				std::uint64_t(near_points(b.hull(), first, a.center, reach_b)) << NEAR_BITS;
		for (; near != 0; near &= near - 1) {
			const std::uint32_t bit = std::uint32_t(std::countr_zero(near));
			const std::uint32_t which = bit / NEAR_BITS;
			const std::uint32_t point = first + bit % NEAR_BITS;
			SolverBody &body = *bodies[which];
			SolverBody &other = *bodies[1 - which];
			std::optional<HullContact> found = are_fast ? find_passage(body, other, point) : std::nullopt;
			const bool is_fresh = found.has_value();
			if (!found) {
				read_edges(other);
				found = edges_.find_near(body.positions[point], outward_at(body.hull(), point), margin);
			}
			if (!found) {
				continue;
			}
			if (margin > 0) {
				candidates.add({ std::uint16_t(point), std::uint8_t(which), std::uint16_t(found->edge) });
			}
			if (found->depth >= 0) {
				solve(body, other, point, *found, SIDES[which], is_fresh);
				++contacts;
			}
		}
	}
	return contacts;
}

std::size_t PairContactSolver::handle_candidates(SolverBody &a, SolverBody &b, PairCandidates &candidates) {
	std::size_t contacts = 0;
	edges_of_ = nullptr;
	for (PairCandidate &candidate : candidates.list()) {
		contacts += candidate.side == 0 ? handle_candidate(a, b, candidate, 1) : handle_candidate(b, a, candidate, -1);
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
