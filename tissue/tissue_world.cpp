#include "tissue/tissue_world.h"

#include <algorithm>
#include <cassert>

namespace trocar {
namespace {

constexpr double kFirstStep = 0.01;    // s
constexpr double kLongestStep = 0.05;  // s: a gap in the states never counts as more

}  // namespace

TissueWorld::TissueWorld(const TissueSetup& setup)
    : organ_(setup.organ), adjacent_(setup.adjacent), tools_(setup.tools), seen_(setup.seen_T) {
  assert(!tools_.empty());
  assert(adjacent_.size() < kMaxPatchMaterials && (adjacent_.empty() || setup.rigid.empty()));
  if (setup.soft && seen_) {
    SoftOrganOptions options = setup.soft->options;
    options.tool_radius_m = tools_.front().shape.radius_m;
    soft_.emplace(setup.soft->lattice, seen_, setup.soft->material, options);
    felt_ = *setup.organ_T;
    velocity_.assign(felt_.vertices.size(), Vec3::Zero());
    organ_.mu_static = setup.soft->material.mu_static;
    organ_.mu_dynamic = setup.soft->material.mu_dynamic;
    triangle_material_.assign(setup.triangle_material.begin(), setup.triangle_material.end());
    organ_vertices_ = seen_->vertices.size();
    organ_triangles_ = seen_->triangles.size();
    actions_.emplace(*soft_);
    extraction_.emplace(felt_, triangle_material_);
  } else if (setup.organ_T && !setup.organ_T->triangles.empty()) {
    extraction_.emplace(*setup.organ_T, setup.triangle_material);
  }
  if (!setup.rigid.empty()) rigid_.emplace(setup.rigid, tools_.front());
}

const Tool& TissueWorld::in_hand(const StylusState& stylus) const {
  return tools_[std::min(static_cast<std::size_t>(std::max(0, stylus.instrument)), tools_.size() - 1)];
}

void TissueWorld::step(const HapticState& newest, bool present, ContactPatch& patch) {
  const StylusState& state = newest.stylus;
  const double dt_s = frame_.stamp == 0 ? kFirstStep : std::clamp(state.t_s - frame_.t_s, 0.0, kLongestStep);
  ++frame_.stamp;
  frame_.t_s = state.t_s;
  patch.stamp = frame_.stamp;
  patch.topology = soft_ ? soft_->topology() : seen_ ? seen_->topology : 0;
  patch.clear();
  patch.reach_m = kPatchRadius;
  patch.material[0] = organ_;
  std::copy(adjacent_.begin(), adjacent_.end(), patch.material.begin() + 1);
  patch.grip = {};
  patch.held = {};
  const Tool& tool = in_hand(state);
  const JawReading jaws{state.X_TI, state.V_TI_T, state.jaw_opening_m, state.grip_force_n};
  if (rigid_) rigid_->take(tool);
  if (rigid_) rigid_->step(jaws, present, dt_s);
  if (rigid_) patch.held = rigid_->held();
  if (soft_) step_soft(newest, tool, present);
  if (present && extraction_) extraction_->extract(state.X_TI, tool.shape, patch, state.jaw_opening_m);
  if (soft_) {
    patch.material[0].stiffness_n_per_m = soft_->stiffness_n_per_m();
    patch.glide_s = soft_->solid().options().step_s;
    patch.follows = frame_.stamp - 1;
    patch.given_j = soft_->given_j();
    patch.topology = soft_->topology();  // a cut in this step has changed it
    patch.hold = actions_->grip().hold();
    patch.grip = actions_->block();
    actions_->grip().clear(patch);
    frame_.grip = actions_->grip().state();
    frame_.slipped_m = actions_->grip().slipped_m();
    actions_->tell(*soft_, frame_);
  }
  if (present && rigid_) rigid_->add_to(jaws, patch);
  enclose(patch, patch.balls);
  if (rigid_) rigid_->describe(frame_);
  dropped_ += static_cast<std::uint64_t>(patch.dropped);
}

void TissueWorld::step_soft(const HapticState& newest, const Tool& tool, bool present) {
  std::vector<SoftSpring> springs;
  const bool cut = actions_->before(newest, tool, present, *soft_, springs);
  if (cut) take_cut_surface();
  soft_->step(newest.contacts, present ? &newest.stylus.X_TI.p : nullptr, springs);
  actions_->after(newest, tool, present, springs, *soft_);
  const auto felt = soft_->felt();
  const double step_s = soft_->solid().options().step_s;
  for (std::size_t v = 0; v < felt.size(); ++v) {
    velocity_[v] = (felt[v] - felt_.vertices[v]) / step_s;
    felt_.vertices[v] = felt[v];
  }
  extraction_->refit(velocity_);
}

void TissueWorld::take_cut_surface() {
  // The felt vertices of before stay where they were; the adjacent organs' move behind the organ's new ones.
  const auto& organ = *soft_->rest();
  const auto shift = static_cast<std::int32_t>(organ.vertices.size() - organ_vertices_);
  TriangleSurface felt;
  felt.vertices.assign(felt_.vertices.begin(), felt_.vertices.begin() + static_cast<std::ptrdiff_t>(organ_vertices_));
  felt.vertices.insert(felt.vertices.end(), soft_->felt().begin() + static_cast<std::ptrdiff_t>(organ_vertices_),
                       soft_->felt().end());
  felt.vertices.insert(felt.vertices.end(), felt_.vertices.begin() + static_cast<std::ptrdiff_t>(organ_vertices_),
                       felt_.vertices.end());
  felt.triangles = organ.triangles;
  for (std::size_t t = organ_triangles_; t < felt_.triangles.size(); ++t) {
    auto triangle = felt_.triangles[t];
    for (std::int32_t& corner : triangle) corner += shift;
    felt.triangles.push_back(triangle);
  }
  if (!triangle_material_.empty())
    triangle_material_.insert(triangle_material_.begin() + static_cast<std::ptrdiff_t>(organ_triangles_),
                              organ.triangles.size() - organ_triangles_, 0);
  felt_ = std::move(felt);
  velocity_.assign(felt_.vertices.size(), Vec3::Zero());
  organ_vertices_ = organ.vertices.size();
  organ_triangles_ = organ.triangles.size();
  extraction_.emplace(felt_, triangle_material_);
}

TissueShape TissueWorld::shape() const {
  if (!soft_) return {};
  return {.topology = soft_->topology(),
          .nodes_T = soft_->solid().position(),
          .fields = soft_->fields(),
          .changes = soft_->cuts()};
}

}  // namespace trocar
