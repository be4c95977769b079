// SPDX-License-Identifier: MIT
// Cuts and tears, as scripts see them.
#include "godot/convert.h"
#include "godot/nodes/body_cuts.h"
#include "godot/nodes/soft_body_2d.h"
#include "godot/server/soft_body_simulation_2d.h"
#include "godot/server/step_signals.h"

#include <godot_cpp/core/error_macros.hpp>

namespace godot {

namespace {

// Whether the caller is to blame, not where the body happens to be.
bool is_bad_input(const softbody::Error &p_error) {
	return p_error.name.starts_with("blade") || p_error.name == "body" || p_error.name == "detail_mode";
}

} // namespace

TypedArray<SoftBody2D> SoftBody2D::cut(const Vector2 &p_from, const Vector2 &p_to) {
	return cut_polyline({ p_from, p_to });
}

TypedArray<SoftBody2D> SoftBody2D::cut_polyline(const PackedVector2Array &p_points) {
	SoftBodySimulation2D *simulation = SoftBodySimulation2D::get_singleton();
	if (simulation->is_stepping()) {
		simulation->after_step(get_instance_id(), [this, p_points] { cut_polyline(p_points); });
		return {};
	}
	const auto planned = softbody::BodyCuts::plan(*this, p_points);
	if (!planned) {
		const String message = describe() + ": not cut: " + softbody::to_godot(planned.error()) + ".";
		ERR_FAIL_COND_V_MSG(is_bad_input(planned.error()), {}, message);
		WARN_PRINT(message); // players draw where they like
		return {};
	}
	if (planned.value().pieces.size() < 2) {
		return {};
	}
	const auto made = softbody::BodyCuts(*this).make(planned.value());
	ERR_FAIL_COND_V_MSG(!made, {}, describe() + ": not cut: " + softbody::to_godot(made.error()) + ".");
	const TypedArray<SoftBody2D> pieces = made.value();
	simulation->after_step(get_instance_id(), [this, pieces] { emit_signal("was_cut", pieces); });
	return pieces;
}

TypedArray<PackedVector2Array> SoftBody2D::preview_cut(const PackedVector2Array &p_points) const {
	const auto planned = softbody::BodyCuts::plan(*this, p_points);
	return planned && planned.value().pieces.size() > 1 ? softbody::BodyCuts::outlines(planned.value()) : TypedArray<PackedVector2Array>();
}

String SoftBody2D::get_cut_problem(const PackedVector2Array &p_points) const {
	const auto planned = softbody::BodyCuts::plan(*this, p_points);
	return planned ? String() : softbody::to_godot(planned.error());
}

void SoftBody2D::tear(softbody::StepSignals &r_signals) {
	r_signals.add(get_instance_id(), [this] { tear_now(); });
}

// What becomes a dent first cannot tear below that.
double SoftBody2D::most_bearable_strain() const {
	return MAX(material_.values().tear_stretch, material_.values().yield_strain);
}

void SoftBody2D::tear_now() {
	const auto planned = softbody::BodyCuts::plan_tear(*this, most_bearable_strain());
	if (!planned || planned.value().pieces.size() < 2) {
		return; // it holds on, as long as what would come off is too small
	}
	const auto made = softbody::BodyCuts(*this).make(planned.value());
	ERR_FAIL_COND_MSG(!made, describe() + ": not torn: " + softbody::to_godot(made.error()) + ".");
	const TypedArray<SoftBody2D> pieces = made.value();
	SoftBodySimulation2D::get_singleton()->after_step(get_instance_id(), [this, pieces] { emit_signal("torn", pieces); });
}

} // namespace godot
