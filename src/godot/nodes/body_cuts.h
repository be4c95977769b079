// SPDX-License-Identifier: MIT
// Cuts of a node: the largest piece keeps the node, the others become nodes beside it.
#pragma once

#include "core/creator/body_cut.h"
#include "core/creator/body_tear.h"
#include "core/model/soft_body_data.h"
#include "godot/nodes/body_design.h"
#include "godot/nodes/body_structure.h"
#include "godot/nodes/cut_history.h"
#include "godot/nodes/soft_body_2d.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace softbody {

/// What decides where a copy of a node's body tears.
struct TearRules {
	StructureOptions options; ///< that its shape was made of
	TearLimits limits;
	bool tears = false; ///< whether it tears at all
};

/// One cut of one node. Everything that can be refused is asked first; then nothing is.
class BodyCuts {
public:
	explicit BodyCuts(godot::SoftBody2D &r_node) : node_(r_node), whole_(*r_node.body()) {}

	static Result<BodyCut> plan(const godot::SoftBody2D &p_node, const godot::PackedVector2Array &p_points);
	/// Along the weakest way through what bears no more than `p_stretch`, one piece alone if it bears that.
	static Result<BodyCut> plan_tear(const godot::SoftBody2D &p_node, double p_stretch);
	/// Of a copy that was made of the node (`SoftBody2D::make_copy`).
	static TearRules tear_rules(const godot::SoftBody2D &p_node, const SoftBodyData &p_copy);
	/// The polygons of the pieces as they are deformed, in the world.
	static godot::TypedArray<godot::PackedVector2Array> outlines(const BodyCut &p_cut);
	/// The nodes of the pieces, this one first. Nothing has changed if it is refused.
	Result<godot::TypedArray<godot::SoftBody2D>> make(const BodyCut &p_cut);

	static CutStructure structure_of(const godot::SoftBody2D &p_node);
	/// The node becomes what it was when that state was saved, before or after cuts. What went to other pieces since comes
	/// back; the pieces stay. Nothing has changed if it is refused.
	Status become(const NodeState &p_state);

private:
	/// Null outside of the tree of a running game.
	static const SoftBodyData *whole_of(const godot::SoftBody2D &p_node);
	static StructureOptions options_of(const godot::SoftBody2D &p_node, const SoftBodyData &p_body, const godot::Transform2D &p_scale);
	static BodyCutLimits limits_of(const godot::SoftBody2D &p_node);
	/// What a piece's node has of its own.
	struct Piece {
		godot::SoftBody2D *node = nullptr; ///< null for the first piece until it is made
		BodyStructure::Values structure;
		godot::PackedVector2Array uv;
		godot::PackedColorArray vertex_colors;
		godot::PackedInt32Array cut_edges;
		double mass = 0; ///< if it is not that of its area
		BodyDesign design;
		std::optional<SoftBodyData> body;
	};

	void describe_pieces(const BodyCut &p_cut);
	godot::PackedInt32Array cut_edges(const BodyCut &p_cut, const BodyPiece &p_piece) const;
	void copy_to(godot::SoftBody2D &r_node) const;
	static void await_modes(godot::SoftBody2D &r_node);
	static void take_structure(godot::SoftBody2D &r_node, Piece &r_piece);
	static void find_modes(godot::SoftBody2D &r_node);
	static void take_modes(godot::SoftBody2D &r_node, uint64_t p_task);
	Result<SoftBodyData> create_body(const BodyDesign &p_design, const godot::SoftBody2D &p_node) const;
	Status restore_body(Piece &r_piece, const CutHistory::Entry *p_former, const NodeState &p_state);
	Status make_body(const BodyCut &p_cut, std::size_t p_index, godot::SoftBody2D &r_node);
	static void take_pins(godot::SoftBody2D &r_node, const BodyPiece &p_piece, const BodyPins &p_pins, PointOrder p_whole_order);
	void keep_first();
	void add_piece(Piece &r_piece);
	void carry_exceptions(godot::SoftBody2D &r_node) const;
	void carry_pin_targets(godot::SoftBody2D &r_node) const;
	/// Returns those that went to other pieces.
	std::vector<uint64_t> carry_attachments();
	void take_back(const std::vector<CutHistory::Entry> &p_gone);
	void draw_as_before(godot::SoftBody2D &r_node) const;

	godot::SoftBody2D &node_;
	const SoftBodyData whole_; ///< as it was before the cut
	std::vector<Piece> pieces_;
	bool was_moving_ = false; ///< whether it was drawn between two ticks
	godot::Transform2D start_; ///< the frame in which it was at the earlier one
};

} // namespace softbody
