// SPDX-License-Identifier: MIT
// A list whose items are found by ids that outlive them.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace softbody {

/// Refers to an item as long as it lives. After its removal the id refers to nothing, even when its place is used again.
template <class Item>
struct Id {
	std::uint32_t index = UINT32_MAX;
	std::uint32_t generation = 0;
	friend auto operator<=>(Id a, Id b) = default;
};

/// The id of a body.
using BodyId = Id<class SoftBodyData>;

/// Items stored densely under stable ids; removing one moves the last into its place.
template <class Item>
class IdList {
public:
	Id<Item> add(Item item) {
		if (free_slots_.empty()) {
			free_slots_.push_back(std::uint32_t(slots_.size()));
			slots_.emplace_back();
		}
		const std::uint32_t slot = free_slots_.back();
		free_slots_.pop_back();
		slots_[slot].dense = std::uint32_t(items_.size());
		items_.push_back(std::move(item));
		return ids_.emplace_back(Id<Item>{ slot, slots_[slot].generation });
	}
	/// False when the id refers to nothing.
	bool remove(Id<Item> id) {
		if (!has(id)) {
			return false;
		}
		const std::uint32_t dense = slots_[id.index].dense;
		if (dense + 1 != items_.size()) {
			items_[dense] = std::move(items_.back());
			ids_[dense] = ids_.back();
			slots_[ids_[dense].index].dense = dense;
		}
		items_.pop_back();
		ids_.pop_back();
		slots_[id.index].dense = UINT32_MAX;
		slots_[id.index].generation++;
		free_slots_.push_back(id.index);
		return true;
	}
	bool has(Id<Item> id) const {
		return id.index < slots_.size() && slots_[id.index].dense != UINT32_MAX && slots_[id.index].generation == id.generation;
	}
	/// Null when the id refers to nothing. Valid until an item is added or removed.
	Item *find(Id<Item> id) { return has(id) ? &items_[slots_[id.index].dense] : nullptr; }
	const Item *find(Id<Item> id) const { return has(id) ? &items_[slots_[id.index].dense] : nullptr; }
	std::span<Item> items() { return items_; }
	std::span<const Item> items() const { return items_; }
	/// Id of the item stored at `index` of `items()`.
	Id<Item> id_at(std::size_t index) const { return ids_[index]; }

	/// Everything of a list but its items: which ids they have, and which ids coming ones will have.
	struct Order {
		std::vector<Id<Item>> ids; ///< of the items, in their order
		std::vector<std::uint32_t> generations; ///< of each index that an id has had
		std::vector<std::uint32_t> free; ///< indices without an item; the last one is taken next
		friend bool operator==(const Order &, const Order &) = default;
	};
	Order order() const {
		Order order{ ids_, {}, free_slots_ };
		for (const Slot &slot : slots_) {
			order.generations.push_back(slot.generation);
		}
		return order;
	}
	/// Whether each index is that of one item, or free.
	static bool is_sound(const Order &order) {
		std::vector<char> used(order.generations.size(), 0);
		const auto take = [&](std::uint32_t index) { return index < used.size() && !std::exchange(used[index], char(1)); };
		bool is_sound = order.ids.size() + order.free.size() == used.size();
		for (const Id<Item> id : order.ids) {
			is_sound = is_sound && take(id.index) && order.generations[id.index] == id.generation;
		}
		for (const std::uint32_t index : order.free) {
			is_sound = is_sound && take(index);
		}
		return is_sound;
	}
	/// Gives the items other ids. Precondition: the order is sound, and is one of as many items.
	void set_order(const Order &order) {
		ids_ = order.ids;
		free_slots_ = order.free;
		slots_.assign(order.generations.size(), {});
		for (std::size_t i = 0; i < slots_.size(); ++i) {
			slots_[i].generation = order.generations[i];
		}
		for (std::size_t i = 0; i < ids_.size(); ++i) {
			slots_[ids_[i].index].dense = std::uint32_t(i);
		}
	}
	/// Replaces all items and their ids, with the same precondition.
	void assign(std::vector<Item> items, const Order &order) {
		items_ = std::move(items);
		set_order(order);
	}

private:
	struct Slot {
		std::uint32_t dense = UINT32_MAX; ///< place in `items_`, UINT32_MAX when free
		std::uint32_t generation = 0;
	};
	std::vector<Item> items_;
	std::vector<Id<Item>> ids_;
	std::vector<Slot> slots_;
	std::vector<std::uint32_t> free_slots_;
};

} // namespace softbody
