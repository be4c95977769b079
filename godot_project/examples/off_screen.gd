# SPDX-License-Identifier: MIT
extends Node2D
## Makes a long row of soft bodies that stand still while no camera sees them, and moves a camera along it.

const COUNT := 90
const SPACING := 80.0 # px
const PERIOD := 24.0 # s

var _age := 0.0

@onready var _camera: Camera2D = %Camera
@onready var _status: Label = %Status


func _ready() -> void:
	var rubber := PhysicsMaterial.new()
	rubber.friction = 0.4
	rubber.bounce = 0.92
	for i in COUNT:
		var body := SoftBody2D.new()
		body.polygon = SoftBody2D.make_circle_polygon(34, 14)
		body.position = Vector2(80 + SPACING * i, 250 + 90 * (i % 3))
		body.elastic_model = SoftBody2D.ELASTIC_MODEL_NETWORK
		body.stiffness = 180
		body.mass = 1
		body.physics_material_override = rubber
		body.can_sleep = false
		body.simulate_off_screen = false
		body.color = Color.from_hsv(fmod(i * 0.07, 1), 0.5, 0.95)
		body.smooth = true
		body.antialiased = true
		body.outline_width = 4
		body.outline_color = body.color.darkened(0.5)
		add_child(body)


func _physics_process(delta: float) -> void:
	_age += delta
	_camera.position.x = 640 + (COUNT * SPACING - 1280) * (0.5 - 0.5 * cos(TAU * _age / PERIOD))
	_status.text = "%d of %d bodies simulated, %d µs a step" % [
		SoftBodySimulation2D.get_awake_body_count(), COUNT, roundi(SoftBodySimulation2D.get_last_step_usec())]
