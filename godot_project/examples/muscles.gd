# SPDX-License-Identifier: MIT
extends Node2D
## Lets springs shorten and lengthen: a wave along a worm, a beat in a heart.

const WAVE_LENGTH := 260.0 # px
const WAVE_FREQUENCY := 1.3 # Hz
const WAVE := 0.35
const BEAT := 1.1 # s

var _age := 0.0

@onready var _worm: SoftBody2D = %Worm
@onready var _heart: SoftBody2D = %Heart


func _physics_process(delta: float) -> void:
	_age += delta
	_crawl()
	_beat()


## Springs along the worm shorten and lengthen in a wave; the worm goes the way that the wave goes.
func _crawl() -> void:
	var scales := PackedFloat32Array()
	for k in _worm.get_spring_count():
		var ends := _worm.get_spring_points(k)
		var a := _rest_place(ends.x)
		var b := _rest_place(ends.y)
		var along := absf((b - a).normalized().x)
		var phase := TAU * (WAVE_FREQUENCY * _age - (a.x + b.x) / 2 / WAVE_LENGTH)
		scales.append(1 + WAVE * along * sin(phase))
	_worm.spring_length_scales = scales
	if _worm.global_position.x > 1050:
		_worm.teleport(Transform2D(0, Vector2(200, _worm.global_position.y)))


func _rest_place(index: int) -> Vector2:
	return _worm.polygon[index] if index < _worm.polygon.size() else _worm.inner_points[index - _worm.polygon.size()]


func _beat() -> void:
	var phase := fmod(_age, BEAT) / BEAT
	var squeeze := 0.22 * (exp(-60 * pow(phase - 0.15, 2)) + 0.6 * exp(-60 * pow(phase - 0.42, 2)))
	var scales := PackedFloat32Array()
	scales.resize(_heart.get_spring_count())
	scales.fill(1 - squeeze)
	_heart.spring_length_scales = scales
