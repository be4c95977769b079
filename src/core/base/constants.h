// SPDX-License-Identifier: MIT
// Every tolerance and default of the core, each with its unit and what changing it does.
#pragma once

#include "core/base/real.h"

namespace softbody {

/// Smallest number of hull points. Two points enclose no area.
inline constexpr int MIN_HULL_POINTS = 3;

/// Largest number of hull points accepted [1]. The check for self-intersection is quadratic:
/// 4096 points take about 50 ms once, at creation.
inline constexpr int MAX_HULL_POINTS = 4096;

/// Share of the squared distance of two points by which a third must lie inside the circle over them to count as
/// between them [1]. Larger: points are joined past others. Smaller: rounding decides which diagonals a lattice gets.
inline constexpr Real CIRCLE_TOLERANCE = Real(1e-4);

/// Largest Poisson's ratio of a material [1]. At 1/2, the limit of theory, nothing can change its area, and the moduli
/// are infinite.
inline constexpr Real MOST_POISSON_RATIO = Real(0.49);

/// Largest substep count accepted or chosen [1]. Past it a body cannot be stepped explicitly in
/// real time; the plan then reports itself as unsafe instead of growing without bound.
inline constexpr int MAX_SUBSTEPS = 64;

/// Length of the step [s] for which counts of substeps below are meant. A longer one takes more in proportion, or contacts
/// and XPBD would be as much worse at 30 ticks a second as the step is longer.
inline constexpr Real USUAL_STEP = Real(1) / 60;

/// Fewest substeps the automatic rule gives a body that can touch something [1]. Contacts are
/// found once a substep, and below four a resting body visibly sinks and creeps.
inline constexpr int MIN_CONTACT_SUBSTEPS = 4;

/// Most substeps in which bodies that touch one another look for contacts because one of them needs as many force
/// substeps [1]. Stiffer bodies take several force substeps in each.
inline constexpr int MAX_CONTACT_SUBSTEPS = 16;

/// A body whose center of mass moves slower than this [length/s, times WorldData::length_unit], and its points, root mean
/// square weighted by mass, slower than SLEEP_WOBBLE times this [1], counts as at rest. Larger: bodies stop in the middle of
/// a slow roll, or of a wobble. Smaller: piles in which a light body trembles between heavy ones never sleep.
inline constexpr Real SLEEP_SPEED = Real(0.05);
inline constexpr Real SLEEP_WOBBLE = 3;

/// The same, for the points too, of a body that no gravity acts on [length/s, times WorldData::length_unit]: what drifts is not at rest, however
/// slow. In pixels it is the default of Godot's own bodies.
inline constexpr Real SLEEP_SPEED_WEIGHTLESS = Real(0.02);

/// Time [s] after which a body that has hardly moved is drowsy, and time in which its velocities then fall to 1/e. What is
/// left of them are tremors that let a pile creep, slip somewhere, and wake itself: 1000 bodies fell asleep after 16 s, and
/// do after 11. Longer: as before. Shorter: slow bodies stick.
inline constexpr Real DROWSY_TIME = Real(0.1);
inline constexpr Real DROWSY_DECAY = Real(0.1);

/// Time [s] that an island of touching bodies must have been at rest before it falls asleep.
inline constexpr Real SLEEP_TIME = Real(0.5);

/// Share of the smaller body's radius by which bodies may be inside one another before they are moved apart as
/// wholes, and by which they are moved at most in a substep [1]. Smaller: piles are moved instead of pressed.
/// Larger: bodies that start inside one another strain their springs and jump apart.
inline constexpr Real DEEP_OVERLAP = Real(0.1);

/// Share of the smaller body's radius by which a contact of one substep pushes points out of an overlap that is older
/// than the substep [1]. Larger: what is left of a deep overlap jumps apart. Smaller: points stay inside for longer.
inline constexpr Real OLD_OVERLAP_PUSH = Real(0.02);

/// Share of the thinner body's width that two bodies may move towards each other in a substep before their contacts
/// are sought along the way [1]. Larger: fast points may be taken for having come from the other side.
inline constexpr Real SWEEP_SHARE = Real(0.25);

/// Distance that a hull keeps from itself where it collides with itself, as a share of its shortest edge at rest [1].
/// Larger: folds stay visibly apart. Smaller: rounding may cross them, above all far from the world's origin.
inline constexpr Real SELF_GAP = Real(1) / 32;

/// Share of its convex hull that an outline without deep dents fills [1]. Larger: bodies that cannot meet themselves are
/// watched for it, which takes two to four times as long. Smaller: arms and lips pass through each other.
inline constexpr Real LEAST_SOLIDITY = Real(0.95);

/// How often the contacts of a hull with itself are gone through in a substep before what still crosses is moved as one
/// piece [1]. Fewer: a body that lies folded on itself stiffens. More: costs as much again, where it is folded.
inline constexpr int SELF_CONTACT_PASSES = 4;

/// Stability budget S of the substep rule h²Ω² + 2hΓ <= S² [1]. 2 is the limit of the linear
/// theory and fails for crumpled bodies. At 1.3 none of 12 500 random crumpled bodies (`bench.sh auto`) becomes
/// non-finite or doubles its energy, with 1.9 times the fewest substeps that a search finds safe; of 12 000 others one
/// came to 2.03 times.
inline constexpr Real STABILITY_BUDGET = Real(1.3);

/// Most substeps the automatic choice spends on explicit springs [1]; past it the body goes to XPBD,
/// which gains no energy with any stiffness but damps the wobble.
inline constexpr int EXPLICIT_SUBSTEP_CAP = 32;

/// Substeps of a body that went to XPBD [1]. More make it stiffer and livelier.
inline constexpr int XPBD_SUBSTEPS = 8;

/// Damping ratio c / sqrt(k m) below which large deformations ring for long and a pile may not
/// settle [1]. Nothing is clamped to it; the node warns.
inline constexpr Real DAMPING_FLOOR = Real(0.02);

/// Default shape-matching stiffness as a fraction of the springs' stiffness [1]. Below about
/// 0.4, some strongly deformed bodies stay folded for good.
inline constexpr Real DEFAULT_SHAPE_MATCHING = Real(0.4);

/// Half thickness given to a line segment [length, in world units where gravity is about 10
/// a meter: multiplied by WorldData::length_unit]. A point rests this far from the line, so that
/// rounding can never put it on the other side. Larger: visible gap. Smaller: leaks far from the origin.
inline constexpr Real LINEAR_SLOP = Real(0.001);

/// How deep a body may be in a one-way collider and still be held by it, if the collider does not say [length, times
/// WorldData::length_unit]. Larger: bodies that have hardly come through from behind are taken up. Smaller: what is
/// pressed into it for a moment may fall through.
inline constexpr Real ONE_WAY_MARGIN = Real(0.01);

/// Least cosine between a contact's normal and the direction in which a one-way collider holds [1]. Larger: round ends and
/// slopes let slip what lies on them. Smaller: steep sides hold, too.
inline constexpr Real ONE_WAY_FACING = Real(0.1);

/// How far apart, in radii, the points of a joined body may be before it counts as blown up and is reset, and how far
/// it may fly in a step for that flight to outlast a reset [1]. Larger: a body that blows up over several steps
/// reappears away from where it was. Smaller: one that is only stretched is taken for lost.
inline constexpr Real CREDIBLE_REACH = 1000;

/// Limits of shape that suit nearly every body [1]: half of its area, a fifth of its thickness, three times its length.
inline constexpr Real DEFAULT_LEAST_AREA = Real(0.5);
inline constexpr Real DEFAULT_LEAST_STRETCH = Real(0.2);
inline constexpr Real DEFAULT_MOST_STRETCH = 3;

/// By how much a stretch or area out of bounds is corrected in a substep, as a share of the rest size or area [1]. Larger:
/// crushed bodies jump up. Smaller: they are out of bounds for longer.
inline constexpr Real LIMIT_PUSH = Real(0.05);

/// From which multiple of its least area on a body is smoothed [1]. Larger: bodies under load keep fewer dents. Smaller: single
/// points fold in before the area is lost.
inline constexpr Real LIMIT_ONSET = Real(1.5);

/// How fast a body is brought back at most that is crumpled, out of bounds by more than LIMIT_FAR, or that nothing can press on
/// [radii/s]. Larger: ruined bodies burst. What a load presses out of bounds gets the velocity of a constraint: with a bound on it
/// of even 8 radii a second, twenty soft bodies on top of each other were crushed.
inline constexpr Real LIMIT_SPEED = 4;
inline constexpr Real LIMIT_FAR = Real(0.3);

/// Which share of its way to where the body's affine map has it a point of a crumpled body goes in a substep at most [1].
inline constexpr Real LIMIT_SMOOTHING = Real(0.25);

/// Springs shorter than this fraction of their rest length have no usable direction and exert no
/// force for that evaluation [1].
inline constexpr Real DEGENERATE_LENGTH = Real(1e-6);

/// Approach speeds below this many substeps of free fall do not bounce [1]. A resting point gains
/// one substep of gravity between contacts; without the threshold restitution would keep it alive.
inline constexpr Real RESTITUTION_SUBSTEPS = 2;

/// Time [s] over which a body that hardly moves forgets how fast it landed. Longer: a body that has come
/// to rest leaps when it is nudged. Shorter: the turning point of a slow landing costs it its bounce.
inline constexpr Real BOUNCE_MEMORY = Real(0.3);

/// Time [s] without a contact after which a touch has ended for those who monitor it. Longer: ends are told late.
/// Shorter: the trembling of bodies that come to rest is told as ends and beginnings.
inline constexpr Real TOUCH_MEMORY = Real(0.05);

/// Share of the smaller body's radius by which a body and what it touched must also have parted for their touch to end
/// [1]. Smaller: neighbors in a pile, which hardly press on each other, touch and part for as long as the pile creeps,
/// and so does a body that hops as it comes to rest. Larger: bodies count as touching where one sees that they do not.
inline constexpr Real TOUCH_GAP = Real(0.02);

/// How often the contacts with rigid bodies that can be pushed are gone through in each substep [1]. Fewer: a box on
/// several bodies rocks longer.
inline constexpr int RIGID_CONTACT_PASSES = 4;

/// How often the joints are gone through in each substep [1]. Fewer: several joints on one point or rigid body give way to
/// one another.
inline constexpr int JOINT_PASSES = 4;

/// Share of the smaller body's radius by which a rigid joint that was made or torn open closes in a substep, beyond what has
/// opened it within the substep [1]. Larger: bodies are snatched together. Smaller: slowly drawn.
inline constexpr Real JOINT_GAP_CLOSING = Real(0.02);

/// Share of its gap that a rigid joint closes in a step where only the rigid body can move [1]. Larger: it overshoots, as
/// its engine moves the body once a step. Smaller: the gap closes slowly.
inline constexpr Real JOINT_PULL = Real(0.2);

/// Least inverse_mass of a place on a hull edge, as a share of its lighter end's [1]. An end is moved by at
/// most 1 / sqrt of this, 5 times, what the place must move.
inline constexpr Real LEAST_EDGE_INVERSE_MASS = Real(0.04);

} // namespace softbody
