# SPDX-License-Identifier: MIT
@tool
extends RefCounted
## Puts one node of the edited scene into the place of another, as steps of the editor's undo. The steps call nothing of the
## addon, so the history also works while the addon is off.

var old: Node2D
var made: Node2D
## Children of `old` that the new node stands for.
var used: Array[Node] = []
## Signals that the new node has no end for.
var lost := PackedStringArray()

var _parent: Node
var _index := 0
var _children: Array[Node] = []
## Nodes below `old` that are stored with the scene, and the scene that each belongs to.
var _owners := {}
## Connections that come in from other nodes: signal, target method by the old node and by the new one, flags.
var _incoming: Array[Dictionary] = []


## `values`: of the new node, by property.
static func of(p_old: Node2D, p_made: Node2D, values: Dictionary, p_used: Array[Node] = []) -> RefCounted:
	var swap: RefCounted = new()
	swap.old = p_old
	swap.made = p_made
	swap.used = p_used
	swap._prepare(values)
	return swap


func _prepare(values: Dictionary) -> void:
	_parent = old.get_parent()
	_index = old.get_index()
	_children = old.get_children()
	made.name = old.name
	for property: StringName in values:
		made.set(property, values[property])
	_take_script()
	for group in old.get_groups():
		if not group.begins_with("_"): # the engine's own
			made.add_to_group(group, true)
	for entry in old.get_meta_list():
		made.set_meta(entry, old.get_meta(entry))
	if is_root():
		made.scene_file_path = old.scene_file_path
	for node in old.find_children("*", "", true, false):
		if node.owner != null and (node.owner == old or not old.is_ancestor_of(node.owner)):
			_owners[node] = node.owner
	_take_connections()


func is_root() -> bool:
	return old == EditorInterface.get_edited_scene_root()


## The editor's own node, by which a scene gets another root; null where it has no such method.
static func editor_node() -> Node:
	var node: Node = EditorInterface.get_base_control()
	while node != null and not node.has_method(&"set_edited_scene"):
		node = node.get_parent()
	return node


func add_do(undo: EditorUndoRedoManager) -> void:
	var step := func(object: Object, method: StringName, arguments: Array) -> void:
		undo.callv(&"add_do_method", [object, method] + arguments)
	_add_steps(step, old, made, _children.filter(func(child: Node) -> bool: return not child in used))
	for each in _incoming:
		step.call(each["source"], &"disconnect", [each["signal"], each["old"]])
		if each.has("made"):
			step.call(each["source"], &"connect", [each["signal"], each["made"], each["flags"]])
	undo.add_do_reference(made)


func add_undo(undo: EditorUndoRedoManager) -> void:
	var step := func(object: Object, method: StringName, arguments: Array) -> void:
		undo.callv(&"add_undo_method", [object, method] + arguments)
	_add_steps(step, made, old, _children)
	for each in _incoming:
		if each.has("made"):
			step.call(each["source"], &"disconnect", [each["signal"], each["made"]])
		step.call(each["source"], &"connect", [each["signal"], each["old"], each["flags"]])
	undo.add_undo_reference(old)
	for child in used:
		undo.add_undo_reference(child)


# `children`: those that `to` gets, in order.
func _add_steps(step: Callable, from: Node, to: Node, children: Array) -> void:
	for child in _children:
		if from == old or not child in used:
			step.call(from, &"remove_child", [child])
	if is_root():
		step.call(editor_node(), &"set_edited_scene", [to])
	else:
		step.call(_parent, &"remove_child", [from])
		step.call(_parent, &"add_child", [to])
		step.call(_parent, &"move_child", [to, _index])
		step.call(to, &"set_owner", [old.owner])
	for child: Node in children:
		step.call(to, &"add_child", [child])
	for node: Node in _owners:
		if children.any(func(child: Node) -> bool: return child == node or child.is_ancestor_of(node)):
			step.call(node, &"set_owner", [to if _owners[node] == old else _owners[node]])


# A script that extends Node2D or Node runs on the new node as well.
func _take_script() -> void:
	var script: Script = old.get_script()
	if script == null or not ClassDB.is_parent_class(made.get_class(), script.get_instance_base_type()):
		return
	made.set_script(script)
	for property in script.get_script_property_list():
		if property["usage"] & PROPERTY_USAGE_STORAGE:
			made.set(property["name"], old.get(property["name"]))


func _take_connections() -> void:
	for entry in old.get_signal_list():
		var name: StringName = entry["name"]
		for connection in old.get_signal_connection_list(name):
			if not connection["flags"] & CONNECT_PERSIST:
				continue
			var target := _retargeted(connection["callable"])
			if made.has_signal(name) and target.is_valid():
				made.connect(name, target, connection["flags"])
			else:
				lost.append(name)
	for connection in old.get_incoming_connections():
		var source: Signal = connection["signal"]
		if not connection["flags"] & CONNECT_PERSIST or source.get_object() == old:
			continue
		var each := {"source": source.get_object(), "signal": source.get_name(), "old": connection["callable"],
				"flags": connection["flags"]}
		var target := _retargeted(connection["callable"])
		if target.is_valid():
			each["made"] = target
		else:
			lost.append(source.get_name())
		_incoming.append(each)


# The callable with the new node where it had the old one.
func _retargeted(callable: Callable) -> Callable:
	if callable.get_object() != old:
		return callable
	if not made.has_method(callable.get_method()):
		return Callable()
	return Callable(made, callable.get_method()).bindv(callable.get_bound_arguments())
