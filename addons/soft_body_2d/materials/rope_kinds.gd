# SPDX-License-Identifier: MIT
extends RefCounted
## The kinds of a [SoftRope2D]: what each is called, what it does, and a color that suits it.
##
## A rope has no [SoftBodyMaterial2D]: its kind is four values of the node, see [member SoftRope2D.kind].


class Kind:
	var kind: SoftRope2D.Kind
	var file: String
	var title: String
	var text: String
	## How far the free end of one of 60 px that is held level is out at rest, as a share of its length.
	var reach: float
	## Length of one of 300 px that a kilogram hangs from, as a share of that at rest.
	var stretch: float
	var color: Color

	func _init(p_kind: SoftRope2D.Kind, p_file: String, p_title: String, p_text: String, p_measured: Array[float], p_color: Color) -> void:
		kind = p_kind
		file = p_file
		title = p_title
		text = p_text
		reach = p_measured[0]
		stretch = p_measured[1]
		color = p_color

	## The values of this kind by the names of their properties.
	func values() -> Dictionary:
		var rope := SoftRope2D.new()
		rope.kind = kind
		var values := {}
		for property: StringName in [&"stretch_stiffness", &"bend_stiffness", &"bend_damping", &"rest_bend"]:
			values[property] = rope.get(property)
		rope.free()
		return values

	## What `text` promises, in figures.
	func figures() -> String:
		return "60 px of it, held level at one end, stand out by %d %% of their length. A kilogram makes it %s." % [
				roundi(100 * reach), "no longer" if stretch == 1 else "%d %% longer" % roundi(100 * (stretch - 1))]


static func all() -> Array[Kind]:
	return [
		Kind.new(SoftRope2D.KIND_ROPE, "rope", "Rope", "Limp, and keeps its length under any load.", [0.0, 1.0], Color("c9a26b")),
		Kind.new(SoftRope2D.KIND_STRAP, "strap", "Strap", "Bends in wide curves, and keeps its length.", [0.94, 1.0], Color("d0574f")),
		Kind.new(SoftRope2D.KIND_TENTACLE, "tentacle", "Tentacle", "Stands out by itself, and bends back to the shape of its path.", [1.0, 1.0], Color("9b6fd0")),
		Kind.new(SoftRope2D.KIND_RUBBER_BAND, "rubber_band", "Rubber band", "Limp, and stretches.", [0.06, 1.5], Color("e0a13c")),
	]
