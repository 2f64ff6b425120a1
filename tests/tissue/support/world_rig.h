// A board with two foam blocks and a grasper that points straight down, stepped at the tissue rate.
#pragma once

#include <memory>

#include "haptics/control/pinch_channel.h"
#include "tissue/tissue_world.h"

namespace trocar::test {

inline FoamBlock foam_block(const Vec3& middle, int kind = 0) {
  FoamBlock block;
  block.size_m = Vec3(0.014, 0.014, 0.020);
  block.mass_kg = 0.002;
  block.stiffness_n_per_m = 300 + 100 * kind;
  block.slip_below_n = 0.5;
  block.crush_above_n = 1.5;
  block.kind = kind;
  block.colour = 7 - kind;
  block.X_TO.p = middle;
  return block;
}

struct WorldRig {
  TissueSetup setup;
  std::unique_ptr<TissueWorld> world;
  std::unique_ptr<ContactPatch> patch = std::make_unique<ContactPatch>();
  StylusState state;

  WorldRig() {
    setup.rigid.board = BoardPlate{};
    setup.rigid.blocks = {foam_block(Vec3(0, 0, 0.010)), foam_block(Vec3(0.032, 0, 0.010), 1)};
    setup.tools = {make_tool(InstrumentKind::kGrasper)};
    state.X_TI.R << 1, 0, 0, 0, -1, 0, 0, 0, -1;
    state.X_TI.p = Vec3(0, 0, 0.060);
    state.jaw_opening_m = 0.022;
  }
  void start() { world = std::make_unique<TissueWorld>(setup); }
  /// Starts the world when it has not been started.
  void step(int steps = 1, bool present = true) {
    if (!world) start();
    for (int i = 0; i < steps; ++i) {
      state.t_s += 0.01;
      state.grip_force_n = grip_block(patch->grip, state.jaw_opening_m).force_n;
      world->step({state}, present, *patch);
    }
  }
  int triangles_of(std::int32_t material) const {
    int count = 0;
    for (int i = 0; i < patch->count; ++i) count += patch->triangle[std::size_t(i)].material == material;
    return count;
  }
};

}  // namespace trocar::test
