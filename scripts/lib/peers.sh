# shellcheck shell=bash
# SPDX-License-Identifier: MIT
# Peers that Debian has not, or not built for speed: Box2D 3, and Chipmunk in floats without assertions. Their sources come
# from packages of pinned versions that carry them, or from a folder that the caller names:
#
#   BOX2D_V3_SOURCES   a checkout of Box2D 3: a folder with include/ and src/
#   CHIPMUNK_SOURCES   a checkout of Chipmunk 7 or of its fork Munk2D: a folder with include/ and src/
#
# Needs common.sh, build.sh, and BENCH_PYTHON of bench.sh. What cannot be had is said, and left out.

PEERS_DIR=$CACHE_DIR/peers
BOX2D_V3_CRATE=boxdd-sys # carries Box2D 3.2.0 as it is
BOX2D_V3_CRATE_VERSION=0.6.0
CHIPMUNK_SDIST=pymunk # carries Munk2D 2.0.1, the fork in which Chipmunk is kept up
CHIPMUNK_SDIST_VERSION=7.3.1

# fetch_box2d_v3 FOLDER: puts the sources there.
fetch_box2d_v3() {
	local project=$1.project
	command -v cargo >/dev/null || { echo "there is no cargo"; return 1; }
	rm -rf "$project" && mkdir -p "$project" && : >"$project/lib.rs"
	cat >"$project/Cargo.toml" <<END
[package]
name = "peers"
version = "0.0.0"
edition = "2021"
[lib]
path = "lib.rs"
[dependencies]
$BOX2D_V3_CRATE = { version = "=$BOX2D_V3_CRATE_VERSION", default-features = false }
END
	(cd "$project" && cargo vendor --quiet vendor) && cp -r "$project/vendor/$BOX2D_V3_CRATE/third-party/box2d" "$1"
}

# fetch_chipmunk FOLDER: puts the sources there.
fetch_chipmunk() {
	local sdist=$1.sdist
	rm -rf "$sdist"
	"$BENCH_PYTHON" -m pip download --disable-pip-version-check --quiet --no-deps --no-binary :all: -d "$sdist" \
		"$CHIPMUNK_SDIST==$CHIPMUNK_SDIST_VERSION" &&
		tar -xzf "$sdist"/*.tar.gz -C "$sdist" --strip-components 1 && cp -r "$sdist/Munk2D" "$1"
}

# build_engine SOURCES LIBRARY FLAGS…: compiles all of SOURCES/src into the static library.
build_engine() {
	local sources=$1 library=$2 file objects
	shift 2
	objects=$(mktemp -d) || return 1
	for file in "$sources"/src/*.c; do
		"${CC:-cc}" "$@" -O3 -DNDEBUG -fPIC -fvisibility=hidden -w "-I$sources/include" -c "$file" \
			-o "$objects/$(basename "$file" .c).o" || return 1
	done
	ar rcs "$library.new" "$objects"/*.o && mv "$library.new" "$library"
	rm -rf "$objects"
}

# need_peer NAME KEY GIVEN FETCH FLAGS…: leaves headers and lib<NAME>.a in a folder of the cache, and sets PEER_<NAME> to
# it. KEY names what the folder was made of; GIVEN is a folder with sources, or empty to have FETCH bring them.
need_peer() {
	local name=$1 key=$2 given=$3 fetch=$4 folder=$PEERS_DIR/$1 sources log=$LOG_DIR/peer_$1.log
	shift 4
	key="$key $*"
	if [[ -n $given || ! -f $folder/lib$name.a || $(cat "$folder/made_of.txt" 2>/dev/null) != "$key" ]]; then
		step "Building the peer $name"
		rm -rf "$folder" && mkdir -p "$folder"
		sources=${given:-$folder/sources}
		if ! { { [[ -n $given ]] || "$fetch" "$sources"; } && build_engine "$sources" "$folder/lib$name.a" "$@" &&
			cp -r "$sources/include" "$folder/"; } >"$log" 2>&1 </dev/null; then
			step "The peer $name is not built: $(tail -n 1 "$log") (see $log, and scripts/lib/peers.sh)"
			return 0
		fi
		echo "${given:+given }$key" >"$folder/made_of.txt"
	fi
	export "PEER_${name^^}=$folder"
}

# build_peers: builds the program that runs the piles, and sets BENCH_PEERS to the libraries of the peers that were built.
build_peers() {
	local name found=() wide=()
	need_packages libbox2d-dev libchipmunk-dev || return 1
	# Our core looks for AVX2 when it runs; Box2D is told when it is built, and takes 0.82 to 0.89 of the time with it.
	! grep -qsw avx2 /proc/cpuinfo || wide=(-mavx2 -DBOX2D_AVX2)
	need_peer box2d_v3 "$BOX2D_V3_CRATE $BOX2D_V3_CRATE_VERSION" "${BOX2D_V3_SOURCES-}" fetch_box2d_v3 \
		-std=gnu17 -ffp-contract=off "${wide[@]}"
	# With the flags of its own release build.
	need_peer chipmunk_floats "$CHIPMUNK_SDIST $CHIPMUNK_SDIST_VERSION" "${CHIPMUNK_SOURCES-}" fetch_chipmunk \
		-std=gnu99 -ffast-math -DCP_USE_DOUBLES=0
	rm -f "$REPO_DIR"/build/bench/peer_*.so # of an engine that is not built this time
	run_scons peers || { problem "the core or its benchmarks do not compile"; return 1; }
	for name in "$REPO_DIR"/build/bench/peer_*.so; do
		found+=("$name")
	done
	BENCH_PEERS=$(IFS=: && echo "${found[*]}")
	export BENCH_PEERS
}
