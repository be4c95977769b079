#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Runs the Godot engine that the other scripts use.
#
# Usage: scripts/godot.sh ARGS…      for example: scripts/godot.sh --editor --path godot_project
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/lib/common.sh"
. "$REPO_DIR/scripts/lib/godot.sh"

find_godot
case " $* " in
	*" --headless "* | *" --version "* | *" --help "* | *" -h "*) exec "${GODOT_COMMAND[@]}" "$@" ;;
	*) need_window && godot_windowed 0 "$@" ;;
esac
