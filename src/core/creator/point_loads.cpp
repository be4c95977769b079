// SPDX-License-Identifier: MIT
// Loads on the points of a body as loads on the nodes of the solid inside it, and displacements of the nodes as those of the
// points.
#include "core/creator/point_loads.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace softbody {

namespace {

// Least mass of a hull point, over their mean: contacts would flick lighter points about.
constexpr double LEAST_MASS = 0.3;

constexpr double SMOOTHED_CELLS = 1.5;

// Most pieces into which an edge is divided where loads are spread along it.
constexpr double MOST_PIECES = 16;

} // namespace

PointLoads::PointLoads(const LatticeSolid &solid, std::span<const Vec2> points, std::size_t hull_count) :
		solid_(solid), points_(points.begin(), points.end()), hull_count_(hull_count) {
	assign_shares();
	assign_edges();
	assign_regions();
}

void PointLoads::assign_shares() {
	const std::span<const Vec2> hull = std::span(points_).first(hull_count_);
	// Each hull point stands for the part of the solid that is nearest to it: the tip of a star is light.
	hull_shares_.assign(hull_count_, 0);
	for (std::uint32_t node = 0; node < solid_.node_masses().size(); ++node) {
		const Vec2 place = solid_.node_position(node);
		double least = length_squared(hull[0] - place);
		for (const Vec2 p : hull) {
			least = std::min(least, double(length_squared(p - place)));
		}
		std::vector<std::size_t> nearest; // several on a line of symmetry
		for (std::size_t i = 0; i < hull_count_; ++i) {
			if (length_squared(hull[i] - place) <= least * (1 + 1e-4)) {
				nearest.push_back(i);
			}
		}
		for (const std::size_t i : nearest) {
			hull_shares_[i] += solid_.node_masses()[node] / double(nearest.size());
		}
	}
	smooth_shares();
	double sum = 0;
	for (double &share : hull_shares_) {
		share = std::max(share, LEAST_MASS / double(hull_count_));
		sum += share;
	}
	const double factor = 1 / sum;
	for (double &share : hull_shares_) {
		share *= factor;
	}
}

// Hull points closer together than the lattice's nodes share the sum within a cell's length equally.
void PointLoads::smooth_shares() {
	const auto edge = [&](std::size_t i) { return double(length(points_[(i + 1) % hull_count_] - points_[i])); };
	const auto tributary = [&](std::size_t i) { return (edge((i + hull_count_ - 1) % hull_count_) + edge(i)) / 2; };
	const double reach = SMOOTHED_CELLS * solid_.cell_size();
	std::vector<double> smooth(hull_count_);
	for (std::size_t i = 0; i < hull_count_; ++i) {
		double share = hull_shares_[i];
		double length = tributary(i);
		double ahead = edge(i);
		double behind = edge((i + hull_count_ - 1) % hull_count_);
		for (std::size_t k = 1; 2 * k < hull_count_ && (ahead < reach || behind < reach); ++k) {
			const std::size_t next = (i + k) % hull_count_;
			const std::size_t last = (i + hull_count_ - k) % hull_count_;
			if (ahead < reach) {
				share += hull_shares_[next];
				length += tributary(next);
			}
			if (behind < reach) {
				share += hull_shares_[last];
				length += tributary(last);
			}
			ahead += edge(next);
			behind += edge((last + hull_count_ - 1) % hull_count_);
		}
		smooth[i] = share / length * tributary(i);
	}
	hull_shares_ = std::move(smooth);
}

// A load on a hull point is a load on its two edges, as a contact with the ground touches edges, not points. The
// displacement of the outline is the piecewise linear one that fits the solid's best, through a basis that is dual to
// the hat functions (Wohlmuth 2000): over an edge with s from 0 at the point to 1 at its neighbor the weight is 2 - 3
// s. Every uniform strain and rotation is reproduced exactly.
void PointLoads::assign_edges() {
	const double offset = std::sqrt(1.0 / 12);
	edges_.assign(hull_count_, {});
	for (std::size_t i = 0; i < hull_count_; ++i) {
		const Vec2 here = points_[i];
		const std::array<Vec2, 2> neighbors = { points_[i == 0 ? hull_count_ - 1 : i - 1], points_[i + 1 == hull_count_ ? 0 : i + 1] };
		const double both = double(length(neighbors[0] - here)) + double(length(neighbors[1] - here));
		for (const Vec2 neighbor : neighbors) {
			const double share = 2 * double(length(neighbor - here)) / both;
			const auto pieces = std::size_t(std::clamp(std::ceil(double(length(neighbor - here)) / solid_.cell_size()), 1.0, MOST_PIECES));
			for (std::size_t piece = 0; piece < pieces; ++piece) {
				for (const double at : { 0.5 - offset, 0.5 + offset }) { // Gauss: exact for the products of two lines
					const double s = (double(piece) + at) / double(pieces);
					const LatticeSolid::Embedding place = solid_.embed(here + (neighbor - here) * Real(s));
					for (std::size_t c = 0; c < 4; ++c) {
						edges_[i].push_back({ place.nodes[c], place.weights[c] * share * (2 - 3 * s) / (2 * double(pieces)) });
					}
				}
			}
		}
	}
}

