// SPDX-License-Identifier: MIT
// The node that ties a SoftBody2D to another one, to any other node, or to the world.
#pragma once

#include "core/base/value_range.h"
#include "core/model/joint.h"
#include "godot/resources/property_binding.h"
#include "godot/resources/unfit_values.h"
#include "godot/server/stepped_node.h"

#include <godot_cpp/classes/node2d.hpp>
#include <godot_cpp/variant/node_path.hpp>
#include <godot_cpp/variant/packed_string_array.hpp>
#include <godot_cpp/variant/rid.hpp>

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace softbody {
class SoftBodySpace2D;
}

namespace godot {

class SoftBody2D;

/// Like Godot's Joint2D: two node paths, and the place of the node says where the joint is. Holds the joint of the core for
/// as long as both ends are in one space. See doc_classes/SoftBodyJoint2D.xml.
class SoftBodyJoint2D : public Node2D, public softbody::SteppedJoint {
	GDCLASS(SoftBodyJoint2D, Node2D)

public:
	~SoftBodyJoint2D();

	/// The path of one end: 0 is a, 1 is b.
	template <int END>
	void set_node(const NodePath &p_path);
	template <int END>
	NodePath get_node() const { return paths_[END]; }
	template <double SoftBodyJoint2D::*VALUE>
	void set_number(double p_value);
	template <double SoftBodyJoint2D::*VALUE>
	double get_number() const { return this->*VALUE; }
	void set_rigid(bool p_rigid);
	bool is_rigid() const { return rigid_; }
	void set_disable_collision(bool p_disable) { disable_collision_ = p_disable; }
	bool is_collision_disabled() const { return disable_collision_; }

	bool is_broken() const { return broken_; }
	void mend();
	/// Where the ends are now, in the world.
	template <int END>
	Vector2 get_anchor() const { return place_of(ends_[END]); }

	PackedStringArray get_warnings() const;
	PackedStringArray _get_configuration_warnings() const override { return get_warnings(); }

	// For the space.
	softbody::JointId get_joint_id() const override { return id_; }
	RID get_rigid_body() const override;
	void prepare_step() override;
	void note_break(softbody::StepSignals &r_signals) override;
	void follow_cut(uint64_t p_cut, uint64_t p_node, const softbody::SoftBodyData &p_whole, std::span<const uint64_t> p_pieces) override;
	void undo_cuts(uint64_t p_first_cut, uint64_t p_node) override;
	void write_state(softbody::StateWriter &r_to) const override;
	softbody::Status read_state(softbody::StateReader &r_from, bool p_is_foreign, bool p_takes) override;
	void note_restored() override;

protected:
	static void _bind_methods();
	void _notification(int p_what);
	bool _set(const StringName &p_name, const Variant &p_value) {
		return unfit_.set(*this, get_class_static(), p_name, p_value);
	}
	bool _get(const StringName &p_name, Variant &r_value) const { return unfit_.get(p_name, r_value); }
	void _get_property_list(List<PropertyInfo> *r_list) const { unfit_.append_to(r_list); }

private:
	/// Of one end, from when the joint was first made.
	struct End {
		uint64_t node = 0; ///< instance id; 0 is the world
		softbody::JointAnchor anchor; ///< without the soft body's id, which is another one each time it enters the tree
		Vector2 position; ///< in the frame of a node that is no soft body; in the world without a node
	};

	/// What it remembers besides the core's joint.
	struct State {
		uint64_t node = 0; ///< its instance id
		softbody::JointId id;
		double bound_length = 0;
		bool broken = false;
		bool is_bound = false; ///< whether the ends have been found
		End ends[2];
	};

	/// An end as it was before a cut of its body.
	struct FormerEnd {
		uint64_t cut = 0; ///< number of the cut
		uint64_t node = 0; ///< instance id
		int index = 0;
		std::optional<End> end; ///< nothing if it had not been found yet
	};

	template <class Archive>
	static void visit_state(State &r_state, Archive &r_archive);
	/// The end at that path, or nothing while it is not there.
	std::optional<End> find_end(const NodePath &p_path) const;
	/// The end's anchor as it is now, or nothing while its node is not in this space.
	std::optional<softbody::JointAnchor> present_anchor(const End &p_end) const;
	Vector2 place_of(const std::optional<End> &p_end) const;
	/// Binds a number that is refused out of this range.
	template <double SoftBodyJoint2D::*VALUE>
	static void bind_number(const char *p_name, const softbody::ValueRange &p_range, const char *p_hint_string);
	void enter_space();
	void leave_space();
	String missing_end(int p_end) const;
	void note_missing_end(bool p_has_first);
	void forget_ends();
	void update_exception(bool p_joins);
	softbody::Joint make_joint(const softbody::JointAnchor &p_first, const softbody::JointAnchor &p_second) const;

	softbody::UnfitValues unfit_;
	NodePath paths_[2];
	double length_ = -1;
	bool rigid_ = true;
	double stiffness_ = 100;
	double damping_ = 0;
	double break_force_ = 0;
	bool disable_collision_ = true;

	softbody::SoftBodySpace2D *space_ = nullptr;
	softbody::JointId id_;
	std::optional<End> ends_[2];
	std::vector<FormerEnd> former_ends_; ///< the latest last
	double bound_length_ = 0; ///< distance of the ends when they were found
	softbody::Joint known_; ///< as the core has it
	std::pair<uint64_t, uint64_t> excepted_{ 0, 0 }; ///< instance ids of the soft body and of what it passes through
	bool broken_ = false;
	int missed_ticks_ = 0; ///< that an end was not there, since it was named
	bool complained_ = false; ///< about a refused joint, until something changes
};

} // namespace godot
