#include "tests/app/session/recording/waving_world.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace trocar::test {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kBreath_s = 4, kBreath_m = 0.012, kPress_hz = 2, kPress_m = 0.010, kPressed_m = 0.0125;

}  // namespace

std::vector<NodePlace> block_of_nodes(std::size_t count) {
  const auto edge = static_cast<int>(std::ceil(std::cbrt(static_cast<double>(count))));
  std::vector<NodePlace> nodes;
  for (int k = 0; k < edge; ++k)
    for (int j = 0; j < edge; ++j)
      for (int i = 0; i < edge && nodes.size() < count; ++i)
        nodes.emplace_back(0.01f * static_cast<float>(i), 0.01f * static_cast<float>(j), 0.01f * static_cast<float>(k));
  return nodes;
}

std::vector<NodePlace> waved(const std::vector<NodePlace>& rest_T, double t_s, double noise_m) {
  std::mt19937_64 random(static_cast<std::uint64_t>(1e4 * t_s) + 1);
  std::uniform_real_distribution<double> noise(-noise_m, noise_m);
  Eigen::AlignedBox3f box;
  for (const NodePlace& node : rest_T) box.extend(node);
  const NodePlace pressed(box.center().x(), box.center().y(), box.max().z());
  const double depth = kPress_m * 0.5 * (1 - std::cos(kTurn * kPress_hz * t_s));
  std::vector<NodePlace> nodes = rest_T;
  for (NodePlace& node : nodes) {
    const double late = double{node.x()} / 0.3;
    const double breath = kBreath_m * 0.5 * (1 - std::cos(kTurn * (t_s / kBreath_s - 0.1 * late)));
    const double near = double{(node - pressed).norm()} / kPressed_m;
    const Vec3 moved(0.2 * breath * late, breath * (0.8 + 0.2 * late), -0.3 * breath - depth * std::exp(-near * near));
    node += (moved + Vec3(noise(random), noise(random), noise(random))).cast<float>();
  }
  return nodes;
}

WavingWorld::WavingWorld(std::vector<NodePlace> rest_T, std::shared_ptr<const EmbeddedSurface> surface)
    : rest_T_(std::move(rest_T)), nodes_T_(rest_T_), surface_(std::move(surface)) {
  fields_ = {{"blood", FieldPlace::kNodes, std::vector<float>(rest_T_.size(), 0)}};
}

void WavingWorld::step(const HapticState& state, bool, ContactPatch& patch) {
  patch = {};
  patch.stamp = ++frame_.stamp;
  frame_.t_s = state.stylus.t_s;
  nodes_T_ = waved(rest_T_, frame_.t_s);
  const auto bloody = std::min(rest_T_.size(), static_cast<std::size_t>(10 * frame_.t_s));
  std::fill_n(fields_[0].value.begin(), bloody, 0.6f);
}

SurfacePtr WavingWorld::surface() const { return surface_ ? surface_->at(nodes_T_, fields_) : nullptr; }

}  // namespace trocar::test
