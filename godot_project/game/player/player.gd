# SPDX-License-Identifier: MIT
extends SoftBody2D
## The player: a balloon of jelly that rolls, jumps, goes flat and blows itself up.
##
## Its polygon is drawn small, so that it is stretched whenever there is air in it: a skin without wrinkles at every size.
## What it can do is what the node can do; each part says which of its features that is.

signal jumped
signal landed(strength: float)
## Pressed so hard that it would burst: by a platform against the ground, say.
signal crushed
signal popped
signal size_changed(size: Size)

enum Size { FLAT, ROUND, BIG }

## The area that [member inflation] aims at for each [enum Size], as a multiple of the rest area.
const INFLATION: Array[float] = [0.95, 2.2, 4.4]
## How fast air goes in and out [1/s].
const BLOW_RATE: Array[float] = [9.0, 9.0, 12.0]
## Grip for each size: flat it is slippery, big it sticks between walls.
const GRIP: Array[float] = [0.06, 0.95, 1.0]
## Air drag for each size [1/s]; a big jelly hangs in the air.
const DRAG: Array[float] = [0.1, 0.1, 2.5]
## Share of the gravity that each size feels; what is in between goes by the area.
const WEIGHT: Array[float] = [1.5, 1.3, 0.36]
## Highest speed over the ground for each size [px/s].
const SPEED: Array[float] = [300.0, 360.0, 350.0]

const GROUND_PULL := 900.0 # px/s², beside what rolling does
const AIR_PULL := 1000.0
const SPIN_RATE := 14.0 # how eagerly it takes up the spin of its speed [1/s]
const JUMP_SPEED := 640.0 # px/s
const JUMP_STRETCH := 0.22 # how much more of the jump the top of the body gets, and the bottom less
const WALL_SPEED := 330.0 # px/s away from a wall that it jumps off
const JUMP_CUT := 0.45 # what is left of the rise when the button is let go
const COYOTE_TIME := 0.1 # s after leaving the ground in which it can jump yet
const BUFFER_TIME := 0.13 # s before touching the ground in which a jump is remembered
const SLIP_TIME := 0.16 # s after a jump in which walls do not hold it
const SLIPPERY := 0.04
const GROUND_NORMAL := 0.45 # how much a contact pushes upward to count as ground
const CRUSHED := 0.45 # share of the area that the air in it would have, below which it bursts
const CRUSH_TIME := 0.15 # s
const SQUISH_TICKS := 3 # a soft body hits hardest a moment after it has begun to touch
const SQUISH_IMPULSE := 50.0 # kg·px/s in one tick from which touching is heard; its weight makes 21

## What drives it: the actions of the input map. Off while a menu, a fade or the end has the stage.
var controlled := true
## The mouse asks for this direction, from -1 to 1; added to that of the keys.
var pointer_direction := 0.0
var size := Size.ROUND

var _wheel_size := Size.ROUND
var _ground_age := INF
var _wall_age := INF
var _wall_side := 0.0
var _jump_age := INF
var _rising := false
var _slip := 0.0 # s of little grip left
var _hard := 0.0
var _squish := 0.0
var _squish_ticks := 0
var _crushed_for := 0.0
var _round_area := 1.0


func _ready() -> void:
	_round_area = get_rest_area() * INFLATION[Size.ROUND]


func _physics_process(delta: float) -> void:
	_feel(delta)
	var direction := 0.0
	var wanted := Size.ROUND
	_jump_age += delta
	if controlled:
		direction = clampf(Input.get_axis(&"game_left", &"game_right") + pointer_direction, -1, 1)
		wanted = _wanted_size()
		if Input.is_action_just_pressed(&"game_jump"):
			_jump_age = 0
	if wanted != size:
		size = wanted
		size_changed.emit(size)
	_breathe(delta)
	_drive(direction)
	_jump()


## Steps of the mouse wheel choose a size that stays; keys hold one for as long as they are held.
func turn_wheel(steps: int) -> void:
	_wheel_size = clampi(_wheel_size + steps, Size.FLAT, Size.BIG) as Size


## Puts it somewhere, round and at rest: [method teleport] draws nothing in between, [method reset] takes the motion.
func place_at(place: Vector2) -> void:
	_wheel_size = Size.ROUND
	size = Size.ROUND
	teleport(Transform2D(0, place))
	reset()
	inflation = INFLATION[Size.ROUND]
	_ground_age = INF
	_wall_age = INF
	_jump_age = INF
	_rising = false
	reset_physics_interpolation()


func pop() -> void:
	popped.emit()


