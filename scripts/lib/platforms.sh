# shellcheck shell=bash
# SPDX-License-Identifier: MIT
# Other processors and systems than this one: builds for them, and runs what was built by emulators.
#
# Needs common.sh, godot.sh and build.sh, and `count`, `count_doctest` and `count_engine` of scripts/test.sh. docs/platforms.md says what was run.

OWN_HASHES=$LOG_DIR/platform_own.log
PLATFORMS=(linux-arm64 linux-arm64-godot windows web macos linux-old)
ARM64_CXX=aarch64-linux-gnu-g++
WINDOWS_CXX=x86_64-w64-mingw32-g++-posix
OBJDUMP=objdump # one that knows the library's processor
LARGEST_GLIBC=2.28 # that of Godot's own builds
FOREIGN_INCLUDE=$REPO_DIR/build/foreign_include
ARM64_GODOT_ROOT=$CACHE_DIR/godot-root-arm64
# What cannot hold in an emulator: no window, and threads that end, with which user emulation loses memory.
ARM64_GODOT_WITHOUT=(test_drawing test_abuse/test_scenes_change_while_threads_run)
WEB_ROOT=$CACHE_DIR/web-root
WEB_BIN=$REPO_DIR/build/web-bin
# As Godot's own program for browsers is linked: with all of the libraries, of which the extension takes what it needs.
WEB_STUB=(-sMAIN_MODULE=1 -sWASM_BIGINT -sALLOW_MEMORY_GROWTH=1 -sEXIT_RUNTIME=1 -sNODERAWFS=1 "-sSUPPORT_LONGJMP='wasm'" -lstdc++)
HASHES_ONLY= # by test_platforms: nothing but the bits

# need_platform NAME: installs the compiler and the emulator of that platform.
need_platform() {
	case $1 in
		linux-arm64) need_packages scons g++ g++-aarch64-linux-gnu qemu-user doctest-dev ;;
		linux-arm64-godot) need_packages scons g++ g++-aarch64-linux-gnu qemu-user && need_arm64_godot ;;
		windows) need_packages scons g++ g++-mingw-w64-x86-64-posix wine doctest-dev ;;
		web) need_packages scons g++ doctest-dev && need_emscripten ;;
		*) need_packages scons g++ ;;
	esac || return 1
	# The headers of this machine's system are of no use for another one, except doctest's.
	mkdir -p "$FOREIGN_INCLUDE"
	[[ -e $FOREIGN_INCLUDE/doctest || ! -d /usr/include/doctest ]] || ln -sfn /usr/include/doctest "$FOREIGN_INCLUDE/doctest"
}

# compiler_of NAME: the compiler of that platform.
compiler_of() {
	case $1 in
		linux-arm64) echo "$ARM64_CXX" ;;
		windows) echo "$WINDOWS_CXX" ;;
		web) echo em++ ;;
	esac
}

# need_arm64_godot: Debian testing's engine for arm64 in a folder of its own, which is the root directory for the emulator.
need_arm64_godot() {
	local part=$ARM64_GODOT_ROOT.part log=$LOG_DIR/arm64_godot_install.log
	[[ ! -x $ARM64_GODOT_ROOT/usr/bin/godot ]] || return 0
	need_packages mmdebstrap debian-archive-keyring || return 1
	step "Installing Godot for arm64 into $ARM64_GODOT_ROOT (483 MB)"
	rm -rf "$part" "$ARM64_GODOT_ROOT"
	mkdir -p "$part/tmp"
	TMPDIR=$part/tmp mmdebstrap --variant=extract --mode=chrootless --architectures=arm64 --format=tar \
		--aptopt='Acquire::Check-Valid-Until "false"' --aptopt='Acquire::Retries "3"' \
		--include=godot,libgl1-mesa-dri,libegl-mesa0,libgl1,libegl1 testing - 2>"$log" </dev/null |
		tar -x --no-same-owner --exclude=./dev --exclude=./tmp -C "$part" ||
		{ problem "could not install Godot for arm64 (see $log)"; return 1; }
	rm -rf "$part/tmp"
	[[ -e $part/lib ]] || ln -s usr/lib "$part/lib"
	mv "$part" "$ARM64_GODOT_ROOT"
}

