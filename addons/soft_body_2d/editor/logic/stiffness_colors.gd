# SPDX-License-Identifier: MIT
@tool
extends RefCounted
## Colors for stiffnesses, on a scale of ratios: blue is soft, red is stiff.

const STOPS: Array[Color] = [Color("4a78e0"), Color("3fb8a8"), Color("f0d04c"), Color("e5532d")]
## The scale spans at least this ratio, so that equal springs have the color of its middle.
const LEAST_RATIO := 4.0

var least := INF
var most := 0.0


func clear() -> void:
	least = INF
	most = 0.0


func include(stiffness: float, factors: PackedFloat32Array) -> void:
	var low := 1.0
	var high := 1.0
	if not factors.is_empty():
		low = INF
		high = 0.0
		for factor in factors:
			low = minf(low, factor)
			high = maxf(high, factor)
	least = minf(least, stiffness * low)
	most = maxf(most, stiffness * high)
	var ratio := most / maxf(least, 1e-6)
	if ratio < LEAST_RATIO:
		var widen := sqrt(LEAST_RATIO / ratio)
		least /= widen
		most *= widen


## 0 where it is softest, 1 where it is stiffest.
func place_of(stiffness: float) -> float:
	var low := maxf(least, 1e-6)
	if stiffness <= low or most <= low:
		return 0.0
	return clampf(log(stiffness / low) / log(most / low), 0, 1)


func color_of(stiffness: float) -> Color:
	return ramp(place_of(stiffness))


func ramp(share: float) -> Color:
	var at := clampf(share, 0, 1) * (STOPS.size() - 1)
	var index := mini(int(at), STOPS.size() - 2)
	return STOPS[index].lerp(STOPS[index + 1], at - index)
