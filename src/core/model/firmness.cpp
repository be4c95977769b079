// SPDX-License-Identifier: MIT
// How firm a body is made for its weight.
#include "core/model/firmness.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace softbody {

double load_of(double mass, double gravity, double area) {
	return mass * std::abs(gravity) / std::sqrt(area / std::numbers::pi);
}

// E R / (m g) decides how much a body sags: E in proportion to the load keeps it.
Firmness firmness_for(double load, double youngs_modulus) {
	Firmness firmness;
	firmness.for_load = std::max(1.0, load / LIGHT_LOAD);
	const double least = LEAST_FIRM_STRENGTH * load / youngs_modulus;
	firmness.is_least = least > firmness.for_load;
	firmness.factor = firmness.is_least ? least : firmness.for_load;
	const double most = std::max(1.0, MOST_FIRM_MODULUS / youngs_modulus);
	firmness.factor = std::min(firmness.factor, most);
	firmness.for_load = std::min(firmness.for_load, most);
	return firmness;
}

} // namespace softbody
