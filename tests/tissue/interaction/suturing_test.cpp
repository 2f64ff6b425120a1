// Needle and thread on an organ that gives way: a stitch, what it holds, how it tears, what is recorded of it.
#include "tissue/interaction/suturing.h"

#include <gtest/gtest.h>

#include <cstring>
#include <ctime>
#include <random>

#include "haptics/input_error.h"
#include "tests/tissue/interaction/needle_rig.h"
#include "tissue/thin/sheet_body.h"

namespace trocar::suturing_test {
namespace {

using Kind = SutureEvent::Kind;

constexpr double kTop = test::NeedleRig::kTop;

struct Sewn {
  explicit Sewn(double thread_m = 0.15, const TissueSolid& tissue = {}, const SutureThreadOptions& thread = {})
      : organ(build_lattice({rest->vertices, rest->triangles}, {.cell_m = 0.01}).lattice, rest, tissue, {}),
        setup{.X_TN = turned(0), .thread_m = thread_m, .thread = thread},
        suturing(setup, organ) {
    const Vec3 held = turned(0) * setup.needle.place(0.3 * setup.needle.length_m);
    jaws = test::jaws_from_above(held - Vec3(0, 0, 0.004));
    X_IN = jaws.inverse() * turned(0);
    suturing.load(jaws, X_IN);
  }
  static Pose turned(double angle) {
    Pose X;
    X.R.col(0) = Vec3::UnitX();
    X.R.col(1) = Vec3::UnitZ();
    X.R.col(2) = -Vec3::UnitY();
    X.R = Mat3(X.R * Eigen::AngleAxisd(angle, Vec3::UnitZ()).toRotationMatrix());
    X.p = Vec3(0, 0, kTop + test::NeedleRig::kOver);
    return X;
  }
  void step(const Pose& X_TI, double opening_m, bool present = true) {
    HapticState state;
    state.stylus.X_TI = X_TI;
    state.stylus.jaw_opening_m = opening_m;
    std::vector<SoftSpring> springs;
    const std::clock_t from = std::clock();
    suturing.before(state, tool, present, organ, springs);
    cpu_s += double(std::clock() - from) / CLOCKS_PER_SEC;
    organ.step({}, nullptr, springs);
    const std::clock_t then = std::clock();
    suturing.after(state, tool, present, springs, organ);
    cpu_s += double(std::clock() - then) / CLOCKS_PER_SEC;
    ++steps;
    jaws = X_TI;
    for (const SutureEvent& event : suturing.events()) all.push_back(event);
  }
  bool told(Kind kind) const {
    return std::any_of(all.begin(), all.end(), [kind](const SutureEvent& event) { return event.kind == kind; });
  }
  /// Jaws over some steps to a place, as they are turned.
  void move(const Vec3& to, double opening_m, int count) {
    const Pose from = jaws;
    for (int i = 1; i <= count; ++i) step({from.R, from.p + (to - from.p) * i / count}, opening_m);
  }
  /// Through the tissue, let go, taken at the point, drawn on along the arc until the thread is in both holes.
  void stitch() {
    for (int i = 0; i <= 660; ++i) step(turned(0.005 * i) * X_IN.inverse(), 0);
    step(jaws, 0.004);
    move(jaws.p + Vec3(0, 0, 0.03), 0.004, 30);
    const Pose at = test::jaws_from_above(suturing.needle().tip_T() - Vec3(0, 0, 0.002));
    for (int i = 0; i <= 10; ++i) step(at, 0.004 * (10 - i) / 10);
    ASSERT_TRUE(suturing.needle().held());
    const Pose taken = at.inverse() * suturing.needle().X_TN();
    const Vec3 middle = suturing.needle().X_TN().p, axis = suturing.needle().X_TN().R.col(2);
    for (int i = 0; i <= 700 && !told(Kind::kStitch); ++i) {
      const Mat3 by = Eigen::AngleAxisd(0.005 * i, axis).toRotationMatrix();
      step(Pose{by * (at * taken).R, middle} * taken.inverse(), 0);
    }
  }
  const Stitch& last() const { return suturing.thread().stitches().back(); }
  double furthest_from_rest() const {
    double most = 0;
    for (std::size_t v = 0; v < rest->vertices.size(); ++v)
      most = std::max(most, (organ.surface()->vertices[v] - rest->vertices[v]).norm());
    return most;
  }

