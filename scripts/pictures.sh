#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Plays scenes of the demo project and makes the animated pictures of README and docs of them, in docs/pictures.
#
# Usage: scripts/pictures.sh [NAME…]      default: all of the list below
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/lib/common.sh"
. "$REPO_DIR/scripts/lib/godot.sh"
. "$REPO_DIR/scripts/lib/build.sh"
. "$REPO_DIR/scripts/lib/bench.sh"

# name  scene  first second  last second  frames filmed a second  frames shown a second (15 and 15, if not given)
CLIPS=(
	"drop  res://pictures/hero_drop.tscn  0  4  60  60"
	"press  res://pictures/hero_press.tscn  0  4  60  60"
	"cut  res://pictures/hero_cut.tscn  0  4  60  60"
	"heap  res://pictures/hero_heap.tscn  0  4  60  60"
	"petri_dish  res://miniatures/petri_dish.tscn  1  6"
	"before_drop  res://pictures/drop.tscn  0  5  30  15"
	"before_press  res://pictures/press.tscn  0  6"
	"before_heap  res://pictures/heap.tscn  0  6  7  7"
)
FRAMES_PER_SECOND=15
WIDTH=448

# slides NAME: what the scripted player of the game saw in its three levels, a second each.
slides() {
	local name=$1 folder=$REPO_DIR/build/pictures/$1 log=$LOG_DIR/picture_$1.log
	step "$name: the game"
	rm -rf "$folder"
	mkdir -p "$folder"
	if ! godot_windowed 600 --fixed-fps 60 --path "$PROJECT_DIR" --script res://tests/play/play_game.gd -- "--pictures=$folder" \
		>"$log" 2>&1; then
		tail -n 5 "$log" >&2
		problem "the scripted player did not win (see $log)"
		return 1
	fi
	find "$folder" -name '*.png' ! -name 'level_*' -delete
	"$BENCH_PYTHON" "$REPO_DIR/scripts/lib/animate.py" "$folder" "$REPO_DIR/docs/pictures/$name.webp" 1 "$WIDTH" 0
}

# film NAME SCENE BEGIN END [FILMED [SHOWN]]: plays the scene by the clock of its frames, and keeps what was drawn from BEGIN on.
film() {
	local name=$1 scene=$2 begin=$3 end=$4 rate=${5:-$FRAMES_PER_SECOND} shown=${6:-$FRAMES_PER_SECOND}
	local folder=$REPO_DIR/build/pictures/$name log=$LOG_DIR/picture_$name.log
	step "$name: $scene"
	rm -rf "$folder"
	mkdir -p "$folder"
	if ! godot_windowed 600 --path "$PROJECT_DIR" --resolution 960x540 --fixed-fps "$rate" \
		--write-movie "$folder/frame.png" --quit-after $((end * rate)) "$scene" >"$log" 2>&1; then
		tail -n 5 "$log" >&2
		problem "Godot could not film $scene (see $log)"
		return 1
	fi
	"$BENCH_PYTHON" "$REPO_DIR/scripts/lib/animate.py" "$folder" "$REPO_DIR/docs/pictures/$name.webp" \
		"$shown" "$WIDTH" $((begin * rate))
}

build_extension target=template_debug
find_godot
need_window
need_bench_python # its Python reads and writes pictures
import_project
mkdir -p "$REPO_DIR/docs/pictures"
for clip in "${CLIPS[@]}"; do
	read -r -a words <<<"$clip"
	[[ $# -eq 0 || " $* " == *" ${words[0]} "* ]] || continue
	film "${words[@]}"
done
[[ $# -ne 0 && " $* " != *" moonjelly "* ]] || slides moonjelly
