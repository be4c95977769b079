#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Takes the pictures of docs/editor.md from the running editor, into docs/pictures/editor. Look at each of them.
#
# Usage: scripts/editor_pictures.sh [NAME]
#   NAME  only those whose name contains it
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/lib/common.sh"
. "$REPO_DIR/scripts/lib/godot.sh"
. "$REPO_DIR/scripts/lib/build.sh"
. "$REPO_DIR/scripts/lib/editor.sh"

build_extension target=template_debug
find_godot
import_project
need_window
make_editor_project
mkdir -p "$REPO_DIR/docs/pictures/editor"
step "Taking pictures"
SOFT_BODY_2D_SHOTS=$REPO_DIR/docs/pictures/editor run_editor 300 --pictures "$@" 2>&1 | tee "$LOG_DIR/editor_pictures.log"
