# SPDX-License-Identifier: MIT
@tool
extends VBoxContainer
## Shows of the selected bodies whether they are stable, what they cost and how far they sag, and applies advice.

const Advice := preload("../logic/stability_advice.gd")
const Words := preload("../logic/words.gd")
const MaterialAccess := preload("../logic/material_access.gd")

const COLORS: Array[Color] = [Color("5fc96a"), Color("f0b93a"), Color("f0605f")]
## What a material has instead of a body that shares it.
const OF_MATERIAL: Array[StringName] = [&"youngs_modulus", &"stiffness", &"damping"]
const LOOK_AGAIN := 0.4
## A measurement of what it would take to do it every time that something moves [ms].
const TIME_LIMIT := 20.0

## Whether the figures are unfolded, in this and later panels.
static var shows_figures := false

## For tests: what is shown.
var headline: Advice.Row
var report := {}
var shown_rows: Array[Advice.Row] = []
var shown_advice: Array[Advice.Advice] = []
var advice_buttons: Array[Button] = []

var _canvas: RefCounted # BodyCanvas
var _bodies: Array[SoftBody2D] = []
var _known := 0
var _grid := GridContainer.new()
var _list := VBoxContainer.new()
var _title := Label.new()
var _light := ColorRect.new()
var _headline := Label.new()
var _fold := Button.new()


func set_up(canvas: RefCounted, bodies: Array[SoftBody2D]) -> void:
	_canvas = canvas
	_bodies = bodies


func _ready() -> void:
	name = "SoftBodyStability"
	_title.theme_type_variation = &"HeaderSmall"
	add_child(_title)
	var line := HBoxContainer.new()
	_light.custom_minimum_size = Vector2.ONE * 12 * EditorInterface.get_editor_scale()
	_light.size_flags_vertical = Control.SIZE_SHRINK_CENTER
	_headline.autowrap_mode = TextServer.AUTOWRAP_WORD_SMART
	_headline.size_flags_horizontal = Control.SIZE_EXPAND_FILL
	_fold.text = Words.say("Figures")
	_fold.tooltip_text = Words.say("Shows what the line is made of: frequency, substeps, sag, cost and more.")
	_fold.toggle_mode = true
	_fold.set_pressed_no_signal(shows_figures)
	_fold.size_flags_vertical = Control.SIZE_SHRINK_CENTER
	_fold.toggled.connect(_show_figures)
	for part: Control in [_light, _headline, _fold]:
		line.add_child(part)
	add_child(line)
	_grid.visible = shows_figures
	_grid.columns = 3
	_grid.add_theme_constant_override(&"h_separation", roundi(8 * EditorInterface.get_editor_scale()))
	add_child(_grid)
	add_child(_list)
	add_child(HSeparator.new())
	var timer := Timer.new()
	timer.wait_time = LOOK_AGAIN
	timer.timeout.connect(_look)
	add_child(timer)
	timer.start()
	_look.call_deferred()


# What the figures depend on. Cheap next to the figures themselves.
func _look() -> void:
	if Input.is_mouse_button_pressed(MOUSE_BUTTON_LEFT):
		return # something is being dragged: nothing may make it stutter
	var values := []
	for body in _bodies:
		if not is_instance_valid(body):
			return
		values.append([body.polygon, body.inner_points, body.center_point, body.springs, body.spring_stiffness_scales,
				body.spring_damping_scales, body.spring_length_scales, body.pinned_points, body.get_total_mass(),
				body.gravity_scale, body.integrator, body.substeps, body.collision_mask, body.global_transform.x,
				body.global_transform.y, body.elastic_model, body.least_area, body.least_stretch, body.most_stretch,
				body.firm_for_weight, body.detail_mode, body.detail_tolerance, body.detail_point_count])
		for property: StringName in [&"youngs_modulus", &"poisson_ratio", &"damping_ratio", &"stiffness", &"damping",
				&"shape_matching", &"shape_damping_ratio", &"pressure", &"inflation", &"yield_strain", &"flow_rate", &"max_dent",
				&"tear_stretch", &"dent_by"]:
			values.append(body.get(property))
	values.append(Engine.physics_ticks_per_second)
	var known := hash(values)
	if known != _known and is_visible_in_tree():
		_known = known
		refresh()


