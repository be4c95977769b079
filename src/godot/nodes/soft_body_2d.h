// SPDX-License-Identifier: MIT
// The node: a soft body that lives, collides and is drawn in a 2D scene.
#pragma once

#include "core/base/error.h"
#include "core/creator/soft_body_creator.h"
#include "core/model/body_frame.h"
#include "core/model/contact.h"
#include "core/model/soft_body_data.h"
#include "core/model/world_data.h"
#include "godot/drawing/body_interpolation.h"
#include "godot/drawing/debug_drawing.h"
#include "godot/drawing/drawing_frame.h"
#include "godot/drawing/soft_body_skin.h"
#include "godot/resources/soft_body_material_2d.h"
#include "godot/resources/unfit_values.h"
#include "godot/server/stepped_node.h"
#include "godot/surroundings/hull_proxy.h"

#include <godot_cpp/classes/node2d.hpp>
#include <godot_cpp/classes/physics_material.hpp>
#include <godot_cpp/classes/texture2d.hpp>
#include <godot_cpp/templates/hash_map.hpp>
#include <godot_cpp/variant/dictionary.hpp>
#include <godot_cpp/variant/packed_byte_array.hpp>
#include <godot_cpp/variant/packed_float32_array.hpp>
#include <godot_cpp/variant/packed_int32_array.hpp>
#include <godot_cpp/variant/packed_string_array.hpp>
#include <godot_cpp/variant/node_path.hpp>
#include <godot_cpp/variant/packed_vector2_array.hpp>
#include <godot_cpp/variant/typed_array.hpp>
#include <godot_cpp/variant/vector2i.hpp>

#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace softbody {
class SoftBodySpace2D;
}

namespace godot {

/// See doc_classes/SoftBody2D.xml for what each property means to a user; this comment says how the
/// node is built. Its properties describe a body; the body itself (`softbody::SoftBodyData`) lives in
/// the world of the node's space while the node is in the tree, and in `stored_body_` while it is not,
/// so that re-parenting keeps its motion. Point indices of the public interface follow `polygon`; the
/// core may hold the hull reversed (`polygon_reversed_`), and `core_index` translates.
class SoftBody2D : public Node2D, public softbody::SteppedNode {
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

	/// What makes the body elastic. Those after NETWORK are softbody::ElasticModel, in its order.
	enum ElasticModel {
		ELASTIC_MODEL_AUTOMATIC,
		ELASTIC_MODEL_NETWORK,
		ELASTIC_MODEL_SPRINGS,
		ELASTIC_MODEL_SPRINGS_AND_SHAPE,
		ELASTIC_MODEL_SPRINGS_SHAPE_AND_AREA,
		ELASTIC_MODEL_MODES,
		ELASTIC_MODEL_TRIANGLES,
	};
	static constexpr int ELASTIC_MODEL_COUNT = ELASTIC_MODEL_TRIANGLES + 1;

	/// As RigidBody2D.DampMode.
	enum DampMode {
		DAMP_MODE_COMBINE,
		DAMP_MODE_REPLACE,
	};

	/// As CollisionObject2D.DisableMode.
	enum DisableMode {
		DISABLE_MODE_REMOVE,
		DISABLE_MODE_MAKE_STATIC,
		DISABLE_MODE_KEEP_ACTIVE,
	};

	/// What becomes of a body whose motion is no longer finite.
	enum FailureMode {
		FAILURE_MODE_RESET,
		FAILURE_MODE_FREEZE,
	};
	/// Off and on are what the property was before it could choose: false and true.
	enum SelfCollision {
		SELF_COLLISION_OFF,
		SELF_COLLISION_ON,
		SELF_COLLISION_AUTOMATIC,
	};

	SoftBody2D();
	~SoftBody2D();

