// Instruments on two organs and the bed between them, as the world steps them.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/tissue/solid/bed_rig.h"
#include "tissue/tissue_world.h"

namespace trocar::bed_actions_test {
namespace {

/// The two blocks of the rig in a world of their own, and an instrument from above.
class BedTheatre {
 public:
  explicit BedTheatre(InstrumentKind kind) {
    const SurfacePtr first = scene_.lower(), second = scene_.upper();
    auto soft = std::make_shared<SoftSetup>();
    soft->material = scene_.below;
    soft->neighbour = scene_.above;
    soft->bed = scene_.bed;
    soft->options.solid.edge_m = scene_.edge_m;
    const Lattice one = build_lattice(*first, {.cell_m = scene_.edge_m}).lattice;
    soft->lattice = beside(one, build_lattice(*second, {.cell_m = scene_.edge_m, .grid_m = one.origin_m}).lattice);
    both_ = both_surfaces(*first, *second);
    TissueSetup setup;
    setup.organ_T = both_.get();
    setup.seen_T = both_;
    setup.tools = {make_tool(kind)};
    setup.soft = soft;
    world_ = std::make_unique<TissueWorld>(setup);
  }
  void step(const Vec3& tip, double opening_m, bool pedal = false) {
    state_.stylus.t_s += 0.01;
    state_.stylus.X_TI.R << 1, 0, 0, 0, -1, 0, 0, 0, -1;
    state_.stylus.X_TI.p = tip;
    state_.stylus.jaw_opening_m = opening_m;
    state_.stylus.pedal = pedal;
    world_->step(state_, true, *patch_);
  }
  const SurgeryState& surgery() const { return world_->frame().surgery; }
  const TissueFrame& frame() const { return world_->frame(); }

 private:
  test::BedScene scene_;
  SurfacePtr both_;
  std::unique_ptr<TissueWorld> world_;
  std::unique_ptr<ContactPatch> patch_ = std::make_unique<ContactPatch>();
  HapticState state_;
};

TEST(BedActions, GrasperPeelsWhatItHoldsAndTheBedOozes) {
  BedTheatre theatre(InstrumentKind::kGrasper);
  const Vec3 end(0.064, 0, 0.009);
  for (double opening = 0.020; opening > 0.002; opening -= 0.001) theatre.step(end, opening);
  ASSERT_EQ(theatre.frame().grip, GripState::kHolding);
  EXPECT_EQ(theatre.surgery(), SurgeryState{});
  for (int i = 1; i <= 500; ++i) theatre.step(end + Vec3(0, 0, 1e-4 * i), 0.002);
  EXPECT_GT(theatre.surgery().bed_free, 0.2);
  EXPECT_GE(theatre.surgery().bed_hurt, theatre.surgery().bed_free);
  EXPECT_EQ(theatre.surgery().tears, 0);
  EXPECT_GT(theatre.surgery().wounds, 0);
  EXPECT_GT(theatre.surgery().blood_ml, 0);
  EXPECT_LT(theatre.surgery().blood_ml, 0.2);
}

TEST(BedActions, LiveHookGoesThroughTheFibres) {
  BedTheatre theatre(InstrumentKind::kHook);
  for (int i = 0; i <= 200; ++i) theatre.step({0.011 + 0.0001 * i, -0.012, 0.0005}, 0, false);
  EXPECT_EQ(theatre.surgery(), SurgeryState{});
  for (int i = 0; i <= 200; ++i) theatre.step({0.011 + 0.0001 * i, -0.012, 0.0005}, 0, true);
  EXPECT_GT(theatre.surgery().bed_free, 0.02);
  EXPECT_LT(theatre.surgery().bed_free, 0.10);
  EXPECT_EQ(theatre.surgery().wounds, 0);  // what is boiled off does not bleed
}

}  // namespace
}  // namespace trocar::bed_actions_test
