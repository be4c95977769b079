// SPDX-License-Identifier: MIT
// Ribbons: long thin bodies along a line, which bend easily and can meet themselves.
#pragma once

#include "core/model/soft_body_data.h"

#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace softbody::testing {

/// What a ribbon is made of.
struct Ribbon {
	double length = 4; ///< along its middle [length]
	double width = 0.2; ///< [length]
	int cells = 20; ///< of which it consists, each with its diagonals: 2 (cells + 1) hull points
	double bend = 0; ///< angle between its ends at rest [rad]: 0 is straight, almost 2 pi a closed ring
	double mass = 1;
	double stiffness = 2000; ///< of every spring
	double damping_ratio = 0.1;
};

/// Hull point i <= cells lies on one side (the outer one of a bent ribbon), 2 cells + 1 - i across from it. Bent by more
/// than a turn, the ribbon crosses itself.
inline std::vector<Vec2> ribbon_points(const Ribbon &ribbon) {
	std::vector<Vec2> points;
	const std::uint32_t cells = std::uint32_t(ribbon.cells);
	const auto add = [&](std::uint32_t i, double aside) {
		const double along = double(i) / cells - 0.5;
		if (ribbon.bend == 0) {
			points.push_back({ Real(along * ribbon.length), Real(-aside) });
			return;
		}
		const double radius = ribbon.length / ribbon.bend + aside;
		const double angle = along * ribbon.bend;
		points.push_back({ Real(radius * std::cos(angle)), Real(radius * std::sin(angle)) });
	};
	for (std::uint32_t i = 0; i <= cells; ++i) {
		add(i, ribbon.width / 2);
	}
	for (std::uint32_t i = cells + 1; i-- > 0;) {
		add(i, -ribbon.width / 2);
	}
	return points;
}

inline std::shared_ptr<const SoftBodyShape> ribbon_shape(const Ribbon &ribbon) {
	SoftBodyShape::Description description;
	description.points = ribbon_points(ribbon);
	const std::uint32_t cells = std::uint32_t(ribbon.cells);
	const std::uint32_t count = 2 * (cells + 1);
	description.masses.assign(count, Real(ribbon.mass / count));
	description.hull_count = count;
	const Real damping = Real(ribbon.damping_ratio * std::sqrt(ribbon.stiffness * ribbon.mass / count));
	const auto join = [&](std::uint32_t a, std::uint32_t b) {
		const Real rest = length(description.points[b] - description.points[a]);
		description.springs.push_back({ a, b, rest, Real(ribbon.stiffness), damping });
	};
	for (std::uint32_t i = 0; i <= cells; ++i) {
		join(i, count - 1 - i);
		if (i < cells) {
			join(i, i + 1);
			join(count - 2 - i, count - 1 - i);
			join(i, count - 2 - i);
			join(i + 1, count - 1 - i);
		}
	}
	return SoftBodyShape::create(std::move(description)).value();
}

} // namespace softbody::testing
