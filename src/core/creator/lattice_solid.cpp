// SPDX-License-Identifier: MIT
// An elastic solid inside an outline, made of square cells.
#include "core/creator/lattice_solid.h"

#include "core/geometry/polygon.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace softbody {

namespace {

constexpr std::uint32_t NONE = UINT32_MAX;

// Least fill of a cell, which keeps the stiffness matrix regular. Larger: outlines along the lattice get a skin.
constexpr double LEAST_FILL = 0.01;

// Fill from which on a cell may hold points, and the extra distance in cells of a point for what a cell lacks of it.
constexpr double WELL_FILLED = 0.4;
constexpr double EMPTINESS = 2.5;

// Cells across the outline's width: a beam of four bilinear cells is 3 % too stiff.
constexpr double CELLS_ACROSS = 4;
constexpr double MOST_CELLS = 1200;
// The same with holes: walls bend, and a cell that is cut counts with its middle, which makes four of them 12 % too stiff.
constexpr double CELLS_ACROSS_WALL = 6;
constexpr double MOST_WALL_CELLS = 2400;
// Wall that needs cells as small as a hole does, over the hole's radius.
constexpr double HOLE_RADIUS_OVER_WALL = 1.5;
constexpr std::size_t MOST_LATTICE = 40000;

// Sine of the angle by which a corner has to turn inwards to get a node of the lattice.
constexpr double INWARD_CORNER = 0.5;

// Stiffness of the spring to the ground, over a cell's own.
constexpr double GROUND = 1e-5;
// The same with holes: a thin ring resists less than that.
constexpr double HOLED_GROUND = 1e-9;

// Clips by one axis-parallel line (Sutherland and Hodgman). Edges along the line cancel in the area.
void clip(const std::vector<Vec2d> &from, double Vec2d::*axis, double bound, double sign, std::vector<Vec2d> &to) {
	to.clear();
	for (std::size_t i = 0; i < from.size(); ++i) {
		const Vec2d &a = from[i];
		const Vec2d &b = from[i + 1 == from.size() ? 0 : i + 1];
		const double da = sign * (a.*axis - bound);
		const double db = sign * (b.*axis - bound);
		if (da >= 0) {
			to.push_back(a);
		}
		if ((da > 0 && db < 0) || (da < 0 && db > 0)) {
			const double t = da / (da - db);
			to.push_back(a + (b - a) * t);
		}
	}
}

double area_of(const std::vector<Vec2d> &polygon) {
	double twice = 0;
	for (std::size_t i = 0; i < polygon.size(); ++i) {
		twice += cross(polygon[i] - polygon[0], polygon[i + 1 == polygon.size() ? 0 : i + 1] - polygon[0]);
	}
	return twice / 2;
}

using CellMatrix = std::array<std::array<double, 8>, 8>;

// Corners of a cell in the order (0,0), (1,0), (1,1), (0,1).
constexpr std::array<Vec2d, 4> CORNERS = { { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } } };

// Adds weight·(λ div² + 2μ ε:ε) at one place of the unit cell. In two dimensions stiffness does not depend on the cell's size.
void add_at(CellMatrix &matrix, double x, double y, double shear, double volume) {
	std::array<double, 4> dx;
	std::array<double, 4> dy;
	for (std::size_t c = 0; c < 4; ++c) {
		const double sx = 2 * CORNERS[c].x - 1;
		const double sy = 2 * CORNERS[c].y - 1;
		dx[c] = sx * (CORNERS[c].y == 0 ? 1 - y : y);
		dy[c] = sy * (CORNERS[c].x == 0 ? 1 - x : x);
	}
	for (std::size_t a = 0; a < 4; ++a) {
		for (std::size_t b = 0; b < 4; ++b) {
			matrix[2 * a][2 * b] += shear * (2 * dx[a] * dx[b] + dy[a] * dy[b]) + volume * dx[a] * dx[b];
			matrix[2 * a][2 * b + 1] += shear * dy[a] * dx[b] + volume * dx[a] * dy[b];
			matrix[2 * a + 1][2 * b] += shear * dx[a] * dy[b] + volume * dy[a] * dx[b];
			matrix[2 * a + 1][2 * b + 1] += shear * (2 * dy[a] * dy[b] + dx[a] * dx[b]) + volume * dy[a] * dy[b];
		}
	}
}

