// SPDX-License-Identifier: MIT
// What a scene or a resource holds that fits no property of ours.
#include "godot/resources/unfit_values.h"

#include <godot_cpp/classes/engine.hpp>
#include <godot_cpp/classes/node.hpp>
#include <godot_cpp/classes/resource.hpp>
#include <godot_cpp/core/class_db.hpp>
#include <godot_cpp/core/error_macros.hpp>
#include <godot_cpp/templates/hash_map.hpp>
#include <godot_cpp/variant/dictionary.hpp>
#include <godot_cpp/variant/typed_array.hpp>

#include <algorithm>
#include <mutex>

using namespace godot;

namespace softbody {

namespace {

using Types = HashMap<StringName, Variant::Type>;

bool is_editor() {
	static const bool result = Engine::get_singleton()->is_editor_hint();
	return result;
}

// Of the properties that objects of this class have by it and by its parents.
const Types &types_of(const StringName &p_class) {
	static std::mutex mutex;
	static HashMap<StringName, Types> known;
	const std::lock_guard lock(mutex);
	Types &types = known[p_class];
	if (types.is_empty()) {
		types["script"] = Variant::NIL; // which every object has, and no class
		const TypedArray<Dictionary> list = ClassDB::class_get_property_list(p_class);
		for (int64_t i = 0; i < list.size(); i++) {
			const Dictionary property = list[i];
			types[property["name"]] = Variant::Type(int(property["type"]));
		}
	}
	return types;
}

bool has_script(const Object &p_owner) {
	return p_owner.get_script().get_type() != Variant::NIL;
}

// The present name of a property, by its former one; empty for a name that none had.
StringName present_name(const Object &p_owner, const StringName &p_former) {
	static const StringName HULL = "hull", POLYGON = "polygon";
	static const StringName SHAPE_DAMPING = "shape_damping", SHAPE_DAMPING_RATIO = "shape_damping_ratio";
	if (p_former == SHAPE_DAMPING) {
		return SHAPE_DAMPING_RATIO;
	}
	return p_former == HULL && Object::cast_to<Node>(&p_owner) != nullptr ? POLYGON : StringName();
}

String name_of(const Object &p_owner) {
	String name;
	if (const Node *node = Object::cast_to<Node>(&p_owner)) {
		name = "'" + String(node->get_name()) + "'" + (node->is_inside_tree() ? " (" + String(node->get_path()) + ")" : String());
	} else if (const Resource *resource = Object::cast_to<Resource>(&p_owner)) {
		name = "'" + (resource->get_name().is_empty() ? resource->get_path() : resource->get_name()) + "'";
	}
	return p_owner.get_class() + " " + name;
}

} // namespace

bool UnfitValues::set(Object &p_owner, const StringName &p_class, const StringName &p_name, const Variant &p_value) {
#ifdef DEBUG_ENABLED
	const auto found = std::ranges::find(entries_, p_name, &Entry::name);
	const Variant::Type *type = types_of(p_class).getptr(p_name);
	if (type == nullptr) {
		if (!is_editor() || has_script(p_owner) || String(p_name).begins_with("metadata/")) {
			return false;
		}
		if (found != entries_.end()) {
			found->value = p_value;
		} else {
			entries_.push_back({ p_name, p_value });
		}
		tell_if_known(p_owner);
		return true;
	}
	if (found != entries_.end()) {
		entries_.erase(found);
	}
	if (*type == Variant::NIL || Variant::can_convert_strict(p_value.get_type(), *type)) {
		return false;
	}
	entries_.push_back({ p_name, p_value, *type });
	tell_if_known(p_owner);
	return true;
#else
	(void)p_owner, (void)p_class, (void)p_name, (void)p_value;
	return false;
#endif
}

bool UnfitValues::set_former(Object &p_owner, const StringName &p_class, const StringName &p_name, const Variant &p_value) {
	const StringName present = present_name(p_owner, p_name);
	if (present.is_empty()) {
		return false;
	}
	if (!set(p_owner, p_class, present, p_value)) {
		p_owner.set(present, p_value);
		note_former(p_owner, p_name, vformat("'%s' is called '%s' now. Its value was taken over: save the scene or resource to store it as '%s', and change scripts and animations that name '%s'.", p_name, present, present, p_name));
	}
	return true;
}

bool UnfitValues::get_former(const Object &p_owner, const StringName &p_name, Variant &r_value) {
	const StringName present = present_name(p_owner, p_name);
	if (present.is_empty()) {
		return false;
	}
	r_value = p_owner.get(present);
	return true;
}

void UnfitValues::note_former(const Object &p_owner, const StringName &p_name, const String &p_text) {
#ifdef DEBUG_ENABLED
	if (std::ranges::find(notes_, p_name, &Note::name) == notes_.end()) {
		notes_.push_back({ p_name, p_text });
		tell_if_known(p_owner);
	}
#else
	(void)p_owner, (void)p_name, (void)p_text;
#endif
}

bool UnfitValues::get(const StringName &p_name, Variant &r_value) const {
	const auto found = std::ranges::find(entries_, p_name, &Entry::name);
	if (found == entries_.end() || found->wanted != Variant::NIL) {
		return false;
	}
	r_value = found->value;
	return true;
}

void UnfitValues::append_to(List<PropertyInfo> *r_list) const {
	for (const Entry &entry : entries_) {
		if (entry.wanted == Variant::NIL) {
			r_list->push_back(PropertyInfo(entry.value.get_type(), entry.name, PROPERTY_HINT_NONE, "", PROPERTY_USAGE_STORAGE));
		}
	}
}

String UnfitValues::explain(const Entry &p_entry) {
	if (p_entry.wanted == Variant::NIL) {
		return vformat("'%s' is no property that this version of the extension knows: a newer one may have saved it. It has no effect, is kept, and is saved again.", p_entry.name);
	}
	const String given = Variant::get_type_name(p_entry.value.get_type());
	const String wanted = Variant::get_type_name(p_entry.wanted);
	return vformat("'%s' refused: a value of type %s, must be %s. The old value stays.", p_entry.name, given, wanted);
}

void UnfitValues::append_warnings(PackedStringArray &r_warnings) const {
	for (const Entry &entry : entries_) {
		r_warnings.push_back(explain(entry));
	}
}

void UnfitValues::tell_if_known(const Object &p_owner) {
	const Node *node = Object::cast_to<Node>(&p_owner);
	if (node == nullptr || node->is_inside_tree()) {
		tell(p_owner);
	}
}

void UnfitValues::tell(const Object &p_owner) {
	for (Note &note : notes_) {
		if (!note.is_told) {
			note.is_told = true;
			WARN_PRINT(name_of(p_owner) + ": " + note.text);
		}
	}
	for (Entry &entry : entries_) {
		if (!entry.is_told) {
			entry.is_told = true;
			if (entry.wanted == Variant::NIL) {
				WARN_PRINT(name_of(p_owner) + ": " + explain(entry));
			} else {
				ERR_PRINT(name_of(p_owner) + ": " + explain(entry));
			}
		}
	}
}

} // namespace softbody
