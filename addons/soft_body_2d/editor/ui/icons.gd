# SPDX-License-Identifier: MIT
@tool
extends RefCounted
## The toolbar's icons: drawn from SVG in the color and size of the editor's theme, light or dark.

const FOLDER := "res://addons/soft_body_2d/editor/icons"
## What the files are drawn with, and the theme replaces.
const INK := "#e0e0e0"
## As the engine does with its own icons. Not black, which could not be tinted where a button is pressed.
const INK_ON_LIGHT := "#5a5a5a"


static func of(name: String, theme: Theme) -> Texture2D:
	var svg := FileAccess.get_file_as_string(FOLDER.path_join(name + ".svg"))
	if svg == "":
		return null
	var is_dark := not theme.has_color(&"font_color", &"Editor") or theme.get_color(&"font_color",
			&"Editor").get_luminance() > 0.5
	var image := Image.new()
	if image.load_svg_from_string(svg if is_dark else svg.replace(INK, INK_ON_LIGHT),
			EditorInterface.get_editor_scale()) != OK:
		return null
	return ImageTexture.create_from_image(image)
