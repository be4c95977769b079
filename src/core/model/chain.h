// SPDX-License-Identifier: MIT
// The part of a shape that makes a body an open chain: cross-sections in a row.
#pragma once

#include "core/base/error.h"
#include "core/base/vec2.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace softbody {

/// A cross-section of an open chain (a rope, a strap): three points in a line across it. The chain moves each section as a thin
/// rigid bar at a right angle to the centerline.
struct ChainSection {
	std::uint32_t left = 0; ///< hull point
	std::uint32_t right = 0; ///< hull point
	std::uint32_t center = 0; ///< inner point on the centerline

	friend bool operator==(const ChainSection &, const ChainSection &) = default;
};

/// The sections of a chain from its first end to its last, and what follows from the points at rest. The part between two
/// neighboring sections is a link.
class ChainShape {
public:
	/// Section that holds no point.
	static constexpr std::uint32_t NO_SECTION = UINT32_MAX;

	ChainShape() = default;
	explicit ChainShape(std::vector<ChainSection> sections) : sections_(std::move(sections)) {}

	/// Refuses fewer than two sections, indices that are not of `hull_count` hull points or of inner points below `point_count`,
	/// and a point in two sections.
	Status check(std::size_t hull_count, std::size_t point_count) const;
	/// Measures lengths, widths, masses and curvature of the points at rest. Refuses links without length.
	Status measure(std::span<const Vec2> rest_positions, std::span<const Real> masses);

	std::size_t count() const { return sections_.size(); }
	std::span<const ChainSection> sections() const { return sections_; }
	/// Lengths of the links at rest [length], each > 0.
	std::span<const Real> lengths() const { return lengths_; }
	Real total_length() const { return total_length_; } ///< sum of those
	/// Half of the width of each section [length]; negative where `left` is on the other side of the centerline.
	std::span<const Real> half_widths() const { return half_widths_; }
	/// Width of each section, as a share of the greatest [1].
	std::span<const Real> width_shares() const { return width_shares_; }
	std::span<const Real> masses() const { return masses_; } ///< of the sections [mass]
	/// Curvature at rest of each inner section [1/length]: the change of the unit tangent over the length, in a frame whose x axis
	/// goes from the section before to the section after.
	std::span<const Vec2> curvatures() const { return curvatures_; }
	/// The section to which a point belongs; NO_SECTION for a point of none.
	std::uint32_t section_of(std::size_t point) const { return point < section_of_.size() ? section_of_[point] : NO_SECTION; }

private:
	std::vector<ChainSection> sections_;
	std::vector<std::uint32_t> section_of_; ///< by point
	std::vector<Real> lengths_;
	std::vector<Real> half_widths_;
	std::vector<Real> width_shares_;
	std::vector<Real> masses_;
	std::vector<Vec2> curvatures_;
	Real total_length_ = 0;
};

} // namespace softbody
