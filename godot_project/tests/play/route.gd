# SPDX-License-Identifier: MIT
extends RefCounted
## How the scripted player gets through the levels: what it wants, from where it is.
##
## It knows places, not times: popped, it tries again from the lantern, like anybody else.

const Level := preload("res://game/levels/level.gd")
const Player := preload("res://game/player/player.gd")
const Platform := preload("res://game/world/platform.gd")

const FLAT := -1
const ROUND := 0
const BIG := 1

## What it wants now: -1, 0 or 1; a jump as soon as there is something to jump off; a size.
var direction := 1
var wants_jump := false
var size := ROUND

var _player: Player
var _level: Level
var _ticks := 0


func think(player: Player, level: Level, index: int) -> void:
	_player = player
	_level = level
	_ticks += 1
	direction = 1
	wants_jump = false
	size = ROUND
	var place := player.get_center_of_mass_position()
	match index:
		0: _cross_meadow(place)
		1: _cross_burrow(place)
		2: _climb(place)


func _cross_meadow(place: Vector2) -> void:
	if place.x > 920 and place.x < 1000: # the pit
		wants_jump = true
	elif place.x > 1290 and place.x < 1500: # two steps
		wants_jump = true
	elif place.x > 1590 and place.x < 1660: # onto the cushion
		wants_jump = true
	elif place.x > 1740 and place.x < 1925 and place.y > 330:
		direction = signi(roundi((1835 - place.x) / 25))
	elif place.x > 2230 and place.x < 2830:
		_ride(place, _platform(0), 2880, 2290)
	elif place.x > 2880 and place.x < 3250: # over the boulders, somehow
		wants_jump = _ticks % 20 == 0
	elif place.x > 3250 and place.x < 3790:
		size = FLAT


func _cross_burrow(place: Vector2) -> void:
	if place.x > 540 and place.x < 980:
		size = FLAT
	elif place.x > 1080 and place.x < 1200:
		wants_jump = true
	elif place.x > 1780 and place.x < 1860:
		wants_jump = true
	elif place.x > 2280 and place.x < 2480 and place.y < 1035:
		direction = signi(roundi((2382 - place.x) / 12))
		size = FLAT if place.y > 700 else ROUND
	elif place.x > 2280 and place.x < 2820 and place.y >= 1035:
		size = FLAT
	elif place.x > 2830 and place.x < 3190 or place.x < 3250 and place.y > 1060:
		wants_jump = true
	elif place.x >= 3190 and place.x < 3275:
		var low := _platform(0).position.y > 1060
		direction = 1 if low else signi(roundi((3225 - place.x) / 12))
		wants_jump = low
	elif place.x >= 3275 and place.x < 3440:
		_lift(place, _platform(0), 640)


func _climb(place: Vector2) -> void:
	if place.x < 470:
		wants_jump = place.x > 380
	elif place.x < 1310 and place.y > 60:
		wants_jump = place.x > 640 and place.x < 700
		size = BIG if place.x > 700 and _player.linear_velocity.y > -150 else ROUND
	elif place.x < 1720 and place.x > 1310 and place.y > -110:
		direction = signi(roundi((1600 - place.x) / 40))
		size = BIG if place.x > 1500 else ROUND
	elif place.x < 1760 and place.y <= -110:
		size = BIG
	elif place.x < 2080 and place.y > -700:
		pass
	elif place.x < 2240 and place.y > -640:
		_climb_chimney(place)
	elif place.x < 2240:
		size = ROUND
	elif place.x < 2960 and place.y > -1000:
		_ride(place, _platform(0), 3060, 2500)
		if place.x > 2930:
			size = BIG
	elif place.x < 3190 and place.y > -1190:
		direction = signi(roundi((3080 - place.x) / 40))
		size = BIG
	else:
		size = BIG if place.x < 3230 else ROUND


## From wall to wall at first, then as a big one that holds by itself, hop by hop.
func _climb_chimney(place: Vector2) -> void:
	direction = signi(roundi((2200 - place.x) / 12)) if place.y > -200 else 0
	wants_jump = place.x > 2150 and (place.y > -260 or _ticks % 30 == 0)
	size = BIG if place.y < -230 and place.y > -600 else ROUND


## Waits at `edge` for a platform, rides it, jumps off towards `goal`.
func _ride(place: Vector2, platform: Platform, goal: float, edge: float) -> void:
	var beside := place.x - platform.position.x
	if absf(beside) < platform.extent.x / 2 + 30 and place.y < platform.position.y:
		direction = signi(roundi(-beside / 30))
		if goal - platform.position.x < 230:
			direction = 1
			wants_jump = true
	elif place.x > edge + 50: # in the air, or lost
		direction = 1 if platform.position.x > place.x or place.x > edge + 200 else 0
	else:
		direction = signi(roundi((edge - place.x) / 15))
		if platform.position.x - place.x < 190 and absf(edge - place.x) < 50:
			direction = 1
			wants_jump = true


## Stands on a lift until it is above `top`; below it, gets out to the left.
func _lift(place: Vector2, platform: Platform, top: float) -> void:
	if place.y > platform.position.y:
		direction = -1
		wants_jump = true
	elif place.y < top - 50 and platform.position.y < top + 5:
		direction = 1
		wants_jump = true
	else:
		direction = signi(roundi((platform.position.x - place.x) / 25))


func _platform(index: int) -> Platform:
	var found: Array[Platform] = []
	for node in _level.get_children():
		if node is Platform:
			found.append(node)
	return found[index]
