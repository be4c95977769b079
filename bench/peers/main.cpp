// SPDX-License-Identifier: MIT
// Runs the pile in all engines and writes the result as JSON. `scripts/bench.sh peers` is the way to call it.
#include "../pile_scene.h"
#include "peers.h"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <cstring>
#include <fstream>

namespace {

using namespace bench;
using nlohmann::json;

// One engine under one choice of settings.
struct Entry {
	std::string engine;
	std::string version;
	std::string settings;
	std::unique_ptr<PileEngine> pile;
};

std::vector<Entry> make_entries(const PileScene &scene) {
	std::vector<Entry> entries;
	for (const SoftBodySettings &settings : softbody_settings()) {
		entries.push_back({ "Soft Body 2D", "this", softbody_pile_settings(scene, settings), make_softbody_pile(scene, settings) });
	}
	for (const PeerSettings &settings : box2d_settings()) {
		entries.push_back({ "Box2D", box2d_version(), settings.name, make_box2d_pile(scene, settings) });
	}
	for (const PeerSettings &settings : chipmunk_settings()) {
		entries.push_back({ "Chipmunk", chipmunk_version(), settings.name, make_chipmunk_pile(scene, settings) });
	}
	return entries;
}

json row_of(const PileScene &scene, const Entry &entry, const PileRun &run) {
	const PileQuality &quality = run.quality;
	return { { "engine", entry.engine }, { "version", entry.version }, { "settings", entry.settings },
		{ "bodies", scene.bodies.size() }, { "ns_per_body_step", run.median }, { "mean", run.mean },
		{ "median_whole", run.median_whole }, { "mean_whole", run.mean_whole }, { "worst_step", run.worst },
		{ "folded", quality.folded }, { "overlapping", quality.overlapping }, { "escaped", quality.escaped },
		{ "mean_penetration", quality.mean_penetration }, { "worst_penetration", quality.worst_penetration },
		{ "mean_area", quality.mean_area }, { "height", quality.height } };
}

} // namespace

int main(int argc, char **argv) {
	const bool quick = argc == 4 && std::strcmp(argv[3], "--quick") == 0;
	if (argc < 3 || argc > 4 || std::strcmp(argv[1], "peers") != 0 || (argc == 4 && !quick)) {
		std::fprintf(stderr, "usage: %s peers OUTPUT.json [--quick]\n", argv[0]);
		return 2;
	}
	const int steps = quick ? 240 : 480;
	const std::vector<std::size_t> counts = quick ? std::vector<std::size_t>{ 200 } : std::vector<std::size_t>{ 1000, 5000 };
	json rows = json::array();
	for (const std::size_t count : counts) {
		const PileScene scene = pile_scene(count);
		const std::vector<Entry> entries = make_entries(scene);
		std::vector<PileEngine *> piles;
		for (const Entry &entry : entries) {
			piles.push_back(entry.pile.get());
		}
		const std::vector<PileRun> runs = run_piles(scene, piles, steps);
		for (std::size_t i = 0; i < runs.size(); ++i) {
			rows.push_back(row_of(scene, entries[i], runs[i]));
		}
	}
	std::ofstream output(argv[2]);
	output << json{ { "steps", steps }, { "rows", rows } }.dump() << '\n';
	if (!output.flush()) {
		std::fprintf(stderr, "error: cannot write %s\n", argv[2]);
		return 1;
	}
	return 0;
}
