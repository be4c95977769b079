# SPDX-License-Identifier: MIT
extends "res://common/toy.gd"
## Two wrestlers in the manner of Gang Beasts, each of six joined soft bodies. The one that pushes the other off the
## roof wins the round.

const Solid := preload("res://common/solid.gd")
const Steering := preload("res://common/steering.gd")
const Wrestler := preload("res://miniatures/wrestler.gd")

const ROOF := Rect2(310, 500, 660, 60)
const FALLEN := 820.0 # px
const NEXT_ROUND := 2.5 # s

var player: Wrestler
var rival: Wrestler

var _score := [0, 0]
var _age := 0.0
var _over := -1.0 # s since the round was decided
var _mood := 0.0
var _player_won := false

@onready var _status: Label = %Status


func _unhandled_input(event: InputEvent) -> void:
	var key := event as InputEventKey
	if key != null and key.pressed and key.keycode == KEY_R:
		_score = [0, 0]
	super(event)


func _build() -> void:
	_age = 0
	_over = -1
	var roof := StaticBody2D.new()
	roof.set_script(Solid)
	Solid.add_box(roof, ROOF)
	Solid.add_box(roof, Rect2(ROOF.position.x + 60, ROOF.end.y, ROOF.size.x - 120, 300))
	world.add_child(roof)
	player = _add_wrestler(Color("4ecdc4"), Vector2(480, 380), 1)
	player.name = "Player"
	rival = _add_wrestler(Color("ff6b6b"), Vector2(800, 380), -1)
	rival.name = "Rival"


func _add_wrestler(tint: Color, place: Vector2, direction: float) -> Wrestler:
	var wrestler := Wrestler.new(tint, direction)
	wrestler.position = place
	world.add_child(wrestler)
	return wrestler


func _physics_process(delta: float) -> void:
	_age += delta
	var wish := Steering.direction()
	player.walk = wish.x
	player.jumps = wish.y < -0.5
	player.grabs = Steering.is_acting()
	player.shoves = Steering.is_acting_otherwise()
	_think(delta)
	if _over < 0:
		for i in 2:
			if _over < 0 and [player, rival][i].get_place().y > FALLEN:
				_over = 0
				_score[1 - i] += 1
				_player_won = i == 1
	else:
		_over += delta
		if _over > NEXT_ROUND:
			restart()
	_tell()


## The rival walks up, shoves, holds on when it is near the edge, and keeps away from the edge otherwise.
func _think(delta: float) -> void:
	_mood = fmod(_mood + delta, 3.2)
	var way := player.get_place().x - rival.get_place().x
	var middle := ROOF.get_center().x - rival.get_place().x
	var near := absf(way) < 120
	rival.walk = signf(way) * (0.75 if not near else 0.9) if _age > 0.8 else 0.0
	rival.shoves = near and _mood < 1.6
	rival.grabs = near and _mood >= 1.6 and _mood < 2.7
	rival.jumps = near and _mood > 3.0
	if absf(middle) > ROOF.size.x / 2 - 70: # back from the edge, even if the other is there
		rival.walk = signf(middle)
		rival.grabs = near


func _tell() -> void:
	var text := "You %d : %d rival" % _score
	if _over >= 0:
		text += "   ·   " + ("You win the round!" if _player_won else "The rival wins the round.")
	_status.text = text


func _process(_delta: float) -> void:
	queue_redraw()


## A skyline, so that the roof is high up.
func _draw() -> void:
	for i in 9:
		var height := 150.0 + 90.0 * sin(i * 2.3) + 30.0 * cos(i * 5.1)
		var box := Rect2(-20 + 150 * i, 720 - height, 118, height + 20)
		draw_rect(box, Color(0.13, 0.13, 0.27, 0.75))
		for row in int(height / 34):
			for column in 3:
				if sin(i * 7.0 + row * 3.7 + column * 11.0) > 0.1:
					var place := box.position + Vector2(16 + 34 * column, 14 + 34 * row)
					draw_rect(Rect2(place, Vector2(16, 16)), Color(1, 0.85, 0.5, 0.35))
