// SPDX-License-Identifier: MIT
// Takes points out of an outline one by one, as long as a tolerance allows it.
#include "core/creator/outline_collapse.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace softbody {

namespace {

constexpr std::size_t MOST_PIECES_OF_EDGE = 256;
// Points are moved for pairs whose error is at most this many tolerances, and for so many of them before giving up.
constexpr double MOVABLE_ERROR = 2.5;
constexpr int MOVABLE_PAIRS = 8;
// Pairs around a new point that are moved, so many times, by so many halved steps.
constexpr int MOVE_ROUNDS = 2;
constexpr int MOVE_STEPS = 3;
constexpr int MOVES_OF_STEP = 4;

double distance_between(Vec2d a, Vec2d b) {
	return std::sqrt(dot(b - a, b - a));
}

double distance_to_segment(Vec2d p, Vec2d a, Vec2d b) {
	const Vec2d along = b - a;
	const double squared = dot(along, along);
	const double t = squared > 0 ? std::clamp(dot(p - a, along) / squared, 0.0, 1.0) : 0.0;
	return distance_between(p, a + along * t);
}

bool edges_meet(Vec2d a, Vec2d b, Vec2d c, Vec2d d) {
	const auto side = [](Vec2d p, Vec2d q, Vec2d r) { return cross(q - p, r - p); };
	const double c_side = side(a, b, c);
	const double d_side = side(a, b, d);
	if (c_side == 0 && d_side == 0) { // in one line
		return std::min(a.x, b.x) <= std::max(c.x, d.x) && std::min(c.x, d.x) <= std::max(a.x, b.x) &&
				std::min(a.y, b.y) <= std::max(c.y, d.y) && std::min(c.y, d.y) <= std::max(a.y, b.y);
	}
	return c_side * d_side <= 0 && side(c, d, a) * side(c, d, b) <= 0;
}

} // namespace

OutlineCollapse::OutlineCollapse(std::span<const Vec2d> outline, const Limits &limits, std::span<const float> weights) :
		limits_(limits), bound_(limits.tolerance), count_(outline.size()) {
	for (std::size_t i = 0; i < outline.size(); ++i) {
		const Vec2d a = outline[i];
		const Vec2d b = outline[(i + 1) % outline.size()];
		Node node;
		node.point = a;
		node.place = std::uint32_t(fine_.size());
		node.before = std::uint32_t((i + outline.size() - 1) % outline.size());
		node.after = std::uint32_t((i + 1) % outline.size());
		nodes_.push_back(node);
		const double wanted = std::ceil(distance_between(a, b) / limits.piece);
		const std::size_t pieces = std::size_t(std::clamp(wanted, 1.0, double(MOST_PIECES_OF_EDGE)));
		for (std::size_t piece = 0; piece < pieces; ++piece) {
			const double t = double(piece) / double(pieces);
			fine_.push_back(a + (b - a) * t);
			fine_places_.push_back(double(i) + t);
			fine_weights_.push_back(weights.empty() ? 1.0 : double(weights[i]) * (1 - t) + double(weights[(i + 1) % outline.size()]) * t);
		}
	}
}

double OutlineCollapse::distance_of_stretch(std::uint32_t from, std::uint32_t to, Vec2d a, Vec2d b, double bound) const {
	double most = 0;
	const std::size_t way = way_between(from, to);
	for (std::size_t i = 0; i <= way && most <= bound; ++i) {
		const std::uint32_t place = place_along(from, i);
		most = std::max(most, fine_weights_[place] * distance_to_segment(fine_[place], a, b));
	}
	return most;
}

std::uint32_t OutlineCollapse::nearest_place(std::uint32_t from, std::uint32_t to, Vec2d point, double &r_distance) const {
	std::uint32_t nearest = from;
	double least = NEVER;
	for (std::size_t i = 0; i <= way_between(from, to); ++i) {
		const Vec2d arm = fine_[place_along(from, i)] - point;
		if (dot(arm, arm) < least) {
			least = dot(arm, arm);
			nearest = place_along(from, i);
		}
	}
	r_distance = std::sqrt(least) * fine_weights_[nearest];
	return nearest;
}

double OutlineCollapse::gap_of(Vec2d point, std::uint32_t place) const {
	return fine_weights_[place] * distance_between(point, fine_[place]);
}

void OutlineCollapse::try_merged(Node &r_node, Vec2d merged) const {
	const Node &next = nodes_[r_node.after];
	const Node &before = nodes_[r_node.before];
	const Node &after = nodes_[next.after];
	const double first = distance_between(before.point, merged);
	const double second = distance_between(merged, after.point);
	// Points that are too close already are drawn apart step by step.
	const double least = std::min({ limits_.least_edge, distance_between(before.point, r_node.point), distance_between(r_node.point, next.point), distance_between(next.point, after.point) });
	double gap = 0;
	const std::uint32_t place = nearest_place(r_node.place, next.place, merged, gap);
	const double first_weight = weight_between(before.place, place);
	const double second_weight = weight_between(place, after.place);
	if (std::min(first * first_weight, second * second_weight) < least || std::max(first * first_weight, second * second_weight) > limits_.longest_edge) {
		return;
	}
	const double bound = std::min(bound_, r_node.cost);
	if (gap > bound) {
		return;
	}
	const double cost = std::max({ gap, distance_of_stretch(before.place, place, before.point, merged, bound),
			distance_of_stretch(place, after.place, merged, after.point, bound) });
	if (cost <= bound_ && cost < r_node.cost) {
		r_node.cost = cost;
		r_node.merged = merged;
		r_node.merged_place = place;
	}
}

