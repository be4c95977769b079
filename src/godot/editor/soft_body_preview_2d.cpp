// SPDX-License-Identifier: MIT
// A separate world in which copies of SoftBody2D nodes move, for the editor's live preview.
#include "godot/editor/soft_body_preview_2d.h"

#include "godot/convert.h"
#include "godot/nodes/soft_body_2d.h"

#include <godot_cpp/core/class_db.hpp>
#include <godot_cpp/core/error_macros.hpp>

#include <cmath>
#include <utility>

using softbody::to_core;
using softbody::to_godot;

namespace godot {

namespace {

// Largest speed of a grabbed point [px/s]: a jump of the mouse does not tear at the body.
constexpr double GRAB_SPEED = 3000;

} // namespace

SoftBodyPreview2D::SoftBodyPreview2D() :
		world_(std::make_unique<softbody::WorldData>()), simulator_(std::make_unique<softbody::Simulator>(*world_)) {
	world_->set_length_unit(softbody::PIXELS_PER_METER);
	world_->set_gravity(SoftBody2D::project_gravity());
}

int SoftBodyPreview2D::add_body(SoftBody2D *p_body) {
	ERR_FAIL_NULL_V_MSG(p_body, -1, "SoftBodyPreview2D: body is null: give a SoftBody2D.");
	auto copy = p_body->make_copy();
	ERR_FAIL_COND_V_MSG(!copy, -1, "SoftBodyPreview2D: " + p_body->describe() + " has no body: " + to_godot(copy.error()) + ".");
	const bool is_reversed = softbody::signed_area(to_core(p_body->get_global_transform().xform(p_body->get_polygon()))) < 0;
	softbody::TearRules rules = softbody::BodyCuts::tear_rules(*p_body, copy.value());
	const int index = int(bodies_.size());
	bodies_.push_back({ world_->add_soft_body(std::move(copy.value())), is_reversed, index, is_reversed, std::move(rules), {} });
	return index;
}

void SoftBodyPreview2D::add_floor(const Vector2 &p_position, const Vector2 &p_normal) {
	softbody::Surface surface;
	surface.layer = UINT32_MAX;
	const softbody::Status status = world_->add_border({ { to_core(p_position), to_core(p_normal.normalized()) }, surface });
	ERR_FAIL_COND_MSG(status.has_value(), "SoftBodyPreview2D: floor refused: " + to_godot(*status) + ".");
}

void SoftBodyPreview2D::step(double p_delta) {
	pull_grabbed_point(p_delta);
	const softbody::StepReport report = simulator_->simulate(softbody::Real(p_delta));
	ERR_FAIL_COND_MSG(report.refused.has_value(), "SoftBodyPreview2D: step refused: " + to_godot(*report.refused) + ".");
	const int count = int(bodies_.size());
	for (int i = 0; i < count; i++) {
		const softbody::SoftBodyData &body = *world_->find(bodies_[size_t(i)].id);
		const softbody::TearRules &rules = bodies_[size_t(i)].rules;
		if (rules.tears && body.takes_damage() && softbody::is_overstretched(body, rules.limits.stretch)) {
			tear(i);
		}
	}
}

// The largest piece takes the place of the whole, as in a game. Their elastic modes are found at once.
void SoftBodyPreview2D::tear(int p_index) {
	const Copy whole = bodies_[size_t(p_index)];
	softbody::SoftBodyData body = *world_->find(whole.id);
	const bool is_held = grabbed_body_ == p_index;
	const Vector2 held = is_held ? get_grabbed_position() : Vector2();
	if (is_held) { // a hand is no pin
		body.set_pinned(grabbed_point_, false);
	}
	const auto cut = softbody::plan_tear(body, whole.rules.options, whole.rules.limits);
	if (!cut || cut.value().pieces.size() < 2) {
		return;
	}
	auto pieces = softbody::make_pieces(body, cut.value());
	if (!pieces) {
		return;
	}
	if (is_held) {
		release();
	}
	const size_t corner_count = body.hull().size();
	std::vector<std::vector<double>> columns; // of each corner of the whole
	for (size_t corner = 0; corner < corner_count; corner++) {
		std::vector<double> one(corner_count, 0.0);
		one[corner] = 1;
		columns.push_back(softbody::carried<double>(cut.value().polygon, one));
	}
	world_->remove_soft_body(whole.id);
	for (size_t i = 0; i < pieces.value().size(); i++) {
		const softbody::BodyPiece &piece = cut.value().pieces[i];
		Copy copy{ world_->add_soft_body(std::move(pieces.value()[i])), false, whole.source, whole.is_source_reversed, { piece.options, whole.rules.limits, true }, {} };
		for (const uint32_t point : piece.outline) {
			std::vector<double> weights(whole.weights.empty() ? corner_count : whole.weights[0].size(), 0.0);
			for (size_t corner = 0; corner < corner_count; corner++) {
				const double share = columns[corner][point];
				if (whole.weights.empty()) {
					weights[corner] = share;
					continue;
				}
				for (size_t k = 0; share != 0 && k < weights.size(); k++) {
					weights[k] += share * whole.weights[corner][k];
				}
			}
			copy.weights.push_back(std::move(weights));
		}
		if (i == 0) {
			bodies_[size_t(p_index)] = std::move(copy);
		} else {
			bodies_.push_back(std::move(copy));
		}
	}
	if (is_held) {
		const Vector2 target = grab_target_;
		grab(held, HUGE_VAL);
		grab_target_ = target;
	}
}

int SoftBodyPreview2D::get_source(int p_index) const {
	ERR_FAIL_INDEX_V_MSG(p_index, int(bodies_.size()), -1, "SoftBodyPreview2D: there are " + itos(int64_t(bodies_.size())) + " bodies.");
	return bodies_[size_t(p_index)].source;
}

PackedVector2Array SoftBodyPreview2D::carry(int p_index, const PackedVector2Array &p_values) const {
	ERR_FAIL_INDEX_V_MSG(p_index, int(bodies_.size()), PackedVector2Array(), "SoftBodyPreview2D: there are " + itos(int64_t(bodies_.size())) + " bodies.");
	const Copy &copy = bodies_[size_t(p_index)];
	if (copy.weights.empty()) {
		return p_values;
	}
	const int count = int(copy.weights[0].size());
	ERR_FAIL_COND_V_MSG(p_values.size() != count, PackedVector2Array(), "SoftBodyPreview2D: values has " + itos(p_values.size()) + " entries and must have " + itos(count) + ", one for each point of the polygon that tore.");
	const softbody::PointOrder order{ count, copy.is_source_reversed };
	PackedVector2Array carried;
	for (const std::vector<double> &weights : copy.weights) {
		Vector2 sum;
		for (int i = 0; i < count; i++) {
			sum += p_values[order.mirror(i)] * real_t(weights[size_t(i)]);
		}
		carried.push_back(sum);
	}
	return carried;
}

void SoftBodyPreview2D::pull_grabbed_point(double p_delta) {
	if (grabbed_body_ < 0) {
		return;
	}
	softbody::SoftBodyData *body = world_->find(bodies_[size_t(grabbed_body_)].id);
	const Vector2 place = to_godot(body->positions()[grabbed_point_]);
	body->set_pin_target(grabbed_point_, to_core(place.move_toward(grab_target_, real_t(GRAB_SPEED * p_delta))));
}

bool SoftBodyPreview2D::grab(const Vector2 &p_position, double p_max_distance) {
	release();
	double nearest = p_max_distance;
	for (size_t i = 0; i < bodies_.size(); i++) {
		const softbody::SoftBodyData *body = world_->find(bodies_[i].id);
		for (uint32_t point = 0; point < body->point_count(); point++) {
			const double distance = to_godot(body->positions()[point]).distance_to(p_position);
			if (distance <= nearest && !body->is_pinned(point)) {
				nearest = distance;
				grabbed_body_ = int(i);
				grabbed_point_ = point;
			}
		}
	}
	if (grabbed_body_ < 0) {
		return false;
	}
	grab_target_ = p_position;
	world_->find(bodies_[size_t(grabbed_body_)].id)->set_pinned(grabbed_point_, true);
	return true;
}

void SoftBodyPreview2D::release() {
	if (grabbed_body_ >= 0) {
		world_->find(bodies_[size_t(grabbed_body_)].id)->set_pinned(grabbed_point_, false);
		grabbed_body_ = -1;
	}
}

Vector2 SoftBodyPreview2D::get_grabbed_position() const {
	ERR_FAIL_COND_V_MSG(grabbed_body_ < 0, Vector2(), "SoftBodyPreview2D: no point is grabbed.");
	return to_godot(world_->find(bodies_[size_t(grabbed_body_)].id)->positions()[grabbed_point_]);
}

const softbody::SoftBodyData *SoftBodyPreview2D::find(int p_index) const {
	ERR_FAIL_INDEX_V_MSG(p_index, int(bodies_.size()), nullptr, "SoftBodyPreview2D: there are " + itos(int64_t(bodies_.size())) + " bodies.");
	return world_->find(bodies_[size_t(p_index)].id);
}

PackedVector2Array SoftBodyPreview2D::get_polygon(int p_index) const {
	const softbody::SoftBodyData *body = find(p_index);
	return body != nullptr ? get_point_positions(p_index).slice(0, int64_t(body->hull().size())) : PackedVector2Array();
}

PackedVector2Array SoftBodyPreview2D::get_point_positions(int p_index) const {
	const softbody::SoftBodyData *body = find(p_index);
	if (body == nullptr) {
		return PackedVector2Array();
	}
	const softbody::PointOrder order{ int(body->hull().size()), bodies_[size_t(p_index)].is_reversed };
	PackedVector2Array points;
	for (int i = 0; i < int(body->point_count()); i++) {
		points.push_back(to_godot(body->positions()[size_t(order.mirror(i))]));
	}
	return points;
}

void SoftBodyPreview2D::_bind_methods() {
	ClassDB::bind_method(D_METHOD("add_body", "body"), &SoftBodyPreview2D::add_body);
	ClassDB::bind_method(D_METHOD("get_body_count"), &SoftBodyPreview2D::get_body_count);
	ClassDB::bind_method(D_METHOD("add_floor", "position", "normal"), &SoftBodyPreview2D::add_floor, DEFVAL(Vector2(0, -1)));
	ClassDB::bind_method(D_METHOD("step", "delta"), &SoftBodyPreview2D::step);
	ClassDB::bind_method(D_METHOD("grab", "position", "max_distance"), &SoftBodyPreview2D::grab);
	ClassDB::bind_method(D_METHOD("drag", "position"), &SoftBodyPreview2D::drag);
	ClassDB::bind_method(D_METHOD("release"), &SoftBodyPreview2D::release);
	ClassDB::bind_method(D_METHOD("is_grabbing"), &SoftBodyPreview2D::is_grabbing);
	ClassDB::bind_method(D_METHOD("get_grabbed_position"), &SoftBodyPreview2D::get_grabbed_position);
	ClassDB::bind_method(D_METHOD("get_polygon", "index"), &SoftBodyPreview2D::get_polygon);
	ClassDB::bind_method(D_METHOD("get_point_positions", "index"), &SoftBodyPreview2D::get_point_positions);
	ClassDB::bind_method(D_METHOD("get_source", "index"), &SoftBodyPreview2D::get_source);
	ClassDB::bind_method(D_METHOD("carry", "index", "values"), &SoftBodyPreview2D::carry);
}

} // namespace godot