  SurfacePtr rest = test::ellipsoid({0.06, 0.05, kTop}, 48);
  SoftOrgan organ;
  SutureSetup setup;
  Suturing suturing;
  Tool tool = make_tool(InstrumentKind::kGrasper);
  Pose jaws, X_IN;
  std::vector<SutureEvent> all;
  double cpu_s = 0;
  int steps = 0;
};

TEST(Suturing, AStitchIsThreadInBothHoles) {
  Sewn s;
  s.stitch();
  ASSERT_TRUE(s.told(Kind::kPuncture));
  ASSERT_TRUE(s.told(Kind::kExit));
  ASSERT_TRUE(s.told(Kind::kStitch));
  ASSERT_EQ(s.suturing.thread().stitches().size(), 1U);
  EXPECT_EQ(s.suturing.counts().punctures, 1);
  EXPECT_EQ(s.suturing.counts().stitches, 1);
  EXPECT_EQ(s.suturing.counts().tears, 0);
  EXPECT_TRUE(s.suturing.needle().paths().empty());
  EXPECT_NEAR(s.last().bridge_m(), 0.016, 0.002);
  // Drawn up by 60 mm the thread has run through by about as much, and its holes are where it lies.
  const double before = s.last().entry.ring.arc_m;
  s.move(s.jaws.p + Vec3(0, 0, 0.06), 0, 300);
  ASSERT_EQ(s.suturing.thread().stitches().size(), 1U);
  EXPECT_GT(s.last().entry.ring.arc_m - before, 0.04);
  for (const StitchHole* hole : {&s.last().entry, &s.last().exit})
    EXPECT_LT((s.suturing.thread().rod().place_at(hole->ring.arc_m) - hole->at_T).norm(), 5e-4);
  std::printf("thread of 150 mm in a stitch, needle held: %.3f ms CPU a step beside the organ's own\n",
              1e3 * s.cpu_s / s.steps);
}

TEST(Suturing, ThreadIsDrawnThroughAgainstItsFriction) {
  for (const double friction : {10.0, 20.0}) {
    Sewn s(0.15, {}, {.friction_n_per_m = friction, .edge_friction = 0});
    s.stitch();
    double sum = 0;
    int count = 0;
    for (int i = 0; i < 300; ++i) {
      s.move(s.jaws.p + Vec3(0, 0, 2e-4), 0, 1);
      if (i < 200) continue;
      sum += s.suturing.needle().load_T().force.norm();
      ++count;
    }
    EXPECT_NEAR(sum / count, friction * s.last().bridge_m(), 0.25 * friction * s.last().bridge_m()) << friction;
  }
}

TEST(Suturing, DrawnOutNothingIsLeft) {
  Sewn s(0.06);
  s.stitch();
  s.move(s.jaws.p + Vec3(0, 0, 0.1), 0, 400);
  EXPECT_TRUE(s.told(Kind::kDrawnThrough));
  EXPECT_TRUE(s.suturing.thread().stitches().empty());
  for (int i = 0; i < 500; ++i) s.step(s.jaws, 0);
  EXPECT_LT(s.furthest_from_rest(), 1e-4);
}

TEST(Suturing, PulledHarderThanTheTissueBearsAStitchTearsOut) {
  // The thread sticks: what is drawn is the tissue.
  Sewn s(0.15, {}, {.friction_n_per_m = 400});
  s.stitch();
  const double limit = pull_out_force(s.organ.material(), s.last().bridge_m(), s.setup.tissue);
  EXPECT_NEAR(limit, std::min(4.62, 300 * s.last().bridge_m()), 1e-9);
  double most = 0;
  for (int i = 0; i < 900 && !s.told(Kind::kPulledOut); ++i) {
    s.move(s.jaws.p + Vec3(0, 0, 1e-4), 0, 1);
    if (!s.suturing.thread().stitches().empty())
      most = std::max(most, i < 20 ? 0 : s.last().load_n);  // not while the hole takes the thread over
  }
  ASSERT_TRUE(s.told(Kind::kPulledOut));
  EXPECT_NEAR(most, limit, 0.05 * limit);
  EXPECT_TRUE(s.suturing.thread().stitches().empty());
  EXPECT_EQ(s.suturing.counts().tears, 1);
}

TEST(Suturing, TheNeedleHangsOnItsThreadAndLiesOnTheOrgan) {
  Sewn s;
  s.step(s.jaws, 0.004);
  for (int i = 0; i < 400; ++i) s.step(s.jaws, 0.004, false);
  EXPECT_FALSE(s.suturing.needle().held());
  SurfaceWalk walk(*s.rest);
  for (const double share : {0.0, 0.5, 1.0}) {
    std::int32_t vertex = -1;
    const Vec3 place = s.suturing.needle().X_TN() * s.setup.needle.place(share * s.setup.needle.length_m);
    EXPECT_GT(walk.foot(s.organ.surface()->vertices, place, vertex).height_m, -0.001);
  }
  EXPECT_LT((s.suturing.needle().swage_T() - s.suturing.thread().rod().nodes().front().position).norm(), 1e-4);
}

TEST(Suturing, EventsAndNodesMakeTheSamePictureAgain) {
  Sewn s;
  s.stitch();
  std::vector<std::string> changes;
  for (const SutureEvent& event : s.all) {
    changes.push_back(suture_event_bytes(event));
    EXPECT_TRUE(is_suture_event(changes.back()));
    EXPECT_EQ(parse_suture_event(changes.back()), event);
  }
  std::vector<NodePlace> nodes;
  s.suturing.add_nodes(nodes);
  const SuturePlayback playback(s.setup, changes);
  ASSERT_EQ(playback.nodes(), nodes.size());
  const std::vector<SurfacePtr> again = playback.at(nodes);
  for (std::size_t i = 0; i < again[0]->vertices.size(); ++i)
    EXPECT_LT((again[0]->vertices[i] - s.suturing.seen()[0]->vertices[i]).norm(), 1e-6);
  EXPECT_EQ(again[1]->vertices.size(), s.suturing.seen()[1]->vertices.size());
  std::string cut = changes[0];
  cut.pop_back();
  EXPECT_THROW(parse_suture_event(cut), InputError);
}

TEST(SutureEvents, AreNoChangeOfASheetAndThoseOfFormerRecordingsAreRead) {
  const SutureEvent event{.kind = Kind::kSnipped, .entry_rest_T = Vec3(1, 2, 3), .arc_m = 0.1};
  std::string bytes = suture_event_bytes(event);
  EXPECT_FALSE(is_sheet_change(bytes));
  for (const std::size_t edges : {0U, 1U, 9U, 50U}) {
    const std::string sheet = sheet_change_bytes({1, std::vector<SheetEdge>(edges, SheetEdge{3, 4})});
    EXPECT_FALSE(is_suture_event(sheet)) << edges;
    EXPECT_THROW(parse_suture_event(sheet), InputError) << edges;
  }
  constexpr std::int32_t kFormer = -43;
  bytes.replace(0, sizeof kFormer, reinterpret_cast<const char*>(&kFormer), sizeof kFormer);
  EXPECT_TRUE(is_suture_event(bytes));
  EXPECT_EQ(parse_suture_event(bytes), event);
}

TEST(Suturing, AtRandomAllStaysFiniteAndTheSameInputGivesTheSameBytes) {
  const auto run = [](int steps) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> way(-0.004, 0.004), turn(-0.2, 0.2), chance(0, 1);
    Sewn s(0.30);
    Pose X = s.jaws;
    bool sound = true;
    double opening = 0;
    for (int i = 0; i < steps; ++i) {
      X.p += Vec3(way(random), way(random), way(random));
      X.p = X.p.cwiseMax(Vec3(-0.04, -0.04, kTop - 0.015)).cwiseMin(Vec3(0.04, 0.04, kTop + 0.04));
      X.R = Mat3(
          X.R * Eigen::AngleAxisd(turn(random), Vec3(turn(random), turn(random), 0.1).normalized()).toRotationMatrix());
      X.R = Eigen::Quaterniond(X.R).normalized().toRotationMatrix();
      if (chance(random) < 0.02) opening = chance(random) < 0.5 ? 0.006 : 0.0;
      if (i % 1000 == 0) s.suturing.load(Sewn::turned(0) * s.X_IN.inverse(), s.X_IN);
      if (i % 1000 < 400) {  // driven, not steadily, then whatever comes
        X = Sewn::turned(0.005 * (i % 1000) * (0.999 + 0.001 * chance(random))) * s.X_IN.inverse();
        opening = 0;
      }
      s.step(X, opening, i % 1000 < 400 || chance(random) > 0.01);
      for (const RodNode& node : s.suturing.thread().rod().nodes()) sound = sound && node.position.allFinite();
      sound = sound && s.suturing.needle().X_TN().p.allFinite() && s.organ.surface()->vertices[0].allFinite();
    }
    EXPECT_TRUE(sound);
    EXPECT_GT(s.suturing.counts().punctures, 0);
    EXPECT_EQ(s.suturing.thread().rod().held_steps(), 0U);
    std::printf("%d steps at random, thread of 300 mm: %d punctures, %d tears, %.3f ms CPU a step\n", steps,
                s.suturing.counts().punctures, s.suturing.counts().tears, 1e3 * s.cpu_s / s.steps);
    std::vector<NodePlace> nodes;
    s.suturing.add_nodes(nodes);
    return nodes;
  };
  EXPECT_FALSE(run(10000).empty());
  const auto a = run(1000), b = run(1000);
  EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(NodePlace)), 0);
}

