// SPDX-License-Identifier: MIT
// What cuts have changed about a node, as values: for states of a body that was cut since or before.
#include "godot/nodes/cut_history.h"

#include "core/base/value_range.h"

#include <godot_cpp/variant/array.hpp>
#include <godot_cpp/variant/utility_functions.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <iterator>
#include <span>
#include <string>
#include <utility>

using namespace godot;

namespace softbody {

namespace {

// Before the structure: these letters, the version, a checksum of all after it, and the number of bytes of the structure.
constexpr std::array<uint8_t, 4> MAGIC = { 'S', 'B', '2', 'C' };
constexpr int64_t VERSION = 1;
constexpr int64_t AT_VERSION = 4;
constexpr int64_t AT_CHECKSUM = 8;
constexpr int64_t AT_SIZE = 16;
constexpr int64_t HEAD = 20;
constexpr const char *DAMAGED = "keep the bytes as they were saved";

Error refused(const std::string &p_name, const std::string &p_value, const std::string &p_bound) {
	return { "state." + p_name, p_value, p_bound, DAMAGED };
}

// FNV-1a.
int64_t checksum_of(const PackedByteArray &p_bytes, int64_t p_from) {
	uint64_t sum = 0xcbf29ce484222325u;
	for (int64_t i = p_from; i < p_bytes.size(); i++) {
		sum = (sum ^ p_bytes[i]) * 0x100000001b3u;
	}
	return int64_t(sum);
}

/// Shows every value of a structure, in the order of the bytes.
template <class Structure>
void visit(Structure &p_structure, auto p_each) {
	auto &values = p_structure.values;
	p_each("polygon", values.polygon);
	p_each("inner_points", values.inner_points);
	p_each("springs", values.springs);
	p_each("spring_stiffness_scales", values.stiffness_scales);
	p_each("spring_damping_scales", values.damping_scales);
	p_each("spring_length_scales", values.length_scales);
	p_each("center_point", values.center_point);
	p_each("uv", p_structure.uv);
	p_each("vertex_colors", p_structure.vertex_colors);
	p_each("cut_edges", p_structure.cut_edges);
	p_each("mass", p_structure.mass);
	p_each("elastic_model", p_structure.elastic_model);
	p_each("awaits_modes", p_structure.awaits_modes);
}

Status check(const CutStructure &p_structure) {
	const BodyStructure::Values &values = p_structure.values;
	if (Status status = first_error({ BodyStructure::check("polygon", values.polygon), BodyStructure::check("inner_points", values.inner_points),
				BodyStructure::check("springs", values.springs), BodyStructure::check("spring_stiffness_scales", values.stiffness_scales),
				BodyStructure::check("spring_damping_scales", values.damping_scales),
				BodyStructure::check("spring_length_scales", values.length_scales), check_all_finite("uv", p_structure.uv),
				check_all_finite("vertex_colors", p_structure.vertex_colors) })) {
		return status;
	}
	if (!std::isfinite(p_structure.mass) || p_structure.mass <= 0) {
		return refused("mass", std::to_string(p_structure.mass), "must be above 0 kg");
	}
	if (p_structure.elastic_model < 0 || p_structure.elastic_model >= BodyProperties::ELASTIC_MODEL_COUNT) {
		return refused("elastic_model", std::to_string(p_structure.elastic_model), "must be an ElasticModel");
	}
	return {};
}

Result<CutStructure> structure_from(const PackedByteArray &p_bytes) {
	const Variant read = UtilityFunctions::bytes_to_var(p_bytes);
	if (read.get_type() != Variant::ARRAY) {
		return refused("structure", std::to_string(p_bytes.size()) + " bytes", "must be an array of values");
	}
	const Array list = read;
	CutStructure structure;
	int64_t next = 0;
	Status status;
	visit(structure, [&](const char *p_name, auto &r_value) {
		using Value = std::remove_reference_t<decltype(r_value)>;
		const Variant value = next < list.size() ? list[next] : Variant();
		next++;
		if (value.get_type() != Variant(Value()).get_type()) {
			status = status ? status : refused(p_name, "of another type", "must be of the property's");
			return;
		}
		r_value = Value(value);
	});
	if (status || next != list.size()) {
		return status ? *status : refused("structure", std::to_string(list.size()) + " values", "must be " + std::to_string(next));
	}
	if (Status wrong = check(structure)) {
		return *wrong;
	}
	return structure;
}

Result<BodyState> body_from(const PackedByteArray &p_bytes, int64_t p_from) {
	return body_state_from_bytes(std::span(p_bytes.ptr(), std::size_t(p_bytes.size())).subspan(std::size_t(p_from)));
}

} // namespace

bool CutStructure::is_same(const CutStructure &p_other) const {
	const BodyStructure::Values &a = values;
	const BodyStructure::Values &b = p_other.values;
	return a.polygon == b.polygon && a.inner_points == b.inner_points && a.springs == b.springs && a.stiffness_scales == b.stiffness_scales &&
			a.damping_scales == b.damping_scales && a.length_scales == b.length_scales && a.center_point == b.center_point;
}

PackedByteArray to_bytes(const BodyState &p_body, const CutStructure *p_structure) {
	const std::vector<uint8_t> state = to_bytes(p_body);
	PackedByteArray bytes;
	if (p_structure != nullptr) {
		Array list;
		visit(*p_structure, [&](const char *, const auto &p_value) { list.push_back(p_value); });
		const PackedByteArray structure = UtilityFunctions::var_to_bytes(list);
		bytes.resize(HEAD);
		std::ranges::copy(MAGIC, bytes.ptrw());
		bytes.encode_u32(AT_VERSION, VERSION);
		bytes.encode_u32(AT_SIZE, structure.size());
		bytes.append_array(structure);
	}
	const int64_t from = bytes.size();
	bytes.resize(from + int64_t(state.size()));
	std::memcpy(bytes.ptrw() + from, state.data(), state.size());
	if (p_structure != nullptr) {
		bytes.encode_s64(AT_CHECKSUM, checksum_of(bytes, AT_SIZE));
	}
	return bytes;
}

Result<NodeState> node_state_from_bytes(const PackedByteArray &p_bytes) {
	NodeState state;
	int64_t from = 0;
	if (p_bytes.size() >= HEAD && std::equal(MAGIC.begin(), MAGIC.end(), p_bytes.ptr())) {
		if (const int64_t version = p_bytes.decode_u32(AT_VERSION); version != VERSION) {
			return Error{ "state.version", std::to_string(version), "must be " + std::to_string(VERSION), "save it again with this version" };
		}
		from = HEAD + int64_t(p_bytes.decode_u32(AT_SIZE));
		if (from > p_bytes.size() || p_bytes.decode_s64(AT_CHECKSUM) != checksum_of(p_bytes, AT_SIZE)) {
			return refused("checksum", "another", "must be that of the data");
		}
		auto structure = structure_from(p_bytes.slice(HEAD, from));
		if (!structure) {
			return structure.error();
		}
		state.structure = std::move(structure.value());
	}
	auto body = body_from(p_bytes, from);
	if (!body) {
		return body.error();
	}
	state.body = std::move(body.value());
	return state;
}

uint64_t CutHistory::next_cut() {
	static uint64_t cuts = 0;
	return ++cuts;
}

void CutHistory::begin_as(const Entry &p_whole) {
	entries_ = { p_whole };
	entries_.front().attachments.clear();
}

const CutHistory::Entry *CutHistory::find(const CutStructure &p_structure) const {
	const auto found = std::ranges::find_if(entries_, [&](const Entry &p_entry) { return p_entry.structure.is_same(p_structure); });
	return found != entries_.end() ? &*found : nullptr;
}

std::vector<CutHistory::Entry> CutHistory::take_from(uint64_t p_cut) {
	const auto first = std::ranges::find_if(entries_, [p_cut](const Entry &p_entry) { return p_entry.cut >= p_cut; });
	std::vector<Entry> taken(std::make_move_iterator(first), std::make_move_iterator(entries_.end()));
	entries_.erase(first, entries_.end());
	return taken;
}

} // namespace softbody
