#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds and runs the tests, and installs first what is missing for that; the last line is the result:
# "N passed, N failed", and ", N skipped" if some could not be done on this machine.
#
# Usage: scripts/test.sh             what to run after a change: core, engine, editor and game, without what takes longest; says
#                                    what it leaves out
#        scripts/test.sh all         all parts up to portable but levels: what continuous integration runs. First the core; then those that only compile and
#                                    simulate run beside those that run Godot; what a part prints comes as a whole, once it has ended
#        scripts/test.sh PART
#   core         only the tests of the simulation core, which need neither Godot nor godot-cpp
#   engine       only the tests inside of Godot
#   levels       the tests inside of Godot once more, with bodies that change their level every ten ticks; arguments after it are the
#                filters of godot_project/tests/run.gd
#   editor       only the tests of the editor addon in a real editor, which no one sees if there is no screen
#   game         only the scripted player, who has to win the game; leaves pictures in build/game
#   export       the exported demo, and the tests of the nodes in an exported release
#   newcomer     a newcomer's first five minutes in a real editor: empty project, unzip, enable, a body, a floor, play, a material,
#                drag a point, play, export; any warning or error on the way fails it; filmed into build/newcomer
#   package      what judges a release; newcomer; the packed addon without the editor, and every example of the documentation
#   csharp       the addon's C# classes: as the class reference has them, compiled by Mono's compiler and Microsoft's and run
#                against a stand-in for Godot; `all` does so by Mono's alone, as the other is a download of 190 MB
#   quick        sanitize and determinism, each without what takes longest; says what it leaves out
#   portable     whether scenes end in the same bits on arm64 and Windows, by emulators; whether the extension would load in a
#                Godot 4.3 and with an old glibc
#   sanitize     the core under AddressSanitizer and UndefinedBehaviorSanitizer, and what uses threads under ThreadSanitizer
#   determinism  whether gcc and clang, at -O0, -O2 and -O3, on one to eight threads, compute the same bits
#   leaks        the tests inside of Godot once more, with the extension under AddressSanitizer, UndefinedBehaviorSanitizer
#                and LeakSanitizer; arguments after it are the filters of godot_project/tests/run.gd
#   platforms    portable, with all tests of the core, for more platforms: linux-arm64, windows, web, macos, linux-old; and
#                linux-arm64-godot, the tests of the nodes in a Godot for arm64. Arguments after it choose among them, and --hashes
#                before them leaves everything out but the bits. docs/platforms.md says how long each takes
# All from sanitize on build the core anew for each variant: some minutes each, on two cores, the first time.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/lib/common.sh"
. "$REPO_DIR/scripts/lib/godot.sh"
. "$REPO_DIR/scripts/lib/build.sh"
. "$REPO_DIR/scripts/lib/csharp.sh"
. "$REPO_DIR/scripts/lib/editor.sh"
. "$REPO_DIR/scripts/lib/export.sh"
. "$REPO_DIR/scripts/lib/lanes.sh"
. "$REPO_DIR/scripts/lib/package.sh"
. "$REPO_DIR/scripts/lib/platforms.sh"
. "$REPO_DIR/scripts/lib/sanitized.sh"

TIME_LIMIT=600
SLOW_SUITES='*slow*' # of doctest: what takes longest, or does so under AddressSanitizer, through code that other tests run, too
# Suites that run once more with the physics server on a thread of its own. Of the others, those that put a question to the
# engine itself in the tick in which they add something cannot hold there: the engine does not know it yet.
PHYSICS_THREAD_SUITES=(test_soft_floors test_found_by_shape test_rigid_bodies test_driven_bodies test_one_way test_areas test_joints
	test_resting test_contacts test_characters test_cuts)
