# shellcheck shell=bash
# SPDX-License-Identifier: MIT
# Exports the demo project and runs what was exported.
#
# Needs common.sh, godot.sh and build.sh, and an engine found by find_godot.

EXPORT_DIR=$REPO_DIR/build/export
EXPORT_HOME=$CACHE_DIR/export-home

# need_templates: makes sure that the engine has export templates of its own version.
need_templates() {
	local version folder
	version=$(godot_version "${GODOT_COMMAND[@]}")
	# 4.6.3.stable.debian4.6.3+ds-2 and 4.6.3.stable.official.abcdef are both looked for in 4.6.3.stable.
	version=$(grep -oE '^[0-9.]+\.(stable|rc[0-9]*|beta[0-9]*|dev[0-9]*)' <<<"$version")
	if [[ $GODOT_NAME != *"$GODOT_ROOT"* ]]; then
		folder=${XDG_DATA_HOME:-$HOME/.local/share}/godot/export_templates/$version
		[[ $(uname -s) != Linux || -f $folder/linux_release.x86_64 ]] ||
			problem "no export templates in $folder: install them in the editor by Editor → Manage Export Templates"
		return
	fi
	folder=$EXPORT_HOME/godot/export_templates/$version
	mkdir -p "$folder"
	ln -sfn "$GODOT_ROOT/usr/bin/godot-template-release" "$folder/linux_release.x86_64"
	ln -sfn "$GODOT_ROOT/usr/bin/godot-template-debug" "$folder/linux_debug.x86_64"
	export XDG_DATA_HOME=$EXPORT_HOME
}

# export_project PROJECT GAME: exports for Linux with the release template, as the program GAME in $EXPORT_DIR/GAME/.
# Godot keeps the scenes that it exported as long as their files stay the same, but what is in them depends on the extension, too.
export_project() {
	local project=$1 game=$2 log=$LOG_DIR/export_$2.log status=0
	rm -rf "${EXPORT_DIR:?}/$game" "${project:?}/.godot/exported"
	mkdir -p "$EXPORT_DIR/$game"
	(need_templates && godot_headless 600 --path "$project" --export-release Linux "$EXPORT_DIR/$game/$game" >"$log" 2>&1) ||
		status=$?
	if [[ $status -ne 0 || ! -s $EXPORT_DIR/$game/$game.pck ]] || grep -qE '^ERROR' "$log"; then
		grep -E 'ERROR' -A 2 "$log" >&2
		tail -n 5 "$log" >&2
		problem "Godot could not export $project (see $log)"
		return 1
	fi
}

# export_tests GAME: exports a copy of the demo project that runs its tests instead of the game.
export_tests() {
	local project=$REPO_DIR/build/exported_tests
	rm -rf "$project"
	cp -r "$PROJECT_DIR" "$project"
	rm -rf "$project/tests/editor"
	printf 'class_name ExportedTests\nextends "res://tests/run.gd"\n' >"$project/tests/exported_tests.gd"
	printf '[gd_scene format=3]\n\n[node name="Empty" type="Node"]\n' >"$project/tests/empty.tscn"
	sed -i 's|^exclude_filter="tests/\*"|exclude_filter=""|' "$project/export_presets.cfg"
	sed -i 's|^run/main_scene=.*|run/main_scene="res://tests/empty.tscn"\nrun/main_loop_type="ExportedTests"|' "$project/project.godot"
	godot_headless 300 --path "$project" --import >"$LOG_DIR/exported_tests_import.log" 2>&1 ||
		{ problem "Godot could not import the tests (see $LOG_DIR/exported_tests_import.log)"; return 1; }
	export_project "$project" "$1"
}

# exported_game GAME SECONDS ARGS…: runs what export_project made, for that long at most.
exported_game() {
	local folder=$EXPORT_DIR/$1 game=$1 limit=$2
	shift 2
	if [[ $GODOT_NAME != *"$GODOT_ROOT"* ]]; then
		limited "$limit" "$folder/$game" "$@"
		return
	fi
	# The template of our own engine needs the libraries it was built with, so their loader starts it. A game looks for
	# its files beside the program that was started, under its name without the ending: so the loader lies there, too.
	cp "$GODOT_LIBRARIES/ld-linux-x86-64.so.2" "$folder/$game.loader"
	limited "$limit" "${GODOT_ENVIRONMENT[@]}" "$folder/$game.loader" "${GODOT_LIBRARY_PATH[@]}" "$folder/$game" "$@"
}
