# SPDX-License-Identifier: MIT
@tool
extends MenuButton
## The menu Convert of the 2D editor's toolbar: there while a node is selected that it has something for.

const ConvertCommands := preload("convert_commands.gd")
const Words := preload("../logic/words.gd")

enum Item { CONVERT, BAKE, BAKE_PRESENT, SKIN, ADD_SKIN }

var commands: ConvertCommands


func _init() -> void:
	name = "SoftBody2DConvert"
	text = Words.say("Convert")
	tooltip_text = Words.say("Make soft bodies of the selected nodes, Polygon2D nodes of soft bodies, or polygons that bend with them.")
	switch_on_hover = true
	get_popup().id_pressed.connect(choose)


## The entries for the selection, by id.
static func entries() -> Dictionary:
	var found := {}
	if not ConvertCommands.convertible().is_empty():
		found[Item.CONVERT] = Words.say("Convert to SoftBody2D")
	if not ConvertCommands.polygons_on_bodies().is_empty():
		found[Item.SKIN] = Words.say("Convert to SoftBodySkin2D")
	if not ConvertCommands.bodies().is_empty():
		found[Item.ADD_SKIN] = Words.say("Add Skin")
		found[Item.BAKE] = Words.say("Bake to Polygon2D")
		found[Item.BAKE_PRESENT] = Words.say("Bake to Polygon2D as It Is Now")
	return found


func show_selection() -> void:
	var shown := entries()
	get_popup().clear()
	for id: int in shown:
		get_popup().add_item(shown[id], id)
	visible = not shown.is_empty()


func choose(id: int) -> void:
	match id:
		Item.CONVERT:
			commands.convert_selected()
		Item.SKIN:
			commands.make_skins()
		Item.ADD_SKIN:
			commands.add_skins()
		_:
			commands.bake_selected(id == Item.BAKE_PRESENT)
