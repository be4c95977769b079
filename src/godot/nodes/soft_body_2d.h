// SPDX-License-Identifier: MIT
// The node: a soft body that lives, collides and is drawn in a 2D scene.
#pragma once

#include "core/base/error.h"
#include "core/model/soft_body_data.h"
#include "core/model/world_data.h"
#include "godot/drawing/body_interpolation.h"
#include "godot/drawing/debug_drawing.h"
#include "godot/drawing/drawing_frame.h"
#include "godot/drawing/soft_body_skin.h"

#include <godot_cpp/classes/node2d.hpp>
#include <godot_cpp/classes/texture2d.hpp>
#include <godot_cpp/templates/hash_map.hpp>
#include <godot_cpp/variant/dictionary.hpp>
#include <godot_cpp/variant/packed_int32_array.hpp>
#include <godot_cpp/variant/packed_string_array.hpp>
#include <godot_cpp/variant/node_path.hpp>
#include <godot_cpp/variant/packed_vector2_array.hpp>
#include <godot_cpp/variant/typed_array.hpp>

#include <memory>
#include <optional>
#include <span>
#include <vector>

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
	PackedVector2Array get_interpolated_hull(double p_fraction) const;
	Transform2D get_interpolated_transform(double p_fraction) const;

	static PackedVector2Array make_circle_hull(double p_radius, int p_point_count);
	static PackedVector2Array make_box_hull(const Vector2 &p_size, double p_spacing);
	static PackedVector2Array make_capsule_hull(double p_radius, double p_height, double p_spacing);

	int get_point_count() const;
	PackedVector2Array get_point_positions() const;
	PackedVector2Array get_point_velocities() const;
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
	std::span<const softbody::Vec2> rest_points() const { return skin_.rest(); }
	/// The body's points in the node's frame at that fraction, in the core's order; a rest shape without a body. Valid
	/// until the next call for any node.
	std::span<const softbody::Vec2> local_points(double p_fraction) const;
	/// Whether it is drawn where the last tick left it, not between two.
	bool is_drawn_at_tick() const;

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
	/// Before a frame is drawn: brings the skin to where the body is in it. False when there was nothing to do.
	bool draw_frame(const softbody::DrawingFrame &p_frame);

protected:
	static void _bind_methods();
	void _notification(int p_what);

private:
	static void bind_shape();
	static void bind_motion();
	static void bind_points();
	static void bind_material();
	static void bind_collision();
	static void bind_solver();
	static void bind_drawing();
	static void bind_pins();

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
	Transform2D body_transform() const;
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
	void enter_screen() { on_screen_ = true; }
	void leave_screen() { on_screen_ = false; }

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
	HashMap<StringName, String> refused_; ///< last refused value of a property, until a good one is set

	PackedInt32Array pinned_points_;
	TypedArray<NodePath> pin_targets_; ///< one a pinned point; missing ones are the world
	std::vector<Pin> pins_; ///< likewise
	uint64_t rest_version_ = 0;

	softbody::SoftBodySpace2D *space_ = nullptr;
	softbody::BodyId body_id_;
	size_t space_index_ = 0;
	std::optional<softbody::SoftBodyData> stored_body_;
	Transform2D built_scale_; ///< scale and skew the shape was built at, without rotation and position
	Transform2D known_transform_; ///< global transform the node had when it last agreed with the body
	bool hull_reversed_ = false;
	bool moving_ = false; ///< whether the last tick stepped the body

	softbody::SoftBodySkin skin_;
	softbody::BodyInterpolation interpolation_;
	std::unique_ptr<softbody::DebugDrawing> debug_drawing_; ///< while collision shapes are visible
	softbody::BodyView *view_ = nullptr; ///< while in a space
	bool settled_ = false; ///< whether what is drawn holds until the body moves again
	bool area_checked_ = false; ///< since the last tick, of a body that nobody sees
	bool item_displaced_ = false; ///< whether the canvas item stands where the body is drawn, not where the node is
	bool on_screen_ = false; ///< as the rendering server saw it last
	Rect2 skin_area_; ///< part of the node's plane in which the skin may move before `seen_area` is set anew
	Callable entered_screen_;
	Callable left_screen_;
};

} // namespace godot

VARIANT_ENUM_CAST(SoftBody2D::Integrator);
VARIANT_ENUM_CAST(SoftBody2D::OutlineTextureMode);
