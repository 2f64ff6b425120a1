// What instruments do to an organ: each by what its user does and sees.
#include "tissue/interaction/instrument_actions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/support/repeats.h"
#include "tests/tissue/solid/soft_organ_rig.h"
#include "tests/tissue/support/manifold.h"
#include "tissue/tissue_world.h"

namespace trocar {
namespace {

using test::expect_manifold;
using test::from_above;

/// An ellipsoid in a world of its own, its pole up, and an instrument over it.
class Theatre {
 public:
  explicit Theatre(InstrumentKind kind) : Theatre({kind, InstrumentKind::kClipApplier}, 0.010) {}
  Theatre(std::initializer_list<InstrumentKind> kinds, double edge_m, bool sews = false)
      : rest_(test::ellipsoid({0.06, 0.05, 0.035}, 40)) {
    auto soft = std::make_shared<SoftSetup>();
    soft->material.residual_strain = 0.06;
    soft->options.solid.edge_m = edge_m;
    soft->lattice = build_lattice(*rest_, {.cell_m = edge_m}).lattice;
    setup_.organ_T = rest_.get();
    setup_.seen_T = rest_;
    setup_.tools.clear();
    for (const InstrumentKind kind : kinds) setup_.tools.push_back(make_tool(kind));
    setup_.soft = soft;
    if (sews) setup_.suture = std::make_shared<SutureSetup>();
    if (sews) setup_.sheets = {flap()};
    setup_.followed = {pole(), {{0, 0, -0.035}, -Vec3::UnitZ()}};
    world_ = std::make_unique<TissueWorld>(setup_);
    state_.stylus.instrument = 0;
  }

  /// One step of the world; what presses is what lies deepest under the tip, at 150 N/m.
  void step(const Vec3& tip, double opening_m, bool pedal = false, bool present = true) {
    state_.stylus.t_s += 0.01;
    state_.stylus.X_TI = from_above(tip);
    state_.stylus.X_TI.R *= Eigen::AngleAxisd(roll_rad, Vec3::UnitZ()).toRotationMatrix();
    state_.stylus.jaw_opening_m = opening_m;
    state_.stylus.pedal = pedal;
    touch(tip);
    world_->step(state_, present, *patch_);
  }
  void wait(int steps) {
    for (int i = 0; i < steps; ++i) step({0, 0, 0.2}, 0.02);
  }
  /// Scissors from above, open, pressed in by so much, closed.
  void snip(double x, double y, double in_m) {
    for (double o = 0.002; o <= 0.012; o += 0.002) step({x, y, top(x, y) - in_m}, o);
    for (double o = 0.012; o >= 0; o -= 0.002) step({x, y, top(x, y) - in_m}, o);
    wait(1);
  }
  void take(int instrument) { state_.stylus.instrument = instrument; }
  /// 24 by 20 mm beside the pole, hung on along the side that is nearer to it.
  static SheetSetup flap() {
    SheetSetup sheet{"flap", rectangular_sheet(0.020, 0.024, 0.004), {}, 0.0015, {}};
    sheet.material.young_pa = 6000;
    for (std::size_t v = 0; v < sheet.drawn_T.vertices.size(); ++v) {
      Vec3& at = sheet.drawn_T.vertices[v];
      if (at.y() < 1e-9) sheet.hinge.push_back(static_cast<std::int32_t>(v));
      const double x = 0.015 + at.y(), y = 0.010 - at.x();
      at = Vec3(x, y, top(x, y) + 0.001);
    }
    return sheet;
  }
  static SurfacePlace pole() { return {{0, 0, 0.035}, Vec3::UnitZ()}; }
  static double top(double x, double y) { return 0.035 * std::sqrt(1 - std::pow(x / 0.06, 2) - std::pow(y / 0.05, 2)); }

  const TissueFrame& frame() const { return world_->frame(); }
  const SurgeryState& surgery() const { return world_->frame().surgery; }
  const ContactPatch& patch() const { return *patch_; }
  TissueWorld& world() { return *world_; }
  float most(const std::string& field) const {
    for (const SurfaceField& f : world_->surface()->fields)
      if (f.name == field) return *std::max_element(f.value.begin(), f.value.end());
    return 0;
  }
  bool presses = true;
  double roll_rad = 0;  ///< of the shaft

