// SPDX-License-Identifier: MIT
// The node: a soft body that lives, collides and is drawn in a 2D scene.
#pragma once

#include "core/base/error.h"
#include "core/model/body_frame.h"
#include "core/model/firmness.h"
#include "core/model/soft_body_data.h"
#include "core/model/world_data.h"
#include "godot/drawing/body_interpolation.h"
#include "godot/drawing/debug_drawing.h"
#include "godot/drawing/drawing_frame.h"
#include "godot/drawing/soft_body_skin.h"
#include "godot/nodes/body_design.h"
#include "godot/nodes/body_growth.h"
#include "godot/nodes/body_material.h"
#include "godot/nodes/body_picker.h"
#include "godot/nodes/body_pins.h"
#include "godot/nodes/body_properties.h"
#include "godot/nodes/body_structure.h"
#include "godot/nodes/collision_exceptions.h"
#include "godot/nodes/contact_reports.h"
#include "godot/nodes/cut_history.h"
#include "godot/nodes/fall_memory.h"
#include "godot/nodes/value_rule.h"
#include "godot/resources/property_binding.h"
#include "godot/resources/soft_body_material_2d.h"
#include "godot/resources/unfit_values.h"
#include "godot/server/stepped_node.h"
#include "godot/surroundings/hull_proxy.h"

#include <godot_cpp/classes/node2d.hpp>
#include <godot_cpp/templates/hash_map.hpp>
#include <godot_cpp/variant/dictionary.hpp>
#include <godot_cpp/variant/packed_string_array.hpp>
#include <godot_cpp/variant/packed_vector2_array.hpp>
#include <godot_cpp/variant/vector2i.hpp>

#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace softbody {
class BodyCuts;
struct RopePart;
class SoftBodySpace2D;
}

namespace godot {

/// See doc_classes/SoftBody2D.xml for what each property means to a user; this comment says how the node is built.
///
/// Parts of the node have classes of their own, which own their state, such as `BodyStructure`, `BodyMaterial`, `HullProxy` and
/// `SoftBodySkin`. `BodyProperties` are those that are one value each, and `set_value` judges them all.
///
/// The body itself (`softbody::SoftBodyData`) lives in the world of the node's space while the node is in the tree, and in
/// `stored_body_` while it is not, so that re-parenting keeps its motion. Point indices of the public interface follow the
/// simulated polygon; the core may hold it reversed (`polygon_reversed_`), and `core_index` translates.
class SoftBody2D : public Node2D, public softbody::SteppedNode, public softbody::BodyProperties {
	GDCLASS(SoftBody2D, Node2D)

public:
	SoftBody2D();
	~SoftBody2D();

	// Setters and getters of many properties.
	template <auto VALUE>
	void set_value(softbody::ValueOf<VALUE> p_value);
	template <auto VALUE>
	softbody::ValueOf<VALUE> get_value() const { return values_.*VALUE; }
	template <auto VALUE>
	void set_structure(softbody::ValueOf<VALUE> p_value);
	template <auto VALUE>
	softbody::ValueOf<VALUE> get_structure() const { return structure_.values().*VALUE; }
	template <auto VALUE>
	void set_detail(softbody::ValueOf<VALUE> p_value);
	template <auto VALUE>
	softbody::ValueOf<VALUE> get_detail() const { return structure_.detail().*VALUE; }
	template <auto VALUE>
	void set_style(softbody::ValueOf<VALUE> p_value);
	template <auto VALUE>
	softbody::ValueOf<VALUE> get_style() const { return skin_.style().*VALUE; }
	template <double softbody::MaterialValues::*VALUE>
	void set_material_value(double p_value) { set_own_material_value(softbody::material_fields()[softbody::index_of(VALUE)], p_value); }
	template <double softbody::MaterialValues::*VALUE>
	double get_material_value() const { return material_.values().*VALUE; }

