// The rigid side of a scene: board, pegs, foam blocks or rings, and port, what the jaws do to the blocks, and what of
// them can be felt.
//
// One step: jaws grip (foam_grip.h), free blocks move (block_dynamics.h), pairs are listed. The board is felt through
// two large triangles of its own material, every block near the tool through its twelve; the block between the jaws is
// felt by the pinch instead, and once held it touches the rest as a capsule of the tool; a ring, whose hole no capsule
// has, by a spring to where board and pegs keep it. Frame T, SI units. Deterministic. Thread: tissue task.
#pragma once

#include <vector>

#include "haptics/contact/instrument.h"
#include "haptics/exchange/contact_patch.h"
#include "tissue/rigid/block_dynamics.h"
#include "tissue/rigid/foam_grip.h"
#include "tissue/rigid/rigid_scene.h"
#include "tissue/tissue_frame.h"

namespace trocar {

inline constexpr std::int32_t kBoardMaterial = 1, kFirstFoamMaterial = 2;  ///< in the patch's table; 0 is the organ
inline constexpr std::int32_t kFirstRigidId = 1 << 28;  ///< patch triangles of the board, then blocks

class RigidWorld {
 public:
  /// @throws InputError when there are more blocks or kinds than frame and patch hold.
  RigidWorld(const RigidScene& scene, const Tool& tool);

  /// The instrument in hand from now on. Only a grasper takes blocks.
  void take(const Tool& tool) { tool_ = tool; }

  /// @param present the instrument is in the scene: it meets the blocks.
  void step(const JawReading& jaws, bool present, double dt_s);
  /// What the jaws hold, as a capsule of the tool.
  HeldObject held() const { return grip_.held(bodies_); }
  /// What keeps a held ring from where the jaws would have it.
  GripHold hold() const { return grip_.hold(bodies_, board_.stiffness_n_per_m); }
  /// Adds materials, triangles near the tool and grip block. @param patch count and dropped go on from where they are.
  void add_to(const JawReading& jaws, ContactPatch& patch) const;
  /// Fills objects, grip and pairs.
  void describe(TissueFrame& frame) const;

 private:
  std::vector<Pusher> pushers(const JawReading& jaws) const;
  void list_pairs(const JawReading& jaws, bool present);
  void list_tool_pairs(const JawReading& jaws);
  void list_block_pairs();
  void add_pair(std::int32_t a, std::int32_t b, const RigidContacts& contacts, double stiffness_n_per_m);
  /// Does what lies within reach_m of these two points belong into the patch?
  bool near_tool(const JawReading& jaws, const Vec3& from_T, const Vec3& to_T, double reach_m) const;

  RigidScene scene_;
  Tool tool_;
  double floor_z_m_ = 0;
  RigidMaterial board_;
  std::vector<RigidBody> bodies_;
  std::vector<Foam> foams_;
  BlockDynamics dynamics_;
  FoamGrip grip_;
  std::vector<ContactPair> pairs_;
};

}  // namespace trocar