CellMatrix cell_matrix(double poisson_ratio) {
	CellMatrix matrix{};
	const double offset = std::sqrt(1.0 / 12);
	for (const double x : { 0.5 - offset, 0.5 + offset }) {
		for (const double y : { 0.5 - offset, 0.5 + offset }) {
			add_at(matrix, x, y, 0.25, 0);
		}
	}
	add_at(matrix, 0.5, 0.5, 0, 2 * poisson_ratio / (1 - 2 * poisson_ratio)); // λ/μ in plane strain
	return matrix;
}

// The hull point at which the outline turns inwards most, if by more than INWARD_CORNER.
std::optional<std::size_t> sharpest_inward_corner(std::span<const Vec2> hull) {
	std::optional<std::size_t> sharpest;
	double least = -INWARD_CORNER;
	for (std::size_t i = 0; i < hull.size(); ++i) {
		const Vec2 in = hull[i] - hull[i == 0 ? hull.size() - 1 : i - 1];
		const Vec2 out = hull[i + 1 == hull.size() ? 0 : i + 1] - hull[i];
		const double size = double(length(in)) * double(length(out));
		// Beyond a right angle the sine falls again, but the cosine does not.
		const double sine = size > 0 ? double(cross(in, out)) / size : 0.0;
		const double turn = sine < 0 && dot(in, out) < 0 ? sine - 2 * (1 + sine) : sine;
		if (turn < least) {
			least = turn;
			sharpest = i;
		}
	}
	return sharpest;
}

} // namespace

LatticeSolid::LatticeSolid(std::span<const Vec2> hull, std::size_t cells, const Holes &holes) {
	const auto [low, high] = bounding_box(hull);
	const double width = double(high.x) - low.x;
	const double height = double(high.y) - low.y;
	transposed_ = height > width;
	const double along = transposed_ ? height : width;
	const double across = transposed_ ? width : height;

	const double area = holes.empty() ? double(signed_area(hull)) : area_moments(hull, holes).area;
	double thickness = 2 * area / (holes.empty() ? double(perimeter(hull)) : holed_perimeter(hull, holes));
	for (const std::vector<Vec2> &hole : holes) { // the solid gives way beside a hole within the hole's radius
		thickness = std::min(thickness, HOLE_RADIUS_OVER_WALL * 2 * std::abs(double(signed_area(hole))) / double(perimeter(hole)));
	}
	ground_ = holes.empty() ? GROUND : HOLED_GROUND;
	cell_ = std::min(std::sqrt(area / double(cells)), thickness / (holes.empty() ? CELLS_ACROSS : CELLS_ACROSS_WALL));
	cell_ = std::max({ cell_, std::sqrt(area / (holes.empty() ? MOST_CELLS : MOST_WALL_CELLS)), std::sqrt(along * across / double(MOST_LATTICE)),
			along / double(MOST_LATTICE / 8) });
	columns_ = cells_between(0, along);
	rows_ = cells_between(0, across);
	// Symmetric about the middle of the outline's box, as the outline may be.
	double left = low.x - (double(transposed_ ? rows_ : columns_) * cell_ - width) / 2;
	double top = low.y - (double(transposed_ ? columns_ : rows_) * cell_ - height) / 2;
	// A cell over a corner that points inwards would bridge it; the sharpest such corner gets a node.
	if (const std::optional<std::size_t> corner = sharpest_inward_corner(hull)) {
		left = hull[*corner].x - std::ceil((double(hull[*corner].x) - low.x) / cell_ - 1e-6) * cell_;
		top = hull[*corner].y - std::ceil((double(hull[*corner].y) - low.y) / cell_ - 1e-6) * cell_;
		columns_ = cells_between(transposed_ ? top : left, transposed_ ? high.y : high.x);
		rows_ = cells_between(transposed_ ? left : top, transposed_ ? high.x : high.y);
	}
	corner_ = { Real(left), Real(top) };
	measure_fill(hull, holes);
	number_nodes();
}

std::size_t LatticeSolid::cells_between(double from, double to) const {
	return std::max<std::size_t>(1, std::size_t(std::ceil((to - from) / cell_ - 1e-6)));
}

void LatticeSolid::measure_fill(std::span<const Vec2> hull, const Holes &holes) {
	fill_.assign(columns_ * rows_, 0);
	add_fill(hull, 1);
	for (const std::vector<Vec2> &hole : holes) {
		add_fill(hole, -1);
	}
	for (double &share : fill_) {
		share = share > 1e-9 ? std::min(share, 1.0) : 0.0;
	}
}

