# SPDX-License-Identifier: MIT
extends Control
## Two players over a network that loses packets and delivers them late and out of order. Each has a world of their own, stepped
## by hand. The worlds agree to the last bit in every tick whose inputs both have heard.

const Peer := preload("res://examples/rollback_peer.gd")
const Solid := preload("res://common/solid.gd")
const COLORS: Array[Color] = [Color("ff6b6b"), Color("5aa9e6"), Color("f2c14e")]

## Share of packets that are lost.
@export_range(0.0, 0.9) var loss := 0.25
## The longest that a packet takes, in ticks.
@export_range(1, 30) var most_delay := 6

var peers: Array[Peer] = []
var mismatches := 0
var agreed := 0 ## Ticks after which both worlds were compared.

var _network := RandomNumberGenerator.new()
var _moods: Array[RandomNumberGenerator] = [RandomNumberGenerator.new(), RandomNumberGenerator.new()]
var _inputs: Array[Vector2] = [Vector2.ZERO, Vector2.ZERO]
var _packets: Array[Array] = [[], []] # on the way to each peer
var _now := 0
var _spaces: Array[RID] = []
var _players: Array[Array] = []
var _starts: Array[PackedByteArray] = []

@onready var _status: Label = %Status
@onready var _viewports: Array[SubViewport] = [%Left, %Right]


func _ready() -> void:
	for viewport in _viewports:
		viewport.world_2d = World2D.new()
		_players.append(make_arena(viewport))
		_spaces.append(viewport.world_2d.space)
		SoftBodySimulation2D.set_automatic_stepping(viewport.world_2d.space, false)
	begin(1)


func _physics_process(_delta: float) -> void:
	advance()
	_status.text = "tick %d   ·   %d rollbacks, %d ticks at most   ·   %d ticks stepped again   ·   %d ticks waited   ·   %d agreed, %d mismatches" % [
		_now, peers[0].rollbacks + peers[1].rollbacks, maxi(peers[0].deepest, peers[1].deepest),
		peers[0].replayed + peers[1].replayed, peers[0].waits + peers[1].waits, agreed, mismatches]


## Everything from the beginning.
func begin(new_seed: int) -> void:
	for i in 2:
		if _starts.size() < 2:
			_starts.append(SoftBodySimulation2D.save_state(_spaces[i]))
		else:
			SoftBodySimulation2D.restore_state(_spaces[i], _starts[i])
		_moods[i].seed = 2 * new_seed + i
		_inputs[i] = Vector2.ZERO
		_packets[i] = []
	_network.seed = new_seed
	_now = 0
	agreed = 0
	mismatches = 0
	peers.clear()
	for i in 2:
		peers.append(Peer.new(i, _spaces[i], _players[i]))


## One tick of both peers, and of the network between them.
func advance() -> void:
	for i in 2:
		var late: Array = []
		for packet: Dictionary in _packets[i]:
			if packet.due <= _now:
				peers[i].hear(packet)
			else:
				late.append(packet)
		_packets[i] = late
		peers[i].play(_choose_input.bind(i))
		var packet := peers[i].make_packet()
		packet.due = _now + _network.randi_range(1, most_delay)
		if _network.randf() >= loss:
			_packets[1 - i].append(packet)
	_now += 1
	_compare()


## Ticks whose inputs both have heard.
func _compare() -> void:
	var both := mini(mini(peers[0].tick, peers[0].heard_ticks), mini(peers[1].tick, peers[1].heard_ticks))
	while agreed < both:
		for peer in peers:
			peer.correct()
		if peers[0].hashes[agreed] != peers[1].hashes[agreed]:
			mismatches += 1
		agreed += 1


## The arrow keys for the left player; else what comes to mind, for some ticks.
func _choose_input(player: int) -> Vector2:
	if player == 0:
		var keys := Input.get_vector("ui_left", "ui_right", "ui_up", "ui_down")
		if keys != Vector2.ZERO:
			return keys
	if _moods[player].randf() < 0.1:
		var angle := _moods[player].randf() * TAU
		_inputs[player] = Vector2.from_angle(angle) if _moods[player].randf() < 0.7 else Vector2.ZERO
	return _inputs[player]


## Walls, two players, and what they push about. Returns the players.
static func make_arena(parent: Node) -> Array[SoftBody2D]:
	var walls := Solid.new()
	for box: Rect2 in [Rect2(0, 450, 600, 50), Rect2(0, 0, 30, 450), Rect2(570, 0, 30, 450), Rect2(30, 0, 540, 30)]:
		Solid.add_box(walls, box)
	parent.add_child(walls)
	var bodies: Array[SoftBody2D] = []
	for i in 8:
		var body := SoftBody2D.new()
		body.polygon = SoftBody2D.make_circle_polygon(44.0 if i < 2 else 34.0, 16)
		body.position = Vector2(150 + 300 * i, 390) if i < 2 else Vector2(170 + 130 * ((i - 2) % 3), 300 - 80 * floori((i - 2) / 3.0))
		body.color = COLORS[mini(i, 2)]
		body.smooth = true
		body.antialiased = true
		body.outline_width = 3.0
		body.outline_color = COLORS[mini(i, 2)].darkened(0.5)
		body.contact_monitor = i < 2
		parent.add_child(body)
		bodies.append(body)
	var chain := SoftBodyJoint2D.new()
	chain.position = (bodies[2].position + bodies[3].position) / 2
	parent.add_child(chain)
	chain.node_a = chain.get_path_to(bodies[2])
	chain.node_b = chain.get_path_to(bodies[3])
	chain.break_force = 9000.0
	return bodies.slice(0, 2)
