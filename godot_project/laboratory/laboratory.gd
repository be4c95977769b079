# SPDX-License-Identifier: MIT
extends Node2D
## All models and all integrators side by side under the same load, with sliders for what they are made of.

const Curves := preload("res://laboratory/curves.gd")
const MaterialPanel := preload("res://laboratory/material_panel.gd")
const StabilityText := preload("res://laboratory/stability_text.gd")
const Solid := preload("res://common/solid.gd")
const Grabber := preload("res://common/grabber.gd")

enum Load { DROP, PRESS, THROW }

const LEFT := 322.0 # px, of the lanes
const RIGHT := 962.0
const FLOORS: Array[float] = [372.0, 690.0]
const ROOM := 262.0 # px, the height of a lane
const WALL := 6.0
const PRESS_TO := 0.55 # of the body's height
const REPORT_DELAY := 0.5 # s after a change
const MODELS: Array[String] = ["mass-spring", "pressure", "shape matching", "combined"]
const COLORS: Array[Color] = [
	Color("ff6b6b"), Color("ffb347"), Color("ffe066"), Color("a8d672"), Color("4ecdc4"), Color("5aa9e6"), Color("b388eb"),
	Color("f78fb3"),
]

## What the sliders change; the models leave out what they do without.
var base := SoftBodyMaterial2D.new()
## Those of the upper row, then those of the lower one.
var bodies: Array[SoftBody2D] = []
var current_load := Load.DROP

var _starts: Array[Vector2] = []
var _rows: Array[int] = []
var _names: Array[String] = []
var _model_count := 0
var _plates: Array[AnimatableBody2D] = []
var _plate_age := 0.0
var _shown_row := 0
var _selected := 3
var _report_age := 0.0

@onready var _panel: MaterialPanel = %Materials
@onready var _loads: HBoxContainer = %Loads
@onready var _row_button: Button = %Row
@onready var _energy: Curves = %Energy
@onready var _penetration: Curves = %Penetration
@onready var _area: Curves = %Area
@onready var _plan: Label = %Plan
@onready var _stability: Label = %Stability


func _ready() -> void:
	base.stiffness = 260
	base.damping = 0.8
	base.pressure = 400
	base.shape_matching = 0.4
	_build_lanes()
	_panel.show_material(base)
	_panel.value_changed.connect(_on_value_changed)
	for load_name: String in Load:
		var button := Button.new()
		button.text = load_name.capitalize()
		button.pressed.connect(apply_load.bind(Load[load_name]))
		button.size_flags_horizontal = Control.SIZE_EXPAND_FILL
		_loads.add_child(button)
	_row_button.pressed.connect(func() -> void: show_row(1 - _shown_row))
	var grabber := Grabber.new()
	add_child(grabber)
	_spread_values()
	show_row(0)
	apply_load(Load.DROP)


func _build_lanes() -> void:
	var solid := StaticBody2D.new()
	solid.set_script(Solid)
	for row in 2:
		var count := MODELS.size() if row == 0 else COLORS.size()
		var width := (RIGHT - LEFT) / count
		Solid.add_box(solid, Rect2(LEFT - WALL / 2, FLOORS[row], RIGHT - LEFT + WALL, 20))
		for i in count + 1:
			Solid.add_box(solid, Rect2(LEFT + i * width - WALL / 2, FLOORS[row] - ROOM, WALL, ROOM + 1))
		var plate := AnimatableBody2D.new()
		plate.set_script(Solid)
		plate.set(&"fill", Color("8a4f5d"))
		plate.set(&"edge", Color("d98e8e"))
		plate.sync_to_physics = false
		for i in count:
			Solid.add_box(plate, Rect2(LEFT + i * width + WALL, -14, width - 2 * WALL, 14))
			var radius := minf(width * 0.3, 46)
			_add_body(row, i, Vector2(LEFT + (i + 0.5) * width, FLOORS[row] - ROOM + radius + 30), radius)
		add_child(plate)
		_plates.append(plate)
	add_child(solid)


