// SPDX-License-Identifier: MIT
// Finds places with more shapes than one query of the engine takes.
#pragma once

#include "core/geometry/aabb.h"

#include <godot_cpp/classes/physics_direct_space_state2d.hpp>
#include <godot_cpp/classes/physics_shape_query_parameters2d.hpp>
#include <godot_cpp/variant/rid.hpp>

#include <vector>

namespace softbody {

/// The engine tests at most 2048 shapes in a query, those of areas and of other layers among them, and does not tell of
/// more. This counts all shapes in boxes, one count a call, and remembers how small a box must be where they are many.
class CrowdWatch {
public:
	CrowdWatch();
	~CrowdWatch();
	CrowdWatch(const CrowdWatch &) = delete;
	CrowdWatch &operator=(const CrowdWatch &) = delete;

	/// Whether the box that was given last has been counted to its end.
	bool is_done() const { return waiting_.empty(); }
	/// Counts another box from the next call of `look` on.
	void watch(const Aabb &box);
	/// Counts once, if there is anything to count.
	void look(godot::PhysicsDirectSpaceState2D *state);
	/// How often a box must be quartered, 0..`most`, so that its parts hold few enough shapes as far as is known.
	int splits(const Aabb &box, int most) const;

private:
	struct Part {
		Aabb box;
		int depth = 0;
	};
	struct Crowd {
		Aabb box;
		Real width = 0; ///< largest extent of a query in it [px]
	};

	bool is_crowded(godot::PhysicsDirectSpaceState2D *state, const Aabb &box);
	void remember();

	godot::RID shape_;
	godot::Ref<godot::PhysicsShapeQueryParameters2D> query_;
	Aabb watched_;
	std::vector<Part> waiting_; ///< parts of it that are still to be counted
	int deepest_ = 0;
	unsigned turn_ = 0; ///< quarter that comes first
	std::vector<Crowd> crowds_;
};

} // namespace softbody
