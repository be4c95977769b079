// SPDX-License-Identifier: MIT
// The node's looks: the rest shape that they are made for, where it is drawn between physics ticks, and whether it needs to be.
#include "godot/nodes/soft_body_2d.h"

#include "godot/convert.h"
#include "godot/nodes/rope_part.h"
#include "godot/server/soft_body_simulation_2d.h"
#include "godot/server/soft_body_space_2d.h"

#include <godot_cpp/classes/engine.hpp>
#include <godot_cpp/classes/rendering_server.hpp>
#include <godot_cpp/core/error_macros.hpp>

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

using softbody::Aabb;
using softbody::SkinStyle;
using softbody::Vec2;

namespace godot {

namespace {

String size_warning(const char *p_property, int64_t p_size, int64_t p_polygon_size) {
	return "'" + String(p_property) + "' has " + String::num_int64(p_size) + " entries and the polygon " + String::num_int64(p_polygon_size) + " points, so it is not used. Give it one entry for each point of the polygon, or none.";
}

// The area in which a skin may move before the rendering server is told again reaches farther by this part of its size.
constexpr real_t AREA_RESERVE = 0.25;
// So much larger than needed, as a ratio of areas, it is made smaller again.
constexpr real_t AREA_EXCESS = 6;
// So many frames in a row without a word of the rendering server make a body off-screen: it tells of a frame after it.
constexpr int UNSEEN_FRAMES = 3;

Rect2 rect_of(const Aabb &p_box) {
	return Rect2(softbody::to_godot(p_box.min), softbody::to_godot(p_box.max - p_box.min));
}

} // namespace

void SoftBody2D::update_topology() {
	rest_version_++;
	// Of the node's scale one pixel is this part; the parent's and the camera's are left out, as Godot's own lines do.
	const Vector2 scale = built_scale_.get_scale().abs();
	const real_t pixel = 1 / MAX(real_t(1e-3), (scale.x + scale.y) / 2);
	rest_points_ = structure_.rest_points(polygon_reversed_);
	const softbody::DrawnOutline *outline = structure_.outline();
	const softbody::PointOrder drawn_order = outline != nullptr ? softbody::PointOrder{ structure_.polygon_count(), false } : order();
	std::vector<Vec2> rest = outline != nullptr ? outline->drawn_rest(rest_points_) : rest_points_;
	std::span<const std::size_t> holes;
	if (structure_.holes() != nullptr) {
		const std::span<const Vec2> drawn = with_holes(std::span<const Vec2>(rest).first(std::size_t(structure_.polygon_count())), rest_points_);
		rest.assign(drawn.begin(), drawn.end());
		holes = structure_.holes()->counts();
	}
	skin_.set_rest(std::move(rest), drawn_order, softbody::Real(pixel), holes);
	remake_skin();
}

// The commands of the canvas item hold colors and textures; drawing them again also brings the meshes up to date.
void SoftBody2D::remake_skin() {
	note_look();
	queue_redraw();
}

// The next frame does not leave the node out, though its body may rest.
void SoftBody2D::note_look() {
	settled_ = false;
	area_checked_ = false;
	if (space_ != nullptr) {
		space_->note_look(*this);
	}
}

void SoftBody2D::append_drawing_warnings(PackedStringArray &r_warnings) const {
	const SkinStyle &style = skin_.style();
	if (!style.vertex_colors.is_empty() && style.vertex_colors.size() != structure_.polygon_count()) {
		r_warnings.push_back(size_warning("vertex_colors", style.vertex_colors.size(), structure_.polygon_count()));
	}
	if (!style.uv.is_empty() && style.uv.size() != structure_.polygon_count()) {
		r_warnings.push_back(size_warning("uv", style.uv.size(), structure_.polygon_count()));
	}
	if (style.cut_edges.size() > structure_.polygon_count()) {
		r_warnings.push_back("'cut_edges' has " + String::num_int64(style.cut_edges.size()) + " entries, more than the polygon has edges. Name each edge once.");
	}
	for (const int32_t edge : style.cut_edges) {
		if (edge < 0 || edge >= structure_.polygon_count()) {
			r_warnings.push_back("'cut_edges' names edge " + String::num_int64(edge) + " and the polygon has edges 0 to " + String::num_int64(structure_.polygon_count() - 1) + ", so it is not used. Leave it out.");
			break;
		}
	}
}

// A texture that changes may have another size, or show another part of an atlas.
void SoftBody2D::follow_texture() {
	skin_.change_style();
	remake_skin();
}

void SoftBody2D::listen_to_textures(bool p_listens) {
	const Callable changed = own_callable("_follow_texture");
	for (const Ref<Texture2D> &texture : { skin_.style().texture, skin_.style().outline_texture, skin_.style().cut_texture }) {
		if (texture.is_valid() && texture->is_connected("changed", changed) != p_listens) {
			if (p_listens) {
				texture->connect("changed", changed);
			} else {
				texture->disconnect("changed", changed);
			}
		}
	}
}

// Frames.

// Where the engine blends the canvas item's transform, drawing leaves the frame to it. Where it does not, the canvas
// item is put where the body is drawn, and with it all that is drawn below the node in the tree; the node itself stays
// at the tick.

// A node set anew from outside is drawn there at once if we blend, and on its way there if the engine does, as all
// nodes are.
void SoftBody2D::note_move_by_user(const Transform2D &p_from, const Transform2D &p_to) {
	interpolation_.carry(p_from, p_to, is_physics_interpolated_and_enabled());
}

// A camera that hangs on the body moves in ticks, unless the engine blends. So must the body then, or it would tremble
// on the screen.
bool SoftBody2D::is_drawn_at_tick() const {
	return view_ != nullptr && view_->is_carried_by(this) && !is_physics_interpolated_and_enabled();
}

std::span<const Vec2> SoftBody2D::local_points(double p_fraction) const {
	static std::vector<Vec2> points;
	if (space_ == nullptr || body() == nullptr) {
		return rest_points_;
	}
	const softbody::SoftBodyData &data = *body();
	points.resize(data.point_count());
	interpolation_.local_points(known_transform_, p_fraction, data.previous_positions(), data.positions(), points);
	const Transform2D simulated = structure_.simulated_scale(built_scale_);
	if (simulated != built_scale_) { // drawn as small as the node is
		const Transform2D shrink = simulated.affine_inverse() * built_scale_;
		for (Vec2 &point : points) {
			point = softbody::to_core(shrink.xform(softbody::to_godot(point)));
		}
	}
	return points;
}

std::span<const Vec2> SoftBody2D::drawn_points(double p_fraction) const {
	const softbody::DrawnOutline *outline = structure_.outline();
	const std::span<const Vec2> points = local_points(p_fraction);
	const std::span<const Vec2> drawn = outline != nullptr ? outline->follow(points, order()) : points;
	return structure_.holes() != nullptr ? with_holes(drawn.first(std::size_t(structure_.polygon_count())), points) : drawn;
}

bool SoftBody2D::check_fraction(double &r_fraction) const {
	if (r_fraction == -1) {
		r_fraction = is_drawn_at_tick() ? 1 : softbody::present_fraction();
	}
	ERR_FAIL_COND_V_MSG(!(r_fraction >= 0 && r_fraction <= 1), false, describe() + ": fraction = " + String::num(r_fraction) + " must be between 0 and 1, or -1 for that of the present frame.");
	return true;
}

PackedVector2Array SoftBody2D::get_interpolated_polygon(double p_fraction) const {
	PackedVector2Array polygon;
	if (!check_fraction(p_fraction) || followed_body() == nullptr || space_ == nullptr) {
		return polygon;
	}
	const Transform2D frame = interpolation_.frame(known_transform_, p_fraction);
	const std::span<const Vec2> points = drawn_points(p_fraction);
	const bool is_drawn_in_order = structure_.outline() != nullptr;
	polygon.resize(structure_.polygon_count());
	Vector2 *write = polygon.ptrw();
	for (int i = 0; i < structure_.polygon_count(); i++) {
		write[i] = frame.xform(softbody::to_godot(points[is_drawn_in_order ? std::size_t(i) : core_index(i)]));
	}
	return polygon;
}

Transform2D SoftBody2D::get_interpolated_transform(double p_fraction) const {
	if (!check_fraction(p_fraction) || followed_body() == nullptr || space_ == nullptr) {
		return get_global_transform();
	}
	return interpolation_.frame(known_transform_, p_fraction);
}

void SoftBody2D::draw() {
	skin_.note_tint(softbody::is_tinted(*this)); // of a node that was there before the library was loaded anew
	if (rope() != nullptr) {
		skin_.change_style().uv = rope()->texture_coordinates(skin_.style().texture, structure_.values());
	}
	skin_.draw(get_canvas_item());
	const double fraction = is_drawn_at_tick() ? 1 : softbody::present_fraction();
	skin_.update(drawn_points(fraction));
	update_seen_area();
}

// While a body moves and no camera sees it, its skin stays as it was drawn last, and only its area is followed: it may grow
// into view. Once it rests, its skin is brought to where it rests.
bool SoftBody2D::draw_frame(const softbody::DrawingFrame &p_frame) {
	unseen_frames_ = on_screen_ ? 0 : MIN(unseen_frames_ + 1, UNSEEN_FRAMES);
	if (settled_) {
		return false;
	}
	const double fraction = is_drawn_at_tick() ? 1 : p_frame.fraction();
	place_canvas_item(fraction);
	if (on_screen_ || view_->is_unsteady() || !interpolation_.is_moving()) {
		skin_.update(drawn_points(fraction));
		update_seen_area();
		if (debug_drawing_) {
			draw_debug(fraction);
		}
		settled_ = !interpolation_.is_moving();
		return true;
	}
	if (!area_checked_) {
		area_checked_ = true;
		const std::span<const Vec2> points = local_points(1);
		if (!skin_area_.encloses(rect_of(softbody::bounding_box(points)))) {
			skin_.update(drawn_points(1));
			update_seen_area();
			return true;
		}
	}
	return false;
}

// The frames in which no camera sees the body are counted as far as needed.
bool SoftBody2D::is_drawn() const {
	return settled_ && (on_screen_ || unseen_frames_ == UNSEEN_FRAMES);
}

void SoftBody2D::draw_debug(double p_fraction) {
	const softbody::SoftBodyData *found = body();
	if (found == nullptr) {
		return;
	}
	// Contacts are sorted by body, but few look at this.
	std::vector<softbody::Contact> contacts;
	for (const softbody::Contact &contact : space_->simulator().contacts()) {
		if (contact.body == body_id_ && interpolation_.is_moving()) {
			contacts.push_back(contact);
		}
	}
	const double delta = 1.0 / Engine::get_singleton()->get_physics_ticks_per_second();
	debug_drawing_->draw(*found, local_points(p_fraction), interpolation_.frame(known_transform_, p_fraction), contacts, space_->simulator().plan(*found, softbody::Real(delta)));
}

void SoftBody2D::place_canvas_item(double p_fraction) {
	const bool is_ours = interpolation_.is_moving() && (on_screen_ || view_->is_unsteady()) && !is_physics_interpolated_and_enabled();
	if (is_ours) {
		const Transform2D frame = interpolation_.frame(known_transform_, p_fraction);
		RenderingServer::get_singleton()->canvas_item_set_transform(get_canvas_item(), get_transform() * known_transform_.affine_inverse() * frame);
	} else if (item_displaced_) {
		RenderingServer::get_singleton()->canvas_item_set_transform(get_canvas_item(), get_transform());
	}
	item_displaced_ = is_ours;
}

void SoftBody2D::enter_screen() {
	on_screen_ = true;
	unseen_frames_ = 0;
}

void SoftBody2D::leave_screen() {
	on_screen_ = false;
	if (space_ != nullptr) {
		space_->note_look(*this); // to count frames
	}
}

// A body that no frame has had a chance to show, as without a screen, is not off-screen.
bool SoftBody2D::is_off_screen() const {
	return unseen_frames_ >= UNSEEN_FRAMES;
}

// Tells the rendering server in which part of the plane the body is drawn: it draws the canvas item, and says that it
// is seen, when a viewport shows any of it.
void SoftBody2D::update_seen_area() {
	const Rect2 box = rect_of(skin_.bounds());
	if (skin_area_.encloses(box) && skin_area_.get_area() <= AREA_EXCESS * box.get_area()) {
		return;
	}
	skin_area_ = box.grow(AREA_RESERVE * MAX(box.size.x, box.size.y));
	if (!entered_screen_.is_valid()) {
		entered_screen_ = own_callable("_enter_screen");
		left_screen_ = own_callable("_leave_screen");
	}
	const Vector2 scale = known_transform_.get_scale().abs();
	const real_t margin = real_t(softbody::DrawingFrame::MARGIN) / MAX(real_t(1e-3), MIN(scale.x, scale.y));
	RenderingServer::get_singleton()->canvas_item_set_visibility_notifier(get_canvas_item(), true, skin_area_.grow(margin), entered_screen_, left_screen_);
}

} // namespace godot
