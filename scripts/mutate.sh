#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Breaks the core in seeded ways (a sign, a term, a bound, a condition), one at a time, and tells how many the tests notice.
#
# Usage: scripts/mutate.sh [--count N] [--seed N] [--jobs N] [--seconds N] [--near] [--only PART_OF_PATH]
#   Survivors are printed and kept in build/mutation/result.json: each is explained, or gets a test. A hundred take hours
#   on two cores, as a survivor costs a whole run of the tests; with --near, which asks only the tests of the file's own room
#   and so counts too few, a third of that. The sources are not touched.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/lib/common.sh"

need_packages python3 g++ doctest-dev
mkdir -p "$REPO_DIR/build/mutation"
exec python3 "$REPO_DIR/scripts/mutate.py" "$@"