	void set_polygon(const PackedVector2Array &p_polygon);
	PackedVector2Array get_polygon() const { return polygon_; }
	void set_mass(double p_mass);
	double get_mass() const { return mass_; }
	double get_total_mass() const { return mass_in_use(); }
	void set_center_point(bool p_center_point);
	bool has_center_point() const { return center_point_; }
	template <double softbody::MaterialValues::*VALUE>
	void set_material_value(double p_value) {
		set_own_material_value(softbody::material_field(VALUE), p_value);
	}
	template <double softbody::MaterialValues::*VALUE>
	double get_material_value() const {
		return own_material_.*VALUE;
	}
	void set_preset(SoftBodyMaterial2D::Preset p_preset);
	SoftBodyMaterial2D::Preset get_preset() const;
	void set_physics_material_override(const Ref<PhysicsMaterial> &p_material);
	Ref<PhysicsMaterial> get_physics_material_override() const { return physics_material_override_; }
	void set_network_values_set(bool p_set);
	void clear_network_values() { set_network_values_set(false); }
	bool has_network_values() const { return own_material_.has_network_values; }
	void set_elastic_model(ElasticModel p_model);
	ElasticModel get_elastic_model() const { return elastic_model_; }
	ElasticModel get_elastic_model_in_use() const;
	void set_least_area(double p_share);
	double get_least_area() const { return least_area_; }
	void set_least_stretch(double p_share);
	double get_least_stretch() const { return least_stretch_; }
	void set_most_stretch(double p_share);
	double get_most_stretch() const { return most_stretch_; }
	void set_soft_body_material(const Ref<SoftBodyMaterial2D> &p_material);
	Ref<SoftBodyMaterial2D> get_soft_body_material() const { return material_; }
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
	void set_collision_layer_value(int p_layer_number, bool p_value);
	bool get_collision_layer_value(int p_layer_number) const;
	void set_collision_mask_value(int p_layer_number, bool p_value);
	bool get_collision_mask_value(int p_layer_number) const;
	void set_self_collision(SelfCollision p_self_collision);
	SelfCollision get_self_collision() const { return self_collision_; }
	/// Whether it is in use.
	bool has_self_collision() const;

	// What the engine sees: soft_body_2d_proxy.cpp.
	void set_collision_proxy_enabled(bool p_enabled);
	bool is_collision_proxy_enabled() const { return collision_proxy_enabled_; }
	void set_collision_proxy_margin(double p_margin);
	double get_collision_proxy_margin() const { return collision_proxy_margin_; }
	RID get_rid() const;
	void add_collision_exception_with(Node *p_body);
	void remove_collision_exception_with(Node *p_body);
	TypedArray<Node2D> get_collision_exceptions() const;

	// Damping: soft_body_2d_damping.cpp.
	void set_linear_damp_mode(DampMode p_mode);
	DampMode get_linear_damp_mode() const { return linear_damp_mode_; }
	void set_linear_damp(double p_damp);
	double get_linear_damp() const { return linear_damp_; }
	void set_angular_damp_mode(DampMode p_mode);
	DampMode get_angular_damp_mode() const { return angular_damp_mode_; }
	void set_angular_damp(double p_damp);
	double get_angular_damp() const { return angular_damp_; }

