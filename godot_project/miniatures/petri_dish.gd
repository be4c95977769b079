# SPDX-License-Identifier: MIT
extends "res://common/toy.gd"
## A petri dish in the manner of Agar.io: cells press themselves flat at the round wall, flee from larger ones and
## swallow smaller ones, growing by their area.

const Steering := preload("res://common/steering.gd")
const Cell := preload("res://miniatures/petri_cell.gd")

const DISH_RADIUS := 640.0
const WALL := 60.0 # px, its thickness
const WALL_PARTS := 64
const OTHERS := 13
const CRUMBS := 70
const CRUMB_AREA := 110.0 # px²
const SIGHT := 260.0 # px, between the polygons
const PLAYER_RADIUS := 34.0
const TINTS: Array[Color] = [
	Color("ff6b6b"), Color("ffb347"), Color("b388eb"), Color("5aa9e6"), Color("ffd93d"), Color("f78fb3"),
]

var player: Cell
var crumbs := PackedVector2Array()

var _substance := SoftBodyMaterial2D.new()
var _random := RandomNumberGenerator.new()
var _follows_mouse := false

@onready var _camera: Camera2D = %Camera
@onready var _status: Label = %Status


func _init() -> void:
	_substance.stiffness = 18
	_substance.damping = 0.25
	_substance.pressure = 70
	_substance.shape_matching = 0.15
	_substance.shape_damping_ratio = 0.6
	_substance.friction = 0.05
	_substance.density = 0.9


func _build() -> void:
	_random.seed = 7
	_build_wall()
	player = _add_cell(Vector2.ZERO, PLAYER_RADIUS, Color("7ee081"))
	player.name = "Player"
	player.rotation = 0
	var look := Node2D.new()
	look.set_script(preload("res://demo/eyes.gd"))
	look.scale = Vector2(0.75, 0.75)
	look.position = Vector2(0, -6)
	player.add_child(look)
	for i in OTHERS:
		# The smallest around the middle, the largest near the wall; the golden angle spreads them.
		var size := float(i) / (OTHERS - 1)
		var place := Vector2.from_angle(2.4 * i + 0.9) * DISH_RADIUS * lerpf(0.3, 0.82, size)
		var cell := _add_cell(place, lerpf(14, 54, size * size), TINTS[i % TINTS.size()])
		cell.vigour = 0.72
	crumbs.clear()
	for i in CRUMBS:
		crumbs.append(_random_place())


func _add_cell(place: Vector2, radius: float, tint: Color) -> Cell:
	var cell := Cell.new(radius, tint, _substance)
	cell.position = place
	world.add_child(cell)
	return cell


func _build_wall() -> void:
	var wall := StaticBody2D.new()
	for i in WALL_PARTS:
		var shape := ConvexPolygonShape2D.new()
		var a := Vector2.from_angle(TAU * i / WALL_PARTS)
		var b := Vector2.from_angle(TAU * (i + 1) / WALL_PARTS)
		var outside := DISH_RADIUS + WALL
		shape.points = PackedVector2Array([a * DISH_RADIUS, a * outside, b * outside, b * DISH_RADIUS])
		var part := CollisionShape2D.new()
		part.shape = shape
		wall.add_child(part)
	world.add_child(wall)


func _random_place() -> Vector2:
	return Vector2.from_angle(_random.randf() * TAU) * (DISH_RADIUS - 30) * sqrt(_random.randf())


## The cells that have not been swallowed.
func get_cells() -> Array[Cell]:
	var cells: Array[Cell] = []
	for node in world.get_children():
		if node is Cell and not node.is_queued_for_deletion() and (node as Cell).swallowed_by == null:
			cells.append(node as Cell)
	return cells


func _unhandled_input(event: InputEvent) -> void:
	super(event)
	if event is InputEventMouseMotion or event is InputEventMouseButton:
		_follows_mouse = true


func _physics_process(_delta: float) -> void:
	var cells := get_cells()
	for cell in cells:
		cell.wish = _wish_of_player() if cell == player else _wish_of(cell, cells)
		_eat_crumbs(cell)
	_tell(cells)


