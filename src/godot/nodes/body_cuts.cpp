// SPDX-License-Identifier: MIT
// Cuts of a node: the largest piece keeps the node, the others become nodes beside it.
#include "godot/nodes/body_cuts.h"

#include "core/geometry/polygon.h"
#include "core/model/body_frame.h"
#include "godot/convert.h"
#include "godot/nodes/soft_body_attachment_2d.h"
#include "godot/server/shape_cache.h"
#include "godot/server/soft_body_simulation_2d.h"
#include "godot/server/soft_body_space_2d.h"

#include <godot_cpp/classes/scene_tree.hpp>
#include <godot_cpp/core/error_macros.hpp>

#include <memory>
#include <utility>
#include <vector>

using namespace godot;

namespace softbody {

namespace {

// Least width of a piece, twice its area over its perimeter [px]. Thinner ones take many substeps and are hardly seen.
constexpr Real LEAST_PIECE_WIDTH = 2;

// Properties of nodes and canvas items that a piece has as the whole had them. What SoftBody2D adds is copied by its parts.
const char *const SHARED_PROPERTIES[] = { "process_mode", "process_priority", "process_physics_priority", "physics_interpolation_mode",
	"visible", "modulate", "self_modulate", "show_behind_parent", "top_level", "light_mask", "visibility_layer", "z_index", "z_as_relative",
	"y_sort_enabled", "texture_filter", "texture_repeat", "material", "use_parent_material" };

} // namespace

Result<BodyCut> BodyCuts::plan(const SoftBody2D &p_node, const PackedVector2Array &p_points) {
	if (Status refused = p_node.structure_.check_as_drawn()) {
		return *refused;
	}
	const SoftBodyData *body = whole_of(p_node);
	if (body == nullptr) {
		return Error{ "body", "none", "must be in the scene tree of a running game", "add the node to the tree first" };
	}
	if (body->shape().chain() != nullptr) {
		return Error{ "body", "a rope", "must not be a SoftRope2D", "remove a joint, or join two ropes and remove the joint between them" };
	}
	return plan_cut(*body, options_of(p_node, *body, p_node.built_scale_), to_core(p_points), limits_of(p_node));
}

Result<BodyCut> BodyCuts::plan_tear(const SoftBody2D &p_node, double p_stretch) {
	if (Status refused = p_node.structure_.check_as_drawn()) {
		return *refused;
	}
	const SoftBodyData *body = whole_of(p_node);
	if (body == nullptr) {
		return Error{ "body", "none", "must be in the scene tree of a running game", "add the node to the tree first" };
	}
	return softbody::plan_tear(*body, options_of(p_node, *body, p_node.built_scale_), { Real(p_stretch), limits_of(p_node) });
}

const SoftBodyData *BodyCuts::whole_of(const SoftBody2D &p_node) {
	const SoftBodyData *body = p_node.followed_body();
	return body != nullptr && p_node.design() != nullptr && p_node.space_ != nullptr ? body : nullptr;
}

TearRules BodyCuts::tear_rules(const SoftBody2D &p_node, const SoftBodyData &p_copy) {
	const Transform2D transform = p_node.is_inside_tree() ? p_node.get_global_transform() : p_node.get_transform();
	return { options_of(p_node, p_copy, scale_and_skew(transform)), { Real(p_node.most_bearable_strain()), limits_of(p_node) },
		p_node.material_.values().tear_stretch > 0 && !p_node.structure_.check_as_drawn() };
}

StructureOptions BodyCuts::options_of(const SoftBody2D &p_node, const SoftBodyData &p_body, const Transform2D &p_scale) {
	StructureOptions options = p_node.structure_.options(p_node.structure_.simulated_scale(p_scale));
	options.mass = p_body.shape().total_mass();
	options.elastic = p_body.shape().modes() != nullptr;
	options.elastic_triangles = p_body.shape().triangles() != nullptr;
	return options;
}

BodyCutLimits BodyCuts::limits_of(const SoftBody2D &p_node) {
	BodyCutLimits limits;
	limits.smallest_piece = Real(p_node.values_.smallest_piece);
	limits.least_width = LEAST_PIECE_WIDTH;
	return limits;
}

TypedArray<PackedVector2Array> BodyCuts::outlines(const BodyCut &p_cut) {
	TypedArray<PackedVector2Array> outlines;
	for (const BodyPiece &piece : p_cut.pieces) {
		PackedVector2Array outline;
		for (const uint32_t point : piece.outline) {
			outline.push_back(to_godot(p_cut.polygon.points[point].position));
		}
		outlines.push_back(outline);
	}
	return outlines;
}

// The pieces stay in the coordinates of the whole, so that a texture goes on across the cut, and attachments keep their places.
void BodyCuts::describe_pieces(const BodyCut &p_cut) {
	const BodyStructure::Values &whole = node_.structure_.values();
	const SkinStyle &style = node_.skin_.style();
	const PointOrder order = node_.order();
	const auto in_core_order = [&](const auto &p_values, auto &r_list) {
		if (p_values.size() == whole.polygon.size()) {
			for (int i = 0; i < int(p_values.size()); i++) {
				r_list.push_back(p_values[order.mirror(i)]);
			}
		}
	};
	std::vector<Vector2> corners;
	const std::vector<Vector2> uv = node_.skin_.uv_in_use();
	std::vector<Color> colors;
	in_core_order(whole.polygon, corners);
	in_core_order(style.vertex_colors, colors);
	const std::vector<Vector2> places = carried<Vector2>(p_cut.polygon, corners);
	const std::vector<Vector2> uv_places = uv.empty() ? uv : carried<Vector2>(p_cut.polygon, uv);
	const std::vector<Color> point_colors = colors.empty() ? colors : carried<Color>(p_cut.polygon, colors);
	for (const BodyPiece &each : p_cut.pieces) {
		Piece piece;
		for (const uint32_t point : each.outline) {
			piece.structure.polygon.push_back(places[point]);
			if (!uv_places.empty()) {
				piece.uv.push_back(uv_places[point]);
			}
			if (!point_colors.empty()) {
				piece.vertex_colors.push_back(point_colors[point]);
			}
		}
		piece.cut_edges = cut_edges(p_cut, each);
		for (const uint32_t point : each.inner_points) {
			piece.structure.inner_points.push_back(whole.inner_points[int64_t(point)]);
		}
		const auto to_scales = [](const std::vector<Real> &p_scales, PackedFloat32Array &r_scales) {
			for (const Real scale : p_scales) {
				r_scales.push_back(float(scale));
			}
		};
		to_scales(each.options.spring_stiffness_scales, piece.structure.stiffness_scales);
		to_scales(each.options.spring_damping_scales, piece.structure.damping_scales);
		to_scales(each.options.spring_length_scales, piece.structure.length_scales);
		piece.structure.center_point = whole.center_point;
		piece.mass = node_.values_.mass * each.share;
		pieces_.push_back(std::move(piece));
	}
}

// Those of this cut, and what is left of those of earlier ones.
PackedInt32Array BodyCuts::cut_edges(const BodyCut &p_cut, const BodyPiece &p_piece) const {
	const PackedInt32Array &earlier = node_.skin_.style().cut_edges;
	const PointOrder order = node_.order();
	const std::size_t count = std::size_t(node_.structure_.polygon_count());
	PackedInt32Array edges;
	int edge = 0;
	for (const auto &source : source_edges(p_cut.polygon, count, p_piece.outline)) {
		if (!source || earlier.has(order.mirror_edge(int(*source)))) {
			edges.push_back(edge);
		}
		edge++;
	}
	return edges;
}

void BodyCuts::copy_to(SoftBody2D &r_node) const {
	for (const char *property : SHARED_PROPERTIES) {
		r_node.set(property, node_.get(property));
	}
	r_node.values_ = node_.values_;
	r_node.has_own_mass_ = node_.has_own_mass_;
	r_node.freeze_ = node_.freeze_;
	r_node.enabled_ = node_.enabled_;
	r_node.skin_.copy_look(node_.skin_);
	r_node.listen_to_textures(true);
	if (node_.material_.is_shared()) {
		r_node.set_soft_body_material(node_.material_.shared());
	} else {
		r_node.material_.exchange_own(node_.material_.values());
	}
	r_node.set_physics_material_override(node_.material_.surface_override());
	r_node.built_scale_ = node_.built_scale_;
	r_node.is_mirrored_x_ = node_.is_mirrored_x_;
}

void BodyCuts::take_structure(SoftBody2D &r_node, Piece &r_piece) {
	// Springs that were given one by one are gone; the network that they were is not.
	const SoftBody2D::ModelChoice choice = r_node.choose_model();
	if (choice.model == SoftBody2D::ELASTIC_MODEL_NETWORK && r_node.structure_.has_springs()) {
		r_node.values_.elastic_model = SoftBody2D::ELASTIC_MODEL_NETWORK;
	}
	using Values = BodyStructure::Values;
	r_node.structure_.exchange<&Values::polygon>(r_piece.structure.polygon);
	r_node.structure_.exchange<&Values::inner_points>(r_piece.structure.inner_points);
	r_node.structure_.exchange<&Values::springs>(r_piece.structure.springs);
	r_node.structure_.exchange<&Values::stiffness_scales>(r_piece.structure.stiffness_scales);
	r_node.structure_.exchange<&Values::damping_scales>(r_piece.structure.damping_scales);
	r_node.structure_.exchange<&Values::length_scales>(r_piece.structure.length_scales);
	r_node.structure_.exchange<&Values::center_point>(r_piece.structure.center_point);
	if (r_node.values_.mass_mode == SoftBody2D::MASS_MODE_CUSTOM) {
		r_node.values_.mass = r_piece.mass;
	}
	await_modes(r_node);
	r_node.design_.reset();
}

// A number that no earlier task had.
void BodyCuts::await_modes(SoftBody2D &r_node) {
	static uint64_t tasks = 0;
	r_node.awaited_modes_ = 0;
	if (r_node.choose_model().model == SoftBody2D::ELASTIC_MODEL_MODES) {
		r_node.awaited_modes_ = ++tasks;
	}
}

// Elastic modes take a hundred times as long as all the rest of a cut. Springs stand in for them for some ticks.
void BodyCuts::find_modes(SoftBody2D &r_node) {
	if (r_node.awaited_modes_ == 0) {
		return;
	}
	const SizedHull sized = r_node.sized_hull(r_node.built_scale_);
	StructureOptions options = r_node.structure_.options(sized.scale.rest);
	options.elastic = true;
	const auto held = std::make_shared<std::shared_ptr<const SoftBodyShape>>();
	const uint64_t task = r_node.awaited_modes_;
	SoftBodySimulation2D::get_singleton()->late_work().add(
			r_node.get_instance_id(), [held, hull = sized.points, options] { *held = prepare_shape(hull, options); },
			[held, &r_node, task] { take_modes(r_node, task); });
}

// The points stay, and so does the momentum, though masses are divided anew between them.
void BodyCuts::take_modes(SoftBody2D &r_node, uint64_t p_task) {
	if (r_node.awaited_modes_ != p_task) {
		return; // it was cut once more
	}
	r_node.awaited_modes_ = 0;
	r_node.design_.reset();
	if (r_node.body() == nullptr) {
		return;
	}
	const SoftBodyData before = *r_node.body();
	r_node.apply_shape();
	SoftBodyData *const after = r_node.body();
	keep_momentum(before, { &after, 1 });
	if (before.is_asleep()) {
		after->put_to_sleep();
	}
}

// At rest, with the damping of areas that the whole had.
Result<SoftBodyData> BodyCuts::create_body(const BodyDesign &p_design, const SoftBody2D &p_node) const {
	auto settings = p_node.make_settings(p_design);
	if (!settings) {
		return settings.error();
	}
	settings.value().linear_damp = whole_.settings().linear_damp;
	settings.value().angular_damp = whole_.settings().angular_damp;
	return SoftBodyData::create(p_design.shape, settings.value());
}

// The body as it will be, of a node that has the structure of the piece.
Status BodyCuts::make_body(const BodyCut &p_cut, std::size_t p_index, SoftBody2D &r_node) {
	Piece &piece = pieces_[p_index];
	auto design = r_node.make_design(node_.built_scale_);
	if (!design) {
		return design.error();
	}
	piece.design = std::move(design.value());
	auto body = create_body(piece.design, r_node);
	if (!body) {
		return body.error();
	}
	place_piece(whole_, p_cut, p_index, body.value());
	body.value().set_rotation_memory(whole_.rotation_memory());
	body.value().set_acceleration(whole_.acceleration());
	for (const auto &[point, source] : p_cut.pieces[p_index].pins) {
		if (Status status = body.value().set_pinned(point, true)) {
			return status;
		}
	}
	piece.body = std::move(body.value());
	return {};
}

void BodyCuts::take_pins(SoftBody2D &r_node, const BodyPiece &p_piece, const BodyPins &p_pins, PointOrder p_whole_order) {
	std::vector<std::pair<int, int>> points;
	for (const auto &[point, source] : p_piece.pins) {
		points.push_back({ r_node.order().mirror(int(point)), p_whole_order.mirror(int(source)) });
	}
	r_node.pins_.take_part(p_pins, points);
}

// Blending goes on from the frame of the whole. A piece is where the whole was seen, though the rendering server has not said
// so yet.
void BodyCuts::draw_as_before(SoftBody2D &r_node) const {
	if (was_moving_) {
		r_node.interpolation_.begin(start_);
	} else {
		r_node.interpolation_.end();
	}
	r_node.on_screen_ = node_.on_screen_;
	r_node.note_look();
}

// The first piece's body takes the place of the whole in the world.
void BodyCuts::keep_first() {
	Piece &piece = pieces_[0];
	node_.design_ = piece.design;
	node_.polygon_reversed_ = piece.design.is_reversed;
	node_.space_->world().replace_soft_body(node_.body_id_, std::move(*piece.body));
	node_.proxy_.forget_shape();
	node_.apply_exceptions();
	node_.apply_freeze();
	node_.contacts_.clear();
	SkinStyle &style = node_.skin_.change_style();
	style.uv = piece.uv;
	style.vertex_colors = piece.vertex_colors;
	style.cut_edges = piece.cut_edges;
	node_.update_topology();
	node_.note_change();
	node_.follow_body();
	node_.lock_rotation();
	draw_as_before(node_);
	node_.update_configuration_warnings();
}

void BodyCuts::add_piece(Piece &r_piece) {
	SoftBody2D &node = *r_piece.node;
	node.design_ = r_piece.design;
	node.polygon_reversed_ = r_piece.design.is_reversed;
	node.stored_body_ = std::make_unique<SoftBodyData>(std::move(*r_piece.body));
	SkinStyle &style = node.skin_.change_style();
	style.uv = r_piece.uv;
	style.vertex_colors = r_piece.vertex_colors;
	style.cut_edges = r_piece.cut_edges;
	node.update_topology();
	Node *parent = node_.get_parent();
	const CanvasItem *canvas_parent = node_.is_set_as_top_level() ? nullptr : Object::cast_to<CanvasItem>(parent);
	const Transform2D base = canvas_parent != nullptr ? canvas_parent->get_global_transform() : Transform2D();
	node.set_transform(base.affine_inverse() * node.transform_at(measure_frame(*node.stored_body_)));
	node.known_transform_ = base * node.get_transform();
	node.set_name(node_.get_name());
	const TypedArray<StringName> groups = node_.get_groups();
	for (int64_t i = 0; i < groups.size(); i++) {
		const StringName group = groups[i];
		if (!String(group).begins_with("_")) { // the engine's own
			node.add_to_group(group);
		}
	}
	if (!parent->is_node_ready()) { // which is busy with its children; the body waits for the tree
		parent->call_deferred("add_child", &node, true);
		return;
	}
	parent->add_child(&node, true);
	parent->move_child(&node, node_.get_index() + 1);
	if (node_.get_owner() != nullptr) {
		node.set_owner(node_.get_owner());
	}
	node.update_picker();
	node.lock_rotation();
	if (was_moving_ && node.is_physics_interpolated_and_enabled()) { // the engine blends it from the frame of the whole, too
		const Transform2D now = node.get_transform();
		node.set_transform(base.affine_inverse() * start_);
		node.known_transform_ = node.get_global_transform();
		node.reset_physics_interpolation();
		node.set_transform(now);
		node.known_transform_ = node.get_global_transform();
	}
	draw_as_before(node);
}

void BodyCuts::carry_exceptions(SoftBody2D &r_node) const {
	node_.exceptions_.for_each([&](uint64_t p_id) {
		Node *other = Object::cast_to<Node>(ObjectDB::get_instance(p_id));
		if (other == nullptr || other == &r_node) {
			return;
		}
		SoftBody2D *soft = Object::cast_to<SoftBody2D>(other);
		if (soft != nullptr && node_.exceptions_.is_taken(p_id)) {
			soft->add_collision_exception_with(&r_node);
		}
		if (std::ranges::find(node_.exceptions_.chosen(), p_id) != node_.exceptions_.chosen().end()) {
			r_node.add_collision_exception_with(other);
		}
	});
}

// Paths begin at the node, and the piece stands elsewhere.
void BodyCuts::carry_pin_targets(SoftBody2D &r_node) const {
	if (!r_node.is_inside_tree()) {
		return;
	}
	TypedArray<NodePath> targets;
	for (const int32_t point : r_node.pins_.points()) {
		const NodePath path = r_node.pins_.target_of(point);
		Node *target = path.is_empty() ? nullptr : node_.get_node_or_null(path);
		targets.push_back(target != nullptr ? r_node.get_path_to(target) : path);
	}
	r_node.pins_.set_paths(targets);
}

// Attachments go to the piece on whose undeformed polygon they stand, or to the nearest one.
std::vector<uint64_t> BodyCuts::carry_attachments() {
	std::vector<uint64_t> gone;
	const TypedArray<Node> children = node_.get_children();
	for (int64_t i = 0; i < children.size(); i++) {
		SoftBodyAttachment2D *attachment = Object::cast_to<SoftBodyAttachment2D>(children[i]);
		if (attachment == nullptr) {
			continue;
		}
		const Vec2 place = to_core(attachment->get_rest_position());
		std::size_t holder = 0;
		double least = HUGE_VAL;
		for (std::size_t k = 0; k < pieces_.size(); k++) {
			const std::vector<Vec2> polygon = to_core(pieces_[k].structure.polygon);
			const double distance = point_in_polygon(place, polygon) ? -1 : double(nearest_place(polygon, place).distance_squared);
			if (distance < least) {
				least = distance;
				holder = k;
			}
		}
		attachment->attach_at(attachment->get_rest_position(), attachment->get_rest_rotation());
		if (holder != 0) {
			attachment->reparent(pieces_[holder].node, false);
			gone.push_back(attachment->get_instance_id());
		}
		attachment->follow_now();
	}
	return gone;
}

Result<TypedArray<SoftBody2D>> BodyCuts::make(const BodyCut &p_cut) {
	describe_pieces(p_cut);
	was_moving_ = node_.interpolation_.is_moving();
	start_ = node_.interpolation_.start();
	const BodyStructure old_structure = node_.structure_;
	const SoftBody2D::Values old_values = node_.values_;
	const std::optional<BodyDesign> old_design = node_.design_;
	const uint64_t old_task = node_.awaited_modes_;
	CutHistory::Entry before{ CutHistory::next_cut(), structure_of(node_), old_design, node_.pins_, {} };
	Status refused;
	for (std::size_t i = 1; i < pieces_.size() && !refused; i++) {
		pieces_[i].node = memnew(SoftBody2D);
		copy_to(*pieces_[i].node);
		pieces_[i].node->structure_ = old_structure; // by which the model was chosen
		take_structure(*pieces_[i].node, pieces_[i]);
		refused = make_body(p_cut, i, *pieces_[i].node);
	}
	if (!refused) {
		pieces_[0].node = &node_;
		take_structure(node_, pieces_[0]);
		refused = make_body(p_cut, 0, node_);
	}
	if (refused) {
		node_.structure_ = old_structure;
		node_.values_ = old_values;
		node_.design_ = old_design;
		node_.awaited_modes_ = old_task;
		for (std::size_t i = 1; i < pieces_.size(); i++) {
			if (pieces_[i].node != nullptr) {
				memdelete(pieces_[i].node);
			}
		}
		return *refused;
	}
	std::vector<SoftBodyData *> bodies;
	for (Piece &piece : pieces_) {
		bodies.push_back(&*piece.body);
	}
	keep_momentum(whole_, bodies);

	const BodyPins pins = node_.pins_;
	const PointOrder order = node_.order();
	const uint64_t cut = before.cut;
	node_.cuts_.add(std::move(before));
	TypedArray<SoftBody2D> nodes;
	std::vector<uint64_t> ids;
	for (std::size_t i = 0; i < pieces_.size(); i++) {
		SoftBody2D &node = *pieces_[i].node;
		node.polygon_reversed_ = pieces_[i].design.is_reversed;
		take_pins(node, p_cut.pieces[i], pins, order);
		if (i == 0) {
			keep_first();
		} else {
			node.cuts_.begin_as(node_.cuts_.first());
			add_piece(pieces_[i]);
			carry_pin_targets(node);
			carry_exceptions(node);
		}
		find_modes(node);
		nodes.push_back(&node);
		ids.push_back(node.get_instance_id());
	}
	node_.cuts_.last().attachments = carry_attachments();
	for (SteppedJoint *joint : node_.space_->joints()) {
		joint->follow_cut(cut, node_.get_instance_id(), whole_, ids);
	}
	return nodes;
}

} // namespace softbody
