# SPDX-License-Identifier: MIT
extends RefCounted
## One of two players, with a world of their own. The input of the other is guessed until it is heard; where the guess was wrong,
## the world goes back to that tick and the ticks since then are stepped again.

const WINDOW := 8 # ticks that a peer goes ahead of what it has heard
const DELTA := 1.0 / 60
const PUSH := 26.0 # px/s a tick

var tick := 0 ## The next one.
var heard_ticks := 0 ## All inputs of the other before this tick are known.
var own: Array[Vector2] = [] ## Inputs, one a tick.
var hashes: Array[int] = [] ## After each tick, as it was stepped last.
var rollbacks := 0
var deepest := 0
var replayed := 0
var waits := 0

var _player: int
var _space: RID
var _bodies: Array[SoftBody2D] # of both players
var _heard := {} # inputs of the other, by tick
var _used: Array[Vector2] = [] # inputs of the other, as guessed or heard
var _states: Array[PackedByteArray] = [] # before each tick; empty where they are no longer needed


func _init(player: int, space: RID, bodies: Array[SoftBody2D]) -> void:
	_player = player
	_space = space
	_bodies = bodies


## The inputs of the last ticks: earlier packets may have been lost.
func make_packet() -> Dictionary:
	var first := maxi(0, tick - 3 * WINDOW)
	return {"first": first, "inputs": own.slice(first)}


func hear(packet: Dictionary) -> void:
	var inputs: Array = packet.inputs
	for i in inputs.size():
		_heard[packet.first + i] = inputs[i]
	while _heard.has(heard_ticks):
		heard_ticks += 1


## Corrects the past, and goes one tick ahead if the other is near enough. `input` is not asked for otherwise.
func play(input: Callable) -> void:
	correct()
	if tick - heard_ticks >= WINDOW:
		waits += 1
		return
	own.append(input.call())
	_used.append(Vector2.ZERO)
	_states.append(PackedByteArray())
	hashes.append(0)
	if tick > WINDOW:
		_states[tick - WINDOW - 1] = PackedByteArray()
	_step(false)


func correct() -> void:
	var now := tick
	for past in range(maxi(0, now - WINDOW), now):
		if _heard.has(past) and _heard[past] != _used[past]:
			SoftBodySimulation2D.restore_state(_space, _states[past])
			tick = past
			rollbacks += 1
			deepest = maxi(deepest, now - past)
			break
	while tick < now:
		_step(true)
		replayed += 1


func _step(is_replay: bool) -> void:
	_states[tick] = SoftBodySimulation2D.save_state(_space)
	_used[tick] = _heard.get(tick, _heard.get(heard_ticks - 1, Vector2.ZERO))
	push(_bodies[_player], own[tick])
	push(_bodies[1 - _player], _used[tick])
	SoftBodySimulation2D.step(_space, DELTA, is_replay)
	hashes[tick] = SoftBodySimulation2D.hash_state(_space)
	tick += 1


## What an input does.
static func push(body: SoftBody2D, input: Vector2) -> void:
	if input != Vector2.ZERO:
		body.apply_central_impulse(input * PUSH * body.mass)
