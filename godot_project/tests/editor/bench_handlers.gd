# SPDX-License-Identifier: MIT
@tool
extends "suite.gd"
## How long the addon's handlers take, in a real editor: prints one ROW of JSON each. scripts/bench.sh editor sums them up.

const Presets := preload("res://addons/soft_body_2d/editor/logic/structure_presets.gd")
const TextureTrace := preload("res://addons/soft_body_2d/editor/logic/texture_trace.gd")

const ROUNDS := 15


func set_up(driver: EditorPlugin, error_log: RefCounted) -> void:
	super(driver, error_log)
	check(true, "a measurement claims nothing")


func _row(what: String, points: int, times: PackedFloat64Array, limit: float) -> void:
	var sorted := times.duplicate()
	sorted.sort()
	print("ROW ", JSON.stringify({"what": what, "size": points, "median_ms": sorted[sorted.size() / 2] / 1000,
			"worst_ms": sorted[-1] / 1000, "limit_ms": limit}))


func bench_gestures() -> void:
	for count: int in [16, 64, 256, 1000]:
		await open_scene({"polygon": SoftBody2D.make_circle_polygon(150, count)})
		for entry: Array in [["polygon", 1, 0], ["springs", 2, 0], ["brush", 2, 1]]:
			plugin.set_mode(entry[1])
			plugin.springs_mode.tool = entry[2]
			plugin.springs_mode.brush.target = 8.0
			await frames(3)
			var handler := PackedFloat64Array()
			var drawing := PackedFloat64Array()
			press(polygon_on_screen(0))
			for i in ROUNDS:
				move(_mouse + Vector2(1 if i % 2 == 0 else -1, 1))
				handler.append(plugin.canvas.handler_usec)
				await drawn()
				drawing.append(plugin.canvas.draw_usec)
			release()
			await frames(1)
			_row("mouse, " + entry[0], count, handler, 5)
			_row("drawing, " + entry[0], count, drawing, 5)


func bench_report() -> void:
	for count: int in [16, 64, 256]:
		await open_scene({"polygon": SoftBody2D.make_circle_polygon(50, count)})
		var times := PackedFloat64Array()
		for i in 5:
			var begin := Time.get_ticks_usec()
			body.get_stability_report(20.0)
			times.append(Time.get_ticks_usec() - begin)
		_row("stability report", count, times, 40)


## A flower with 24 petals and a rough edge: about a thousand corners of pixels before points are saved.
static func flower(size: int) -> Image:
	const SMALL := 256
	var image := Image.create(SMALL, SMALL, false, Image.FORMAT_RGBA8)
	for y in SMALL:
		for x in SMALL:
			var place := Vector2(x - SMALL / 2 + 0.5, y - SMALL / 2 + 0.5)
			var radius := SMALL * (0.34 + 0.1 * sin(24 * place.angle()) + 0.02 * sin(151 * place.angle()))
			if place.length() < radius:
				image.set_pixel(x, y, Color.WHITE)
	image.resize(size, size, Image.INTERPOLATE_CUBIC)
	return image


func bench_tracing() -> void:
	for size: int in [256, 1024, 4096]:
		var picture := flower(size)
		var times := PackedFloat64Array()
		for i in 3:
			var trace := TextureTrace.new()
			var begin := Time.get_ticks_usec()
			trace.trace(picture, 64)
			times.append(Time.get_ticks_usec() - begin)
			check(trace.problem == "", trace.problem)
		_row("tracing", size, times, 500)
