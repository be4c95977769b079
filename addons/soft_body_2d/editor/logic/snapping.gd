# SPDX-License-Identifier: MIT
@tool
extends RefCounted
## Places on the editor's grid, which lies in the plane of the scene.

var enabled := false
var step := Vector2(8, 8)
var offset := Vector2.ZERO


## `place` in the scene's plane.
func snapped_to_grid(place: Vector2) -> Vector2:
	if not enabled or step.x <= 0 or step.y <= 0:
		return place
	return (place - offset).snapped(step) + offset