# need_emscripten: the em++ on the PATH if its library knows C++20, else that of Debian 13 in a folder of its own, which is the root
# directory for what runs in it. Debian 12's (3.1.6) is too old.
need_emscripten() {
	local part=$WEB_ROOT.part name
	if command -v em++ >/dev/null && command -v node >/dev/null && em++ --version | grep -qE ' 3\.1\.[6-9][0-9]| [4-9]\.[0-9]+\.'; then
		return 0
	fi
	need_packages mmdebstrap debian-archive-keyring bubblewrap || return 1
	if [[ ! -x $WEB_ROOT/usr/bin/em++ ]]; then
		step "Installing Debian 13's emscripten into $WEB_ROOT (2.3 GB)"
		rm -rf "$part" "$WEB_ROOT"
		mkdir -p "$part/tmp"
		TMPDIR=$part/tmp mmdebstrap --variant=extract --mode=chrootless --format=tar --include=emscripten,nodejs,dash,coreutils trixie - \
			2>"$LOG_DIR/emscripten_install.log" </dev/null | tar -x --no-same-owner --exclude=./dev --exclude=./tmp -C "$part" ||
			{ problem "could not install emscripten (see $LOG_DIR/emscripten_install.log)"; return 1; }
		for name in bin sbin lib lib64; do
			[[ -e $part/$name ]] || ln -s "usr/$name" "$part/$name"
		done
		[[ -e $part/usr/bin/sh ]] || ln -s dash "$part/usr/bin/sh"
		rm -rf "$part/tmp"
		mv "$part" "$WEB_ROOT"
	fi
	# Its own libraries are in a folder that nobody may write to, and its settings say so.
	mkdir -p "$WEB_BIN" "$CACHE_DIR/emscripten" "$WEB_ROOT"{/tmp,/dev,/proc}
	sed 's/^FROZEN_CACHE.*/FROZEN_CACHE = False/' "$WEB_ROOT/usr/share/emscripten/.emscripten" >"$CACHE_DIR/emscripten/config"
	for name in emcc em++ emar emranlib node; do
		cat >"$WEB_BIN/$name" <<-END
			#!/usr/bin/env bash
			exec bwrap --bind "$WEB_ROOT" / --dev /dev --proc /proc --bind "$REPO_DIR" "$REPO_DIR" --bind /tmp /tmp \\
				--bind "$CACHE_DIR/emscripten" "$CACHE_DIR/emscripten" --ro-bind-try /usr/include/doctest /usr/include/doctest \\
				--clearenv --setenv PATH /usr/bin --setenv HOME /tmp \${CPATH:+--setenv CPATH "\$CPATH"} \\
				--setenv EM_CONFIG "$CACHE_DIR/emscripten/config" --setenv EM_CACHE "$CACHE_DIR/emscripten/cache" \\
				--chdir "\$PWD" $name "\$@"
		END
		chmod +x "$WEB_BIN/$name"
	done
	export PATH=$WEB_BIN:$PATH
	em++ --version >"$LOG_DIR/emscripten.log" 2>&1 ||
		{ problem "Debian 13's emscripten does not run in $WEB_ROOT (see $LOG_DIR/emscripten.log)"; return 1; }
}

# with_foreign NAME COMMAND…: runs it with the settings of that platform's compiler.
with_foreign() {
	local name=$1
	shift
	(
		export "CXX=$(compiler_of "$name")" "CPATH=$FOREIGN_INCLUDE"
		"$@"
	)
}

# foreign_scons NAME TARGET…: builds programs of the core for that platform.
foreign_scons() {
	with_foreign "$1" run_scons "${@:2}"
}

# foreign_program NAME PROGRAM: the path of what foreign_scons made, relative to the repository.
foreign_program() {
	local target ending=
	target=$("$(compiler_of "$1")" -dumpmachine)
	case $1 in
		windows) ending=.exe ;;
		web) ending=.js ;;
	esac
	echo "build/$target/$2$ending"
}

# run_foreign NAME SECONDS PROGRAM ARGS…: runs a program of that platform, for that long at most. Without carriage returns.
run_foreign() {
	local name=$1 limit=$2 emulator=()
	shift 2
	case $name in
		linux-arm64) emulator=(env QEMU_LD_PREFIX=/usr/aarch64-linux-gnu qemu-aarch64) ;;
		windows) emulator=(env "WINEPREFIX=$CACHE_DIR/wine" WINEDEBUG=-all wine) ;;
		web) emulator=(node) ;;
	esac
	(cd "$REPO_DIR" && set -o pipefail && limited "$limit" "${emulator[@]}" "$@" | tr -d '\r')
}

