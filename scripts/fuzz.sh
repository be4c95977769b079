#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Fuzzes the core with libFuzzer, AddressSanitizer and UndefinedBehaviorSanitizer; installs first what is missing for that.
#
# Usage: scripts/fuzz.sh SECONDS [TARGET…]
#   SECONDS  for each target; 0 only replays the corpus
#   TARGET   shape, state, geometry, world or cut (tests/fuzz); default: all of them, one after the other
# What is found new stays in build/fuzz/corpus. Bytes that break a claim are kept in build/fuzz: give them to the program
# build/fuzz/fuzz_TARGET to see what happens, mend it, and write a test of it into tests/fuzz/test_fuzz.cpp.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/lib/common.sh"
. "$REPO_DIR/scripts/lib/build.sh"

ALL_TARGETS=(shape state geometry world cut)
BUILD_DIR=$REPO_DIR/build/fuzz

if [[ ! ${1:-} =~ ^[0-9]+$ ]]; then
	problem "usage: scripts/fuzz.sh SECONDS [TARGET…], where TARGET is one of: ${ALL_TARGETS[*]}" || exit 2
fi
seconds=$1
shift
targets=("$@")
[[ $# -gt 0 ]] || targets=("${ALL_TARGETS[@]}")
for target in "${targets[@]}"; do
	[[ " ${ALL_TARGETS[*]} " == *" $target "* ]] || problem "no such target: $target; there are ${ALL_TARGETS[*]}" || exit 2
done

need_packages scons clang
# Debian 12 keeps the sanitizers' libraries apart, in a package named after the compiler's version.
version=$(clang++ -dumpversion)
need_packages "libclang-rt-${version%%.*}-dev"

step "Building the fuzzers"
run_scons fuzz || problem "the core or its fuzzers do not compile" || exit 1

# What keeps a run fast: short stacks of what was allocated, and little that was freed kept from use.
export ASAN_OPTIONS=malloc_context_size=2:quarantine_size_mb=16${ASAN_OPTIONS:+:$ASAN_OPTIONS}
total=0
broken=()
for target in "${targets[@]}"; do
	step "Fuzzing $target for $seconds s"
	log=$LOG_DIR/fuzz_$target.log
	mkdir -p "$BUILD_DIR/corpus/$target"
	options=(-print_final_stats=1 -max_len=400 -timeout=60 -rss_limit_mb=4096 "-artifact_prefix=$BUILD_DIR/$target-")
	if [[ $seconds -gt 0 ]]; then
		options+=("-max_total_time=$seconds")
	else
		options+=(-runs=0)
	fi
	folders=("$BUILD_DIR/corpus/$target")
	[[ ! -d $REPO_DIR/tests/fuzz/corpus/$target ]] || folders+=("$REPO_DIR/tests/fuzz/corpus/$target")
	"$BUILD_DIR/fuzz_$target" "${options[@]}" "${folders[@]}" >"$log" 2>&1 || broken+=("$target")
	count=$(sed -nE 's/^stat::number_of_executed_units: *([0-9]+)/\1/p' "$log")
	echo "$target: ${count:-0} executions"
	total=$((total + ${count:-0}))
	grep -E 'what\(\):|runtime error|SUMMARY|Test unit written' "$log" || true
done
echo "$total executions, ${#broken[@]} targets broken${broken:+: ${broken[*]}}"
[[ ${#broken[@]} -eq 0 ]]
