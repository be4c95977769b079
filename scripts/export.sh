#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Exports the demo with the release template into build/export and plays it; packs the addon as build/package/*.zip, judges the
# package, and tries it in an empty project and its editor; installs first what is missing for that. The package is that of a release
# if the libraries of all platforms lie in addons/soft_body_2d/bin, else a partial one.
#
# Usage: scripts/export.sh [--seconds=N]
#   --seconds=N  plays the exported game for N simulated seconds (default 10) and prints its summary
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/lib/common.sh"
. "$REPO_DIR/scripts/lib/godot.sh"
. "$REPO_DIR/scripts/lib/build.sh"
. "$REPO_DIR/scripts/lib/export.sh"
. "$REPO_DIR/scripts/lib/package.sh"

GAME=soft_body_2d_demo
seconds=10
for argument in "$@"; do
	case $argument in
		--seconds=*) seconds=${argument#*=} ;;
		*) problem "usage: scripts/export.sh [--seconds=N]" || exit 2 ;;
	esac
done
[[ $seconds =~ ^[1-9][0-9]*$ ]] || problem "--seconds=$seconds: must be a whole number above 0" || exit 2

build_extension target=template_debug # which the editor loads while it exports
build_extension target=template_release
find_godot
step "Godot $GODOT_NAME"
import_project
step "Exporting for Linux"
export_project "$PROJECT_DIR" "$GAME"
step "Playing $seconds s of the exported game"
log=$LOG_DIR/exported_game.log
exported_game "$GAME" $((120 + 30 * seconds)) --headless --fixed-fps 60 --audio-driver Dummy -- --summary "--quit-after-seconds=$seconds" \
	>"$log" 2>&1 || { tail -n 20 "$log" >&2; problem "the exported game failed (all of its output: $log)"; }
if grep -E '^ *(USER )?(SCRIPT )?ERROR:' -A 2 "$log" >&2; then
	problem "the exported game reported the errors above (all of its output: $log)"
fi
grep -E '^SUMMARY ' "$log" || problem "the exported game printed no summary (all of its output: $log)"

step "Packing the addon"
release_tool check_versions "$REPO_DIR"
pack_addon
step "Trying it in an empty project"
unpack_into_new_project
play_as_newcomer || problem "the README's first example failed in an empty project (all of its output: $LOG_DIR/newcomer.log)"
tail -n 1 "$LOG_DIR/newcomer.log"
need_window
[[ $GODOT_NAME != *"$GODOT_ROOT"* ]] || need_packages bubblewrap
play_five_minutes || problem "the addon does not work in an editor of an empty project (all of its output: $LOG_DIR/newcomer_editor.log)"
