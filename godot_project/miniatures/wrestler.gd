# SPDX-License-Identifier: MIT
extends Node2D
## A wrestler of six soft bodies, tied together by joints: torso, head, two arms, two legs.
##
## What keeps it upright are torques on torso, head and legs; it walks and jumps only while a leg stands on something.
## It grabs with a joint that is made while the game runs, and that breaks when pulled too hard.

const STRENGTH := 6500.0 # kg px/s²; with which it walks, for its whole mass
const SPEED := 260.0 # px/s
const JUMP := 430.0 # px/s
const HOLD_FORCE := 26000.0 # kg px/s²; where a grip breaks
const REACH := 46.0 # px; how near a hand must be to grab
const UPRIGHT := 130.0 # 1/s²
const UPRIGHT_DAMPING := 16.0 # 1/s

## Where it wants to walk, -1 to 1.
var walk := 0.0
## Whether it wants to jump, as soon as it stands.
var jumps := false
## Whether its hands want to hold on to what they reach.
var grabs := false
## Whether it shoves with both arms.
var shoves := false
## 1 looks to the right.
var facing := 1.0

var torso: SoftBody2D
var parts: Array[SoftBody2D] = []

var _head: SoftBody2D
var _arms: Array[SoftBody2D] = []
var _legs: Array[SoftBody2D] = []
var _grips: Array[SoftBodyJoint2D] = []
var _stride := 0.0
var _jump_age := 1.0
var _mass := 0.0


func _init(tint := Color.WHITE, direction := 1.0) -> void:
	facing = direction
	var leg := SoftBody2D.make_capsule_polygon(15, 76, 13)
	var arm := SoftBody2D.make_capsule_polygon(12, 76, 12)
	_legs.append(_add_part("BackLeg", leg, Vector2(12, 74), tint.darkened(0.25), 0.7))
	_arms.append(_add_part("BackArm", arm, Vector2(18, -6), tint.darkened(0.25), 0.4))
	torso = _add_part("Torso", SoftBody2D.make_capsule_polygon(34, 112, 16), Vector2.ZERO, tint, 2.0)
	_head = _add_part("Head", SoftBody2D.make_circle_polygon(31, 16), Vector2(0, -80), tint.lightened(0.15), 0.7)
	_legs.append(_add_part("FrontLeg", leg, Vector2(-12, 74), tint.darkened(0.12), 0.7))
	_arms.append(_add_part("FrontArm", arm, Vector2(-18, -6), tint.darkened(0.12), 0.4))
	for part in parts:
		_mass += part.mass
		for other in parts:
			if other != part:
				part.add_collision_exception_with(other)
	for part in _legs:
		part.contact_monitor = true
		part.physics_material_override = PhysicsMaterial.new()
	var eyes := Node2D.new()
	eyes.set_script(preload("res://demo/eyes.gd"))
	var attachment := SoftBodyAttachment2D.new()
	attachment.position = Vector2(9 * facing, -6)
	eyes.scale = Vector2(0.7, 0.7)
	attachment.add_child(eyes)
	_head.add_child(attachment)
	_tie(torso, _head, Vector2(0, -52))
	for part in _legs:
		_tie(torso, part, Vector2(part.position.x, 44))
	for part in _arms:
		_tie(torso, part, Vector2(part.position.x, -36))


func _add_part(part_name: String, outline: PackedVector2Array, place: Vector2, tint: Color,
		part_mass: float) -> SoftBody2D:
	var part := SoftBody2D.new()
	part.name = part_name
	part.polygon = outline
	part.position = place
	part.mass = part_mass
	part.elastic_model = SoftBody2D.ELASTIC_MODEL_NETWORK
	part.stiffness = 420 * part_mass
	part.damping = 0.35 * part_mass
	part.shape_matching = 0.6
	part.color = tint
	part.smooth = true
	part.antialiased = true
	part.outline_width = 3.5
	part.outline_color = tint.darkened(0.45)
	part.collision_proxy_enabled = false
	add_child(part)
	parts.append(part)
	return part