# own_hashes LEVEL TICKS [_double]: what this machine makes of the hashed scenes by g++, in OWN_HASHES and that.
own_hashes() {
	local log=$OWN_HASHES${3:-}
	run_scons "hashes_g++_$1${3:-}" >"$log.build" 2>&1 || { problem "the core does not compile (see $log.build)"; return 1; }
	limited "$TIME_LIMIT" "$REPO_DIR/build/determinism/hashes_g++_$1${3:-}" 1 "$2" >"$log" ||
		{ problem "the scenes do not end on this machine (see $log)"; return 1; }
}

# test_hashes NAME LEVEL TICKS [_double [_nothreads]]: whether the scenes end there in the bits of own_hashes. Says so, with the hash of
# all hashes. WebAssembly with threads steps on two of them, too.
test_hashes() {
	local name=$1 program log=$LOG_DIR/platform_$1${4:-}${5:-}.log start=$SECONDS built threads=1
	program=hashes_$(compiler_of "$name")_$2${5:-}${4:-}
	[[ $name != web || -n ${5:-} ]] || threads=2
	if ! foreign_scons "$name" "$program" >"$log.build" 2>&1; then
		tail -n 5 "$log.build" >&2
		problem "the core does not compile for $name (see $log.build)"
		count 0 0 1
		return
	fi
	built=$((SECONDS - start))
	if run_foreign "$name" $((3 * TIME_LIMIT)) "$(foreign_program "$name" "determinism/$program")" $threads "$3" >"$log" &&
		cmp -s "$OWN_HASHES${4:-}" "$log"; then
		count 0 1 0
	else
		diff "$OWN_HASHES${4:-}" "$log" || true
		echo "FAILED: $name computes other bits"
		count 0 0 1
	fi
	[[ $PLATFORM_LINE != *hash* ]] || PLATFORM_LINE+=,
	PLATFORM_LINE+="${5:+ without threads}${4:+ double} hash $(sed -n 's/^all //p' "$log"), built in $built s, run in $((SECONDS - start - built)) s"
	echo "$PLATFORM_LINE"
}

# say_times NAME PROGRAM: what a tick of each hashed scene takes there on one thread, beside this machine's own program [µs]. No test.
say_times() {
	local own=$LOG_DIR/platform_times_own.log foreign=$LOG_DIR/platform_times_$1.log
	[[ -z $HASHES_ONLY ]] || return 0
	limited "$TIME_LIMIT" "$REPO_DIR/build/determinism/hashes_g++_O2" 1 240 times >"$own" || return 0
	run_foreign "$1" "$TIME_LIMIT" "$(foreign_program "$1" "determinism/$2")" 1 240 times >"$foreign" || return 0
	echo "µs a tick, one thread, the least of three runs: scene, bodies, this machine, $1, times as long"
	paste -d ' ' "$own" "$foreign" | awk '{ printf "  %-10s %4d %7d %7d %6.2f\n", $1, $2, $3, $6, $6 / $3 }'
}

# test_foreign_core NAME [OPTION…]: the tests of the core there, with options of doctest.
test_foreign_core() {
	local name=$1 log=$LOG_DIR/platform_core_$1.log start=$SECONDS status=0
	[[ -z $HASHES_ONLY ]] || return 0
	shift
	if ! foreign_scons "$name" tests_float >"$log.build" 2>&1; then
		tail -n 5 "$log.build" >&2
		problem "the tests do not compile for $name (see $log.build)"
		count 0 0 1
		return
	fi
	run_foreign "$name" $((6 * TIME_LIMIT)) "$(foreign_program "$name" tests/softbody_tests_float)" --no-colors=true "$@" \
		>"$log" 2>&1 || status=$?
	count_doctest "$status" "$log"
	PLATFORM_LINE+=", suite $(sed -nE 's/^\[doctest\] test cases: .*\| *([0-9]+) passed \| *([0-9]+) failed.*/\1 passed \2 failed/p' "$log" |
		tail -n 1), $((SECONDS - start)) s"
	echo "$PLATFORM_LINE"
}

