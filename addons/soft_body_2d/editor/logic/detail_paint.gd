# SPDX-License-Identifier: MIT
@tool
extends RefCounted
## Weights of detail as they are painted: one for each point of the polygon.

## What `detail_weights` may hold.
const LEAST := 0.1
const MOST := 10.0
const COARSE := Color("4f8fdc")
const EVEN := Color("8d97a5")
const FINE := Color("ff8f5c")


## 1 everywhere, where the body has none that fit.
static func weights_of(body: SoftBody2D) -> PackedFloat32Array:
	var weights := body.detail_weights
	if weights.size() != body.polygon.size():
		weights = PackedFloat32Array()
		weights.resize(body.polygon.size())
		weights.fill(1)
	return weights


## None where all of them are 1, which is the same.
static func tidied(weights: PackedFloat32Array) -> PackedFloat32Array:
	for weight in weights:
		if not is_equal_approx(weight, 1):
			return weights
	return PackedFloat32Array()


## Gray for 1, on a scale of ratios.
static func color_of(weight: float) -> Color:
	var share := log(clampf(weight, LEAST, MOST)) / log(MOST)
	return EVEN.lerp(FINE if share > 0 else COARSE, minf(1, 1.6 * absf(share)))
