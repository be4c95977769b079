// SPDX-License-Identifier: MIT
// The node: a soft body that lives, collides and is drawn in a 2D scene.
#pragma once

#include "core/base/error.h"
#include "core/model/soft_body_data.h"
#include "core/model/world_data.h"
#include "godot/surroundings/area_effects.h"
#include "godot/surroundings/hull_proxy.h"

#include <godot_cpp/classes/node2d.hpp>
#include <godot_cpp/classes/texture2d.hpp>
#include <godot_cpp/templates/hash_map.hpp>
#include <godot_cpp/templates/local_vector.hpp>
#include <godot_cpp/variant/dictionary.hpp>
#include <godot_cpp/variant/packed_int32_array.hpp>
#include <godot_cpp/variant/packed_string_array.hpp>
#include <godot_cpp/variant/packed_vector2_array.hpp>
#include <godot_cpp/variant/typed_array.hpp>

#include <optional>

namespace softbody {
class SoftBodySpace2D;
}

namespace godot {

/// See doc_classes/SoftBody2D.xml for what each property means to a user; this comment says how the
/// node is built. Its properties describe a body; the body itself (`softbody::SoftBodyData`) lives in
/// the world of the node's space while the node is in the tree, and in `stored_body_` while it is not,
/// so that re-parenting keeps its motion. Point indices of the public interface follow `hull`; the
/// core may hold the hull reversed (`hull_reversed_`), and `core_index` translates.
class SoftBody2D : public Node2D {
	GDCLASS(SoftBody2D, Node2D)

public:
	/// Same values as softbody::Integrator.
	enum Integrator {
		INTEGRATOR_AUTOMATIC,
		INTEGRATOR_EXPLICIT_EULER,
		INTEGRATOR_SEMI_IMPLICIT_EULER,
		INTEGRATOR_MIDPOINT,
		INTEGRATOR_HEUN,
		INTEGRATOR_RUNGE_KUTTA_4,
		INTEGRATOR_VELOCITY_VERLET,
		INTEGRATOR_XPBD,
	};

	/// As RigidBody2D.DampMode.
	enum DampMode {
		DAMP_MODE_COMBINE,
		DAMP_MODE_REPLACE,
	};

	SoftBody2D();
	~SoftBody2D();

	void set_hull(const PackedVector2Array &p_hull);
	PackedVector2Array get_hull() const { return hull_; }
	void set_mass(double p_mass);
	double get_mass() const { return mass_; }
	void set_stiffness(double p_stiffness);
	double get_stiffness() const { return stiffness_; }
	void set_damping(double p_damping);
	double get_damping() const { return damping_; }
	void set_center_point(bool p_center_point);
	bool has_center_point() const { return center_point_; }
	void set_pressure(double p_pressure);
	double get_pressure() const { return pressure_; }
	void set_inflation(double p_inflation);
	double get_inflation() const { return inflation_; }
	void set_friction(double p_friction);
	double get_friction() const { return friction_; }
	void set_bounce(double p_bounce);
	double get_bounce() const { return bounce_; }
	void set_rolling_resistance(double p_rolling_resistance);
	double get_rolling_resistance() const { return rolling_resistance_; }
	void set_shape_matching(double p_shape_matching);
	double get_shape_matching() const { return shape_matching_; }
	void set_shape_damping(double p_shape_damping);
	double get_shape_damping() const { return shape_damping_; }
	void set_gravity_scale(double p_gravity_scale);
	double get_gravity_scale() const { return gravity_scale_; }
	void set_integrator(Integrator p_integrator);
	Integrator get_integrator() const { return integrator_; }
	void set_substeps(int p_substeps);
	int get_substeps() const { return substeps_; }
	void set_collision_layer(uint32_t p_layer);
	uint32_t get_collision_layer() const { return collision_layer_; }
	void set_collision_mask(uint32_t p_mask);
	uint32_t get_collision_mask() const { return collision_mask_; }
	void set_collision_proxy_enabled(bool p_enabled);
	bool is_collision_proxy_enabled() const { return collision_proxy_enabled_; }
	void set_collision_proxy_margin(double p_margin);
	double get_collision_proxy_margin() const { return collision_proxy_margin_; }
	RID get_rid() const;
	void add_collision_exception_with(Node *p_body);
	void remove_collision_exception_with(Node *p_body);
	TypedArray<Node2D> get_collision_exceptions() const;
	void set_linear_damp_mode(DampMode p_mode);
	DampMode get_linear_damp_mode() const { return linear_damp_mode_; }
	void set_linear_damp(double p_damp);
	double get_linear_damp() const { return linear_damp_; }
	void set_angular_damp_mode(DampMode p_mode);
	DampMode get_angular_damp_mode() const { return angular_damp_mode_; }
	void set_angular_damp(double p_damp);
	double get_angular_damp() const { return angular_damp_; }
	void set_color(const Color &p_color);
	Color get_color() const { return color_; }
	void set_texture(const Ref<Texture2D> &p_texture);
	Ref<Texture2D> get_texture() const { return texture_; }

	static PackedVector2Array make_circle_hull(double p_radius, int p_point_count);
	static PackedVector2Array make_box_hull(const Vector2 &p_size, double p_spacing);
	static PackedVector2Array make_capsule_hull(double p_radius, double p_height, double p_spacing);

