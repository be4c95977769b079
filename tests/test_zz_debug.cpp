#include "core/collision/environment_contact_solver.h"
#include "core/dynamics/energy.h"
#include "scenes/rope.h"
#include "scenes/thesis_body.h"
#include <cstdio>
#include <doctest/doctest.h>
using namespace softbody; using namespace softbody::testing;
static void dump(RopeWorld &s, const char *tag, int tick) {
	double ymin=1e9,ymax=-1e9,vmax=0; for (auto p: s.body().hull()) { ymin=std::min(ymin,double(p.y)); ymax=std::max(ymax,double(p.y)); }
	for (auto v: s.body().velocities()) vmax=std::max(vmax,double(length(v)));
	std::printf("%s %d y %.4f..%.4f vmax %.3f stretch %.5f E %.4f", tag, tick, ymin, ymax, vmax, stretch_of(s.body()), measure_energy(s.body(), s.world.gravity()).total());
	if (!s.world.rigid_bodies().empty()) { auto &r=s.world.rigid_bodies()[0]; std::printf(" rb %.3f %.3f v %.3f %.3f end %.3f %.3f", r.pose.position.x, r.pose.position.y, r.linear_velocity.x, r.linear_velocity.y, center_place(s.body(), s.body().shape().chain()->count()-1).x, center_place(s.body(), s.body().shape().chain()->count()-1).y); }
	std::printf("\n");
}
TEST_CASE("dbg line") {
	RopeWorld scene(rope_along(line({ -1, Real(0.2) }, { 1, Real(0.3) }, 40), Real(0.05), 1));
	Collider o; o.vertices = { { -3, 0 }, { 3, 0 } }; REQUIRE(!scene.world.add_collider(o));
	for (int t=0;t<60;++t) { scene.simulator.simulate(Real(1)/60); dump(scene,"line",t);} }
TEST_CASE("dbg swing") {
	RopeWorld scene(rope_along(line({ 0, 0 }, { 4, 0 }, 40), Real(0.1), 1)); scene.pin(0);
	const auto w = scene.add_weight({ 4, 0 }, 50); scene.tie(39, w);
	for (int t=0;t<120;++t) { scene.simulator.simulate(Real(1)/60); if (t%4==0) dump(scene,"swing",t); if (t==12||t==18||t==24||t==28) for (int i=24;i<40;++i) { auto p=center_place(scene.body(),i); auto v=scene.body().velocities()[center_of(scene.body(),i)]; auto q=center_place(scene.body(),i-1); std::printf("   %d %.5f %.5f  v %.3f %.3f  link %.5f\n",i,p.x,p.y,v.x,v.y,double(length(p-q))/(4/39.0));} } }
TEST_CASE("dbg whip") {
	RopeWorld scene(rope_along(line({ 0, 0 }, { 2, 0 }, 40), Real(0.03), 1)); scene.pin(0);
	for (int t=0;t<120;++t) { scene.simulator.simulate(Real(1)/60); dump(scene,"whip",t);} }
TEST_CASE("dbg cat") {
	BodySettings settings; settings.linear_damp = 3; settings.can_sleep = false;
	const std::vector<Vec2> v{ { -1, 0 }, { 0, Real(-1.118) }, { 1, 0 } };
	RopeWorld scene(rope_along(divide_path(v, 61).value(), Real(0.01), 1, settings)); scene.pin(0); scene.pin(60);
	for (int t=0;t<1800;++t) { scene.simulator.simulate(Real(1)/60); if (t%100==0) dump(scene,"cat",t);} }
TEST_CASE("dbg ball") {
	RopeWorld scene(rope_along(line({ 0, 0 }, { 0, -4 }, 40), Real(0.1), Real(0.02))); scene.pin(0);
	BodySettings s; s.shape_stiffness = 800; s.shape_damping = 8; s.integrator = Integrator::SEMI_IMPLICIT_EULER;
	const BodyId b = scene.world.add_soft_body(thesis_body(thesis_shape_with_ratio(4000, Real(0.3)), s, { {0,Real(-4.5)}, {} }));
	Joint joint; joint.first = JointAnchor::on_point(scene.rope, center_of(scene.body(), 39)); joint.second = nearest_anchor(*scene.world.find(b), b, { 0, -4 });
	REQUIRE(scene.world.add_joint(joint));
	for (int t=0;t<60;++t) { scene.simulator.simulate(Real(1)/60); dump(scene,"ball",t); std::printf("   ball %.3f %.3f\n", scene.world.find(b)->positions()[8].x, scene.world.find(b)->positions()[8].y);} }
