# shellcheck shell=bash
# SPDX-License-Identifier: MIT
# What all scripts share: the folders, messages, and the installation of missing Debian packages.
# shellcheck disable=SC2034 # The scripts that read this one use the folders.

REPO_DIR=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
PROJECT_DIR=$REPO_DIR/godot_project
LOG_DIR=$REPO_DIR/build/logs
CACHE_DIR=${XDG_CACHE_HOME:-${HOME:?is not set, and the downloads are kept below it}/.cache}/soft_body_2d
mkdir -p "$LOG_DIR" "$CACHE_DIR"

# step TEXT: says how long what happened until now took, and what happens now.
step() {
	end_step
	STEP_START=$SECONDS
	printf '==> %s\n' "$*"
}

# end_step: says how long the step took that is under way, if there is one.
end_step() {
	[[ -z ${STEP_START:-} ]] || printf '    %d s\n' $((SECONDS - STEP_START))
	STEP_START=
}

# problem TEXT: says in one line what is wrong and how to mend it, and returns 1.
problem() {
	printf 'error: %s\n' "$*" >&2
	return 1
}

# has_package NAME: whether the thing that we want from that Debian package is here, wherever it came from.
has_package() {
	case $1 in
		g++) command -v "${CXX:-g++}" >/dev/null ;;
		g++-*-linux-gnu) command -v "${1#g++-}-g++" >/dev/null ;;
		g++-mingw-w64-x86-64-posix) command -v x86_64-w64-mingw32-g++-posix >/dev/null ;;
		qemu-user) command -v qemu-aarch64 >/dev/null ;;
		bubblewrap) command -v bwrap >/dev/null ;;
		nodejs) command -v node >/dev/null ;;
		mono-mcs) command -v mcs >/dev/null ;;
		mono-runtime) command -v mono >/dev/null ;;
		libmono-system-xml-linq4.0-cil) [[ -n $(find /usr/lib/mono -name System.Xml.Linq.dll -print -quit 2>/dev/null) ]] ;;
		binutils) command -v objdump >/dev/null ;;
		doctest-dev) echo '#include <doctest/doctest.h>' | "${CXX:-g++}" -x c++ -E - >/dev/null 2>&1 ;;
		nlohmann-json3-dev) echo '#include <nlohmann/json.hpp>' | "${CXX:-g++}" -x c++ -E - >/dev/null 2>&1 ;;
		libbox2d-dev) echo '#include <box2d/box2d.h>' | "${CXX:-g++}" -x c++ -E - >/dev/null 2>&1 ;;
		libchipmunk-dev) echo '#include <chipmunk/chipmunk.h>' | "${CXX:-g++}" -x c++ -E - >/dev/null 2>&1 ;;
		python3-venv) command -v python3 >/dev/null && python3 -c 'import ensurepip, venv' 2>/dev/null ;;
		ca-certificates) [[ -e /etc/ssl/certs/ca-certificates.crt ]] || ! command -v apt-get >/dev/null ;;
		debian-archive-keyring) [[ -e /usr/share/keyrings/debian-archive-keyring.gpg ]] ;;
		xvfb) command -v Xvfb >/dev/null && command -v xvfb-run >/dev/null ;;
		libclang-rt-*-dev) [[ -n $(find /usr/lib/llvm-*/lib/clang -name 'libclang_rt.fuzzer*' -print -quit 2>/dev/null) ]] ;;
		*) command -v "$1" >/dev/null ;;
	esac
}

# need_packages NAME…: installs those of the Debian packages that are missing, or says which ones are.
need_packages() {
	local missing=() as_root=() remedy
	list_missing "$@"
	[[ ${#missing[@]} -gt 0 ]] || return 0
	remedy="install them and run this again (on Debian: apt-get install ${missing[*]})"

	command -v apt-get >/dev/null || { problem "missing: ${missing[*]}; $remedy"; return 1; }
	if [[ $EUID -ne 0 ]]; then
		command -v sudo >/dev/null || { problem "missing: ${missing[*]}, and there is no sudo; $remedy"; return 1; }
		as_root=(sudo)
		[[ -t 0 ]] || as_root+=(-n) # Nobody is there to be asked for a password.
	fi
	as_root+=(env DEBIAN_FRONTEND=noninteractive apt-get -q -o Acquire::Retries=3 -o DPkg::Lock::Timeout=300)

	step "Installing ${missing[*]}"
	(
		flock 9 # One that runs beside this may be installing some of them.
		list_missing "$@"
		[[ ${#missing[@]} -gt 0 ]] || exit 0
		{ "${as_root[@]}" update && "${as_root[@]}" install -y --no-install-recommends "${missing[@]}"; } >"$LOG_DIR/apt.log" 2>&1 9>&-
	) 9>"$CACHE_DIR/apt.lock" && return 0
	tail -n 5 "$LOG_DIR/apt.log" >&2
	problem "could not install ${missing[*]} (see $LOG_DIR/apt.log); $remedy"
}

# list_missing NAME…: sets `missing` to those of the packages that are.
list_missing() {
	local name
	missing=()
	for name in "$@"; do
		has_package "$name" || missing+=("$name")
	done
}