TEST(Suturing, AKnotHoldsByItsThrows) {
  // The thread's own friction is small; only the knot keeps the loop from being drawn through.
  const auto drawn = [](const std::vector<Throw>& throws) {
    Sewn s(0.15, {}, {.friction_n_per_m = 2, .edge_friction = 0});
    s.stitch();
    s.move(s.jaws.p + Vec3(0, 0, 0.03), 0, 100);
    for (const Throw& made : throws) s.suturing.tie(made);
    double most = 0;
    for (int i = 0; i < 350; ++i) {
      s.move(s.jaws.p + Vec3(0, 0, 4e-4), 0, 1);
      if (i > 150) most = std::max(most, s.suturing.needle().load_T().force.norm());
    }
    return most;
  };
  const double none = drawn({}), half = drawn({{1, 1}}), granny = drawn({{1, 1}, {1, 1}}),
               square = drawn({{1, 1}, {1, -1}});
  std::printf(
      "most force on a thread drawn by 140 mm: %.2f N without a knot, %.2f half knot, %.2f granny, %.2f square\n", none,
      half, granny, square);
  EXPECT_LT(none, half);
  EXPECT_LT(half, granny);
  EXPECT_GE(square, 0.95 * granny) << "neither slips: the tissue comes along";
}

TEST(Suturing, ANewNeedleIsHeldUntilTheFingersHaveClosedOnItAndOpened) {
  Sewn s;
  const Pose still = s.jaws;
  for (int i = 0; i < 20; ++i) s.step(still, 0.012);
  EXPECT_TRUE(s.suturing.needle().held()) << "the fingers are still open";
  for (int i = 0; i < 20; ++i) s.step(still, 0.0003);
  EXPECT_TRUE(s.suturing.needle().held());
  s.step(still, 0.012);
  EXPECT_FALSE(s.suturing.needle().held());
  ASSERT_FALSE(s.all.empty());
  EXPECT_EQ(s.all.front().kind, Kind::kBroughtIn);
  EXPECT_EQ(s.suturing.counts().needles, 1);
}

