// SPDX-License-Identifier: MIT
// Prints the hashes of all scenes, for scripts/test.sh determinism and platforms to compare. In the tests it is empty.
// Arguments: the largest number of threads (default: 8; with 1 it starts no thread), and how many ticks (default: 240). With a third
// argument it prints instead how many bodies each scene has and the microseconds that a tick takes on one thread, the least of three runs.
#ifdef HASHES_PROGRAM
#include "determinism/hashed_scenes.h"
#include "scenes/mixed.h"
#include "support/threads.h"

#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <cstdlib>

using namespace softbody::testing;

int main(int count, char **arguments) {
	const std::size_t most_threads = count > 1 ? std::size_t(std::atoi(arguments[1])) : 8;
	const int ticks = count > 2 ? std::atoi(arguments[2]) : 240;
	if (count > 3) {
		for (const HashedScene &scene : hashed_scenes()) {
			const double least = std::min({ time_hashed(scene, ticks), time_hashed(scene, ticks), time_hashed(scene, ticks) });
			std::printf("%s %zu %.0f\n", scene.name, scene.make().soft_bodies().size(), least);
		}
		return 0;
	}
	bool are_alike = true;
	BitHash all;
	for (const HashedScene &scene : hashed_scenes()) {
		const std::uint64_t alone = run_hashed(scene, ticks, {});
		std::printf("%s %016" PRIx64 "\n", scene.name, alone);
		all.add(alone);
		for (std::size_t threads = 2; threads <= most_threads; ++threads) {
			const std::uint64_t hash = run_hashed(scene, ticks, on_threads(threads));
			if (hash != alone) {
				std::printf("%s differs on %zu threads: %016" PRIx64 "\n", scene.name, threads, hash);
				are_alike = false;
			}
		}
	}
	std::printf("all %016" PRIx64 "\n", all.value());
	return are_alike ? 0 : 1;
}
#endif
