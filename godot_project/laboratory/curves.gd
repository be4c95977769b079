# SPDX-License-Identifier: MIT
extends Control
## Live curves over the last seconds, one for each of several things, all on one scale.

const SAMPLES := 300
const MARGIN := Vector2(8, 24)

## What is shown, above the curves.
@export var title := ""
@export var unit := ""
## The scale never shows less than this.
@export var least_top := 1.0

var _colors := PackedColorArray()
var _samples: Array[PackedFloat32Array] = []
var _bright := -1


## Empties the curves; from now on there is one for each color.
func start(colors: PackedColorArray) -> void:
	_colors = colors
	_samples.clear()
	for i in colors.size():
		_samples.append(PackedFloat32Array())
	_bright = -1
	queue_redraw()


## Draws this one stronger than the others.
func brighten(index: int) -> void:
	_bright = index


## One value for each curve.
func add(values: PackedFloat32Array) -> void:
	for i in mini(values.size(), _samples.size()):
		_samples[i].append(values[i])
		if _samples[i].size() > SAMPLES:
			_samples[i].remove_at(0)
	queue_redraw()


func get_last(index: int) -> float:
	var samples := _samples[index]
	return samples[samples.size() - 1] if not samples.is_empty() else 0.0


func _draw() -> void:
	draw_rect(Rect2(Vector2.ZERO, size), Color(0.06, 0.07, 0.15, 0.6))
	var top := least_top
	for samples in _samples:
		for value in samples:
			top = maxf(top, value)
	# A round number, so that the scale stands still.
	var power := pow(10, floorf(log(top) / log(10)))
	for factor: float in [1, 1.2, 1.5, 2, 3, 5, 10]:
		if power * factor >= top:
			top = power * factor
			break
	var font := ThemeDB.fallback_font
	draw_string(font, Vector2(MARGIN.x, 17), "%s, up to %s %s" % [title, String.num(top, 2), unit],
			HORIZONTAL_ALIGNMENT_LEFT, size.x - 2 * MARGIN.x, 13, Color(1, 1, 1, 0.8))
	var area := Rect2(MARGIN, size - MARGIN - Vector2(MARGIN.x, 6))
	draw_line(Vector2(area.position.x, area.end.y), area.end, Color(1, 1, 1, 0.3))
	for i in _samples.size():
		if _samples[i].size() < 2:
			continue
		var line := PackedVector2Array()
		for k in _samples[i].size():
			line.append(area.position + area.size * Vector2(float(k) / (SAMPLES - 1), 1 - minf(_samples[i][k] / top, 1)))
		var strong := i == _bright or _bright < 0
		draw_polyline(line, Color(_colors[i], 1.0 if strong else 0.45), 2.0 if strong else 1.0)
