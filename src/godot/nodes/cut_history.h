// SPDX-License-Identifier: MIT
// What cuts have changed about a node, as values: for states of a body that was cut since or before.
#pragma once

#include "core/base/error.h"
#include "core/model/body_state.h"
#include "godot/nodes/body_design.h"
#include "godot/nodes/body_pins.h"
#include "godot/nodes/body_structure.h"

#include <godot_cpp/variant/packed_byte_array.hpp>
#include <godot_cpp/variant/packed_color_array.hpp>
#include <godot_cpp/variant/packed_int32_array.hpp>
#include <godot_cpp/variant/packed_vector2_array.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace softbody {

/// Everything that a cut makes anew of a node besides its body.
struct CutStructure {
	BodyStructure::Values values;
	godot::PackedVector2Array uv;
	godot::PackedColorArray vertex_colors;
	godot::PackedInt32Array cut_edges;
	double mass = 0; ///< SoftBody2D::mass, if it was set [kg]
	int elastic_model = 0; ///< SoftBody2D::elastic_model
	bool awaits_modes = false; ///< whether springs still stand in for its elastic modes

	/// `awaits_modes` aside.
	bool is_same(const CutStructure &p_other) const;
};

/// The state of a node's body, and of which structure it is.
struct NodeState {
	BodyState body;
	std::optional<CutStructure> structure; ///< nothing: that of the node before any cut
};

/// The bytes of the core's state, after those of the structure if there is one.
godot::PackedByteArray to_bytes(const BodyState &p_body, const CutStructure *p_structure);
/// Refuses, by name, what `body_state_from_bytes` refuses and structures that no node can have.
Result<NodeState> node_state_from_bytes(const godot::PackedByteArray &p_bytes);

/// What a node was before each of its cuts, the first one first. Empty for a node that was never cut.
class CutHistory {
public:
	struct Entry {
		uint64_t cut = 0; ///< number of the cut, rising over all nodes
		CutStructure structure;
		std::optional<BodyDesign> design;
		BodyPins pins;
		std::vector<uint64_t> attachments; ///< instance ids of those that went to other pieces
	};

	static uint64_t next_cut();

	bool is_empty() const { return entries_.empty(); }
	const Entry &first() const { return entries_.front(); }
	Entry &last() { return entries_.back(); }
	void add(Entry p_entry) { entries_.push_back(std::move(p_entry)); }
	/// Of a piece: it was the same whole, from which nothing has gone to others.
	void begin_as(const Entry &p_whole);
	/// The entry of that structure, or null.
	const Entry *find(const CutStructure &p_structure) const;
	/// Removes this entry and all later ones, and returns them.
	std::vector<Entry> take_from(uint64_t p_cut);
	void clear() { entries_.clear(); }

private:
	std::vector<Entry> entries_;
};

} // namespace softbody
