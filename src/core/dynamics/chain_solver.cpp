// SPDX-License-Identifier: MIT
// Solves one open chain.
#include "core/dynamics/chain_solver.h"

#include <algorithm>
#include <cmath>

namespace softbody {

namespace {

// The second pass needs the tension of the first. Further ones find which links pull, and which places press and slide.
constexpr int PASSES = 2;
constexpr int MOST_PASSES = 7;

// Mass that holds a place on a surface, over the mean mass of a section.
constexpr double HOLDING_MASS = 1e6;

// Compliance of a link that keeps its length, over the inverse of the least mass: for chains tight between two fixed ends,
// whose equations would else contradict each other in the last digits.
constexpr double LEAST_COMPLIANCE = 1e-9;

// A link that is not tight is pushed to its length by a spring of this angular frequency for the mass of its ends [rad/s], with this
// damping time [s]. A link as stiff against pushes as against pulls would let a heavy load kick the light rope before it aside.
constexpr double SLACK_FREQUENCY = 100;
constexpr double SLACK_DAMPING_TIME = 0.01;

// The same while links are closed. A chain that is a little too long for its two ends cannot become right, and a straight one would be
// thrown aside by any attempt. A whole chain of 40 links closes by a tenth in a substep, neighbors at once.
constexpr double CLOSING_COMPLIANCE = 0.05;

// Share of the link's length by which its ends may pass each other across it in a substep: beyond, a link turns by more than a
// linear equation says.
constexpr double MOST_TURN = 0.8;

// How far the stiffness of links against being turned is taken at the end of the substep. Stable for any tension from 1/2 - 2/s
// on, with s = (h ω)². Slow swinging (s near 0) is not damped; what the substep cannot show dies away.
double implicit_share(double s) {
	return s / (s + 2);
}

// Change of a contact's impulse, as a share of it, that another pass is worth.
constexpr double ENOUGH = 0.02;

// Share of its length by which a link counts as tight.
constexpr double TIGHT = 1e-6;

constexpr std::size_t dof(std::size_t section) {
	return 3 * section;
}
// After both of its sections, so that its leading minor is negative.
constexpr std::size_t dof_of_link(std::size_t link) {
	return 3 * (link + 1) + 2;
}

// How a link is solved: it pulls; a spring pushes it to its length; or nothing acts along it.
enum LinkState : char {
	TIGHT_LINK,
	SHORT_LINK,
	LOOSE_LINK,
};

bool keeps_lengths(const BodySettings &settings) {
	return std::isinf(settings.axial_stiffness);
}

double cube(double x) {
	return x * x * x;
}

} // namespace

void ChainSolver::measure_links(const ChainSubstep &step) {
	const std::size_t links = step.x.size() - 1;
	directions_.resize(links);
	sizes_.resize(links);
	for (std::size_t i = 0; i < links; ++i) {
		const Vec2d d = step.x[i + 1] - step.x[i];
		sizes_[i] = length(d);
		directions_[i] = sizes_[i] > 0 ? d * (1 / sizes_[i]) : Vec2d{ 1, 0 };
		sizes_[i] = std::max(sizes_[i], 1e-3 * double(step.chain.lengths()[i]));
	}
}

void ChainSolver::begin(const ChainSubstep &step) {
	const std::size_t n = step.x.size();
	const std::span<const Real> masses = step.chain.masses();
	system_.begin(3 * n);
	for (const ChainLoad &load : step.loads) {
		if (load.is_fixed) {
			system_.prescribe(dof(load.section), load.velocity.x);
			system_.prescribe(dof(load.section) + 1, load.velocity.y);
		}
	}
	double sum = 0;
	least_mass_ = double(masses[0]);
	for (std::size_t i = 0; i < n; ++i) {
		sum += double(masses[i]);
		least_mass_ = std::min(least_mass_, double(masses[i]));
		if (step.is_fixed[i] != 0) {
			system_.prescribe(dof(i), start_[i].x);
			system_.prescribe(dof(i) + 1, start_[i].y);
		}
	}
	stiff_ = HOLDING_MASS * sum / double(n);
}

void ChainSolver::add_block(std::size_t i, std::size_t j, double xx, double xy, double yx, double yy) {
	const std::size_t a = dof(i);
	const std::size_t b = dof(j);
	system_.add(a, b, xx);
	system_.add(a + 1, b + 1, yy);
	if (i == j) {
		system_.add(a, b + 1, xy);
	} else {
		system_.add(a, b + 1, xy);
		system_.add(a + 1, b, yx);
	}
}

// Energy EI/2 |κ|² of the mean length of two links, with κ = Σ g x - κ0 linear in the places of three sections.
void ChainSolver::add_bending(const ChainSubstep &step) {
	const BodySettings &settings = step.settings;
	if (!(settings.bending_stiffness > 0)) {
		return;
	}
	const double factor = step.h * (step.h + double(settings.chain_damping_time));
	for (std::size_t i = 1; i + 1 < step.x.size(); ++i) {
		const double a = double(step.chain.lengths()[i - 1]);
		const double b = double(step.chain.lengths()[i]);
		const double g[3] = { 2 / ((a + b) * a), -2 / (a * b), 2 / ((a + b) * b) };
		const double k = double(settings.bending_stiffness) * cube(double(step.chain.width_shares()[i])) * (a + b) / 2;
		Vec2d bent = (step.x[i - 1] - step.x[i]) * g[0] + (step.x[i + 1] - step.x[i]) * g[2];
		const Vec2d way = step.x[i + 1] - step.x[i - 1];
		const double size = length(way);
		if (settings.rest_bend > 0 && size > 0) {
			const Vec2d tangent = way * (1 / size);
			const Vec2d rest = Vec2d(step.chain.curvatures()[i]) * double(settings.rest_bend);
			bent -= tangent * rest.x + perpendicular(tangent) * rest.y;
		}
		for (std::size_t p = 0; p < 3; ++p) {
			const Vec2d push = bent * (-step.h * k * g[p]);
			system_.add_right(dof(i - 1 + p), push.x);
			system_.add_right(dof(i - 1 + p) + 1, push.y);
			for (std::size_t q = 0; q <= p; ++q) {
				const double entry = factor * k * g[p] * g[q];
				add_block(i - 1 + p, i - 1 + q, entry, 0, 0, entry);
			}
		}
	}
}

// Rows of the links. For one that stretches by EA: λ = h EA/L (C + (h + β) J v).
void ChainSolver::add_links(const ChainSubstep &step, std::span<const double> wanted, double compliance_scale, double slack_scale) {
	system_.prescribe(2, 0); // the place of a link before the first
	for (std::size_t i = 0; i < directions_.size(); ++i) {
		const std::size_t row = dof_of_link(i);
		if (link_states_[i] == LOOSE_LINK || (link_states_[i] == SHORT_LINK && slack_scale == 0)) {
			system_.prescribe(row, 0);
			continue;
		}
		const Vec2d n = directions_[i];
		system_.add(row, dof(i), -n.x);
		system_.add(row, dof(i) + 1, -n.y);
		system_.add(row, dof(i + 1), n.x);
		system_.add(row, dof(i + 1) + 1, n.y);
		double compliance = (slack_scale > 0 ? LEAST_COMPLIANCE : CLOSING_COMPLIANCE) / least_mass_;
		if (link_states_[i] == SHORT_LINK) {
			const double m = double(std::min(step.chain.masses()[i], step.chain.masses()[i + 1]));
			compliance += slack_scale / (m * SLACK_FREQUENCY * SLACK_FREQUENCY);
		} else if (!keeps_lengths(step.settings)) {
			const double share = (double(step.chain.width_shares()[i]) + double(step.chain.width_shares()[i + 1])) / 2;
			compliance += compliance_scale * double(step.chain.lengths()[i]) / (double(step.settings.axial_stiffness) * share);
		}
		system_.add(row, row, -compliance);
		system_.add_right(row, wanted[i]);
	}
}

// A link that would push is slack, and one that would get too long is not. Returns whether any has changed.
bool ChainSolver::update_links(const ChainSubstep &step) {
	bool has_changed = false;
	for (std::size_t i = 0; i < directions_.size(); ++i) {
		const double least = TIGHT * double(step.chain.lengths()[i]) / step.h;
		const double rate = dot(directions_[i], found_[i + 1] - found_[i]);
		const bool is_slack = link_states_[i] != TIGHT_LINK ? rate <= longest_[i] + least : tension_[i] < 0;
		has_changed |= is_slack != (link_states_[i] != TIGHT_LINK);
		link_states_[i] = char(is_slack ? LOOSE_LINK : TIGHT_LINK);
	}
	return has_changed;
}

void ChainSolver::add_tension(const ChainSubstep &step) {
	const std::span<const Real> masses = step.chain.masses();
	for (std::size_t i = 0; i < directions_.size(); ++i) {
		const double pull = std::max(tension_[i], 0.0) / sizes_[i]; // h T/|d|
		const double fast = 4 * step.h * pull / double(std::min(masses[i], masses[i + 1])); // (h ω)²
		const double factor = implicit_share(fast) * step.h * pull;
		const Vec2d n = directions_[i];
		const double xx = factor * n.y * n.y;
		const double xy = -factor * n.x * n.y;
		const double yy = factor * n.x * n.x;
		add_block(i, i, xx, xy, xy, yy);
		add_block(i + 1, i + 1, xx, xy, xy, yy);
		add_block(i + 1, i, -xx, -xy, -xy, -yy);
	}
}

double ChainSolver::along(const ChainContact &contact, std::span<const Vec2d> v, Vec2d direction) const {
	return dot(direction, v[contact.section] * contact.share + v[contact.other] * (1 - contact.share));
}

void ChainSolver::add_contacts(const ChainSubstep &step, bool is_move) {
	for (const ChainContact &contact : step.contacts) {
		if (!contact.presses) {
			continue;
		}
		const std::size_t ends = contact.section == contact.other || contact.share == 1 ? 1 : 2;
		const double shares[2] = { ends == 1 ? 1.0 : contact.share, 1 - contact.share };
		const std::size_t sections[2] = { contact.section, contact.other };
		const auto hold = [&](Vec2d n, double mass, double wanted) {
			for (std::size_t p = 0; p < ends; ++p) {
				system_.add_right(dof(sections[p]), mass * wanted * shares[p] * n.x);
				system_.add_right(dof(sections[p]) + 1, mass * wanted * shares[p] * n.y);
				for (std::size_t q = 0; q < ends; ++q) {
					if (sections[q] <= sections[p]) {
						const double entry = mass * shares[p] * shares[q];
						add_block(sections[p], sections[q], entry * n.x * n.x, entry * n.x * n.y, entry * n.x * n.y, entry * n.y * n.y);
					}
				}
			}
		};
		if (is_move) {
			hold(contact.normal, stiff_, 0);
			continue;
		}
		const Vec2d tangent = perpendicular(contact.normal);
		hold(contact.normal, stiff_, dot(contact.velocity, contact.normal) - std::max(contact.gap, 0.0) / step.h);
		// As a drag, which stops a place and never throws it, however wrong the impulse of the last pass was.
		hold(tangent, std::min(contact.friction * contact.normal_impulse / contact.slip, stiff_), dot(contact.velocity, tangent));
	}
}

// Finds from the velocities of the last pass which places press, and how hard. The first pass knows no
// friction, and its slip says nothing. Returns whether the next pass would differ.
bool ChainSolver::update_contacts(const ChainSubstep &step, bool has_changed, bool has_friction) {
	for (ChainContact &contact : step.contacts) {
		const Vec2d tangent = perpendicular(contact.normal);
		const double wanted = dot(contact.velocity, contact.normal) - std::max(contact.gap, 0.0) / step.h;
		const double speed = along(contact, found_, contact.normal);
		const double slip = std::abs(along(contact, found_, tangent) - dot(contact.velocity, tangent));
		const double impulse = contact.presses ? std::max(stiff_ * (wanted - speed), 0.0) : 0.0;
		const bool presses = contact.presses ? impulse > 0 : speed < wanted;
		has_changed |= presses != contact.presses || std::abs(impulse - contact.normal_impulse) > ENOUGH * impulse;
		contact.presses = presses;
		contact.normal_impulse = impulse;
		contact.slip = has_friction ? std::max(slip, step.least_slip) : contact.slip;
	}
	return has_changed;
}

void ChainSolver::solve_velocities(const ChainSubstep &step, std::span<Vec2d> v, double drift_rate) {
	const std::size_t n = step.x.size();
	start_.assign(v.begin(), v.end());
	found_ = start_;
	tension_.assign(n - 1, 0.0);
	wanted_.resize(n - 1);
	longest_.resize(n - 1);
	measure_links(step);
	link_states_.assign(n - 1, 0);
	for (ChainContact &contact : step.contacts) {
		const Vec2d tangent = perpendicular(contact.normal);
		contact.presses = contact.gap <= 0;
		contact.normal_impulse = 0;
		contact.slip = std::max(std::abs(along(contact, start_, tangent) - dot(contact.velocity, tangent)), step.least_slip);
	}
	const bool keeps = keeps_lengths(step.settings);
	const double stretch_time = step.h + double(step.settings.chain_damping_time);
	const double slack_time = step.h + SLACK_DAMPING_TIME;
	for (std::size_t i = 0; i + 1 < n; ++i) {
		link_states_[i] = char(sizes_[i] < double(step.chain.lengths()[i]) * (1 - TIGHT) ? SHORT_LINK : TIGHT_LINK);
	}
	for (int pass = 0; pass < MOST_PASSES; ++pass) {
		begin(step);
		for (std::size_t i = 0; i < n; ++i) {
			const double m = double(step.chain.masses()[i]);
			add_block(i, i, m, 0, 0, m);
			const Vec2d momentum = start_[i] * m + step.force[i] * step.h;
			system_.add_right(dof(i), momentum.x);
			system_.add_right(dof(i) + 1, momentum.y);
		}
		for (const ChainLoad &load : step.loads) {
			if (!load.is_fixed) {
				add_block(load.section, load.section, load.mass_xx, load.mass_xy, load.mass_xy, load.mass_yy);
				system_.add_right(dof(load.section), load.mass_xx * load.velocity.x + load.mass_xy * load.velocity.y);
				system_.add_right(dof(load.section) + 1, load.mass_xy * load.velocity.x + load.mass_yy * load.velocity.y);
			}
		}
		add_bending(step);
		for (std::size_t i = 0; i + 1 < n; ++i) {
			// A link that turns gets longer than its direction says: by the way of its ends across it.
			const Vec2d apart = start_[i + 1] - start_[i];
			const double across = std::min(std::abs(cross(directions_[i], apart)) * step.h, MOST_TURN * sizes_[i]);
			const double lengthening = sizes_[i] - std::sqrt(sizes_[i] * sizes_[i] - across * across);
			const double stretch = sizes_[i] - double(step.chain.lengths()[i]);
			const double rate = stretch < 0 ? 1 / step.h : keeps ? drift_rate : 1 / stretch_time; // up to its length, but no further
			longest_[i] = -lengthening / step.h - stretch * rate;
			link_states_[i] = char(link_states_[i] == 0 ? TIGHT_LINK : stretch < 0 ? SHORT_LINK : LOOSE_LINK);
			wanted_[i] = link_states_[i] == SHORT_LINK ? -stretch / slack_time : longest_[i];
		}
		add_links(step, wanted_, 1 / (step.h * stretch_time), 1 / (step.h * slack_time));
		add_tension(step);
		add_contacts(step, false);
		const std::vector<double> &found = system_.solve();
		for (std::size_t i = 0; i < n; ++i) {
			found_[i] = { found[dof(i)], found[dof(i) + 1] };
			if (i > 0) {
				tension_[i - 1] = found[dof_of_link(i - 1)];
			}
		}
		const bool has_changed = update_links(step);
		if (!update_contacts(step, has_changed || pass + 1 < PASSES, pass > 0)) {
			break;
		}
	}
	for (ChainLoad &load : step.loads) {
		const Vec2d change = load.velocity - found_[load.section];
		load.impulse = { load.mass_xx * change.x + load.mass_xy * change.y, load.mass_xy * change.x + load.mass_yy * change.y };
		if (load.is_fixed) {
			const std::size_t i = load.section;
			load.impulse = (found_[i] - start_[i]) * double(step.chain.masses()[i]) - step.force[i] * step.h;
			load.impulse -= i + 1 < n ? directions_[i] * tension_[i] : Vec2d{};
			load.impulse += i > 0 ? directions_[i - 1] * tension_[i - 1] : Vec2d{};
		}
	}
	std::ranges::copy(found_, v.begin());
}

bool ChainSolver::close_links(const ChainSubstep &step, std::span<Vec2d> moves) {
	constexpr double NOTICED = 1e-5; // of a link's length
	const std::size_t n = step.x.size();
	std::ranges::fill(moves, Vec2d{});
	measure_links(step);
	wanted_.resize(n - 1);
	link_states_.assign(n - 1, 0);
	bool is_needed = false;
	for (std::size_t i = 0; i + 1 < n; ++i) {
		const double rest = double(step.chain.lengths()[i]);
		link_states_[i] = char(sizes_[i] < rest ? SHORT_LINK : TIGHT_LINK);
		wanted_[i] = keeps_lengths(step.settings) && link_states_[i] == TIGHT_LINK ? std::max(rest - sizes_[i], -rest / 2) : 0.0;
		is_needed |= std::abs(wanted_[i]) > NOTICED * rest;
	}
	for (const ChainLoad &load : step.loads) {
		is_needed |= load.is_fixed && load.gap != Vec2d{};
	}
	if (!is_needed) {
		return false;
	}
	start_.assign(n, Vec2d{});
	begin(step);
	for (const ChainLoad &load : step.loads) {
		if (load.is_fixed) {
			system_.prescribe(dof(load.section), load.gap.x);
			system_.prescribe(dof(load.section) + 1, load.gap.y);
		}
	}
	for (std::size_t i = 0; i < n; ++i) {
		const double m = double(step.chain.masses()[i]);
		add_block(i, i, m, 0, 0, m);
	}
	for (const ChainLoad &load : step.loads) {
		if (!load.is_fixed) {
			add_block(load.section, load.section, load.mass_xx, load.mass_xy, load.mass_xy, load.mass_yy);
		}
	}
	add_links(step, wanted_, 0, 0);
	add_contacts(step, true);
	const std::vector<double> &found = system_.solve();
	for (std::size_t i = 0; i < n; ++i) {
		moves[i] = { found[dof(i)], found[dof(i) + 1] };
	}
	return true;
}

} // namespace softbody
