// What the hand feels while tissue is cut under the instrument: loop at 1 kHz, tissue at 100 Hz behind it.
#include <gtest/gtest.h>

#include <memory>

#include "haptics/contact/contact_renderer.h"
#include "tests/tissue/solid/soft_organ_rig.h"
#include "tissue/tissue_world.h"

namespace trocar {
namespace {

struct Felt {
  double largest_n = 0, largest_step_n = 0, step_at_cut_n = 0;
  int cuts = 0;
};

/// Scissors pressed in from above by so much, held there, and closed; steps of the force on the tip, N/ms.
Felt feel_snip(double in_m) {
  const SurfacePtr rest = test::ellipsoid({0.06, 0.05, 0.035}, 32);
  auto soft = std::make_shared<SoftSetup>();
  soft->material.residual_strain = 0.06;
  soft->lattice = build_lattice(*rest, {.cell_m = 0.010}).lattice;
  TissueSetup setup;
  setup.organ_T = rest.get();
  setup.seen_T = rest;
  setup.tools = {make_tool(InstrumentKind::kScissors)};
  setup.soft = soft;
  TissueWorld world(setup);
  ContactRenderer renderer(ContactLaw::kProxy, setup.tools[0].shape);
  std::array<ContactPatch, 2> patch;
  HapticState state;
  Felt felt;
  Vec3 last = Vec3::Zero();
  int cut_at = -1;
  for (int ms = 0; ms < 2200; ++ms) {
    const double z = 0.045 - std::min(1.0, ms / 1000.0) * (0.010 + in_m);
    const double opening = ms < 1400 ? 0.012 : std::max(0.0, 0.012 - 0.03e-3 * (ms - 1400));
    state.stylus.t_s = ms * 1e-3;
    state.stylus.X_TI = test::from_above({0, 0, z});
    state.stylus.jaw_opening_m = opening;
    const Twist speed{{0, 0, ms < 1000 ? -(0.010 + in_m) : 0}, Vec3::Zero()};
    // A patch is in use from 5 ms after its step on.
    if (ms % 10 == 0) world.step(state, true, patch[std::size_t(ms / 10 % 2)]);
    const ContactPatch& seen = patch[std::size_t((ms - 5 < 0 ? 0 : (ms - 5) / 10) % 2)];
    const ContactResult result = renderer.update(state.stylus.X_TI, speed, seen, opening);
    state.contacts = renderer.contacts();
    const Vec3 force = result.F_I_T.force;
    EXPECT_TRUE(force.allFinite());
    if (world.frame().surgery.cuts > felt.cuts) felt.cuts = world.frame().surgery.cuts, cut_at = ms;
    const double step = (force - last).norm();
    if (ms > 1100) {
      felt.largest_step_n = std::max(felt.largest_step_n, step);
      if (cut_at >= 0 && ms - cut_at < 40) felt.step_at_cut_n = std::max(felt.step_at_cut_n, step);
    }
    felt.largest_n = std::max(felt.largest_n, force.norm());
    last = force;
  }
  return felt;
}

TEST(CutForce, NoStepAboveThreeTenthsOfANewtonAMillisecond) {
  for (const double in : {0.004, 0.012}) {
    const Felt felt = feel_snip(in);
    EXPECT_EQ(felt.cuts, 1);
    EXPECT_GT(felt.largest_n, 0.05);
    EXPECT_LT(felt.step_at_cut_n, 0.3);
    std::printf("pressed %.0f mm: %.2f N, largest step %.3f N/ms, at the cut %.3f\n", 1e3 * in, felt.largest_n,
                felt.largest_step_n, felt.step_at_cut_n);
  }
}

}  // namespace
}  // namespace trocar
