# SPDX-License-Identifier: MIT
extends "res://common/toy.gd"
## Fruit is thrown up; a blade that the mouse or a stick draws cuts it. Pieces are cut again. Stones are left alone.

enum State { PLAYING, WON, LOST }

const Steering := preload("res://common/steering.gd")
const Fruit := preload("res://miniatures/fruit.gd")

const SCREEN := Rect2(0, 0, 1280, 720)
const GOAL := 40 # points: one for each new piece
const HEARTS := 3
## A blade is as long as its way in this time [s].
const BLADE_TIME := 0.2
const BLADE_STEP := 8.0 # px, least distance of its points
const STICK_SPEED := 1500.0 # px/s
const PUSH := 90.0 # px/s, with which pieces part
const FIRST_PAUSE := 1.1 # s between throws, at the start
const LAST_PAUSE := 0.55
const STONE_SHARE := 0.12
const MOST_BODIES := 60
const DROP_LIFE := 0.6 # s
const MOST_DROPS := 120

var state := State.PLAYING
var score := 0
var hearts := HEARTS
## Where the stick's blade is.
var hand := SCREEN.get_center()

var _random := RandomNumberGenerator.new()
var _pause := 0.0
var _clock := 0.0
var _blade := PackedVector2Array()
var _blade_times := PackedFloat64Array()
var _stick_is_seen := false
var _mouse_is_down := false
var _drops: Array[Dictionary] = []

@onready var _overlay: Node2D = %Overlay
@onready var _status: Label = %Status
@onready var _message: Label = %Message


func _ready() -> void:
	_random.seed = randi()
	super()
	_overlay.draw.connect(_draw_overlay)


func _build() -> void:
	state = State.PLAYING
	score = 0
	hearts = HEARTS
	_pause = 0.4
	_drops.clear()
	_let_go()


func _unhandled_input(event: InputEvent) -> void:
	super(event)
	var mouse := make_input_local(event) as InputEventMouse
	if mouse == null:
		return
	var button := mouse as InputEventMouseButton
	if button != null and button.button_index == MOUSE_BUTTON_LEFT:
		_mouse_is_down = button.pressed
		_let_go()
	_stick_is_seen = false
	if _mouse_is_down:
		draw_blade_to(to_global(mouse.position))


## Leads the blade there.
func draw_blade_to(point: Vector2) -> void:
	if _blade.is_empty() or _blade[-1].distance_to(point) >= BLADE_STEP:
		_blade.append(point)
		_blade_times.append(_clock)


func _let_go() -> void:
	_blade.clear()
	_blade_times.clear()


## Fruit, stones and pieces in the air.
func get_thrown() -> Array[SoftBody2D]:
	var found: Array[SoftBody2D] = []
	for node in world.get_children():
		if node.is_in_group(Fruit.THROWN) and not node.is_queued_for_deletion():
			found.append(node)
	return found


func _physics_process(delta: float) -> void:
	_clock += delta
	_move_hand(delta)
	while not _blade_times.is_empty() and _clock - _blade_times[0] > BLADE_TIME:
		_blade_times.remove_at(0)
		_blade.remove_at(0)
	_pause -= delta
	if _pause <= 0:
		_pause = lerpf(FIRST_PAUSE, LAST_PAUSE, minf(1, float(score) / GOAL))
		throw_fruit(_random.randf() < STONE_SHARE)
	_cut()
	_count_missed()
	for drop in _drops:
		drop["age"] += delta
		drop["velocity"] += Vector2(0, 980) * delta
		drop["place"] += drop["velocity"] * delta
	_drops = _drops.filter(func(drop: Dictionary) -> bool: return drop["age"] < DROP_LIFE)
	_tell()


func _move_hand(delta: float) -> void:
	var wish := Steering.direction()
	_stick_is_seen = _stick_is_seen or wish != Vector2.ZERO
	hand = (hand + wish * STICK_SPEED * delta).clamp(SCREEN.position, SCREEN.end)
	if _stick_is_seen and Steering.is_acting():
		draw_blade_to(hand)
	elif _stick_is_seen:
		_let_go()


