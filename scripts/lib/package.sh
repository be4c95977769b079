# shellcheck shell=bash
# SPDX-License-Identifier: MIT
# Packs the addon for users, judges what was packed, and walks a newcomer's path with it.
#
# Needs common.sh, godot.sh, build.sh and export.sh, and for the newcomer an engine found by find_godot.

PACKAGE_DIR=$REPO_DIR/build/package
NEWCOMER_DIR=$REPO_DIR/build/newcomer_project
FIVE_MINUTES_DIR=$REPO_DIR/build/five_minutes
FILM_DIR=$REPO_DIR/build/newcomer

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

# play_five_minutes: in an editor that opens an empty project: unzip, enable, add a body and a floor, play, pick a material, drag a
# point, play; then export, and play what was exported. The screen is filmed into build/newcomer. Leaves "N passed, N failed" in
# $LOG_DIR/newcomer_editor.log; fails also if anything on the way gave a warning or an error.
play_five_minutes() {
	local log=$LOG_DIR/newcomer_editor.log home=$REPO_DIR/build/newcomer_home frames=$REPO_DIR/build/newcomer_screen film= status=0
	rm -rf "$home" "$FIVE_MINUTES_DIR" "$FILM_DIR" "$frames"
	mkdir -p "$FIVE_MINUTES_DIR/addons/newcomer" "$home" "$FILM_DIR" "$frames"
	cp "$REPO_DIR/scripts/lib/newcomer_plugin.gd" "$FIVE_MINUTES_DIR/addons/newcomer/"
	printf '[plugin]\n\nname="Newcomer"\ndescription=""\nauthor=""\nversion="1"\nscript="newcomer_plugin.gd"\n' \
		>"$FIVE_MINUTES_DIR/addons/newcomer/plugin.cfg"
	cat >"$FIVE_MINUTES_DIR/project.godot" <<-'END'
		config_version=5

		[application]

		config/name="Newcomer"
		config/features=PackedStringArray("GL Compatibility")

		[audio]

		driver/driver="Dummy"

		[editor_plugins]

		enabled=PackedStringArray("res://addons/newcomer/plugin.cfg")

		[rendering]

		renderer/rendering_method="gl_compatibility"
		renderer/rendering_method.mobile="gl_compatibility"
	END
	if ! has_screen; then
		python3 "$REPO_DIR/scripts/lib/film_screen.py" "$frames/Xvfb_screen0" "$LOG_DIR/newcomer_step.txt" "$FILM_DIR" &
		film=$!
	fi
	(
		rm -f "$LOG_DIR/newcomer_step.txt"
		export XDG_CONFIG_HOME=$home/config XDG_DATA_HOME=$home/data XDG_CACHE_HOME=$home/cache SCREEN_OPTIONS="-fbdir $frames" SCREEN_SIZE=1600x900
		with_screen run_five_minutes
	) >"$log" 2>&1 || status=$?
	[[ -z $film ]] || kill "$film"
	no_errors_in "$log" && return $status
}

# editor_that_starts_games ARGS…: the engine, such that it can start itself again as a game. Our own is started by the loader of its
# libraries, which the editor would take for the engine; so it gets its folder as its root.
editor_that_starts_games() {
	if [[ $GODOT_NAME != *"$GODOT_ROOT"* ]]; then
		"${GODOT_COMMAND[@]}" "$@"
		return
	fi
	bwrap --bind "$GODOT_ROOT" / --dev-bind /dev /dev --proc /proc --bind /tmp /tmp --bind "$REPO_DIR" "$REPO_DIR" \
		--unsetenv LD_LIBRARY_PATH /usr/bin/godot --rendering-driver opengl3 "$@"
}

# run_five_minutes: what play_five_minutes does on a screen.
run_five_minutes() {
	local status=0 options=(--audio-driver Dummy)
	editor_that_starts_games "${options[@]}" --single-window --resolution 1600x900 --position 0,0 \
		--path "$FIVE_MINUTES_DIR" --editor -- "--package=$PACKAGE" "--step-file=$LOG_DIR/newcomer_step.txt" ||
		status=$?
	rm -rf "$FIVE_MINUTES_DIR/addons/newcomer"
	sed -i 's|"res://addons/newcomer/plugin.cfg", ||; s|, "res://addons/newcomer/plugin.cfg"||' "$FIVE_MINUTES_DIR/project.godot"
	sed '/^\[preset.1\]/,$d' "$PROJECT_DIR/export_presets.cfg" >"$FIVE_MINUTES_DIR/export_presets.cfg"
	echo exported >"$LOG_DIR/newcomer_step.txt"
	export_project "$FIVE_MINUTES_DIR" newcomer || status=1
	exported_game newcomer 60 "${options[@]}" --max-fps 60 --quit-after 240 || status=1
	godot_headless 60 --path "$FIVE_MINUTES_DIR" --fixed-fps 60 --script "$REPO_DIR/scripts/lib/newcomer.gd" \
		-- res://main.tscn >"$LOG_DIR/newcomer_rests.log" 2>&1 || status=1
	grep 'lowest point' "$LOG_DIR/newcomer_rests.log" || { cat "$LOG_DIR/newcomer_rests.log"; status=1; }
	return $status
}

# run_snippets: every example of the documentation, in the newcomer's project. Leaves "N passed, 0 failed" in
# $LOG_DIR/snippets.log.
run_snippets() {
	local log=$LOG_DIR/snippets.log
	godot_headless 300 --path "$NEWCOMER_DIR" --fixed-fps 60 --script "$REPO_DIR/scripts/lib/run_snippets.gd" -- res://snippets \
		>"$log" 2>&1 && no_errors_in "$log"
}

# What the engine says of a machine without a graphics card and a desktop, and of a root without certificates.
MACHINE_MESSAGES='xdg-user-dir|X509CertificateMbedTLS file|Could not set V-Sync mode|Required extension VK_KHR_surface not found|rendering_context_driver_vulkan.cpp'

# messages_in LOG: every warning and error, a line each, with the place in the engine that gave it.
messages_in() {
	awk 'function end() { if (message != "") print message; message = "" }
		/^ *(USER )?(SCRIPT )?(ERROR|WARNING):/ { end(); message = $0; next }
		message != "" { if ($1 == "at:") message = message " " $0; end() }
		END { end() }' "$1"
}

# no_errors_in LOG: shows what the engine complained about.
no_errors_in() {
	if messages_in "$1" | grep -vE "$MACHINE_MESSAGES" >&2; then
		problem "the engine complained (all of its output: $1)"
	fi
}
