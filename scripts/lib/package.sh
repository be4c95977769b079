# shellcheck shell=bash
# SPDX-License-Identifier: MIT
# Packs the addon for users, judges what was packed, and walks a newcomer's path with it.
#
# Needs common.sh, godot.sh and build.sh, and for the newcomer an engine found by find_godot.

PACKAGE_DIR=$REPO_DIR/build/package
NEWCOMER_DIR=$REPO_DIR/build/newcomer

# release_tool NAME ARGS…: a Python program of scripts/lib.
release_tool() {
	python3 -B "$REPO_DIR/scripts/lib/$1.py" "${@:2}"
}

# pack_addon: packs the addon with whatever libraries have been built, judges the package, and sets PACKAGE to it. With those of all
# platforms it is soft_body_2d-VERSION.zip, else soft_body_2d-VERSION-partial.zip.
pack_addon() {
	local partial=()
	need_packages python3 || return 1
	rm -rf "$PACKAGE_DIR"
	PACKAGE=$(release_tool pack_addon --partial "$REPO_DIR" "$PACKAGE_DIR") || return 1
	echo "$PACKAGE"
	[[ $PACKAGE != *-partial.zip ]] || partial=(--partial)
	release_tool check_package ${partial[@]+"${partial[@]}"} "$PACKAGE" || problem "$PACKAGE may not go out as it is"
}

# unpack_into_new_project: a project as the editor's "New Project" makes it, with the package unpacked into it.
unpack_into_new_project() {
	rm -rf "$NEWCOMER_DIR"
	mkdir -p "$NEWCOMER_DIR/.godot"
	printf 'config_version=5\n\n[application]\n\nconfig/name="Newcomer"\n' >"$NEWCOMER_DIR/project.godot"
	python3 -m zipfile -e "$PACKAGE" "$NEWCOMER_DIR" || return 1
	# The editor writes this when it first sees the addon. A first import without it may crash at its end (Godot 123511).
	echo res://addons/soft_body_2d/soft_body_2d.gdextension >"$NEWCOMER_DIR/.godot/extension_list.cfg"
}

# play_as_newcomer: the README's first example in the new project; the body must come to rest on the floor. Leaves the last
# line of the check, "1 passed, 0 failed", in $LOG_DIR/newcomer.log.
play_as_newcomer() {
	local log=$LOG_DIR/newcomer.log
	mkdir -p "$NEWCOMER_DIR/snippets"
	python3 "$REPO_DIR/scripts/lib/snippets.py" "$REPO_DIR" "$NEWCOMER_DIR/snippets" || return 1
	mv "$NEWCOMER_DIR/snippets/first.gd" "$NEWCOMER_DIR/main.gd"
	cat >"$NEWCOMER_DIR/main.tscn" <<-'END'
		[gd_scene load_steps=2 format=3]

		[ext_resource type="Script" path="res://main.gd" id="1"]

		[node name="Main" type="Node2D"]
		script = ExtResource("1")
	END
	{
		godot_headless 300 --path "$NEWCOMER_DIR" --import &&
			godot_headless 120 --path "$NEWCOMER_DIR" --fixed-fps 60 --quit-after 120 res://main.tscn &&
			godot_headless 120 --path "$NEWCOMER_DIR" --fixed-fps 60 --script "$REPO_DIR/scripts/lib/newcomer.gd" -- res://main.tscn
	} >"$log" 2>&1 && no_errors_in "$log"
}

# enable_as_newcomer: an editor of the new project, in which the addon is switched on, off and on. Leaves "N passed, 0 failed" in
# $LOG_DIR/newcomer_editor.log.
enable_as_newcomer() {
	local log=$LOG_DIR/newcomer_editor.log home=$REPO_DIR/build/newcomer_home
	rm -rf "$home"
	mkdir -p "$NEWCOMER_DIR/addons/newcomer" "$home"
	cp "$REPO_DIR/scripts/lib/newcomer_plugin.gd" "$NEWCOMER_DIR/addons/newcomer/"
	printf '[plugin]\n\nname="Newcomer"\ndescription=""\nauthor=""\nversion="1"\nscript="newcomer_plugin.gd"\n' \
		>"$NEWCOMER_DIR/addons/newcomer/plugin.cfg"
	printf '[gd_scene format=3]\n\n[node name="Main" type="Node2D"]\n\n[node name="Body" type="SoftBody2D" parent="."]\n' >"$NEWCOMER_DIR/body.tscn"
	printf '\n[editor_plugins]\n\nenabled=PackedStringArray("res://addons/newcomer/plugin.cfg")\n' >>"$NEWCOMER_DIR/project.godot"
	XDG_CONFIG_HOME=$home/config XDG_DATA_HOME=$home/data XDG_CACHE_HOME=$home/cache \
		godot_headless 300 --path "$NEWCOMER_DIR" --editor >"$log" 2>&1 && no_errors_in "$log"
}

# run_snippets: every example of the documentation, in the newcomer's project. Leaves "N passed, 0 failed" in
# $LOG_DIR/snippets.log.
run_snippets() {
	local log=$LOG_DIR/snippets.log
	godot_headless 300 --path "$NEWCOMER_DIR" --fixed-fps 60 --script "$REPO_DIR/scripts/lib/run_snippets.gd" -- res://snippets \
		>"$log" 2>&1 && no_errors_in "$log"
}

# no_errors_in LOG: shows what the engine complained about.
no_errors_in() {
	if grep -E '^ *(USER )?(SCRIPT )?(ERROR|WARNING):' -A 2 "$1" >&2; then
		problem "the engine complained (all of its output: $1)"
	fi
}