TEST(Suturing, ScissorsCutTheThreadAndPlaybackKnows) {
  Sewn s;
  s.stitch();
  s.move(s.jaws.p + Vec3(0, 0, 0.05), 0, 250);
  const std::size_t nodes = s.suturing.thread().rod().nodes().size();
  s.tool = make_tool(InstrumentKind::kScissors);
  const double drawn_to = s.last().exit.ring.arc_m;
  for (int i = 0; i < 400; ++i) s.step({s.jaws.R, Vec3(0, 0, 0.3)}, 0.006);  // the needle falls and hangs
  ASSERT_FALSE(s.suturing.thread().stitches().empty());
  EXPECT_NEAR(s.last().exit.ring.arc_m, drawn_to, 0.003) << "friction keeps the thread where it is";
  // Across the thread, beside the tissue, where it hardly moves.
  const double arc = s.last().exit.ring.arc_m - 0.006;
  const Vec3 at = s.suturing.thread().rod().place_at(arc);
  const Vec3 along = (s.suturing.thread().rod().place_at(arc - 0.002) - at).normalized();
  Pose X;
  X.R.col(2) = along.unitOrthogonal();
  X.R.col(0) = along;
  X.R.col(1) = X.R.col(2).cross(X.R.col(0));
  X.p = at + 0.008 * X.R.col(2);
  s.step(X, 0.006);
  StylusState blades;
  blades.X_TI = X;
  blades.jaw_opening_m = 0.006;
  EXPECT_TRUE(s.suturing.jaws_taken(blades, s.tool, true)) << "to the organ they are a probe";
  for (const double opening : {0.004, 0.002, 0.0002}) s.step(X, opening);
  ASSERT_TRUE(s.told(Kind::kSnipped));
  EXPECT_EQ(s.suturing.thread().rod().nodes().size(), nodes + 2);
  std::vector<std::string> changes;
  for (const SutureEvent& event : s.all) changes.push_back(suture_event_bytes(event));
  std::vector<NodePlace> places;
  s.suturing.add_nodes(places);
  const SuturePlayback playback(s.setup, changes);
  ASSERT_EQ(playback.nodes(), places.size());
  EXPECT_EQ(playback.at(places)[1]->triangles, s.suturing.seen()[1]->triangles);
  changes.push_back(suture_event_bytes({.kind = Kind::kBroughtIn}));
  EXPECT_EQ(SuturePlayback(s.setup, changes).nodes(), places.size() - 2) << "a new thread is whole";
  EXPECT_EQ(SuturePlayback(s.setup, {}).nodes(), 0U) << "no needle has been brought in";
}

TEST(Suturing, PrintsWhatAStepCosts) {
  Sewn s(0.30);
  const auto print = [&s](const char* what) {
    std::printf("thread of 300 mm, %s: %.3f ms CPU a step beside the organ's own\n", what, 1e3 * s.cpu_s / s.steps);
    s.cpu_s = s.steps = 0;
  };
  for (int i = 0; i <= 400; ++i) s.step(Sewn::turned(0.005 * i) * s.X_IN.inverse(), 0);
  print("needle driven");
  for (int i = 0; i < 100; ++i) s.step(s.jaws, 0);
  print("needle held in tissue");
  s.stitch();
  s.cpu_s = s.steps = 0;
  s.move(s.jaws.p + Vec3(0, 0, 0.04), 0, 200);
  print("drawn through a stitch");
  for (int i = 0; i < 200; ++i) s.step(s.jaws, 0);
  print("held in a stitch");
}

}  // namespace
}  // namespace trocar::suturing_test
