// SPDX-License-Identifier: MIT
// Prints the hashes of all scenes, for scripts/test.sh determinism to compare between compilers. In the tests it is empty.
#ifdef HASHES_PROGRAM
#include "determinism/hashed_scenes.h"
#include "support/threads.h"

#include <cinttypes>
#include <cstdio>

using namespace softbody::testing;

int main() {
	bool are_alike = true;
	for (const HashedScene &scene : hashed_scenes()) {
		const std::uint64_t alone = run_hashed(scene, 240, {});
		std::printf("%s %016" PRIx64 "\n", scene.name, alone);
		for (std::size_t threads = 2; threads <= 8; ++threads) {
			const std::uint64_t hash = run_hashed(scene, 240, on_threads(threads));
			if (hash != alone) {
				std::printf("%s differs on %zu threads: %016" PRIx64 "\n", scene.name, threads, hash);
				are_alike = false;
			}
		}
	}
	return are_alike ? 0 : 1;
}
#endif
