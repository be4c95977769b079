// SPDX-License-Identifier: MIT
// What a scene or a resource holds that this version of the extension does not know.
#pragma once

#include <godot_cpp/core/object.hpp>
#include <godot_cpp/core/property_info.hpp>
#include <godot_cpp/templates/list.hpp>
#include <godot_cpp/variant/packed_string_array.hpp>
#include <godot_cpp/variant/string_name.hpp>
#include <godot_cpp/variant/variant.hpp>

#include <utility>
#include <vector>

namespace softbody {

/// The engine drops values of properties that a class does not have, without a word, and whoever then saves the scene has
/// lost them. In the editor these are kept, shown as warnings and saved again, so that a scene of a newer version survives
/// an older one. A game saves no scenes: there it is as the engine has it. So it is for an object with a script, as
/// values that nobody knows are then those of variables that its script had once.
///
/// Each class of ours hands its `_set`, `_get` and `_get_property_list` on to one of these.
class UnknownProperties {
public:
	/// The engine asks for each property that is set. True if it is unknown and was kept.
	bool set(godot::Object &p_owner, const godot::StringName &p_name, const godot::Variant &p_value);
	bool get(const godot::StringName &p_name, godot::Variant &r_value) const;
	void append_to(godot::List<godot::PropertyInfo> *r_list) const;
	/// One for each.
	void append_warnings(godot::PackedStringArray &r_warnings) const;
	/// Prints those that have not been printed. `p_who` is how messages name the owner.
	void tell(const godot::String &p_who);

private:
	std::vector<std::pair<godot::StringName, godot::Variant>> values_;
	std::size_t told_ = 0;
};

} // namespace softbody
