# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## Default ropes of every kind thrown into a bin, ten at a time.


const ROPES := 10
const BIN := 300.0 # px between its walls


func _add_bin() -> void:
	var bin := StaticBody2D.new()
	for wall: Array in [[Vector2(0, 300), Vector2.UP], [Vector2(-BIN / 2, 0), Vector2.RIGHT], [Vector2(BIN / 2, 0), Vector2.LEFT]]:
		var collision := CollisionShape2D.new()
		var boundary := WorldBoundaryShape2D.new()
		boundary.normal = wall[1]
		collision.shape = boundary
		collision.position = wall[0]
		bin.add_child(collision)
	stage.add_child(bin)


# The longest rope of a heap, over its length at rest, while it falls and settles.
func _longest_of_heap(kind: SoftRope2D.Kind, rng: RandomNumberGenerator) -> float:
	_add_bin()
	var ropes: Array[SoftRope2D] = []
	for i in ROPES:
		var rope := SoftRope2D.new()
		rope.kind = kind
		rope.position = Vector2(rng.randf_range(-20, 20), 150 - 60 * i)
		rope.rotation = PI / 2 + rng.randf_range(-0.2, 0.2) # level
		rope.position.x += 100 * cos(rope.rotation - PI / 2)
		stage.add_child(rope)
		rope.linear_velocity = Vector2(rng.randf_range(-150, 150), rng.randf_range(0, 300))
		ropes.append(rope)
	var longest := 1.0
	for i in 180:
		await ticks(1)
		for rope in ropes:
			longest = maxf(longest, rope.get_length() / rope.get_rest_length())
	for child in stage.get_children():
		child.free()
	return longest


func _check_heaps(kind: SoftRope2D.Kind, heaps: int, most: float) -> void:
	var rng := RandomNumberGenerator.new()
	rng.seed = 25 + kind
	var longest := 1.0
	for heap in heaps:
		longest = maxf(longest, await _longest_of_heap(kind, rng))
	check_below(longest, most, "length over that at rest")


func test_ten_ropes_thrown_into_a_bin_keep_their_length() -> void:
	await _check_heaps(SoftRope2D.KIND_ROPE, 1, 1.1)


func test_ten_straps_thrown_into_a_bin_keep_their_length() -> void:
	await _check_heaps(SoftRope2D.KIND_STRAP, 3, 1.1)


func test_ten_tentacles_thrown_into_a_bin_keep_their_length() -> void:
	await _check_heaps(SoftRope2D.KIND_TENTACLE, 1, 1.1)


func test_ten_rubber_bands_thrown_into_a_bin_stretch_no_more_than_when_they_hang() -> void:
	await _check_heaps(SoftRope2D.KIND_RUBBER_BAND, 1, 1.5)
