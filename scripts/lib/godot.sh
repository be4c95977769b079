# shellcheck shell=bash
# SPDX-License-Identifier: MIT
# Finds a Godot engine, or installs one into the user's cache, and runs it with a window or without.
#
# Needs common.sh. After find_godot, GODOT_COMMAND is how to start the engine and GODOT_NAME says which one it is.
# shellcheck disable=SC2034 # The scripts that read this one use the name.

GODOT_ROOT=$CACHE_DIR/godot-root
GODOT_LIBRARIES=$GODOT_ROOT/usr/lib/x86_64-linux-gnu
GODOT_REMEDY="get it from https://godotengine.org/download and set GODOT=/path/to/it"
# How programs built for our own engine's libraries are started: told where Mesa and fontconfig are, as that is not where
# they were built to be, and by the loader of those libraries.
GODOT_ENVIRONMENT=(env
	LIBGL_DRIVERS_PATH="$GODOT_LIBRARIES/dri" GBM_BACKENDS_PATH="$GODOT_LIBRARIES/gbm"
	__EGL_VENDOR_LIBRARY_DIRS="$GODOT_ROOT/usr/share/glvnd/egl_vendor.d" __GLX_VENDOR_LIBRARY_NAME=mesa
	FONTCONFIG_FILE="$GODOT_ROOT/etc/fonts/fonts.conf")
GODOT_LIBRARY_PATH=(--library-path "$GODOT_LIBRARIES:$GODOT_LIBRARIES/pulseaudio")
GODOT_COMMAND=()

# godot_version COMMAND…: the version that the engine reports, or nothing.
godot_version() {
	"$@" --headless --version 2>/dev/null </dev/null | grep -E '^[0-9]+\.[0-9]+' | tail -n 1 || true
}

# accept_godot WHERE COMMAND…: takes this engine if it is 4.3 or newer.
accept_godot() {
	local where=$1 version
	shift
	version=$(godot_version "$@")
	[[ $version =~ ^4\.([0-9]+) && ${BASH_REMATCH[1]} -ge 3 ]] || return 1
	GODOT_COMMAND=("$@")
	GODOT_NAME="$version ($where)"
}