	// Drawing.
	enum OutlineTextureMode {
		OUTLINE_TEXTURE_TILE,
		OUTLINE_TEXTURE_STRETCH,
	};
	void set_color(const Color &p_color);
	Color get_color() const { return skin_.style().color; }
	void set_vertex_colors(const PackedColorArray &p_colors);
	PackedColorArray get_vertex_colors() const { return skin_.style().vertex_colors; }
	void set_antialiased(bool p_antialiased);
	bool is_antialiased() const { return skin_.style().antialiased; }
	void set_smooth(bool p_smooth);
	bool is_smooth() const { return skin_.style().smooth; }
	void set_texture(const Ref<Texture2D> &p_texture);
	Ref<Texture2D> get_texture() const { return skin_.style().texture; }
	void set_texture_offset(const Vector2 &p_offset);
	Vector2 get_texture_offset() const { return skin_.style().texture_offset; }
	void set_texture_scale(const Vector2 &p_scale);
	Vector2 get_texture_scale() const { return skin_.style().texture_scale; }
	void set_texture_rotation(double p_rotation);
	double get_texture_rotation() const { return skin_.style().texture_rotation; }
	void set_uv(const PackedVector2Array &p_uv);
	PackedVector2Array get_uv() const { return skin_.style().uv; }
	void set_outline_width(double p_width);
	double get_outline_width() const { return skin_.style().outline_width; }
	void set_outline_color(const Color &p_color);
	Color get_outline_color() const { return skin_.style().outline_color; }
	void set_outline_texture(const Ref<Texture2D> &p_texture);
	Ref<Texture2D> get_outline_texture() const { return skin_.style().outline_texture; }
	void set_outline_texture_mode(OutlineTextureMode p_mode);
	OutlineTextureMode get_outline_texture_mode() const;
	PackedVector2Array get_interpolated_polygon(double p_fraction) const;
	Transform2D get_interpolated_transform(double p_fraction) const;

	/// What keeps these points from being a polygon of a body, as the setter would say it; empty when nothing does.
	static String get_polygon_problem(const PackedVector2Array &p_polygon);
	static PackedVector2Array make_circle_polygon(double p_radius, int p_point_count);
	static PackedVector2Array make_box_polygon(const Vector2 &p_size, double p_spacing);
	static PackedVector2Array make_capsule_polygon(double p_radius, double p_height, double p_spacing);

	// Structure: soft_body_2d_structure.cpp.
	void set_inner_points(const PackedVector2Array &p_points);
	PackedVector2Array get_inner_points() const { return inner_points_; }
	void set_springs(const PackedInt32Array &p_springs);
	PackedInt32Array get_springs() const { return springs_; }
	void set_spring_stiffness_scales(const PackedFloat32Array &p_scales);
	PackedFloat32Array get_spring_stiffness_scales() const { return spring_stiffness_scales_; }
	void set_spring_damping_scales(const PackedFloat32Array &p_scales);
	PackedFloat32Array get_spring_damping_scales() const { return spring_damping_scales_; }
	void set_spring_length_scales(const PackedFloat32Array &p_scales);
	PackedFloat32Array get_spring_length_scales() const { return spring_length_scales_; }
	int get_spring_count() const;
	Vector2i get_spring_points(int p_index) const;
	PackedInt32Array get_all_springs() const;
	double get_spring_stiffness(int p_index) const;
	double get_spring_damping(int p_index) const;
	double get_spring_rest_length(int p_index) const;
	double get_spring_length(int p_index) const;
	double get_spring_strain(int p_index) const;
	void set_spring_stiffness_scale(int p_index, double p_scale);
	void set_spring_damping_scale(int p_index, double p_scale);
	void set_spring_length_scale(int p_index, double p_scale);

	// Contacts: soft_body_2d_contacts.cpp.
	void set_contact_monitor(bool p_enabled);
	bool is_contact_monitor_enabled() const { return contact_monitor_; }
	void set_max_contacts_reported(int p_amount);
	int get_max_contacts_reported() const { return max_contacts_reported_; }
	int get_contact_count() const { return int(contacts_.size()); }
	Vector2 get_contact_position(int p_index) const;
	Vector2 get_contact_normal(int p_index) const;
	double get_contact_impulse(int p_index) const;
	double get_contact_depth(int p_index) const;
	int get_contact_point(int p_index) const;
	Object *get_contact_collider(int p_index) const;
	TypedArray<Node2D> get_colliding_bodies() const;

	// State: soft_body_2d_state.cpp.
	PackedByteArray get_state() const;
	Error set_state(const PackedByteArray &p_state);

