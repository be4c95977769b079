// SPDX-License-Identifier: MIT
// The immutable part of a body: its points at rest, masses, hull and springs.
#pragma once

#include "core/base/error.h"
#include "core/base/vec2.h"
#include "core/model/chain.h"
#include "core/model/elastic_modes.h"
#include "core/model/elastic_triangles.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace softbody {

/// Spring between the points `a` and `b` of one body (thesis 4.4.2, "Spring2D"). It pulls with k(|d| - l) along the
/// line between the points and damps only the rate of length change, so it neither turns the body nor resists its
/// rotation (thesis eq. 3.12 and 3.16, corrected).
struct Spring2D {
	std::uint32_t a = 0; ///< point index
	std::uint32_t b = 0; ///< point index, != a
	Real rest_length = 0; ///< l [length], > 0
	Real stiffness = 0; ///< k [force/length], >= 0
	Real damping = 0; ///< c [force·s/length], >= 0
};

/// Immutable structure of a soft body. Like bodies share one through `std::shared_ptr`; changing a spring means making
/// another shape.
///
/// Points [0, hull_count) are the hull in order, wound so that its signed area is positive; inner points follow. Rest
/// positions are stored relative to the center of mass.
class SoftBodyShape {
public:
	/// Input of `create`. `points` may lie anywhere; `masses` has one entry a point.
	struct Description {
		std::vector<Vec2> points; ///< rest positions [length], hull first
		std::vector<Real> masses; ///< [mass], each > 0
		std::size_t hull_count = 0; ///< 3..points.size()
		std::vector<Spring2D> springs;
		/// Modes for exactly these points and mass shares; null: none.
		std::shared_ptr<const ElasticModes> modes = nullptr;
		/// Triangles with these points as corners; null: none. A shape has modes, triangles or neither.
		std::shared_ptr<const ElasticTriangles> triangles = nullptr;
		/// Sections that make the body an open chain (see `create_rope`); empty: none. Then there are no springs, modes or triangles.
		std::vector<ChainSection> chain = {};
	};

	/// Checks everything and builds the shape. Refuses a bad hull (see `check_hull`) or one of negative winding; sizes
	/// that do not match; non-finite points; masses <= 0; springs with an index out of range, coinciding ends, an
	/// earlier spring's ends, a rest length not > 0, or a negative or non-finite value; modes of another number of
	/// points; triangles beside modes, with corners out of range or without area; a chain that `ChainShape::check` refuses or beside
	/// springs, modes or triangles; and derived values out of range. O(points² + springs).
	static Result<std::shared_ptr<const SoftBodyShape>> create(Description description);

	std::span<const Vec2> rest_positions() const { return rest_positions_; }
	std::span<const Vec2> rest_hull() const { return { rest_positions_.data(), hull_count_ }; }
	std::span<const Real> masses() const { return masses_; }
	std::span<const Real> inverse_masses() const { return inverse_masses_; } ///< [1/mass]
	std::span<const Spring2D> springs() const { return springs_; }
	/// The body's elastic modes, or null (BodySettings::shear_modulus).
	const ElasticModes *modes() const { return modes_.get(); }
	/// Finite elements of an elastic solid that fill the hull, or null (BodySettings::shear_modulus).
	const ElasticTriangles *triangles() const { return triangles_.get(); }
	/// The body as an open chain, or null.
	const ChainShape *chain() const { return chain_ ? &*chain_ : nullptr; }
	std::size_t point_count() const { return rest_positions_.size(); }
	std::size_t hull_count() const { return hull_count_; }

	/// Center of mass in the coordinates of the description [length].
	Vec2 origin_offset() const { return origin_offset_; }
	Real total_mass() const { return total_mass_; }
	Real rest_area() const { return rest_area_; } ///< area inside the hull at rest [length²], > 0
	Real rest_inertia() const { return rest_inertia_; } ///< about the center of mass [mass·length²]
	/// Rough width of the thinner part: twice the rest area over the hull's perimeter [length]. A disk's is its radius.
	Real width() const { return width_; }
	Real radius() const { return radius_; } ///< largest distance of a point from the center of mass

