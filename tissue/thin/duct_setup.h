// A duct or a vessel as a scene lays it out: where it runs, what it is made of, what holds it, what it carries.
//
// The path's first point is where its content comes from. T, SI. Thread: plain values.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "haptics/quantities.h"
#include "tissue/solid/tissue_material.h"

namespace trocar {

enum class DuctHold : std::uint8_t { kOrgan, kFixed };
enum class DuctContent : std::uint8_t { kNothing, kBile, kBlood };

struct DuctSetup {
  std::string name;          ///< "cystic duct"
  std::vector<Vec3> path_T;  ///< as drawn, m; at least two points
  double outer_radius_m = 0.0015, wall_m = 0.0005;
  TissueSolid material;
  std::array<DuctHold, 2> ends{DuctHold::kOrgan, DuctHold::kFixed};  ///< of the first and the last point
  DuctContent content = DuctContent::kNothing;
  bool slack = false;  ///< drawn without the tension that ducts and vessels have at rest
};

}  // namespace trocar
