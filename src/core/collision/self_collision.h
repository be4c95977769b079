// SPDX-License-Identifier: MIT
// Contacts of a body with itself: its hull does not pass through itself, from outside or from inside.
#pragma once

#include "core/base/pack.h"
#include "core/base/vec2.h"
#include "core/geometry/polygon.h"
#include "core/model/soft_body_data.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace softbody {

/// Keeps a simple hull from crossing itself (`BodySettings::self_collision`). Every hull point is swept through all
/// moving edges that it is not an end of. So its original side is known: outside for two arms that close, inside for a
/// body that is pressed flat. Point and edge are moved apart by inverse mass, to SELF_GAP. They lose the part of their
/// approach that made the depth within the substep, with Coulomb friction. Momentum and angular momentum stay, unless
/// points are pinned.
///
/// Parts that still cross after a few passes over all contacts move as one rigid piece for this substep (an impact
/// zone: Provot 1997, Bridson, Fedkiw and Anderson 2002). So a simple hull stays simple under any pressure.
///
/// A hull that is crossed or inverted when the substep begins has no contacts with itself. Its points may then be on a
/// wrong side, and contacts would lock the crossing in.
///
/// One object serves one thread and owns nothing but scratch memory, which grows to the largest hull.
class SelfCollision {
public:
	/// Solves the contacts of a body whose hull moved from `before` (at least as many points) to its present positions
	/// in a substep of `h` [s]. Returns the number of contacts solved. O(hull points) for a hull that stays away from
	/// itself.
	std::size_t handle(SoftBodyData &body, std::span<const Vec2> before, Real h);

private:
	struct Contact {
		Real t = 0; ///< place on the edge, 0..1
		Vec2 normal; ///< unit, the direction in which the point must move
		Real depth = 0; ///< [length], >= 0
	};
	/// Boxes of PACK_WIDTH runs, or of as many packs of the level below.
	struct Boxes {
		BasicVec2<RealPack> min;
		BasicVec2<RealPack> max;
	};

	bool begin(const SoftBodyData &body, std::span<const Vec2> before);
	void end(SoftBodyData &body);
	std::uint32_t after(std::uint32_t i) const { return i + 1 == count_ ? 0 : i + 1; }

	// A run is PACK_WIDTH points of the hull in order, each with the edge that begins at it.
	std::uint32_t run_count() const { return (count_ + PACK_WIDTH - 1) / PACK_WIDTH; }
	Boxes edge_boxes(std::uint32_t run) const;
	void build_boxes();
	bool is_straight(std::uint32_t run, std::uint32_t next) const;
	template <class Visit>
	void visit_runs(const Aabb &box, std::size_t level, std::size_t pack, const Visit &visit) const;
	/// Calls `visit(a, b)`, a <= b, for all pairs of runs whose points may come within `gap` of edges.
	template <class Visit>
	void visit_run_pairs(Real gap, const Visit &visit) const;
	/// Calls `visit(point, edge)` for all pairs that may come within `gap` of each other.
	template <class Visit>
	void visit_candidates(Real gap, const Visit &visit) const;
	bool was_folded() const;

	std::optional<Contact> find_contact(std::uint32_t point, std::uint32_t edge, Real gap) const;
	std::optional<Contact> find_near_contact(std::uint32_t point, std::uint32_t edge, Real side, Real gap) const;
	Real side_of_chain(std::uint32_t point, std::uint32_t edge) const;
	void solve(SoftBodyData &body, std::uint32_t point, std::uint32_t edge, const Contact &contact, Real h);
	void hold_zones(SoftBodyData &body);
	void move_zone(SoftBodyData &body, std::uint32_t zone);

	// The hull before and after the substep, each relative to an origin that moves with it. Copies of the first point
	// fill the last run and one more entry.
	std::uint32_t count_ = 0; ///< hull points
	std::vector<Vec2> from_;
	std::vector<Vec2> to_;
	Vec2 origin_; ///< of `to_`, in the world
	Vec2 shift_; ///< from the origin of `from_`
	Real gap_ = 0; ///< [length]
	std::vector<char> is_moved_;
	std::vector<std::uint32_t> zones_; ///< of each hull point: the first point of its zone
	std::vector<char> is_joined_; ///< of each zone: joined in this round
	std::vector<Boxes> boxes_; ///< of runs and their paths, level by level
	std::array<std::size_t, 8> levels_{}; ///< first index of each level; the last level is a single pack
	std::size_t level_count_ = 0;
};

} // namespace softbody
