# SPDX-License-Identifier: MIT
extends RefCounted
## Hands that play: what a player wants to do, as events of a keyboard, a mouse or a gamepad.
##
## Nothing is set behind the engine's back: every event goes through [method Input.parse_input_event], as those of real
## devices do.

enum Device { KEYS, PAD, MOUSE }

const POINTER_DISTANCE := 300.0 # px beside the jelly

var device := Device.KEYS
## From the coordinates of the game's view to those of the window, in which devices speak.
var to_window := Transform2D.IDENTITY

var _direction := 0
var _size := 0
var _jumping := false
var _pointed := Vector2.ZERO


## -1 rolls to the left, 1 to the right. `place` is where the player is on the screen: the mouse points beside it.
func roll(direction: int, place: Vector2) -> void:
	match device:
		Device.KEYS:
			if direction != _direction:
				_key(KEY_A, direction < 0)
				_key(KEY_D, direction > 0)
		Device.PAD:
			if direction != _direction:
				_axis(JOY_AXIS_LEFT_X, direction)
		Device.MOUSE:
			_pointed = place + Vector2(direction * POINTER_DISTANCE, 0)
			_point(_pointed)
			if (direction != 0) != (_direction != 0):
				_button(MOUSE_BUTTON_LEFT, direction != 0, _pointed)
	_direction = direction


func jump(held: bool) -> void:
	if held == _jumping:
		return
	_jumping = held
	match device:
		Device.KEYS:
			_key(KEY_SPACE, held)
		Device.PAD:
			_pad(JOY_BUTTON_A, held)
		Device.MOUSE:
			_button(MOUSE_BUTTON_RIGHT, held, _pointed)


## -1 goes flat, 0 is round, 1 blows up.
func take_size(size: int) -> void:
	if size == _size:
		return
	match device:
		Device.KEYS:
			_key(KEY_S, size < 0)
			_key(KEY_SHIFT, size > 0)
		Device.PAD:
			_axis(JOY_AXIS_TRIGGER_LEFT, 1.0 if size < 0 else 0.0)
			_axis(JOY_AXIS_TRIGGER_RIGHT, 1.0 if size > 0 else 0.0)
		Device.MOUSE:
			for step in absi(size - _size):
				var wheel := MOUSE_BUTTON_WHEEL_UP if size > _size else MOUSE_BUTTON_WHEEL_DOWN
				_button(wheel, true, _pointed)
				_button(wheel, false, _pointed)
	_size = size


## Lets go of everything.
func rest() -> void:
	roll(0, Vector2(640, 360))
	jump(false)
	take_size(0)


## What the other side forgets as it brings the player back, such as what the wheel has chosen.
func forget_size() -> void:
	if device == Device.MOUSE:
		_size = 0


func tap_key(key: Key) -> void:
	_key(key, true)
	_key(key, false)


func tap_pad(button: JoyButton) -> void:
	_pad(button, true)
	_pad(button, false)


func _key(key: Key, pressed: bool) -> void:
	var event := InputEventKey.new()
	event.keycode = key
	event.physical_keycode = key
	event.pressed = pressed
	_send(event)


func _pad(button: JoyButton, pressed: bool) -> void:
	var event := InputEventJoypadButton.new()
	event.button_index = button
	event.pressed = pressed
	event.pressure = 1.0 if pressed else 0.0
	_send(event)


func _axis(axis: JoyAxis, value: float) -> void:
	var event := InputEventJoypadMotion.new()
	event.axis = axis
	event.axis_value = value
	_send(event)


func _button(button: MouseButton, pressed: bool, place: Vector2) -> void:
	var event := InputEventMouseButton.new()
	event.button_index = button
	event.pressed = pressed
	event.position = to_window * place
	event.global_position = event.position
	_send(event)


func _point(place: Vector2) -> void:
	var event := InputEventMouseMotion.new()
	event.position = to_window * place
	event.global_position = event.position
	_send(event)


func _send(event: InputEvent) -> void:
	Input.parse_input_event(event)
	Input.flush_buffered_events()