	// What it is made of: soft_body_2d_material.cpp.
	void set_mass_mode(MassMode p_mode);
	MassMode get_mass_mode() const { return values_.mass_mode; }
	void set_mass(double p_mass);
	/// That of the body, whatever makes it.
	double get_mass() const;
	double get_youngs_modulus_in_use() const;
	void set_preset(SoftBodyMaterial2D::Preset p_preset);
	SoftBodyMaterial2D::Preset get_preset() const { return material_.preset(); }
	void set_physics_material_override(const Ref<PhysicsMaterial> &p_material);
	Ref<PhysicsMaterial> get_physics_material_override() const { return material_.surface_override(); }
	void set_network_values_set(bool p_set);
	void clear_network_values() { set_network_values_set(false); }
	bool has_network_values() const { return material_.values().has_network_values; }
	ElasticModel get_elastic_model_in_use() const;
	void set_soft_body_material(const Ref<SoftBodyMaterial2D> &p_material);
	Ref<SoftBodyMaterial2D> get_soft_body_material() const { return material_.shared(); }
	Ref<SoftBodyMaterial2D> get_soft_body_material_in_use();

	// What it collides with: soft_body_2d_collision.cpp.
	void set_collision_layer_value(int p_layer_number, bool p_value);
	bool get_collision_layer_value(int p_layer_number) const;
	void set_collision_mask_value(int p_layer_number, bool p_value);
	bool get_collision_mask_value(int p_layer_number) const;
	/// Whether it is in use.
	bool has_self_collision() const;
	RID get_rid() const { return proxy_.rid(); }
	void add_collision_exception_with(Node *p_body);
	void remove_collision_exception_with(Node *p_body);
	TypedArray<Node2D> get_collision_exceptions() const;

	// Looks: soft_body_2d_drawing.cpp.
	Look get_look_in_use() const { return skin_.is_soft() ? LOOK_SOFT : LOOK_PLAIN; }
	Color get_color_in_use() const { return skin_.color_in_use(); }
	PackedVector2Array get_interpolated_polygon(double p_fraction) const;
	TypedArray<PackedVector2Array> get_interpolated_holes(double p_fraction) const;
	Transform2D get_interpolated_transform(double p_fraction) const;

	// Structure: soft_body_2d_structure.cpp.
	PackedVector2Array get_polygon() const { return structure_.values().polygon; }
	void set_holes(const TypedArray<PackedVector2Array> &p_holes);
	TypedArray<PackedVector2Array> get_holes() const;
	static String get_holes_problem(const TypedArray<PackedVector2Array> &p_holes, const PackedVector2Array &p_polygon);
	/// What keeps these points from being a polygon of a body, as the setter would say it; empty when nothing does.
	static String get_polygon_problem(const PackedVector2Array &p_polygon);
	static PackedVector2Array make_circle_polygon(double p_radius, int p_point_count);
	static PackedVector2Array make_box_polygon(const Vector2 &p_size, double p_spacing);
	static PackedVector2Array make_capsule_polygon(double p_radius, double p_height, double p_spacing);
	PackedVector2Array get_simulated_polygon() const { return structure_.hull(); }
	Dictionary get_detail_report() const;
	int get_spring_count() const;
	Vector2i get_spring_points(int p_index) const;
	PackedInt32Array get_all_springs() const;
	double get_spring_stiffness(int p_index) const;
	double get_spring_damping(int p_index) const;
	double get_spring_rest_length(int p_index) const;
	double get_spring_length(int p_index) const;
	double get_spring_strain(int p_index) const;
	/// Sets the factor of one spring.
	template <auto VALUE>
	void set_scale_of_spring(int p_index, double p_scale);

	// Contacts: soft_body_2d_collision.cpp.
	void set_contact_monitor(bool p_enabled);
	bool is_contact_monitor_enabled() const { return values_.contact_monitor; }
	int get_contact_count() const { return int(contacts_.records().size()); }
	template <auto VALUE>
	softbody::ValueOf<VALUE> get_contact_value(int p_index) const;
	int get_contact_point(int p_index) const;
	Object *get_contact_collider(int p_index) const;
	TypedArray<Node2D> get_colliding_bodies() const;

	// Sleep: soft_body_2d_sleep.cpp.
	void set_sleeping(bool p_sleeping);
	bool is_sleeping() const;
	void set_freeze_enabled(bool p_freeze);
	bool is_freeze_enabled() const { return freeze_; }

