// How stiff a block of soft tissue is where it is pressed: the converged number that a coarse lattice is held to.
//
// Origin in the middle of the top face, z up, m; the block reaches from z = -depth to 0. Load and block are mirror
// images of themselves at x = 0 and y = 0, so a quarter is solved, on a mesh whose rings about the load are circles
// with one at its rim. Stiffness by work: F over the displacement d that the load's distribution feels, F d = work.
// Thread: any, not the tick.
#pragma once

#include <Eigen/Core>
#include <functional>

namespace trocar {

enum class BlockSides { free, held };

struct ReferenceBlock {
  Eigen::Vector3d size_m{0.120, 0.120, 0.060};
  /// Across the radius of the load; outside they grow e-fold in as many, under a punch they shrink towards its rim.
  /// At 3 tent and punch are within 1 % of converged at Poisson 0.45, a tent within 1.3 % at 0.49.
  int cells = 3;
  std::function<double(const Eigen::Vector3d& x_m)> young_pa = [](const Eigen::Vector3d&) { return 5000.0; };
  double poisson = 0.45;
  BlockSides sides = BlockSides::free;  ///< the bottom is always held
};

enum class BlockLoad {
  tent,          ///< pressure that falls linearly from the middle to nothing at the radius
  punch,         ///< flat, rigid, round and slippery
  bonded_punch,  ///< the same, and nothing slides under it
};

struct BlockStiffness {
  double force_n = 0, displacement_m = 0;  ///< of the whole block
  double n_per_m = 0;
  int nodes = 0, iterations = 0;  ///< of the quarter
};

/// @param radius_m of the load, less than half of every side and the depth. @throws std::invalid_argument otherwise
BlockStiffness stiffness(const ReferenceBlock& block, BlockLoad load, double radius_m);

struct ConvergedStiffness {
  double n_per_m = 0, uncertainty_n_per_m = 0;  ///< extrapolated; how far that lies from the finest mesh's
  double order = 0;                             ///< observed, of the error in the cell size
};

/// Richardson's extrapolation from `block.cells`, twice and four times as many. @throws as stiffness()
ConvergedStiffness converged_stiffness(ReferenceBlock block, BlockLoad load, double radius_m);

}  // namespace trocar
