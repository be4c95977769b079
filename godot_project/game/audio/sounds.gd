# SPDX-License-Identifier: MIT
extends Node
## Plays the sounds of the game. They are made once, on first use, and shared by every scene that has this node.

const Settings := preload("res://game/settings.gd")
const Synth := preload("res://game/audio/synth.gd")
const VOICES := 8

static var _streams := {}
static var _music: AudioStreamWAV
static var _music_task := -1

var _voices: Array[AudioStreamPlayer] = []
var _next := 0
var _music_player := AudioStreamPlayer.new()
var _asked_for_music := false
## A run without a screen has no ears either, and need not compute music.
var _is_heard := DisplayServer.get_name() != "headless"


func _ready() -> void:
	process_mode = Node.PROCESS_MODE_ALWAYS
	for i in VOICES:
		var voice := AudioStreamPlayer.new()
		_voices.append(voice)
		add_child(voice)
	add_child(_music_player)
	get_streams()


func _exit_tree() -> void:
	if _music_task >= 0:
		WorkerThreadPool.wait_for_task_completion(_music_task)
		_music_task = -1


func _process(_delta: float) -> void:
	if _music_task >= 0 and WorkerThreadPool.is_task_completed(_music_task):
		WorkerThreadPool.wait_for_task_completion(_music_task)
		_music_task = -1
	if _asked_for_music and _music_task < 0 and _music != null and not _music_player.playing:
		_music_player.stream = _music
		_music_player.play()
	_music_player.volume_db = linear_to_db(maxf(Settings.music_volume * 0.8, 0.0001))


func _notification(what: int) -> void:
	if what == NOTIFICATION_WM_CLOSE_REQUEST:
		silence()


## Stops everything at once.
func silence() -> void:
	_asked_for_music = false
	_music_player.stop()
	for voice in _voices:
		voice.stop()


## `strength` from 0 to 1 is loudness; a little chance in the pitch keeps repeated sounds alive.
func play(sound: StringName, strength := 1.0, pitch := 1.0) -> void:
	if not _is_heard:
		return
	var voice := _voices[_next]
	_next = (_next + 1) % VOICES
	voice.stream = _streams[sound]
	voice.volume_db = linear_to_db(clampf(strength, 0.02, 1))
	voice.pitch_scale = pitch * randf_range(0.95, 1.06)
	voice.play()


## The loop takes a second to compute, so that happens on a thread of the pool.
func start_music() -> void:
	if not _is_heard:
		return
	_asked_for_music = true
	if _music == null and _music_task < 0:
		_music_task = WorkerThreadPool.add_task(func() -> void: _music = Synth.music())


## All sounds by name, made on the first call.
static func get_streams() -> Dictionary:
	if not _streams.is_empty():
		return _streams
	_streams = {
		&"jump": Synth.glide(190, 520, 0.2, 0.5, 0.35),
		&"squish": Synth.glide(210, 70, 0.22, 0.6, 0.2, 0.35, 18),
		&"inflate": Synth.glide(120, 330, 0.4, 0.35, 0.15, 0.45),
		&"deflate": Synth.glide(360, 90, 0.35, 0.35, 0.3, 0.4, 24),
		&"star": Synth.bells([1046.5, 1568.0], 0.07, 0.5, 0.3),
		&"checkpoint": Synth.bells([523.3, 659.3, 784.0], 0.09, 0.7, 0.3),
		&"pop": Synth.glide(520, 60, 0.3, 0.6, 0.4, 0.5),
		&"bounce": Synth.glide(150, 420, 0.3, 0.5, 0.3, 0.05, 12),
		&"gate": Synth.bells([523.3, 659.3, 784.0, 1046.5], 0.11, 1.0, 0.3),
		&"win": Synth.bells([523.3, 659.3, 784.0, 1046.5, 784.0, 1046.5, 1318.5], 0.15, 1.4, 0.3),
		&"button": Synth.glide(420, 560, 0.09, 0.3, 0.2),
	}
	return _streams
