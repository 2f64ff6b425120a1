#include "tissue/tissue_world.h"

#include <algorithm>
#include <cassert>

namespace trocar {
namespace {

constexpr double kFirstStep = 0.01;    // s
constexpr double kLongestStep = 0.05;  // s: a gap in the states never counts as more

}  // namespace

TissueWorld::TissueWorld(const TissueSetup& setup)
    : organ_(setup.organ), adjacent_(setup.adjacent), tool_(setup.tool), seen_(setup.seen_T) {
  assert(adjacent_.size() < kMaxPatchMaterials && (adjacent_.empty() || setup.rigid.empty()));
  if (setup.organ_T && !setup.organ_T->triangles.empty()) extraction_.emplace(*setup.organ_T, setup.triangle_material);
  if (!setup.rigid.empty()) rigid_.emplace(setup.rigid, setup.tool);
}

void TissueWorld::step(const HapticState& newest, bool present, ContactPatch& patch) {
  const StylusState& state = newest.stylus;
  const double dt_s = frame_.stamp == 0 ? kFirstStep : std::clamp(state.t_s - frame_.t_s, 0.0, kLongestStep);
  ++frame_.stamp;
  frame_.t_s = state.t_s;
  patch.stamp = frame_.stamp;
  patch.topology = seen_ ? seen_->topology : 0;
  patch.clear();
  patch.reach_m = kPatchRadius;
  patch.material[0] = organ_;
  std::copy(adjacent_.begin(), adjacent_.end(), patch.material.begin() + 1);
  patch.grip = {};
  patch.held = {};
  const JawReading jaws{state.X_TI, state.V_TI_T, state.jaw_opening_m, state.grip_force_n};
  if (rigid_) rigid_->step(jaws, present, dt_s);
  if (rigid_) patch.held = rigid_->held();
  if (present && extraction_) extraction_->extract(state.X_TI, tool_, patch, state.jaw_opening_m);
  if (present && rigid_) rigid_->add_to(jaws, patch);
  enclose(patch, patch.balls);
  if (rigid_) rigid_->describe(frame_);
  dropped_ += static_cast<std::uint64_t>(patch.dropped);
}

}  // namespace trocar