func _wish_of_player() -> Vector2:
	var wish := Steering.direction()
	if wish != Vector2.ZERO:
		_follows_mouse = false
	if not _follows_mouse:
		return wish
	return ((get_global_mouse_position() - player.get_center_of_mass_position()) / 80).limit_length(1)


## Direction away from cells that could swallow it, else towards cells that it could swallow, else to the next crumb.
func _wish_of(cell: Cell, cells: Array[Cell]) -> Vector2:
	var place := cell.get_center_of_mass_position()
	var flight := Vector2.ZERO
	var prey := Vector2.ZERO
	var nearest := SIGHT
	for other in cells:
		var way := other.get_center_of_mass_position() - place
		var gap := way.length() - other.get_radius() - cell.get_radius()
		if other == cell or gap > SIGHT:
			continue
		if other.can_swallow(cell):
			flight -= way.normalized() * (1.2 - gap / SIGHT)
		elif cell.can_swallow(other) and gap < nearest:
			nearest = gap
			prey = way.normalized()
	# At the wall it goes along it, or it could be cornered at once.
	var rim := place.length() / (DISH_RADIUS - cell.get_radius())
	if flight != Vector2.ZERO:
		var outward := place.normalized()
		if rim > 0.85 and flight.dot(outward) > 0:
			flight -= outward * flight.dot(outward) * 1.2
		return flight.normalized()
	if prey != Vector2.ZERO:
		return prey * 0.8
	var crumb := Vector2.ZERO
	var shortest := INF
	for at in crumbs:
		var distance := place.distance_squared_to(at)
		if distance < shortest:
			shortest = distance
			crumb = at
	return (crumb - place).normalized() * 0.5


func _eat_crumbs(cell: Cell) -> void:
	var place := cell.get_center_of_mass_position()
	var reach := cell.get_radius() * cell.get_radius()
	for i in crumbs.size():
		if place.distance_squared_to(crumbs[i]) < reach:
			crumbs[i] = _random_place()
			cell.feed(CRUMB_AREA)


func _tell(cells: Array[Cell]) -> void:
	if not is_instance_valid(player) or player.swallowed_by != null:
		_status.text = "You were swallowed. R starts again."
	elif cells.size() == 1:
		_status.text = "The dish is yours! R starts again."
	else:
		var larger := 0
		for cell in cells:
			larger += int(cell.get_rest_area() > player.get_rest_area())
		_status.text = "%.1f times your first size   ·   %d of %d" % [
			player.get_rest_area() / (PI * PLAYER_RADIUS * PLAYER_RADIUS), larger + 1, cells.size()]


func _process(delta: float) -> void:
	if is_instance_valid(player) and player.is_inside_tree():
		_camera.position = player.get_interpolated_transform().origin
		var zoom := clampf(1.35 * pow(PLAYER_RADIUS / player.get_radius(), 0.6), 0.5, 1.35)
		_camera.zoom = _camera.zoom.lerp(Vector2.ONE * zoom, minf(1, 2 * delta))
	else:
		_camera.position = _camera.position.lerp(Vector2.ZERO, minf(1, delta))
		_camera.zoom = _camera.zoom.lerp(Vector2.ONE * 0.5, minf(1, delta))
	queue_redraw()


func _draw() -> void:
	draw_circle(Vector2.ZERO, DISH_RADIUS + WALL, Color("8fa6c9"))
	draw_circle(Vector2.ZERO, DISH_RADIUS, Color("e9f1e4"))
	for i in 9:
		draw_arc(Vector2.ZERO, DISH_RADIUS * (i + 1) / 9.0, 0, TAU, 96, Color(0.3, 0.45, 0.4, 0.08), 2)
	draw_arc(Vector2.ZERO, DISH_RADIUS + WALL * 0.5, 0, TAU, 128, Color("a9bcd9"), WALL * 0.5)
	draw_arc(Vector2.ZERO, DISH_RADIUS + 2, 0, TAU, 128, Color("5c7096"), 4, true)
	draw_arc(Vector2.ZERO, DISH_RADIUS + WALL * 0.6, -2.3, -1.2, 40, Color(1, 1, 1, 0.6), 8, true)
	for i in crumbs.size():
		draw_circle(crumbs[i], 5, TINTS[i % TINTS.size()].darkened(0.1))