// The area stays where the new point lies on a line parallel to the chord of its neighbors. Of that line, places are
// tried that keep the direction of an edge beside, or that are near what the point stands for.
void OutlineCollapse::judge(std::uint32_t index) {
	Node &node = nodes_[index];
	node.cost = NEVER;
	const Node &next = nodes_[node.after];
	const Vec2d a = nodes_[node.before].point;
	const Vec2d b = node.point;
	const Vec2d c = next.point;
	const Vec2d d = nodes_[next.after].point;
	const Vec2d chord = d - a;
	const double chord_squared = dot(chord, chord);
	if (node.before == next.after || !(chord_squared > 0)) {
		return;
	}
	const double twice_area = cross(b - a, c - a) + cross(c - a, chord);
	const Vec2d foot = a + perpendicular(chord) * (-twice_area / chord_squared);
	const auto on_line = [&](Vec2d p) { return foot + chord * (dot(p - foot, chord) / chord_squared); };
	for (const auto &[from, to] : { std::pair(a, b), std::pair(d, c) }) {
		const double rise = cross(chord, to - from);
		if (rise != 0) {
			try_merged(node, from + (to - from) * (cross(chord, foot - from) / rise));
		}
	}
	for (const double t : { 0.5, 0.25, 0.75, 0.0, 1.0 }) {
		try_merged(node, on_line(b + (c - b) * t));
	}
	try_merged(node, on_line(fine_[place_along(node.place, way_between(node.place, next.place) / 2)]));
	if (node.cost < NEVER && distance_between(b, c) * weight_between(node.place, next.place) < limits_.least_edge) {
		node.cost -= bound_; // first of all
	}
}

// Whether the edges from a node to a point and from there to another node meet any edge that stays.
bool OutlineCollapse::crosses(std::uint32_t from, Vec2d point, std::uint32_t to) const {
	const Vec2d a = nodes_[from].point;
	const Vec2d d = nodes_[to].point;
	for (std::uint32_t i = to; i != from; i = nodes_[i].after) {
		const std::uint32_t j = nodes_[i].after;
		const Vec2d p = nodes_[i].point;
		const Vec2d q = nodes_[j].point;
		// Edges that share a point meet there, and may not fold back onto each other.
		const bool meets = (j != from && edges_meet(a, point, p, q)) || (i != to && edges_meet(point, d, p, q));
		if (meets || distance_to_segment(point, p, q) <= 0) {
			return true;
		}
	}
	return cross(a - point, d - point) == 0 && dot(a - point, d - point) > 0;
}

bool OutlineCollapse::edge_crosses(std::uint32_t index) const {
	return crosses(nodes_[index].before, nodes_[index].point, nodes_[index].after);
}

void OutlineCollapse::apply(std::uint32_t index) {
	Node &node = nodes_[index];
	Node &next = nodes_[node.after];
	node.point = node.merged;
	node.place = node.merged_place;
	next.is_used = false;
	if (start_ == node.after) {
		start_ = index;
	}
	nodes_[next.after].before = index;
	node.after = next.after;
	--count_;
	for (const std::uint32_t each : { nodes_[node.before].before, node.before, index, node.after }) {
		judge(each);
	}
}

std::uint32_t OutlineCollapse::best_pair() const {
	std::uint32_t best = std::uint32_t(nodes_.size());
	double least = NEVER;
	for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
		if (nodes_[i].is_used && nodes_[i].cost < least) {
			least = nodes_[i].cost;
			best = i;
		}
	}
	return best;
}

void OutlineCollapse::take_out_all() {
	while (count_ > limits_.enough) {
		const std::uint32_t best = best_pair();
		if (best == nodes_.size()) {
			return;
		}
		if (crosses(nodes_[best].before, nodes_[best].merged, nodes_[nodes_[best].after].after)) {
			nodes_[best].cost = NEVER; // until a neighbor changes
		} else {
			apply(best);
		}
	}
}

double OutlineCollapse::error_around(std::uint32_t index) const {
	double most = 0;
	std::uint32_t i = nodes_[index].before;
	for (int edge = 0; edge < 3; ++edge) {
		const Node &node = nodes_[i];
		const Node &next = nodes_[node.after];
		most = std::max({ most, gap_of(node.point, node.place), gap_of(next.point, next.place),
				distance_of_stretch(node.place, next.place, node.point, next.point, NEVER) });
		i = node.after;
	}
	return most;
}

