# SPDX-License-Identifier: MIT
@tool
extends RefCounted
## The toolbar's icons: drawn from SVG in the colour and size of the editor's theme, light or dark.

const FOLDER := "res://addons/soft_body_2d/editor/icons"
## What the files are drawn with, and the theme replaces.
const INK := "#e0e0e0"


static func of(name: String, theme: Theme) -> Texture2D:
	var svg := FileAccess.get_file_as_string(FOLDER.path_join(name + ".svg"))
	if svg == "":
		return null
	var ink := theme.get_color(&"font_color", &"Editor") if theme.has_color(&"font_color", &"Editor") else Color(INK)
	var image := Image.new()
	if image.load_svg_from_string(svg.replace(INK, "#" + ink.to_html(false)), EditorInterface.get_editor_scale()) != OK:
		return null
	return ImageTexture.create_from_image(image)