func refresh() -> void:
	for child in _grid.get_children() + _list.get_children():
		child.queue_free()
	advice_buttons.clear()
	shown_rows.clear()
	shown_advice.clear()
	var worst: SoftBody2D = null
	for body in _bodies:
		if not is_instance_valid(body) or not body.is_inside_tree():
			continue
		var found := body.get_stability_report(TIME_LIMIT)
		if worst == null or _badness(found) > _badness(report):
			worst = body
			report = found
	if worst == null:
		return
	_title.text = Words.say("Stability") if _bodies.size() == 1 else Words.say("Stability (worst of %d: %s)") % [_bodies.size(), worst.name]
	var say := Words.say
	shown_rows = Advice.rows(report, 1.0 / Engine.physics_ticks_per_second, say)
	for row in shown_rows:
		_add_row(row)
	shown_advice = Advice.advice(report, own_values(worst), say)
	for advice in shown_advice:
		_add_advice(advice)
	headline = Advice.headline(shown_rows, shown_advice, say)
	_headline.text = headline.text
	_headline.tooltip_text = headline.hint
	_light.color = COLORS[headline.level]


func _show_figures(shown: bool) -> void:
	shows_figures = shown
	_grid.visible = shown


func _badness(of: Dictionary) -> int:
	var sum := 0
	for row in Advice.rows(of, 1.0 / Engine.physics_ticks_per_second, Words.say):
		sum += [0, 1, 100][row.level]
	return sum


static func own_values(body: SoftBody2D) -> Dictionary:
	return {"youngs_modulus": body.youngs_modulus, "stiffness": body.stiffness, "damping": body.damping, "substeps": body.substeps,
			"integrator": body.integrator}


func _add_row(row: Advice.Row) -> void:
	var light := ColorRect.new()
	light.color = COLORS[row.level]
	light.custom_minimum_size = Vector2.ONE * 12 * EditorInterface.get_editor_scale()
	light.size_flags_vertical = Control.SIZE_SHRINK_CENTER
	var title := Label.new()
	title.text = row.title
	title.size_flags_horizontal = Control.SIZE_EXPAND_FILL
	title.autowrap_mode = TextServer.AUTOWRAP_WORD_SMART
	var value := Label.new()
	value.text = row.text
	value.horizontal_alignment = HORIZONTAL_ALIGNMENT_RIGHT
	for part: Control in [light, title, value]:
		part.tooltip_text = row.hint
		part.mouse_filter = Control.MOUSE_FILTER_PASS
		_grid.add_child(part)


func _add_advice(advice: Advice.Advice) -> void:
	var row := HBoxContainer.new()
	var text := Label.new()
	text.text = advice.text
	text.autowrap_mode = TextServer.AUTOWRAP_WORD_SMART
	text.size_flags_horizontal = Control.SIZE_EXPAND_FILL
	row.add_child(text)
	var button := Button.new()
	button.text = Words.say("Apply")
	button.size_flags_vertical = Control.SIZE_SHRINK_CENTER
	button.pressed.connect(apply.bind(advice))
	row.add_child(button)
	advice_buttons.append(button)
	_list.add_child(row)


## Sets the advised values on all of the bodies, in one step of undo. Values of a shared material are set there.
func apply(advice: Advice.Advice) -> void:
	if _canvas == null:
		return
	var changes: Array[Dictionary] = []
	var seen := {}
	for body in _bodies:
		var lock: String = _canvas.lock_problem(body)
		if lock != "":
			_canvas.warn(lock)
			return
		var is_network := body.get_elastic_model_in_use() == SoftBody2D.ELASTIC_MODEL_NETWORK
		for property: StringName in advice.changes:
			if property in OF_MATERIAL and (property == &"youngs_modulus") == is_network:
				continue # another model than the worst body's: this value does nothing here, or would make it a network
			var target: Object = body
			if body.soft_body_material != null and property in OF_MATERIAL:
				target = body.soft_body_material
				var problem := MaterialAccess.problem(body.soft_body_material, EditorInterface.get_edited_scene_root())
				if problem != "":
					_canvas.warn(problem)
					return
			var value: Variant = advice.changes[property]
			# What is enough for the worst must not make another one softer.
			if property in OF_MATERIAL and target.get(property) >= value:
				continue
			if not seen.has([target, property]) and target.get(property) != value:
				seen[[target, property]] = true
				changes.append({"object": target, "property": property, "before": target.get(property), "after": value})
	_canvas.commit(Words.say("Apply Stability Advice"), {}, {}, changes)
	_look()
