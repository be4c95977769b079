#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Draws docs/charts from the results that scripts/bench.sh keeps in bench/results.
#
# Usage: scripts/charts.sh [RESULT.json]      default: the result of this machine, else the newest one
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/lib/common.sh"
. "$REPO_DIR/scripts/lib/bench.sh"

need_bench_python
step "Drawing docs/charts"
exec "$BENCH_PYTHON" "$REPO_DIR/bench/charts.py" "$@"
