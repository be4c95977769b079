// SPDX-License-Identifier: MIT
// Cuts a soft body, as it is deformed, into smaller ones that go on where it was.
#pragma once

#include "core/base/error.h"
#include "core/base/vec2.h"
#include "core/creator/soft_body_creator.h"
#include "core/geometry/polygon_cut.h"
#include "core/model/soft_body_data.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace softbody {

/// Bounds of a cut.
struct BodyCutLimits {
	/// Least share of the area at rest that a piece has [1], 0..0.5. A part of the blade that would leave less cuts nothing.
	Real smallest_piece = Real(0.02);
	/// Least width of a piece at rest, twice its area over its perimeter [length], >= 0.
	Real least_width = 0;
	/// Most pieces [1], 1..MAX_CUT_PIECES.
	int most_pieces = 64;
};
inline constexpr int MAX_CUT_PIECES = 256;

/// Largest number of points of a blade.
inline constexpr std::size_t MAX_BLADE_POINTS = 4096;

/// What a piece is made of, before its body is made.
struct BodyPiece {
	std::vector<std::uint32_t> outline; ///< points of BodyCut::polygon, of positive area
	std::vector<std::uint32_t> inner_points; ///< entries of StructureOptions::inner_points of the whole
	std::vector<Vec2> hull; ///< the outline at rest, in the coordinates of the shape's description [length]
	/// Mass, inner points and painted factors of the piece. Springs that were given one by one are not carried over.
	StructureOptions options;
	double share = 1; ///< of the area at rest and of the mass [1]
	/// Pinned points: of the piece, and of the whole. A corner that the cut went through is pinned on both sides.
	std::vector<std::pair<std::uint32_t, std::uint32_t>> pins;
};

/// A cut that can be made. It has changed nothing yet.
struct BodyCut {
	PolygonCut polygon; ///< of the deformed hull; its twin is the hull at rest, in the coordinates of the description
	std::vector<BodyPiece> pieces; ///< the largest first; one alone if the blade cuts nothing
};

/// Cuts the body where the blade, in the world [length], hits its deformed hull. `options` are those that its shape was
/// made of. Points along a cut are as far apart as the hull's points are on average. Refuses, by name, limits out of
/// range, a blade of fewer than two or more than MAX_BLADE_POINTS points or with places that are not finite, a body that
/// is folded over itself, and a blade of which every part that would cut is refused by the limits. O(points² · pieces)
/// in the worst case; allocates.
Result<BodyCut> plan_cut(const SoftBodyData &body, const StructureOptions &options, std::span<const Vec2> blade,
		const BodyCutLimits &limits = {});

/// Puts the points of a piece where they were in the body, with their velocities, the places of the step before and dents,
/// and lets nothing dent or tear it for a while (`SoftBodyData::pause_damage`). Points
/// that the body had keep all of these to the bit; new ones are carried by the points around them. Precondition: the
/// piece's shape has its outline as hull, in this order, and then its inner points; further points may follow.
void place_piece(const SoftBodyData &body, const BodyCut &cut, std::size_t piece, SoftBodyData &placed);

/// Gives the pieces together the momentum and the angular momentum of the body, by one rigid motion of all of them. New
/// points, and masses divided anew, would change these a little. Pinned points stay; with them it is no promise.
void keep_momentum(const SoftBodyData &body, std::span<SoftBodyData *const> pieces);

/// The pieces as bodies with the settings of the whole, the largest first. Refuses what `SoftBodyCreator` refuses.
Result<std::vector<SoftBodyData>> make_pieces(const SoftBodyData &body, const BodyCut &cut);

/// All of it: the pieces as bodies with the settings of the whole, the largest first. Refuses like `plan_cut`, and what
/// `SoftBodyCreator` refuses. If the blade cuts nothing there is one body.
Result<std::vector<SoftBodyData>> cut_body(const SoftBodyData &body, const StructureOptions &options, std::span<const Vec2> blade,
		const BodyCutLimits &limits = {});

} // namespace softbody
