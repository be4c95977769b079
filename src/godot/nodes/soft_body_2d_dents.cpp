// SPDX-License-Identifier: MIT
// Dents: what a body's shape at rest has become.
#include "godot/nodes/soft_body_2d.h"

#include "godot/convert.h"
#include "godot/server/step_signals.h"

#include <span>
#include <string>
#include <vector>

namespace godot {

// One displacement a point, in the order of the user's points and in the node's own coordinates, so that it holds for any size.
PackedVector2Array SoftBody2D::get_dents() const {
	const softbody::SoftBodyData *found = body();
	if (found == nullptr) {
		return first_dents_;
	}
	PackedVector2Array dents;
	if (!found->is_dented()) {
		return dents;
	}
	const Transform2D back = structure_.simulated_scale(built_scale_).affine_inverse();
	const std::span<const softbody::Vec2> rest = found->shape().rest_positions();
	const std::span<const softbody::Vec2> first = found->shared_shape()->rest_positions();
	dents.resize(int64_t(rest.size()));
	for (int i = 0; i < int(rest.size()); i++) {
		const std::size_t point = core_index(i);
		dents[i] = back.basis_xform(softbody::to_godot(rest[point] - first[point]));
	}
	return dents;
}

softbody::Status SoftBody2D::apply_dents(softbody::SoftBodyData &r_body, const PackedVector2Array &p_dents) const {
	if (p_dents.is_empty()) {
		r_body.reset_dents();
		return {};
	}
	const std::span<const softbody::Vec2> first = r_body.shared_shape()->rest_positions();
	if (std::size_t(p_dents.size()) != first.size()) {
		return softbody::Error{ "dents", std::to_string(p_dents.size()) + " entries", "must have one a point, " + std::to_string(first.size()) + ", or none", "clear them when the points are changed" };
	}
	const Transform2D scale = structure_.simulated_scale(built_scale_);
	std::vector<softbody::Vec2> places(first.begin(), first.end());
	for (int i = 0; i < int(p_dents.size()); i++) {
		places[core_index(i)] += softbody::to_core(scale.basis_xform(p_dents[i]));
	}
	return r_body.set_rest_positions(places);
}

void SoftBody2D::set_dents(const PackedVector2Array &p_dents) {
	if (softbody::SoftBodyData *found = followed_body()) {
		if (accept("dents", apply_dents(*found, p_dents))) {
			growth_.note_growth();
			proxy_.forget_shape();
		}
	} else {
		first_dents_ = p_dents;
	}
}

double SoftBody2D::get_dent() const {
	const softbody::SoftBodyData *found = followed_body();
	return found != nullptr ? double(found->dent()) : 0.0;
}

void SoftBody2D::reset_dents() {
	set_dents({});
}

void SoftBody2D::note_dent(softbody::StepSignals &r_signals) {
	proxy_.forget_shape();
	r_signals.add(get_instance_id(), [this] { emit_signal("dented", get_dent()); });
}

} // namespace godot
