// SPDX-License-Identifier: MIT
// Signals of a step, kept until every node is up to date.
#include "godot/server/step_signals.h"

#include <godot_cpp/core/object.hpp>

#include <utility>

namespace softbody {

void StepSignals::emit() {
	// A listener must not step anything, but it may add to this list: the loop works on a list of its own.
	for (const Pending &each : std::exchange(pending_, {})) {
		if (godot::ObjectDB::get_instance(each.sender) != nullptr) {
			each.emit();
		}
	}
}

} // namespace softbody
