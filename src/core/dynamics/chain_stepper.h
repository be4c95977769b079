// SPDX-License-Identifier: MIT
// Carries a chain through a substep: its sections to the solver, and back to the points of the body.
#pragma once

#include "core/collision/chain_contacts.h"
#include "core/collision/contact_log.h"
#include "core/dynamics/chain_solver.h"
#include "core/model/soft_body_data.h"

#include <span>
#include <vector>

namespace softbody {

/// One substep of a body whose shape has a chain takes `solve_velocities` and then `move`, then contacts and `take_contacts`. A
/// section's points are in one place of the state each, so that contacts, joints and drawing treat the body as any other; at the
/// start of a substep a section is where the mean of its points is, weighted by mass, with their mean velocity. It owns scratch memory.
/// One object serves one thread.
class ChainStepper {
public:
	/// Solves for the velocities of the substep of `h` [s] that begins `elapsed` [s] after the step began, under all its forces,
	/// with what joints fasten to it; the results are in the loads. Logs contacts of a monitored body. Returns the number of contacts.
	std::size_t solve_velocities(const ColliderIndex &surroundings, SoftBodyData &body, Real elapsed, Real h, std::span<ChainLoad> loads,
			double drift_rate, ContactLog &log);
	/// Moves the body by its velocities, gives the links their lengths, and closes gaps of joints to fixed places. Then each
	/// section is straight and square to the centerline. Keeps the spin of a body that nothing holds.
	void move(const ColliderIndex &surroundings, SoftBodyData &body, Real elapsed, Real h, std::span<ChainLoad> loads);
	/// Stores the points of the body before contacts with the environment.
	void begin_contacts(const SoftBodyData &body);
	/// Lets a section follow those of its points that these contacts have moved.
	void take_contacts(SoftBodyData &body) const;

private:
	void gather(const SoftBodyData &body);
	void gather_forces(const SoftBodyData &body, Vec2 gravity);
	void spread(SoftBodyData &body, bool with_positions);
	double spin_of(const SoftBodyData &body) const;
	void set_spin(SoftBodyData &body, double spin) const;

	ChainSolver solver_;
	ChainContactFinder finder_;
	std::vector<ChainContact> contacts_;
	Vec2 base_; ///< place of the first center: sums relative to it keep digits far from the origin
	std::vector<Vec2d> x_; ///< of the sections, from `base_`
	std::vector<Vec2d> v_;
	std::vector<Vec2d> forces_;
	std::vector<Vec2d> moves_;
	std::vector<char> is_fixed_;
	std::vector<Vec2> external_; ///< on the points
	std::vector<Vec2> old_positions_;
	std::vector<Vec2> old_velocities_;
	double slip_ = 0; ///< ChainSubstep::least_slip
	double spin_ = 0; ///< that the body should have after its move
	bool keeps_spin_ = false;
};

} // namespace softbody
