// SPDX-License-Identifier: MIT
// Binds a property, or an enumeration, in one line.
#pragma once

#include <godot_cpp/core/class_db.hpp>
#include <godot_cpp/core/type_info.hpp>
#include <godot_cpp/variant/string.hpp>

#include <initializer_list>

namespace softbody {

template <class Pointer>
struct MemberPointer;
template <class Owner, class Value>
struct MemberPointer<Value Owner::*> {
	using OwnerType = Owner;
	using ValueType = Value;
};
/// The type of the member that the constant `MEMBER` points to.
template <auto MEMBER>
using ValueOf = typename MemberPointer<decltype(MEMBER)>::ValueType;
/// The class that has that member.
template <auto MEMBER>
using OwnerOf = typename MemberPointer<decltype(MEMBER)>::OwnerType;

/// Binds setter, getter and the property itself. Without names of their own these are `set_` and `get_` before the name of
/// the property. Its type is the setter's argument.
template <class Class, class Argument, class Value>
void bind_property(const char *p_name, void (Class::*p_setter)(Argument), Value (Class::*p_getter)() const,
		godot::PropertyHint p_hint = godot::PROPERTY_HINT_NONE, const char *p_hint_string = "", const char *p_getter_name = nullptr,
		const char *p_setter_name = nullptr, uint32_t p_usage = godot::PROPERTY_USAGE_DEFAULT) {
	const godot::String name = p_name;
	const godot::String setter = p_setter_name != nullptr ? godot::String(p_setter_name) : "set_" + name;
	const godot::String getter = p_getter_name != nullptr ? godot::String(p_getter_name) : "get_" + name;
	const godot::Variant::Type type = godot::Variant::Type(godot::GetTypeInfo<Argument>::VARIANT_TYPE);
	godot::ClassDB::bind_method(godot::D_METHOD(setter, name), p_setter);
	godot::ClassDB::bind_method(godot::D_METHOD(getter), p_getter);
	godot::ClassDB::add_property(Class::get_class_static(),
			godot::PropertyInfo(type, name, p_hint, godot::String::utf8(p_hint_string), p_usage), setter, getter);
}

/// Binds an enumeration whose constants are 0, 1, 2, …, in this order.
template <class Class>
void bind_enumeration(const char *p_name, std::initializer_list<const char *> p_constants) {
	int64_t value = 0;
	for (const char *constant : p_constants) {
		godot::ClassDB::bind_integer_constant(Class::get_class_static(), p_name, constant, value++);
	}
}

} // namespace softbody
