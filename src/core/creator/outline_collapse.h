// SPDX-License-Identifier: MIT
// Takes points out of an outline one by one, as long as a tolerance allows it.
#pragma once

#include "core/base/vec2.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace softbody {

/// The method of `simplify_outline` for one tolerance. Every hull point stands for a place of the outline, every edge for the
/// stretch between two such places. The error is the largest distance of a hull point from its place, and of a stretch from
/// its edge. It bounds the distance in both directions: a stretch is one line, so its projections cover the
/// edge between those of its ends; beyond these the edge lies between a hull point and the projection of its place.
/// Where the outline has a weight, its distances count that many times as much, and its hull's edges are that many times as short.
class OutlineCollapse {
public:
	struct Limits {
		double tolerance = 0; ///< largest error [length]
		double piece = 0; ///< longest piece into which edges of the outline are divided [length], > 0
		double least_edge = 0; ///< least distance of neighbors [length]; those of the outline that are closer stay where they must
		double longest_edge = 0; ///< [length], unless the outline has a longer one
		std::size_t enough = 3; ///< number of points below which none is taken out [1]
	};

	/// `weights` has one for each point of the outline, > 0, or none, where all are 1; between points they are interpolated.
	OutlineCollapse(std::span<const Vec2d> outline, const Limits &limits, std::span<const float> weights = {});

	/// Replaces pairs of neighbors by one point that keeps the area, those of the least error first (Kronenfeld and others
	/// 2020). Where no pair is left within the tolerance, the points around a pair are moved, with the area kept, until it is.
	void run();

	std::size_t count() const { return count_; }
	std::vector<Vec2d> hull() const;
	/// For each hull point its place: i + t is t of the way from the outline's point i to the next.
	std::vector<double> places() const;
	/// The error of the hull shifted by that [length], by weights.
	double error_of_shifted(Vec2d shift) const;

private:
	static constexpr double NEVER = std::numeric_limits<double>::infinity();

	struct Node {
		Vec2d point;
		std::uint32_t place = 0; ///< index into `fine_`
		std::uint32_t before = 0;
		std::uint32_t after = 0;
		bool is_used = true;
		// The point that would replace this one and the next, and the error of its two edges.
		double cost = NEVER;
		Vec2d merged;
		std::uint32_t merged_place = 0;
	};

	std::size_t way_between(std::uint32_t from, std::uint32_t to) const { return (to + fine_.size() - from) % fine_.size(); }
	std::uint32_t place_along(std::uint32_t from, std::size_t way) const { return std::uint32_t((from + way) % fine_.size()); }
	/// Both stop looking once the result exceeds `bound`.
	double distance_of_stretch(std::uint32_t from, std::uint32_t to, Vec2d a, Vec2d b, double bound) const;
	std::uint32_t nearest_place(std::uint32_t from, std::uint32_t to, Vec2d point, double &r_distance) const;
	/// Distance of a node from its place, by the place's weight.
	double gap_of(Vec2d point, std::uint32_t place) const;
	/// Mean weight of two places.
	double weight_between(std::uint32_t from, std::uint32_t to) const { return (fine_weights_[from] + fine_weights_[to]) / 2; }
	void judge(std::uint32_t index);
	void try_merged(Node &r_node, Vec2d merged) const;
	bool crosses(std::uint32_t from, Vec2d point, std::uint32_t to) const;
	bool edge_crosses(std::uint32_t index) const;
	void apply(std::uint32_t index);
	/// The pair of least cost; none: the number of nodes.
	std::uint32_t best_pair() const;
	void take_out_all();
	/// Takes out one more point by moving those around it. False if none can be.
	bool take_out_by_moving();
	void move_pair(std::uint32_t index);
	/// Error of the edges before, between and after a point and the next.
	double error_around(std::uint32_t index) const;

	Limits limits_;
	double bound_; ///< of the error for now
	std::vector<Vec2d> fine_; ///< the outline, its edges divided
	std::vector<double> fine_places_;
	std::vector<double> fine_weights_;
	std::vector<Node> nodes_;
	std::uint32_t start_ = 0;
	std::size_t count_ = 0;
};

} // namespace softbody
