# SPDX-License-Identifier: MIT
extends SoftBody2D
## A cell of the petri dish: a membrane under pressure, without springs inside, that swallows smaller ones.
##
## It grows by a larger `polygon`. A new polygon builds the body anew in its rest shape; putting the state back lets it
## go on as it was deformed, and the pressure blows it up to its new size.

const POINTS := 24
## Ticks between two changes of a polygon: each makes another shape.
const FEEDING_INTERVAL := 4
## What a swallowed cell loses at a time, as a share of what it had.
const BITE := 1.0 / 8
## A cell swallows those whose area times this is below its own.
const ADVANTAGE := 1.25
## How long two cells touch until the larger one lets the smaller one in [s].
const TOUCH_TIME := 0.25
const TOP_SPEED := 230.0 # px/s, of a cell of 34 px
const GRIP := 4.0 # 1/s; how eagerly the wish becomes motion

## Where the cell wants to go, of length 1 at most.
var wish := Vector2.ZERO
## How fast of what its size allows.
var vigour := 1.0
## The cell that is swallowing this one.
var swallowed_by: SoftBody2D

var _to_gain := 0.0 # px²
var _bite := 0.0 # px²
var _touching := {} # cell -> s
var _tick := 0


func _init(radius := 34.0, tint := Color.WHITE, substance: SoftBodyMaterial2D = null) -> void:
	polygon = make_circle_polygon(radius, POINTS)
	center_point = false
	elastic_model = ELASTIC_MODEL_NETWORK
	soft_body_material = substance
	gravity_scale = 0
	rotation = radius # no two look alike
	smooth = true
	antialiased = true
	outline_width = 4
	outline_color = tint.darkened(0.22)
	color = Color(tint, 0.7)
	collision_proxy_enabled = false
	add_to_group(&"cells")
	var nucleus := SoftBodyAttachment2D.new()
	nucleus.position = Vector2(radius * 0.2, 0)
	nucleus.draw.connect(_draw_nucleus.bind(nucleus, tint.darkened(0.35)))
	add_child(nucleus)


## Of a disk of its rest area [px].
func get_radius() -> float:
	return sqrt(get_rest_area() / PI)


func can_swallow(other: SoftBody2D) -> bool:
	return get_rest_area() > ADVANTAGE * other.get_rest_area()


## Adds so much area, over the next ticks.
func feed(gain: float) -> void:
	_to_gain += gain


func get_top_speed() -> float:
	return TOP_SPEED * vigour * pow(34.0 / get_radius(), 0.4)


func _physics_process(delta: float) -> void:
	_tick += 1
	if swallowed_by != null:
		_sink()
		return
	apply_central_force(get_total_mass() * GRIP * (wish * get_top_speed() - get_linear_velocity()))
	z_index = int(get_radius())
	_look_for_prey(delta)
	if _to_gain > 0 and _tick % FEEDING_INTERVAL == 0:
		var gain := minf(_to_gain, maxf(_to_gain / 2, 60.0))
		_to_gain -= gain
		_resize(get_rest_area() + gain)


func _look_for_prey(delta: float) -> void:
	for node in get_tree().get_nodes_in_group(&"cells"):
		var other := node as SoftBody2D
		if other == self or other.get_parent() != get_parent() or other.get(&"swallowed_by") != null \
				or not can_swallow(other):
			continue
		var between := get_center_of_mass_position().distance_to(other.get_center_of_mass_position())
		var near := between < get_radius() + (other.call(&"get_radius") as float) + 5
		var time: float = _touching.get(other, 0.0) + delta if near else 0.0
		_touching[other] = time
		if time > TOUCH_TIME:
			_touching.erase(other)
			other.call(&"be_swallowed", self)


## From now on nothing holds it back from sinking into `by`.
func be_swallowed(by: SoftBody2D) -> void:
	swallowed_by = by
	collision_layer = 0
	collision_mask = 0
	remove_from_group(&"cells")
	_bite = get_rest_area() * BITE


## Towards the middle of the larger one, which gains what this one loses.
func _sink() -> void:
	if not is_instance_valid(swallowed_by) or not swallowed_by.is_inside_tree():
		queue_free()
		return
	var host := swallowed_by
	var way := host.get_center_of_mass_position() - get_center_of_mass_position()
	apply_central_force(get_total_mass() * (40 * way - 10 * (get_linear_velocity() - host.get_linear_velocity())))
	z_index = host.z_index - 1
	if _tick % FEEDING_INTERVAL != 0 or way.length() > maxf(host.call(&"get_radius") * 0.9, get_radius()):
		return
	var left := get_rest_area() - _bite
	host.call(&"feed", _bite if left > _bite / 2 else get_rest_area())
	if left > _bite / 2:
		_resize(left)
	else:
		queue_free()


func _resize(area: float) -> void:
	var state := get_state()
	polygon = Transform2D.IDENTITY.scaled(Vector2.ONE * sqrt(area / get_rest_area())) * polygon
	set_state(state)


func _draw_nucleus(on: Node2D, tint: Color) -> void:
	on.draw_circle(Vector2.ZERO, 0.26 * sqrt(get_rest_area() / PI), tint)
	on.draw_circle(Vector2(-2, -2), 0.1 * sqrt(get_rest_area() / PI), tint.lightened(0.4))
