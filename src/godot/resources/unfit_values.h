// SPDX-License-Identifier: MIT
// What a scene or a resource holds that fits no property of ours.
#pragma once

#include <godot_cpp/core/object.hpp>
#include <godot_cpp/core/property_info.hpp>
#include <godot_cpp/templates/list.hpp>
#include <godot_cpp/variant/packed_string_array.hpp>
#include <godot_cpp/variant/string_name.hpp>
#include <godot_cpp/variant/variant.hpp>

#include <cstddef>
#include <vector>

namespace softbody {

/// Values that the engine would drop or change in silence: it ignores properties that a class does not have, and turns a value
/// of a wrong type into an empty array. Saving the scene then loses them.
///
/// - **Unknown names.** The editor keeps their values, shows them as warnings and saves them again, so that a scene of a newer
///   version survives an older one. A game saves no scenes and ignores them. They are ignored, too, for an object with a
///   script, where an unknown name was a variable of the script once.
/// - **Wrong types.** A message of debug builds names the property; the old value stays.
/// - **Former names.** A renamed property takes the value over, and a warning says so.
///
/// Each class of ours hands its `_set`, `_get` and `_get_property_list` on to one of these. Release builds ask nothing.
class UnfitValues {
public:
	/// The engine asks for each property that is set, of an object of `p_class`. True if the value is unfit, and has been
	/// dealt with. From any thread, for different owners.
	bool set(godot::Object &p_owner, const godot::StringName &p_class, const godot::StringName &p_name,
			const godot::Variant &p_value);
	/// Takes over a value that came under the name that a property of `p_class` had in an earlier version. False if it never
	/// had that name.
	bool set_former(godot::Object &p_owner, const godot::StringName &p_class, const godot::StringName &p_name,
			const godot::Variant &p_value);
	/// The value of a property by its earlier name.
	static bool get_former(const godot::Object &p_owner, const godot::StringName &p_name, godot::Variant &r_value);
	/// Has a warning printed, once for each name: a value came under a name that the property had in an earlier version.
	void note_former(const godot::Object &p_owner, const godot::StringName &p_name, const godot::String &p_text);
	/// A value that was kept.
	bool get(const godot::StringName &p_name, godot::Variant &r_value) const;
	void append_to(godot::List<godot::PropertyInfo> *r_list) const;
	/// One for each.
	void append_warnings(godot::PackedStringArray &r_warnings) const;
	/// Prints those that have not been printed. For a node that enters the tree: when its scene sets its properties it has
	/// no name yet. What comes later, and what comes to a resource, is told at once.
	void tell(const godot::Object &p_owner);

private:
	struct Note {
		godot::StringName name;
		godot::String text;
		bool is_told = false;
	};
	struct Entry {
		godot::StringName name;
		godot::Variant value;
		godot::Variant::Type wanted = godot::Variant::NIL; ///< NIL for an unknown name
		bool is_told = false;
	};
	static godot::String explain(const Entry &p_entry);
	void tell_if_known(const godot::Object &p_owner);

	std::vector<Entry> entries_;
	std::vector<Note> notes_;
};

} // namespace softbody
