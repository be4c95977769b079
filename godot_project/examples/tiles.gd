# SPDX-License-Identifier: MIT
extends Node2D
## Makes a tile set of a block and two slopes, and a level of it: as the editor would, without a picture file.

const SIZE := 64
## From above; # is a block, \ and / are slopes, . is air.
const LEVEL: Array[String] = [
	"#..................#",
	"#..................#",
	"#..................#",
	"##\\................#",
	"###\\..............##",
	"####\\............/##",
	"#####\\..........####",
	"######\\...##../#####",
	"#######\\..##.#######",
	"####################",
	"####################",
	"####################",
]
const TILES := "#\\/"
const AGAIN_AFTER := 9.0 # s

var _age := 0.0
var _starts := {} # body -> Transform2D


func _ready() -> void:
	var layer := TileMapLayer.new()
	layer.tile_set = _make_tile_set()
	layer.z_index = -1
	for row in LEVEL.size():
		for column in LEVEL[row].length():
			var kind := TILES.find(LEVEL[row][column])
			if kind >= 0:
				layer.set_cell(Vector2i(column, row), 0, Vector2i(kind, 0))
	add_child(layer)
	for node in find_children("*", "SoftBody2D"):
		_starts[node] = (node as SoftBody2D).global_transform


func _physics_process(delta: float) -> void:
	_age += delta
	if _age > AGAIN_AFTER:
		_age = 0
		for body: SoftBody2D in _starts:
			body.teleport(_starts[body])
			body.reset()
			body.linear_velocity = Vector2(160, 0)


func _make_tile_set() -> TileSet:
	var half := SIZE / 2.0
	var outlines: Array[PackedVector2Array] = [
		PackedVector2Array([Vector2(-half, -half), Vector2(half, -half), Vector2(half, half), Vector2(-half, half)]),
		PackedVector2Array([Vector2(-half, -half), Vector2(half, half), Vector2(-half, half)]),
		PackedVector2Array([Vector2(half, -half), Vector2(half, half), Vector2(-half, half)]),
	]
	var tiles := TileSet.new()
	tiles.tile_size = Vector2i(SIZE, SIZE)
	tiles.add_physics_layer()
	var source := TileSetAtlasSource.new()
	source.texture = ImageTexture.create_from_image(_draw_tiles(outlines))
	source.texture_region_size = tiles.tile_size
	tiles.add_source(source, 0)
	for i in outlines.size():
		source.create_tile(Vector2i(i, 0))
		var data := source.get_tile_data(Vector2i(i, 0), 0)
		data.add_collision_polygon(0)
		data.set_collision_polygon_points(0, 0, outlines[i])
	return tiles


func _draw_tiles(outlines: Array[PackedVector2Array]) -> Image:
	var image := Image.create(SIZE * outlines.size(), SIZE, false, Image.FORMAT_RGBA8)
	for i in outlines.size():
		for y in SIZE:
			for x in SIZE:
				var place := Vector2(x + 0.5, y + 0.5) - Vector2(SIZE, SIZE) / 2
				if Geometry2D.is_point_in_polygon(place, outlines[i]):
					var shade := 0.06 * float((x / 16 + y / 16) % 2)
					image.set_pixel(i * SIZE + x, y, Color("3b4072").lightened(shade))
	return image
