// SPDX-License-Identifier: MIT
// Solves one open chain: bending, stretch, what hangs on it and what it lies on, at once.
#pragma once

#include "core/base/vec2.h"
#include "core/collision/chain_contacts.h"
#include "core/dynamics/band_system.h"
#include "core/model/body_settings.h"
#include "core/model/chain.h"

#include <cstdint>
#include <span>
#include <vector>

namespace softbody {

/// Substeps of a chain in a step of USUAL_STEP [1]. Fewer: ropes lose their swing sooner, and lie less still on round things.
inline constexpr int CHAIN_SUBSTEPS = 8;

/// What a joint fastens to a section.
struct ChainLoad {
	std::uint32_t section = 0;
	/// Whether the other side moves by itself: a place in the world, a kinematic body.
	bool is_fixed = false;
	// Mass of the other side at the joint, a symmetric matrix [mass].
	double mass_xx = 0;
	double mass_xy = 0;
	double mass_yy = 0;
	Vec2d velocity; ///< of the other side at the joint [length/s]
	Vec2 place; ///< of the other side at the end of the substep [length]
	Vec2d offset; ///< of the joint's place on the section from its center [length]
	Vec2d gap; ///< from that place to the other side after the substep [length]
	Vec2d impulse; ///< result: on the section [mass·length/s]
};

/// A chain in one substep. Arrays have one entry a section.
struct ChainSubstep {
	const ChainShape &chain;
	const BodySettings &settings;
	double h = 0; ///< [s]
	double least_slip = 0; ///< speed below which a place that friction holds may creep [length/s], > 0
	std::span<const Vec2d> x; ///< centers relative to any origin [length]
	std::span<const Vec2d> force; ///< external, with gravity [mass·length/s²]
	std::span<const char> is_fixed; ///< sections that keep their velocity
	std::span<ChainLoad> loads;
	std::span<ChainContact> contacts;
};

/// Steps a chain as one system of equations. Unknown are the velocities of the sections and the tensions of the links:
///   (M + h² K + h² G) v - Jᵀ λ = M v0 + h f - h K x,   J v = (change of length within the substep) / h,
/// with the bending stiffness K of a discrete elastic rod for links that keep their lengths (Bergou and others 2006, "A quadratic
/// bending model for inextensible surfaces"), the stiffness G of links under tension against being turned, and the directions J of the links.
/// Masses of loads are added to M, so that a joint is as rigid as a link, whatever hangs on it. A place that touches a surface is
/// held along the normal while it presses, and dragged along the surface as Coulomb's law says for the speed that it had. The matrix is a band of 13, so that
/// one solution takes O(sections), whatever the load: nothing is left to converge but which places press and slide, and the
/// tension, which the second pass takes from the first. It owns scratch memory.
class ChainSolver {
public:
	/// Changes `v` to the velocities of the coming substep. Links shorter or longer than at rest become right by the share
	/// `drift_rate` of the difference a second [1/s]; not those of a chain that stretches.
	void solve_velocities(const ChainSubstep &step, std::span<Vec2d> v, double drift_rate);
	/// The moves of all sections that give the links their lengths, which change no velocity. Joints close their gaps. Writes none
	/// for a chain that stretches. `x` is after the substep. Returns whether `moves` are not all 0.
	bool close_links(const ChainSubstep &step, std::span<Vec2d> moves);

private:
	void begin(const ChainSubstep &step);
	void add_block(std::size_t i, std::size_t j, double xx, double xy, double yx, double yy);
	void add_bending(const ChainSubstep &step);
	/// `slack_scale` 0: slack links are left out.
	void add_links(const ChainSubstep &step, std::span<const double> wanted, double compliance_scale, double slack_scale);
	void add_tension(const ChainSubstep &step);
	void add_contacts(const ChainSubstep &step, bool is_move);
	bool update_links(const ChainSubstep &step);
	bool update_contacts(const ChainSubstep &step, bool has_changed, bool has_friction);
	void measure_links(const ChainSubstep &step);
	double along(const ChainContact &contact, std::span<const Vec2d> v, Vec2d direction) const;

	BandSystem system_;
	std::vector<Vec2d> directions_; ///< of the links, unit
	std::vector<double> sizes_; ///< present lengths of the links
	std::vector<double> tension_; ///< impulse of each link in the last pass, positive where it pulls [mass·length/s]
	std::vector<char> link_states_; ///< how each link is solved; 0: it pulls
	std::vector<double> longest_; ///< rates at which links may get longer at most [length/s]
	std::vector<double> wanted_; ///< rates at which links get longer [length/s]; or changes of their lengths
	std::vector<Vec2d> start_; ///< velocities before
	std::vector<Vec2d> found_; ///< velocities of the last pass
	double stiff_ = 0; ///< mass that stands for infinity in contacts
	double least_mass_ = 0;
};

} // namespace softbody
