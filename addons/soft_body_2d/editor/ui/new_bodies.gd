# SPDX-License-Identifier: MIT
@tool
extends RefCounted
## Sees when a user adds a body to the scene that is edited, and gives it what new bodies get. That belongs to the step of undo which adds
## it: the node goes and comes back with it.

const NewBody := preload("../logic/new_body.gd")

const CANVAS_COLOR := "rendering/environment/defaults/default_clear_color"

var _undo: EditorUndoRedoManager
var _tree: SceneTree


func start(undo: EditorUndoRedoManager, tree: SceneTree) -> void:
	_undo = undo
	_tree = tree
	_tree.node_added.connect(_on_node_added)


func stop() -> void:
	_tree.node_added.disconnect(_on_node_added)


# Scenes are opened, and tool scripts work, outside of steps of undo. What is instantiated from a scene has an owner or a file.
func _on_node_added(node: Node) -> void:
	if node is SoftBody2D and _undo.is_committing_action() and node.owner == null and node.scene_file_path == "":
		_greet.call_deferred(node)


# When the step has been made, and the node has its owner.
func _greet(node: Variant) -> void:
	if not is_instance_valid(node) or not node.is_inside_tree():
		return
	var body: SoftBody2D = node
	var root := EditorInterface.get_edited_scene_root()
	if root == null or (body != root and body.owner != root) or not NewBody.is_untouched(body):
		return
	var values := NewBody.values_of(body, ProjectSettings.get_setting(CANVAS_COLOR))
	for property: StringName in values:
		body.set(property, values[property])