	// Sleep: soft_body_2d_sleep.cpp.
	void set_sleeping(bool p_sleeping);
	bool is_sleeping() const;
	void set_can_sleep(bool p_able);
	bool is_able_to_sleep() const { return can_sleep_; }
	void set_failure_mode(FailureMode p_mode);
	FailureMode get_failure_mode() const { return failure_mode_; }
	/// The core has put the body back, and frozen it if that is its mode: says so, and follows.
	void set_disable_mode(DisableMode p_mode);
	DisableMode get_disable_mode() const { return disable_mode_; }
	void set_simulate_off_screen(bool p_enabled);
	bool is_simulating_off_screen() const { return simulate_off_screen_; }
	void set_freeze_enabled(bool p_freeze);
	bool is_freeze_enabled() const { return freeze_; }

	int get_point_count() const;
	PackedVector2Array get_point_positions() const;
	PackedVector2Array get_point_velocities() const;
	int get_nearest_point(const Vector2 &p_global_position) const;
	bool has_point(const Vector2 &p_global_position) const;
	void apply_point_force(int p_index, const Vector2 &p_force);
	void apply_point_impulse(int p_index, const Vector2 &p_impulse);
	void apply_point_forces(const PackedVector2Array &p_forces);
	PackedVector2Array get_point_forces() const;
	void set_point_position(int p_index, const Vector2 &p_position);
	void set_point_positions(const PackedVector2Array &p_positions);
	void set_point_velocity(int p_index, const Vector2 &p_velocity);
	void set_point_velocities(const PackedVector2Array &p_velocities);
	double get_area() const;
	double get_rest_area() const;
	double get_penetration() const override;

	// Motion: soft_body_2d_motion.cpp.
	void set_linear_velocity(const Vector2 &p_velocity);
	Vector2 get_linear_velocity() const;
	void set_angular_velocity(double p_velocity);
	double get_angular_velocity() const;
	void apply_impulse(const Vector2 &p_impulse, const Vector2 &p_position);
	void apply_central_impulse(const Vector2 &p_impulse);
	void apply_torque_impulse(double p_torque);
	void apply_force(const Vector2 &p_force, const Vector2 &p_position);
	void apply_central_force(const Vector2 &p_force);
	void apply_torque(double p_torque);
	void set_constant_force(const Vector2 &p_force);
	Vector2 get_constant_force() const { return constant_force_; }
	void set_constant_torque(double p_torque);
	double get_constant_torque() const { return constant_torque_; }
	void add_constant_central_force(const Vector2 &p_force);
	void add_constant_force(const Vector2 &p_force, const Vector2 &p_position);
	void add_constant_torque(double p_torque);
	Vector2 get_center_of_mass_position() const;
	Vector2 get_center_of_mass() const;
	double get_inertia() const;
	double get_kinetic_energy() const;
	void teleport(const Transform2D &p_transform);
	void reset();

	// What will become of it: soft_body_2d_report.cpp.
	Dictionary get_substep_plan() const;
	Dictionary get_stability_report(double p_time_limit_msec) const;
	PackedStringArray get_warnings() const;
	PackedStringArray _get_configuration_warnings() const override { return get_warnings(); }

	// Pins, in soft_body_2d_pins.cpp.
	void set_pinned_points(const PackedInt32Array &p_points);
	PackedInt32Array get_pinned_points() const { return pinned_points_; }
	void set_pin_targets(const TypedArray<NodePath> &p_targets);
	TypedArray<NodePath> get_pin_targets() const { return pin_targets_; }
	void set_point_pinned(int p_index, bool p_pinned, const NodePath &p_target);
	bool is_point_pinned(int p_index) const;
	NodePath get_pin_target(int p_index) const;

	// For nodes that hold on to this one.
	softbody::SoftBodySpace2D *get_space() const { return space_; }
	/// Null before it has entered the tree.
	const softbody::SoftBodyData *get_body() const { return body(); }
	/// Another number whenever the rest shape is another.
	uint64_t get_rest_version() const { return rest_version_; }
	/// All points at rest in the node's frame, in the core's order.
	std::span<const softbody::Vec2> get_rest_positions() const { return skin_.rest(); }
	/// The body's points in the node's frame at that fraction, in the core's order; a rest shape without a body. Valid
	/// until the next call for any node.
	std::span<const softbody::Vec2> local_points(double p_fraction) const;
	/// Whether it is drawn where the last tick left it, not between two.
	bool is_drawn_at_tick() const;

