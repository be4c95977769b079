// SPDX-License-Identifier: MIT
// An elastic solid inside an outline, made of square cells: linear finite elements without a mesh of triangles.
#pragma once

#include "core/base/vec2.h"
#include "core/geometry/holed_polygon.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace softbody {

/// Plane-strain solid of unit shear modulus and unit mass that fills an outline with bilinear square cells. A cell that
/// the outline cuts counts by its share inside (finite cell method, Parvizian, Düster and Rank 2007). Shear is
/// integrated at four points, volume change at one, so that nearly incompressible material does not lock. Allocates: for
/// the creation of bodies only.
class LatticeSolid {
public:
	/// A point's place in the lattice: its displacement is the weighted mean of four nodes' displacements.
	struct Embedding {
		std::array<std::uint32_t, 4> nodes{};
		std::array<double, 4> weights{};
	};

	/// About `cells` cells, more where the outline is thin. Nothing is inside of the holes. Preconditions: `hull` passes `check_hull`, with
	/// positive area, and `holes` pass `check_holes`.
	LatticeSolid(std::span<const Vec2> hull, std::size_t cells, const Holes &holes = {});

	std::span<const double> node_masses() const { return masses_; } ///< they sum to 1
	double cell_size() const { return cell_; } ///< [length]
	Vec2 node_position(std::size_t node) const {
		return corner_ + Vec2{ Real(cell_ * places_[node][0]), Real(cell_ * places_[node][1]) };
	}
	/// The place of a point inside the outline or beside it.
	Embedding embed(Vec2 point) const;

	/// Factors the stiffness matrix for a Poisson's ratio, 0 <= ν < 0.5, with a faint spring to the ground. O(nodes ·
	/// bandwidth²).
	void factor(double poisson_ratio);
	/// Replaces each of several loads, one vector a node, by the displacements that it causes. Precondition: `factor`
	/// was called.
	void solve(std::vector<std::vector<Vec2d>> &loads) const;

private:
	/// The nodes of a cell that is not empty, in the order (0,0), (1,0), (1,1), (0,1).
	std::array<std::uint32_t, 4> corners_of(std::size_t cell) const {
		const std::size_t i = cell / rows_;
		const std::size_t j = cell % rows_;
		return { node_at(i, j), node_at(i + 1, j), node_at(i + 1, j + 1), node_at(i, j + 1) };
	}
	std::uint32_t node_at(std::size_t column, std::size_t row) const { return nodes_[column * (rows_ + 1) + row]; }
	std::size_t cells_between(double from, double to) const;
	void measure_fill(std::span<const Vec2> hull, const Holes &holes);
	/// Adds the part of each cell that is inside of an outline, times `sign`.
	void add_fill(std::span<const Vec2> outline, double sign);
	void number_nodes();

	Vec2 corner_;
	double cell_ = 0; ///< edge of a cell [length]
	double ground_ = 0; ///< stiffness of the spring to the ground, over a cell's own
	bool transposed_ = false; ///< columns along y, so that the band stays narrow
	std::size_t columns_ = 0;
	std::size_t rows_ = 0;
	std::vector<double> fill_; ///< of each cell, column by column [1]
	std::vector<std::uint32_t> nodes_; ///< number of each lattice node, or NONE
	std::vector<std::array<std::uint32_t, 2>> places_; ///< of each numbered node: along x, along y
	std::vector<double> masses_;
	std::size_t band_ = 0; ///< entries of a row left of the diagonal
	std::vector<double> factor_; ///< lower triangle by rows, band_ + 1 entries each
};

} // namespace softbody
