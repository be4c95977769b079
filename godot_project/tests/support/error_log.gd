# SPDX-License-Identifier: MIT
extends Logger
## Collects what the engine prints as errors and warnings, from any thread. Needs Godot 4.5.

var _mutex := Mutex.new()
var _entries := PackedStringArray()
var _notes := PackedStringArray()


func _log_error(function: String, file: String, line: int, code: String, rationale: String,
		_editor_notify: bool, error_type: int, _backtraces: Array[ScriptBacktrace]) -> void:
	var kind := "warning" if error_type == ERROR_TYPE_WARNING else "error"
	var text := code if rationale == "" else rationale
	_mutex.lock()
	_entries.append("%s: %s (%s, %s:%d)" % [kind, text, function, file.get_file(), line])
	_mutex.unlock()


func _log_message(message: String, _error: bool) -> void:
	if message.begins_with("Note: SoftBody2D"):
		_mutex.lock()
		_notes.append(message)
		_mutex.unlock()


## What the extension has printed that is neither, since the run began.
func notes() -> PackedStringArray:
	_mutex.lock()
	var copy := _notes.duplicate()
	_mutex.unlock()
	return copy


## Everything since the last call.
func take() -> PackedStringArray:
	_mutex.lock()
	var taken := _entries.duplicate()
	_entries.clear()
	_mutex.unlock()
	return taken
