# SPDX-License-Identifier: MIT
extends RefCounted
## The materials of this folder: what each is called, what it does, and a color that suits it.

const FOLDER := "res://addons/soft_body_2d/materials/"


## What a default node of a material does that falls 200 px onto flat ground. All lengths are shares of its size of 100 px.
class Preset:
	var file: String
	var title: String
	var text: String
	## Height at rest.
	var rest: float
	## Least height as it lands.
	var squash: float
	## Height of its first jump, as a share of the fall.
	var rebound: float
	## Largest lasting change of a length; 0 of a material that takes no dents.
	var dent: float
	var color: Color

	func _init(p_file: String, p_title: String, p_text: String, p_measured: Array[float], p_color: Color) -> void:
		file = p_file
		title = p_title
		text = p_text
		rest = p_measured[0]
		squash = p_measured[1]
		rebound = p_measured[2]
		dent = p_measured[3]
		color = p_color

	func path() -> String:
		return FOLDER + file + ".tres"

	func load_material() -> SoftBodyMaterial2D:
		return load(path())

	## What `text` promises, in figures.
	func figures() -> String:
		var line := "Dropped from 200 px, a ball of 100 px squashes to %d %% of its height and jumps back %d %% of the fall. At rest it is %d %% high." % [
				roundi(100 * squash), roundi(100 * rebound), roundi(100 * rest)]
		return line if dent == 0 else line + " The fall leaves a dent of %d %%." % roundi(100 * dent)


static func all() -> Array[Preset]:
	return [
		Preset.new("jelly", "Jelly", "Wobbles a few times and keeps its shape.", [0.956, 0.754, 0.244, 0.0], Color("4cc38a")),
		Preset.new("water_balloon", "Water balloon", "Spreads wide as it lands and sloshes for long.", [0.926, 0.678, 0.203, 0.0], Color("4aa3e0")),
		Preset.new("rubber_ball", "Rubber ball", "Firm, grips, and jumps more than half of its fall.", [0.991, 0.873, 0.576, 0.0], Color("e0524a")),
		Preset.new("slime", "Slime", "Sags, sticks to slopes, and does not jump.", [0.857, 0.718, 0.0, 0.0], Color("8fd14f")),
		Preset.new("marshmallow", "Marshmallow", "Light; is pressed together without bulging, and one swing calms it.", [0.975, 0.803, 0.169, 0.0], Color("f5dfe4")),
		Preset.new("beach_ball", "Beach ball", "Light, rolls far, and jumps high.", [0.993, 0.867, 0.596, 0.0], Color("f2b134")),
		Preset.new("tyre", "Tyre", "Heavy and firm; grips, and rolls on.", [0.995, 0.896, 0.459, 0.0], Color("5b6270")),
		Preset.new("car_panel", "Car panel", "Heavy sheet metal: what hits it hard leaves a dent, and it does not jump.", [0.91, 0.869, 0.021, 0.182], Color("9aa7b8")),
		Preset.new("fruit", "Fruit", "Firm flesh that bruises where it lands.", [0.945, 0.861, 0.121, 0.103], Color("f08a3c")),
	]