// Tries places of a point in eight directions around it; the next point follows so that the area stays: it moves at a right angle to
// the chord from the first point to the one after it.
void OutlineCollapse::move_pair(std::uint32_t index) {
	constexpr double SLANT = 0.70710678118654752;
	constexpr Vec2d DIRECTIONS[] = { { 1, 0 }, { SLANT, SLANT }, { 0, 1 }, { -SLANT, SLANT }, { -1, 0 }, { -SLANT, -SLANT }, { 0, -1 }, { SLANT, -SLANT } };
	Node &b = nodes_[index];
	Node &c = nodes_[b.after];
	const Node &a = nodes_[b.before];
	const Node &d = nodes_[c.after];
	if (b.before == c.after) {
		return;
	}
	const double twice_area = cross(b.point - a.point, c.point - a.point) + cross(c.point - a.point, d.point - a.point);
	double error = error_around(index);
	double step = limits_.tolerance / 2;
	for (int halving = 0; halving < MOVE_STEPS; ++halving, step /= 2) {
		for (int move = 0; move < MOVES_OF_STEP; ++move) {
			const Node old_b = b;
			const Node old_c = c;
			Node best_b = b;
			Node best_c = c;
			for (const Vec2d direction : DIRECTIONS) {
				b.point = old_b.point + direction * step;
				const Vec2d chord = d.point - b.point;
				const double squared = dot(chord, chord);
				if (!(squared > 0)) {
					continue;
				}
				c.point = old_c.point + perpendicular(chord) * ((cross(old_c.point - a.point, chord) - twice_area) / squared);
				double gap = 0;
				b.place = nearest_place(a.place, old_c.place, b.point, gap);
				c.place = nearest_place(b.place, d.place, c.point, gap);
				const double edges[] = { distance_between(a.point, b.point) * weight_between(a.place, b.place), distance_between(b.point, c.point) * weight_between(b.place, c.place),
					distance_between(c.point, d.point) * weight_between(c.place, d.place) };
				if (std::ranges::min(edges) < limits_.least_edge || std::ranges::max(edges) > limits_.longest_edge) {
					continue;
				}
				const double moved = error_around(index);
				if (moved < error) {
					error = moved;
					best_b = b;
					best_c = c;
				}
			}
			const bool has_moved = best_b.point != old_b.point;
			b = best_b;
			c = best_c;
			if (!has_moved) {
				break;
			}
		}
	}
}

bool OutlineCollapse::take_out_by_moving() {
	const auto judge_all = [&](double bound) {
		bound_ = bound;
		for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
			if (nodes_[i].is_used) {
				judge(i);
			}
		}
	};
	judge_all(MOVABLE_ERROR * limits_.tolerance);
	for (int pair = 0; pair < MOVABLE_PAIRS && count_ > limits_.enough; ++pair) {
		const std::uint32_t best = best_pair();
		if (best == nodes_.size()) {
			break;
		}
		const std::vector<Node> before = nodes_;
		const std::uint32_t start = start_;
		apply(best);
		std::uint32_t around[6];
		around[3] = best;
		for (int i = 3; i > 0; --i) {
			around[i - 1] = nodes_[around[i]].before;
		}
		around[4] = nodes_[best].after;
		around[5] = nodes_[around[4]].after;
		double error = NEVER;
		for (int round = 0; round < MOVE_ROUNDS && error > limits_.tolerance; ++round) {
			for (const int i : { 3, 2, 4, 1 }) {
				move_pair(around[i]);
			}
			error = std::max({ error_around(around[1]), error_around(around[3]), error_around(around[4]) });
		}
		if (error <= limits_.tolerance && std::ranges::none_of(around, [&](std::uint32_t i) { return edge_crosses(i); })) {
			judge_all(limits_.tolerance);
			return true;
		}
		nodes_ = before;
		start_ = start;
		++count_;
		nodes_[best].cost = NEVER;
	}
	judge_all(limits_.tolerance);
	return false;
}

void OutlineCollapse::run() {
	for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
		judge(i);
	}
	do {
		take_out_all();
	} while (count_ > limits_.enough && take_out_by_moving());
}

std::vector<Vec2d> OutlineCollapse::hull() const {
	std::vector<Vec2d> points;
	for (std::uint32_t i = start_; points.size() < count_; i = nodes_[i].after) {
		points.push_back(nodes_[i].point);
	}
	return points;
}

std::vector<double> OutlineCollapse::places() const {
	std::vector<double> places;
	for (std::uint32_t i = start_; places.size() < count_; i = nodes_[i].after) {
		places.push_back(fine_places_[nodes_[i].place]);
	}
	return places;
}

double OutlineCollapse::error_of_shifted(Vec2d shift) const {
	double most = 0;
	std::uint32_t i = start_;
	do {
		const Node &node = nodes_[i];
		const Node &next = nodes_[node.after];
		const Vec2d point = node.point + shift;
		most = std::max({ most, gap_of(point, node.place), distance_of_stretch(node.place, next.place, point, next.point + shift, NEVER) });
		i = node.after;
	} while (i != start_);
	return most;
}

} // namespace softbody
