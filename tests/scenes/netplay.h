// SPDX-License-Identifier: MIT
// Two peers who play one world over a network that loses and reorders packets: each predicts the other's input, rolls back where
// that was wrong, and steps again. A third world plays the true inputs and never rolls back.
#pragma once

#include "core/dynamics/simulator.h"
#include "core/dynamics/world_state.h"
#include "core/model/world_data.h"
#include "support/random.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace softbody::testing {

struct NetplayOptions {
	std::uint64_t seed = 1;
	int ticks = 120;
	double loss = 0.25; ///< share of packets that are lost
	int most_delay = 6; ///< of a packet [ticks]; each has its own, so they overtake one another
};

struct NetplayResult {
	int ticks = 0;
	int rollbacks = 0;
	int replayed = 0; ///< ticks stepped again, by both peers
	int deepest = 0; ///< ticks that one rollback went back
	int stalls = 0; ///< ticks in which a peer waited for input
	int mismatches = 0; ///< ticks after which one of the three worlds had another hash
};

/// Ticks that a peer goes ahead of the input that it knows.
inline constexpr int ROLLBACK_WINDOW = 8;

/// What a player does in a tick: pushes one body.
struct PlayerInput {
	std::uint32_t body = 0;
	Vec2 impulse; ///< as a change of velocity
	friend bool operator==(const PlayerInput &, const PlayerInput &) = default;
};

/// The input of a player: held for some ticks, then another.
inline std::vector<PlayerInput> make_inputs(std::uint64_t seed, int ticks, std::uint32_t bodies, Real speed) {
	Random random(seed);
	std::vector<PlayerInput> inputs;
	PlayerInput input;
	for (int tick = 0; tick < ticks; ++tick) {
		if (tick == 0 || random.chance(0.15)) {
			input = { std::uint32_t(random.integer(0, int(bodies) - 1)), random.chance(0.5) ? random.vector(double(speed)) : Vec2{} };
		}
		inputs.push_back(input);
	}
	return inputs;
}

inline void step_with(Simulator &simulator, const PlayerInput &first, const PlayerInput &second) {
	for (const PlayerInput &input : { first, second }) {
		SoftBodyData &body = simulator.world().soft_bodies()[input.body];
		for (std::uint32_t point = 0; input.impulse != Vec2{} && point < body.point_count(); ++point) {
			body.apply_impulse(point, input.impulse * body.shape().masses()[point]);
		}
	}
	simulator.simulate(Real(1) / 60);
}

/// One of two players, with a world of their own.
class Peer {
public:
	Peer(int player, WorldData world, std::vector<PlayerInput> own) :
			player_(player), world_(std::move(world)), simulator_(world_), own_(std::move(own)), heard_(own_.size()), used_(own_.size()), hashes(own_.size()) {}