 private:
  void touch(const Vec3& tip) {
    SolvedContacts& contacts = state_.contacts;
    contacts = {};
    contacts.topology = world_->surface()->topology;
    if (!presses || patch_->stamp == 0) return;
    // The patch's nearest vertex above the tip.
    double least = 0.006;
    for (int i = 0; i < patch_->count; ++i) {
      const Vec3 at = interpolate({1. / 3, 1. / 3, 1. / 3}, patch_->corners(i));
      const double aside = std::hypot(at.x() - tip.x(), at.y() - tip.y());
      if (aside >= least || at.z() < tip.z()) continue;
      least = aside;
      contacts.count = 1;
      SolvedContact& c = contacts.at[0];
      c.place = {patch_->triangle[std::size_t(i)].id, {1. / 3, 1. / 3, 1. / 3}};
      c.normal_T = Vec3::UnitZ();
      c.tool_T = tip;
      c.share = 1;
      c.force_T = Vec3(0, 0, std::min(3.0, 150 * (at.z() - tip.z())));
    }
  }

  SurfacePtr rest_;
  TissueSetup setup_;
  std::unique_ptr<TissueWorld> world_;
  HapticState state_;
  std::unique_ptr<ContactPatch> patch_ = std::make_unique<ContactPatch>();
};

TEST(InstrumentActions, ScissorsCutWhatLiesBetweenThem) {
  Theatre theatre(InstrumentKind::kScissors);
  theatre.presses = false;
  theatre.snip(0, 0, 0.006);
  EXPECT_EQ(theatre.surgery().cuts, 1);
  EXPECT_EQ(theatre.surgery().refusals, 0);
  EXPECT_EQ(theatre.world().surface()->topology, 1U);
  EXPECT_EQ(theatre.patch().topology, 1U);
  EXPECT_EQ(theatre.world().shape().changes.size(), 1U);
  // It bleeds: some tenths of a millilitre in ten seconds, seen as blood on the surface.
  theatre.wait(1000);
  EXPECT_GT(theatre.surgery().blood_ml, 0.05);
  EXPECT_LT(theatre.surgery().blood_ml, 20);
  EXPECT_GT(theatre.most("blood"), 0.5F);
}

TEST(InstrumentActions, TheFingersFeelTheEnergyOfTheCutWhileTheBladesClose) {
  Theatre theatre(InstrumentKind::kScissors);
  theatre.presses = false;
  for (double o = 0.002; o <= 0.012; o += 0.002) theatre.step({0, 0, 0.029}, o);
  const GripBlock block = theatre.patch().grip;
  EXPECT_NEAR(block.thickness_m, 0.012, 1e-3);
  // 164 J/m2 over the area ahead: between a quarter and all of a square of 12 mm by 6 mm.
  const double energy = 0.5 * block.stiffness_n_per_m * block.thickness_m * block.thickness_m;
  EXPECT_GT(energy, 164 * 0.25 * 0.012 * 0.006);
  EXPECT_LT(energy, 164 * 0.012 * 0.006);
  for (double o = 0.012; o >= 0; o -= 0.002) theatre.step({0, 0, 0.029}, o);
  theatre.step({0, 0, 0.029}, 0);
  EXPECT_EQ(theatre.patch().grip.stiffness_n_per_m, 0) << "cut through: nothing resists";
}

TEST(InstrumentActions, ScissorsInTheAirRefuseAndSayWhy) {
  Theatre theatre(InstrumentKind::kScissors);
  theatre.snip(0, 0, -0.030);
  EXPECT_EQ(theatre.surgery().cuts, 0);
  EXPECT_EQ(theatre.surgery().refusals, 1);
  EXPECT_EQ(CutRefusal(theatre.surgery().refusal), CutRefusal::kNothingThere);
  EXPECT_GT(theatre.surgery().refused_s, 0);
  EXPECT_EQ(theatre.frame().clip_count, 0);
  // Closed jaws that were never open cut nothing either.
  for (int i = 0; i < 20; ++i) theatre.step({0, 0, 0.03}, 0);
  EXPECT_EQ(theatre.surgery().refusals, 1);
}

TEST(InstrumentActions, ScissorsLeaveNoStripBesideAWoundAndSayWhy) {
  Theatre theatre(InstrumentKind::kScissors);
  theatre.presses = false;
  theatre.snip(0, 0, 0.006);
  ASSERT_EQ(theatre.surgery().cuts, 1);
  theatre.wait(100);
  // The blades close in the plane x = 0.
  theatre.snip(0.0018, 0, 0.006);
  EXPECT_EQ(theatre.surgery().cuts, 1);
  EXPECT_EQ(theatre.surgery().refusals, 1);
  EXPECT_EQ(CutRefusal(theatre.surgery().refusal), CutRefusal::kBesideCut);
  theatre.snip(0.009, 0, 0.006);
  EXPECT_EQ(theatre.surgery().cuts, 2) << "well beside it";
  theatre.snip(0, 0.011, 0.006);
  EXPECT_EQ(theatre.surgery().cuts, 3) << "on from its end";
}

TEST(InstrumentActions, FollowedPlacesGoAlongWithTheTissue) {
  Theatre theatre({InstrumentKind::kProbe, InstrumentKind::kScissors}, 0.010);
  const auto place = [&](std::size_t i) { return theatre.frame().place[i]; };
  theatre.wait(1);
  ASSERT_EQ(theatre.frame().place_count, 2);
  EXPECT_LT((place(0).point_T - Theatre::pole().point_T).norm(), 2e-4);
  EXPECT_LT((place(1).point_T + Theatre::pole().point_T).norm(), 2e-4);
  // Beside the pole: it sinks, and the side that is pressed lies deeper.
  for (int i = 0; i < 40; ++i) theatre.step({0.008, 0, Theatre::top(0.008, 0) - 1e-4 * i}, 0);
  EXPECT_LT(place(0).point_T.z(), 0.0345);
  ASSERT_TRUE(theatre.frame().touched_rest_T);
  EXPECT_LT((*theatre.frame().touched_rest_T - Vec3(0.008, 0, Theatre::top(0.008, 0))).norm(), 0.005);
  EXPECT_GT(place(0).normal_T.x(), 0.01);
  EXPECT_NEAR(place(0).normal_T.norm(), 1, 1e-12);
  theatre.wait(300);
  EXPECT_FALSE(theatre.frame().touched_rest_T);
  EXPECT_LT((place(0).point_T - Theatre::pole().point_T).norm(), 5e-4) << "let go, it comes back";
  // A cut through it leaves it on one of the lips.
  theatre.take(1);
  theatre.presses = false;
  theatre.snip(0, 0, 0.006);
  ASSERT_EQ(theatre.surgery().cuts, 1);
  theatre.wait(300);
  EXPECT_TRUE(place(0).point_T.allFinite());
  EXPECT_LT((place(0).point_T - Theatre::pole().point_T).norm(), 5e-3);
}

TEST(InstrumentActions, AHookDrawnAlongWithThePedalCutsAndWithoutItDoesNot) {
  for (const bool pedal : {false, true}) {
    Theatre theatre(InstrumentKind::kHook);
    theatre.step({-0.01, 0, 0.05}, 0);
    for (double x = -0.01; x <= 0.01; x += 0.00005) theatre.step({x, 0, Theatre::top(x, 0) - 0.002}, 0, pedal);
    if (pedal) {
      EXPECT_GE(theatre.surgery().cuts, 2);
      EXPECT_GT(theatre.surgery().heat_j, 5);
      EXPECT_GT(theatre.most("char"), 0.1F);
      EXPECT_GT(theatre.frame().smoke_per_m, 0);
    } else {
      EXPECT_EQ(theatre.surgery(), SurgeryState{});
      EXPECT_TRUE(theatre.world().surface()->fields.empty());
    }
  }
}

TEST(InstrumentActions, CurrentBurnsAFoldThatIsHeldAndNothingBesideIt) {
  const SurfacePtr rest = test::ellipsoid({0.06, 0.05, 0.035}, 48);
  for (const bool holds : {true, false}) {
    SoftOrgan organ(build_lattice(*rest, {.cell_m = 0.010}).lattice, rest, TissueSolid{}, {});
    InstrumentActions actions(organ, {.soft_w = 30});
    const Tool grasper = make_tool(InstrumentKind::kGrasper);
    HapticState state;
    double hottest_c = 0;
    const auto step = [&](double opening_m, bool pedal) {
      state.stylus.t_s += 0.01;
      state.stylus.X_TI = from_above({0, 0, holds ? 0.029 : 0.060});
      state.stylus.jaw_opening_m = opening_m;
      state.stylus.pedal = pedal;
      std::vector<SoftSpring> springs;
      actions.before(state, grasper, true, organ, springs);
      organ.step({}, &state.stylus.X_TI.p, springs);
      actions.after(state, grasper, true, springs, organ);
      hottest_c = std::max(hottest_c, actions.state().contact_c);
    };
    for (double o = 0.014; o > 0; o -= 0.001) step(o, false);
    ASSERT_EQ(actions.grip().holds(), holds);
    EXPECT_EQ(actions.state().heat_j, 0) << "no pedal yet";
    for (int i = 0; i < 200; ++i) step(0, true);
    if (!holds) {
      EXPECT_EQ(actions.state(), SurgeryState{});
      EXPECT_EQ(actions.heat().blocks(), 0U);
      continue;
    }
    EXPECT_TRUE(actions.grip().holds());
    EXPECT_GT(hottest_c, 60) << "a burn, as events count it";
    EXPECT_GT(actions.state().heat_j, 5);
    EXPECT_GE(actions.heat().damage_at({0, 0, 0.033}), 1) << "dead 2 mm deep";
    EXPECT_LT(actions.heat().damage_at({0.025, 0, Theatre::top(0.025, 0) - 0.001}), 0.1);
  }
}

TEST(InstrumentActions, CoagulationStopsAWoundThatOozes) {
  const auto rate_after = [](bool pedal) {
    Theatre theatre(InstrumentKind::kScissors);
    theatre.presses = false;
    theatre.snip(0, 0, 0.002);
    theatre.presses = true;
    for (int i = 0; i < 600; ++i) theatre.step({0, -0.006 + 2e-5 * i, Theatre::top(0, 0) - 0.001}, 0, pedal);
    theatre.wait(200);
    return theatre.surgery().blood_ml_per_min;
  };
  const double open = rate_after(false), closed = rate_after(true);
  EXPECT_GT(open, 0.3);
  EXPECT_LT(closed, 0.3 * open);
}

TEST(InstrumentActions, AClipClosesTheWoundBetweenTheJawsAndElseIsRefused) {
  Theatre theatre(InstrumentKind::kClipApplier);
  const auto close = [&](double z) {
    for (double o = 0.006; o >= 0; o -= 0.002) theatre.step({0, 0, z}, o);
  };
  close(0.035);
  EXPECT_EQ(theatre.surgery().clips, 0);
  EXPECT_EQ(theatre.surgery().refusals, 1);
  EXPECT_EQ(CutRefusal(theatre.surgery().refusal), CutRefusal::kNoWound);
  EXPECT_EQ(theatre.frame().clip_count, 0);
}

TEST(InstrumentActions, AClipStaysOnItsWoundAndMovesWithTheTissue) {
  Theatre theatre(InstrumentKind::kScissors);
  theatre.presses = false;
  theatre.snip(0, 0, 0.006);
  EXPECT_NEAR(theatre.surgery().cut_m, 0.010, 0.008);
  theatre.wait(300);
  theatre.take(1);
  const double bled = theatre.surgery().blood_ml_per_min;
  for (double o = 0.006; o >= 0; o -= 0.002) theatre.step({0, 0, 0.025}, o);
  ASSERT_EQ(theatre.surgery().clips, 1);
  theatre.wait(400);
  EXPECT_LT(theatre.surgery().blood_ml_per_min, 0.3 * bled) << "the faces that it presses together ooze no longer";
  ASSERT_EQ(theatre.frame().clip_count, 1);
  const Vec3 set = theatre.frame().clip[0].p;
  EXPECT_LT((set - Vec3(0, 0, 0.025)).norm(), 1e-3) << "where the jaws closed";
  EXPECT_NEAR(theatre.frame().clip[0].R.determinant(), 1, 1e-9);
  // Pressed down beside it, it goes along; let go, it comes back.
  theatre.presses = true;
  for (int i = 0; i < 100; ++i) theatre.step({0.008, 0, 0.028}, 0);
  const Vec3 pressed = theatre.frame().clip[0].p;
  EXPECT_LT(pressed.z(), set.z() - 0.0005);
  theatre.wait(500);
  EXPECT_LT((theatre.frame().clip[0].p - set).norm(), 0.3 * (pressed - set).norm());
  EXPECT_EQ(theatre.frame().clip_count, 1);
}

TEST(InstrumentActions, SuctionTakesBloodAndTheAccountCloses) {
  Theatre theatre(InstrumentKind::kSuction);
  for (int i = 0; i < 50; ++i) theatre.step({0, 0, 0.05}, 0.002);
  EXPECT_EQ(theatre.most("wet"), 0) << "taken in hand with closed fingers, it does not rinse at once";
  theatre.step({0, 0, 0.05}, 0.012);
  for (int i = 0; i < 200; ++i) theatre.step({0, 0, 0.05}, 0.002);  // rinses
  EXPECT_GT(theatre.most("wet"), 0.3F);
  for (int i = 0; i < 200; ++i) theatre.step({0, 0, 0.036}, 0.02, true);
  EXPECT_GT(theatre.surgery().sucked_ml, 0.1);
}

TEST(InstrumentActions, PulledTooHardAFoldTearsOut) {
  Theatre theatre(InstrumentKind::kGrasper);
  theatre.presses = false;
  for (double o = 0.012; o >= 0; o -= 0.0005) theatre.step({0, 0, 0.033}, o);
  ASSERT_TRUE(theatre.frame().held());
  for (double z = 0.033; z < 0.12 && theatre.frame().held(); z += 0.0005) theatre.step({0, 0, z}, 0);
  EXPECT_FALSE(theatre.frame().held());
  theatre.wait(300);
  // Nothing of the hold is left; a tear is there when the pads hold better than the capsule.
  double off = 0;
  const auto surface = theatre.world().surface();
  for (std::size_t v = 0; v < surface->vertices.size(); ++v)
    off = std::max(off, (surface->vertices[v] - surface->rest->vertices[v]).norm());
  EXPECT_LT(off, theatre.surgery().tears > 0 ? 5e-3 : 5e-4);
}

/// Every instrument anywhere, opening, closing, energised, pulled: nothing breaks, and afterwards the organ rests.
TEST(InstrumentActions, RandomTicksLeaveASoundOrgan) {
  const int steps = test::repeats("ACTION_TICKS", 40'000) / 10;  // ticks of the loop
  Theatre theatre({InstrumentKind::kScissors, InstrumentKind::kGrasper, InstrumentKind::kHook,
                   InstrumentKind::kClipApplier, InstrumentKind::kSuction, InstrumentKind::kNeedleDriver},
                  0.0125, true);
  std::mt19937 random(3);
  const auto share = [&] { return double(random()) / double(std::mt19937::max()); };
  Vec3 tip(0, 0, 0.05), to = tip;
  double opening = 0.01, wanted = 0.01, turned = 0;
  bool pedal = false;
  for (int i = 0; i < steps; ++i) {
    if (i % 12 == 0) {
      // On the organ, into it, above it; every other time where it was, with the jaws moved.
      const double x = 0.09 * (share() - 0.5), y = 0.07 * (share() - 0.5);
      if (share() < 0.5) to = {x, y, theatre.top(x, y) + 0.030 * share() - 0.012};
      wanted = share() < 0.5 ? 0 : 0.02 * share();
      pedal = share() < 0.4;
      if (share() < 0.02) tip = to;  // a jump
      if (share() < 0.1) theatre.take(share() < 0.6 ? 0 : int(6 * share()));
      turned += share() < 0.3 ? 3 * (share() - 0.5) : 0;
    }
    tip += 0.1 * (to - tip);
    opening += 0.2 * (wanted - opening);
    theatre.roll_rad += 0.1 * (turned - theatre.roll_rad);
    theatre.step(tip, opening < 1e-4 ? 0 : opening, pedal, share() > 0.001);
    if (i % 1000 != 999) continue;
    for (const Vec3& vertex : theatre.world().surface()->vertices) ASSERT_TRUE(vertex.allFinite()) << "step " << i;
    expect_manifold(*theatre.world().surface());
  }
  theatre.wait(200);
  for (const SurfacePtr& thin : theatre.world().thin())
    for (const Vec3& vertex : thin->vertices) ASSERT_TRUE(vertex.allFinite());
  // The organ's own: a thread may still slide down beside it.
  const TissueShape shape = theatre.world().shape();
  const auto nodes = shape.nodes_T.first(shape.nodes_T.size() - shape.thin_T.size());
  const std::vector<NodePlace> before(nodes.begin(), nodes.end());
  theatre.wait(1);
  float moved = 0;
  for (std::size_t n = 0; n < before.size(); ++n)
    moved = std::max(moved, (theatre.world().shape().nodes_T[n] - before[n]).norm());
  EXPECT_LT(moved, 1e-4F) << "in a step of 10 ms";
  const SurgeryState& done = theatre.surgery();
  const SutureState& sewn = theatre.frame().suture;
  std::printf(
      "%d steps: %d cuts, %d tears, %d clips, %d refused, %.1f mL, %.0f J; %d needles, %d punctures, %d stitches\n",
      steps, done.cuts, done.tears, done.clips, done.refusals, done.blood_ml, done.heat_j, sewn.needles, sewn.punctures,
      sewn.stitches);
  // The more wounds there are, the more often scissors are too close to one.
  EXPECT_GE(done.cuts, std::min(steps / 200, 20 + steps / 1000)) << "120 in 10^6 ticks";
  EXPECT_GT(done.heat_j, 10);
}

}  // namespace
}  // namespace trocar
