# shellcheck shell=bash
# SPDX-License-Identifier: MIT
# What benchmarks need: Python with SciPy for the reference and matplotlib for the charts, in an environment of its own; and
# the processor for themselves.
#
# Needs common.sh. After need_bench_python, BENCH_PYTHON is the interpreter to use.
# shellcheck disable=SC2034 # The scripts that read this one use the interpreter.

BENCH_VENV=$CACHE_DIR/bench-venv
BENCH_REQUIREMENTS=$REPO_DIR/bench/requirements.txt
BENCH_PYTHON=$BENCH_VENV/bin/python

# need_bench_python: makes the environment, and again whenever the pinned versions change.
need_bench_python() {
	need_packages python3 python3-venv || return 1
	(
		flock 9 # A second script waits here, and then finds the environment made.
		if cmp -s "$BENCH_REQUIREMENTS" "$BENCH_VENV/installed.txt" && "$BENCH_PYTHON" -c '' 2>/dev/null; then
			exit 0
		fi
		step "Installing SciPy and matplotlib into $BENCH_VENV"
		rm -rf "$BENCH_VENV"
		{ python3 -m venv "$BENCH_VENV" &&
			"$BENCH_PYTHON" -m pip install --disable-pip-version-check --only-binary :all: -r "$BENCH_REQUIREMENTS"; } \
			>"$LOG_DIR/bench_venv.log" 2>&1 </dev/null || exit 1
		cp "$BENCH_REQUIREMENTS" "$BENCH_VENV/installed.txt"
	) 9>"$BENCH_VENV.lock" && return 0
	tail -n 5 "$LOG_DIR/bench_venv.log" >&2
	problem "could not install $BENCH_REQUIREMENTS (see $LOG_DIR/bench_venv.log); with a network, run this again"
}

# first_in_line: sets BENCH_PRIORITY to the words before a command that let nothing else of this machine run in between, if
# we may have that: other programs then cost a measurement nothing. Each result says by which priority it was measured.
first_in_line() {
	BENCH_PRIORITY=()
	! chrt -f 1 true 2>/dev/null || BENCH_PRIORITY=(chrt -f 1)
	export BENCH_PRIORITY_COMMAND="${BENCH_PRIORITY[*]}"
}
