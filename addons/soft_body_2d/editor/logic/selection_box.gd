# SPDX-License-Identifier: MIT
@tool
extends RefCounted
## How a drag on the box around a selection turns and scales it. All in one plane, whichever.

enum Handle { NONE, ROTATE, SCALE }

const ROTATION_STEP := deg_to_rad(15)
## A selection is not scaled below this, so that it can be scaled up again.
const LEAST_SCALE := 0.01


## The corners, from the upper left clockwise.
static func corners(box: Rect2) -> PackedVector2Array:
	return [box.position, Vector2(box.end.x, box.position.y), box.end, Vector2(box.position.x, box.end.y)]


## Where the box is turned by: above its upper edge.
static func rotation_handle(box: Rect2, distance: float) -> Vector2:
	return Vector2(box.get_center().x, box.position.y - distance)


## Turns about `center` by the angle that the mouse has gone; in steps of 15 degrees if `stepped`.
static func rotation_about(center: Vector2, from: Vector2, to: Vector2, stepped: bool) -> Transform2D:
	var angle := (from - center).angle_to(to - center)
	if stepped:
		angle = snappedf(angle, ROTATION_STEP)
	return Transform2D(0, center) * Transform2D(angle, Vector2.ZERO) * Transform2D(0, -center)


## Scales about `anchor` so that `from` comes to `to`; alike in both directions if `uniform`.
static func scale_about(anchor: Vector2, from: Vector2, to: Vector2, uniform: bool) -> Transform2D:
	var before := from - anchor
	var after := to - anchor
	var factor := Vector2.ONE
	if uniform:
		factor = Vector2.ONE * (after.dot(before) / before.length_squared() if before != Vector2.ZERO else 1.0)
	else:
		for axis in 2:
			if not is_zero_approx(before[axis]):
				factor[axis] = after[axis] / before[axis]
	for axis in 2:
		if absf(factor[axis]) < LEAST_SCALE:
			factor[axis] = LEAST_SCALE if factor[axis] >= 0 else -LEAST_SCALE
	return Transform2D(0, anchor) * Transform2D(0, factor, 0, Vector2.ZERO) * Transform2D(0, -anchor)
