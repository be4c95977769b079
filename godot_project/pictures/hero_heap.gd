# SPDX-License-Identifier: MIT
extends "res://pictures/hero.gd"
## Forty-two bodies of five materials fall into a box, blocks and rings among them.

const COUNT := 42
const HALF := 385.0
const WALL := 30.0
const KINDS: Array[String] = ["jelly", "water_balloon", "slime", "marshmallow", "jelly", "beach_ball"]
const JELLY_COLORS: Array[Color] = [Color("ff6b8b"), Color("ffb347"), Color("b388eb")]


func _build() -> void:
	add_floor()
	for x: float in [-HALF - WALL, HALF]:
		add_solid(Rect2(x, -3000, WALL, 3100))
	var random := RandomNumberGenerator.new()
	random.seed = 4
	for i in COUNT:
		var which := i * 5 % 7 % KINDS.size()
		var kind := KINDS[which]
		var radius := random.randf_range(38, 58)
		var place := Vector2(-HALF + 85 + 123 * (i % 6) + random.randf_range(-6, 6) + 40 * (floori(i / 6.0) % 2) - 20, -62 - 122.0 * floori(i / 6.0))
		var outline := SoftBody2D.make_circle_polygon(radius, 20)
		if which == 4:
			outline = make_block(Vector2(1.8, 1.6) * radius)
		var color := JELLY_COLORS[i % 3] if kind == "jelly" else Color.TRANSPARENT
		var body := add_body(kind, outline, place, color)
		body.rotation = random.randf_range(0, TAU)
		if which == 5:
			body.holes = [SoftBody2D.make_circle_polygon(radius * 0.45, 12)]
