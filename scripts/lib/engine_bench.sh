# shellcheck shell=bash
# SPDX-License-Identifier: MIT
# Measures nodes in an exported game: the release library under the release template, as players get it.
#
# Needs common.sh, build.sh, godot.sh, export.sh, and of bench.sh first_in_line.

BENCH_PROJECT=$REPO_DIR/build/engine_bench
BENCH_GAME=soft_body_2d_bench

# measure_engine QUICK: leaves build/bench/engine_release.json.
measure_engine() {
	local rows=$REPO_DIR/build/bench/engine_release.json log=$LOG_DIR/engine_bench.log quick=$1 load
	local headless=() drawn=() crowd=()
	mkdir -p "$(dirname "$rows")"
	build_extension target=template_debug || return 1 # which the editor loads while it exports
	build_extension target=template_release || return 1
	cp "$REPO_DIR"/build/extension.*.template_release.*.flags "$REPO_DIR/build/bench/engine_release.flags"
	find_godot || return 1
	step "Godot $GODOT_NAME"

	rm -rf "$BENCH_PROJECT"
	cp -r "$REPO_DIR/bench/engine" "$BENCH_PROJECT"
	cp -r "$PROJECT_DIR/addons" "$BENCH_PROJECT/"
	mkdir -p "$BENCH_PROJECT/.godot"
	echo "$ADDON_EXTENSION" >"$BENCH_PROJECT/.godot/extension_list.cfg"
	godot_headless 300 --path "$BENCH_PROJECT" --import >"$LOG_DIR/engine_bench_import.log" 2>&1 ||
		{ problem "Godot could not import the bench (see $LOG_DIR/engine_bench_import.log)"; return 1; }
	export_project "$BENCH_PROJECT" "$BENCH_GAME" || return 1

	for load in soft soft_unseen soft_apart; do
		headless+=(hold "$load")
	done
	headless+=(hold rigid)
	drawn+=(hold soft hold soft_unseen)
	for load in soft soft_unseen soft_apart soft_alone soft_monitored soft_asleep; do
		headless+=(cost "$load" 1000)
	done
	headless+=(cost soft_resting 10000 cost soft_resting 200000)
	crowd=(crowd 1000 crowd 10000)
	for load in soft soft_unseen soft_asleep soft_off_screen soft_off_screen_still; do
		drawn+=(cost "$load" 1000)
	done
	drawn+=(cost soft_resting 10000)
	if [[ $quick == yes ]]; then
		headless=(cost soft 300 cost soft_unseen 300 cost soft_asleep 300)
		drawn=(cost soft 300)
		crowd=(crowd 1000)
	fi
	step "Measuring without a window"
	: >"$log"
	measure_rows 1800 "$log" --headless -- "${headless[@]}" || return 1
	measure_rows 300 "$log" --headless -- "${crowd[@]}" || return 1 # in a process that has freed nothing yet
	step "Measuring in a window"
	with_screen measure_rows 1800 "$log" -- "${drawn[@]}" || return 1
	{
		echo '{"rows": ['
		sed -nE 's/^ROW (\{.*\})[[:space:]]*$/\1/p' "$log" | paste -sd ,
		echo ']}'
	} >"$rows"
}

# measure_rows SECONDS LOG ARGS…: runs the exported bench and adds what it says to the log.
measure_rows() {
	local limit=$1 log=$2
	shift 2
	if ! with_priority exported_game "$BENCH_GAME" "$limit" --fixed-fps 60 --audio-driver Dummy "$@" >>"$log" 2>&1 ||
		grep -E '^ *(USER )?(SCRIPT )?ERROR:' -A 2 "$log" >&2; then
		tail -n 5 "$log" >&2
		problem "the bench failed (all of its output: $log)"
	fi
}

# with_priority COMMAND…: runs one of our functions, and all that it starts, as first_in_line allows.
with_priority() (
	[[ ${#BENCH_PRIORITY[@]} -eq 0 ]] || chrt -f -p 1 "$BASHPID" || return 1
	"$@"
)
