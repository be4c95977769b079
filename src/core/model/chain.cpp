// SPDX-License-Identifier: MIT
// The part of a shape that makes a body an open chain.
#include "core/model/chain.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace softbody {

Status ChainShape::check(std::size_t hull_count, std::size_t point_count) const {
	if (sections_.size() < 2) {
		return Error{ "chain", std::to_string(sections_.size()) + " sections", "must have at least 2", "add points to the path" };
	}
	std::vector<char> seen(point_count, 0);
	for (std::size_t i = 0; i < sections_.size(); ++i) {
		const ChainSection &section = sections_[i];
		const std::string name = "chain[" + std::to_string(i) + "]";
		const bool is_valid = section.left < hull_count && section.right < hull_count && section.center >= hull_count && section.center < point_count;
		if (!is_valid) {
			return Error{ name, "points " + std::to_string(section.left) + ", " + std::to_string(section.right) + " and " + std::to_string(section.center),
				"must be two hull points and an inner point", "use indices of existing points" };
		}
		for (const std::uint32_t point : { section.left, section.right, section.center }) {
			if (seen[point]++ != 0) {
				return Error{ name, "point " + std::to_string(point), "must belong to one section", "use each point once" };
			}
		}
	}
	return {};
}

Status ChainShape::measure(std::span<const Vec2> rest_positions, std::span<const Real> masses) {
	const std::size_t n = sections_.size();
	section_of_.assign(rest_positions.size(), NO_SECTION);
	lengths_.assign(n - 1, 0);
	half_widths_.assign(n, 0);
	width_shares_.assign(n, 1);
	masses_.assign(n, 0);
	curvatures_.assign(n, Vec2{});
	total_length_ = 0;
	const auto center = [&](std::size_t i) { return rest_positions[sections_[i].center]; };
	Real widest = 0;
	for (std::size_t i = 0; i < n; ++i) {
		const auto [left, right, middle] = sections_[i];
		for (const std::uint32_t point : { left, right, middle }) {
			section_of_[point] = std::uint32_t(i);
			masses_[i] += masses[point];
		}
		if (i + 1 < n) {
			lengths_[i] = length(center(i + 1) - center(i));
			total_length_ += lengths_[i];
			if (!(lengths_[i] > 0)) {
				return Error{ "chain[" + std::to_string(i) + "]", "0", "must have a length", "move its ends apart" };
			}
		}
		const Vec2 way = center(std::min(i + 1, n - 1)) - center(i == 0 ? 0 : i - 1);
		const Real half = length(rest_positions[left] - rest_positions[right]) / 2;
		half_widths_[i] = cross(way, rest_positions[left] - center(i)) < 0 ? -half : half;
		widest = std::max(widest, half);
	}
	for (std::size_t i = 0; i < n; ++i) {
		width_shares_[i] = widest > 0 ? std::abs(half_widths_[i]) / widest : Real(1);
	}
	for (std::size_t i = 1; i + 1 < n; ++i) {
		const Vec2 before = (center(i) - center(i - 1)) * (1 / lengths_[i - 1]);
		const Vec2 after = (center(i + 1) - center(i)) * (1 / lengths_[i]);
		const Vec2 way = center(i + 1) - center(i - 1);
		const Real size = length(way);
		const Vec2 curvature = (after - before) * (2 / (lengths_[i - 1] + lengths_[i]));
		curvatures_[i] = size > 0 ? Vec2{ dot(curvature, way), cross(way, curvature) } * (1 / size) : Vec2{};
	}
	return {};
}

} // namespace softbody