# find_godot: $GODOT, else the first new enough one on the PATH, else our own.
find_godot() {
	local name
	[[ ${#GODOT_COMMAND[@]} -eq 0 ]] || return 0
	if [[ -n ${GODOT:-} ]]; then
		accept_godot "$GODOT" "$GODOT" || problem "GODOT=$GODOT is no Godot 4.3 or newer; $GODOT_REMEDY"
		return
	fi
	for name in godot4 godot; do
		if command -v "$name" >/dev/null && accept_godot "$(command -v "$name")" "$name"; then
			return 0
		fi
	done
	install_godot || return 1
	# There is no driver for Vulkan among its libraries.
	accept_godot "$GODOT_ROOT/usr/bin/godot" "${GODOT_ENVIRONMENT[@]}" \
		"$GODOT_LIBRARIES/ld-linux-x86-64.so.2" "${GODOT_LIBRARY_PATH[@]}" \
		"$GODOT_ROOT/usr/bin/godot" --rendering-driver opengl3 ||
		problem "the Godot in $GODOT_ROOT does not run: delete that folder and try again"
}

# install_godot: Debian testing's engine, export templates and Mesa in a folder of their own, run by the loader in there.
# Debian 12 has no Godot 4, and the engine of testing needs newer libraries than those of the system.
install_godot() {
	local part=$GODOT_ROOT.part packages
	[[ ! -x $GODOT_ROOT/usr/bin/godot ]] || return 0
	if ! command -v dpkg >/dev/null || [[ $(dpkg --print-architecture) != amd64 ]]; then
		problem "there is no Godot 4.3 or newer here; $GODOT_REMEDY"
		return 1
	fi
	need_packages mmdebstrap debian-archive-keyring || return 1

	step "Installing Godot into $GODOT_ROOT (a download of about 200 MB)"
	packages=godot,godot-template-release,godot-template-debug
	packages+=,libgl1-mesa-dri,libegl-mesa0,libglx-mesa0,libgl1,libegl1
	(
		flock 9 # A second script that wants to install it waits here, and then finds it installed.
		[[ ! -x $GODOT_ROOT/usr/bin/godot ]] || exit 0
		rm -rf "$part"
		mkdir -p "$part/tmp"
		# As no package is configured, only unpacked, this needs neither root nor anything that root would allow.
		TMPDIR=$part/tmp mmdebstrap --variant=extract --mode=chrootless --format=tar \
			--aptopt='Acquire::Check-Valid-Until "false"' --aptopt='Acquire::Retries "3"' \
			--include="$packages" testing - 2>"$LOG_DIR/godot_install.log" 9>&- </dev/null |
			tar -x --no-same-owner --exclude=./dev --exclude=./tmp -C "$part" || exit 1
		rm -rf "$part/tmp"
		mkdir "$part/tmp" "$part/dev" "$part/proc" # With these, an exported game can have this folder as its root.
		ln -sfn usr/bin "$part/bin"
		ln -sfn usr/lib "$part/lib"
		ln -sfn usr/lib64 "$part/lib64"
		rm -rf "$GODOT_ROOT"
		mv "$part" "$GODOT_ROOT"
	) 9>"$GODOT_ROOT.lock" && return 0
	grep -m 1 '^E:' "$LOG_DIR/godot_install.log" >&2
	problem "could not install Godot (see $LOG_DIR/godot_install.log); try again, or $GODOT_REMEDY"
}

# has_screen: whether a window can be shown.
has_screen() {
	[[ -n ${DISPLAY:-}${WAYLAND_DISPLAY:-} || $(uname -s) != Linux ]]
}

# limited SECONDS COMMAND…: runs it, and ends it if it takes longer; 0 is no limit.
limited() {
	local limit=$1
	shift
	if [[ $limit -gt 0 ]] && command -v timeout >/dev/null; then
		timeout -k 10 "$limit" "$@" </dev/null
	else
		"$@"
	fi
}

# godot_headless SECONDS ARGS…: runs the engine without a window, for that long at most.
godot_headless() {
	local limit=$1
	shift
	limited "$limit" "${GODOT_COMMAND[@]}" --headless "$@"
}

# need_window: what it takes to open one.
need_window() {
	has_screen || need_packages xvfb xauth
}

# godot_windowed SECONDS ARGS…: runs the engine in a window; without a screen, in one that nobody sees, drawn by the CPU.
godot_windowed() {
	local limit=$1
	shift
	if has_screen; then
		limited "$limit" "${GODOT_COMMAND[@]}" "$@"
	else
		limited "$limit" xvfb-run -a -s "-screen 0 1280x720x24" \
			env LIBGL_ALWAYS_SOFTWARE=1 "${GODOT_COMMAND[@]}" --rendering-driver opengl3 --audio-driver Dummy "$@"
	fi
}

# with_screen COMMAND…: runs a command or function with a screen; where there is none, with one that nobody sees, by an Xvfb that gets
# the options $SCREEN_OPTIONS as well.
with_screen() {
	local number status=0 server
	if has_screen; then
		"$@"
		return
	fi
	need_window || return 1
	# shellcheck disable=SC2086 # Options are words.
	coproc XVFB { exec Xvfb ${SCREEN_OPTIONS:-} -displayfd 1 -screen 0 "${SCREEN_SIZE:-1280x720}x24" 2>"$LOG_DIR/xvfb.log"; }
	server=$XVFB_PID
	if ! read -r -t 20 number <&"${XVFB[0]}"; then
		problem "Xvfb does not start (see $LOG_DIR/xvfb.log)"
		return 1
	fi
	DISPLAY=:$number LIBGL_ALWAYS_SOFTWARE=1 "$@" || status=$?
	kill "$server" && wait "$server" 2>/dev/null
	return $status
}
