// SPDX-License-Identifier: MIT
// Runs piles in all engines and writes the result as JSON. `scripts/bench.sh peers` is the way to call it.
#include "../pile_scene.h"
#include "peers.h"
#include "scenes.h"

#include <nlohmann/json.hpp>

#include <dlfcn.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <map>
#include <sstream>

namespace {

using namespace bench;
using nlohmann::json;

const char *const OURS = "Soft Body 2D";

// One engine under one choice of settings.
struct Entry {
	std::string engine;
	std::string version;
	std::string setting; // in a word or two
	std::string settings; // in full
	std::unique_ptr<PileEngine> pile;
	int threads = 1;
};

Entry make_ours(const PileScene &scene, const SoftBodySettings &settings, int threads) {
	return { OURS, "this", settings.name, softbody_pile_settings(scene, settings),
		make_softbody_pile(scene, settings, threads), threads };
}

Entry make_theirs(const PileScene &scene, const Peer &peer, const PeerSettings &settings, int threads) {
	const char *body = settings.body == RingBody::CENTER ? "with center" : "cross springs";
	return { peer.engine, peer.version, body, settings.name, peer.make(scene, settings, threads), threads };
}

// The libraries of the peers that were built, in their order.
std::vector<const Peer *> load_peers(const char *paths) {
	std::vector<const Peer *> peers;
	std::istringstream listed(paths != nullptr ? paths : "");
	for (std::string path; std::getline(listed, path, ':');) {
		void *library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
		void *symbol = library != nullptr ? dlsym(library, "bench_peer") : nullptr;
		if (symbol == nullptr) {
			std::fprintf(stderr, "error: %s\n", dlerror());
			std::exit(1);
		}
		peers.push_back(&reinterpret_cast<const Peer &(*)()>(symbol)());
	}
	return peers;
}

std::vector<PileRun> run_entries(
		const PileScene &scene, const std::vector<Entry> &entries, int steps, PileClock clock) {
	std::vector<PileEngine *> piles;
	for (const Entry &entry : entries) {
		piles.push_back(entry.pile.get());
	}
	return run_piles(scene, piles, steps, clock);
}

// As bench/tables_peers.py judges peers.
bool holds(const PileRun &run) {
	const PileQuality &quality = run.quality;
	return quality.folded == 0 && quality.escaped == 0 && 100 * quality.overlapping <= run.hulls.size();
}

json head_of(const PileScene &scene, std::string_view kind, const Entry &entry) {
	return { { "engine", entry.engine }, { "version", entry.version }, { "setting", entry.setting },
		{ "settings", entry.settings }, { "scene", kind }, { "bodies", scene.bodies.size() }, { "threads", entry.threads } };
}

json quality_of(const PileQuality &quality) {
	return { { "folded", quality.folded }, { "overlapping", quality.overlapping }, { "escaped", quality.escaped },
		{ "mean_penetration", quality.mean_penetration }, { "worst_penetration", quality.worst_penetration },
		{ "mean_area", quality.mean_area }, { "height", quality.height } };
}

json row_of(const PileScene &scene, std::string_view kind, const Entry &entry, const PileRun &run) {
	json row = head_of(scene, kind, entry);
	row.update({ { "ns_per_body_step", run.median }, { "low", run.low }, { "high", run.high }, { "mean", run.mean },
			{ "median_whole", run.median_whole }, { "mean_whole", run.mean_whole }, { "worst_step", run.worst } });
	row.update(quality_of(run.quality));
	return row;
}

// Which settings of each peer go into the scenes after the first: of those that hold the first, the fastest.
using Chosen = std::map<const Peer *, PeerSettings>;

Chosen choose(const std::vector<const Peer *> &peers, const std::vector<PileRun> &runs, std::size_t first) {
	Chosen chosen;
	for (const Peer *peer : peers) {
		const PileRun *best = nullptr;
		for (const PeerSettings &settings : peer->settings) {
			const PileRun &run = runs[first++];
			const bool better = best == nullptr || (holds(run) && !holds(*best)) ||
					(holds(run) == holds(*best) && run.median < best->median);
			if (better) {
				best = &run;
				chosen[peer] = settings;
			}
		}
	}
	return chosen;
}

// All kinds of piles of that many bodies, one thread.
void add_scenes(json &rows, const std::vector<const Peer *> &peers, std::size_t count, int steps, bool all_kinds) {
	Chosen chosen;
	for (const std::string_view kind : PILE_KINDS) {
		const PileScene scene = pile_of(kind, count);
		std::vector<Entry> entries;
		for (const SoftBodySettings &settings : softbody_settings()) {
			entries.push_back(make_ours(scene, settings, 1));
		}
		const std::size_t ours = entries.size();
		for (const Peer *peer : peers) {
			for (const PeerSettings &settings : chosen.empty() ? peer->settings : std::vector{ chosen[peer] }) {
				entries.push_back(make_theirs(scene, *peer, settings, 1));
			}
		}
		const std::vector<PileRun> runs = run_entries(scene, entries, steps, PileClock::PROCESSOR);
		if (chosen.empty()) {
			chosen = choose(peers, runs, ours);
		}
		for (std::size_t i = 0; i < runs.size(); ++i) {
			rows.push_back(row_of(scene, kind, entries[i], runs[i]));
		}
		if (!all_kinds) {
			return;
		}
	}
}

// The median and the extremes, over runs of their own, of the medians by the clock on the wall.
void add_threads(json &rows, const std::vector<const Peer *> &peers, std::size_t count, int steps, int runs) {
	const PileScene scene = pile_of("equal", count);
	std::vector<std::vector<double>> times;
	std::vector<json> heads;
	std::vector<PileQuality> qualities;
	for (int run = 0; run < runs; ++run) {
		std::vector<Entry> entries;
		for (const int threads : { 1, 2 }) {
			for (const SoftBodySettings &settings : softbody_settings()) {
				entries.push_back(make_ours(scene, settings, threads));
			}
			for (const Peer *peer : peers) {
				if (peer->has_threads) {
					entries.push_back(make_theirs(scene, *peer, peer->settings.back(), threads));
				}
			}
		}
		times.resize(entries.size());
		qualities.resize(entries.size());
		const std::vector<PileRun> results = run_entries(scene, entries, steps, PileClock::WALL);
		heads.clear();
		for (std::size_t i = 0; i < results.size(); ++i) {
			heads.push_back(head_of(scene, "equal", entries[i]));
			times[i].push_back(results[i].median);
			qualities[i] = results[i].quality;
		}
	}
	const std::size_t half = heads.size() / 2; // the entries of one thread, then the same of two
	for (std::size_t i = 0; i < heads.size(); ++i) {
		std::vector<double> gains;
		for (int run = 0; run < runs; ++run) {
			gains.push_back(times[i % half][std::size_t(run)] / times[i][std::size_t(run)]);
		}
		std::sort(gains.begin(), gains.end());
		std::sort(times[i].begin(), times[i].end());
		const std::size_t middle = std::size_t(runs) / 2;
		json row = heads[i];
		row.update({ { "clock", "wall" }, { "runs", runs }, { "ns_per_body_step", times[i][middle] },
				{ "low", times[i].front() }, { "high", times[i].back() }, { "gain", gains[middle] },
				{ "worst_gain", gains.front() } });
		row.update(quality_of(qualities[i]));
		rows.push_back(row);
	}
}

} // namespace

int main(int argc, char **argv) {
	const bool quick = argc > 3 && std::strcmp(argv[3], "--quick") == 0;
	if (argc < 3 || std::strcmp(argv[1], "peers") != 0) {
		std::fprintf(stderr, "usage: %s peers OUTPUT.json [--quick]\nBENCH_PEERS: the peers' libraries, with colons between\n", argv[0]);
		return 2;
	}
	const std::vector<const Peer *> peers = load_peers(std::getenv("BENCH_PEERS"));
	const int steps = quick ? 240 : 480;
	json rows = json::array();
	add_scenes(rows, peers, 100, steps, true);
	add_scenes(rows, peers, 1000, steps, !quick);
	if (!quick) {
		add_scenes(rows, peers, 3000, steps, true);
	}
	add_threads(rows, peers, quick ? 1000 : 3000, steps / 2, quick ? 2 : 10);
	std::ofstream output(argv[2]);
	output << json{ { "steps", steps }, { "rows", rows } }.dump() << '\n';
	if (!output.flush()) {
		std::fprintf(stderr, "error: cannot write %s\n", argv[2]);
		return 1;
	}
	return 0;
}
