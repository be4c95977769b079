#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Measures, prints a table and keeps the full result in bench/results; installs first what is missing for that.
#
# Usage: scripts/bench.sh NAME [--json] [--quick]
#   work-precision  error against an independent reference, time and force evaluations of every integrator; their orders
#   stability       the largest stable stiffness and step of every integrator, measured and in theory
#   energy          the energy of a wobbling body over time
#   recovery        which models find back to their shape from strong deformations
#   auto            random bodies under the automatic choice of integrator and substeps
#   table-4-1       the thesis's table: how many of its bodies a step of 1/60 s holds, with and without collisions
#   pile            piles between walls: time, penetration, folded bodies, rest
#   scaling         step time from 100 to 100,000 bodies, by phase, and what a second thread saves
#   contact-accuracy friction, restitution and momentum against theory; penetration against time; scenes of the field
#   contact-books   where contacts gain or lose energy, height, way or rest, against theory; part of it fails today
#   stress          scenes made to break bodies, under every method at 30 to 240 ticks a second
#   soak            ten simulated hours: drift at rest, memory, bodies lost; with --quick, a third of an hour
#   model           outlines under every elastic model against finite elements, and what they cost; independence of the mesh
#   heap            heaps of nodes at their default values: folded bodies, sleep, time
#   dents           dents over tick rates and elastic models; random cuts against brute force, and what a cut costs
#   detail          outlines of hundreds of points simulated as drawn and by few points: error of the outline, time; changes of the
#                   level in motion, refinement where a body bends, a crowd of 3,000
#   rollback        states of whole worlds: what they cost; two peers over a bad network who roll back and agree
#   peers           piles in other engines, Box2D 2 and 3 and Chipmunk, against ours; scripts/lib/peers.sh says where from
#   engine          nodes in an exported game: how many hold 60 ticks per second, and where their time goes
#   editor          the editor addon's handlers: dragging, painting, drawing, tracing a picture
#   --json   with the result as one JSON object in the last line
#   --quick  fewer cases, within 60 s; its result goes to build/bench/quick_results and leaves the full one alone
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/lib/common.sh"
. "$REPO_DIR/scripts/lib/build.sh"
. "$REPO_DIR/scripts/lib/bench.sh"

names=(work-precision stability energy recovery auto table-4-1 pile scaling contact-accuracy contact-books stress soak model heap dents detail rollback peers engine editor)
name=
for argument in "$@"; do
	case $argument in
		--json | --quick) ;;
		-*) name= && break ;;
		*)
			[[ -z $name && " ${names[*]} " == *" $argument "* ]] || { name= && break; }
			name=$argument
			;;
	esac
done
if [[ -z $name ]]; then
	problem "usage: scripts/bench.sh NAME [--json] [--quick], where NAME is one of: ${names[*]}" || exit 2
fi

need_packages scons g++ nlohmann-json3-dev
need_bench_python
first_in_line
if [[ $name == engine ]]; then
	. "$REPO_DIR/scripts/lib/godot.sh"
	. "$REPO_DIR/scripts/lib/export.sh"
	. "$REPO_DIR/scripts/lib/engine_bench.sh"
	quick=no
	[[ " $* " != *" --quick "* ]] || quick=yes
	measure_engine "$quick"
elif [[ $name == editor ]]; then
	. "$REPO_DIR/scripts/lib/godot.sh"
	. "$REPO_DIR/scripts/lib/editor.sh"
	measure_editor
else
	step "Building the benchmarks"
	if [[ $name == peers ]]; then
		. "$REPO_DIR/scripts/lib/peers.sh"
		build_peers
	else
		run_scons bench || problem "the core or its benchmarks do not compile"
	fi
	step "Measuring $name"
fi
exec "$BENCH_PYTHON" "$REPO_DIR/bench/bench.py" "$@"