	/// A body like this one in its rest shape where the node is, with its pins: for trials and previews, in any world.
	softbody::Result<softbody::SoftBodyData> make_copy() const;
	/// What the project gives every world, areas left aside [px/s²].
	static softbody::Vec2 project_gravity();

	// For the simulation.
	uint64_t instance_id() const override { return get_instance_id(); }
	softbody::BodyId get_body_id() const override { return body_id_; }
	/// "SoftBody2D 'Jelly' (/root/Main/Jelly)": how messages name this node.
	String describe() const;
	void note_project_settings() override { apply_settings(); }
	void prepare_step() override;
	void feel_areas(const softbody::AreaEffects &p_space) override;
	void stir_proxy() override;
	softbody::HullProxy &proxy() override { return proxy_; }
	void note_failure(softbody::StepSignals &r_signals) override;
	void finish_step() override;
	bool follow_with_proxy(bool p_may_detail) override;
	void take_sleep(softbody::StepSignals &r_signals) override;
	bool watches_contacts() const override { return contact_monitor_; }
	void take_contacts(std::span<const softbody::Contact> p_contacts, std::span<const uint64_t> p_colliders,
			std::vector<uint64_t> p_touched, softbody::StepSignals &r_signals) override;
	bool is_idle() const override;
	bool draw_frame(const softbody::DrawingFrame &p_frame) override;
	/// For joints: the body passes through the object of this instance id, which is no soft body, until the id has been
	/// removed as often as it was added.
	void add_joined(uint64_t p_id);
	void remove_joined(uint64_t p_id);

protected:
	static void _bind_methods();
	void _notification(int p_what);
	void _validate_property(PropertyInfo &p_property) const;
	bool _set(const StringName &p_name, const Variant &p_value) {
		return set_former(p_name, p_value) || unfit_.set(*this, get_class_static(), p_name, p_value);
	}
	bool _get(const StringName &p_name, Variant &r_value) const {
		return get_former(p_name, r_value) || unfit_.get(p_name, r_value);
	}
	void _get_property_list(List<PropertyInfo> *r_list) const { unfit_.append_to(r_list); }

private:
	// Names of earlier versions, in soft_body_2d_former.cpp. True if the property had that name.
	bool set_former(const StringName &p_name, const Variant &p_value);
	bool get_former(const StringName &p_name, Variant &r_value) const;
	void set_former_surface(const StringName &p_name, const Variant &p_value);

	static void bind_properties();
	static void bind_polygon();
	static void bind_mass();
	static void bind_structure();
	static void bind_contacts();
	static void bind_sleep();
	static void bind_state();
	static void bind_motion();
	static void bind_points();
	static void bind_material();
	static void bind_surface();
	static void bind_network();
	static void bind_springs();
	static void bind_limits();
	static void bind_damping();
	static void bind_collision();
	static void bind_proxy();
	static void bind_solver();
	static void bind_report();
	static void bind_drawing();
	static void bind_pins();

	static constexpr int DEFAULT_MAX_CONTACTS = 16;

	/// A model of the elasticity and why: "chosen", "own_springs", "painted_springs", "network_values", "material", or "unfit"
	/// where the network takes the place of a model that the body cannot have.
	struct ModelChoice {
		ElasticModel model = ELASTIC_MODEL_MODES;
		const char *reason = "material";
	};

	static const char *const REASON_NETWORK_VALUES;