# need_stub_host [NAME]: the program that loads the extension as Godot 4.3 would, for this machine or that platform, and the list of
# the functions that Godot 4.3 has. Sets STUB_HOST and STUB_FUNCTIONS.
need_stub_host() {
	local compiler=gcc ending= libraries=(-ldl)
	case ${1:-} in
		windows) compiler=${WINDOWS_CXX/g++/gcc} ending=.exe libraries=() ;;
		linux-arm64) compiler=${ARM64_CXX/g++/gcc} ending=.arm64 ;;
		web) compiler=emcc ending=.js libraries=("${WEB_STUB[@]}") ;;
	esac
	need_packages python3 g++ || return 1
	need_godot_cpp || return 1
	STUB_HOST=$REPO_DIR/build/stub_host$ending
	STUB_FUNCTIONS=$REPO_DIR/build/functions_of_4.3.txt
	python3 - "$REPO_DIR/godot-cpp/gdextension/gdextension_interface.json" >"$STUB_FUNCTIONS" <<-'END'
		import json, sys
		for function in json.load(open(sys.argv[1]))["interface"]:
		    if tuple(int(part) for part in function["since"].split(".")) <= (4, 3):
		        print(function["name"])
	END
	[[ -s $STUB_FUNCTIONS ]] || { problem "godot-cpp does not list the functions of Godot 4.3"; return 1; }
	"$compiler" -std=c99 -Wall -Wextra -O1 "$REPO_DIR/scripts/lib/stub_host.c" -o "$STUB_HOST" ${libraries[@]+"${libraries[@]}"} ||
		problem "the stub host does not compile"
}

# newest_glibc LIBRARY: the newest version of glibc that it asks for.
newest_glibc() {
	"$OBJDUMP" -T "$1" | grep -oE 'GLIBC_[0-9.]+' | sed 's/GLIBC_//' | sort -uV | tail -n 1
}

# test_old_glibc LIBRARY: whether it loads with the glibc that Godot's own builds ask for, by the versions of its symbols. Other
# libraries than these are not on every system.
test_old_glibc() {
	local newest others
	newest=$(newest_glibc "$1")
	others=$("$OBJDUMP" -p "$1" | sed -nE 's/^ *NEEDED +//p' | grep -vxE '(libc|libm|libpthread|libdl)\.so\.6|libgcc_s\.so\.1|ld-linux.*' || true)
	echo "$(basename "$1") asks for glibc $newest"
	if [[ -n $newest && -z $others && $(printf '%s\n' "$newest" $LARGEST_GLIBC | sort -V | tail -n 1) == "$LARGEST_GLIBC" ]]; then
		count 0 1 0
	else
		"$OBJDUMP" -T "$1" | grep -E "GLIBC_$newest\)" || true
		echo "FAILED: it needs glibc $newest, and above $LARGEST_GLIBC it would not load where Godot does${others:+; and $others}"
		count 0 0 1
	fi
}

# test_stub_host LIBRARY: whether the extension loads in a Godot 4.3.
test_stub_host() {
	if limited 60 "$STUB_HOST" "$1" "$STUB_FUNCTIONS"; then count 0 1 0; else count 0 0 1; fi
}

# What continuous integration can afford of other platforms: the bits of arm64 and Windows, and whether the library that was built
# for this machine would load in an old Godot and on an old system.
test_portable() {
	local name library
	if [[ $(uname -sm) != "Linux x86_64" ]]; then
		echo "note: only a Linux with an x86-64 processor can look at other platforms"
		count 0 0 0 1
		return
	fi
	step "Hashing scenes: this machine"
	need_packages scons g++ || return 1
	own_hashes O0 120 || return 1
	for name in linux-arm64 windows; do
		step "Hashing scenes: $name"
		PLATFORM_LINE="$name:"
		need_platform "$name" || return 1
		test_hashes "$name" O1 120
	done
	build_extension target=template_debug || return 1
	step "Loading the extension as Godot 4.3"
	need_stub_host || return 1
	need_packages binutils || return 1
	for library in "$REPO_DIR"/addons/soft_body_2d/bin/libsoft_body_2d.linux.*.x86_64.so; do
		test_stub_host "$library"
		test_old_glibc "$library"
	done
}

