#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Breaks the core in seeded ways (a sign, a term, a bound, a condition), one at a time, and tells how many the tests notice.
#
# Usage: scripts/mutate.sh [--count N] [--seed N] [--jobs N] [--seconds N] [--only PART_OF_PATH] [--near | --cheap]
#                          [--resume | --again FILE] [--run-explained]
#   Survivors are printed and kept in build/mutation/result.json: each gets a test, or an explanation in
#   scripts/mutate_equivalents.json. A mutant takes a few seconds of a core, one that survives all tests a minute: a hundred
#   take half an hour of one core. --cheap leaves out the tests that take longest, --near asks only those of the file's own
#   room: both count too few. --again asks again for what an earlier result has as survived or noticed by a hash alone.
#   The sources are not touched.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/lib/common.sh"

need_packages python3 g++ doctest-dev
mkdir -p "$REPO_DIR/build/mutation"
exec python3 "$REPO_DIR/scripts/mutate.py" "$@"
