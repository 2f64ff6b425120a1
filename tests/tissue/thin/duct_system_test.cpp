// A duct and an artery beside an organ that gives way, in a world: seen, touched, held, clipped, cut; what comes out of
// them; and what a recording knows of it.
#include "tissue/thin/duct_system.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "haptics/input_error.h"
#include "tests/tissue/solid/soft_organ_rig.h"
#include "tissue/tissue_world.h"

namespace trocar::duct_system_test {
namespace {

using test::from_above;

constexpr double kMiddle = 0.078;  // m along x: between organ and bed
constexpr double kBeside = 0.016;  // m from the duct to the artery
constexpr double kTip = 0.005;     // m of the tips below what they close on

DuctSetup duct(const std::string& name, double y_m, DuctContent content) {
  DuctSetup setup;
  setup.name = name;
  setup.material.name = content == DuctContent::kBlood ? "artery" : "duct";
  setup.material.young_pa = 350000;
  setup.material.poisson = 0.49;
  setup.material.stiffening = 4;
  setup.material.rupture_n_per_m = 480;
  setup.material.toughness_j_per_m2 = 500;
  setup.content = content;
  const auto organ = test::ellipsoid({0.06, 0.05, 0.035}, 40);
  const Vec3 wanted(0.06, y_m, 0);
  const Vec3 on = *std::min_element(organ->vertices.begin(), organ->vertices.end(), [&](const Vec3& a, const Vec3& b) {
    return (a - wanted).squaredNorm() < (b - wanted).squaredNorm();
  });
  setup.path_T = {on, {0.098, y_m, 0}};
  if (content == DuctContent::kBlood) {
    setup.outer_radius_m = 0.001;
    setup.wall_m = 0.0004;
    std::swap(setup.path_T[0], setup.path_T[1]);
    setup.ends = {DuctHold::kFixed, DuctHold::kOrgan};
  }
  return setup;
}

class Theatre {
 public:
  explicit Theatre(InstrumentKind kind) : rest_(test::ellipsoid({0.06, 0.05, 0.035}, 40)) {
    auto soft = std::make_shared<SoftSetup>();
    soft->options.solid.edge_m = 0.010;
    soft->lattice = build_lattice(*rest_, {.cell_m = 0.010}).lattice;
    setup_.organ_T = rest_.get();
    setup_.seen_T = rest_;
    setup_.tools = {make_tool(kind), make_tool(InstrumentKind::kScissors), make_tool(InstrumentKind::kClipApplier)};
    setup_.soft = soft;
    setup_.ducts = {duct("cystic duct", 0, DuctContent::kBile), duct("cystic artery", kBeside, DuctContent::kBlood)};
    world_ = std::make_unique<TissueWorld>(setup_);
  }
  /// Lets what hangs come to rest first.
  void settle() { wait(60); }
  void wait(int steps) {
    for (int i = 0; i < steps; ++i) step(from_above({0, 0, 0.2}), 0.02);
  }
  void step(const Pose& X, double opening_m, bool pedal = false) {
    state_.stylus.t_s += 0.01;
    state_.stylus.X_TI = X;
    state_.stylus.jaw_opening_m = opening_m;
    state_.stylus.pedal = pedal;
    world_->step(state_, true, *patch_);
  }
  /// Jaws over a place, open, closed and held so.
  void close(const Vec3& at, double turn = 0, double most_m = 0.012, bool pedal = false) {
    Pose X = from_above(at - Vec3(0, 0, kTip));
    X.R = Mat3(X.R * Eigen::AngleAxisd(turn, Vec3::UnitZ()).toRotationMatrix());
    for (double o = most_m; o > 0; o -= 0.0005) step(X, o, pedal);
    for (int i = 0; i < 5; ++i) step(X, 0, pedal);
  }
  void open(const Vec3& at) {
    for (double o = 0; o < 0.012; o += 0.001) step(from_above(at - Vec3(0, 0, kTip)), o);
    for (double z = 0; z < 0.05; z += 0.002) step(from_above(at + Vec3(0, 0, z)), 0.012);
  }
  void take(std::int32_t instrument) { state_.stylus.instrument = instrument; }
  HapticState& state() { return state_; }
  ContactPatch& patch() { return *patch_; }
  TissueWorld& world() { return *world_; }
  const TissueSetup& setup() const { return setup_; }
  const SurgeryState& surgery() const { return world_->frame().surgery; }
  /// The middle of what is drawn of a duct near its middle.
  Vec3 middle(std::size_t d) const {
    Vec3 sum = Vec3::Zero();
    int count = 0;
    for (const Vec3& v : world_->thin()[d]->vertices)
      if (std::abs(v.x() - kMiddle) < 0.003) sum += v, ++count;
    return sum / count;
  }
  int triangles_of(std::int32_t material) const {
    int count = 0;
    for (int i = 0; i < patch_->count; ++i) count += patch_->triangle[std::size_t(i)].material == material;
    return count;
  }

