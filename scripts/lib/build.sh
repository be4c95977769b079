# shellcheck shell=bash
# SPDX-License-Identifier: MIT
# Builds the parts of the repository, and makes the demo project ready to run.
#
# Needs common.sh; import_project and check_extension need godot.sh and an engine found by it.

ADDON_EXTENSION=res://addons/soft_body_2d/soft_body_2d.gdextension

# run_scons ARGS…: SCons at the top of the repository, with a cache that outlives a `git clean`. One at a time: what SCons knows of
# files lies in one of its own.
run_scons() {
	# A fixed hash seed makes godot-cpp generate the same text in every run, so that the cache knows it again.
	(
		! command -v flock >/dev/null || flock 8
		cd "$REPO_DIR" && SCONS_CACHE=${SCONS_CACHE-$CACHE_DIR/scons} PYTHONHASHSEED=0 scons -Q "$@" 8>&-
	) 8>"$LOG_DIR/scons.lock"
}

# need_godot_cpp: fetches the submodule if its folder is empty, and says which version is used.
need_godot_cpp() {
	local commit tag
	if [[ ! -f $REPO_DIR/godot-cpp/SConstruct ]]; then
		need_packages git ca-certificates || return 1
		step "Fetching godot-cpp"
		if ! GIT_TERMINAL_PROMPT=0 limited 600 git -C "$REPO_DIR" submodule update --init --depth 1 godot-cpp \
			>"$LOG_DIR/godot_cpp.log" 2>&1; then
			grep -m 1 -E 'fatal|error' "$LOG_DIR/godot_cpp.log" >&2
			problem "godot-cpp is missing and could not be fetched; with a network, run: git submodule update --init"
			return 1
		fi
	fi
	commit=$(git -C "$REPO_DIR/godot-cpp" rev-parse --short HEAD 2>/dev/null) || commit="of unknown commit"
	tag=$(git -C "$REPO_DIR/godot-cpp" describe --tags --exact-match 2>/dev/null) || tag=
	step "godot-cpp $commit${tag:+ ($tag)}"
}

# build_extension [ARGS…]: builds the library and puts the addon into the demo project. With a folder BUILT_DIR, which ends with the
# run, once only: nothing changes meanwhile, and SCons takes seconds to say so.
build_extension() {
	local built=${BUILT_DIR:+$BUILT_DIR/built_${*//[^a-z0-9_]/.}}
	[[ ! -e ${built:-/nowhere} ]] || return 0
	need_packages scons g++ || return 1
	need_godot_cpp || return 1
	step "Building the extension"
	run_scons "$@" || { problem "the extension does not compile"; return 1; }
	# Godot loads the extensions of this list. It would write it itself, but only at the end of its first import, during
	# which our classes would be unknown to the project's scripts.
	mkdir -p "$PROJECT_DIR/.godot"
	grep -qsxF "$ADDON_EXTENSION" "$PROJECT_DIR/.godot/extension_list.cfg" ||
		echo "$ADDON_EXTENSION" >>"$PROJECT_DIR/.godot/extension_list.cfg"
	[[ -z $built ]] || : >"$built"
}

# import_project: has Godot import the project's files if any of them is new since the last time.
import_project() {
	local stamp=$PROJECT_DIR/.godot/imported_by_scripts
	if [[ -f $stamp && -z $(find "$PROJECT_DIR" \( -name .godot -o -name bin \) -prune -o -newer "$stamp" -print -quit) ]]; then
		return 0
	fi
	step "Importing the demo project"
	if ! godot_headless 300 --path "$PROJECT_DIR" --import >"$LOG_DIR/import.log" 2>&1; then
		tail -n 20 "$LOG_DIR/import.log" >&2
		problem "Godot could not import $PROJECT_DIR (see $LOG_DIR/import.log)"
		return 1
	fi
	touch "$stamp"
}

# check_extension: whether the engine really loads what was built.
check_extension() {
	if ! godot_headless 60 --path "$PROJECT_DIR" --script "$REPO_DIR/scripts/lib/extension_loaded.gd" \
		>"$LOG_DIR/extension.log" 2>&1; then
		tail -n 20 "$LOG_DIR/extension.log" >&2
		problem "Godot does not load the extension (see $LOG_DIR/extension.log)"
	fi
}

LIBRARY_FUNCTIONS='a?(sin|cos|tan)h?|atan2|sincos|hypot|exp(2|10|m1)?|log(2|10|1p)?|pow|cbrt|erfc?|[lt]gamma'
# The first is the constructor from an angle.
TURNING_FUNCTIONS='Transform2D\((float|double), |([gs]et_rotation|[gs]et_skew|rotate|rotated(_local)?|interpolate_with|looking_at|from_angle|angle(_to(_point)?)?|slerp)\('

# called_functions FOLDER: the functions of mathematics that its objects call and that libraries do not round alike; fails if there
# is none. IEEE 754 says how square roots and remainders are rounded, and floor, ldexp and the like are exact.
called_functions() {
	find "$1" -name '*.o' -exec nm -Au {} + | grep -E " U ($LIBRARY_FUNCTIONS)[fl]?\$"
}

# called_in_engine FOLDER: the same for the objects of src/godot, which may also call godot-cpp's own types: what turns by an angle
# calls a library there. Drawing may, as no step reads it, and so may the file that calls old versions for the whole library.
called_in_engine() {
	find "$1" -name '*.os' ! -path '*/drawing/*' ! -path '*/editor/*' ! -name 'soft_body_2d_drawing.os' ! -name 'old_glibc.os' \
		-exec nm -AuC {} + | sed -E 's/@.*//' |
		grep -E " U ($LIBRARY_FUNCTIONS)[fl]?\$|::(Transform2D|Vector2)::($TURNING_FUNCTIONS)"
}

# shared_names OBJECT: the functions and data of an object that other objects may hold, too, and of which the linker keeps one.
shared_names() {
	nm -C "$1" | grep -E '^[0-9a-f]* +[VWu] ' || true
}

# check_wide_object OBJECT: whether whatever the object that is compiled for AVX2 shares is named after packs of eight lanes.
check_wide_object() {
	local others
	others=$(shared_names "$1" | grep -vE 'BasicPack(Mask)?<8ul>') || return 0
	echo "$others"
	problem "$1 holds code for AVX2 that linkers may take for common code"
}

# check_wide_code FOLDER: whether that holds in a folder of objects, and no other of them has such names.
check_wide_code() {
	local wide others
	wide=$(find "$1" -name '*_avx2.o')
	check_wide_object "$wide" || return 1
	[[ -n $(shared_names "$wide") ]] || { problem "$wide holds no code for AVX2"; return 1; }
	others=$(find "$1" -name '*.o' ! -name '*_avx2.o' -exec nm -AC {} + | grep -E 'BasicPack(Mask)?<8ul>') || return 0
	echo "$others"
	problem "common code uses packs that only the code for AVX2 may use"
}
