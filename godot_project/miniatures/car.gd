# SPDX-License-Identifier: MIT
extends Node2D
## A car of three soft bodies: a body that keeps its dents, and two wheels that hang on it by springs.
##
## SoftBody2D is elastic: whatever dents it, it springs back. Here a script makes the dents stay. Where a point of
## the body has been pushed farther from its place in the rest shape than [constant YIELD], its place follows: a new
## `polygon` and new `inner_points` are a new rest shape, and with the state put back the body goes on as it lies.

## How far a point may be pushed and still spring back [px].
const YIELD := 5.0
## The share of what lies beyond that stays.
const FLOW := 0.7
## Ticks between two looks: each dent makes another shape, for a quarter of the time of a step of three cars.
const LOOK_INTERVAL := 2
## No point leaves its first place by more than this, along the car and upright to it [px].
const DEEPEST := Vector2(80, 26)
const TORQUE := 170000.0 # kg px²/s², of each wheel
const TOP_SPEED := 1400.0 # px/s
const WHEEL_RADIUS := 27.0
const AXLES: Array[Vector2] = [Vector2(-62, 14), Vector2(60, 14)]
## Seen from the side, its front to the right [px].
const OUTLINE: Array[Vector2] = [
	Vector2(-108, 24), Vector2(-110, -10), Vector2(-100, -20), Vector2(-58, -22), Vector2(-36, -58), Vector2(20, -58),
	Vector2(50, -20), Vector2(100, -12), Vector2(110, 2), Vector2(108, 24),
]
const SPACING := 15.0
## Which of the inner points is the middle one.
const MIDDLE := 4

## -1 backwards to 1 forwards.
var throttle := 0.0
## Whether dents stay; without, the car is as elastic as its bodies.
var keeps_dents := true
var body := SoftBody2D.new()
var wheels: Array[SoftBody2D] = []
## 1 if its front is to the right.
var direction := 1.0

var _first := PackedVector2Array()
var _age := 0


func _init(tint := Color.WHITE, p_direction := 1.0) -> void:
	direction = p_direction
	_add_body(tint)
	for place in AXLES:
		_add_wheel(place)


func _add_body(tint: Color) -> void:
	var outline := _divide(OUTLINE)
	body.name = "Body"
	body.polygon = outline
	body.center_point = false
	body.inner_points = PackedVector2Array([
		AXLES[0], AXLES[1], Vector2(-86, 2), Vector2(-34, 4), Vector2(0, 4), Vector2(32, 4), Vector2(86, 8),
		Vector2(-34, -26), Vector2(0, -30), Vector2(30, -24)])
	# The springs of the first shape stay, however it is dented.
	body.springs = body.get_all_springs()
	body.mass = 9
	body.stiffness = 1000
	body.damping = 3.5
	# The axles' springs are those of a frame: they carry the car.
	for i in body.get_spring_count():
		var ends := body.get_spring_points(i)
		if ends.y in [outline.size(), outline.size() + 1] or ends.x in [outline.size(), outline.size() + 1]:
			body.set_spring_stiffness_scale(i, 6)
	body.shape_matching = 0.2
	body.shape_damping_ratio = 0.5
	body.physics_material_override = PhysicsMaterial.new()
	body.physics_material_override.friction = 0.3
	body.texture = preload("res://textures/car.svg")
	body.uv = _texture_coordinates(outline)
	body.color = tint
	body.outline_width = 3
	body.outline_color = tint.darkened(0.55)
	body.antialiased = true
	body.collision_proxy_enabled = false
	body.contact_monitor = true
	if direction < 0: # mirrored as a whole, the texture too
		body.scale = Vector2(-1, 1)
	add_child(body)
	_first = outline + body.inner_points


