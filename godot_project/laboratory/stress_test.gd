# SPDX-License-Identifier: MIT
extends Node2D
## Adds bodies until stepping them takes as long as a frame at 60 Hz may last, takes some away while it takes longer,
## and shows how many that are beside the counts of the thesis's Table 4.1.
##
## The bodies are the thesis's, eight points around one in the middle, and never sleep, or they would cost nothing.

const Curves := preload("res://laboratory/curves.gd")

const SMOOTHING := 0.06 # share of the newest step in the mean
const ENOUGH := 0.92 # of the budget, from which on no body is added
const WATCHED := 120 # ticks, over which the count is averaged once the budget has been reached
const BASIN := Rect2(0, 150, 2560, 1170) # px
const RADIUS := 11.0 # px
const MOST_A_TICK := 14
const ENTRY_SPEED := 260.0 # px/s
## Bodies within a sixtieth of a second in Table 4.1: with and without collisions.
const THESIS := {
	SoftBody2D.INTEGRATOR_EXPLICIT_EULER: [132, 3534],
	SoftBody2D.INTEGRATOR_MIDPOINT: [72, 1817],
	SoftBody2D.INTEGRATOR_RUNGE_KUTTA_4: [36, 912],
}
const METHODS := {
	SoftBody2D.INTEGRATOR_AUTOMATIC: "automatic",
	SoftBody2D.INTEGRATOR_EXPLICIT_EULER: "explicit Euler",
	SoftBody2D.INTEGRATOR_MIDPOINT: "midpoint",
	SoftBody2D.INTEGRATOR_RUNGE_KUTTA_4: "Runge-Kutta 4",
}

## How long a step may take [µs].
var budget := 1e6 / 60
var most_bodies := 6000
var integrator := SoftBody2D.INTEGRATOR_AUTOMATIC
var collides := true
## How many bodies take a whole frame; 0 until that is known.
var found := 0
var count := 0

var _bodies: Node2D
var _substance := SoftBodyMaterial2D.new()
var _polygon := SoftBody2D.make_circle_polygon(RADIUS, 8)
var _smooth := 0.0 # µs
var _watched := 0 # ticks since the budget was first reached
var _mean_count := 0.0
var _results := {} # "integrator collides" -> bodies

@onready var _methods: OptionButton = %Methods
@onready var _with_collisions: CheckButton = %WithCollisions
@onready var _table: Label = %Table
@onready var _status: Label = %Status
@onready var _curve: Curves = %Curve


func _ready() -> void:
	# Firm enough for what lies on top: a pile of folded bodies would be all contacts.
	_substance.stiffness = 40
	_substance.damping = 0.06
	for method: int in METHODS:
		_methods.add_item(METHODS[method], method)
	_methods.item_selected.connect(func(_index: int) -> void: start(_methods.get_selected_id(), collides))
	_with_collisions.toggled.connect(func(pressed: bool) -> void: start(integrator, pressed))
	start(integrator, collides)


## Begins anew with an empty basin.
func start(new_integrator: int, new_collides: bool) -> void:
	integrator = new_integrator as SoftBody2D.Integrator
	collides = new_collides
	found = 0
	count = 0
	_watched = 0
	_smooth = 0
	if _bodies != null:
		remove_child(_bodies)
		_bodies.queue_free()
	_bodies = Node2D.new()
	add_child(_bodies)
	_curve.start(PackedColorArray([Color("ffd166"), Color("ff6b6b")]))


func _unhandled_input(event: InputEvent) -> void:
	var key := event as InputEventKey
	if key != null and key.pressed and not key.echo and key.keycode == KEY_R:
		start(integrator, collides)


func _physics_process(_delta: float) -> void:
	var last := SoftBodySimulation2D.get_last_step_usec()
	_smooth = last if _smooth == 0 else lerpf(_smooth, last, SMOOTHING)
	_curve.add(PackedFloat32Array([_smooth / 1000, budget / 1000]))
	if _smooth > budget:
		_watched = maxi(_watched, 1)
		for i in mini(ceili(count * 0.004), count):
			_remove_body()
	elif _smooth < ENOUGH * budget:
		_add_some()
	if count >= most_bodies:
		_watched = maxi(_watched, 1)
	_watch()
	_tell()


## The nearer the budget, the fewer at a time, so that a step late by a moment does not decide.
func _add_some() -> void:
	# What has been added weighs most once it has fallen on the others.
	var share := clampf(1.1 - _smooth / budget, 0.05, 1) * (1.0 if _watched == 0 else 0.1)
	for i in ceili(share * MOST_A_TICK):
		if count < most_bodies:
			_add_body()


func _add_body() -> void:
	var body := SoftBody2D.new()
	body.polygon = _polygon
	body.elastic_model = SoftBody2D.ELASTIC_MODEL_NETWORK
	body.soft_body_material = _substance
	body.mass = 0.03
	# The thesis's bodies have a radius of half a meter; a meter is 22 px here, not 100.
	body.gravity_scale = 0.22
	body.integrator = integrator
	body.can_sleep = false
	body.collision_proxy_enabled = false
	body.color = Color.from_hsv(fmod(count * 0.0137, 1), 0.55, 0.95)
	if collides:
		# Every one beside the last, in eight rows above the basin that have fallen away when their turn comes again.
		var columns := int(BASIN.size.x / (3.2 * RADIUS)) - 2
		body.position = Vector2(BASIN.position.x + (1.5 + count % columns) * 3.2 * RADIUS,
				BASIN.position.y - 60 - 30 * (floori(float(count) / columns) % 8))
		body.linear_velocity = Vector2(0, ENTRY_SPEED)
	else:
		body.collision_mask = 0
		body.collision_layer = 0
		body.gravity_scale = 0
		body.position = BASIN.position + Vector2(fmod(count * 37.3, BASIN.size.x), fmod(count * 61.7, BASIN.size.y))
	_bodies.add_child(body)
	count += 1


func _remove_body() -> void:
	var body := _bodies.get_child(count - 1)
	_bodies.remove_child(body)
	body.queue_free()
	count -= 1


func _watch() -> void:
	if _watched == 0:
		return
	_mean_count = float(count) if _watched == 1 else lerpf(_mean_count, count, 2.0 / WATCHED)
	_watched += 1
	if _watched > WATCHED:
		found = roundi(_mean_count)
		_results["%d %s" % [integrator, collides]] = found


func _tell() -> void:
	_status.text = "%d bodies · %.1f of %.1f ms a step · %d contacts" % [
		count, _smooth / 1000, budget / 1000, SoftBodySimulation2D.get_contact_count()]
	if found > 0:
		_status.text += "\nA frame's worth: %d bodies." % found if found < most_bodies \
				else "\nThe basin is full before the frame: %d." % found
	var text := ""
	for method: int in METHODS:
		text += "%s\n" % METHODS[method]
		for with: bool in [true, false]:
			var mine: int = _results.get("%d %s" % [method, with], 0)
			var thesis := str(THESIS[method][0 if with else 1]) if method in THESIS else "–"
			text += "   %s: thesis %s, here %s\n" % ["colliding" if with else "apart", thesis, str(mine) if mine > 0 else "?"]
	_table.text = text
