# SPDX-License-Identifier: MIT
@tool
extends EditorContextMenuPlugin
## The entries of the menu Convert in the context menu of the scene tree. Only loaded where the engine has such menus (4.4).

const ConvertMenu := preload("convert_menu.gd")

var menu: ConvertMenu


func _popup_menu(_paths: PackedStringArray) -> void:
	var entries := ConvertMenu.entries()
	var chosen_from := menu # a callable that holds this object would keep it for ever
	for id: int in entries:
		var icon := &"Polygon2D"
		if id == ConvertMenu.Item.CONVERT:
			icon = &"SoftBody2D"
		elif id in [ConvertMenu.Item.SKIN, ConvertMenu.Item.ADD_SKIN]:
			icon = &"SoftBodySkin2D"
		add_context_menu_item(entries[id], func(_nodes: Array) -> void: chosen_from.choose(id), _icon(icon))


func _icon(type: StringName) -> Texture2D:
	if String(type).begins_with("SoftBody"):
		return load("res://addons/soft_body_2d/icons/%s.svg" % type.to_snake_case())
	return EditorInterface.get_editor_theme().get_icon(type, &"EditorIcons")
