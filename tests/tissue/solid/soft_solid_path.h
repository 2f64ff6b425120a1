// A run of a soft solid of either build, for the comparison of both.
#pragma once

#include <cstring>
#include <string>

#include "tests/tissue/solid/soft_blocks.h"

namespace trocar::test {

/// Bytes of all positions and velocities after 60 steps under a tool, from a scramble.
template <class Solid>
std::string bytes_of_run() {
  const SoftBlock block(5, 4, 3, 0.01);
  TissueSolid material = elastic(5000, 0.45);
  material.prony = {PronyBranch{0.35, 0.1}, PronyBranch{0.25, 5}};
  material.stiffening = 2;
  Solid solid(block.nodes, block.cells, std::span(&material, 1), SoftSolidOptions{});
  for (const std::int32_t node : block.face(2, false)) solid.hold(node, 20);
  solid.place(scrambled(solid.rest(), 0.01, 7));
  std::string bytes;
  for (int i = 0; i < 60; ++i) {
    SoftSpring tool{{{block.id(2, 2, 3), block.id(3, 2, 3)}, {0.4F, 0.6F}}, Vec3::UnitZ(), 200};
    const Vec3 at = (solid.position()[std::size_t(block.id(2, 2, 3))]).template cast<double>();
    tool.stretch_m = at.z() - 0.03 + 1e-4 * i;
    tool.pushes_only = true;
    solid.step({&tool, 1});
    for (const auto values : {solid.position(), solid.velocity()})
      bytes.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
    bytes.append(reinterpret_cast<const char*>(&tool.force_n), sizeof tool.force_n);
    const double softness = solid.compliance(tool.place, tool.direction, 0.02, true);
    bytes.append(reinterpret_cast<const char*>(&softness), sizeof softness);
  }
  return bytes;
}

/// Of the solid built without vector instructions.
std::string portable_bytes();

}  // namespace trocar::test
