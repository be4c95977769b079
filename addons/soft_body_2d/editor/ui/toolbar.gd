# SPDX-License-Identifier: MIT
@tool
extends HBoxContainer
## The addon's part of the 2D editor's toolbar: modes, shapes, structure, preview, help.

const Icons := preload("icons.gd")
const Presets := preload("../logic/structure_presets.gd")
const Words := preload("../logic/words.gd")

signal mode_chosen(mode: int)
signal create_toggled(enabled: bool)
signal shape_chosen(shape: StringName)
signal preset_chosen(preset: int)
signal preview_toggled(enabled: bool)
signal help_wanted

enum Mode { NONE, POLYGON, SPRINGS, PINS, HOLES, DETAIL, PATH }

const SHAPES: Array = [
	[&"circle", "Circle…"], [&"rectangle", "Rectangle…"], [&"capsule", "Capsule…"],
	[&"regular_polygon", "Regular Polygon…"], [&"", ""], [&"polygon_2d", "From Polygon2D…"],
	[&"sprite_2d", "From Sprite2D…"], [&"texture", "From Texture…"], [&"path_2d", "From Path2D…"], [&"", ""],
	[&"resample", "Resample…"], [&"mirror_horizontally", "Mirror Left and Right"],
	[&"mirror_vertically", "Mirror Up and Down"], [&"symmetric_left", "Make Symmetric from Left Half"],
	[&"symmetric_right", "Make Symmetric from Right Half"],
]
const PRESETS: Array = ["None (Outline Only)", "Center Point", "Cross-Braced", "Lattice"]

var mode_buttons: Array[Button] = []
var create_button: Button
var shape_menu: MenuButton
var structure_menu: MenuButton
var preview_button: Button
var help_button: Button


func _init() -> void:
	name = "SoftBody2DToolbar"


func _ready() -> void:
	add_child(VSeparator.new())
	var group := ButtonGroup.new()
	group.allow_unpress = true
	for entry: Array in [["polygon", "Shape the polygon.\nDrag points; click an edge to insert one; right-click erases.\nShift+drag selects by a box; Escape takes a drag back."],
			["springs", "Edit and paint springs."], ["pins", "Pin points."],
			["holes", "Shape holes.\nDrag points; click an edge to insert one; right-click erases, the whole hole when three are left.\nDouble-click takes a hole as a whole; the pen draws one more."],
			["detail", "Paint where the simulated outline is to be finer, and see how many points it takes."],
			["path", "Shape the path of the rope.\nDrag points; click the path to insert one; right-click erases.\nWith the pen, go on from an end or draw a new path."]]:
		var button := _add_button(Words.say(entry[1]))
		button.toggle_mode = true
		button.button_group = group
		button.set_meta(&"icon", entry[0])
		mode_buttons.append(button)
	group.pressed.connect(func(_button: BaseButton) -> void: mode_chosen.emit(mode()))
	create_button = _add_button("")
	create_button.toggle_mode = true
	create_button.set_meta(&"icon", "create")
	create_button.toggled.connect(func(enabled: bool) -> void: create_toggled.emit(enabled))
	shape_menu = _add_menu(Words.say("Shape"), Words.say("Start from a shape, or change the polygon as a whole."))
	for i in SHAPES.size():
		if SHAPES[i][0] == &"":
			shape_menu.get_popup().add_separator()
		else:
			shape_menu.get_popup().add_item(Words.say(SHAPES[i][1]), i)
	shape_menu.get_popup().id_pressed.connect(func(id: int) -> void: shape_chosen.emit(SHAPES[id][0]))
	structure_menu = _add_menu(Words.say("Structure"), Words.say("What the polygon is filled with."))
	for i in PRESETS.size():
		structure_menu.get_popup().add_item(Words.say(PRESETS[i]), i)
	structure_menu.get_popup().id_pressed.connect(func(id: int) -> void: preset_chosen.emit(id))
	preview_button = _add_button(Words.say("Play the body here, on a floor that is only there for it.\nPull at it with the mouse. Nothing is changed."))
	preview_button.toggle_mode = true
	preview_button.toggled.connect(func(enabled: bool) -> void: preview_toggled.emit(enabled))
	help_button = _add_button(Words.say("Open the class reference of SoftBody2D (F1)."))
	help_button.pressed.connect(func() -> void: help_wanted.emit())
	_update_icons()


func _notification(what: int) -> void:
	if what == NOTIFICATION_THEME_CHANGED and help_button != null:
		_update_icons()


func mode() -> Mode:
	for i in mode_buttons.size():
		if mode_buttons[i].button_pressed:
			return (i + 1) as Mode
	return Mode.NONE


## `of_ropes`: ropes have a path in place of all else.
func show_mode(mode: Mode, of_ropes := false) -> void:
	for i in mode_buttons.size():
		mode_buttons[i].set_pressed_no_signal(i + 1 == mode)
		mode_buttons[i].visible = of_ropes == (i + 1 == Mode.PATH)
	create_button.visible = mode in [Mode.POLYGON, Mode.HOLES, Mode.PATH]
	for control: Control in [shape_menu, structure_menu, preview_button]:
		control.visible = not of_ropes
	match mode:
		Mode.HOLES:
			create_button.tooltip_text = Words.say("Draw one more hole: click to place its points, click the first one again to close it.")
		Mode.PATH:
			create_button.tooltip_text = Words.say("Draw a path: click to place its points, click the last one again, or Enter. Begin at an end of the rope to make it longer.")
		_:
			create_button.tooltip_text = Words.say("Draw a new polygon: click to place its points, click the first one again to close it.")


func show_creating(enabled: bool) -> void:
	create_button.set_pressed_no_signal(enabled)


func show_preview(playing: bool) -> void:
	preview_button.set_pressed_no_signal(playing)
	_update_icons()


func _add_button(tooltip: String) -> Button:
	var button := Button.new()
	button.theme_type_variation = &"FlatButton"
	button.focus_mode = Control.FOCUS_NONE
	button.tooltip_text = tooltip
	add_child(button)
	return button


func _add_menu(text: String, tooltip: String) -> MenuButton:
	var menu := MenuButton.new()
	menu.text = text
	menu.tooltip_text = tooltip
	menu.switch_on_hover = true
	add_child(menu)
	return menu


func _update_icons() -> void:
	var theme := EditorInterface.get_editor_theme()
	for button: Button in mode_buttons + [create_button]:
		button.icon = Icons.of(button.get_meta(&"icon"), theme)
	preview_button.icon = theme.get_icon(&"Stop" if preview_button.button_pressed else &"Play", &"EditorIcons")
	help_button.icon = theme.get_icon(&"HelpSearch", &"EditorIcons")
