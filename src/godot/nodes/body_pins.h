// SPDX-License-Identifier: MIT
// Points of a node that are held in place, or at another node.
#pragma once

#include "core/base/error.h"
#include "core/model/soft_body_data.h"
#include "godot/convert.h"

#include <godot_cpp/classes/node2d.hpp>
#include <godot_cpp/variant/node_path.hpp>
#include <godot_cpp/variant/packed_int32_array.hpp>
#include <godot_cpp/variant/packed_string_array.hpp>
#include <godot_cpp/variant/typed_array.hpp>

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace softbody {

/// Points are those of the user's order. A pin without a target holds its point where it is. A pin with one looks for the
/// target until it is there, and then keeps its place in the target's frame.
class BodyPins {
public:
	const godot::PackedInt32Array &points() const { return points_; }
	const godot::TypedArray<godot::NodePath> &targets() const { return targets_; }
	bool has(int p_point) const { return points_.has(p_point); }
	/// Empty for a point without a target.
	godot::NodePath target_of(int p_point) const;

	static Status check(const godot::PackedInt32Array &p_points);
	void set_points(const godot::PackedInt32Array &p_points);
	void set_targets(const godot::TypedArray<godot::NodePath> &p_targets);
	/// False when the point is pinned so already.
	bool pin(int p_point, const godot::NodePath &p_target);
	void unpin(int p_point);
	/// Takes over which points of the body are pinned. A point that stays pinned keeps its target.
	void take_over(const SoftBodyData &p_body, PointOrder p_order);
	/// Takes over pins of another body: for each pair the point here and the point there. Targets and places in their
	/// frames stay.
	void take_part(const BodyPins &p_whole, std::span<const std::pair<int, int>> p_points);
	/// Exchanges the paths for others to the same targets.
	void set_paths(const godot::TypedArray<godot::NodePath> &p_paths) { targets_ = p_paths; }
	/// The places in the frames of the targets are looked up anew: for a body of another rest shape.
	void forget_places() { places_.clear(); }

	/// Pins and frees points of the body, which stay where they are.
	Status apply(SoftBodyData &r_body, PointOrder p_order) const;
	/// Before a step: moves points with targets to where those are now. `p_owner` is the node that paths begin at.
	Status follow(const godot::Node &p_owner, SoftBodyData &r_body, PointOrder p_order);
	void append_warnings(const godot::Node &p_owner, int p_point_count, godot::PackedStringArray &r_warnings) const;

private:
	struct Place {
		uint64_t target = 0; ///< instance id, once it was found
		godot::Vector2 position; ///< in the target's frame
	};

	godot::PackedInt32Array points_;
	godot::TypedArray<godot::NodePath> targets_; ///< one a pinned point; missing ones are the world
	std::vector<Place> places_; ///< one a pinned point
};

} // namespace softbody
