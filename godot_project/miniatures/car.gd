# SPDX-License-Identifier: MIT
extends Node2D
## A car of three soft bodies: a body of metal that dents and tears, and two wheels that hang on it by springs.
##
## What strains the body further than [constant YIELD] stays, by [member SoftBody2D.yield_strain]; what stretches it further than
## [constant TEAR] tears, by [member SoftBody2D.tear_stretch].

## Strain up to which a car springs back [1]: of springs of mean stiffness. The axles are six times as stiff as the rest, which has half of it.
const YIELD := 0.2
const FLOW_RATE := 40.0 # 1/s
const MOST_DENT := 0.7
## Strain at which sheet tears [1].
const TEAR := 0.7
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

## -1 backwards to 1 forwards.
var throttle := 0.0
## Whether the body is of metal; if not, it is elastic.
var is_metal := true:
	set(value):
		is_metal = value
		body.yield_strain = YIELD if is_metal else 0.0
		body.tear_stretch = TEAR if is_metal else 0.0
var body := SoftBody2D.new()
var wheels: Array[SoftBody2D] = []
## 1 if its front is to the right.
var direction := 1.0


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
	body.yield_strain = YIELD
	body.flow_rate = FLOW_RATE
	body.max_dent = MOST_DENT
	body.tear_stretch = TEAR
	body.mass = 9
	body.elastic_model = SoftBody2D.ELASTIC_MODEL_NETWORK
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


func _add_wheel(place: Vector2) -> void:
	var wheel := SoftBody2D.new()
	wheel.polygon = SoftBody2D.make_circle_polygon(WHEEL_RADIUS, 18)
	wheel.position = place * Vector2(direction, 1)
	wheel.mass = 0.9
	wheel.elastic_model = SoftBody2D.ELASTIC_MODEL_NETWORK
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