	// Points: soft_body_2d_points.cpp.
	int get_point_count() const;
	PackedVector2Array get_point_positions() const;
	PackedVector2Array get_point_velocities() const;
	int get_nearest_point(const Vector2 &p_global_position) const;
	bool has_point(const Vector2 &p_global_position) const;
	void apply_point_force(int p_index, const Vector2 &p_force);
	void apply_point_impulse(int p_index, const Vector2 &p_impulse);
	void apply_point_forces(const PackedVector2Array &p_forces);
	void push_by_fluid(const PackedVector2Array &p_forces, bool p_flows); ///< In the coming step, one a point; a flow keeps it awake.
	PackedVector2Array get_point_forces() const;
	void set_point_position(int p_index, const Vector2 &p_position);
	void set_point_positions(const PackedVector2Array &p_positions);
	void set_point_velocity(int p_index, const Vector2 &p_velocity);
	void set_point_velocities(const PackedVector2Array &p_velocities);
	double get_area() const;
	double get_rest_area() const;
	double get_penetration() const override;
	PackedByteArray get_state() const;
	Error set_state(const PackedByteArray &p_state);

	// Cuts: soft_body_2d_cuts.cpp.
	TypedArray<SoftBody2D> cut(const Vector2 &p_from, const Vector2 &p_to);
	TypedArray<SoftBody2D> cut_polyline(const PackedVector2Array &p_points);
	TypedArray<PackedVector2Array> preview_cut(const PackedVector2Array &p_points) const;
	String get_cut_problem(const PackedVector2Array &p_points) const;

	// Dents: soft_body_2d_dents.cpp.
	void set_dents(const PackedVector2Array &p_dents);
	PackedVector2Array get_dents() const;
	double get_dent() const;
	void reset_dents();

	// Motion: soft_body_2d_motion.cpp.
	void set_linear_velocity(const Vector2 &p_velocity);
	Vector2 get_linear_velocity() const;
	void set_axis_velocity(const Vector2 &p_axis_velocity);
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
	Vector2 get_gravity() const;
	void teleport(const Transform2D &p_transform);
	void reset();

	// What will become of it: soft_body_2d_report.cpp.
	Dictionary get_substep_plan() const;
	Dictionary get_stability_report(double p_time_limit_msec) const;
	PackedStringArray get_warnings() const;
	PackedStringArray _get_configuration_warnings() const override { return get_warnings(); }

	// Pins: soft_body_2d_points.cpp.
	void set_pinned_points(const PackedInt32Array &p_points);
	PackedInt32Array get_pinned_points() const { return pins_.points(); }
	void set_pin_targets(const TypedArray<NodePath> &p_targets);
	TypedArray<NodePath> get_pin_targets() const { return pins_.targets(); }
	void set_point_pinned(int p_index, bool p_pinned, const NodePath &p_target);
	bool is_point_pinned(int p_index) const { return pins_.has(p_index); }
	NodePath get_pin_target(int p_index) const { return pins_.target_of(p_index); }

	// For nodes that hold on to this one.
	softbody::SoftBodySpace2D *get_space() const { return space_; }
	const softbody::SoftBodyData *get_body() const { return body(); } ///< null before it has entered the tree
	uint64_t get_rest_version() const { return rest_version_; } ///< another whenever the rest shape is another
	/// All points at rest in the node's frame, in the core's order.
	std::span<const softbody::Vec2> get_rest_positions() const { return rest_points_; }
	/// The body's points in the node's frame at that fraction, in the core's order; at rest without a body. Valid until the next call.
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
	String describe() const override;
	void note_project_settings() override { apply_settings(); }
	void prepare_step(double p_delta) override;
	void feel_areas(const softbody::AreaEffects &p_space, bool p_engine_has_stepped) override;
	void stir_proxy() override;
	softbody::HullProxy &proxy() override { return proxy_; }
	void note_failure(softbody::StepSignals &r_signals) override;
	void note_dent(softbody::StepSignals &r_signals) override;
	void tear(softbody::StepSignals &r_signals) override;
	void finish_step() override;
	bool follow_with_proxy(bool p_may_detail) override;
	void take_sleep(softbody::StepSignals &r_signals) override;
	bool watches_contacts() const override { return values_.contact_monitor; }
	void take_contacts(std::span<const softbody::Contact> p_contacts, std::span<const uint64_t> p_colliders,
			std::vector<uint64_t> p_touched, softbody::StepSignals &r_signals) override;
	bool may_pause() const override;
	bool is_idle() const override;
	void take_over_transform() override;
	void write_state(softbody::StateWriter &r_to) const override;
	softbody::Status check_state(std::span<const uint8_t> p_state) const override;
	void take_state(std::span<const uint8_t> p_state, bool p_is_foreign) override;
	bool draw_frame(const softbody::DrawingFrame &p_frame) override;
	bool is_drawn() const override;
	/// For joints: it passes through the object of that instance id, no soft body, until that is removed as often as added.
	void add_joined(uint64_t p_id);
	void remove_joined(uint64_t p_id);

protected:
	static void _bind_methods();
	void _notification(int p_what);
	void _validate_property(PropertyInfo &p_property) const;
	bool _set(const StringName &p_name, const Variant &p_value);
	bool _get(const StringName &p_name, Variant &r_value) const;
	void _get_property_list(List<PropertyInfo> *r_list) const { unfit_.append_to(r_list); }
	virtual const softbody::RopePart *rope() const { return nullptr; } ///< what makes the body a rope

