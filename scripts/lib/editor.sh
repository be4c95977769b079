# shellcheck shell=bash
# SPDX-License-Identifier: MIT
# Runs the real editor on a copy of the demo project, driven by made-up input.
#
# Needs common.sh, godot.sh and an engine found by it.

EDITOR_DIR=$REPO_DIR/build/editor_project

# make_editor_project: a fresh copy with the test plugin enabled. The editor may write into it; the project stays.
make_editor_project() {
	rm -rf "$EDITOR_DIR"
	mkdir -p "$EDITOR_DIR"
	cp -R "$PROJECT_DIR/." "$EDITOR_DIR/" || return 1
	# What the editor of an earlier run, or the user's own, remembers would change what is seen.
	rm -rf "$EDITOR_DIR/.godot/editor" "$REPO_DIR/build/editor_home"
	sed -i 's|^enabled=PackedStringArray(.*|enabled=PackedStringArray("res://addons/soft_body_2d/plugin.cfg", "res://tests/editor/plugin.cfg")|' \
		"$EDITOR_DIR/project.godot"
	grep -q 'tests/editor/plugin.cfg' "$EDITOR_DIR/project.godot" || problem "project.godot enables no plugins"
}

# run_editor SECONDS ARGS…: the editor in that copy, with settings of its own.
run_editor() {
	local limit=$1 home=$REPO_DIR/build/editor_home
	shift
	mkdir -p "$home/config" "$home/data" "$home/cache"
	XDG_CONFIG_HOME=$home/config XDG_DATA_HOME=$home/data XDG_CACHE_HOME=$home/cache \
		godot_windowed "$limit" --path "$EDITOR_DIR" --editor -- --editor-tests "$@"
}

# measure_editor: leaves build/bench/editor_debug.json. Needs build.sh.
measure_editor() {
	local rows=$REPO_DIR/build/bench/editor_debug.json log=$LOG_DIR/editor_bench.log
	mkdir -p "$(dirname "$rows")"
	build_extension target=template_debug || return 1 # the editor loads no other
	cp "$REPO_DIR"/build/extension.*.template_debug.*.flags "$REPO_DIR/build/bench/editor_debug.flags"
	find_godot || return 1
	import_project || return 1
	need_window || return 1
	make_editor_project || return 1
	step "Measuring in Godot's editor"
	run_editor 600 --bench >"$log" 2>&1 || { tail -n 5 "$log" >&2; problem "the bench failed (all of its output: $log)"; return 1; }
	{
		echo '{"rows": ['
		sed -nE 's/^ROW (\{.*\})[[:space:]]*$/\1/p' "$log" | paste -sd ,
		echo ']}'
	} >"$rows"
}