# test_platforms [--hashes] [NAME…]: these platforms, or all: what takes long, too. With --hashes only the bits, of those that compute some.
test_platforms() {
	local name start lines=()
	HASHES_ONLY=
	if [[ ${1:-} == --hashes ]]; then
		HASHES_ONLY=yes
		shift
		[[ $# -gt 0 ]] || set -- linux-arm64 windows web
	fi
	[[ $# -gt 0 ]] || set -- "${PLATFORMS[@]}"
	for name in "$@"; do
		[[ " ${PLATFORMS[*]} " == *" $name "* && (-z $HASHES_ONLY || ! $name =~ godot|macos|linux-old) ]] || { problem "no platform $name: ${PLATFORMS[*]}"; return 1; }
	done
	need_packages scons g++ doctest-dev || return 1
	own_hashes O2 240 || return 1
	own_hashes O2 240 _double || return 1
	for name in "$@"; do
		step "Platform $name"
		start=$SECONDS
		PLATFORM_LINE="$name:"
		if need_platform "$name"; then
			"test_on_${name//-/_}" || count 0 0 1
		else
			count 0 0 1
			PLATFORM_LINE+=" could not be prepared"
		fi
		PLATFORM_LINE+=", $((SECONDS - start)) s in all"
		lines+=("$PLATFORM_LINE")
	done
	step "Platforms"
	echo "this machine: hash $(sed -n 's/^all //p' "$OWN_HASHES"), double hash $(sed -n 's/^all //p' "${OWN_HASHES}_double")"
	printf '%s\n' "${lines[@]}"
}

# test_foreign_library NAME LIBRARY [SCONS ARGUMENTS…]: whether the release library links for that platform, and a stub host that
# answers as Godot 4.3 gets through its entry.
test_foreign_library() {
	local name=$1 library=addons/soft_body_2d/bin/$2 start=$SECONDS status=passed log=$LOG_DIR/platform_library_$2.log
	[[ -z $HASHES_ONLY ]] || return 0
	if ! CXX=$(compiler_of "$name") build_extension "${@:3}" target=template_release >"$log" 2>&1; then
		problem "the library does not link for $name (see $log)" || true
		count 0 0 1
		return
	fi
	need_stub_host "$name" || return 1
	if run_foreign "$name" 120 "$STUB_HOST" "$library" "${STUB_FUNCTIONS#"$REPO_DIR/"}"; then
		count 0 1 0
	else
		status=FAILED
		count 0 0 1
	fi
	[[ $2 != *.nothreads.* ]] || PLATFORM_LINE+=", without threads"
	PLATFORM_LINE+=", library in a stub host: $status, $((SECONDS - start)) s"
	echo "$PLATFORM_LINE"
}

# User emulation loses memory with every thread that ends, so nothing of the suites with threads.
test_on_linux_arm64() {
	local library=libsoft_body_2d.linux.template_release.arm64.so
	test_hashes linux-arm64 O2 240
	test_hashes linux-arm64 O2 240 _double
	test_foreign_core linux-arm64 '--test-suite-exclude=*threads*'
	test_foreign_library linux-arm64 "$library" platform=linux arch=arm64
	[[ -n $HASHES_ONLY ]] || OBJDUMP=aarch64-linux-gnu-objdump test_old_glibc "$REPO_DIR/addons/soft_body_2d/bin/$library"
}

# The tests of the nodes in Debian's Godot for arm64, without a window.
test_on_linux_arm64_godot() {
	local log=$LOG_DIR/platform_arm64_godot.log start=$SECONDS status=0 built version
	local GODOT_COMMAND=(qemu-aarch64 -L "$ARM64_GODOT_ROOT" "$ARM64_GODOT_ROOT/usr/bin/godot")
	CXX=$ARM64_CXX build_extension platform=linux arch=arm64 target=template_debug >"$log.build" 2>&1 ||
		{ problem "the library does not link for arm64 (see $log.build)"; return 1; }
	built=$((SECONDS - start))
	version=$(godot_version "${GODOT_COMMAND[@]}")
	import_project || return 1
	godot_headless $((9 * TIME_LIMIT)) --fixed-fps 60 --path "$PROJECT_DIR" --script res://tests/run.gd \
		-- "${ARM64_GODOT_WITHOUT[@]/#/--without=}" >"$log" 2>&1 || status=$?
	count_engine "$status" "$log"
	sed -n '/^What failed:$/,$p' "$log"
	PLATFORM_LINE+=" Godot $version, suite $(sed -nE 's/^([0-9]+) passed, ([0-9]+) failed.*/\1 passed \2 failed/p' "$log" | tail -n 1)"
	PLATFORM_LINE+=", built in $built s, run in $((SECONDS - start - built)) s"
	echo "$PLATFORM_LINE"
}

test_on_windows() {
	test_hashes windows O2 240
	test_hashes windows O2 240 _double
	test_foreign_core windows
	test_foreign_library windows libsoft_body_2d.windows.template_release.x86_64.dll platform=windows use_mingw=yes
}

# The core and the library under Node, for pages that share memory between threads, and for those that do not.
test_on_web() {
	local library=libsoft_body_2d.web.template_release.wasm32
	PLATFORM_LINE+=" emscripten $(em++ --version 2>/dev/null | sed -nE 's/.* ([0-9]+\.[0-9]+\.[0-9]+) .*/\1/p' | head -n 1),"
	test_hashes web O2 240
	test_hashes web O2 240 _double
	test_hashes web O2 240 '' _nothreads
	say_times web hashes_em++_O2_nothreads
	test_foreign_core web
	test_foreign_library web $library.nothreads.wasm platform=web threads=no
	WEB_STUB+=(-pthread)
	test_foreign_library web $library.wasm platform=web threads=yes
}

# write_zig_tool VENV COMMAND PATH: a program that calls Zig's compiler for macOS, without the flag that names a processor once more.
write_zig_tool() {
	local target='-target aarch64-macos'
	[[ $2 == c* ]] || target=
	cat >"$3" <<-END
		#!/usr/bin/env bash
		arguments=()
		while [[ \$# -gt 0 ]]; do
			if [[ \$1 == -arch ]]; then shift; else arguments+=("\$1"); fi
			shift
		done
		exec "$1/bin/python" -m ziglang $2 $target "\${arguments[@]}"
	END
	chmod +x "$3"
}

# Linked only: there is nothing here that runs it. Python's package of Zig brings the compiler.
test_on_macos() {
	local start=$SECONDS venv=$CACHE_DIR/ziglang wrappers=$REPO_DIR/build/zig tool
	need_packages python3-venv || return 1
	"$venv/bin/python" -m ziglang version >/dev/null 2>&1 || { python3 -m venv "$venv" && "$venv/bin/pip" install -q ziglang==0.13.0.post1; } ||
		{ problem "could not install ziglang"; return 1; }
	# godot-cpp looks for the tools of OSXCross by these names.
	mkdir -p "$wrappers/target/bin"
	for tool in clang:cc clang++:c++ ar:ar ranlib:ranlib as:cc; do
		write_zig_tool "$venv" "${tool#*:}" "$wrappers/target/bin/arm64-apple-darwin16-${tool%:*}"
	done
	if OSXCROSS_ROOT=$wrappers build_extension platform=macos arch=arm64 target=template_release >"$LOG_DIR/platform_macos.log" 2>&1; then
		count 0 1 0
		PLATFORM_LINE+=" linked only, $((SECONDS - start)) s"
	else
		count 0 0 1
		PLATFORM_LINE+=" does not link (see $LOG_DIR/platform_macos.log), $((SECONDS - start)) s"
	fi
}

# The release library in the oldest Debian that can still be had: its loader and its libraries.
test_on_linux_old() {
	local start=$SECONDS root=$CACHE_DIR/old-linux library lib usr
	lib=$root/lib/x86_64-linux-gnu usr=$root/usr/lib/x86_64-linux-gnu
	need_packages mmdebstrap debian-archive-keyring binutils || return 1
	build_extension target=template_release || return 1
	need_stub_host || return 1
	library=$REPO_DIR/addons/soft_body_2d/bin/libsoft_body_2d.linux.template_release.x86_64.so
	test_old_glibc "$library"
	if [[ ! -e $lib/ld-2.31.so ]]; then
		rm -rf "$root"
		mkdir -p "$root"
		mmdebstrap --variant=extract --mode=chrootless --format=tar --include=libc6,libc6-dev,libgcc-s1 bullseye - \
			2>"$LOG_DIR/platform_old.log" </dev/null | tar -x --no-same-owner --exclude=./dev -C "$root" ||
			{ problem "could not install an old Debian (see $LOG_DIR/platform_old.log)"; return 1; }
	fi
	# Linked with the old libraries, and with the threads that every Godot has. A compiler given a sysroot would still find the new ones.
	gcc -O1 -fno-pie -no-pie -nostdlib "$REPO_DIR/scripts/lib/stub_host.c" "$usr"/crt[1i].o -Wl,--allow-shlib-undefined,--no-as-needed "$lib"/lib{dl.so.2,pthread.so.0,c.so.6} \
		"$usr/libc_nonshared.a" "$usr/crtn.o" -o "$STUB_HOST.old" || { problem "the stub host does not link with an old glibc"; return 1; }
	if limited 60 "$lib/ld-2.31.so" --library-path "$lib:$usr" "$STUB_HOST.old" "$library" "$STUB_FUNCTIONS"; then
		count 0 1 0
		PLATFORM_LINE+=" loads with glibc 2.31"
	else
		count 0 0 1
		PLATFORM_LINE+=" does not load with glibc 2.31"
	fi
	PLATFORM_LINE+=", asks for $(newest_glibc "$library"), $((SECONDS - start)) s"
}