	friend class softbody::BodyCuts;
	static void bind_properties();
	static void bind_body_methods();
	static void bind_structure_methods();
	static void bind_enumerations();
	// Friction and bounce were properties of the node in earlier versions: soft_body_2d_material.cpp.
	static bool is_former_surface(const StringName &p_name);
	void set_former_surface(const StringName &p_name, const Variant &p_value);

	/// What `set_value` does with a property.
	using ValueRule = softbody::ValueRule<SoftBody2D>;
	/// One for each member of `Values`, `BodyStructure::Values` and `SkinStyle` that is a property; `bind_value` fills it.
	template <auto VALUE>
	static inline ValueRule rule_of;
	/// Binds a property whose setter and getter are templates.
	template <auto VALUE>
	static void bind_value(const ValueRule &p_rule, PropertyHint p_hint = PROPERTY_HINT_NONE, const char *p_hint_string = "",
			const char *p_getter_name = nullptr, const char *p_setter_name = nullptr);

	static const char *const REASON_NETWORK_VALUES;
	/// Mass of the default body [kg], and its area [px²].
	static constexpr double DEFAULT_MASS = 1;
	static double default_area();
	static PackedVector2Array make_default_polygon();
	softbody::SizedHull sized_hull(const Transform2D &p_transform) const;
	using Design = softbody::BodyDesign;