void LatticeSolid::add_fill(std::span<const Vec2> polygon, double sign) {
	// In units of a cell, columns along x. A transposed outline is turned over rather than mirrored: only the sign of
	// areas changes.
	std::vector<Vec2d> outline;
	for (const Vec2 p : polygon) {
		const double x = (double(p.x) - corner_.x) / cell_;
		const double y = (double(p.y) - corner_.y) / cell_;
		outline.push_back(transposed_ ? Vec2d{ y, x } : Vec2d{ x, y });
	}
	std::vector<Vec2d> left;
	std::vector<Vec2d> column;
	std::vector<Vec2d> below;
	std::vector<Vec2d> cell;
	for (std::size_t i = 0; i < columns_; ++i) {
		clip(outline, &Vec2d::x, double(i), 1, left);
		clip(left, &Vec2d::x, double(i + 1), -1, column);
		for (std::size_t j = 0; j < rows_ && !column.empty(); ++j) {
			clip(column, &Vec2d::y, double(j), 1, below);
			clip(below, &Vec2d::y, double(j + 1), -1, cell);
			fill_[i * rows_ + j] += sign * std::abs(area_of(cell));
		}
	}
}

void LatticeSolid::number_nodes() {
	nodes_.assign((columns_ + 1) * (rows_ + 1), NONE);
	std::uint32_t count = 0;
	for (std::size_t i = 0; i <= columns_; ++i) {
		for (std::size_t j = 0; j <= rows_; ++j) {
			for (const auto &[di, dj] : { std::pair{ 0, 0 }, { 1, 0 }, { 0, 1 }, { 1, 1 } }) {
				const bool is_cell = i >= std::size_t(di) && j >= std::size_t(dj) && i - di < columns_ && j - dj < rows_;
				if (is_cell && fill_[(i - di) * rows_ + (j - dj)] > 0 && nodes_[i * (rows_ + 1) + j] == NONE) {
					nodes_[i * (rows_ + 1) + j] = count++;
					places_.push_back({ std::uint32_t(transposed_ ? j : i), std::uint32_t(transposed_ ? i : j) });
				}
			}
		}
	}
	masses_.assign(count, 0);
	band_ = 0;
	double total = 0;
	for (std::size_t cell = 0; cell < fill_.size(); ++cell) {
		if (fill_[cell] > 0) {
			const std::array<std::uint32_t, 4> corners = corners_of(cell);
			band_ = std::max<std::size_t>(band_, 2 * (corners[2] - corners[0]) + 1);
			for (const std::uint32_t node : corners) {
				masses_[node] += fill_[cell] / 4;
			}
			total += fill_[cell];
		}
	}
	for (double &mass : masses_) {
		mass /= total;
	}
}