	/// Points and springs at one scale of the node. Its springs have stiffness and damping 1 times what is painted on them; how
	/// stiff they are is a setting.
	struct Design {
		std::shared_ptr<const softbody::SoftBodyShape> shape;
		Transform2D scale;
		double area = 0; ///< inside the hull at that scale [px²]
		double mass = 0; ///< [kg]
		ModelChoice wanted; ///< model by the node's properties
		ModelChoice used;
		softbody::Status model_problem; ///< why `used` is not `wanted`
		bool is_reversed = false; ///< see `polygon_reversed_`
		bool has_deep_dents = false; ///< see `softbody::has_deep_dents`
		PackedStringArray problems; ///< parts of the structure that do not fit the others and were left out
	};

	/// Friction and bounce as contacts use them.
	struct Surface {
		double friction = 0; ///< [1], >= 0
		double bounce = 0; ///< [1], 0..1
		bool rough = false;
		bool absorbent = false;
		/// Whether it has these values and is neither rough nor absorbent.
		bool is_plain(double p_friction, double p_bounce) const;
	};

	/// What a contact of the last step was, for scripts.
	struct ContactRecord {
		Vector2 point;
		Vector2 normal;
		double impulse = 0;
		double depth = 0;
		uint32_t core_point = 0;
		uint64_t collider = 0; ///< instance id
	};

	/// A callable of a bound method of this node that may be kept beyond the call. It is by name: the node outlives its code
	/// when the editor reloads the extension, and a `callable_mp` points into that code.
	Callable own_callable(const char *p_method) { return Callable(this, p_method); }
	bool accept(const StringName &p_property, const softbody::Status &p_status);
	bool accept_shape(const StringName &p_property);
	bool change(const StringName &p_property, double &r_member, double p_value, const softbody::Status &p_range);
	bool accept_values(const StringName &p_property);
	bool is_current(const Design &p_design) const;
	void set_own_material_value(const softbody::MaterialField &p_field, double p_value);
	bool take_over_own_values(const StringName &p_property, const softbody::MaterialValues &p_values);
	void take_over_material();
	void take_over_physics_material();
	/// Of `physics_material_override` where there is one, else of the material.
	Surface surface() const;
	static Ref<PhysicsMaterial> make_physics_material(const Surface &p_surface);
	const softbody::MaterialValues &material_values() const;
	ModelChoice choose_model() const;
	double mass_of_area(double p_area) const;
	double mass_in_use() const;
	softbody::Status apply_elasticity(const Design &p_design, softbody::BodySettings &r_settings) const;
	softbody::Result<softbody::BodySettings> make_settings(const Design &p_design) const;
	/// The structure at the scale of `p_transform`, or what is wrong with it. A draft has no elastic modes, which take some
	/// milliseconds: it serves to judge properties while a scene sets them one after the other.
	softbody::Result<Design> make_design(const Transform2D &p_transform, bool p_is_draft = false) const;
	softbody::Status check_elasticity(const Design &p_design) const;
	/// That of the body, or the one it would have; null if there can be none.
	const Design *design() const;
	Transform2D design_transform() const;
	template <class Value>
	bool change_structure(const StringName &p_property, Value &r_member, const Value &p_value, const softbody::Status &p_status);
	void set_scale_of_spring(const StringName &p_property, PackedFloat32Array &r_scales, int p_index, double p_scale,
			bool p_may_be_zero);
	const softbody::Spring2D *find_spring(int p_index) const;
	std::pair<double, double> spring_scales() const;
	void tell_structure_problems();
	void tell_network_once() const;
	static bool decided_by_network_values(const Design &p_design);
	void append_stability_warnings(const Design &p_design, PackedStringArray &r_warnings) const;
	const ContactRecord *find_contact(int p_index) const;
	struct Impact;
	static Impact impact_of(std::span<const softbody::Contact> p_contacts, std::span<const uint64_t> p_colliders, uint64_t p_collider);
	void watch_collider(Node *p_collider, bool p_watch);
	void emit_entered(uint64_t p_collider, const Impact &p_impact);
	void emit_exited(uint64_t p_collider);
	void on_collider_exiting(uint64_t p_collider);
	void forget_contacts();
	void take_over_pins();
	softbody::SoftBodyData *body();
	const softbody::SoftBodyData *body() const;
	/// The body after it has followed a transform that the user has just set.
	const softbody::SoftBodyData *followed_body() const;
	softbody::SoftBodyData *followed_body();
	std::size_t core_index(int p_index) const;
	/// The other way round, for a body or design that holds the hull so.
	int public_index(std::size_t p_core_index, bool p_reversed) const;
	bool check_index(int p_index) const;