// An inner point stands for the part of the solid nearest to it: it moves as the mean rigid motion of that part, and
// its load is spread over it. A load on a single place would let it swing inside the body.
void PointLoads::assign_regions() {
	const std::span<const Vec2> inner = std::span(points_).subspan(hull_count_);
	const std::span<const double> node_masses = solid_.node_masses();
	regions_.assign(inner.size(), {});
	for (std::uint32_t node = 0; node < node_masses.size() && !inner.empty(); ++node) {
		const Vec2 place = solid_.node_position(node);
		const auto nearest = std::ranges::min_element(inner, {}, [&](Vec2 p) { return length_squared(p - place); });
		regions_[std::size_t(nearest - inner.begin())].nodes.push_back(node);
	}
	for (std::size_t k = 0; k < inner.size(); ++k) {
		Region &region = regions_[k];
		if (region.nodes.empty()) { // coincident points
			const LatticeSolid::Embedding nearest = solid_.embed(inner[k]);
			region.nodes.assign(nearest.nodes.begin(), nearest.nodes.end());
		}
		for (const std::uint32_t node : region.nodes) {
			region.mass += node_masses[node];
			region.center += Vec2d(solid_.node_position(node)) * node_masses[node];
		}
		region.center = { region.center.x / region.mass, region.center.y / region.mass };
		for (const std::uint32_t node : region.nodes) {
			region.inertia += node_masses[node] * length_squared(Vec2d(solid_.node_position(node)) - region.center);
		}
	}
}

// Spreads loads on the points over the nodes.
PointVector PointLoads::to_nodes(const PointVector &loads) const {
	PointVector nodes(solid_.node_masses().size());
	for (std::size_t i = 0; i < hull_count_; ++i) {
		for (const auto &[node, weight] : edges_[i]) {
			nodes[node] += loads[i] * weight;
		}
	}
	for (std::size_t k = 0; k < regions_.size(); ++k) {
		const Region &region = regions_[k];
		const Vec2d load = loads[hull_count_ + k];
		const Vec2d pull{ load.x / region.mass, load.y / region.mass };
		const double turn = cross(Vec2d(points_[hull_count_ + k]) - region.center, load) / region.inertia;
		for (const std::uint32_t node : region.nodes) {
			const Vec2d arm = Vec2d(solid_.node_position(node)) - region.center;
			nodes[node] += (pull + perpendicular(arm) * turn) * solid_.node_masses()[node];
		}
	}
	return nodes;
}

// The displacements of the points when the nodes move: the transpose of `to_nodes`.
PointVector PointLoads::from_nodes(const PointVector &nodes) const {
	PointVector result(points_.size());
	for (std::size_t i = 0; i < hull_count_; ++i) {
		for (const auto &[node, weight] : edges_[i]) {
			result[i] += nodes[node] * weight;
		}
	}
	for (std::size_t k = 0; k < regions_.size(); ++k) {
		const Region &region = regions_[k];
		Vec2d moved;
		double turn = 0;
		for (const std::uint32_t node : region.nodes) {
			const double mass = solid_.node_masses()[node];
			moved += nodes[node] * mass;
			turn += mass * cross(Vec2d(solid_.node_position(node)) - region.center, nodes[node]);
		}
		const Vec2d arm = Vec2d(points_[hull_count_ + k]) - region.center;
		result[hull_count_ + k] = Vec2d{ moved.x / region.mass, moved.y / region.mass } + perpendicular(arm) * (turn / region.inertia);
	}
	return result;
}

} // namespace softbody