LatticeSolid::Embedding LatticeSolid::embed(Vec2 point) const {
	double x = (double(point.x) - corner_.x) / cell_;
	double y = (double(point.y) - corner_.y) / cell_;
	if (transposed_) {
		std::swap(x, y);
	}
	// The nearest cell of the solid: among the cells around the point, or, far outside, among all.
	std::size_t best = fill_.size();
	double least = 0;
	const auto look_at = [&](std::size_t cell) {
		const double dx = std::abs(x - (double(cell / rows_) + 0.5));
		const double dy = std::abs(y - (double(cell % rows_) + 0.5));
		// A point in a corner of the outline that a nearly empty cell holds is assigned to the fuller cell beside it.
		const double distance = std::max(dx, dy) + std::max(0.0, WELL_FILLED - fill_[cell]) * EMPTINESS - 1e-3 * fill_[cell];
		if (fill_[cell] > 0 && (best == fill_.size() || distance < least)) {
			least = distance;
			best = cell;
		}
	};
	const std::ptrdiff_t column = std::ptrdiff_t(std::floor(x));
	const std::ptrdiff_t row = std::ptrdiff_t(std::floor(y));
	for (std::ptrdiff_t i = column - 1; i <= column + 1; ++i) {
		for (std::ptrdiff_t j = row - 1; j <= row + 1; ++j) {
			if (i >= 0 && j >= 0 && i < std::ptrdiff_t(columns_) && j < std::ptrdiff_t(rows_)) {
				look_at(std::size_t(i) * rows_ + std::size_t(j));
			}
		}
	}
	if (best == fill_.size()) {
		for (std::size_t cell = 0; cell < fill_.size(); ++cell) {
			look_at(cell);
		}
	}
	const double u = x - double(best / rows_);
	const double v = y - double(best % rows_);
	return { corners_of(best), { (1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v } };
}

// Cholesky factor of a banded matrix.
void LatticeSolid::factor(double poisson_ratio) {
	const std::size_t count = 2 * masses_.size();
	const std::size_t width = band_ + 1;
	factor_.assign(count * width, 0);
	const auto entry = [&](std::size_t row, std::size_t column) -> double & { return factor_[row * width + band_ + column - row]; };
	const CellMatrix matrix = cell_matrix(poisson_ratio);
	for (std::size_t cell = 0; cell < fill_.size(); ++cell) {
		if (fill_[cell] <= 0) {
			continue;
		}
		const double weight = std::max(fill_[cell], LEAST_FILL);
		const std::array<std::uint32_t, 4> corners = corners_of(cell);
		for (std::size_t a = 0; a < 8; ++a) {
			for (std::size_t b = 0; b < 8; ++b) {
				// A transposed lattice has its axes swapped; an isotropic solid is unaffected.
				const std::size_t row = 2 * corners[a / 2] + (transposed_ ? 1 - a % 2 : a % 2);
				const std::size_t column = 2 * corners[b / 2] + (transposed_ ? 1 - b % 2 : b % 2);
				if (column <= row) {
					entry(row, column) += weight * matrix[a][b];
				}
			}
		}
	}
	const double ground = ground_ * double(masses_.size());
	for (std::size_t k = 0; k < count; ++k) {
		entry(k, k) += ground * masses_[k / 2];
	}
	// Column by column: compilers can vectorize several entries of a row.
	std::vector<double> column(width);
	for (std::size_t k = 0; k < count; ++k) {
		const double pivot = std::sqrt(std::max(entry(k, k), 1e-12));
		entry(k, k) = pivot;
		const std::size_t end = std::min(count, k + width);
		for (std::size_t row = k + 1; row < end; ++row) {
			entry(row, k) /= pivot;
			column[row - k] = entry(row, k);
		}
		for (std::size_t row = k + 1; row < end; ++row) {
			const double factor = column[row - k];
			double *target = &entry(row, k + 1);
			for (std::size_t j = 1; j <= row - k; ++j) {
				target[j - 1] -= factor * column[j];
			}
		}
	}
}

// Entry k of load c lies at [k * loads.size() + c], so that all loads are solved in one pass over the factor.
void LatticeSolid::solve(std::vector<std::vector<Vec2d>> &loads) const {
	const std::size_t count = 2 * masses_.size();
	const std::size_t width = band_ + 1;
	const std::size_t loads_count = loads.size();
	std::vector<double> all(count * loads_count);
	const auto row_of = [&](std::size_t row) { return &all[row * loads_count]; };
	const auto take = [&](std::size_t to, std::size_t from, double factor) {
		for (std::size_t c = 0; c < loads_count; ++c) {
			row_of(to)[c] -= factor * row_of(from)[c];
		}
	};
	const auto divide_by_pivot = [&](std::size_t row) {
		const double inverse = 1 / factor_[row * width + band_];
		for (std::size_t c = 0; c < loads_count; ++c) {
			row_of(row)[c] *= inverse;
		}
	};
	const auto entry = [&](std::size_t row, std::size_t column) { return factor_[row * width + band_ + column - row]; };
	for (std::size_t k = 0; k < count; ++k) {
		for (std::size_t c = 0; c < loads_count; ++c) {
			row_of(k)[c] = k % 2 == 0 ? loads[c][k / 2].x : loads[c][k / 2].y;
		}
	}
	for (std::size_t row = 0; row < count; ++row) {
		for (std::size_t k = row > band_ ? row - band_ : 0; k < row; ++k) {
			take(row, k, entry(row, k));
		}
		divide_by_pivot(row);
	}
	for (std::size_t row = count; row-- > 0;) {
		divide_by_pivot(row);
		for (std::size_t k = row > band_ ? row - band_ : 0; k < row; ++k) {
			take(k, row, entry(row, k));
		}
	}
	for (std::size_t k = 0; k < count; ++k) {
		for (std::size_t c = 0; c < loads_count; ++c) {
			(k % 2 == 0 ? loads[c][k / 2].x : loads[c][k / 2].y) = row_of(k)[c];
		}
	}
}

} // namespace softbody