	void enter_space();
	void leave_space();
	void rebuild_body(bool p_keeps_motion);
	/// Gives a body that has just been made the velocities that were set before.
	void start_first_motion();
	void apply_constant_forces();
	bool check_points(const char *p_what, const PackedVector2Array &p_values);
	/// The node goes to where its points have been put.
	void follow_body();
	void apply_shape();
	void apply_settings();
	void take_over_transform();
	void update_proxy_presence();
	/// The next tick does not leave the node out, though its body may rest.
	void note_change();
	void note_enabled();
	/// Whether its process mode lets it be stepped, and if not, its disable mode.
	bool takes_part() const;
	bool is_held_static() const { return !enabled_ && disable_mode_ == DISABLE_MODE_MAKE_STATIC; }
	void apply_freeze();
	void apply_exceptions();
	softbody::Real proxy_inset() const;
	Transform2D transform_at(const softbody::BodyFrame &p_frame) const;
	void update_topology();

	// Pins, in soft_body_2d_pins.cpp.
	struct Pin {
		uint64_t target = 0; ///< instance id, once it was found
		Vector2 place; ///< in the target's frame
	};
	void apply_pins();
	void follow_pin_targets();
	void append_pin_warnings(PackedStringArray &r_warnings) const;

	// Drawing, in soft_body_2d_drawing.cpp.
	void append_drawing_warnings(PackedStringArray &r_warnings) const;
	void replace_texture(Ref<Texture2D> softbody::SkinStyle::*p_member, const Ref<Texture2D> &p_texture);
	void follow_texture();
	void remake_skin();
	// Frames, in soft_body_2d_frame.cpp.
	void note_move_by_user(const Transform2D &p_from, const Transform2D &p_to);
	bool check_fraction(double &r_fraction) const;
	void draw();
	void place_canvas_item(double p_fraction);
	void update_seen_area();
	void draw_debug(double p_fraction);
	void enter_screen();
	void leave_screen() { on_screen_ = false; }
	bool is_off_screen() const;

	PackedVector2Array polygon_;
	PackedVector2Array inner_points_;
	PackedInt32Array springs_;
	PackedFloat32Array spring_stiffness_scales_;
	PackedFloat32Array spring_damping_scales_;
	PackedFloat32Array spring_length_scales_;
	double mass_ = 1;
	bool center_point_ = true;
	softbody::MaterialValues own_material_;
	Ref<SoftBodyMaterial2D> material_;
	Ref<PhysicsMaterial> physics_material_override_;
	Ref<PhysicsMaterial> former_surface_; ///< made for values that an old scene set under their former names
	std::optional<Surface> surface_override_; ///< of `physics_material_override` when its values last were finite
	ElasticModel elastic_model_ = ELASTIC_MODEL_AUTOMATIC;
	double least_area_ = 0.5;
	double least_stretch_ = 0.2;
	double most_stretch_ = 3;
	bool density_decides_ = false; ///< whether the density of the material makes the mass
	double gravity_scale_ = 1;
	Vector2 first_linear_velocity_; ///< of a body that is still to be made
	double first_angular_velocity_ = 0;
	Vector2 constant_force_;
	double constant_torque_ = 0;
	bool can_sleep_ = true;
	FailureMode failure_mode_ = FAILURE_MODE_RESET;
	DisableMode disable_mode_ = DISABLE_MODE_REMOVE;
	bool enabled_ = true; ///< whether its process mode, or the one that it inherits, is another than disabled
	bool simulate_off_screen_ = true;
	bool freeze_ = false;
	Integrator integrator_ = INTEGRATOR_AUTOMATIC;
	int substeps_ = 0;
	uint32_t collision_layer_ = 1;
	uint32_t collision_mask_ = 1;
	SelfCollision self_collision_ = SELF_COLLISION_AUTOMATIC;
	bool contact_monitor_ = false;
	int max_contacts_reported_ = DEFAULT_MAX_CONTACTS;
	bool collision_proxy_enabled_ = true;
	double collision_proxy_margin_ = -1;
	std::vector<uint64_t> collision_exceptions_; ///< instance ids
	std::vector<uint64_t> joined_; ///< instance ids of other bodies that joints keep from colliding with it, one a joint
	std::vector<uint64_t> excepted_by_; ///< instance ids of soft bodies that have this one among theirs
	DampMode linear_damp_mode_ = DAMP_MODE_COMBINE;
	double linear_damp_ = 0;
	DampMode angular_damp_mode_ = DAMP_MODE_COMBINE;
	double angular_damp_ = 0;
	softbody::UnfitValues unfit_;
	HashMap<StringName, String> refused_; ///< last refused value of a property, until a good one is set

