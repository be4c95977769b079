#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds everything and plays the demo, and installs first what is missing for that.
#
# Usage: scripts/demo.sh [--headless] [--json] [--seconds N] [--screenshot FILE]
#   Without options and with a screen, game and demo are yours to play. Else the demo plays itself and reports how that went:
#   --seconds N        for so many seconds of the game (default 8)
#   --screenshot FILE  keeps the last picture there (default build/demo.png)
#   --headless         without a window and a picture
#   --json             with the report as one JSON object in the last line
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/lib/common.sh"
. "$REPO_DIR/scripts/lib/godot.sh"
. "$REPO_DIR/scripts/lib/build.sh"

usage() {
	problem "$1; usage: scripts/demo.sh [--headless] [--json] [--seconds N] [--screenshot FILE]" || exit 2
}

headless=no json=no seconds=8 screenshot=$REPO_DIR/build/demo.png interactive=no
if [[ $# -eq 0 ]] && has_screen; then
	interactive=yes
fi
while [[ $# -gt 0 ]]; do
	case $1 in
		--headless) headless=yes screenshot= ;;
		--json) json=yes ;;
		--seconds)
			[[ ${2:-} =~ ^[0-9]+$ && $2 -gt 0 ]] || usage "--seconds wants a whole number above 0, not '${2:-}'"
			seconds=$2
			shift
			;;
		--screenshot)
			[[ -n ${2:-} && -d $(dirname "$2") ]] || usage "--screenshot wants a file in an existing folder, not '${2:-}'"
			screenshot=$(cd "$(dirname "$2")" && pwd)/$(basename "$2")
			shift
			;;
		*) usage "unknown option '$1'" ;;
	esac
	shift
done
[[ $headless == no || -z $screenshot ]] || usage "without a window there is no screenshot"

build_extension target=template_debug
find_godot
[[ $headless == yes ]] || need_window
step "Godot $GODOT_NAME"
import_project
check_extension

if [[ $interactive == yes ]]; then
	step "Opening the menu: the game, the demo and what else there is; close the window to end it"
	godot_windowed 0 --path "$PROJECT_DIR"
	exit
fi

# A fixed frame rate makes the game's seconds independent of the clock: it runs as fast as it can, and always the same.
step "Playing $seconds s of the demo"
log=$LOG_DIR/demo.log
limit=$((120 + 30 * seconds))
arguments=(--fixed-fps 60 --audio-driver Dummy --path "$PROJECT_DIR" res://demo/main.tscn -- --summary "--quit-after-seconds=$seconds")
status=0
if [[ $headless == yes ]]; then
	godot_headless $limit "${arguments[@]}" >"$log" 2>&1 || status=$?
else
	rm -f "$screenshot"
	godot_windowed $limit "${arguments[@]}" "--screenshot=$screenshot" >"$log" 2>&1 || status=$?
fi

if grep -E '^ *(USER )?(SCRIPT )?ERROR:' -A 2 "$log" >&2; then
	problem "the engine reported the errors above (all of its output: $log)"
fi
if [[ $status -ne 0 ]]; then
	tail -n 20 "$log" >&2
	problem "the demo ended with status $status (all of its output: $log)"
fi
summary=$(sed -nE 's/^SUMMARY (\{.*\})[[:space:]]*$/\1/p' "$log" | tail -n 1)
[[ -n $summary ]] || problem "the demo printed no summary (all of its output: $log)"
if [[ -n $screenshot ]]; then
	[[ -s $screenshot ]] || problem "the demo saved no screenshot (all of its output: $log)"
	step "Screenshot: $screenshot"
fi

python3 - "$json" "$summary" <<'PYTHON'
import json
import sys

as_json, summary = sys.argv[1] == "yes", json.loads(sys.argv[2])
print(
    "==> {bodies:.0f} bodies, {ticks:.0f} ticks, {mean_step_us:.0f} µs per step, largest penetration"
    " {max_penetration_px:.2f} px, smallest area {area:.0f} %".format(area=100 * summary["min_area_ratio"], **summary)
)
if as_json:
    print(json.dumps(summary))
if not summary["finite"]:
    sys.exit("error: the simulation has blown up")
PYTHON
