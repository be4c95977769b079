// SPDX-License-Identifier: MIT
// A list of nodes from which any can be taken at once.
#pragma once

#include "godot/server/stepped_node.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace softbody {

/// Nodes in an order that only their comings and goings decide. Each node holds its place in the list, so that adding
/// and removing take O(1). Both are allowed while the list is gone through: a node removed then is skipped, a node
/// added then waits for the next time.
template <std::size_t SteppedNode::Places::*PLACE>
class NodeList {
public:
	/// A node is in the lists of one space at a time.
	bool contains(const SteppedNode &p_node) const { return p_node.places.*PLACE != SIZE_MAX; }

	/// A node that is in the list already stays where it is.
	void add(SteppedNode &r_node) {
		if (!contains(r_node)) {
			r_node.places.*PLACE = nodes_.size();
			nodes_.push_back(&r_node);
		}
	}

	void remove(SteppedNode &r_node) {
		if (!contains(r_node)) {
			return;
		}
		const std::size_t place = r_node.places.*PLACE;
		r_node.places.*PLACE = SIZE_MAX;
		nodes_[place] = nullptr;
		gaps_++;
		if (walks_ == 0) {
			nodes_[place] = nodes_.back();
			nodes_.pop_back();
			gaps_ = 0;
			if (place < nodes_.size()) {
				nodes_[place]->places.*PLACE = place;
			}
		}
	}

	/// Calls `p_work(node)` for the nodes that are in the list now.
	template <class Work>
	void for_each(const Work &p_work) {
		walks_++;
		const std::size_t count = nodes_.size();
		for (std::size_t i = 0; i < count; i++) {
			if (nodes_[i] != nullptr) {
				p_work(*nodes_[i]);
			}
		}
		walks_--;
		close_gaps();
	}

	std::size_t count() const { return nodes_.size() - gaps_; }
	/// The node at a place below `count()`. Not while the list is gone through.
	SteppedNode &operator[](std::size_t p_place) const { return *nodes_[p_place]; }

private:
	void close_gaps() {
		if (walks_ > 0 || gaps_ == 0) {
			return;
		}
		std::erase(nodes_, nullptr);
		gaps_ = 0;
		for (std::size_t i = 0; i < nodes_.size(); i++) {
			nodes_[i]->places.*PLACE = i;
		}
	}

	std::vector<SteppedNode *> nodes_;
	std::size_t gaps_ = 0; ///< entries that are null
	int walks_ = 0; ///< calls of `for_each` under way
};

} // namespace softbody
