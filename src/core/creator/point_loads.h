// SPDX-License-Identifier: MIT
// Loads on the points of a body as loads on the nodes of the solid inside it, and displacements of the nodes as those of the
// points.
#pragma once

#include "core/base/vec2.h"
#include "core/creator/lattice_solid.h"
#include "core/creator/ritz.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace softbody {

/// A hull point acts on the solid along its two edges, an inner point on the part of the solid nearest to it.
class PointLoads {
public:
	/// `points` are the hull, then the inner points. `solid` must outlive the object.
	PointLoads(const LatticeSolid &solid, std::span<const Vec2> points, std::size_t hull_count);

	/// Share of the solid for which each hull point stands, summing to 1.
	const std::vector<double> &hull_shares() const { return hull_shares_; }
	/// Spreads loads on the points over the nodes.
	PointVector to_nodes(const PointVector &loads) const;
	/// Displacements of the points when the nodes move: the transpose of `to_nodes`.
	PointVector from_nodes(const PointVector &nodes) const;

private:
	void assign_shares();
	void smooth_shares();
	void assign_edges();
	void assign_regions();

	/// The nodes that an inner point stands for, with their center and inertia.
	struct Region {
		std::vector<std::uint32_t> nodes;
		double mass = 0;
		Vec2d center;
		double inertia = 0;
	};

	const LatticeSolid &solid_;
	std::vector<Vec2> points_;
	std::size_t hull_count_;
	/// For each hull point: the nodes along its two edges, by the weights with which they share its load.
	std::vector<std::vector<std::pair<std::uint32_t, double>>> edges_;
	std::vector<Region> regions_; ///< of each inner point
	std::vector<double> hull_shares_; ///< of each hull point
};

} // namespace softbody