# Suites that an exported release cannot run: of warnings that it does not give, of documents that it does not hold, of the editor,
# of drawing without a window, and of the demo's panels, whose containers report connections of their own in Godot's release template.
DEBUG_SUITES=" test_class test_class_reference test_damaged_scenes test_drawing test_drawing_debug test_drawing_default_look test_drawing_looks
	test_drawing_seen test_drawing_smoothness test_editor_conversion test_editor_logic test_editor_stability test_editor_tracing
	test_former_names test_godot_audit test_laboratory test_scenes "
passed=0
failed=0
skipped=0
QUICK=

# count STATUS PASSED FAILED [SKIPPED]: adds the result of one program. One that ends badly without a failed test, or that ran
# no test at all, counts as one failure.
count() {
	local status=$1 more_passed=${2:-0} more_failed=${3:-0} more_skipped=${4:-0}
	if [[ $more_failed -eq 0 && ($status -ne 0 || $((more_passed + more_skipped)) -eq 0) ]]; then
		problem "the tests ended with status $status after $more_passed passed tests" || true
		more_failed=1
	fi
	passed=$((passed + more_passed))
	failed=$((failed + more_failed))
	skipped=$((skipped + more_skipped))
}

# What exported games load, for the parts that need it later.
test_release_library() {
	build_extension target=template_release
}

# The core, as two programs: in single and in double precision. What runs after a change is the first, without the slow suites.
test_core() {
	local programs=(float double) options=(--no-colors=true) real log running=()
	need_packages scons g++ doctest-dev || return 1
	if [[ -n $QUICK ]]; then
		programs=(float)
		options+=("--test-suite-exclude=$SLOW_SUITES")
	fi
	test_rooms
	step "Building the tests of the core"
	run_scons "${programs[@]/#/tests_}" || { problem "the core or its tests do not compile"; return 1; }
	[[ -n $QUICK ]] || test_bench
	test_wide_code
	test_own_functions
	[[ -z $QUICK ]] || say_slow float
	step "Testing the core: ${programs[*]}"
	for real in "${programs[@]}"; do
		run_core "$real" "${options[@]}" & # Both at once, as neither keeps two cores busy.
		running+=($!)
	done
	wait "${running[@]}"
	for real in "${programs[@]}"; do
		log=$LOG_DIR/tests_core_$real.log
		echo "$real:"
		cat "$log"
		count_doctest "$(cat "$LOG_DIR/tests_core_$real.status")" "$log"
	done
}

# The benchmarks compile and link: some of them run only when somebody asks for them.
test_bench() {
	need_packages nlohmann-json3-dev || return 1
	step "Building the benchmarks"
	if run_scons bench_links; then count 0 1 0; else count 0 0 1; fi
}

# run_core NAME [OPTION…]: the tests of the core in that precision. What they print and their status are left in files.
run_core() {
	local status=0 log=$LOG_DIR/tests_core_$1
	(cd "$REPO_DIR" && limited $((2 * TIME_LIMIT)) "build/tests/softbody_tests_$1" "${@:2}") >"$log.log" 2>&1 || status=$?
	echo "$status" >"$log.status"
}

# test_rooms: the folders of src include one another in one direction. A folder within a room of the core belongs to it. The prelude is in no
# room: no file includes it, the compiler reads it in front of each.
test_rooms() {
	local includes circles
	includes=$(cd "$REPO_DIR" && grep -roE '^#include "(core|godot|thesis)/[^"]*"' src --include='*.h' --include='*.cpp' --exclude=prelude.h |
		sed -E 's|^src/||; s|:#include "| |; s|[^ /]*\.h"$||; s|/[^ /]* |/ |; s|(core/[a-z]+/)[a-z]+/|\1|g' |
		awk '$1 != $2' | sort -u)
	if [[ -n $includes ]] && circles=$(tsort <<<"$includes" 2>&1 >/dev/null); then
		count 0 1 0
	else
		echo "folders that include one another: $circles" >&2
		count 1 0 1
	fi
}

