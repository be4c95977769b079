// SPDX-License-Identifier: MIT
// The node that makes an area of water or wind.
#pragma once

#include "core/dynamics/fluid_forces.h"
#include "godot/resources/unfit_values.h"
#include "godot/server/stepped_node.h"

#include <godot_cpp/classes/area2d.hpp>
#include <godot_cpp/variant/packed_string_array.hpp>

#include <cstdint>
#include <vector>

namespace softbody {

class SoftBodySpace2D;

} // namespace softbody

namespace godot {

class SoftBody2D;

/// An Area2D whose shapes are filled with a fluid. Before each step of the soft bodies it adds forces to those inside. See doc_classes/SoftBodyFluid2D.xml.
class SoftBodyFluid2D : public Area2D, public softbody::SteppedFluid {
	GDCLASS(SoftBodyFluid2D, Area2D)

public:
	void set_density(double p_density) { set_checked("density", density_, p_density, "kg/m²"); }
	double get_density() const { return density_; }
	void set_buoyancy_enabled(bool p_enabled) { buoyancy_enabled_ = p_enabled; }
	bool is_buoyancy_enabled() const { return buoyancy_enabled_; }
	void set_drag(double p_drag) { set_checked("drag", drag_, p_drag, ""); }
	double get_drag() const { return drag_; }
	void set_viscosity(double p_viscosity) { set_checked("viscosity", viscosity_, p_viscosity, "1/s"); }
	double get_viscosity() const { return viscosity_; }
	void set_flow(const Vector2 &p_flow);
	Vector2 get_flow() const { return flow_; }

	~SoftBodyFluid2D();

	bool look() override;
	uint64_t number() const override { return number_; }
	bool flows() const override { return flow_ != Vector2(); }
	bool reaches(const softbody::SoftBodyData &p_body, const softbody::Aabb &p_box) const override;
	void push(softbody::SteppedNode &r_node, double p_delta) override;

	PackedStringArray get_warnings() const;
	PackedStringArray _get_configuration_warnings() const override { return get_warnings(); }

protected:
	static void _bind_methods();
	void _notification(int p_what);
	bool _set(const StringName &p_name, const Variant &p_value) { return unfit_.set(*this, get_class_static(), p_name, p_value); }
	bool _get(const StringName &p_name, Variant &r_value) const { return unfit_.get(p_name, r_value); }
	void _get_property_list(List<PropertyInfo> *r_list) const { unfit_.append_to(r_list); }

private:
	void set_checked(const char *p_name, double &r_value, double p_value, const char *p_unit);
	String describe() const;
	void enter_space();
	void leave_space();

	softbody::UnfitValues unfit_;
	softbody::SoftBodySpace2D *space_ = nullptr; ///< null outside of the tree, and in the editor
	double density_ = 2; ///< [kg/m²]
	bool buoyancy_enabled_ = true;
	double drag_ = 1; ///< [1]
	double viscosity_ = 2; ///< [1/s]
	Vector2 flow_; ///< in the area's own directions [px/s]

	// What `look` has found.
	std::vector<std::vector<softbody::Vec2>> region_;
	softbody::Aabb reach_;
	softbody::Vec2 global_flow_; ///< [px/s]
	uint64_t number_ = 0;
};

} // namespace godot
