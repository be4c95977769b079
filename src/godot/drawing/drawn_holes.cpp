// SPDX-License-Identifier: MIT
// The holes of a body as they are drawn.
#include "godot/drawing/drawn_holes.h"

#include "core/creator/hole_weights.h"
#include "core/geometry/polygon.h"

#include <algorithm>
#include <cmath>
#include <mutex>

using namespace godot;

namespace softbody {

namespace {

constexpr std::size_t MOST_KEPT = 16;

struct Kept {
	Holes holes;
	std::vector<Vec2> hull;
	std::shared_ptr<const HoleBinding> binding;
};

// The last few, as crowds come of one kind.
std::shared_ptr<const HoleBinding> find_or_make(const Holes &p_holes, const std::vector<Vec2> &p_hull) {
	static std::mutex mutex;
	static std::vector<Kept> kept;
	static std::size_t oldest = 0;
	const std::lock_guard lock(mutex);
	const auto found = std::ranges::find_if(kept, [&](const Kept &each) { return each.hull == p_hull && each.holes == p_holes; });
	if (found != kept.end()) {
		return found->binding;
	}
	Kept made{ p_holes, p_hull, std::make_shared<const HoleBinding>(p_holes, p_hull, hole_weights(p_hull, p_holes)) };
	if (kept.size() < MOST_KEPT) {
		kept.push_back(made);
	} else {
		kept[oldest] = made;
		oldest = (oldest + 1) % MOST_KEPT;
	}
	return made.binding;
}

} // namespace

Holes to_core(const TypedArray<PackedVector2Array> &p_holes) {
	Holes holes;
	for (int64_t i = 0; i < p_holes.size(); i++) {
		holes.push_back(to_core(PackedVector2Array(p_holes[i])));
	}
	return holes;
}

TypedArray<PackedVector2Array> to_godot(const Holes &p_holes) {
	TypedArray<PackedVector2Array> holes;
	for (const std::vector<Vec2> &hole : p_holes) {
		holes.push_back(to_godot(std::span<const Vec2>(hole)));
	}
	return holes;
}

DrawnHoles::DrawnHoles(const Holes &p_holes, const PackedVector2Array &p_polygon, const PackedVector2Array &p_hull) :
		holes_(p_holes), hull_(to_core(p_hull)) {
	const bool is_negative = signed_area(to_core(p_polygon)) < 0;
	for (const std::vector<Vec2> &hole : p_holes) {
		winds_as_polygon_.push_back((signed_area(hole) < 0) == is_negative);
	}
}

const HoleBinding &DrawnHoles::binding() const {
	if (binding_ == nullptr) {
		binding_ = find_or_make(holes_, hull_);
	}
	return *binding_;
}

std::span<const Vec2> DrawnHoles::place(std::span<const Vec2> p_points, PointOrder p_order) const {
	static std::vector<Vec2> hull;
	static std::vector<Vec2> points;
	hull.resize(hull_.size());
	for (std::size_t i = 0; i < hull.size(); i++) {
		hull[i] = p_points[std::size_t(p_order.mirror(int(i)))];
	}
	points.resize(binding().point_count());
	binding().place(hull, points);
	return points;
}

Holes DrawnHoles::follow(std::span<const Vec2> p_points, PointOrder p_order) const {
	Holes holes;
	std::span<const Vec2> left = place(p_points, p_order);
	for (const std::size_t count : counts()) {
		holes.emplace_back(left.begin(), left.begin() + std::ptrdiff_t(count));
		left = left.subspan(count);
	}
	return holes;
}

void DrawnHoles::append(std::span<const Vec2> p_points, PointOrder p_order, bool p_against_reverse, std::vector<Vec2> &r_points) const {
	const std::span<const Vec2> places = place(p_points, p_order);
	std::size_t start = 0;
	for (std::size_t hole = 0; hole < counts().size(); hole++) {
		const std::span<const Vec2> points = places.subspan(start, counts()[hole]);
		start += points.size();
		r_points.insert(r_points.end(), points.begin(), points.end());
		if (winds_as_polygon_[hole] != p_against_reverse) {
			std::reverse(r_points.end() - std::ptrdiff_t(points.size()), r_points.end());
		}
	}
}

double DrawnHoles::area(std::span<const Vec2> p_points, PointOrder p_order) const {
	double sum = 0;
	for (const std::vector<Vec2> &hole : follow(p_points, p_order)) {
		sum += std::abs(double(signed_area(hole)));
	}
	return sum;
}

} // namespace softbody
