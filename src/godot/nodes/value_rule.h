// SPDX-License-Identifier: MIT
// What a node does with a value that one of its properties is given.
#pragma once

#include "core/base/value_range.h"

namespace softbody {

/// Name and range of a property of a node of class `Node`, and what it acts on.
template <class Node>
struct ValueRule {
	using Effect = void (Node::*)();
	ValueRule(const char *p_name = "", const ValueRange &p_range = {}, Effect p_effect = nullptr, bool p_is_judged = false) :
			name(p_name), range(p_range), effect(p_effect), is_judged(p_is_judged) {}
	const char *name;
	ValueRange range;
	Effect effect; ///< called when the value was accepted
	bool is_judged; ///< whether the value is refused where the body as a whole cannot have it
};

} // namespace softbody