# The core calls no function of a library of mathematics that rounds as it likes: it has its own (core/base/elementary.h).
test_own_functions() {
	local calls
	step "Functions of mathematics"
	if calls=$(called_functions "$REPO_DIR/build/tests/softbody_tests_float.objects/src/core"); then
		echo "calls of a library whose last digit may differ: $calls" >&2
		count 1 0 1
	else
		count 0 1 0
	fi
}

# Nor do the nodes, in what a step reads of Godot: the direction of a transform, a capsule's outline.
test_own_turns() {
	local folder calls
	step "Functions of mathematics between Godot and the core"
	folder=$(find "$REPO_DIR/build" -maxdepth 1 -name 'extension.*.template_debug.*' -type d ! -name '*_sanitized' -print -quit)
	if [[ -z $(find "${folder:-/nowhere}/src/godot" -name '*.os' -print -quit 2>/dev/null) ]]; then
		count 0 0 0 1 # a compiler whose objects are called otherwise
	elif calls=$(called_in_engine "$folder/src/godot"); then
		echo "calls of a library whose last digit may differ: $calls" >&2
		count 1 0 1
	else
		count 0 1 0
	fi
}

# Common code must not be what the one file that is compiled for AVX2 holds, in whatever order objects are linked.
test_wide_code() {
	local compiler level object
	step "Names of the code for AVX2"
	if [[ $(uname -sm) != "Linux x86_64" ]]; then
		count 0 0 0 1
		return
	fi
	if check_wide_code "$REPO_DIR/build/tests/softbody_tests_float.objects"; then count 0 1 0; else count 0 0 1; fi
	[[ -z $QUICK ]] || return 0
	need_packages clang || return 1
	for compiler in g++ clang++; do
		for level in O2 O3; do
			object=$LOG_DIR/wide_$compiler$level.o
			if $compiler -std=c++20 -ffp-contract=off -fno-math-errno -Wno-psabi -mavx2 -$level -I "$REPO_DIR/src" -c \
				"$REPO_DIR/src/core/dynamics/lane_stepper_avx2.cpp" -o "$object" && check_wide_object "$object"; then
				count 0 1 0
			else
				count 0 0 1
			fi
		done
	done
}

# say_slow NAME: the test cases of that program that are left out.
say_slow() {
	echo "note: these tests are left out:"
	"$REPO_DIR/build/tests/softbody_tests_$1" --no-colors=true --no-version=true --list-test-cases \
		"--test-suite=$SLOW_SUITES" | grep -v '^\[doctest\]\|^===' | sed 's/^/  /'
}

# count_doctest STATUS LOG: adds the result of one run of doctest. A test case that ended by SKIP_TEST (tests/support/skip.h)
# has passed for doctest, whose own word "skipped" means those that were not asked for.
count_doctest() {
	local summary more_passed more_failed more_skipped
	# [doctest] test cases:  57 |  56 passed | 1 failed | 0 skipped
	summary=$(sed -nE 's/^\[doctest\] test cases: .*\| *([0-9]+) passed \| *([0-9]+) failed.*/\1 \2/p' "$2" | tail -n 1)
	read -r more_passed more_failed <<<"${summary:-0 0}" # no numbers if the program did not reach its end
	more_skipped=$(grep -cE ' MESSAGE: skipped: ' "$2") || true
	[[ -n $summary ]] || more_skipped=0
	count "$1" $((more_passed - more_skipped)) "$more_failed" "$more_skipped"
}

# What runs with all tests: the sanitizers and compilers without what takes longest.
test_quick() {
	QUICK=1
	test_sanitize || return 1
	test_determinism
}

