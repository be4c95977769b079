# SPDX-License-Identifier: MIT
extends RefCounted
## What the player has chosen and reached, kept in a file of the user's folder. Shared by all scenes; no node needed.

enum Quality { LOW, MEDIUM, HIGH }

const QUALITY_NAMES: Array[String] = ["Low", "Medium", "High"]

## Where it is kept. A test takes another file.
static var path := "user://moonjelly.cfg"
static var sound_volume := 0.8
static var music_volume := 0.6
static var quality := Quality.HIGH
static var fullscreen := false
## Seconds of the fastest way through all levels, 0 for none yet, and the most stars ever brought home.
static var best_time := 0.0
static var best_stars := 0
## How many levels may be chosen in the menu.
static var unlocked := 1


static func read() -> void:
	var file := ConfigFile.new()
	if file.load(path) != OK:
		return # the first start
	sound_volume = clampf(_number(file, "sound", "volume", sound_volume), 0, 1)
	music_volume = clampf(_number(file, "sound", "music", music_volume), 0, 1)
	quality = clampi(int(_number(file, "picture", "quality", quality)), 0, Quality.HIGH) as Quality
	fullscreen = _number(file, "picture", "fullscreen", float(fullscreen)) > 0
	best_time = maxf(_number(file, "best", "time", best_time), 0)
	best_stars = maxi(int(_number(file, "best", "stars", best_stars)), 0)
	unlocked = maxi(int(_number(file, "best", "unlocked", unlocked)), 1)


static func write() -> void:
	var file := ConfigFile.new()
	file.set_value("sound", "volume", sound_volume)
	file.set_value("sound", "music", music_volume)
	file.set_value("picture", "quality", quality)
	file.set_value("picture", "fullscreen", int(fullscreen))
	file.set_value("best", "time", best_time)
	file.set_value("best", "stars", best_stars)
	file.set_value("best", "unlocked", unlocked)
	if file.save(path) != OK:
		printerr("Moonjelly: the settings could not be saved to " + path)


## Lets the engine and the nodes of the tree follow what has been chosen.
static func apply(tree: SceneTree) -> void:
	AudioServer.set_bus_volume_db(0, linear_to_db(maxf(sound_volume, 0.0001)))
	var mode := DisplayServer.window_get_mode()
	var is_full := mode == DisplayServer.WINDOW_MODE_FULLSCREEN
	if DisplayServer.get_name() != "headless" and fullscreen != is_full:
		DisplayServer.window_set_mode(
				DisplayServer.WINDOW_MODE_FULLSCREEN if fullscreen else DisplayServer.WINDOW_MODE_WINDOWED)
	tree.call_group(&"quality", &"apply_quality", quality)
	for node in tree.get_nodes_in_group(&"soft_bodies"):
		apply_to_body(node as SoftBody2D)


## Soft bodies are drawn finer and, at the highest quality, stepped in twice as many substeps as they would need.
static func apply_to_body(body: SoftBody2D) -> void:
	body.antialiased = quality > Quality.LOW
	body.smooth = quality > Quality.LOW
	body.substeps = 0
	if quality == Quality.HIGH:
		body.substeps = 2 * int(body.get_substep_plan()["substeps"])


static func _number(file: ConfigFile, section: String, key: String, fallback: float) -> float:
	var value: Variant = file.get_value(section, key, fallback)
	return value if value is float or value is int else fallback
