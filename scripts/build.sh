#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds the extension into the demo project, and installs first what is missing for that.
#
# Usage: scripts/build.sh [SCons arguments]      for example: scripts/build.sh target=template_release
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/lib/common.sh"
. "$REPO_DIR/scripts/lib/godot.sh"
. "$REPO_DIR/scripts/lib/build.sh"

build_extension "$@"
step "Done: godot_project is ready to be opened in Godot"
