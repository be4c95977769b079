# SPDX-License-Identifier: MIT
extends "res://pictures/before_and_after.gd"
## Two plates without friction press a default body to half of its height and let it go. There is no gravity.
##
## Dashed lines show how wide the elastic solid of the same material gets, by finite elements (`press_0.5` in
## bench/fem/references.json).

const RADIUS := 50.0
const CLOSING := 2.0 # s
const HOLDING := 2.0 # s
const OPENING := 0.5 # s
const PRESSED_TO := 0.5
## Over the width at rest.
const WIDTH_OF_SOLID := 1.437
const PLATE := Vector2(240, 30)

var _plates: Array[StaticBody2D] = []


func _build(side: int) -> void:
	for up: float in [-1.0, 1.0]:
		var plate := AnimatableBody2D.new()
		plate.sync_to_physics = false
		plate.position.y = up * (RADIUS + PLATE.y / 2)
		SOLID.add_box(plate, Rect2(-PLATE / 2, PLATE))
		for look: Array in [[0.0, Color("8b93d6")], [2.0, Color("3b4072")]]:
			var area := Polygon2D.new()
			var half := PLATE / 2 - Vector2.ONE * float(look[0])
			area.polygon = PackedVector2Array([-half, Vector2(half.x, -half.y), half, Vector2(-half.x, half.y)])
			area.color = look[1]
			plate.add_child(area)
		sides[side].add_child(plate)
		_plates.append(plate)
	var body := add_body(side, Vector2.ZERO, COLORS[side])
	body.gravity_scale = 0
	body.physics_material_override = PhysicsMaterial.new()
	body.physics_material_override.friction = 0


func _move(age: float) -> void:
	var pressed := clampf(age / CLOSING, 0, 1) - clampf((age - CLOSING - HOLDING) / OPENING, 0, 1)
	for plate in _plates:
		plate.position.y = signf(plate.position.y) * (RADIUS * lerpf(1, PRESSED_TO, pressed) + PLATE.y / 2)


func _describe(side: int) -> String:
	var body: SoftBody2D = bodies[side][0]
	var size := size_of(body)
	return "height %d %%\nwidth %d %%, area %d %%" % [percent(size.y), percent(size.x), percent(area_of(body))]


func _draw_overlay() -> void:
	var half := RADIUS * WIDTH_OF_SOLID
	var gap := absf(_plates[0].position.y) - PLATE.y / 2
	for side in sides:
		for x: float in [-half, half]:
			overlay.draw_dashed_line(side.position + Vector2(x, -gap), side.position + Vector2(x, gap), GHOST, 1.5, 5)
