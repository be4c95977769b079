// SPDX-License-Identifier: MIT
// The looks of a body: meshes whose vertices follow its points.
#pragma once

#include "core/base/vec2.h"
#include "core/geometry/aabb.h"
#include "core/skin/fill_mesh.h"
#include "core/skin/outline_band.h"
#include "godot/convert.h"
#include "godot/drawing/skin_style.h"
#include "godot/drawing/soft_look.h"

#include <godot_cpp/variant/array.hpp>
#include <godot_cpp/variant/packed_byte_array.hpp>
#include <godot_cpp/variant/rid.hpp>

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace softbody {

/// Triangles, texture coordinates and colors are made from the rest shape and the style, once. A frame only writes the
/// places of the vertices into the buffers of the meshes: the draw commands of the canvas item stay, so nothing else on
/// the item is touched, and no buffer is made anew. All in the node's coordinates.
///
/// Lives on the main thread. Owns its objects in the rendering server.
class SoftBodySkin {
public:
	SoftBodySkin() = default;
	SoftBodySkin(const SoftBodySkin &) = delete;
	SoftBodySkin &operator=(const SoftBodySkin &) = delete;
	~SoftBodySkin();

	const SkinStyle &style() const { return style_; }
	/// The style, to change it; the meshes are made anew on next use.
	SkinStyle &change_style() {
		is_stale_ = true;
		return style_;
	}
	/// Tells whether the node is tinted or has a canvas material as it enters the tree: LOOK_AUTOMATIC is plain then. The first
	/// call counts, so that a body that blinks later keeps its look.
	void note_tint(bool tinted);
	/// Takes over the style, and whether it is drawn soft.
	void copy_look(const SoftBodySkin &other);
	/// Whether the body is drawn in the soft look.
	bool is_soft() const { return is_drawn_soft(style_, is_tinted_.value_or(false)); }
	/// The fill color, as the look has it.
	godot::Color color_in_use() const { return color_of_look(style_, is_soft()); }
	/// Sets all points of the body at rest, the hull first, in the order of the core, and how that order is the user's.
	/// One pixel is `pixel` long there. `holes` as for FillMesh.
	void set_rest(std::vector<Vec2> rest, PointOrder order, Real pixel, std::span<const std::size_t> holes = {});

	std::span<const Vec2> rest() const { return rest_; }

	/// What SkinStyle::uv would have to be, in the order of the core, to show the texture as it is shown now; empty without a
	/// texture.
	std::vector<godot::Vector2> uv_in_use() const;

	/// Adds the commands that draw the meshes to a canvas item.
	void draw(const godot::RID &item);
	/// Moves the meshes to the present points, in the order of `set_rest`. O(vertices).
	void update(std::span<const Vec2> points);
	/// Box around the vertices of the last `update`.
	const Aabb &bounds() const { return bounds_; }

private:
	/// A mesh in the rendering server, and its vertices as pairs of float.
	struct Mesh {
		godot::RID rid;
		godot::PackedByteArray bytes;
		std::size_t vertex_count = 0;

		std::span<Vec2> vertices();
		/// Replaces the mesh; colors may be empty.
		void make(const std::vector<Triangle> &triangles, std::span<const godot::Vector2> uvs,
				std::span<const godot::Color> colors);
		void send() const;
		void free();
	};

	bool has_fill() const { return drawn_.color.a > 0; }
	bool has_outline() const { return drawn_.outline_width > 0 && drawn_.outline_color.a > 0; }
	bool has_cuts() const { return style_.cut_width > 0 && !style_.cut_edges.is_empty(); }
	void make();
	void make_fill();
	Real wall_width() const;
	void make_outline(std::span<const Vec2> rim);
	void make_cuts(std::span<const Vec2> rim);
	void place_bands(const std::vector<OutlineBand> &bands, std::span<const Vec2> rim, std::span<Vec2> vertices) const;
	/// Places of the rim for these points. Valid until the next call for any body.
	std::span<Vec2> rim_at(std::span<const Vec2> points) const;
	/// For each edge of the rim whether a cut made it.
	std::vector<std::uint8_t> cut_edges() const;
	/// Bands inside the rim, one after the other, with a texture along each: a whole number of tiles all around, or one that is stretched.
	std::vector<OutlineBand> make_bands(Mesh &r_mesh, std::span<const Vec2> rim, Real width, const godot::Ref<godot::Texture2D> &texture, bool is_tiled, std::span<const std::uint8_t> edges) const;
	/// Before offset, scale and rotation [px of the texture].
	std::vector<Vec2> corner_pixels(godot::Vector2 part_size) const;
	bool has_own_uv() const { return std::size_t(style_.uv.size()) == hull_count_; }
	std::vector<godot::Vector2> texture_coordinates() const;
	std::vector<godot::Color> colors() const;

	SkinStyle style_;
	std::optional<bool> is_tinted_;
	SkinStyle drawn_; ///< the style as the look has it; made with the meshes
	std::vector<Vec2> rest_;
	std::size_t hull_count_ = 0;
	std::vector<std::size_t> holes_; ///< number of points of each
	PointOrder order_;
	Real pixel_ = 1;
	bool is_stale_ = true;

	std::shared_ptr<const FillMesh> fill_; ///< one for like bodies
	std::vector<OutlineBand> outline_; ///< along the hull and along each hole
	std::vector<OutlineBand> cut_bands_;
	Mesh fill_mesh_;
	Mesh outline_mesh_;
	Mesh cut_mesh_;
	Aabb bounds_;
};

} // namespace softbody