func is_on_ground() -> bool:
	return _ground_age == 0


## Whether there is, or has been a moment ago, something to jump off.
func can_jump() -> bool:
	return _ground_age < COYOTE_TIME or _wall_age < COYOTE_TIME


## How hard it touches, and what: [member contact_monitor] lists every contact of the last step with normal and impulse.
func _feel(delta: float) -> void:
	_ground_age += delta
	_wall_age += delta
	var impulse := 0.0
	var side := 0.0
	for i in get_contact_count():
		var normal := get_contact_normal(i)
		impulse += get_contact_impulse(i)
		if normal.y < -GROUND_NORMAL:
			_ground_age = 0
		elif absf(normal.x) > 0.8:
			side += normal.x
			_wall_age = 0
	if _wall_age == 0:
		_wall_side = signf(side) if absf(side) > 0.5 else 0.0
	if impulse > SQUISH_IMPULSE and _hard <= SQUISH_IMPULSE:
		_squish_ticks = SQUISH_TICKS
		_squish = 0
	if _squish_ticks > 0:
		_squish = maxf(_squish, impulse)
		_squish_ticks -= 1
		if _squish_ticks == 0:
			landed.emit(_squish)
	_hard = maxf(impulse, _hard - 500 * delta)


func _wanted_size() -> Size:
	if Input.is_action_pressed(&"game_deflate"):
		return Size.FLAT
	if Input.is_action_pressed(&"game_inflate"):
		return Size.BIG
	return _wheel_size


## Air in and out: [member pressure] drives the area towards [member inflation]. Weight goes by the area that it really
## has, so that a big jelly in a narrow shaft is no lighter than it looks.
func _breathe(delta: float) -> void:
	inflation = move_toward(inflation, INFLATION[size], BLOW_RATE[size] * delta)
	_slip -= delta
	var grip := GRIP[size] if _slip <= 0 else SLIPPERY
	if not is_equal_approx(physics_material_override.friction, grip):
		physics_material_override.friction = grip
	linear_damp = DRAG[size]
	var filled := get_area() / _round_area
	_crushed_for = _crushed_for + delta if filled < CRUSHED * inflation / INFLATION[Size.ROUND] else 0.0
	if _crushed_for > CRUSH_TIME:
		_crushed_for = 0
		crushed.emit()
	gravity_scale = lerpf(WEIGHT[1], WEIGHT[2], clampf(filled - 1, 0, 1)) if filled > 1 \
			else lerpf(WEIGHT[0], WEIGHT[1], clampf(2 * filled - 1, 0, 1))


## Rolling is a torque that friction turns into motion; [method apply_central_force] helps, and steers in the air.
func _drive(direction: float) -> void:
	var radius := sqrt(get_area() / PI)
	var grounded := _ground_age < COYOTE_TIME
	if size != Size.FLAT and grounded:
		var spin := direction * SPEED[size] / radius - angular_velocity
		apply_torque(spin * SPIN_RATE * inertia)
	if direction == 0:
		if grounded and size != Size.FLAT:
			apply_central_force(Vector2(-linear_velocity.x * 3 * mass, 0))
		return
	var missing := direction * SPEED[size] - linear_velocity.x
	if missing * direction > 0: # what is faster already keeps its speed
		var pull := GROUND_PULL if grounded else AIR_PULL
		apply_central_force(Vector2(clampf(missing * 10, -pull, pull) * mass, 0))


## A jump is an impulse for each point, the upper ones a little more: it stretches as it takes off.
func _jump() -> void:
	if _rising and not Input.is_action_pressed(&"game_jump") and linear_velocity.y < -80:
		apply_central_impulse(Vector2(0, -linear_velocity.y * (1 - JUMP_CUT) * mass))
		_rising = false
	elif linear_velocity.y >= 0:
		_rising = false
	if _jump_age > BUFFER_TIME or not can_jump():
		return
	var change := Vector2(0, -JUMP_SPEED - maxf(linear_velocity.y, 0) + 0.35 * maxf(-linear_velocity.y, 0))
	if _ground_age >= COYOTE_TIME:
		change.x = _wall_side * WALL_SPEED - linear_velocity.x * 0.5
	var radius := sqrt(get_area() / PI)
	var points := get_point_positions()
	var center := get_center_of_mass_position()
	for i in points.size():
		var share := 1 - JUMP_STRETCH * (points[i].y - center.y) / radius
		apply_point_impulse(i, change * share * mass / points.size())
	_jump_age = INF
	_ground_age = INF
	_wall_age = INF
	_slip = SLIP_TIME
	_rising = true
	jumped.emit()