 private:
  SurfacePtr rest_;
  TissueSetup setup_;
  std::unique_ptr<TissueWorld> world_;
  HapticState state_;
  std::unique_ptr<ContactPatch> patch_ = std::make_unique<ContactPatch>();
};

constexpr std::int32_t kGrasp = 0, kCut = 1, kClip = 2;

TEST(DuctSystem, IsSeenAndLiesInThePatchWithItsOwnMaterial) {
  Theatre t(InstrumentKind::kGrasper);
  t.settle();
  ASSERT_EQ(t.world().thin().size(), 2U);
  EXPECT_LT((t.middle(0) - Vec3(kMiddle, 0, 0)).norm(), 0.001);
  t.step(from_above({kMiddle, 0, 0.008}), 0);
  EXPECT_GT(t.triangles_of(1), 20);
  EXPECT_GT(t.triangles_of(2), 0);
  EXPECT_NEAR(t.patch().material[1].stiffness_n_per_m, 132, 30) << "of a ring that is pressed";
  EXPECT_EQ(t.surgery(), SurgeryState{});
  EXPECT_EQ(t.world().shape().topology, 0U);
  EXPECT_GT(t.world().shape().thin_T.size(), 30U);
}

TEST(DuctSystem, TheOrganLiesAsItIsDrawnUntilADuctIsCutAndThenGoesBackFromIt) {
  Theatre t(InstrumentKind::kGrasper);
  const auto end = [&] {
    const auto& vertices = t.world().surface()->vertices;
    const Vec3 on = t.setup().ducts[0].path_T[0];
    for (std::size_t v = 0; v < vertices.size(); ++v)
      if (t.world().surface()->rest->vertices[v] == on) return Vec3(vertices[v] - on);
    return Vec3(Vec3::Constant(1));
  };
  t.wait(150);
  EXPECT_LT(end().norm(), 5e-5);
  t.take(kCut);
  t.close(t.middle(0));
  t.open(t.middle(0));
  t.wait(100);
  EXPECT_LT(end().x(), -2e-4);
}

/// The loop's contact on the first duct, its tool this far below where that lay.
void press(Theatre& t, double tool_z_m) {
  for (int i = 0; i < 40; ++i) {
    SolvedContacts contacts;
    double least = 1;
    for (int k = 0; k < t.patch().count; ++k) {
      const PatchTriangle& triangle = t.patch().triangle[std::size_t(k)];
      const Vec3 at = interpolate({1. / 3, 1. / 3, 1. / 3}, t.patch().corners(k));
      if (triangle.material != 1 || triangle.normal.z() < 0.8 || std::abs(at.x() - kMiddle) > least) continue;
      least = std::abs(at.x() - kMiddle);
      contacts.count = 1;
      SolvedContact& c = contacts.at[0];
      c.place = {triangle.id, {1. / 3, 1. / 3, 1. / 3}};
      c.normal_T = Vec3::UnitZ();
      c.tool_T = Vec3(at.x(), at.y(), tool_z_m);
      c.force_T = Vec3(0, 0, 0.1);
    }
    t.state().contacts = contacts;
    t.step(from_above({kMiddle, 0, 0.004}), 0);
  }
  t.state().contacts = {};
}

TEST(DuctSystem, IsPushedByWhatTheLoopSolvesAndGoesBack) {
  Theatre t(InstrumentKind::kProbe);
  t.settle();
  const double before = t.middle(0).z();
  press(t, before - 0.002);
  EXPECT_LT(t.middle(0).z(), before - 0.001);
  EXPECT_LT(std::abs(t.middle(1).z()), 0.001) << "the other one is not touched";
  t.wait(100);
  EXPECT_NEAR(t.middle(0).z(), before, 1e-4);
}

/// A light duct goes all the way back within a step: the loop, which meets it a step later, felt a blow of 1.5 N.
TEST(DuctSystem, HeldAsideAndLostForATickItLandsOnTheToolAndDoesNotGoThroughIt) {
  const auto after_a_step = [](bool beside) {
    Theatre t(InstrumentKind::kProbe);
    t.settle();
    press(t, t.middle(0).z() - 0.006);
    const double held = t.middle(0).z(), lost = 1e-4;
    const double tip = held + t.setup().ducts[0].outer_radius_m + ToolShape{}.radius_m + lost;
    t.step(from_above({kMiddle, 0, beside ? tip : 0.2}), 0);
    return t.middle(0).z() - held;
  };
  EXPECT_GT(after_a_step(false), 0.004) << "without a tool";
  EXPECT_LT(after_a_step(true), 0.0015) << "a tube of flat sides, and the dent of what it pulls with";
}

TEST(DuctSystem, AGrasperHoldsItPullsItAndTheOrganBehindIt) {
  Theatre t(InstrumentKind::kGrasper);
  t.settle();
  const Vec3 at = t.middle(0);
  const auto tip = [&] {
    double far = 0;
    for (const Vec3& v : t.world().surface()->vertices)
      if (std::hypot(v.y(), v.z()) < 0.002) far = std::max(far, v.x());
    return far;
  };
  const double organ_before = tip();
  t.close(at);
  EXPECT_EQ(t.world().frame().grip, GripState::kHolding);
  EXPECT_EQ(t.triangles_of(1), 0) << "what the jaws have is no contact";
  EXPECT_GT(t.patch().hold.stiffness_n_per_m, 0);
  for (double x = 0; x < 0.006; x += 2e-4) t.step(from_above(at + Vec3(x, 0, -kTip)), 0);
  for (int i = 0; i < 30; ++i) t.step(from_above(at + Vec3(0.006, 0, -kTip)), 0);
  EXPECT_GT(tip(), organ_before + 2e-4);
  const Vec3 pull = t.patch().hold.anchor_T - t.state().stylus.X_TI * t.patch().hold.point_I;
  EXPECT_LT(pull.x() * t.patch().hold.stiffness_n_per_m, -0.05) << "N on the jaws";
  t.open(at + Vec3(0.006, 0, 0));
  EXPECT_EQ(t.world().frame().grip, GripState::kEmpty);
  t.wait(200);
  EXPECT_NEAR(tip(), organ_before, 2e-4);
}

TEST(DuctSystem, AClipIsRefusedForAReasonOfItsOwnNumberOrPlaced) {
  Theatre t(InstrumentKind::kGrasper);
  t.take(kClip);
  t.settle();
  const Vec3 at = t.middle(0);
  t.close(at, 0.7, 0.008);
  EXPECT_EQ(t.surgery().clips, 0);
  EXPECT_EQ(t.surgery().refusals, 1);
  EXPECT_EQ(t.surgery().refusal, refusal_code(ClipRefusal::kAngle));
  EXPECT_EQ(closing_words(t.surgery().refusal), sentence(ClipRefusal::kAngle));
  for (const CutRefusal why : {CutRefusal::kTooFine, CutRefusal::kBesideCut})
    EXPECT_EQ(closing_words(static_cast<std::int32_t>(why)), refusal_words(why));
  EXPECT_EQ(closing_words(0), "");
  t.open(at);
  t.close(at, 0, 0.008);
  EXPECT_EQ(t.surgery().clips, 1);
  EXPECT_EQ(t.surgery().refusal, 0);
  t.open(at);
  EXPECT_EQ(t.surgery().bile_leaks, 0);
}

TEST(DuctSystem, JawsThatCloseOnADuctDoNothingToTheOrganAndThoseBesideItDo) {
  Theatre t(InstrumentKind::kGrasper);
  t.take(kCut);
  t.settle();
  t.close(t.middle(0));
  EXPECT_EQ(t.surgery().cuts, 1);
  EXPECT_EQ(t.world().surface()->topology, 0U);
  EXPECT_EQ(t.world().thin()[0]->topology, 1U);
  EXPECT_EQ(t.world().thin()[1]->topology, 0U);
  EXPECT_EQ(t.world().shape().topology, 1U);
  t.wait(5);
  t.close({0, 0, 0.034});
  EXPECT_EQ(t.surgery().cuts, 2);
  EXPECT_EQ(t.world().surface()->topology, 1U);
  EXPECT_EQ(t.world().shape().topology, 2U);
  ASSERT_EQ(t.world().shape().changes.size(), 2U);
  EXPECT_TRUE(is_duct_change(t.world().shape().changes[0]));
  EXPECT_FALSE(is_duct_change(t.world().shape().changes[1]));
}

TEST(DuctSystem, ANickedArteryBleedsAndAClipBeforeItStopsThat) {
  const auto bleeds_ml = [](bool clipped) {
    Theatre t(InstrumentKind::kGrasper);
    t.settle();
    const Vec3 at = t.middle(1);
    t.take(kClip);
    if (clipped) t.close(at + Vec3(0.006, 0, 0), 0, 0.008), t.open(at + Vec3(0.006, 0, 0));
    EXPECT_EQ(t.surgery().clips, clipped ? 1 : 0);
    t.take(kCut);
    const Vec3 half = at + Vec3(0, 0, 0.0045);  // the blades end in it
    t.close(half);
    t.open(half);
    EXPECT_EQ(t.surgery().cuts, 1);
    EXPECT_EQ(t.world().thin()[1]->topology, 0U) << "no more than nicked";
    t.wait(1000);
    return t.surgery().blood_ml;
  };
  const double open = bleeds_ml(false);
  EXPECT_GT(open, 0.5);
  EXPECT_LT(bleeds_ml(true), 0.2 * open) << "what still comes is from behind it";
}

TEST(DuctSystem, ACutArteryBleedsUnlessItIsClippedOnBothSides) {
  const auto bleeds_ml = [](int clips) {
    Theatre t(InstrumentKind::kGrasper);
    t.settle();
    const Vec3 at = t.middle(1);
    t.take(kClip);
    for (int i = 0; i < clips; ++i) {
      const Vec3 place = at + Vec3(i == 0 ? 0.006 : -0.006, 0, 0);  // the first where the blood comes from
      t.close(place, 0, 0.008);
      t.open(place);
    }
    EXPECT_EQ(t.surgery().clips, clips);
    t.take(kCut);
    t.close(at);
    t.open(at);
    EXPECT_EQ(t.surgery().cuts, 1);
    t.wait(1000);
    return t.surgery().blood_ml;
  };
  const double open = bleeds_ml(0), both = bleeds_ml(2);
  EXPECT_GT(open, 1) << "mL in ten seconds";
  EXPECT_LT(open, 15);
  EXPECT_LT(bleeds_ml(1), 0.3 * open) << "what runs back from the organ is little";
  EXPECT_EQ(both, 0);
}

TEST(DuctSystem, ACutDuctLeaksBileUntilBothStumpsAreClipped) {
  Theatre t(InstrumentKind::kGrasper);
  t.settle();
  const Vec3 at = t.middle(0);
  t.take(kCut);
  t.close(at);
  t.open(at);
  t.wait(100);
  EXPECT_EQ(t.surgery().bile_leaks, 2);
  EXPECT_GT(t.surgery().bile_ml, 0.005);
  EXPECT_EQ(t.surgery().blood_ml, 0);
  t.take(kClip);
  for (const double side : {-0.009, 0.009}) {
    t.close(at + Vec3(side, 0, 0), 0, 0.008);
    t.open(at + Vec3(side, 0, 0));
  }
  EXPECT_EQ(t.surgery().clips, 2) << closing_words(t.surgery().refusal);
  EXPECT_EQ(t.surgery().bile_leaks, 0);
}

TEST(DuctSystem, HeldWithCurrentItIsSealedAndTheArteryThenDoesNotBleed) {
  Theatre t(InstrumentKind::kGrasper);
  t.settle();
  const Vec3 at = t.middle(1);
  for (const double side : {0.007, -0.007}) {
    t.close(at + Vec3(side, 0, 0));
    for (int i = 0; i < 220; ++i) t.step(from_above(at + Vec3(side, 0, -kTip)), 0, true);
    t.open(at + Vec3(side, 0, 0));
  }
  t.take(kCut);
  t.close(at);
  t.open(at);
  t.wait(300);
  EXPECT_EQ(t.surgery().cuts, 1);
  EXPECT_EQ(t.surgery().blood_ml, 0);
}

TEST(DuctSystem, TubesMadeFromRecordedNodesAndChangesLieWhereTheyLay) {
  Theatre t(InstrumentKind::kGrasper);
  t.settle();
  const Vec3 at = t.middle(0);
  t.take(kClip);
  t.close(at + Vec3(0.006, 0, 0), 0, 0.008);
  t.open(at + Vec3(0.006, 0, 0));
  t.take(kCut);
  t.close(at);
  t.take(kGrasp);
  t.wait(10);
  const TissueShape shape = t.world().shape();
  ASSERT_EQ(shape.changes.size(), 2U);
  const DuctPlayback playback(t.setup().ducts, {shape.changes.begin(), shape.changes.end()});
  ASSERT_EQ(playback.nodes(), shape.thin_T.size());
  const auto made = playback.at(shape.thin_T);
  for (std::size_t d = 0; d < 2; ++d) {
    const SurfaceSnapshot& was = *t.world().thin()[d];
    EXPECT_EQ(made[d]->triangles, was.triangles);
    ASSERT_EQ(made[d]->vertices.size(), was.vertices.size());
    double off = 0;
    for (std::size_t v = 0; v < was.vertices.size(); ++v)
      off = std::max(off, (made[d]->vertices[v] - was.vertices[v]).norm());
    EXPECT_LT(off, 3e-4) << "rings may be turned a little";
  }
  EXPECT_EQ(playback.at(shape.thin_T)[0]->vertices, made[0]->vertices) << "whatever was shown before";
  const DuctPlayback whole(t.setup().ducts, {});
  EXPECT_LT(whole.nodes(), playback.nodes());
}

constexpr double kLittleStump = 0.0013;  // m from a clip's middle to the cut

/// A clip between the middle and the fixed end, and a cut beside it.
void leave_stump(Theatre& t, std::size_t d) {
  const Vec3 at = t.middle(d) + Vec3(0.006, 0, 0), beside = at - Vec3(kLittleStump, 0, 0);
  t.take(kClip);
  t.close(at, 0, 0.008);
  t.open(at);
  t.take(kCut);
  t.close(beside);
  t.open(beside);
  t.take(kGrasp);
}

std::vector<DuctMark> marks(Theatre& t, DuctMark::Kind kind) {
  std::vector<DuctMark> out;
  const TissueFrame& frame = t.world().frame();
  for (std::int32_t i = 0; i < frame.duct_mark_count; ++i)
    if (frame.duct_mark[std::size_t(i)].kind == kind) out.push_back(frame.duct_mark[std::size_t(i)]);
  return out;
}

/// The grasper closes on the only clip and draws it towards the free end, at most so far.
/// @return N, what it pulled with in the last step in which the clip was on
double draw_clip(Theatre& t, double most_m) {
  const Pose X_TC = t.world().frame().clip[0];
  const Vec3 axis = X_TC.p - kTip * X_TC.R.col(2);
  t.close(axis);
  double pull = 0;
  for (double way = 0; way < most_m; way += 1e-4) {
    t.step(from_above(axis - Vec3(way, 0, kTip)), 0);
    if (marks(t, DuctMark::Kind::kClip).empty()) break;
    const GripHold& hold = t.patch().hold;
    pull = hold.stiffness_n_per_m * (hold.anchor_T - t.state().stylus.X_TI * hold.point_I).norm();
  }
  t.open(axis - Vec3(most_m, 0, 0));
  return pull;
}

TEST(DuctSystem, AClipIsDrawnOffAShortStumpAtWhatThatBearsAndIsToldOnce) {
  Theatre t(InstrumentKind::kGrasper);
  t.settle();
  leave_stump(t, 0);
  ASSERT_EQ(marks(t, DuctMark::Kind::kClip).size(), 1U) << closing_words(t.surgery().refusal);
  ASSERT_EQ(marks(t, DuctMark::Kind::kCut).size(), 1U) << closing_words(t.surgery().refusal);
  EXPECT_EQ(t.surgery().bile_leaks, 1) << "from the other end";
  const double clip_m = marks(t, DuctMark::Kind::kClip)[0].arc_m, cut_m = marks(t, DuctMark::Kind::kCut)[0].arc_m;
  const ClipOptions options;
  const double bears = options.pull_off_n * (clip_m - cut_m - options.width_m / 2) / options.stump_m;
  const std::int32_t refusals = t.surgery().refusals;
  draw_clip(t, 0.002);
  EXPECT_EQ(marks(t, DuctMark::Kind::kClip).size(), 1U) << "a gentle pull spares it";
  EXPECT_EQ(t.surgery().refusals, refusals);
  const std::uint64_t topology = t.world().shape().topology;
  EXPECT_NEAR(draw_clip(t, 0.040), bears, 0.6) << "a cut leaves no sliver: 0.2 mm of stump more or less";
  EXPECT_TRUE(marks(t, DuctMark::Kind::kClip).empty());
  EXPECT_EQ(t.world().frame().clip_count, 0);
  EXPECT_EQ(t.surgery().clips, 1) << "that were set";
  EXPECT_EQ(t.surgery().tears, 0);
  EXPECT_EQ(t.surgery().bile_leaks, 2);
  t.wait(50);
  EXPECT_EQ(t.surgery().refusals, refusals + 1);
  EXPECT_EQ(t.surgery().refusal, kClipCameOff);
  EXPECT_FALSE(closing_words(kClipCameOff).empty());
  EXPECT_EQ(t.world().shape().topology, topology + 1);
  const DuctChange change = parse_duct_change(t.world().shape().changes.back());
  EXPECT_EQ(change.kind, DuctChange::Kind::kUnclipped);
  EXPECT_EQ(change.arc_m, clip_m);
}

TEST(DuctSystem, AnArteryWhoseClipIsDrawnOffBleedsOn) {
  Theatre t(InstrumentKind::kGrasper);
  t.settle();
  leave_stump(t, 1);
  ASSERT_EQ(marks(t, DuctMark::Kind::kClip).size(), 1U) << closing_words(t.surgery().refusal);
  t.wait(300);
  const double clipped_ml = t.surgery().blood_ml;
  draw_clip(t, 0.040);
  EXPECT_TRUE(marks(t, DuctMark::Kind::kClip).empty());
  const double before_ml = t.surgery().blood_ml;
  t.wait(300);
  EXPECT_GT(t.surgery().blood_ml - before_ml, 2 * clipped_ml + 0.05);
}

TEST(DuctSystem, AClipThatCameOffIsPlayedBackAndIsTheSameTwice) {
  struct Made {
    std::vector<std::string> changes;
    std::vector<NodePlace> thin_T;
    SurfacePtr tube;
    std::vector<DuctSetup> ducts;
  };
  const auto make = [] {
    Theatre t(InstrumentKind::kGrasper);
    t.settle();
    leave_stump(t, 0);
    draw_clip(t, 0.040);
    t.wait(50);
    const TissueShape shape = t.world().shape();
    return Made{{shape.changes.begin(), shape.changes.end()},
                {shape.thin_T.begin(), shape.thin_T.end()},
                t.world().thin()[0],
                t.setup().ducts};
  };
  const Made made = make(), again = make();
  EXPECT_EQ(made.changes, again.changes);
  EXPECT_EQ(made.thin_T, again.thin_T);
  ASSERT_EQ(made.changes.size(), 3U);
  const auto off_m = [&](std::size_t changes) {
    const DuctPlayback playback(made.ducts, std::span(made.changes).first(changes));
    const SurfacePtr played = playback.at(made.thin_T)[0];
    EXPECT_EQ(played->triangles, made.tube->triangles);
    double off = 0;
    for (std::size_t v = 0; v < made.tube->vertices.size(); ++v)
      off = std::max(off, (played->vertices[v] - made.tube->vertices[v]).norm());
    return off;
  };
  EXPECT_LT(off_m(3), 6e-4) << "rings may be turned a little";
  EXPECT_GT(off_m(2), 1.25 * off_m(3)) << "without the last change it would still be flat there";
}

/// Jaws round a duct that are pushed on beyond it go through it: it must not throw the shaft out of itself.
TEST(DuctSystem, ADuctThatTheJawsWereRoundIsFeltAgainOnlyWhereTheToolIsClearOfIt) {
  Theatre t(InstrumentKind::kClipApplier);
  t.settle();
  const Vec3 at = t.middle(0);
  const auto shown = [&](double aside_m, double deeper_m) {
    t.step(from_above(at - Vec3(0, aside_m, kTip + deeper_m)), 0.012);
    return t.triangles_of(1);
  };
  EXPECT_GT(shown(0.012, 0), 20) << "beside it";
  for (double up = 0.03; up > 0; up -= 0.001) shown(0, -up);
  EXPECT_EQ(shown(0, 0), 0) << "round it";
  for (double deeper = 0; deeper < 0.012; deeper += 0.0005)
    EXPECT_EQ(shown(0, deeper), 0) << deeper << " m beyond it, jaws or shaft through it";
  EXPECT_GT(shown(0.012, 0), 20) << "beside it again";
}

TEST(DuctSystem, AChangeIsReadBackFromItsBytesAndWhatIsNoneIsRefused) {
  DuctChange change{DuctChange::Kind::kClipped, 1, 0.0123, 0.75, {1, 2, 3}, Mat3::Identity()};
  change.rotation_rod(0, 2) = -0.5;
  const std::string bytes = duct_change_bytes(change);
  const DuctChange read = parse_duct_change(bytes);
  EXPECT_EQ(read.kind, change.kind);
  EXPECT_EQ(read.duct, 1);
  EXPECT_EQ(read.arc_m, change.arc_m);
  EXPECT_EQ(read.share, change.share);
  EXPECT_EQ(read.offset_rod, change.offset_rod);
  EXPECT_EQ(read.rotation_rod, change.rotation_rod);
  std::string later = bytes;
  later[sizeof(std::int32_t)] = static_cast<char>(DuctChange::Kind::kUnclipped);
  EXPECT_EQ(parse_duct_change(later).kind, DuctChange::Kind::kUnclipped);
  ++later[sizeof(std::int32_t)];
  EXPECT_THROW(parse_duct_change(later), InputError);
  EXPECT_THROW(parse_duct_change(bytes.substr(0, bytes.size() - 1)), InputError);
  EXPECT_THROW(parse_duct_change(bytes + "x"), InputError);
  EXPECT_THROW(parse_duct_change("nonsense that is long enough to be read as a change of a duct"), InputError);
  const std::vector<DuctSetup> one{duct("cystic duct", 0, DuctContent::kBile)};
  EXPECT_THROW(DuctPlayback(one, std::vector<std::string>{bytes}), InputError) << "there is no second duct";
}

TEST(DuctSystem, ADuctThatEndsBesideTheOrganIsRefusedByName) {
  TissueSetup setup = Theatre(InstrumentKind::kProbe).setup();
  const auto organ = test::ellipsoid({0.06, 0.05, 0.035}, 40);
  setup.organ_T = organ.get();
  setup.seen_T = organ;
  setup.ducts[1].path_T[1].x() += 0.01;
  try {
    const TissueWorld world(setup);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("cystic artery"), std::string::npos);
  }
}

}  // namespace
}  // namespace trocar::duct_system_test
