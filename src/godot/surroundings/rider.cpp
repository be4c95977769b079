// SPDX-License-Identifier: MIT
// A character above a soft body, as the proxy of that body sees it.
#include "godot/surroundings/rider.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace softbody {

namespace {

// Distance of the soles from an edge of the hull at which a rider counts as standing on it [px].
constexpr Real STANDING_DISTANCE = 4;

// Distance above the soles within which what is in the way is a floor and no wall [px].
constexpr Real STEP_HEIGHT = 6;

// Spread of riders along the floor, squared, below which they do not turn the floor [px²].
constexpr Real LEAST_SPREAD = 100;

// Whether the segment has a part in the box, by clipping it at each side (Liang and Barsky 1984).
bool meets(Vec2 a, Vec2 b, const Aabb &box) {
	Real first = 0;
	Real last = 1;
	const auto clip = [&](Real from, Real way, Real least, Real most) {
		if (way == 0) {
			return from >= least && from <= most;
		}
		const Real one = (least - from) / way;
		const Real other = (most - from) / way;
		first = std::max(first, std::min(one, other));
		last = std::min(last, std::max(one, other));
		return first <= last;
	};
	return clip(a.x, b.x - a.x, box.min.x, box.max.x) && clip(a.y, b.y - a.y, box.min.y, box.max.y);
}

// Leaves the part of a convex polygon where the direction n has n · p <= most.
void keep_below(Vec2 direction, Real most, std::vector<Vec2> &r_polygon) {
	std::vector<Vec2> kept;
	for (std::size_t i = 0; i < r_polygon.size(); ++i) {
		const Vec2 a = r_polygon[i];
		const Vec2 b = r_polygon[i + 1 < r_polygon.size() ? i + 1 : 0];
		const Real over_a = dot(a, direction) - most;
		const Real over_b = dot(b, direction) - most;
		if (over_a <= 0) {
			kept.push_back(a);
		}
		if ((over_a < 0 && over_b > 0) || (over_a > 0 && over_b < 0)) {
			kept.push_back(a + (b - a) * (over_a / (over_a - over_b)));
		}
	}
	r_polygon = kept.size() > 2 ? std::move(kept) : std::vector<Vec2>();
}

template <class Work>
void for_edges_in(std::span<const Vec2> hull, const Aabb &box, const Work &work) {
	for (std::size_t i = 0; i < hull.size(); ++i) {
		const std::size_t next = i + 1 < hull.size() ? i + 1 : 0;
		if (meets(hull[i], hull[next], box)) {
			work(i, next);
		}
	}
}

} // namespace

bool operator==(const Rider &a, const Rider &b) {
	return a.box.min == b.box.min && a.box.max == b.box.max && a.up == b.up && a.speed == b.speed && a.reach == b.reach &&
			a.stood == b.stood && a.gap == b.gap;
}

// The box in a frame whose y axis points down to the floor, for the direction along the axes nearest to `up`.
Aabb Rider::sole(Real above, Real below) const {
	Aabb band = box;
	if (std::abs(up.y) >= std::abs(up.x)) {
		const Real end = (box.max.x - box.min.x) / 4;
		const Real level = up.y < 0 ? box.max.y : box.min.y;
		band = { { box.min.x + end, level - (up.y < 0 ? above : below) }, { box.max.x - end, level + (up.y < 0 ? below : above) } };
	} else {
		const Real end = (box.max.y - box.min.y) / 4;
		const Real level = up.x < 0 ? box.max.x : box.min.x;
		band = { { level - (up.x < 0 ? above : below), box.min.y + end }, { level + (up.x < 0 ? below : above), box.max.y - end } };
	}
	return band;
}

std::optional<Vec2> velocity_at_soles(std::span<const Vec2> hull, std::span<const Vec2> velocities, const Rider &rider,
		Real above, Real below) {
	Vec2 sum;
	Real ends = 0;
	for_edges_in(hull, rider.sole(above, below), [&](std::size_t from, std::size_t to) {
		sum += velocities[from] + velocities[to];
		ends += 2;
	});
	return ends > 0 ? std::optional(sum * (1 / ends)) : std::nullopt;
}

// What reaches up beside a character is a wall, which stops it, unless it stands in the middle of that.
bool sinks_in(std::span<const Vec2> hull, const Rider &rider) {
	bool is_there = false;
	const auto find = [&](std::size_t, std::size_t) { is_there = true; };
	if (rider.stood) {
		for_edges_in(hull, rider.sole(STEP_HEIGHT, STEP_HEIGHT), find);
		if (is_there) {
			return true;
		}
	}
	const Real height = std::abs(dot(rider.box.max - rider.box.min, rider.up));
	const Vec2 lift = rider.up * STEP_HEIGHT;
	Aabb upper = rider.box;
	upper.min += { std::max(lift.x, Real(0)), std::max(lift.y, Real(0)) };
	upper.max += { std::min(lift.x, Real(0)), std::min(lift.y, Real(0)) };
	bool is_wall = false;
	if (height > STEP_HEIGHT) {
		for_edges_in(hull, upper, [&](std::size_t, std::size_t) { is_wall = true; });
	}
	for_edges_in(hull, rider.box.grown(rider.reach), find);
	return is_there && !is_wall;
}

