# SPDX-License-Identifier: MIT
extends RefCounted
## What the command line asks of the demo: the arguments after `--`.

const USAGE := "known are --summary, --quit-after-seconds=N, --screenshot=ABSOLUTE_PATH"

## Print one line of results at the end.
var summary := false
## Simulated seconds after which the demo ends by itself; 0 for never.
var quit_after_seconds := 0.0
## Where to save the last picture; empty for nowhere.
var screenshot_path := ""
## What is wrong with the arguments; empty if nothing.
var problem := ""


func read(arguments: PackedStringArray) -> void:
	for argument in arguments:
		var value := argument.get_slice("=", 1) if "=" in argument else ""
		match argument.get_slice("=", 0):
			"--summary":
				summary = true
			"--quit-after-seconds":
				quit_after_seconds = value.to_float()
				if not value.is_valid_float() or not quit_after_seconds > 0:
					problem = "--quit-after-seconds=%s: must be a number above 0" % value
			"--screenshot":
				screenshot_path = value
				if not value.is_absolute_path():
					problem = "--screenshot=%s: must be an absolute path" % value
			_:
				problem = "%s: unknown argument; %s" % [argument, USAGE]
