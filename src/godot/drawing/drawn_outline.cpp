// SPDX-License-Identifier: MIT
// A polygon that is drawn, and the hull of fewer points that is simulated in its place.
#include "godot/drawing/drawn_outline.h"

#include <algorithm>
#include <cstddef>
#include <mutex>

using namespace godot;

namespace softbody {

namespace {

constexpr std::size_t MOST_KEPT = 16;

struct Kept {
	std::vector<Vec2> polygon;
	SimplifyOptions options;
	std::shared_ptr<const DrawnOutline> outline; ///< null where the polygon is the hull
};

} // namespace

std::shared_ptr<const DrawnOutline> DrawnOutline::find_or_make(const PackedVector2Array &p_polygon, const SimplifyOptions &p_options) {
	static std::mutex mutex;
	static std::vector<Kept> kept;
	static std::size_t oldest = 0;
	Kept wanted{ to_core(p_polygon), p_options, nullptr };
	const std::lock_guard lock(mutex);
	const auto found = std::ranges::find_if(kept, [&](const Kept &each) { return each.options == p_options && each.polygon == wanted.polygon; });
	if (found != kept.end()) {
		return found->outline;
	}
	const auto simplified = simplify_outline(wanted.polygon, p_options);
	if (simplified && !simplified.value().is_outline) {
		const auto made = std::make_shared<DrawnOutline>();
		made->drawn_ = wanted.polygon;
		made->hull_ = to_godot(simplified.value().hull);
		made->error_ = simplified.value().error;
		made->binding_ = OutlineBinding(wanted.polygon, simplified.value().hull, simplified.value().places);
		wanted.outline = made;
	}
	if (kept.size() < MOST_KEPT) {
		kept.push_back(wanted);
	} else {
		kept[oldest] = wanted;
		oldest = (oldest + 1) % MOST_KEPT;
	}
	return wanted.outline;
}

std::vector<Vec2> DrawnOutline::drawn_rest(std::span<const Vec2> p_rest) const {
	std::vector<Vec2> drawn = drawn_;
	drawn.insert(drawn.end(), p_rest.begin() + std::ptrdiff_t(hull_.size()), p_rest.end());
	return drawn;
}

std::span<const Vec2> DrawnOutline::follow(std::span<const Vec2> p_points, PointOrder p_order) const {
	static std::vector<Vec2> hull;
	static std::vector<Vec2> drawn;
	const std::size_t count = std::size_t(hull_.size());
	hull.resize(count);
	for (std::size_t i = 0; i < count; i++) {
		hull[i] = p_points[std::size_t(p_order.mirror(int(i)))];
	}
	drawn.resize(drawn_.size() + p_points.size() - count);
	binding_.place(hull, drawn);
	std::copy(p_points.begin() + std::ptrdiff_t(count), p_points.end(), drawn.begin() + std::ptrdiff_t(drawn_.size()));
	return drawn;
}

std::vector<Vec2> DrawnOutline::fit(std::span<const Vec2> p_drawn) const {
	std::vector<Vec2> fitted(std::size_t(hull_.size()));
	binding_.fit(p_drawn, fitted);
	return fitted;
}

} // namespace softbody
