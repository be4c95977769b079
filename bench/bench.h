// SPDX-License-Identifier: MIT
// What every benchmark of the core is: a function from options to a JSON result.
#pragma once

#include <nlohmann/json.hpp>

#include <string>

namespace bench {

struct Options {
	bool quick = false; ///< fewer cases, to end within seconds
};

/// Runs and returns what was measured; never aborts on a blow-up, which is a result like any other.
using Bench = nlohmann::json (*)(const Options &options);

nlohmann::json work_precision(const Options &options);
nlohmann::json stability(const Options &options);
nlohmann::json energy(const Options &options);
nlohmann::json recovery(const Options &options);
nlohmann::json automatic(const Options &options);
nlohmann::json table_4_1(const Options &options);
nlohmann::json pile(const Options &options);
nlohmann::json scaling(const Options &options);
nlohmann::json contact_accuracy(const Options &options);
nlohmann::json contact_books(const Options &options);
/// A part of `contact_accuracy`.
nlohmann::json field_scenes(const Options &options);
/// A part of `contact_accuracy`.
nlohmann::json contact_chart(const Options &options);
nlohmann::json stress(const Options &options);
nlohmann::json soak(const Options &options);
nlohmann::json model(const Options &options);
nlohmann::json heap(const Options &options);
nlohmann::json detail(const Options &options);
/// Parts of `detail`.
nlohmann::json detail_levels(const Options &options);
nlohmann::json detail_crowd(const Options &options);
nlohmann::json detail_refinement(const Options &options);
nlohmann::json dents(const Options &options);
nlohmann::json rollback(const Options &options);
/// A part of `dents`.
nlohmann::json cuts(const Options &options);

} // namespace bench
