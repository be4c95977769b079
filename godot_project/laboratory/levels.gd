# SPDX-License-Identifier: MIT
extends Node2D
## Shows by color how each body was simulated in the last tick: in full, as a rigid body in flight, or not at all. Bodies are tossed up
## in turn; three drift without weight.

const RIGID_FLIGHT := "physics/soft_body_2d/solver/rigid_flight"
const COLORS := {
	"full": Color("ff8c42"),
	"rigid": Color("4ea8ff"),
	"asleep": Color("7d8ca3"),
	"paused": Color("4a4f63"),
}
const COLUMNS := 6
const ROWS := 2
const TOSS := 900.0 # px/s
const TICKS_A_TOSS := 45

## Bodies of each level in the last tick.
var counts := {}
var bodies: Array[SoftBody2D] = []

var _ticks := 0
var _was_on: bool

@onready var _legend: RichTextLabel = %Legend
@onready var _toggle: CheckButton = %RigidFlight


func _ready() -> void:
	_was_on = ProjectSettings.get_setting(RIGID_FLIGHT)
	_toggle.toggled.connect(set_rigid_flight)
	set_rigid_flight(true)
	for i in COLUMNS * ROWS:
		_add_body(Vector2(340 + 150 * (i % COLUMNS), 560 - 120 * floori(i / float(COLUMNS))), 16 + 8 * (i % 3))
	for i in 3:
		var drifting := _add_body(Vector2(400 + 300 * i, 130), 24)
		drifting.gravity_scale = 0
		drifting.linear_damp_mode = SoftBody2D.DAMP_MODE_REPLACE
		drifting.angular_damp_mode = SoftBody2D.DAMP_MODE_REPLACE
		drifting.linear_velocity = Vector2(20 - 20 * i, 3)
		drifting.angular_velocity = 0.5


func _exit_tree() -> void:
	ProjectSettings.set_setting(RIGID_FLIGHT, _was_on)


func set_rigid_flight(enabled: bool) -> void:
	ProjectSettings.set_setting(RIGID_FLIGHT, enabled)
	_toggle.set_pressed_no_signal(enabled)


func _add_body(at: Vector2, points: int) -> SoftBody2D:
	var body := SoftBody2D.new()
	body.polygon = SoftBody2D.make_circle_polygon(44, points)
	body.position = at
	add_child(body)
	bodies.append(body)
	return body


func _physics_process(_delta: float) -> void:
	if _ticks % TICKS_A_TOSS == 0:
		var tossed := bodies[floori(_ticks / float(TICKS_A_TOSS)) * 5 % (COLUMNS * ROWS)]
		tossed.linear_velocity = Vector2(0, -TOSS)
		tossed.angular_velocity = 1.5
	_ticks += 1
	counts = {}
	for level: String in COLORS:
		counts[level] = 0
	for body in bodies:
		var level: String = body.get_detail_report().level
		counts[level] += 1
		body.color = COLORS[level]
	var lines := PackedStringArray()
	for level: String in COLORS:
		lines.append("[color=#%s]●[/color] %s: %d" % [(COLORS[level] as Color).to_html(false), level, counts[level]])
	_legend.text = "\n".join(lines)