func _add_body(row: int, index: int, place: Vector2, radius: float) -> void:
	var body := SoftBody2D.new()
	body.polygon = SoftBody2D.make_circle_polygon(radius, 16)
	body.position = place
	body.elastic_model = SoftBody2D.ELASTIC_MODEL_NETWORK
	body.soft_body_material = SoftBodyMaterial2D.new()
	body.mass = 1
	body.color = COLORS[index]
	body.smooth = true
	body.antialiased = true
	body.outline_width = 3
	body.outline_color = COLORS[index].darkened(0.45)
	body.can_sleep = false
	body.collision_proxy_enabled = false
	var title := Label.new()
	title.add_theme_font_size_override(&"font_size", 11 if row == 1 else 13)
	title.position = Vector2(place.x - 80, FLOORS[row] + 1)
	title.size = Vector2(160, 16)
	title.horizontal_alignment = HORIZONTAL_ALIGNMENT_CENTER
	if row == 0:
		body.name = MODELS[index].to_pascal_case()
		body.center_point = index != 1
		title.text = MODELS[index]
		if index == 2: # the springs would do a part of it
			for i in body.get_spring_count():
				body.set_spring_stiffness_scale(i, 0.1)
		_model_count += 1
	else:
		body.integrator = index as SoftBody2D.Integrator
		body.name = StabilityText.METHODS[index].to_pascal_case()
		title.text = StabilityText.METHODS[index].replace("semi-implicit", "semi-impl.").replace("velocity", "vel.")
	_names.append(StabilityText.METHODS[index] if row == 1 else MODELS[index])
	body.add_to_group(&"soft_bodies")
	add_child(body)
	title.z_index = 5
	add_child(title)
	bodies.append(body)
	_starts.append(place)
	_rows.append(row)


func _on_value_changed(property: StringName, value: float) -> void:
	base.set(property, value)
	_spread_values()
	_report_age = 0


## Every body gets the values of the sliders, except for what its model does without.
func _spread_values() -> void:
	for i in bodies.size():
		var own := bodies[i].soft_body_material
		for property: StringName in _panel.get_names():
			own.set(property, base.get(property))
		if i < _model_count:
			if i == 0 or i == 2:
				own.pressure = 0
			if i == 0 or i == 1:
				own.shape_matching = 0


## All bodies start anew, under this load.
func apply_load(new_load: Load) -> void:
	current_load = new_load
	_plate_age = 0
	for i in bodies.size():
		var body := bodies[i]
		var radius := sqrt(body.get_rest_area() / PI)
		var place := _starts[i]
		if new_load == Load.PRESS:
			place.y = FLOORS[_rows[i]] - radius - 1
		body.global_transform = Transform2D(0, place)
		body.reset()
		if new_load == Load.THROW:
			body.linear_velocity = Vector2(520, -180)
			body.angular_velocity = 9
	_move_plates(0)


func show_row(row: int) -> void:
	_shown_row = row
	var rows := ["the models", "the integrators"]
	_row_button.text = "Curves of %s; show %s" % [rows[row], rows[1 - row]]
	var colors := PackedColorArray()
	for i in bodies.size():
		if _rows[i] == row:
			colors.append(COLORS[colors.size()])
	for curves: Curves in [_energy, _penetration, _area]:
		curves.start(colors)
	select(_model_count - 1 if row == 0 else _model_count)


## Whose plan and stability are shown.
func select(index: int) -> void:
	_selected = index
	_report_age = 0
	for curves: Curves in [_energy, _penetration, _area]:
		curves.brighten(index - (_model_count if _shown_row == 1 else 0))


func _unhandled_input(event: InputEvent) -> void:
	var key := event as InputEventKey
	var button := event as InputEventMouseButton
	if key != null and key.pressed and not key.echo and key.keycode == KEY_R:
		apply_load(current_load)
	elif button != null and button.pressed and button.button_index == MOUSE_BUTTON_LEFT:
		for i in bodies.size():
			if bodies[i].has_point(get_global_mouse_position()):
				if _rows[i] != _shown_row:
					show_row(_rows[i])
				select(i)


func _physics_process(delta: float) -> void:
	if current_load == Load.PRESS:
		_plate_age += delta
	_move_plates(_plate_age)
	var energies := PackedFloat32Array()
	var depths := PackedFloat32Array()
	var areas := PackedFloat32Array()
	for i in bodies.size():
		if _rows[i] == _shown_row:
			energies.append(bodies[i].get_kinetic_energy() / 1e4) # kg px²/s² in J
			depths.append(bodies[i].get_penetration())
			areas.append(100 * bodies[i].get_area() / bodies[i].get_rest_area())
	_energy.add(energies)
	_penetration.add(depths)
	_area.add(areas)
	_plan.text = "%s\n%s" % [_names[_selected].capitalize(), StabilityText.describe_plan(bodies[_selected])]
	var before := _report_age
	_report_age += delta
	if before < REPORT_DELAY and _report_age >= REPORT_DELAY:
		_stability.text = StabilityText.describe_stability(bodies[_selected])


## Down in a second, held for a second, up in a second, again and again; out of the way under other loads.
func _move_plates(age: float) -> void:
	var phase := fmod(age, 4.0)
	var share := smoothstep(0, 1, phase) - smoothstep(2, 3, phase)
	for row in 2:
		var radius := sqrt(bodies[0 if row == 0 else _model_count].get_rest_area() / PI)
		var high := FLOORS[row] - ROOM + 15
		var low := FLOORS[row] - PRESS_TO * 2 * radius
		_plates[row].position = Vector2(0, lerpf(high, low, share))
