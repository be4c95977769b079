// SPDX-License-Identifier: MIT
// Runs one benchmark by name and writes its result as JSON. `scripts/bench.sh` is the way to call it.
#include "bench.h"

#include <cstdio>
#include <fstream>
#include <map>
#include <string>

namespace {

const std::map<std::string, bench::Bench> BENCHES = {
	{ "work-precision", bench::work_precision },
	{ "stability", bench::stability },
	{ "energy", bench::energy },
	{ "recovery", bench::recovery },
	{ "auto", bench::automatic },
	{ "table-4-1", bench::table_4_1 },
	{ "pile", bench::pile },
	{ "scaling", bench::scaling },
	{ "contact-accuracy", bench::contact_accuracy },
	{ "contact-books", bench::contact_books },
	{ "stress", bench::stress },
	{ "soak", bench::soak },
	{ "model", bench::model },
	{ "heap", bench::heap },
	{ "dents", bench::dents },
	{ "detail", bench::detail },
	{ "rollback", bench::rollback },
};

int usage(const char *program) {
	std::fprintf(stderr, "usage: %s NAME OUTPUT.json [--quick]\nnames:", program);
	for (const auto &[name, function] : BENCHES) {
		std::fprintf(stderr, " %s", name.c_str());
	}
	std::fprintf(stderr, "\n");
	return 2;
}

} // namespace

int main(int argc, char **argv) {
	if (argc < 3 || argc > 4 || !BENCHES.contains(argv[1])) {
		return usage(argv[0]);
	}
	bench::Options options;
	options.quick = argc == 4 && std::string(argv[3]) == "--quick";
	if (argc == 4 && !options.quick) {
		return usage(argv[0]);
	}
	std::ofstream output(argv[2]);
	output << BENCHES.at(argv[1])(options).dump() << '\n';
	if (!output.flush()) {
		std::fprintf(stderr, "error: cannot write %s\n", argv[2]);
		return 1;
	}
	return 0;
}
