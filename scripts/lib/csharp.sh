# shellcheck shell=bash
# SPDX-License-Identifier: MIT
# The addon's C# classes: made from the class reference, compiled by Mono's compiler, and run against a stand-in for Godot's assembly.
#
# Needs common.sh, and `count` of scripts/test.sh. No .NET SDK comes with Debian's packages, and a Godot with .NET neither; docs/csharp.md
# says what that leaves open.

CSHARP_DIR=$REPO_DIR/build/csharp
# Of the standard that Mono's compiler knows; Godot's is newer and takes all of it.
CSHARP_COMPILER=(mcs -langversion:7.2 -warnaserror)

# compile_csharp OUTPUT ARGS…: leaves what the compiler says in $LOG_DIR/csharp.log.
compile_csharp() {
	mkdir -p "$CSHARP_DIR"
	(cd "$REPO_DIR" && limited 300 "${CSHARP_COMPILER[@]}" "-out:$1" "${@:2}") >"$LOG_DIR/csharp.log" 2>&1 ||
		{ cat "$LOG_DIR/csharp.log" >&2; return 1; }
}

# refuses_wrong_csharp: whether the compiler refuses what the types exclude: the stand-in must not take everything.
refuses_wrong_csharp() {
	local wrong
	for wrong in 'body.Integrator = 7' 'body.Mass = "heavy"' 'body.YoungModulus = 3' 'body.ContactStarted += () => {}' 'body.Inertia = 1' \
		'SoftBody2D other = new Node2D()' 'body.Cut(new Vector2(), 3)'; do
		printf 'using Godot; using SoftBodies; class Wrong { void Try(SoftBody2D body) { %s; } }\n' "$wrong" >"$CSHARP_DIR/Wrong.cs"
		if compile_csharp "$CSHARP_DIR/wrong.dll" -t:library "$CSHARP_DIR/Wrong.cs" "-r:$CSHARP_DIR/addon.dll" 2>/dev/null; then
			problem "the compiler takes: $wrong"
			return 1
		fi
	done
}

# test_csharp: the classes are those of the class reference, compile with the example, and ask the engine by its names.
test_csharp() {
	local log=$LOG_DIR/tests_csharp.log status=0 summary
	need_packages python3 mono-mcs mono-runtime libmono-system-xml-linq4.0-cil || return 1
	mkdir -p "$CSHARP_DIR"
	step "C#: as the class reference has it"
	if python3 -B "$REPO_DIR/scripts/lib/make_csharp.py" --check "$REPO_DIR"; then count 0 1 0; else count 0 0 1; fi
	step "C#: compiling the addon's classes, the example and those of docs/csharp.md"
	if compile_csharp "$CSHARP_DIR/addon.dll" -t:library 'addons/soft_body_2d/csharp/*.cs' 'tests/csharp/stub/*.cs'; then
		count 0 1 0
	else
		count 0 0 1
		return
	fi
	if compile_csharp "$CSHARP_DIR/example.dll" -t:library 'examples/csharp/*.cs' "-r:$CSHARP_DIR/addon.dll"; then count 0 1 0; else count 0 0 1; fi
	if python3 -B "$REPO_DIR/scripts/lib/csharp_snippets.py" "$REPO_DIR/docs/csharp.md" "$CSHARP_DIR/Page.cs" &&
		compile_csharp "$CSHARP_DIR/page.dll" -t:library "$CSHARP_DIR/Page.cs" "-r:$CSHARP_DIR/addon.dll"; then
		count 0 1 0
	else
		count 0 0 1
	fi
	if refuses_wrong_csharp; then count 0 1 0; else count 0 0 1; fi
	step "C#: running the claims"
	compile_csharp "$CSHARP_DIR/claims.exe" tests/csharp/Claims.cs "-r:$CSHARP_DIR/addon.dll" -r:System.Xml.Linq.dll ||
		{ count 0 0 1; return; }
	limited 300 mono "$CSHARP_DIR/claims.exe" "$REPO_DIR/doc_classes" >"$log" 2>&1 || status=$?
	grep FAILED "$log" >&2 || true
	summary=$(sed -nE 's/^([0-9]+) passed, ([0-9]+) failed$/\1 \2/p' "$log")
	tail -n 1 "$log"
	# shellcheck disable=SC2086 # Two numbers, or none if the program did not reach its end.
	count "$status" $summary
}