	/// Upper bound of the highest squared angular frequency of the springs [1/s²] in any configuration. The Hessian of
	/// one spring has eigenvalues k and k(1 - l/|x|) <= k, so the graph Laplacian of the stiffnesses over the masses
	/// bounds the whole, and its signless twin (D_i x_i + sum of k x_j) / m_i bounds that: by its largest quotient for
	/// any positive vector x (Collatz and Wielandt). A few power iterations choose x.
	Real spring_frequency_squared() const { return spring_frequency_squared_; }
	/// Upper bound of the springs' damping rate [1/s]: as `spring_frequency_squared`, over damping coefficients.
	Real spring_damping_rate() const { return spring_damping_rate_; }
	/// Highest squared angular frequency of the springs [1/s²] and their highest damping rate [1/s] at rest, where they
	/// point in different directions: by power iteration, which may miss the last percent. At most the bounds above.
	Real rest_spring_frequency_squared() const { return rest_spring_frequency_squared_; }
	Real rest_spring_damping_rate() const { return rest_spring_damping_rate_; }

	/// Upper bound of the highest squared angular frequency of the triangles' resistance to shear, over the shear
	/// modulus [1/mass]; 0 without triangles. Its Hessian is equal in every configuration (see `add_triangle_forces`).
	/// The norms of its 2 x 2 blocks are a non-negative matrix, bounded as for `spring_frequency_squared`.
	Real triangle_shear_inverse_mass() const { return triangle_shear_inverse_mass_; }
	/// Upper bound for the triangles' resistance to a change of area at rest, over the bulk modulus [1/mass].
	Real triangle_dilation_inverse_mass() const { return triangle_dilation_inverse_mass_; }

	/// Sum over the hull of |∂A/∂x_i|²/m_i at rest [length²/mass], for the pressure's frequency bound.
	Real area_inverse_mass() const { return area_inverse_mass_; }
	Real least_hull_mass() const { return least_hull_mass_; } ///< [mass]
	Real shortest_hull_edge() const { return shortest_hull_edge_; } ///< at rest [length], > 0
	/// Whether a spring pulls or pushes in the rest shape (SLACK_SPRING), so that the body takes another shape by itself.
	bool is_tense() const { return is_tense_; }
	/// How far the round outline at rest bulges out from the middle of each hull edge [length], see `edge_bulges`. Empty
	/// if all edges are straight.
	std::span<const Real> bulges() const { return bulges_; }
	Real greatest_bulge() const { return greatest_bulge_; } ///< [length]

	/// Copy in which all lengths are `factor` times as large, and masses are scaled so that they sum to `total_mass`. Refuses
	/// values not > 0. An elastic model is carried over, which is exact (see `ElasticModes`) and takes no time.
	Result<std::shared_ptr<const SoftBodyShape>> resized(Real factor, Real total_mass) const;

	/// Lets the points of a copy of `first` rest at `places`, relative to the center of mass, as after plastic flow. Springs keep the
	/// ratio of their rest length to the distance of their ends; modes keep their shapes and stiffness. Bounds of frequencies stay
	/// those of before, until `renew_bounds`. Precondition: a hull that `is_folded` does not call folded. O(points · modes + springs).
	void move_rest(std::span<const Vec2> places, const SoftBodyShape &first);
	/// Finds the bounds of frequencies anew. O(springs).
	void renew_bounds();

private:
	SoftBodyShape() = default;
	void enlarge(Real factor);
	Status derive();
	void measure();
	Status check_derived() const;
	double largest_rate(Real Spring2D::*coefficient) const;
	double rest_rate(Real Spring2D::*coefficient) const;
	std::array<double, 2> largest_triangle_inverse_masses() const;
	template <class Apply>
	double largest_eigenvalue(const Apply &apply) const;

	std::vector<Vec2> rest_positions_;
	std::vector<Real> masses_;
	std::vector<Real> inverse_masses_;
	std::vector<Spring2D> springs_;
	std::shared_ptr<const ElasticModes> modes_;
	std::shared_ptr<const ElasticTriangles> triangles_;
	std::optional<ChainShape> chain_;
	std::size_t hull_count_ = 0;
	Vec2 origin_offset_;
	Real total_mass_ = 0;
	Real rest_area_ = 0;
	Real rest_inertia_ = 0;
	Real radius_ = 0;
	Real width_ = 0;
	Real spring_frequency_squared_ = 0;
	Real spring_damping_rate_ = 0;
	Real rest_spring_frequency_squared_ = 0;
	Real rest_spring_damping_rate_ = 0;
	Real triangle_shear_inverse_mass_ = 0;
	Real triangle_dilation_inverse_mass_ = 0;
	Real area_inverse_mass_ = 0;
	Real least_hull_mass_ = 0;
	Real shortest_hull_edge_ = 0;
	std::vector<Real> bulges_;
	Real greatest_bulge_ = 0;
	bool is_tense_ = false;
};

} // namespace softbody