# The same program by every compiler and at every level of optimization: what they print must be alike.
test_determinism() {
	local variants=(g++_O2 g++_O0 g++_O3 clang++_O0 clang++_O2 clang++_O3) variant name status first= arguments=()
	need_packages scons g++ clang || return 1
	if [[ -n $QUICK ]]; then
		variants=(g++_O0 clang++_O3) # each compiler, and both ends of optimization; tests/dynamics/test_golden.cpp adds g++ -O2
		arguments=(2 60) # threads and ticks: without optimization, eight and 240 take ten minutes
		echo "note: g++ -O2 and -O3 and clang++ -O0 and -O2 are left out, and more than 2 threads and 60 ticks;" \
			"scripts/test.sh determinism has them"
	fi
	step "Building what hashes scenes: ${variants[*]}"
	name=$LOG_DIR/hashes.build.log
	run_scons "${variants[@]/#/hashes_}" >"$name" 2>&1 || { problem "the core does not compile (see $name)"; return 1; }
	for variant in "${variants[@]}"; do
		name=hashes_$variant
		step "Hashing scenes: ${variant/_/ -}"
		status=0
		limited $((6 * TIME_LIMIT)) "$REPO_DIR/build/determinism/$name" ${arguments[@]+"${arguments[@]}"} >"$LOG_DIR/$name.log" ||
			status=$?
		[[ -n $first || $status -ne 0 ]] || first=$LOG_DIR/$name.log
		if [[ $status -ne 0 ]]; then
			cat "$LOG_DIR/$name.log"
			echo "FAILED: ${variant/_/ -} ended with status $status (124: after its time was up)"
			count 0 0 1
		elif cmp -s "$first" "$LOG_DIR/$name.log"; then
			count 0 1 0
		else
			diff "$first" "$LOG_DIR/$name.log" || true
			echo "FAILED: ${variant/_/ -} computes other bits"
			count 0 0 1
		fi
	done
	[[ -z $first ]] || cat "$first"
}

test_sanitize() {
	local name running options=()
	need_packages scons g++ doctest-dev || return 1
	step "Building the tests of the core with sanitizers"
	run_scons tests_address tests_thread || { problem "the core or its tests do not compile"; return 1; }
	if [[ -n $QUICK ]]; then
		say_slow address
		echo "note: scripts/test.sh sanitize has them; the suite \"threads\" runs with the thread sanitizer only"
		options+=("--test-suite-exclude=$SLOW_SUITES,*threads*")
	fi
	step "Testing the core with sanitizers"
	run_sanitized_core address "${options[@]}" & # Both at once, as neither keeps two cores busy.
	running=$!
	run_sanitized_core thread "--test-suite=*threads*"
	wait $running
	for name in address thread; do
		step "The $name sanitizer"
		cat "$LOG_DIR/tests_$name.log"
		count_doctest "$(cat "$LOG_DIR/tests_$name.status")" "$LOG_DIR/tests_$name.log"
	done
}

# run_sanitized_core NAME [OPTION…]: the tests compiled with that sanitizer, with options of doctest. What they print and their
# status are left in files.
run_sanitized_core() {
	local name=$1 log=$LOG_DIR/tests_$1.log status=0 plainly=()
	shift
	# Where addresses are thrown far apart, GCC's sanitizers find no room for their own memory.
	! setarch -R true 2>/dev/null || plainly=(setarch -R)
	(
		cd "$REPO_DIR"
		export ASAN_OPTIONS=detect_leaks=1 UBSAN_OPTIONS=print_stacktrace=1 TSAN_OPTIONS=halt_on_error=1
		limited 3600 "${plainly[@]}" "build/tests/softbody_tests_$name" --no-colors=true "$@"
	) >"$log" 2>&1 || status=$?
	echo "$status" >"$LOG_DIR/tests_$name.status"
}

