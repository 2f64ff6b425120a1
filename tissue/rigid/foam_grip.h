// Jaws and foam blocks: which block stands between the pads, how it is squeezed, held, let slip, crushed and let go.
//
//   squeeze   F = k (h - o), h thickness across the pads, o their opening (rendered at 1 kHz by the pinch channel)
//   hold      a block is held while F >= 0.05 N; it starts to be at 0.1 N
//   slip      held lighter than its slip force and carried free, it creeps down through the pads at
//             v = v_slip (1 - F / F_slip): the ridges of the pads bite only into compressed foam
//   crush     above its crush force it is thinner and softer for good
//   set down  the board turns a held block towards flat against the foam in the pads (k h^2/12 per radian, h as long as
//   they
//             hold it), and pushes it up through the pads when it presses harder than 2 mu F
// A ring is between the pads as thick as its triangle is high, however it is turned; pegs stop it on its way,
// push it through the pads as the board does, and turn it upright between them as it goes down over one. The pads close
// in parallel: their opening is the same along them. Frames T and I (haptics/contact/tool_shape.h: x the hinge axis,
// pads meeting in y = 0). SI units. Deterministic. Thread: tissue task.
#pragma once

#include <vector>

#include "haptics/exchange/contact_patch.h"
#include "tissue/rigid/rigid_body.h"
#include "tissue/rigid/rigid_scene.h"
#include "tissue/tissue_frame.h"

namespace trocar {

/// A block as it has become.
struct Foam {
  FoamBlock spec;
  double stiffness_n_per_m = 0;
  bool crushed = false;
};

/// What the instrument does at a step's end.
struct JawReading {
  Pose X_TI;
  Twist V_TI_T;
  double opening_m = 0, grip_n = 0;
};

class FoamGrip {
 public:
  /// Moves the block that the jaws have, starts and ends holds. @param floor_z_m height of the board.
  void update(const JawReading& jaws, const RigidMaterial& board, double floor_z_m, const std::vector<PegPost>& pegs,
              double dt_s, std::vector<RigidBody>& bodies, std::vector<Foam>& foams);
  /// Lets go of everything (the instrument is not in the scene).
  void reset(std::vector<RigidBody>& bodies);

  GripState state() const { return state_; }
  int object() const { return object_; }
  double slipped_m() const { return slipped_m_; }
  double board_force_n() const { return board_force_n_; }  ///< of the board on the held block
  /// For the pinch channel: what lies between the pads.
  GripBlock block(const std::vector<RigidBody>& bodies, const std::vector<Foam>& foams, const Pose& X_TI) const;
  /// For the contact stage: the held block as a capsule. A ring has none: hold() tells what it meets.
  HeldObject held(const std::vector<RigidBody>& bodies) const;
  /// What board and pegs do to a held ring: they keep it where it is seen, against the jaws.
  GripHold hold(const std::vector<RigidBody>& bodies, double stiffness_n_per_m) const;

 private:
  void look_for_block(const JawReading& jaws, const std::vector<RigidBody>& bodies);
  void centre(const JawReading& jaws, const std::vector<PegPost>& pegs, RigidBody& body) const;
  void grasp(const JawReading& jaws, std::vector<RigidBody>& bodies);
  void let_go(const Twist& V_TI_T, const Vec3& tip_T, std::vector<RigidBody>& bodies);
  void squeeze(const JawReading& jaws, RigidBody& body, Foam& foam) const;
  void carry(const JawReading& jaws, const RigidMaterial& board, double floor_z_m, const std::vector<PegPost>& pegs,
             double dt_s, std::vector<RigidBody>& bodies, const Foam& foam);

  GripState state_ = GripState::kEmpty;
  int object_ = -1;
  Pose X_IO_;  ///< of the held block
  double slipped_m_ = 0, board_force_n_ = 0;
  bool met_ = false;  ///< board or pegs keep a held ring from where the jaws would have it
};

}  // namespace trocar
