# SPDX-License-Identifier: MIT
extends Node2D
## Makes soft bodies while the game runs, one lane after the other, and frees the one that was there.

const LANES := 6
const LANE_WIDTH := 200.0
const INTERVAL := 0.75 # s
const COLORS: Array[Color] = [
	Color("ff6b6b"), Color("ffb347"), Color("a8d672"), Color("4ecdc4"), Color("5aa9e6"), Color("b388eb"),
]
const SKIN := preload("res://common/skin.gd")

var _in_lane: Array[SoftBody2D] = []
var _made := 0
var _age := 0.0


func _ready() -> void:
	_in_lane.resize(LANES)
	_make_one()


func _physics_process(delta: float) -> void:
	_age += delta
	if _age >= INTERVAL:
		_age -= INTERVAL
		_make_one()
	(%Status as Label).text = "%d made, %d in the scene" % [_made, SoftBodySimulation2D.get_body_count()]


func _make_one() -> void:
	var lane := _made % LANES
	if _in_lane[lane] != null:
		_in_lane[lane].queue_free()
	var body := SoftBody2D.new()
	body.polygon = _make_polygon(_made % 4)
	body.elastic_model = SoftBody2D.ELASTIC_MODEL_NETWORK
	body.stiffness = [20.0, 60.0, 200.0][_made % 3]
	body.color = COLORS[_made * 5 % COLORS.size()]
	body.position = Vector2(640 + (lane - (LANES - 1) / 2.0) * LANE_WIDTH, 200)
	body.rotation = 0.35 * _made
	body.add_child(SKIN.new())
	add_child(body)
	_in_lane[lane] = body
	_made += 1


func _make_polygon(kind: int) -> PackedVector2Array:
	match kind:
		0:
			return SoftBody2D.make_circle_polygon(60, 28)
		1:
			return SoftBody2D.make_box_polygon(Vector2(110, 90), 15)
		2:
			return SoftBody2D.make_capsule_polygon(36, 150, 13)
	var star := PackedVector2Array()
	for i in 40:
		star.append(Vector2.from_angle(TAU * i / 40) * (52 + 18 * cos(TAU * i / 8)))
	return star
