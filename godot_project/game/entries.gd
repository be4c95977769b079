# SPDX-License-Identifier: MIT
extends RefCounted
## The scenes that the menu offers beside the game. Add a line to show another one: a title, its path, what it is.

const SCENES: Array[Dictionary] = [
	{"title": "Demo", "path": "res://demo/main.tscn", "about": "Jellies of every stiffness to pull at"},
	{"title": "Slicing", "path": "res://miniatures/slicing.tscn", "about": "Cut the fruit, spare the stones"},
	{"title": "Petri dish", "path": "res://miniatures/petri_dish.tscn", "about": "Swallow the small, flee the large"},
	{"title": "Jelly wrestlers", "path": "res://miniatures/jelly_wrestlers.tscn", "about": "Push the other one off"},
	{"title": "Crash", "path": "res://miniatures/crash.tscn", "about": "A car that keeps its dents"},
	{"title": "Laboratory", "path": "res://laboratory/laboratory.tscn", "about": "Models and methods under one load"},
	{"title": "Levels", "path": "res://laboratory/levels.tscn", "about": "What is simulated in full?"},
	{"title": "Stress test", "path": "res://laboratory/stress_test.tscn", "about": "How many does this machine hold?"},
	{"title": "Crates and a lift", "path": "res://examples/crates_and_lift.tscn", "about": "Rigid bodies push and are pushed"},
	{"title": "Cuts", "path": "res://examples/cuts.tscn", "about": "Draw a line through jelly"},
	{"title": "Dents", "path": "res://examples/dents.tscn", "about": "Metal, toughness, dough"},
	{"title": "Tears", "path": "res://examples/tears.tscn", "about": "Strips that part at their seam"},
	{"title": "Materials", "path": "res://examples/presets.tscn", "about": "From jelly to sheet metal"},
	{"title": "Water", "path": "res://examples/water.tscn", "about": "What floats, and how deep"},
	{"title": "Wind", "path": "res://examples/wind.tscn", "about": "Sails, boxes and a balloon"},
	{"title": "Ropes", "path": "res://examples/ropes.tscn", "about": "A bridge, a chandelier, a grapple"},
	{"title": "Looks", "path": "res://examples/looks.tscn", "about": "Outlines, textures, colors"},
	{"title": "Pile", "path": "res://examples/pile.tscn", "about": "Many bodies on a heap"},
	{"title": "Friction", "path": "res://examples/friction.tscn", "about": "Who slides, who holds"},
	{"title": "Stiffness", "path": "res://examples/stiffness_comparison.tscn", "about": "From pudding to rubber"},
	{"title": "Contact signals", "path": "res://examples/contact_signals.tscn", "about": "What bodies tell of touches"},
	{"title": "Characters and areas", "path": "res://examples/character_and_area.tscn", "about": "What the engine sees"},
	{"title": "Textures", "path": "res://examples/textured_body.tscn", "about": "A picture sticks to the flesh"},
	{"title": "Polygons with dents", "path": "res://examples/concave_polygon.tscn", "about": "Any outline will do"},
	{"title": "Shape matching", "path": "res://examples/shape_matching.tscn", "about": "Who finds back into shape"},
	{"title": "Forces", "path": "res://examples/grab_and_forces.tscn", "about": "Wind, kicks, and the mouse"},
	{"title": "One material for many", "path": "res://examples/shared_material.tscn", "about": "A change reaches all of them"},
	{"title": "Collision layers", "path": "res://examples/collision_layers.tscn", "about": "Who touches whom"},
	{"title": "Run time creation", "path": "res://examples/run_time_creation.tscn", "about": "Bodies made by code"},
]

const LEVELS: Array[String] = [
	"res://game/levels/level_1.tscn",
	"res://game/levels/level_2.tscn",
	"res://game/levels/level_3.tscn",
]

const MENU := "res://game/ui/menu.tscn"
const GAME := "res://game/game.tscn"
const SHOWCASE := "res://game/ui/showcase.tscn"