# The nodes and resources, in the engine.
test_engine() {
	local log=$LOG_DIR/tests_engine.log status=0
	build_extension target=template_debug || return 1
	test_own_turns
	find_godot || return 1
	step "Godot $GODOT_NAME"
	import_project || return 1
	check_extension || return 1
	step "Testing in Godot"
	godot_headless $((3 * TIME_LIMIT)) --fixed-fps 60 --path "$PROJECT_DIR" --script res://tests/run.gd -- --without=test_drawing 2>&1 |
		tee "$log" || status=$?
	count_engine "$status" "$log"

	# The same with a physics server that has its queue emptied on a thread of its own.
	step "Testing in Godot, physics on a thread of its own"
	log=$LOG_DIR/tests_physics_thread.log status=0
	with_physics_thread godot_headless $((3 * TIME_LIMIT)) --fixed-fps 60 --path "$PROJECT_DIR" --script res://tests/run.gd \
		-- "${PHYSICS_THREAD_SUITES[@]}" 2>&1 | tee "$log" || status=$?
	count_engine "$status" "$log"

	step "Quitting while pieces of cut bodies wait for their modes"
	log=$LOG_DIR/tests_quit.log status=0
	godot_headless 60 --fixed-fps 60 --path "$PROJECT_DIR" --script res://tests/quit/quit_after_cuts.gd 2>&1 | tee "$log" || status=$?
	count_engine "$status" "$log"

	# What is drawn can only be looked at in a window; without a screen, in one that nobody sees.
	need_window || return 1
	step "Testing in Godot, what is drawn"
	log=$LOG_DIR/tests_drawing.log status=0
	godot_windowed $((2 * TIME_LIMIT)) --fixed-fps 60 --path "$PROJECT_DIR" --script res://tests/run.gd -- test_drawing 2>&1 |
		tee "$log" || status=$?
	count_engine "$status" "$log"
}

# What bodies do does not depend on their level: everything but the tests of levels themselves holds while it changes all the time.
test_levels() {
	local log=$LOG_DIR/tests_levels.log status=0
	build_extension target=template_debug || return 1
	find_godot || return 1
	import_project || return 1
	check_extension || return 1
	step "Testing in Godot, levels changing every ten ticks"
	godot_headless $((3 * TIME_LIMIT)) --fixed-fps 60 --path "$PROJECT_DIR" --script res://tests/run.gd -- --levels --without=test_levels "$@" 2>&1 |
		tee "$log" || status=$?
	count_engine "$status" "$log"
}

# with_physics_thread COMMAND…: runs it with that project setting.
with_physics_thread() {
	local override=$PROJECT_DIR/override.cfg status=0
	printf '[physics]\n\n2d/run_on_separate_thread=true\n' >"$override"
	"$@" || status=$?
	rm -f "$override"
	return $status
}

# The same tests with an extension in which every access is looked at, and at the end what of its memory nobody holds.
test_leaks() {
	local log=$LOG_DIR/tests_leaks.log status=0
	build_extension target=template_debug || return 1
	build_extension target=template_debug sanitizers=$LEAK_SANITIZERS || return 1
	find_godot || return 1
	import_project || return 1
	make_sanitized_project || return 1
	step "Testing in Godot with sanitizers"
	run_sanitized $((6 * TIME_LIMIT)) --script res://tests/run.gd -- "$@" 2>&1 | tee "$log" || status=$?
	count_engine "$status" "$log"
	step "What the sanitizers found"
	if judge_findings; then
		count 0 1 0
	else
		count 0 0 1
	fi
}

# The editor addon, in an editor that is driven by made-up input.
test_editor() {
	local log=$LOG_DIR/tests_editor.log status=0
	build_extension target=template_debug || return 1
	find_godot || return 1
	import_project || return 1
	need_window || return 1
	make_editor_project || return 1
	step "Testing in Godot's editor"
	run_editor $((2 * TIME_LIMIT)) 2>&1 | tee "$log" || status=$?
	count_engine "$status" "$log"
}

# The game, played from the menu to the win by a script that presses keys and buttons and moves the mouse.
test_game() {
	local log=$LOG_DIR/tests_game.log pictures=$REPO_DIR/build/game status=0
	build_extension target=template_debug || return 1
	find_godot || return 1
	import_project || return 1
	need_window || return 1
	rm -rf "$pictures"
	mkdir -p "$pictures"
	step "Playing the game"
	godot_windowed $((2 * TIME_LIMIT)) --fixed-fps 60 --path "$PROJECT_DIR" --script res://tests/play/play_game.gd \
		-- "--pictures=$pictures" 2>&1 | tee "$log" || status=$?
	count_engine "$status" "$log"
}

