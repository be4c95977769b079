# SPDX-License-Identifier: MIT
extends "res://common/toy.gd"
## A crash in the manner of Wreckfest: soft cars with soft wheels, a wall at the end of
## the road, and other cars before it.

const Solid := preload("res://common/solid.gd")
const Steering := preload("res://common/steering.gd")
const Car := preload("res://miniatures/car.gd")

const ROAD_Y := 560.0
const LEFT := -420.0
const RIGHT := 2700.0
const SPARK_LIFE := 0.45 # s
const LOUD := 90.0 # kg px/s; impulse of a contact that throws sparks
const MOST_SPARKS := 80

var player: Car
var others: Array[Car] = []

var _sparks: Array[Dictionary] = []
var _top_speed := 0.0
var _started := false

@onready var _overlay: Node2D = %Overlay
@onready var _camera: Camera2D = %Camera
@onready var _status: Label = %Status


func _ready() -> void:
	super()
	_overlay.draw.connect(_draw_sparks)


func _build() -> void:
	_sparks.clear()
	_top_speed = 0
	_started = false
	var ground := StaticBody2D.new()
	ground.set_script(Solid)
	ground.set(&"fill", Color("41435a"))
	ground.set(&"edge", Color("c9cbd8"))
	ground.physics_material_override = PhysicsMaterial.new()
	ground.physics_material_override.friction = 1
	ground.physics_material_override.rough = true
	Solid.add_box(ground, Rect2(LEFT - 600, ROAD_Y, RIGHT - LEFT + 1200, 400))
	world.add_child(ground)
	# The walls are smooth, or the wheels would climb them.
	var walls := StaticBody2D.new()
	walls.set_script(Solid)
	walls.set(&"fill", Color("8a4f5d"))
	walls.set(&"edge", Color("d98e8e"))
	Solid.add_box(walls, Rect2(RIGHT, ROAD_Y - 330, 200, 330))
	Solid.add_box(walls, Rect2(LEFT - 200, ROAD_Y - 330, 200, 330))
	world.add_child(walls)
	player = _add_car(Color("ffb347"), 0, 1)
	player.name = "Player"
	others = [_add_car(Color("5aa9e6"), 2560, 1), _add_car(Color("a8d672"), 1900, -1)]


func _add_car(tint: Color, x: float, direction: float) -> Car:
	var car := Car.new(tint, direction)
	car.position = Vector2(x, ROAD_Y - 42)
	world.add_child(car)
	return car


func _physics_process(delta: float) -> void:
	var wish := Steering.direction().x
	_started = _started or wish != 0
	player.throttle = wish
	# The green one comes towards the player once the player moves.
	others[1].throttle = 0.6 if _started and others[1].get_place().x > player.get_place().x else 0.0
	_top_speed = maxf(_top_speed, player.body.get_linear_velocity().length())
	_add_sparks()
	for spark in _sparks:
		spark["age"] += delta
		spark["velocity"] += Vector2(0, 980) * delta
		spark["place"] += spark["velocity"] * delta
	_sparks = _sparks.filter(func(spark: Dictionary) -> bool: return spark["age"] < SPARK_LIFE)
	var first: float = Car.OUTLINE[8].x - Car.OUTLINE[1].x
	_status.text = "%d px/s, at most %d   ·   your car is %d %% shorter than it was" % [
		roundi(player.body.get_linear_velocity().length()), roundi(_top_speed),
		maxi(0, roundi(100 * (1 - player.get_length() / first)))]


func _add_sparks() -> void:
	for car: Car in [player, others[0], others[1]]:
		for i in mini(car.body.get_contact_count(), 3):
			if car.body.get_contact_impulse(i) < LOUD or _sparks.size() >= MOST_SPARKS:
				continue
			for k in 4:
				var way := car.body.get_contact_normal(i).rotated(randf_range(-1.3, 1.3)) * randf_range(100, 500)
				_sparks.append({"place": car.body.get_contact_position(i), "velocity": way, "age": 0.0})


func _process(delta: float) -> void:
	var focus := player.body.get_interpolated_transform().origin
	focus.x = clampf(focus.x + player.body.get_linear_velocity().x * 0.2, LEFT + 380, RIGHT - 380)
	_camera.position = _camera.position.lerp(Vector2(focus.x, 440), minf(1, 5 * delta))
	_overlay.queue_redraw()


func _draw() -> void:
	for i in 14: # hills
		draw_circle(Vector2(LEFT - 200 + 260 * i, ROAD_Y + 60), 150 + 50 * sin(i * 1.9), Color(0.2, 0.22, 0.4, 0.6))
	for i in 30: # posts, so that speed shows
		draw_rect(Rect2(LEFT + 110 * i, ROAD_Y - 46, 7, 46), Color(0.75, 0.78, 0.9, 0.35))
	draw_rect(Rect2(LEFT, ROAD_Y - 42, RIGHT - LEFT, 8), Color(0.75, 0.78, 0.9, 0.25))


func _draw_sparks() -> void:
	for spark in _sparks:
		var fade: float = 1 - spark["age"] / SPARK_LIFE
		_overlay.draw_line(spark["place"], spark["place"] - spark["velocity"] * 0.03, Color(1, 0.85, 0.4, fade), 3)
