// SPDX-License-Identifier: MIT
// The looks of a body: two meshes whose vertices follow its points.
#include "godot/drawing/soft_body_skin.h"

#include "core/geometry/polygon.h"

#include <godot_cpp/classes/rendering_server.hpp>
#include <godot_cpp/core/math.hpp>
#include <godot_cpp/variant/packed_int32_array.hpp>

#include <algorithm>
#include <cmath>

using namespace godot;

namespace softbody {

namespace {

// Pieces of a hull edge on a smooth outline. A hull of very many points is smooth by itself, and the time to make
// triangles grows with the square of their number.
constexpr std::size_t SMOOTH_PIECES = 4;
constexpr std::size_t MOST_SMOOTHED_POINTS = 256;
// Vertices of an arc around a corner of the outline; every corner of a smooth outline is blunt.
constexpr std::uint32_t ARC_POINTS = 5;
constexpr std::uint32_t SMOOTH_ARC_POINTS = 2;

static_assert(sizeof(Vec2) == 2 * sizeof(float), "the rendering server reads vertices as pairs of float");

// Part of a texture of the graphics card, for an AtlasTexture.
struct TexturePart {
	Vector2 size{ 1, 1 }; // of the part, in pixels
	Vector2 start; // both as shares of the whole
	Vector2 share{ 1, 1 };
};

TexturePart part_of(const Ref<Texture2D> &p_texture) {
	TexturePart part;
	if (p_texture.is_null()) {
		return part;
	}
	const Vector2 size = p_texture->get_size();
	if (!(size.x > 0 && size.y > 0)) {
		return part;
	}
	part.size = size;
	if (p_texture->is_class("AtlasTexture")) {
		const Ref<Texture2D> atlas = p_texture->get("atlas");
		const Rect2 region = p_texture->get("region");
		const Vector2 whole = atlas.is_valid() ? atlas->get_size() : Vector2();
		if (whole.x > 0 && whole.y > 0 && region.has_area()) {
			part.start = region.position / whole;
			part.share = region.size / whole;
		}
	}
	return part;
}

RID rid_of(const Ref<Texture2D> &p_texture) {
	return p_texture.is_valid() ? p_texture->get_rid() : RID();
}

// Crowds come of one kind at a time, so the last mesh is the one that is asked for again.
std::shared_ptr<const FillMesh> fill_mesh_of(std::span<const Vec2> rest, std::size_t hull_count, const FillMesh::Options &options, std::span<const std::size_t> holes) {
	static std::shared_ptr<const FillMesh> last;
	if (last == nullptr || !last->is_made_of(rest, hull_count, options, holes)) {
		last = std::make_shared<const FillMesh>(rest, hull_count, options, holes);
	}
	return last;
}

} // namespace

SoftBodySkin::~SoftBodySkin() {
	fill_mesh_.free();
	outline_mesh_.free();
	cut_mesh_.free();
}

std::span<Vec2> SoftBodySkin::Mesh::vertices() {
	return { reinterpret_cast<Vec2 *>(bytes.ptrw()), vertex_count };
}

void SoftBodySkin::Mesh::make(const std::vector<Triangle> &triangles, std::span<const Vector2> uvs,
		std::span<const Color> colors) {
	PackedInt32Array indices;
	indices.resize(int64_t(triangles.size() * 3));
	int32_t *index = indices.ptrw();
	for (const Triangle &triangle : triangles) {
		for (const std::uint32_t corner : triangle) {
			*index++ = int32_t(corner);
		}
	}
	vertex_count = uvs.size();
	PackedVector2Array places;
	places.resize(int64_t(vertex_count)); // all at the origin, until the first update
	places.fill(Vector2());
	PackedVector2Array uv_array;
	uv_array.resize(int64_t(vertex_count));
	std::ranges::copy(uvs, uv_array.ptrw());
	Array arrays;
	arrays.resize(RenderingServer::ARRAY_MAX);
	arrays[RenderingServer::ARRAY_VERTEX] = places;
	arrays[RenderingServer::ARRAY_TEX_UV] = uv_array;
	arrays[RenderingServer::ARRAY_INDEX] = indices;
	if (!colors.empty()) {
		PackedColorArray color_array;
		color_array.resize(int64_t(colors.size()));
		std::ranges::copy(colors, color_array.ptrw());
		arrays[RenderingServer::ARRAY_COLOR] = color_array;
	}
	RenderingServer *server = RenderingServer::get_singleton();
	if (rid.is_valid()) {
		server->mesh_clear(rid);
	} else {
		rid = server->mesh_create();
	}
	server->mesh_add_surface_from_arrays(rid, RenderingServer::PRIMITIVE_TRIANGLES, arrays, Array(), Dictionary(),
			RenderingServer::ARRAY_FLAG_USE_DYNAMIC_UPDATE);
	bytes.resize(int64_t(vertex_count * sizeof(Vec2)));
}

void SoftBodySkin::Mesh::send() const {
	RenderingServer::get_singleton()->mesh_surface_update_vertex_region(rid, 0, 0, bytes);
}

void SoftBodySkin::Mesh::free() {
	if (rid.is_valid()) {
		RenderingServer::get_singleton()->free_rid(rid);
		rid = RID();
	}
}

void SoftBodySkin::note_tint(bool tinted) {
	if (!is_tinted_) {
		is_tinted_ = tinted;
		is_stale_ = true;
	}
}

void SoftBodySkin::copy_look(const SoftBodySkin &other) {
	change_style() = other.style_;
	is_tinted_ = other.is_tinted_;
}

void SoftBodySkin::set_rest(std::vector<Vec2> rest, PointOrder order, Real pixel, std::span<const std::size_t> holes) {
	holes_.assign(holes.begin(), holes.end());
	rest_ = std::move(rest);
	hull_count_ = std::size_t(order.hull_count);
	order_ = order;
	pixel_ = pixel;
	is_stale_ = true;
}

// The hull's box shows the whole texture, unless `uv` assigns a texture pixel to each hull point. Offset, rotation and
// scale then move it as those of Polygon2D do, around the middle of the box.
std::vector<Vec2> SoftBodySkin::corner_pixels(Vector2 part_size) const {
	std::vector<Vec2> pixels;
	if (has_own_uv()) {
		for (std::size_t i = 0; i < hull_count_; ++i) {
			pixels.push_back(to_core(style_.uv[order_.mirror(int(i))]));
		}
		return pixels;
	}
	const std::span<const Vec2> hull = std::span<const Vec2>(rest_).first(hull_count_);
	const Aabb box = bounding_box(hull);
	const Vec2 size = box.max - box.min;
	for (const Vec2 p : hull) {
		pixels.push_back({ (p.x - box.min.x) / size.x * Real(part_size.x), (p.y - box.min.y) / size.y * Real(part_size.y) });
	}
	return pixels;
}

// Rotation and scale are about the texture's middle where the box shows it, and about its corner where `uv` says what is shown.
std::vector<Vector2> SoftBodySkin::uv_in_use() const {
	std::vector<Vector2> uvs;
	if (style_.texture.is_null() && !has_own_uv()) {
		return uvs;
	}
	const Vector2 size = part_of(style_.texture).size;
	Vector2 shift;
	if (!has_own_uv() && style_.texture_scale.x != 0 && style_.texture_scale.y != 0) {
		const Transform2D turn(real_t(style_.texture_rotation), Vector2());
		shift = turn.basis_xform_inv(size / 2 / style_.texture_scale) - size / 2;
	}
	for (const Vec2 pixel : corner_pixels(size)) {
		uvs.push_back(to_godot(pixel) + shift);
	}
	return uvs;
}

std::vector<Vector2> SoftBodySkin::texture_coordinates() const {
	const TexturePart part = part_of(style_.texture);
	const std::vector<Vec2> pixels = corner_pixels(part.size);
	const Vector2 middle = has_own_uv() ? Vector2() : part.size / 2;
	const Transform2D turn(real_t(style_.texture_rotation), Vector2());
	std::vector<Vector2> uvs;
	for (const Vec2 pixel : fill_->spread<Vec2>(pixels)) {
		const Vector2 moved = (turn.xform(to_godot(pixel) - middle) + style_.texture_offset) * style_.texture_scale + middle;
		uvs.push_back(part.start + moved / part.size * part.share);
	}
	return uvs;
}

std::vector<Color> SoftBodySkin::colors() const {
	const bool has_own = std::size_t(style_.vertex_colors.size()) == hull_count_;
	if (!has_own && fill_->faded_start() == fill_->vertex_count()) {
		return {};
	}
	std::vector<Color> hull(hull_count_, Color(1, 1, 1));
	if (has_own) {
		for (std::size_t i = 0; i < hull_count_; ++i) {
			hull[i] = style_.vertex_colors[order_.mirror(int(i))];
		}
	}
	std::vector<Color> colors = fill_->spread<Color>(hull);
	for (std::size_t i = 0; i < colors.size(); ++i) {
		colors[i] = colors[i].clamp();
		if (i >= fill_->band_start() && fill_->band_start() != fill_->faded_start()) {
			colors[i] *= Color(RIM_SHADE, RIM_SHADE, RIM_SHADE);
		}
		if (i >= fill_->faded_start()) {
			colors[i].a = 0;
		}
	}
	return colors;
}

// Rough width of what is between the hull and the holes: twice its area over the length of all outlines, as SoftBodyShape::width.
Real SoftBodySkin::wall_width() const {
	const std::span<const Vec2> points = rest_;
	Real area = std::abs(signed_area(points.first(hull_count_)));
	Real around = perimeter(points.first(hull_count_));
	std::size_t start = hull_count_;
	for (const std::size_t count : holes_) {
		area -= std::abs(signed_area(points.subspan(start, count)));
		around += perimeter(points.subspan(start, count));
		start += count;
	}
	return 2 * area / around;
}

void SoftBodySkin::make_fill() {
	// A hard edge must not show through the soft one of an outline on top of it.
	const Real soft_edge = drawn_.antialiased && !has_outline() ? pixel_ : 0;
	const Real inset = drawn_.antialiased && has_outline() ? std::min(pixel_, Real(drawn_.outline_width) / 2) : 0;
	const Real rim_width = is_soft() ? soft_rim_width(style_, std::span<const Vec2>(rest_).first(hull_count_)) : 0;
	const Real band = holes_.empty() ? rim_width : std::min(rim_width, wall_width() / 3);
	const bool is_curved = drawn_.smooth && hull_count_ <= MOST_SMOOTHED_POINTS;
	const std::size_t pieces = is_soft() ? soft_pieces(hull_count_) : SMOOTH_PIECES;
	fill_ = fill_mesh_of(rest_, hull_count_, { is_curved ? pieces : 1, soft_edge, inset, band }, holes_);
	if (has_fill()) {
		fill_mesh_.make(fill_->triangles(), texture_coordinates(), colors());
	} else {
		fill_mesh_.free();
	}
}

std::vector<std::uint8_t> SoftBodySkin::cut_edges() const {
	std::size_t pieces = 1; // of the rim, for each edge of the hull
	fill_->for_rims([&](std::size_t start, std::size_t count) { pieces = start == 0 ? count / hull_count_ : pieces; });
	std::vector<std::uint8_t> edges(fill_->rim_count(), 0);
	for (std::size_t i = 0; i < hull_count_; ++i) {
		if (drawn_.cut_edges.has(order_.mirror_edge(int(i)))) {
			std::fill_n(edges.begin() + std::ptrdiff_t(i * pieces), pieces, std::uint8_t(1));
		}
	}
	return edges;
}

std::vector<OutlineBand> SoftBodySkin::make_bands(Mesh &r_mesh, std::span<const Vec2> rim, Real width, const Ref<Texture2D> &texture, bool is_tiled, std::span<const std::uint8_t> edges) const {
	const std::uint32_t arc = drawn_.smooth ? SMOOTH_ARC_POINTS : ARC_POINTS;
	std::vector<OutlineBand::Rail> rails;
	if (drawn_.antialiased) {
		const Real half = std::min(pixel_, width) / 2;
		rails = { { -half, 1 }, { half, 1 }, { width - half, arc }, { width + half, arc } };
	} else {
		rails = { { 0, 1 }, { width, arc } };
	}
	const TexturePart part = part_of(texture);
	// A whole number of tiles, so that the last tile ends where the first begins.
	const Real tile = width * Real(part.size.x / part.size.y);
	std::vector<OutlineBand> bands;
	std::vector<Triangle> triangles;
	std::vector<Vector2> uvs;
	std::vector<Color> colors;
	fill_->for_rims([&](std::size_t start, std::size_t count) {
		const std::span<const Vec2> loop = rim.subspan(start, count);
		const OutlineBand band(count, rails, edges.empty() ? edges : edges.subspan(start, count));
		std::vector<Real> way{ 0 }; // along the rim at rest
		for (std::size_t i = 0; i < loop.size(); ++i) {
			way.push_back(way.back() + length(loop[(i + 1) % loop.size()] - loop[i]));
		}
		const Real tiles = is_tiled ? std::max(Real(1), std::round(way.back() / tile)) : Real(1);
		const std::size_t first = uvs.size();
		uvs.resize(first + band.vertex_count());
		colors.resize(drawn_.antialiased ? uvs.size() : 0, Color(1, 1, 1));
		band.for_vertices([&](std::size_t vertex, std::size_t corner, std::size_t rail) {
			const Vector2 uv(way[corner] / way.back() * tiles, CLAMP(rails[rail].distance / width, Real(0), Real(1)));
			uvs[first + vertex] = is_tiled ? uv : part.start + uv * part.share;
			if (!colors.empty() && (rail == 0 || rail + 1 == rails.size())) {
				colors[first + vertex].a = 0;
			}
		});
		for (Triangle triangle : band.triangles()) {
			for (std::uint32_t &corner : triangle) {
				corner += std::uint32_t(first);
			}
			triangles.push_back(triangle);
		}
		bands.push_back(band);
	});
	if (!triangles.empty()) { // of a piece that was cut all around there is no outline
		r_mesh.make(triangles, uvs, colors);
	}
	return bands;
}

void SoftBodySkin::place_bands(const std::vector<OutlineBand> &bands, std::span<const Vec2> rim, std::span<Vec2> vertices) const {
	std::size_t band = 0;
	fill_->for_rims([&](std::size_t start, std::size_t count) {
		bands[band].place(rim.subspan(start, count), fill_->side(), vertices);
		vertices = vertices.subspan(bands[band].vertex_count());
		band++;
	});
}

// The outline lies inside the hull: its outer edge is where the body touches other things.
void SoftBodySkin::make_outline(std::span<const Vec2> rim) {
	outline_mesh_.free();
	if (!has_outline()) {
		return;
	}
	std::vector<std::uint8_t> edges;
	if (has_cuts()) {
		edges = cut_edges();
		for (std::uint8_t &edge : edges) {
			edge = edge == 0 ? 1 : 0;
		}
	}
	const bool is_tiled = drawn_.outline_texture_mode == SkinStyle::OUTLINE_TEXTURE_TILE;
	outline_ = make_bands(outline_mesh_, rim, Real(drawn_.outline_width), drawn_.outline_texture, is_tiled, edges);
}

void SoftBodySkin::make_cuts(std::span<const Vec2> rim) {
	cut_mesh_.free();
	if (has_cuts()) {
		cut_bands_ = make_bands(cut_mesh_, rim, Real(drawn_.cut_width), drawn_.cut_texture, true, cut_edges());
	}
}

void SoftBodySkin::make() {
	is_stale_ = false;
	drawn_ = is_soft() ? soften(style_) : style_;
	make_fill();
	const std::span<const Vec2> rim = rim_at(rest_);
	make_outline(rim);
	make_cuts(rim);
}

std::span<Vec2> SoftBodySkin::rim_at(std::span<const Vec2> points) const {
	static std::vector<Vec2> rim;
	rim.resize(fill_->rim_count());
	fill_->place_rim(points, rim);
	return rim;
}

void SoftBodySkin::draw(const RID &item) {
	if (is_stale_) {
		make();
	}
	RenderingServer *server = RenderingServer::get_singleton();
	if (has_fill()) {
		server->canvas_item_add_mesh(item, fill_mesh_.rid, Transform2D(), drawn_.color, rid_of(drawn_.texture));
	}
	if (outline_mesh_.rid.is_valid()) {
		server->canvas_item_add_mesh(item, outline_mesh_.rid, Transform2D(), drawn_.outline_color,
				rid_of(drawn_.outline_texture));
	}
	if (cut_mesh_.rid.is_valid()) {
		server->canvas_item_add_mesh(item, cut_mesh_.rid, Transform2D(), drawn_.cut_color, rid_of(drawn_.cut_texture));
	}
}

void SoftBodySkin::update(std::span<const Vec2> points) {
	if (is_stale_) {
		make();
	}
	if (points.size() < rest_.size()) {
		return;
	}
	const std::span<const Vec2> rim = rim_at(points);
	bounds_ = bounding_box(rim).grown(pixel_);
	if (has_fill()) {
		fill_->place(points, rim, fill_mesh_.vertices());
		fill_mesh_.send();
	}
	if (outline_mesh_.rid.is_valid()) {
		place_bands(outline_, rim, outline_mesh_.vertices());
		outline_mesh_.send();
	}
	if (cut_mesh_.rid.is_valid()) {
		place_bands(cut_bands_, rim, cut_mesh_.vertices());
		cut_mesh_.send();
	}
}

} // namespace softbody
