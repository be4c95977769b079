// SPDX-License-Identifier: MIT
// The node: its properties, its life in the tree and its agreement with the body in the core.
#include "godot/soft_body_2d.h"

#include "core/base/constants.h"
#include "core/creator/hulls.h"
#include "core/creator/soft_body_creator.h"
#include "core/dynamics/energy.h"
#include "core/dynamics/substep_plan.h"
#include "core/geometry/polygon.h"
#include "core/model/body_frame.h"
#include "godot/convert.h"
#include "godot/soft_body_server_2d.h"

#include <godot_cpp/classes/engine.hpp>
#include <godot_cpp/classes/world2d.hpp>
#include <godot_cpp/core/class_db.hpp>
#include <godot_cpp/core/math.hpp>

#include <cmath>
#include <utility>
#include <vector>

using softbody::to_core;
using softbody::to_godot;

namespace godot {

namespace {

constexpr double DEFAULT_RADIUS = 50; // px
constexpr int DEFAULT_POINTS = 16;

Transform2D without_rotation_and_position(const Transform2D &p_transform) {
	Transform2D scale = Transform2D(-p_transform.get_rotation(), Vector2()) * p_transform;
	scale.set_origin(Vector2());
	return scale;
}

// A rotation read back from a matrix differs in the last digits; that is no change of scale.
bool same_scale(const Transform2D &p_a, const Transform2D &p_b) {
	const real_t size = p_a.columns[0].length() + p_a.columns[1].length();
	return p_a.columns[0].distance_to(p_b.columns[0]) <= 1e-4 * size &&
			p_a.columns[1].distance_to(p_b.columns[1]) <= 1e-4 * size;
}

const char *reason_text(softbody::PlanReason p_reason) {
	switch (p_reason) {
		case softbody::PlanReason::STABILITY:
			return "stability";
		case softbody::PlanReason::CONTACTS:
			return "contacts";
		case softbody::PlanReason::TOO_STIFF:
			return "too_stiff";
		case softbody::PlanReason::FIXED:
			return "fixed";
		case softbody::PlanReason::UNSTABLE:
			break;
	}
	return "unstable";
}

softbody::Pose rotation_and_position(const Transform2D &p_transform) {
	return softbody::to_core_pose(p_transform);
}

} // namespace

SoftBody2D::SoftBody2D() {
	hull_ = make_circle_hull(DEFAULT_RADIUS, DEFAULT_POINTS);
	update_topology();
	set_notify_transform(true);
}

SoftBody2D::~SoftBody2D() {
	leave_space();
}

String SoftBody2D::describe() const {
	String text = "SoftBody2D '" + String(get_name()) + "'";
	if (is_inside_tree()) {
		text += " (" + String(get_path()) + ")";
	}
	return text;
}

bool SoftBody2D::accept(const StringName &p_property, const softbody::Status &p_status) {
	if (!p_status) {
		if (refused_.erase(p_property)) {
			update_configuration_warnings();
		}
		return true;
	}
	const String message = to_godot(p_status->message());
	refused_[p_property] = message;
	update_configuration_warnings();
	ERR_FAIL_V_MSG(false, describe() + ": " + String(p_property) + " refused: " + message + ". The old value stays.");
}

// Properties.

void SoftBody2D::set_hull(const PackedVector2Array &p_hull) {
	if (!accept("hull", softbody::check_hull(to_core(p_hull)))) {
		return;
	}
	hull_ = p_hull;
	update_topology();
	rebuild_body();
	queue_redraw();
	update_configuration_warnings();
}

void SoftBody2D::set_mass(double p_mass) {
	if (accept("mass", softbody::check_above("mass", p_mass, 0, "kg"))) {
		mass_ = p_mass;
		apply_shape();
	}
}

void SoftBody2D::set_stiffness(double p_stiffness) {
	if (accept("stiffness", softbody::check_at_least("stiffness", p_stiffness, 0, "N/m"))) {
		stiffness_ = p_stiffness;
		apply_shape();
	}
}

void SoftBody2D::set_damping(double p_damping) {
	if (accept("damping", softbody::check_at_least("damping", p_damping, 0, "N·s/m"))) {
		damping_ = p_damping;
		apply_shape();
	}
}

void SoftBody2D::set_center_point(bool p_center_point) {
	if (center_point_ != p_center_point) {
		center_point_ = p_center_point;
		update_topology();
		rebuild_body();
		update_configuration_warnings();
	}
}

void SoftBody2D::set_pressure(double p_pressure) {
	if (accept("pressure", softbody::check_at_least("pressure", p_pressure, 0, "N/m"))) {
		pressure_ = p_pressure;
		apply_settings();
	}
}

void SoftBody2D::set_inflation(double p_inflation) {
	if (accept("inflation", softbody::check_at_least("inflation", p_inflation, 0, ""))) {
		inflation_ = p_inflation;
		apply_settings();
	}
}

void SoftBody2D::set_friction(double p_friction) {
	if (accept("friction", softbody::check_at_least("friction", p_friction, 0, ""))) {
		friction_ = p_friction;
		apply_settings();
	}
}

void SoftBody2D::set_bounce(double p_bounce) {
	if (accept("bounce", softbody::check_between("bounce", p_bounce, 0, 1, ""))) {
		bounce_ = p_bounce;
		apply_settings();
	}
}

void SoftBody2D::set_rolling_resistance(double p_rolling_resistance) {
	if (accept("rolling_resistance", softbody::check_at_least("rolling_resistance", p_rolling_resistance, 0, ""))) {
		rolling_resistance_ = p_rolling_resistance;
		apply_settings();
	}
}

void SoftBody2D::set_shape_matching(double p_shape_matching) {
	if (accept("shape_matching", softbody::check_at_least("shape_matching", p_shape_matching, 0, ""))) {
		shape_matching_ = p_shape_matching;
		apply_settings();
	}
}

void SoftBody2D::set_shape_damping(double p_shape_damping) {
	if (accept("shape_damping", softbody::check_at_least("shape_damping", p_shape_damping, 0, ""))) {
		shape_damping_ = p_shape_damping;
		apply_settings();
	}
}

void SoftBody2D::set_gravity_scale(double p_gravity_scale) {
	if (accept("gravity_scale", softbody::check_finite("gravity_scale", p_gravity_scale, ""))) {
		gravity_scale_ = p_gravity_scale;
		apply_settings();
	}
}

void SoftBody2D::set_integrator(Integrator p_integrator) {
	if (accept("integrator", softbody::check_between("integrator", p_integrator, 0, softbody::INTEGRATOR_COUNT - 1, ""))) {
		integrator_ = p_integrator;
		apply_settings();
	}
}

void SoftBody2D::set_substeps(int p_substeps) {
	if (accept("substeps", softbody::check_between("substeps", p_substeps, 0, softbody::MAX_SUBSTEPS, ""))) {
		substeps_ = p_substeps;
		apply_settings();
	}
}

void SoftBody2D::set_collision_mask(uint32_t p_mask) {
	collision_mask_ = p_mask;
	apply_settings();
}

void SoftBody2D::set_color(const Color &p_color) {
	color_ = p_color;
	queue_redraw();
}

void SoftBody2D::set_texture(const Ref<Texture2D> &p_texture) {
	texture_ = p_texture;
	queue_redraw();
}

// From properties to the core.

softbody::BodySettings SoftBody2D::make_settings() const {
	softbody::BodySettings settings;
	const double point_mass = mass_ / get_point_count();
	const double shape_stiffness = shape_matching_ * stiffness_;
	settings.shape_stiffness = softbody::Real(shape_stiffness);
	// The shape-matching oscillator of one point has the frequency sqrt(k_s/m): c = 2 ζ sqrt(k_s m).
	settings.shape_damping = softbody::Real(2 * shape_damping_ * std::sqrt(shape_stiffness * point_mass));
	settings.pressure_stiffness = softbody::Real(pressure_);
	settings.inflation = softbody::Real(inflation_);
	settings.friction = softbody::Real(friction_);
	settings.restitution = softbody::Real(bounce_);
	settings.rolling_resistance = softbody::Real(rolling_resistance_);
	settings.gravity_scale = softbody::Real(gravity_scale_);
	settings.integrator = softbody::Integrator(integrator_);
	settings.substeps = substeps_;
	settings.collision_mask = collision_mask_;
	return settings;
}

softbody::Result<std::shared_ptr<const softbody::SoftBodyShape>> SoftBody2D::make_shape(
		const Transform2D &p_transform) const {
	std::vector<softbody::Vec2> points;
	const Transform2D scale = without_rotation_and_position(p_transform);
	for (const Vector2 &point : hull_) {
		points.push_back(to_core(scale.xform(point)));
	}
	softbody::StructureOptions options;
	options.mass = softbody::Real(mass_);
	options.stiffness = softbody::Real(stiffness_);
	options.damping = softbody::Real(damping_);
	options.centre_point = center_point_;
	return softbody::SoftBodyCreator::create_polygon(points, options);
}

softbody::SoftBodyData *SoftBody2D::body() {
	return const_cast<softbody::SoftBodyData *>(std::as_const(*this).body());
}

const softbody::SoftBodyData *SoftBody2D::body() const {
	if (space_ != nullptr) {
		return std::as_const(*space_).world().find(body_id_);
	}
	return stored_body_ ? &*stored_body_ : nullptr;
}

void SoftBody2D::apply_settings() {
	if (softbody::SoftBodyData *found = body()) {
		accept("settings", found->set_settings(make_settings()));
	}
	update_configuration_warnings();
}

void SoftBody2D::apply_shape() {
	if (softbody::SoftBodyData *found = body()) {
		const auto shape = make_shape(built_scale_);
		if (accept("shape", shape ? softbody::Status() : softbody::Status(shape.error()))) {
			accept("shape", found->set_shape(shape.value()));
		}
	}
	apply_settings(); // the damping of shape matching depends on stiffness and mass
}

// Builds the body anew at the node's transform, at rest. Only another hull or scale needs this.
void SoftBody2D::rebuild_body() {
	if (space_ == nullptr) {
		stored_body_.reset();
		return;
	}
	const Transform2D transform = get_global_transform();
	const auto shape = make_shape(transform);
	if (!accept("shape", shape ? softbody::Status() : softbody::Status(shape.error()))) {
		return;
	}
	auto fresh = softbody::SoftBodyData::create(shape.value(), make_settings(), rotation_and_position(transform));
	if (!accept("transform", fresh ? softbody::Status() : softbody::Status(fresh.error()))) {
		return;
	}
	built_scale_ = without_rotation_and_position(transform);
	std::vector<softbody::Vec2> scaled;
	for (const Vector2 &point : hull_) {
		scaled.push_back(to_core(built_scale_.xform(point)));
	}
	hull_reversed_ = softbody::signed_area(scaled) < 0;
	space_->world().remove_soft_body(body_id_);
	body_id_ = space_->world().add_soft_body(std::move(fresh.value()));
	known_transform_ = transform;
	current_ = current_pose();
	previous_ = current_;
	update_topology();
}

// Life in the tree.

void SoftBody2D::enter_space() {
	if (Engine::get_singleton()->is_editor_hint()) {
		return;
	}
	space_ = SoftBodyServer2D::get_singleton()->add_body(this);
	if (stored_body_) {
		body_id_ = space_->world().add_soft_body(std::move(*stored_body_));
		stored_body_.reset();
		take_over_transform();
	} else {
		rebuild_body();
	}
	set_process_internal(true);
}

void SoftBody2D::leave_space() {
	if (space_ == nullptr) {
		return;
	}
	if (softbody::SoftBodyData *found = body()) {
		stored_body_ = std::move(*found);
		space_->world().remove_soft_body(body_id_);
	}
	space_ = nullptr;
	body_id_ = {};
	// Last: the server drops a space that has no nodes left.
	SoftBodyServer2D::get_singleton()->remove_body(this);
}

void SoftBody2D::_notification(int p_what) {
	switch (p_what) {
		case NOTIFICATION_ENTER_TREE: {
			enter_space();
		} break;
		case NOTIFICATION_EXIT_TREE: {
			leave_space();
		} break;
		case NOTIFICATION_WORLD_2D_CHANGED: {
			if (space_ != nullptr) {
				leave_space();
				enter_space();
			}
		} break;
		case NOTIFICATION_TRANSFORM_CHANGED: {
			take_over_transform();
		} break;
		case NOTIFICATION_INTERNAL_PROCESS: {
			if (moving_ || redraw_needed_) {
				redraw_needed_ = false;
				queue_redraw();
			}
		} break;
		case NOTIFICATION_DRAW: {
			draw();
		} break;
		default:
			break;
	}
}

void SoftBody2D::reset() {
	rebuild_body();
}

// Agreement of node and body.

// Where the node belongs so that its hull, as designed, lies on the body's best-fitting frame.
Transform2D SoftBody2D::body_transform() const {
	const softbody::SoftBodyData &data = *body();
	const softbody::BodyFrame frame = softbody::measure_frame(data);
	const softbody::Vec2 origin = frame.centre - frame.rotation.apply(data.shape().origin_offset());
	Transform2D transform = Transform2D(frame.rotation.angle(), Vector2()) * built_scale_;
	transform.set_origin(to_godot(origin));
	return transform;
}

SoftBody2D::Pose SoftBody2D::current_pose() const {
	return { known_transform_, known_transform_.affine_inverse().xform(to_godot(body()->positions())) };
}

// A transform that differs from the one the body left behind was set by the user: the body follows.
void SoftBody2D::take_over_transform() {
	if (space_ == nullptr || body() == nullptr) {
		return;
	}
	const Transform2D transform = get_global_transform();
	if (transform == known_transform_) {
		return;
	}
	if (!transform.is_finite() || transform.determinant() == 0) {
		accept("transform", softbody::Error{ "transform", "a scale of zero or a non-finite value", "must be invertible", "set a finite position and a scale other than zero" });
		set_global_transform(known_transform_);
		return;
	}
	if (same_scale(without_rotation_and_position(transform), built_scale_)) {
		body()->teleport(rotation_and_position(known_transform_), rotation_and_position(transform));
		known_transform_ = transform;
		current_ = current_pose();
		previous_ = current_;
	} else {
		// Another size is another body: keep how it is deformed and how it moves.
		const PackedVector2Array deformed = current_pose().local_points;
		const std::vector<softbody::Vec2> velocities(body()->velocities().begin(), body()->velocities().end());
		const bool was_reversed = hull_reversed_;
		rebuild_body();
		if (was_reversed == hull_reversed_) {
			for (uint32_t i = 0; i < velocities.size(); i++) {
				body()->set_point(i, to_core(transform.xform(deformed[i])), velocities[i]);
			}
		}
		current_ = current_pose();
		previous_ = current_;
	}
	redraw_needed_ = true;
}

// The engine reports a changed transform at the end of the frame; whoever asks earlier gets the body
// where the node has been put.
const softbody::SoftBodyData *SoftBody2D::followed_body() const {
	const_cast<SoftBody2D *>(this)->take_over_transform();
	return body();
}

softbody::SoftBodyData *SoftBody2D::followed_body() {
	take_over_transform();
	return body();
}

void SoftBody2D::prepare_step() {
	take_over_transform();
	if (softbody::SoftBodyData *found = body()) {
		found->set_active(can_process());
	}
}

void SoftBody2D::finish_step() {
	if (body() == nullptr) {
		return;
	}
	redraw_needed_ = redraw_needed_ || moving_; // after the last move, draw the end of the interpolation once
	moving_ = body()->is_active();
	previous_ = current_;
	if (moving_) {
		set_global_transform(body_transform());
		// Read back rather than remembered: under a transformed parent it may differ in the last digit,
		// and such a digit must not look like a move by the user.
		known_transform_ = get_global_transform();
		current_ = current_pose();
	}
}

// Points.

std::size_t SoftBody2D::core_index(int p_index) const {
	const int hull_count = int(hull_.size());
	return std::size_t(hull_reversed_ && p_index < hull_count ? (hull_count - p_index) % hull_count : p_index);
}

bool SoftBody2D::check_index(int p_index) const {
	ERR_FAIL_COND_V_MSG(body() == nullptr, false, describe() + ": has no body yet; add the node to the scene tree first.");
	ERR_FAIL_COND_V_MSG(p_index < 0 || p_index >= get_point_count(), false, describe() + ": point index " + itos(p_index) + " must be between 0 and " + itos(get_point_count() - 1) + ".");
	return true;
}

int SoftBody2D::get_point_count() const {
	return int(hull_.size()) + (center_point_ ? 1 : 0);
}

PackedVector2Array SoftBody2D::get_point_positions() const {
	PackedVector2Array points;
	if (const softbody::SoftBodyData *found = followed_body()) {
		for (int i = 0; i < get_point_count(); i++) {
			points.push_back(to_godot(found->positions()[core_index(i)]));
		}
	}
	return points;
}

PackedVector2Array SoftBody2D::get_point_velocities() const {
	PackedVector2Array velocities;
	if (const softbody::SoftBodyData *found = followed_body()) {
		for (int i = 0; i < get_point_count(); i++) {
			velocities.push_back(to_godot(found->velocities()[core_index(i)]));
		}
	}
	return velocities;
}

PackedVector2Array SoftBody2D::get_interpolated_hull(double p_fraction) const {
	ERR_FAIL_COND_V_MSG(!(p_fraction >= 0 && p_fraction <= 1), PackedVector2Array(), describe() + ": fraction = " + String::num(p_fraction) + " must be between 0 and 1.");
	const PackedVector2Array points = interpolated_points(p_fraction, Transform2D());
	PackedVector2Array hull;
	for (int i = 0; i < int(hull_.size()) && !points.is_empty(); i++) {
		hull.push_back(points[int64_t(core_index(i))]);
	}
	return hull;
}

int SoftBody2D::get_nearest_point(const Vector2 &p_global_position) const {
	const PackedVector2Array points = get_point_positions();
	int nearest = -1;
	for (int i = 0; i < int(points.size()); i++) {
		if (nearest < 0 || points[i].distance_squared_to(p_global_position) < points[nearest].distance_squared_to(p_global_position)) {
			nearest = i;
		}
	}
	return nearest;
}

bool SoftBody2D::has_point(const Vector2 &p_global_position) const {
	const softbody::SoftBodyData *found = followed_body();
	return found != nullptr && softbody::point_in_polygon(to_core(p_global_position), found->hull());
}

// Forces.

void SoftBody2D::apply_point_force(int p_index, const Vector2 &p_force) {
	if (check_index(p_index)) {
		accept("force", followed_body()->add_external_force(uint32_t(core_index(p_index)), to_core(p_force)));
	}
}

void SoftBody2D::apply_point_impulse(int p_index, const Vector2 &p_impulse) {
	if (check_index(p_index)) {
		accept("impulse", followed_body()->apply_impulse(uint32_t(core_index(p_index)), to_core(p_impulse)));
	}
}

void SoftBody2D::apply_central_force(const Vector2 &p_force) {
	if (!check_index(0)) {
		return;
	}
	softbody::SoftBodyData &target = *followed_body();
	const softbody::SoftBodyShape &shape = target.shape();
	for (uint32_t i = 0; i < shape.point_count(); i++) {
		if (!accept("force", target.add_external_force(i, to_core(p_force) * (shape.masses()[i] / shape.total_mass())))) {
			return;
		}
	}
}

void SoftBody2D::apply_central_impulse(const Vector2 &p_impulse) {
	if (!check_index(0)) {
		return;
	}
	softbody::SoftBodyData &target = *followed_body();
	const softbody::SoftBodyShape &shape = target.shape();
	for (uint32_t i = 0; i < shape.point_count(); i++) {
		if (!accept("impulse", target.apply_impulse(i, to_core(p_impulse) * (shape.masses()[i] / shape.total_mass())))) {
			return;
		}
	}
}

// Measures.

Vector2 SoftBody2D::get_center_of_mass_position() const {
	const softbody::SoftBodyData *found = followed_body();
	return found ? to_godot(softbody::measure_frame(*found).centre) : get_global_position();
}

Vector2 SoftBody2D::get_linear_velocity() const {
	const softbody::SoftBodyData *found = followed_body();
	return found ? to_godot(softbody::measure_frame(*found).velocity) : Vector2();
}

double SoftBody2D::get_angular_velocity() const {
	const softbody::SoftBodyData *found = followed_body();
	return found ? double(softbody::measure_frame(*found).angular_velocity) : 0.0;
}

double SoftBody2D::get_area() const {
	const softbody::SoftBodyData *found = followed_body();
	return found ? double(softbody::signed_area(found->hull())) : get_rest_area();
}

double SoftBody2D::get_rest_area() const {
	const softbody::SoftBodyData *found = followed_body();
	return found ? double(found->shape().rest_area()) : std::abs(double(softbody::signed_area(to_core(hull_))));
}

double SoftBody2D::get_kinetic_energy() const {
	const softbody::SoftBodyData *found = followed_body();
	return found ? softbody::measure_energy(*found, {}).kinetic : 0.0;
}

double SoftBody2D::get_penetration() const {
	const softbody::SoftBodyData *found = followed_body();
	return found && space_ ? double(softbody::measure_penetration(space_->world(), *found)) : 0.0;
}

Dictionary SoftBody2D::get_substep_plan() const {
	const auto shape = make_shape(body() ? built_scale_ : get_transform());
	Dictionary result;
	if (!shape) {
		return result;
	}
	const double delta = 1.0 / Engine::get_singleton()->get_physics_ticks_per_second();
	const softbody::SubstepPlan plan =
			softbody::plan_substeps(*shape.value(), make_settings(), softbody::Real(delta), collision_mask_ != 0);
	result["frequency"] = plan.frequency;
	result["damping_rate"] = plan.damping_rate;
	result["integrator"] = int(plan.integrator);
	result["substeps"] = plan.substeps;
	result["stability_margin"] = plan.stability_margin;
	result["safe"] = plan.safe;
	result["reason"] = reason_text(plan.reason);
	result["cost"] = plan.cost;
	return result;
}

} // namespace godot
