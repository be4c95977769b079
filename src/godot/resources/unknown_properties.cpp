// SPDX-License-Identifier: MIT
// What a scene or a resource holds that this version of the extension does not know.
#include "godot/resources/unknown_properties.h"

#include <godot_cpp/classes/engine.hpp>
#include <godot_cpp/core/error_macros.hpp>
#include <godot_cpp/templates/hash_map.hpp>
#include <godot_cpp/templates/hash_set.hpp>
#include <godot_cpp/variant/dictionary.hpp>
#include <godot_cpp/variant/typed_array.hpp>

#include <algorithm>

using namespace godot;

namespace softbody {

namespace {

bool is_editor() {
	static const bool result = Engine::get_singleton()->is_editor_hint();
	return result;
}

// The object's own list holds what is unknown, too, so it is asked before there is any.
const HashSet<StringName> &known_names(Object &p_owner) {
	static HashMap<StringName, HashSet<StringName>> known;
	HashSet<StringName> &names = known[p_owner.get_class()];
	if (names.is_empty()) {
		const TypedArray<Dictionary> list = p_owner.get_property_list();
		for (int64_t i = 0; i < list.size(); i++) {
			names.insert(Dictionary(list[i])["name"]);
		}
	}
	return names;
}

String explain(const StringName &p_name) {
	return "'" + String(p_name) + "' is no property that this version of the extension knows: a newer one may have saved it. It has no effect, is kept, and is saved again.";
}

} // namespace

bool UnknownProperties::set(Object &p_owner, const StringName &p_name, const Variant &p_value) {
	if (!is_editor() || p_owner.get_script().get_type() != Variant::NIL || String(p_name).begins_with("metadata/")) {
		return false;
	}
	const auto found = std::ranges::find(values_, p_name, &std::pair<StringName, Variant>::first);
	if (found != values_.end()) {
		found->second = p_value;
		return true;
	}
	if (known_names(p_owner).has(p_name)) {
		return false;
	}
	values_.emplace_back(p_name, p_value);
	return true;
}

bool UnknownProperties::get(const StringName &p_name, Variant &r_value) const {
	const auto found = std::ranges::find(values_, p_name, &std::pair<StringName, Variant>::first);
	if (found == values_.end()) {
		return false;
	}
	r_value = found->second;
	return true;
}

void UnknownProperties::append_to(List<PropertyInfo> *r_list) const {
	for (const auto &[name, value] : values_) {
		r_list->push_back(PropertyInfo(value.get_type(), name, PROPERTY_HINT_NONE, "", PROPERTY_USAGE_STORAGE));
	}
}

void UnknownProperties::append_warnings(PackedStringArray &r_warnings) const {
	for (const auto &[name, value] : values_) {
		r_warnings.push_back(explain(name));
	}
}

void UnknownProperties::tell(const String &p_who) {
	for (; told_ < values_.size(); told_++) {
		WARN_PRINT(p_who + ": " + explain(values_[told_].first));
	}
}

} // namespace softbody