func _add_wheel(place: Vector2) -> void:
	var wheel := SoftBody2D.new()
	wheel.polygon = SoftBody2D.make_circle_polygon(WHEEL_RADIUS, 18)
	wheel.position = place * Vector2(direction, 1)
	wheel.mass = 0.9
	wheel.stiffness = 420
	wheel.damping = 0.5
	wheel.pressure = 300
	wheel.physics_material_override = PhysicsMaterial.new() # of friction 1
	# Wheels meet roads, walls and bodies, but not each other.
	wheel.collision_layer = 2
	wheel.color = Color("30324a")
	wheel.smooth = true
	wheel.antialiased = true
	wheel.outline_width = 5
	wheel.outline_color = Color("1a1b2b")
	wheel.collision_proxy_enabled = false
	wheel.draw.connect(_draw_hub.bind(wheel))
	add_child(wheel)
	wheels.append(wheel)
	var joint := SoftBodyJoint2D.new()
	joint.position = wheel.position
	joint.rigid = false
	joint.stiffness = 1800
	joint.damping = 25
	joint.length = 0
	add_child(joint)
	joint.node_a = joint.get_path_to(body)
	joint.node_b = joint.get_path_to(wheel)


func _draw_hub(wheel: SoftBody2D) -> void:
	wheel.draw_circle(Vector2.ZERO, 12, Color("c9cbd8"))
	for i in 5:
		wheel.draw_line(Vector2.ZERO, Vector2.from_angle(TAU * i / 5) * 11, Color("777a90"), 3)
	wheel.draw_circle(Vector2.ZERO, 4, Color("3c3e55"))


func get_place() -> Vector2:
	return body.get_center_of_mass_position()


## From bumper to bumper, along its own axis [px].
func get_length() -> float:
	var least := INF
	var most := -INF
	for point in body.get_point_positions():
		var along := body.to_local(point).x
		least = minf(least, along)
		most = maxf(most, along)
	return most - least


func _physics_process(_delta: float) -> void:
	for wheel in wheels:
		var wish := throttle * direction * TOP_SPEED / WHEEL_RADIUS
		var effect := clampf((wish - wheel.get_angular_velocity()) / 12, -1, 1) if throttle != 0 \
				else clampf(-wheel.get_angular_velocity() / 60, -0.2, 0.2)
		wheel.apply_torque(effect * TORQUE)
	_age += 1
	if keeps_dents and _age % LOOK_INTERVAL == 0:
		_keep_dents()


func _keep_dents() -> void:
	var rest := body.polygon + body.inner_points
	var points := body.get_point_positions()
	var changed := false
	for i in rest.size():
		var off := body.to_local(points[i]) - rest[i]
		if off.length() > YIELD:
			var place := rest[i] + off.limit_length(off.length() - YIELD) * FLOW
			rest[i] = _first[i] + (place - _first[i]).clamp(-DEEPEST, DEEPEST)
			changed = true
	var outline := rest.slice(0, body.polygon.size())
	if not changed or not _is_simple(outline):
		return
	var middle := rest[outline.size() + MIDDLE]
	for i in range(outline.size(), rest.size()):
		if not Geometry2D.is_point_in_polygon(rest[i], outline):
			rest[i] = rest[i].lerp(middle, 0.3) # a point inside that the outline has passed goes inward
			if not Geometry2D.is_point_in_polygon(rest[i], outline):
				return
	var state := body.get_state()
	body.polygon = outline
	body.inner_points = rest.slice(outline.size())
	body.set_state(state)


## Whether no two edges meet, which a polygon must not.
static func _is_simple(polygon: PackedVector2Array) -> bool:
	var count := polygon.size()
	for i in count:
		if polygon[i].distance_squared_to(polygon[i - 1]) < 1:
			return false
		for j in range(i + 2, count):
			if (j + 1) % count != i and Geometry2D.segment_intersects_segment(
					polygon[i], polygon[i + 1], polygon[j], polygon[(j + 1) % count]) != null:
				return false
	return true


static func _divide(corners: Array[Vector2]) -> PackedVector2Array:
	var outline := PackedVector2Array()
	for i in corners.size():
		var from := corners[i]
		var to := corners[(i + 1) % corners.size()]
		var parts := ceili(from.distance_to(to) / SPACING)
		for k in parts:
			outline.append(from.lerp(to, float(k) / parts))
	return outline


## The texture's places of the first shape: they stay at its points, however these move.
static func _texture_coordinates(outline: PackedVector2Array) -> PackedVector2Array:
	var box := Rect2(outline[0], Vector2.ZERO)
	for point in outline:
		box = box.expand(point)
	var coordinates := PackedVector2Array()
	for point in outline:
		coordinates.append((point - box.position) / box.size * Vector2(440, 164))
	return coordinates
