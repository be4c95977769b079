# shellcheck shell=bash
# SPDX-License-Identifier: MIT
# Runs Godot with an extension that is compiled for AddressSanitizer, and judges what that has found.
#
# Needs common.sh, godot.sh and an engine found by it.
# shellcheck disable=SC2034 # The scripts that read this one use the name.

LEAK_SANITIZERS=address,undefined,float-cast-overflow
SANITIZED_DIR=$REPO_DIR/build/sanitized
SANITIZED_LIBRARY=libsoft_body_2d.linux.template_debug.x86_64.so
FINDINGS=$LOG_DIR/findings

# make_sanitized_project: a copy of the demo project with that extension, so that no other script ever loads it.
make_sanitized_project() {
	local project=$SANITIZED_DIR/project
	rm -rf "$project"
	mkdir -p "$project"
	cp -R "$PROJECT_DIR/." "$project/" || return 1
	cp "$SANITIZED_DIR/$SANITIZED_LIBRARY" "$project/addons/soft_body_2d/bin/" || return 1
	# Godot opens libraries so that their own symbols come first, which the sanitizer's runtime refuses. Of one that was closed
	# it could name no function any more in what is found at the end.
	cat >"$SANITIZED_DIR/open_plainly.c" <<-'END'
		#define _GNU_SOURCE
		#include <dlfcn.h>
		void *dlopen(const char *file, int mode) {
			void *(*next)(const char *, int) = (void *(*)(const char *, int))dlsym(RTLD_NEXT, "dlopen");
			return next(file, mode & ~RTLD_DEEPBIND);
		}
		int dlclose(void *handle) {
			return handle == 0;
		}
	END
	gcc -shared -fPIC -O1 -o "$SANITIZED_DIR/open_plainly.so" "$SANITIZED_DIR/open_plainly.c" -ldl
}

# run_sanitized SECONDS ARGS…: the engine without a window, in that project.
run_sanitized() {
	local limit=$1 options=detect_leaks=1:fast_unwind_on_malloc=0:malloc_context_size=12:verify_asan_link_order=0
	shift
	rm -f "$FINDINGS".*
	# Of the engine's own leaks, which there are, its exit status shall say nothing.
	limited "$limit" env LD_PRELOAD="$SANITIZED_DIR/open_plainly.so:$(g++ -print-file-name=libasan.so)" \
		ASAN_OPTIONS="$options:exitcode=0:log_path=$FINDINGS" UBSAN_OPTIONS=print_stacktrace=1 \
		"${GODOT_COMMAND[@]}" --headless --fixed-fps 60 --path "$SANITIZED_DIR/project" "$@"
}

# judge_findings: prints what concerns the extension, and fails if there is something. A leak is ours if it was asked for on
# our behalf, which the stack of its allocation shows: by the library's name, or where a source is known by a namespace, of
# which the engine has none of these. The others are counted.
judge_findings() {
	local file status=0
	for file in "$FINDINGS".*; do
		[[ -f $file ]] || continue
		awk -v RS= '
			/^(Direct|Indirect) leak/ { if (/libsoft_body_2d|softbody::|godot::/) { print $0 "\n"; ours++ } else { others++ } next }
			/ERROR: AddressSanitizer|runtime error:/ { print $0 "\n"; ours++ }
			END { printf "%d of ours, %d leaks of the engine\n", ours, others; exit ours > 0 }
		' "$file" || status=1
	done
	return $status
}
