# SPDX-License-Identifier: MIT
extends Node2D
## Pulls strips apart, over and over: one that never tears, one that tears where it is stretched most, and one with a painted weak seam.

const LENGTH := 300.0 # px
const HEIGHT := 70.0
const COLUMNS := 15
const PULL := 70.0 # px/s, of each end
const FARTHEST := 110.0 # px
const ROUND := 6.5 # s
## Strain at which a strip tears.
const TEAR := 0.5
const ROWS: Array[Dictionary] = [
	{"y": 190.0, "tear": 0.0, "seam": false, "color": Color("5aa9e6")},
	{"y": 370.0, "tear": TEAR, "seam": false, "color": Color("ffb347")},
	{"y": 550.0, "tear": TEAR, "seam": true, "color": Color("ff6b6b")},
]

## The strips of this round, from the upper to the lower.
var strips: Array[SoftBody2D] = []

var _age := 0.0
var _world: Node2D
var _ends: Array[Node2D] = []


func _ready() -> void:
	_begin()


func _begin() -> void:
	if _world != null:
		_world.queue_free()
	_world = Node2D.new()
	add_child(_world)
	strips.clear()
	_ends.clear()
	_age = 0
	for row in ROWS:
		_add_strip(row)


func _add_strip(row: Dictionary) -> void:
	var strip := SoftBody2D.new()
	strip.position = Vector2(640, row["y"] as float)
	strip.polygon = _outline()
	strip.youngs_modulus = 400
	strip.gravity_scale = 0.2
	strip.color = row["color"]
	strip.outline_width = 3
	strip.outline_color = Color(0.15, 0.15, 0.2)
	strip.tear_stretch = row["tear"]
	if row["seam"]:
		_paint_seam(strip)
	_world.add_child(strip)
	strips.append(strip)
	var targets := {}
	for side: float in [-1.0, 1.0]:
		var end := Node2D.new()
		end.position = strip.position + Vector2(side * LENGTH / 2, 0)
		end.set_meta(&"side", side)
		_world.add_child(end)
		_ends.append(end)
		for i in strip.polygon.size():
			if is_equal_approx(strip.polygon[i].x, side * LENGTH / 2):
				targets[i] = end
	var paths: Array[NodePath] = []
	for i: int in targets:
		paths.append(strip.get_path_to(targets[i]))
	strip.pinned_points = PackedInt32Array(targets.keys())
	strip.pin_targets = paths


static func _outline() -> PackedVector2Array:
	var outline := PackedVector2Array()
	for i in COLUMNS:
		outline.append(Vector2((float(i) / (COLUMNS - 1) - 0.5) * LENGTH, -HEIGHT / 2))
	outline.append(Vector2(LENGTH / 2, 0))
	for i in COLUMNS:
		outline.append(Vector2((0.5 - float(i) / (COLUMNS - 1)) * LENGTH, HEIGHT / 2))
	outline.append(Vector2(-LENGTH / 2, 0))
	return outline


## Springs near a line that lies aslant bear a quarter of what the others do.
static func _paint_seam(strip: SoftBody2D) -> void:
	var scales := PackedFloat32Array()
	for i in strip.get_spring_count():
		var ends := strip.get_spring_points(i)
		var middle := Vector2.ZERO
		for point in [ends.x, ends.y]:
			middle += (strip.polygon[point] if point < strip.polygon.size() else Vector2.ZERO) / 2
		scales.append(0.25 if absf(middle.x - 70 - middle.y * 0.6) < 22 else 1.0)
	strip.spring_stiffness_scales = scales


func _physics_process(delta: float) -> void:
	_age += delta
	if _age > ROUND:
		_begin()
		return
	for end in _ends:
		var side: float = end.get_meta(&"side")
		end.position.x = 640 + side * (LENGTH / 2 + minf(FARTHEST, PULL * maxf(0, _age - 0.5)))