void mark_at_riders(std::span<const Vec2> hull, std::span<const Rider> riders, Real margin, std::vector<bool> &r_marks) {
	r_marks.assign(hull.size(), false);
	for (const Rider &rider : riders) {
		for_edges_in(hull, rider.box.grown(margin), [&](std::size_t from, std::size_t to) {
			r_marks[from] = true;
			r_marks[to] = true;
		});
	}
}

// The missing speed of rider i is s_i = e + f d_i, where d_i is its place along the floor, counted from the mean of all:
// e is the mean of s, and f = sum d s / sum d². The speed e along `up` and the spin f, about the mean, bring it.
void move_with_riders(std::span<const Vec2> hull, std::span<const Vec2> velocities, std::span<const Rider> riders,
		BodyFrame &r_frame) {
	struct Foot {
		Vec2 place;
		Vec2 missing; ///< velocity
		Vec2 up;
	};
	std::vector<Foot> feet;
	Foot mean;
	for (const Rider &rider : riders) {
		// What stood on the hull before the step is thrown with its own speed, though the hull stays behind.
		const Real below = rider.stood ? std::max(rider.reach, STANDING_DISTANCE) : STANDING_DISTANCE;
		const std::optional<Vec2> surface = velocity_at_soles(hull, velocities, rider, STANDING_DISTANCE, below);
		if (!surface) {
			continue;
		}
		const Vec2 motion = *surface + rider.up * (rider.speed - dot(*surface, rider.up));
		const Vec2 place = rider.sole(0, 0).center();
		feet.push_back({ place, motion - r_frame.velocity - perpendicular(place - r_frame.center) * r_frame.angular_velocity, rider.up });
		mean.place += place;
		mean.missing += feet.back().missing;
	}
	if (feet.empty()) {
		return;
	}
	const Real share = Real(1) / Real(feet.size());
	mean = { mean.place * share, mean.missing * share, feet.front().up };
	Real moment = 0;
	Real spread = 0;
	for (const Foot &foot : feet) {
		const Real distance = dot(foot.place - mean.place, perpendicular(mean.up));
		moment += distance * dot(foot.missing, mean.up);
		spread += distance * distance;
	}
	// A spin w moves the place d along the floor by perpendicular(d along) w = -d w up.
	const Real spin = spread > LEAST_SPREAD ? -moment / spread : 0;
	r_frame.velocity += mean.missing + perpendicular(r_frame.center - mean.place) * spin;
	r_frame.angular_velocity += spin;
}

void cut_for_riders(std::span<const Vec2> outline, std::span<const Rider> riders, std::vector<std::vector<Vec2>> &r_pieces) {
	r_pieces.resize(pieces_for(riders.size()));
	for (std::vector<Vec2> &piece : r_pieces) {
		piece.clear();
	}
	const Vec2 up = riders.front().up;
	const Vec2 along = perpendicular(up);
	std::vector<std::pair<Real, Real>> columns; // from and to along the floor
	for (std::size_t i = 0; i < riders.size(); ++i) {
		const Rider &rider = riders[i];
		const Real middle = dot(rider.box.center(), along);
		const Real half = std::abs(rider.box.half_size().x * along.x) + std::abs(rider.box.half_size().y * along.y) + rider.reach;
		columns.push_back({ middle - half, middle + half });
		const Real height = std::abs(rider.box.half_size().x * up.x) + std::abs(rider.box.half_size().y * up.y);
		std::vector<Vec2> &floor = r_pieces[2 * i + 1];
		floor.assign(outline.begin(), outline.end());
		keep_below(up, dot(rider.box.center(), up) - height - rider.gap, floor);
		if (riders.size() > 1) { // not under the others, which may be deeper
			keep_below(along, middle + half, floor);
			keep_below(-along, half - middle, floor);
		}
	}
	std::ranges::sort(columns);
	Real from = -std::numeric_limits<Real>::max();
	for (std::size_t i = 0; i <= columns.size(); ++i) {
		const Real to = i < columns.size() ? columns[i].first : std::numeric_limits<Real>::max();
		if (to > from) {
			std::vector<Vec2> &wall = r_pieces[2 * i];
			wall.assign(outline.begin(), outline.end());
			if (i < columns.size()) {
				keep_below(along, to, wall);
			}
			if (i > 0) {
				keep_below(-along, -from, wall);
			}
		}
		from = i < columns.size() ? std::max(from, columns[i].second) : from;
	}
}

} // namespace softbody
