// What deforms of a world, as it is after a step: the nodes that it computes on and what is written on them. The
// recorder keeps it, playback makes surfaces of it (solid/embedded_surface.h).
//
// Frame T, m. Views into the world: valid until its next step. Thread: tissue task.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "haptics/quantities.h"

namespace trocar {

using NodePlace = Eigen::Vector3f;  ///< m; its rounding is some 0.03 um within a theatre

enum class FieldPlace : std::uint8_t { kNodes, kVertices };

/// A share 0 none .. 1 full at every node, or at every vertex of the surface: blood, char, whitening, wet.
struct ShapeField {
  std::string name;
  FieldPlace place = FieldPlace::kVertices;
  std::vector<float> value;

  bool operator==(const ShapeField&) const = default;
};

struct TissueShape {
  std::uint64_t topology = 0;          ///< as long as it is the same, node i is the same place
  std::span<const NodePlace> nodes_T;  ///< of the organ, then those of its thin parts; empty: nothing deforms
  std::span<const ShapeField> fields;
  /// Every change of topology since the beginning, in order, in bytes that the world alone can read.
  std::span<const std::string> changes;
  std::span<const NodePlace> thin_T = {};  ///< the last ones of nodes_T
};

}  // namespace trocar
