# SPDX-License-Identifier: MIT
extends RefCounted
## Makes fruit to be cut, and stones. Pieces of a cut are plain bodies that keep the groups.

## Group of all that is thrown, and of its pieces.
const THROWN := &"thrown"
## Group of what has not been cut.
const WHOLE := &"whole"
const STONES := &"stones"
const STONE := 5
const KINDS: Array[Dictionary] = [
	{"size": Vector2(74, 58), "flesh": Color("ff5d6c"), "rind": Color("2f9e5b"), "rind_width": 10.0}, # melon
	{"size": Vector2(46, 46), "flesh": Color("ffb347"), "rind": Color("e8782a"), "rind_width": 6.0}, # orange
	{"size": Vector2(40, 48), "flesh": Color("d8f08c"), "rind": Color("7fb83a"), "rind_width": 4.0}, # pear
	{"size": Vector2(34, 34), "flesh": Color("9a5fc9"), "rind": Color("5e3390"), "rind_width": 4.0}, # plum
	{"size": Vector2(78, 26), "flesh": Color("fff3c4"), "rind": Color("ffd93d"), "rind_width": 6.0}, # banana
	{"size": Vector2(44, 40), "flesh": Color("6c7080"), "rind": Color("44475a"), "rind_width": 5.0}, # stone
]
const POINTS := 28


static func make(kind: int) -> SoftBody2D:
	var values := KINDS[kind]
	var body := SoftBody2D.new()
	var outline := PackedVector2Array()
	for i in POINTS:
		var place := Vector2.from_angle(TAU * i / POINTS)
		outline.append(place * (values["size"] as Vector2) * (0.9 if kind == STONE and i % 3 == 0 else 1.0))
	body.polygon = outline
	body.youngs_modulus = 20000.0 if kind == STONE else 700.0
	body.color = values["flesh"]
	body.outline_color = values["rind"]
	body.outline_width = values["rind_width"]
	body.cut_width = 3 # no rind where it was cut
	body.cut_color = (values["flesh"] as Color).lightened(0.45)
	body.antialiased = true
	body.smallest_piece = 0.08
	body.collision_proxy_enabled = false
	body.add_to_group(THROWN)
	body.add_to_group(WHOLE)
	if kind == STONE:
		body.add_to_group(STONES)
	return body