func _tie(a: SoftBody2D, b: SoftBody2D, place: Vector2) -> void:
	var joint := SoftBodyJoint2D.new()
	joint.position = place
	joint.length = 0
	add_child(joint)
	joint.node_a = joint.get_path_to(a)
	joint.node_b = joint.get_path_to(b)


func get_place() -> Vector2:
	return torso.get_center_of_mass_position()


func is_holding() -> bool:
	return _grips.any(func(grip: SoftBodyJoint2D) -> bool: return not grip.is_broken())


## Whether a leg stands on something.
func is_standing() -> bool:
	for leg in _legs:
		for i in leg.get_contact_count():
			if leg.get_contact_normal(i).y < -0.5:
				return true
	return false


func _physics_process(delta: float) -> void:
	_jump_age += delta
	var stands := is_standing()
	if absf(walk) > 0.1:
		facing = signf(walk)
	_stride += delta * 11 * absf(walk)
	_turn(torso, facing * 0.12 * absf(walk), 1.0)
	_turn(_head, 0, 0.5)
	for i in 2:
		_turn(_legs[i], 0.5 * absf(walk) * sin(_stride + PI * i), 4.0 if stands else 1.0)
		# A walking wrestler lifts the feet.
		var grip := 0.9 if absf(walk) < 0.1 else 0.25
		if not is_equal_approx(_legs[i].physics_material_override.friction, grip):
			_legs[i].physics_material_override.friction = grip
	_move_arms()
	if stands:
		# All parts alike, or the legs would stay behind.
		var push := clampf((walk * SPEED - torso.get_linear_velocity().x) * 10 * _mass, -STRENGTH, STRENGTH)
		for part in parts:
			part.apply_central_force(Vector2(push * part.mass / _mass, 0))
		if jumps and _jump_age > 0.5:
			_jump_age = 0
			for part in parts:
				part.apply_central_impulse(Vector2(0, -JUMP * part.mass))
	if grabs:
		_grab()
	else:
		_let_go()


## Turns a body towards an angle, as a spring and a damper do.
func _turn(body: SoftBody2D, angle: float, share: float) -> void:
	var off := wrapf(angle - body.global_rotation, -PI, PI)
	var effect := UPRIGHT * off - UPRIGHT_DAMPING * body.get_angular_velocity()
	body.apply_torque(share * effect * body.get_inertia() * (3.0 if body == torso else 1.0))


## A capsule that stands points up and down; raised forward it lies, and its hand is in front.
func _move_arms() -> void:
	for i in 2:
		var angle := 0.4 * sin(_stride + PI * i) * absf(walk)
		if shoves or grabs:
			angle = -facing * (1.45 + 0.2 * i)
		_turn(_arms[i], angle, 1.6)


## The free end of an arm.
func get_hand(arm: SoftBody2D) -> Vector2:
	return arm.global_transform * Vector2(0, 34)


func _grab() -> void:
	if not _grips.is_empty():
		return
	for arm in _arms:
		var hand := get_hand(arm)
		var nearest := REACH
		var held: SoftBody2D
		for node in get_parent().find_children("*", "SoftBody2D", true, false):
			var body := node as SoftBody2D
			if body in parts:
				continue
			var distance := body.get_point_positions()[body.get_nearest_point(hand)].distance_to(hand)
			if distance < nearest:
				nearest = distance
				held = body
		if held != null:
			_grips.append(_make_grip(arm, held, hand))


func _make_grip(arm: SoftBody2D, held: SoftBody2D, hand: Vector2) -> SoftBodyJoint2D:
	var grip := SoftBodyJoint2D.new()
	grip.rigid = false
	grip.stiffness = 900
	grip.damping = 6
	grip.length = 4
	grip.break_force = HOLD_FORCE
	grip.disable_collision = false
	add_child(grip)
	grip.global_position = hand
	grip.node_a = grip.get_path_to(arm)
	grip.node_b = grip.get_path_to(held)
	return grip


func _let_go() -> void:
	for grip in _grips:
		grip.queue_free()
	_grips.clear()
