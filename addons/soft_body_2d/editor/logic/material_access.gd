# SPDX-License-Identifier: MIT
@tool
extends RefCounted
## Whether a shared resource may be changed from the scene that uses it.

const Words := preload("words.gd")


## Why what is changed in this resource would be lost or would not be wanted; empty when it may be changed.
static func problem(resource: Resource, edited_scene: Node) -> String:
	var path := resource.resource_path
	if path == "":
		return "" # part of the scene that is edited
	if "::" in path:
		var owner_path := path.get_slice("::", 0)
		if edited_scene != null and owner_path == edited_scene.scene_file_path:
			return ""
		return Words.say("The material belongs to %s: what is changed here would not be saved. Open that scene, or make the material unique.") % owner_path.get_file()
	var real := ProjectSettings.globalize_path(path)
	if is_read_only(real):
		return Words.say("The file %s is read-only: nothing was changed. Make the file writable, or make the material unique.") % path.get_file()
	return ""


static func is_read_only(path: String) -> bool:
	if not FileAccess.file_exists(path):
		return false
	if OS.has_feature("windows"):
		return FileAccess.get_read_only_attribute(path)
	var anyone := FileAccess.UNIX_WRITE_OWNER | FileAccess.UNIX_WRITE_GROUP | FileAccess.UNIX_WRITE_OTHER
	return not (FileAccess.get_unix_permissions(path) & anyone)
