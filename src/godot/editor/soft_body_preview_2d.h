// SPDX-License-Identifier: MIT
// A separate world in which copies of SoftBody2D nodes move, for the editor's live preview.
#pragma once

#include "core/dynamics/simulator.h"
#include "core/model/world_data.h"
#include "godot/nodes/body_cuts.h"

#include <godot_cpp/classes/ref_counted.hpp>
#include <godot_cpp/variant/packed_vector2_array.hpp>
#include <godot_cpp/variant/vector2.hpp>

#include <memory>
#include <vector>

namespace godot {

class SoftBody2D;

/// See doc_classes/SoftBodyPreview2D.xml. Nodes give copies of their bodies and are not touched after that; a point is
/// grabbed by pinning it, which is stable at any stiffness.
class SoftBodyPreview2D : public RefCounted {
	GDCLASS(SoftBodyPreview2D, RefCounted)

public:
	SoftBodyPreview2D();

	int add_body(SoftBody2D *p_body);
	int get_body_count() const { return int(bodies_.size()); }
	void add_floor(const Vector2 &p_position, const Vector2 &p_normal);
	void step(double p_delta);
	bool grab(const Vector2 &p_position, double p_max_distance);
	void drag(const Vector2 &p_position) { grab_target_ = p_position; }
	void release();
	bool is_grabbing() const { return grabbed_body_ >= 0; }
	Vector2 get_grabbed_position() const;
	PackedVector2Array get_polygon(int p_index) const;
	PackedVector2Array get_point_positions(int p_index) const;
	int get_source(int p_index) const;
	PackedVector2Array carry(int p_index, const PackedVector2Array &p_values) const;

protected:
	static void _bind_methods();

private:
	struct Copy {
		softbody::BodyId id;
		bool is_reversed = false; ///< whether the core holds the hull in reverse order
		int source = 0; ///< the copy of which it is a piece, or its own index
		bool is_source_reversed = false;
		softbody::TearRules rules;
		/// Of each point of a piece's outline, one for each corner of the source's polygon, in the core's order. Empty: all of it.
		std::vector<std::vector<double>> weights;
	};
	void tear(int p_index);
	const softbody::SoftBodyData *find(int p_index) const;
	void pull_grabbed_point(double p_delta);

	std::unique_ptr<softbody::WorldData> world_;
	std::unique_ptr<softbody::Simulator> simulator_;
	std::vector<Copy> bodies_;
	int grabbed_body_ = -1;
	uint32_t grabbed_point_ = 0; ///< in the core's order
	Vector2 grab_target_;
};

} // namespace godot
