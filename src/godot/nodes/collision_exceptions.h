// SPDX-License-Identifier: MIT
// What a node does not collide with, by its user's choice or for a joint.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace softbody {

/// Objects by their instance ids. An exception that a node of ours has holds for both sides: the other keeps it as one that is
/// `taken`.
class CollisionExceptions {
public:
	/// In the order in which they were added.
	const std::vector<uint64_t> &chosen() const { return chosen_; }
	bool is_empty() const { return chosen_.empty() && taken_.empty() && joined_.empty(); }
	/// False when it is one already.
	bool choose(uint64_t p_id) {
		const bool is_new = std::ranges::find(chosen_, p_id) == chosen_.end();
		if (is_new) {
			chosen_.push_back(p_id);
		}
		return is_new;
	}
	/// False when it is none.
	bool drop(uint64_t p_id) { return std::erase(chosen_, p_id) > 0; }

	/// A soft body has this one among its exceptions, or no longer.
	void take(uint64_t p_by) { taken_.push_back(p_by); }
	void give_back(uint64_t p_by) { std::erase(taken_, p_by); }
	bool is_taken(uint64_t p_by) const { return std::ranges::find(taken_, p_by) != taken_.end(); }

	/// For joints: holds until it has been parted from as often as it was joined.
	void join(uint64_t p_id) { joined_.push_back(p_id); }
	/// False when no joint holds it.
	bool part(uint64_t p_id) {
		const auto found = std::ranges::find(joined_, p_id);
		if (found == joined_.end()) {
			return false;
		}
		joined_.erase(found);
		return true;
	}

	/// Calls `p_use` with each id, perhaps more than once with the same.
	template <class Use>
	void for_each(const Use &p_use) const {
		for (const std::vector<uint64_t> *list : { &chosen_, &taken_, &joined_ }) {
			std::ranges::for_each(*list, p_use);
		}
	}

private:
	std::vector<uint64_t> chosen_;
	std::vector<uint64_t> taken_; ///< soft bodies
	std::vector<uint64_t> joined_; ///< one a joint
};

} // namespace softbody