	struct Packet {
		int due = 0;
		int first = 0; ///< tick
		std::vector<PlayerInput> inputs;
	};
	/// What the peer sends: its latest inputs, as earlier packets may be lost.
	Packet packet(int due) const {
		const int last = std::min(tick_ + 1, int(own_.size()));
		const int first = std::max(0, last - 3 * ROLLBACK_WINDOW);
		return { due, first, { own_.begin() + first, own_.begin() + last } };
	}
	void hear(const Packet &packet) {
		for (std::size_t i = 0; i < packet.inputs.size(); ++i) {
			heard_[std::size_t(packet.first) + i] = packet.inputs[i];
		}
		while (known_ < int(heard_.size()) && heard_[std::size_t(known_)]) {
			++known_;
		}
	}
	bool is_done() const { return tick_ == int(own_.size()) && known_ == tick_; }
	/// Goes back to the first tick whose prediction was wrong, and then one tick ahead, if the other is near enough.
	void advance(NetplayResult &result) {
		const int now = tick_;
		for (int tick = std::max(0, now - ROLLBACK_WINDOW); tick < now; ++tick) {
			if (heard_[std::size_t(tick)] && heard_[std::size_t(tick)] != used_[std::size_t(tick)]) {
				roll_back(tick, result);
				break;
			}
		}
		while (tick_ < now) {
			step();
			++result.replayed;
		}
		if (tick_ < int(own_.size()) && tick_ - known_ < ROLLBACK_WINDOW) {
			step();
		} else if (!is_done()) {
			++result.stalls;
		}
	}

private:
	void roll_back(int tick, NetplayResult &result) {
		if (!state_.read(simulator_, {}, snapshots_[std::size_t(tick % (ROLLBACK_WINDOW + 1))])) {
			state_.put_back(simulator_);
		}
		++result.rollbacks;
		result.deepest = std::max(result.deepest, tick_ - tick);
		tick_ = tick;
	}
	void step() {
		std::vector<std::uint8_t> &snapshot = snapshots_[std::size_t(tick_ % (ROLLBACK_WINDOW + 1))];
		snapshot = state_.save(simulator_, {}, {}, std::move(snapshot)).value();
		const std::size_t tick = std::size_t(tick_);
		used_[tick] = heard_[tick] ? *heard_[tick] : known_ > 0 ? *heard_[std::size_t(known_ - 1)] : PlayerInput{};
		if (player_ == 0) {
			step_with(simulator_, own_[tick], used_[tick]);
		} else {
			step_with(simulator_, used_[tick], own_[tick]);
		}
		hashes[tick] = hash_of_motion(world_);
		++tick_;
	}

	int player_;
	WorldData world_;
	Simulator simulator_;
	WorldState state_;
	std::vector<PlayerInput> own_;
	std::vector<std::optional<PlayerInput>> heard_; ///< of the other, of each tick
	std::vector<PlayerInput> used_; ///< of the other, as predicted or heard
	std::array<std::vector<std::uint8_t>, ROLLBACK_WINDOW + 1> snapshots_;
	int tick_ = 0;
	int known_ = 0; ///< ticks of which all inputs of the other are known

public:
	std::vector<std::uint64_t> hashes; ///< after each tick, as last stepped
};

/// `make_world` makes the same world each time; a push changes a velocity by up to `speed`.
template <class MakeWorld>
NetplayResult play_over_network(const MakeWorld &make_world, Real speed, const NetplayOptions &options) {
	WorldData world = make_world();
	const std::uint32_t bodies = std::uint32_t(world.soft_bodies().size());
	const std::array<std::vector<PlayerInput>, 2> inputs = { make_inputs(2 * options.seed, options.ticks, bodies, speed),
		make_inputs(2 * options.seed + 1, options.ticks, bodies, speed) };
	std::vector<std::uint64_t> truth;
	Simulator simulator(world);
	for (std::size_t tick = 0; tick < inputs[0].size(); ++tick) {
		step_with(simulator, inputs[0][tick], inputs[1][tick]);
		truth.push_back(hash_of_motion(world));
	}
	std::array<Peer, 2> peers = { Peer(0, make_world(), inputs[0]), Peer(1, make_world(), inputs[1]) };
	std::array<std::vector<Peer::Packet>, 2> on_the_way; ///< to each peer
	Random network(options.seed + 1000);
	NetplayResult result;
	result.ticks = options.ticks;
	for (int now = 0; !(peers[0].is_done() && peers[1].is_done()) && now < 20 * options.ticks; ++now) {
		for (std::size_t i = 0; i < 2; ++i) {
			for (const Peer::Packet &packet : on_the_way[i]) {
				if (packet.due <= now) {
					peers[i].hear(packet);
				}
			}
			std::erase_if(on_the_way[i], [now](const Peer::Packet &packet) { return packet.due <= now; });
			peers[i].advance(result);
			const int delay = network.integer(1, options.most_delay);
			if (!network.chance(options.loss)) {
				on_the_way[1 - i].push_back(peers[i].packet(now + delay));
			}
		}
	}
	for (Peer &peer : peers) {
		peer.advance(result); // what was heard last
	}
	for (std::size_t tick = 0; tick < truth.size(); ++tick) {
		result.mismatches += int(peers[0].hashes[tick] != truth[tick] || peers[1].hashes[tick] != truth[tick]);
	}
	return result;
}

} // namespace softbody::testing