	PackedInt32Array pinned_points_;
	TypedArray<NodePath> pin_targets_; ///< one a pinned point; missing ones are the world
	std::vector<Pin> pins_; ///< one a pinned point
	uint64_t rest_version_ = 0;

	softbody::SoftBodySpace2D *space_ = nullptr;
	softbody::BodyId body_id_;
	std::optional<softbody::SoftBodyData> stored_body_;
	Transform2D built_scale_; ///< scale and skew the shape was built at, without rotation and position
	Transform2D known_transform_; ///< global transform the node had when it last agreed with the body
	bool polygon_reversed_ = false;
	mutable std::optional<Design> design_; ///< forgotten when the structure changes
	PackedStringArray told_problems_;
	bool sleeping_ = false; ///< as last told, or as wanted of a body that is still to be made
	std::vector<ContactRecord> contacts_; ///< of the last step
	std::vector<uint64_t> touched_; ///< instance ids, sorted
	mutable softbody::HullProxy proxy_; ///< makes its RID when that is asked for
	int engine_steps_ = 0; ///< that the engine can have made since the proxy entered its space
	bool knows_areas_ = false; ///< whether the body has been told what areas do to it
	bool moving_ = false; ///< whether the last tick stepped the body
	bool has_stopped_ = false; ///< whether the tick before it did

	softbody::SoftBodySkin skin_;
	softbody::BodyInterpolation interpolation_;
	std::unique_ptr<softbody::DebugDrawing> debug_drawing_; ///< while collision shapes are visible
	softbody::BodyView *view_ = nullptr; ///< while in a space
	bool settled_ = false; ///< whether what is drawn holds until the body moves again
	bool area_checked_ = false; ///< since the last tick, of a body that no camera sees
	bool item_displaced_ = false; ///< whether the canvas item stands where the body is drawn, not where the node is
	bool on_screen_ = false; ///< as the rendering server saw it last
	int unseen_frames_ = 0; ///< in a row, counted no further than needed
	Rect2 skin_area_; ///< part of the node's plane in which the skin may move before `seen_area` is set anew
	Callable entered_screen_;
	Callable left_screen_;
};

} // namespace godot

VARIANT_ENUM_CAST(SoftBody2D::Integrator);
VARIANT_ENUM_CAST(SoftBody2D::ElasticModel);
VARIANT_ENUM_CAST(SoftBody2D::OutlineTextureMode);
VARIANT_ENUM_CAST(SoftBody2D::DampMode);
VARIANT_ENUM_CAST(SoftBody2D::FailureMode);
VARIANT_ENUM_CAST(SoftBody2D::DisableMode);
VARIANT_ENUM_CAST(SoftBody2D::SelfCollision);