	/// Of a bound method, and may be kept: it is by name, as a reload of the extension exchanges the node's code.
	Callable own_callable(const char *p_method) { return Callable(this, p_method); }
	bool accept(const StringName &p_property, const softbody::Status &p_status);
	bool accept_shape(const StringName &p_property);
	bool accept_values(const StringName &p_property);
	bool is_current(const Design &p_design) const;
	void set_own_material_value(const softbody::MaterialField &p_field, double p_value);
	bool take_over_own_values(const StringName &p_property, const softbody::MaterialValues &p_values);
	void take_over_material();
	bool leaves_to_shared_material(const StringName &p_property);
	void take_over_physics_material();
	ModelChoice choose_model() const;
	ModelChoice modes_or_stand_in(ElasticModel p_model, const char *p_reason) const;
	double mass_of_area(double p_area) const;
	/// Sets both, unless no body can have that mass. False if it was refused.
	bool take_over_mass(const StringName &p_property, MassMode p_mode, double p_mass);
	/// How firm it is made for its weight; nothing where Young's modulus takes no part.
	softbody::Firmness firmness_of(const Design &p_design) const;
	softbody::Status apply_elasticity(const Design &p_design, softbody::BodySettings &r_settings) const;
	softbody::Result<softbody::BodySettings> make_settings(const Design &p_design) const;
	/// Of the present design; nothing where there can be no body.
	std::optional<softbody::BodySettings> present_settings() const;
	/// The structure at the scale of `p_transform`, or what is wrong with it. A draft has no elastic modes, which take some
	/// milliseconds: it serves to judge properties while a scene sets them one after the other.
	softbody::Result<Design> make_design(const Transform2D &p_transform, bool p_is_draft = false) const;
	bool uses_self_collision(const Design &p_design) const;
	softbody::Status check_elasticity(const Design &p_design) const;
	/// That of the body, or the one it would have; null if there can be none.
	const Design *design() const;
	Transform2D design_transform() const;
	/// Takes over a structure in which a value has changed. False if it was refused.
	bool take_over_structure(const StringName &p_property, bool p_has_other_points);
	softbody::DrawnMotion drawn_motion() const;
	void take_over_motion(const softbody::DrawnMotion &p_motion);
	const softbody::Spring2D *find_spring(int p_index) const;
	std::pair<double, double> spring_scales() const;
	void tell_structure_problems();
	void tell_network_once() const;
	static bool decided_by_network_values(const Design &p_design);
	void append_stability_warnings(const Design &p_design, PackedStringArray &r_warnings) const;
	/// Of a network, whose design and settings these are; others keep their shape.
	softbody::FallOutcome fall_outcome(const Design &p_design, const softbody::BodySettings &p_settings) const;
	const softbody::ContactReports::Record *find_contact(int p_index) const;
	void watch_collider(Node *p_collider, bool p_watch);
	void emit_entered(uint64_t p_collider, const softbody::ContactReports::Impact &p_impact);
	void emit_exited(uint64_t p_collider);
	void on_collider_exiting(uint64_t p_collider);
	void forget_contacts();
	softbody::SoftBodyData *body();
	const softbody::SoftBodyData *body() const;
	/// The body after it has followed a transform that the user has just set.
	const softbody::SoftBodyData *followed_body() const;
	softbody::SoftBodyData *followed_body();
	std::size_t core_index(int p_index) const { return std::size_t(order().mirror(p_index)); }
	softbody::PointOrder order() const { return structure_.order(polygon_reversed_); }
	bool check_index(int p_index) const;
	void enter_space();
	void leave_space();
	void rebuild_body(bool p_keeps_motion);
	double most_bearable_strain() const;
	void tear_now();
	/// Gives a body that has just been made the velocities that were set before.
	void start_first_motion();
	softbody::Status apply_dents(softbody::SoftBodyData &r_body, const PackedVector2Array &p_dents) const;
	void apply_constant_forces();
	void lock_rotation();
	/// From the locked rotation; 0 of a body that may turn.
	double turned_by(const softbody::BodyFrame &p_frame) const;
	void hold_rotation(softbody::SoftBodyData &r_body, double p_delta) const;
	void undo_turn(softbody::SoftBodyData &r_body) const;
	/// Adds an impulse or a force at an offset from the node's origin, or at the center of mass where that is null.
	template <auto PUSH>
	void push(const char *p_what, const Vector2 &p_push, const Vector2 *p_position);
	PackedVector2Array in_user_order(std::span<const softbody::Vec2> p_values) const;
	softbody::Status set_point(int p_index, const Vector2 *p_position, const Vector2 *p_velocity);
	bool check_points(const char *p_what, const PackedVector2Array &p_values);
	/// The node goes to where its points have been put.
	void follow_body();
	void place_node(const Transform2D &p_transform);
	void note_mirror();
	void apply_shape();
	void apply_settings();
	void update_proxy_presence();
	void update_picker();
	/// The next tick does not leave the node out, though its body may rest.
	void note_change();
	void apply_collision_layer();
	void note_enabled();
	/// Whether its process mode lets it be stepped, and if not, its disable mode.
	bool takes_part() const;
	bool is_held_static() const { return !enabled_ && values_.disable_mode == DISABLE_MODE_MAKE_STATIC; }
	void apply_freeze();
	void apply_exceptions();
	softbody::Real proxy_inset() const;
	Transform2D simulated_frame(const Transform2D &p_transform) const;
	Transform2D transform_at(const softbody::BodyFrame &p_frame) const;
	void update_topology();
	void apply_pins();
	void follow_pin_targets();