## Throws a fruit, or a stone, up from below the screen.
func throw_fruit(is_stone := false) -> SoftBody2D:
	var fruit := Fruit.make(Fruit.STONE if is_stone else _random.randi_range(0, Fruit.STONE - 1))
	fruit.position = Vector2(_random.randf_range(200, 1080), SCREEN.end.y + 90)
	var top := _random.randf_range(120, 320)
	var gravity: float = ProjectSettings.get_setting("physics/2d/default_gravity")
	var up := sqrt(2 * gravity * (fruit.position.y - top))
	var way := SCREEN.get_center().x + _random.randf_range(-260, 260) - fruit.position.x
	fruit.linear_velocity = Vector2(way / (2 * up / gravity), -up)
	fruit.angular_velocity = _random.randf_range(-4, 4)
	world.add_child(fruit)
	return fruit


func _cut() -> void:
	if _blade.size() < 2:
		return
	for fruit in get_thrown():
		if fruit.get_cut_problem(_blade) != "":
			continue # too little would come off
		var middle := fruit.get_center_of_mass_position()
		var pieces := fruit.cut_polyline(_blade)
		if pieces.is_empty():
			continue # the blade does not lead through it
		var way := _blade[-1] - _blade[0]
		var was_whole := fruit.is_in_group(Fruit.WHOLE)
		for piece in pieces:
			var aside := (piece.get_center_of_mass_position() - middle).normalized()
			piece.apply_central_impulse((aside * PUSH + way.limit_length(200) * 0.25) * piece.mass)
			piece.remove_from_group(Fruit.WHOLE)
		_splash(middle, fruit.color, way)
		if state != State.PLAYING:
			continue # for fun
		if not fruit.is_in_group(Fruit.STONES):
			score += pieces.size() - 1 # the fruit itself is one of them
		elif was_whole:
			_lose_heart()
	if score >= GOAL and state == State.PLAYING:
		state = State.WON
	var all := get_thrown()
	for i in all.size() - MOST_BODIES:
		all[i].queue_free()


func _count_missed() -> void:
	for fruit in get_thrown():
		if fruit.get_center_of_mass_position().y > SCREEN.end.y + 140:
			if fruit.is_in_group(Fruit.WHOLE) and not fruit.is_in_group(Fruit.STONES) and state == State.PLAYING:
				_lose_heart()
			fruit.queue_free()


func _lose_heart() -> void:
	hearts -= 1
	if hearts <= 0 and state == State.PLAYING:
		state = State.LOST


func _splash(place: Vector2, tint: Color, way: Vector2) -> void:
	for i in mini(10, MOST_DROPS - _drops.size()):
		var velocity := way.normalized().rotated(randf_range(-1, 1)) * randf_range(80, 420)
		_drops.append({"place": place, "velocity": velocity, "tint": tint, "age": 0.0})


func _tell() -> void:
	_status.text = "%d of %d   ·   %s" % [mini(score, GOAL), GOAL, "♥".repeat(maxi(0, hearts))]
	match state:
		State.WON:
			_message.text = "Fruit salad! R cuts another one."
		State.LOST:
			_message.text = "The fruit got away. R tries again."
		_:
			_message.text = ""


func _process(_delta: float) -> void:
	_overlay.queue_redraw()


func _draw_overlay() -> void:
	for drop in _drops:
		var fade: float = 1 - drop["age"] / DROP_LIFE
		_overlay.draw_circle(drop["place"], 2 + 4 * fade, Color(drop["tint"], fade))
	if _stick_is_seen:
		_overlay.draw_arc(hand, 14, 0, TAU, 24, Color(1, 1, 1, 0.8), 3, true)
	for i in range(1, _blade.size()): # thin at its end
		var share := float(i) / _blade.size()
		_overlay.draw_line(_blade[i - 1], _blade[i], Color(1, 1, 1, share), 1 + 7 * share, true)