	int get_point_count() const;
	PackedVector2Array get_point_positions() const;
	PackedVector2Array get_point_velocities() const;
	PackedVector2Array get_interpolated_hull(double p_fraction) const;
	int get_nearest_point(const Vector2 &p_global_position) const;
	bool has_point(const Vector2 &p_global_position) const;
	void apply_point_force(int p_index, const Vector2 &p_force);
	void apply_point_impulse(int p_index, const Vector2 &p_impulse);
	void apply_central_force(const Vector2 &p_force);
	void apply_central_impulse(const Vector2 &p_impulse);
	Vector2 get_center_of_mass_position() const;
	Vector2 get_linear_velocity() const;
	double get_angular_velocity() const;
	double get_area() const;
	double get_rest_area() const;
	double get_kinetic_energy() const;
	double get_penetration() const;
	Dictionary get_substep_plan() const;
	void reset();

	PackedStringArray get_warnings() const;
	PackedStringArray _get_configuration_warnings() const override { return get_warnings(); }

	// For the server.
	softbody::BodyId get_body_id() const { return body_id_; }
	/// Its place in the space's list of nodes.
	size_t get_space_index() const { return space_index_; }
	void set_space_index(size_t p_index) { space_index_ = p_index; }
	/// "SoftBody2D 'Jelly' (/root/Main/Jelly)": how messages name this node.
	String describe() const;
	/// Before the step: takes over a transform that the user set, and whether the node may process.
	void prepare_step();
	/// After the step: moves the node along and keeps what drawing interpolates.
	void finish_step();
	/// Before the step: takes over the gravity and damping of areas. `p_space` is what holds where no area is.
	void feel_areas(const softbody::AreaEffects &p_space, uint64_t p_tick);
	/// After the step: moves the proxy along. True when `flush_hull_proxies` must follow.
	bool follow_with_proxy(bool p_may_detail);
	softbody::HullProxy &proxy() { return proxy_; }

protected:
	static void _bind_methods();
	void _notification(int p_what);

private:
	static void bind_shape();
	static void bind_motion();
	static void bind_points();
	static void bind_material();
	static void bind_damping();
	static void bind_collision();
	static void bind_proxy();
	static void bind_solver();
	static void bind_drawing();

	/// One end of the interpolation: the body's frame, and its points in that frame.
	struct Pose {
		Transform2D transform;
		PackedVector2Array local_points; ///< core order
	};

	bool accept(const StringName &p_property, const softbody::Status &p_status);
	bool accept_shape(const StringName &p_property);
	bool change(const StringName &p_property, double &r_member, double p_value, const softbody::Status &p_range);
	softbody::BodySettings make_settings() const;
	/// The structure at the scale of `p_transform`, or what is wrong with it.
	softbody::Result<std::shared_ptr<const softbody::SoftBodyShape>> make_shape(const Transform2D &p_transform) const;
	softbody::SoftBodyData *body();
	const softbody::SoftBodyData *body() const;
	/// The body after it has followed a transform that the user has just set.
	const softbody::SoftBodyData *followed_body() const;
	softbody::SoftBodyData *followed_body();
	std::size_t core_index(int p_index) const;
	bool check_index(int p_index) const;

	void enter_space();
	void leave_space();
	void rebuild_body();
	void apply_shape();
	void apply_settings();
	void take_over_transform();
	void update_proxy_presence();
	void apply_collision_exception(Node *p_body, bool p_excepted);
	softbody::Real proxy_inset() const;
	Transform2D body_transform() const;
	Pose current_pose() const;
	void update_topology();

	PackedVector2Array interpolated_points(double p_fraction, const Transform2D &p_relative_to) const;
	void draw();

	PackedVector2Array hull_;
	double mass_ = 1;
	double stiffness_ = 100;
	double damping_ = 0.12;
	bool center_point_ = true;
	double pressure_ = 0;
	double inflation_ = 1;
	double friction_ = 0.4;
	double bounce_ = 0;
	double rolling_resistance_ = 0.03;
	double shape_matching_ = 0.4;
	double shape_damping_ = 0.25;
	double gravity_scale_ = 1;
	Integrator integrator_ = INTEGRATOR_AUTOMATIC;
	int substeps_ = 0;
	uint32_t collision_layer_ = 1;
	uint32_t collision_mask_ = 1;
	bool collision_proxy_enabled_ = true;
	double collision_proxy_margin_ = -1;
	LocalVector<uint64_t> collision_exceptions_; ///< instance ids
	DampMode linear_damp_mode_ = DAMP_MODE_COMBINE;
	double linear_damp_ = 0;
	DampMode angular_damp_mode_ = DAMP_MODE_COMBINE;
	double angular_damp_ = 0;
	Color color_ = Color(1, 1, 1);
	Ref<Texture2D> texture_;
	HashMap<StringName, String> refused_; ///< last refused value of a property, until a good one is set

	softbody::SoftBodySpace2D *space_ = nullptr;
	softbody::BodyId body_id_;
	size_t space_index_ = 0;
	std::optional<softbody::SoftBodyData> stored_body_;
	Transform2D built_scale_; ///< scale and skew the shape was built at, without rotation and position
	Transform2D known_transform_; ///< global transform the node had when it last agreed with the body
	bool hull_reversed_ = false;
	mutable softbody::HullProxy proxy_; ///< makes its RID when that is asked for
	int engine_steps_ = 0; ///< that the engine can have made since the proxy entered its space
	bool knows_areas_ = false; ///< whether the body has been told what areas do to it
	Pose previous_;
	Pose current_;
	bool moving_ = false; ///< whether the last tick stepped the body
	bool redraw_needed_ = true;

	PackedInt32Array triangles_;
	PackedVector2Array uvs_;
};

} // namespace godot

VARIANT_ENUM_CAST(SoftBody2D::Integrator);
VARIANT_ENUM_CAST(SoftBody2D::DampMode);
