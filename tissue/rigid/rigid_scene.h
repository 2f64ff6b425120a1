// The rigid things of an exercise as they are laid out before it starts: board, blocks or rings, pegs, ring marks,
// port.
//
// Frame T, SI units. The table under the board is level with it: a block that leaves the board lies on the table.
// Thread: plain values, fixed after loading.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "haptics/quantities.h"

namespace trocar {

/// What the contact with a rigid thing feels like.
struct RigidMaterial {
  double stiffness_n_per_m = 250;  ///< as displayed: what the device can show, not the material's own [D]
  double damping_s_per_m = 0.5;    ///< Hunt-Crossley factor on the approach speed [D]
  double friction = 0.6;           ///< block on board, block on block [D]
  double tool_mu_static = 0.2, tool_mu_dynamic = 0.15;  ///< instrument on it [D]
};

/// A square plate whose upper face lies in the plane z = top_z_m of T, centred on the origin.
struct BoardPlate {
  double half_extent_m = 0.050;
  double top_z_m = 0;
  double thickness_m = 0.005;
  RigidMaterial material;
};

/// A foam block: a box that springs between the jaws, slips when held too lightly and is crushed when held too hard; or
/// a triangular ring (collide.h: RingShape), of which the jaws feel the same.
struct FoamBlock {
  Vec3 size_m = Vec3::Zero();  ///< extents along its own axes; ring: twice the height of its triangle, then its own
  double hole_radius_m = 0;    ///< of a ring; 0: a box
  double mass_kg = 0;
  double stiffness_n_per_m = 0;     ///< between the jaws, force per compression
  double slip_below_n = 0;          ///< a lighter grip does not hold its weight
  double crush_above_n = 0;         ///< a harder grip crushes it for good
  double crushed_thickness = 0.75;  ///< of the thickness, after crushing
  double crushed_stiffness = 0.5;   ///< of the stiffness, after crushing
  std::int32_t kind = 0;            ///< which foam
  std::int32_t colour = 0;          ///< index of the colour that is shown; equal for all where colour is no cue
  Pose X_TO;                        ///< at the start: z up, resting on the board
};

/// A round peg that stands on the board.
struct PegPost {
  Vec3 foot_T = Vec3::Zero();
  double radius_m = 0, height_m = 0;
};

/// A ring printed on the board: where a block shall stand. It is felt no more than the board is.
struct RingMark {
  Vec3 centre_T = Vec3::Zero();
  double radius_m = 0;  ///< inner
  std::int32_t colour = 0;
};

/// The port in the abdominal wall: a tube through which the shaft goes, widening above into a cone.
struct PortTube {
  Vec3 centre_T = Vec3::Zero();  ///< pivot, middle of the tube
  Vec3 axis_T = Vec3::UnitZ();   ///< unit, outwards
  double radius_m = 0.006, length_m = 0.020;
};

struct RigidScene {
  std::optional<BoardPlate> board;
  std::vector<FoamBlock> blocks;
  std::vector<RingMark> rings;
  std::vector<PegPost> pegs;
  std::optional<PortTube> port;
  bool empty() const { return !board && blocks.empty(); }
};

}  // namespace trocar
