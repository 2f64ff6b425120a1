// A world that deforms by formula: what keyframes are tested with. Nothing is felt of it.
//
// The organ breathes (12 mm in 4 s, one side later than the other) and a region 25 mm wide is pressed 10 mm deep twice
// a second; blood spreads over that region. Frame T, m.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "tissue/solid/embedded_surface.h"
#include "tissue/world.h"

namespace trocar::test {

/// Nodes of a block of tissue, about `count`, 10 mm apart.
std::vector<NodePlace> block_of_nodes(std::size_t count);

/// Where the nodes are at a time, from where they rest. @param noise_m of a solver that stops early, deterministic.
std::vector<NodePlace> waved(const std::vector<NodePlace>& rest_T, double t_s, double noise_m = 0);

class WavingWorld final : public World {
 public:
  /// @param surface may be nullptr: there is none to be seen.
  WavingWorld(std::vector<NodePlace> rest_T, std::shared_ptr<const EmbeddedSurface> surface);

  void step(const HapticState& state, bool present, ContactPatch& patch) override;
  const TissueFrame& frame() const override { return frame_; }
  SurfacePtr surface() const override;
  TissueShape shape() const override { return {topology, nodes_T_, fields_, changes}; }
  std::uint64_t dropped() const override { return 0; }

  std::uint64_t topology = 7;
  std::vector<std::string> changes;

 private:
  std::vector<NodePlace> rest_T_, nodes_T_;
  std::vector<ShapeField> fields_;
  std::shared_ptr<const EmbeddedSurface> surface_;
  TissueFrame frame_;
};

}  // namespace trocar::test