# The demo as players get it: exported with the release template it does the same as in the editor, to the last digit.
test_export() {
	local options=(--headless --fixed-fps 60 --audio-driver Dummy) seconds=5 editor exported
	build_extension target=template_debug || return 1
	build_extension target=template_release || return 1
	find_godot || return 1
	import_project || return 1
	step "Exporting the demo"
	export_project "$PROJECT_DIR" soft_body_2d_demo || return 1
	step "Testing the exported demo"
	editor=$(summary_of "$LOG_DIR/demo_in_editor.log" limited 300 "${GODOT_COMMAND[@]}" --path "$PROJECT_DIR" "${options[@]}" \
		-- --summary --quit-after-seconds=$seconds) || return 1
	exported=$(summary_of "$LOG_DIR/demo_exported.log" exported_game soft_body_2d_demo 300 "${options[@]}" \
		-- --summary --quit-after-seconds=$seconds) || return 1
	echo "exported: $exported"
	if [[ $editor == "$exported" ]]; then
		count 0 1 0
	else
		echo "FAILED: in the editor: $editor"
		count 0 0 1
	fi

	# What the nodes promise, in a release as players get it.
	local log=$LOG_DIR/tests_exported.log status=0 suites=() suite
	step "Exporting the tests"
	export_tests soft_body_2d_tests || return 1
	for suite in "$PROJECT_DIR"/tests/test_*.gd; do
		suite=$(basename "$suite" .gd)
		[[ $DEBUG_SUITES == *[[:space:]]$suite[[:space:]]* ]] || suites+=("$suite/")
	done
	step "Testing in an exported release"
	exported_game soft_body_2d_tests $((3 * TIME_LIMIT)) "${options[@]}" -- "${suites[@]}" 2>&1 | tee "$log" || status=$?
	count_engine "$status" "$log"
	step "Testing in an exported release, physics on a thread of its own"
	log=$LOG_DIR/tests_exported_thread.log status=0
	printf '[physics]\n\n2d/run_on_separate_thread=true\n' >"$EXPORT_DIR/soft_body_2d_tests/override.cfg"
	exported_game soft_body_2d_tests $((3 * TIME_LIMIT)) "${options[@]}" -- "${PHYSICS_THREAD_SUITES[@]}" 2>&1 | tee "$log" || status=$?
	count_engine "$status" "$log"
}

# A newcomer's path: what is packed works in an empty project, and so does every example of the documentation.
test_package() {
	local status=0
	build_extension target=template_debug || return 1
	build_extension target=template_release || return 1
	find_godot || return 1
	test_release
	step "Packing the addon"
	if pack_addon; then count 0 1 0; else count 0 0 1; fi
	[[ -s $PACKAGE ]] || return 1
	step "Unpacking it into an empty project"
	unpack_into_new_project || return 1
	play_as_newcomer || status=$?
	grep 'lowest point' "$LOG_DIR/newcomer.log" || tail -n 5 "$LOG_DIR/newcomer.log"
	count_engine "$status" "$LOG_DIR/newcomer.log"
	play_newcomer
	step "Running the documentation's examples"
	status=0
	run_snippets || status=$?
	tail -n 1 "$LOG_DIR/snippets.log"
	count_engine "$status" "$LOG_DIR/snippets.log"
}

# play_newcomer: the five minutes of play_five_minutes, counted. Each warning and error on the way fails it.
play_newcomer() {
	local status=0
	step "A newcomer's first five minutes in an editor"
	need_window || return 1
	[[ $GODOT_NAME != *"$GODOT_ROOT"* ]] || need_packages bubblewrap || return 1
	play_five_minutes || status=$?
	grep -E '^FAILED|lowest point' "$LOG_DIR/newcomer_editor.log" || true
	count_engine "$status" "$LOG_DIR/newcomer_editor.log"
}

