# SPDX-License-Identifier: MIT
@tool
extends RefCounted
## A brush that paints factors onto springs or points: full in its middle, fading out towards its radius.

## Plane in which both the brush and the points are [px].
var radius := 40.0
## Share of the radius over which it fades out: 0 is a hard edge, 1 fades from the middle on.
var falloff := 0.5
## Factor that it paints.
var target := 2.0
## How much of the way to the target a stroke goes at its middle, for each second that it stays there.
var strength := 4.0


## 1 in the middle, 0 at the radius and beyond; never rises on the way.
func weight(distance: float) -> float:
	if distance >= radius:
		return 0.0
	var hard := radius * (1 - falloff)
	if distance <= hard:
		return 1.0
	var t := (distance - hard) / (radius - hard)
	return 1 - t * t * (3 - 2 * t)


## The factors of springs after the brush has stayed for `duration` seconds at `place`. On a scale of ratios: from 1 to 4 by way of 2.
func painted(factors: PackedFloat32Array, points: PackedVector2Array, springs: PackedInt32Array, place: Vector2,
		duration: float) -> PackedFloat32Array:
	var result := factors.duplicate()
	for i in springs.size() / 2:
		var on_spring := Geometry2D.get_closest_point_to_segment(place, points[springs[2 * i]], points[springs[2 * i + 1]])
		result[i] = _painted(factors[i], target, on_spring.distance_to(place), duration)
	return result


## The same of points, towards `to` in place of the target.
func painted_points(factors: PackedFloat32Array, points: PackedVector2Array, place: Vector2, to: float,
		duration: float) -> PackedFloat32Array:
	var result := factors.duplicate()
	for i in points.size():
		result[i] = _painted(factors[i], to, points[i].distance_to(place), duration)
	return result


func _painted(factor: float, to: float, distance: float, duration: float) -> float:
	const LEAST := 0.001
	var share := weight(distance)
	if share <= 0:
		return factor
	var way := 1 - exp(-strength * share * duration)
	var from := maxf(factor, LEAST)
	var reached := from * pow(maxf(to, LEAST) / from, way)
	return to if way > 0.999 or absf(reached - to) < 0.001 * to else reached