	// Drawing, in soft_body_2d_drawing.cpp.
	void append_drawing_warnings(PackedStringArray &r_warnings) const;
	void listen_to_textures(bool p_listens);
	void follow_texture();
	void remake_skin();
	void note_look();
	void note_move_by_user(const Transform2D &p_from, const Transform2D &p_to);
	std::span<const softbody::Vec2> drawn_points(double p_fraction) const; ///< as `local_points`, for the skin
	double area_of_holes() const;
	std::span<const softbody::Vec2> with_holes(std::span<const softbody::Vec2> p_outline, std::span<const softbody::Vec2> p_points) const;
	bool check_fraction(double &r_fraction) const;
	void draw();
	void place_canvas_item(double p_fraction);
	void update_seen_area();
	void draw_debug(double p_fraction);
	void enter_screen();
	void leave_screen();
	bool is_off_screen() const;
	Values values_;
	softbody::BodyStructure structure_;
	softbody::BodyMaterial material_;
	softbody::BodyPins pins_;
	softbody::ContactReports contacts_;
	softbody::CollisionExceptions exceptions_;
	Ref<PhysicsMaterial> former_surface_; ///< made for values that an old scene set under their former names
	bool has_own_mass_ = false; ///< whether a mass was set, or is that of a scene
	PackedVector2Array first_dents_; ///< of a body that is still to be made
	Vector2 first_linear_velocity_; ///< of a body that is still to be made
	double first_angular_velocity_ = 0;
	Vector2 constant_force_;
	double constant_torque_ = 0;
	double locked_rotation_ = 0; ///< that the node was given last
	bool enabled_ = true; ///< whether its process mode, or the one that it inherits, is another than disabled
	bool freeze_ = false;
	int64_t unsaid_failures_ = 0; ///< since the last error about one
	uint64_t last_said_failure_ = 0; ///< physics frame of the last error about a failure; 0 for none
	softbody::UnfitValues unfit_;
	HashMap<StringName, String> refused_; ///< last refused value of a property, until a good one is set
	uint64_t rest_version_ = 0;
	std::vector<softbody::Vec2> rest_points_; ///< in the core's order
	softbody::SoftBodySpace2D *space_ = nullptr;
	softbody::BodyId body_id_;
	std::unique_ptr<softbody::SoftBodyData> stored_body_; ///< while in no space
	Transform2D built_scale_; ///< scale and skew the shape was built at, without rotation and position
	Transform2D known_transform_; ///< global transform the node had when it last agreed with the body
	bool polygon_reversed_ = false;
	softbody::CutHistory cuts_; ///< forgotten when the user gives it other points
	uint64_t awaited_modes_ = 0; ///< number of the task that finds its elastic modes after a cut, or 0
	softbody::BodyGrowth growth_;
	bool is_mirrored_x_ = false; ///< whether the node's scale of x is negative
	mutable std::optional<Design> design_; ///< forgotten when the structure changes
	mutable std::unique_ptr<softbody::FallMemory> falls_; ///< once it was asked
	PackedStringArray told_problems_;
	bool sleeping_ = false; ///< as of the last step, or as wanted of a body that is still to be made
	softbody::ToldValue<bool> told_sleep_;
	mutable softbody::HullProxy proxy_; ///< makes its RID when that is asked for
	SoftBodyPicker *picker_ = nullptr; ///< an internal child while the body is pickable
	int engine_steps_ = 0; ///< that the engine can have made since the proxy entered its space
	bool knows_areas_ = false; ///< whether the body has been told what areas do to it
	bool moving_ = false; ///< whether the last tick stepped the body
	bool has_stopped_ = false; ///< whether the tick before it did
	softbody::SoftBodySkin skin_;
	softbody::BodyInterpolation interpolation_;
	std::unique_ptr<softbody::DebugDrawing> debug_drawing_; ///< while collision shapes are visible
	softbody::BodyView *view_ = nullptr; ///< while in a space
	bool settled_ = false; ///< whether what is drawn holds until the body moves again; see `note_look`
	bool area_checked_ = false; ///< since the last tick, of a body that no camera sees
	bool item_displaced_ = false; ///< whether the canvas item stands where the body is drawn, not where the node is
	bool on_screen_ = false; ///< as the rendering server saw it last
	int unseen_frames_ = 0; ///< in a row, counted no further than needed
	Rect2 skin_area_; ///< part of the node's plane in which the skin may move before `seen_area` is set anew
	Callable entered_screen_, left_screen_;
};

} // namespace godot