# The same alone: packs the addon, and plays from an empty project to an exported game.
test_newcomer() {
	build_extension target=template_debug || return 1
	build_extension target=template_release || return 1
	find_godot || return 1
	step "Packing the addon"
	if pack_addon; then count 0 1 0; else count 0 0 1; fi
	[[ -s $PACKAGE ]] || return 1
	play_newcomer
}

# What judges a release: packages and versions that are broken in each way are refused, and this repository's versions agree.
test_release() {
	local log=$LOG_DIR/tests_release.log status=0 ran wrong
	need_packages python3 || return 1
	step "Testing what judges a release"
	(cd "$REPO_DIR/tests/release" && limited $TIME_LIMIT python3 -B -W error -m unittest discover -p 'test_*.py') >"$log" 2>&1 || status=$?
	ran=$(sed -nE 's/^Ran ([0-9]+) tests? in .*/\1/p' "$log")
	wrong=$(sed -nE 's/^FAILED \((.*)\)$/\1/p' "$log" | grep -oE '[0-9]+' | paste -sd+) || true
	[[ $status -eq 0 ]] || cat "$log" >&2
	count "$status" $((${ran:-0} - ${wrong:-0})) $((${wrong:-0}))
}

# summary_of LOG COMMAND…: what the demo sums up, without what a clock had a part in; fails if it reports an error.
summary_of() {
	local log=$1
	shift
	"$@" >"$log" 2>&1 || { tail -n 20 "$log" >&2; problem "the demo failed (all of its output: $log)"; return 1; }
	if grep -E '^ *(USER )?(SCRIPT )?ERROR:' -A 2 "$log" >&2; then
		problem "the demo reported the errors above (all of its output: $log)"
		return 1
	fi
	sed -nE 's/^SUMMARY (\{.*\})[[:space:]]*$/\1/p' "$log" | sed -E 's/"mean_step_us":[0-9.]+,//' | grep . ||
		problem "the demo printed no summary (all of its output: $log)"
}

# count_engine STATUS LOG: adds the result of one run in the engine.
count_engine() {
	local summary
	summary=$(sed -nE 's/^([0-9]+) passed, ([0-9]+) failed(, ([0-9]+) skipped)?$/\1 \2 \4/p' "$2" | tail -n 1)
	# shellcheck disable=SC2086 # Two or three numbers, or none if the program did not reach its end.
	count "$1" $summary
}

after_change=
parts=()
case ${1:-} in
	'') after_change=yes QUICK=1 parts=(core engine editor game) ;;
	core | engine | levels | editor | game | export | newcomer | package | csharp | quick | portable | sanitize | determinism | leaks | platforms) parts=("$1") ;;
	--sanitize | --determinism) parts=("${1#--}") ;;
	all) ;;
	*) problem "usage: scripts/test.sh [all|core|engine|levels|editor|game|export|newcomer|package|csharp|quick|portable|sanitize|determinism|leaks|platforms]" || exit 2 ;;
esac
shift $(($# > 0))
if [[ ${#parts[@]} -eq 0 ]]; then
	begin_lanes
	run_part core # first, as it needs neither Godot nor godot-cpp
	end_part core
	if build_extension target=template_debug; then
		run_lanes "release_library csharp_by_mono quick portable" "engine editor game export package"
	else
		failed=$((failed + 1))
	fi
fi
for part in ${parts[@]+"${parts[@]}"}; do
	"test_$part" "$@" || failed=$((failed + 1))
done
end_step
show_failures
if [[ -n $after_change ]]; then
	echo "note: left out are the core in double precision and its slow tests, export, package, C#, sanitizers, determinism" \
		"and other platforms; scripts/test.sh all has them"
fi
result="$passed passed, $failed failed"
[[ $skipped -eq 0 ]] || result+=", $skipped skipped"
echo "$result"
[[ $failed -eq 0 ]]
