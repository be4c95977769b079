# shellcheck shell=bash
# SPDX-License-Identifier: MIT
# Runs parts of scripts/test.sh side by side: one that compiles or simulates keeps a processor busy while Godot does the same with another.
#
# shellcheck disable=SC2034 # build.sh reads BUILT_DIR.
#
# Needs common.sh and build.sh, and `passed`, `failed` and `skipped` of scripts/test.sh.

LANE_DIR=$LOG_DIR/lanes
FAILED_PARTS=()

# run_part NAME: runs that part in a process of its own, with what it prints in a file. Leaves its three counts and its seconds in another.
run_part() {
	local start=$SECONDS
	(
		passed=0 failed=0 skipped=0
		"test_$1" || failed=$((failed + 1))
		end_step
		echo "$passed $failed $skipped $((SECONDS - start))" >"$LANE_DIR/$1.counts"
	) >"$LANE_DIR/$1.log" 2>&1 || true
}

# end_part NAME: shows what that part has printed, and adds its counts.
end_part() {
	local more_passed more_failed more_skipped seconds
	cat "$LANE_DIR/$1.log"
	if [[ -s $LANE_DIR/$1.counts ]]; then
		read -r more_passed more_failed more_skipped seconds <"$LANE_DIR/$1.counts"
	else
		problem "the part $1 did not reach its end" || true
		more_passed=0 more_failed=1 more_skipped=0 seconds='?'
	fi
	echo "==> Part $1: $more_passed passed, $more_failed failed, $more_skipped skipped, $seconds s"
	passed=$((passed + more_passed))
	failed=$((failed + more_failed))
	skipped=$((skipped + more_skipped))
	[[ $more_failed -eq 0 ]] || FAILED_PARTS+=("$1")
}

# show_failures: what failed once more, at the end: in the middle of thousands of lines nobody finds it. Lines that begin with ERROR are
# not meant: Godot prints them for errors that tests provoke on purpose.
show_failures() {
	local name lines
	for name in ${FAILED_PARTS[@]+"${FAILED_PARTS[@]}"}; do
		echo "==> Failed in part $name:"
		lines=$(grep -E '^FAILED|^error:|^FAIL: |^[^ ]+\.(cpp|h):[0-9]+: (FATAL )?ERROR' "$LANE_DIR/$name.log" | awk '!seen[$0]++' | head -n 20 | cut -c1-400) || true
		if [[ -n $lines ]]; then echo "$lines"; else tail -n 20 "$LANE_DIR/$name.log" | cut -c1-400; fi
	done
}

# begin_lanes: from here on a library is built once only.
begin_lanes() {
	rm -rf "$LANE_DIR"
	mkdir -p "$LANE_DIR"
	BUILT_DIR=$LANE_DIR # of build_extension
}

# run_lanes "PART…"…: the parts of each lane one after the other, the lanes at the same time. Prints a part as a whole, once it has ended.
run_lanes() {
	local lane part name running=() pending=("$@") waiting=yes
	for lane in "$@"; do
		(
			for part in $lane; do
				run_part "$part"
				: >"$LANE_DIR/$part.ended"
			done
		) &
		running+=($!)
	done
	while [[ -n $waiting ]]; do
		waiting=
		for lane in "${!pending[@]}"; do
			for name in ${pending[$lane]}; do
				[[ -e $LANE_DIR/$name.ended ]] || { waiting=yes; break; }
				end_part "$name"
				pending[lane]=${pending[$lane]#"$name"}
				pending[lane]=${pending[$lane]# }
			done
		done
		[[ -z $waiting ]] || sleep 1
	done
	wait "${running[@]}"
}
