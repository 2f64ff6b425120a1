// One object as the jaws take, lift, lose hold of and let go of it.
//
// Events name the object as it is asked for, value in brackets: GRASPED [N], REGRASP [N] when it is grasped again,
// WRONG_BLOCK when it is not the lit one; LIFTED [m] off what it stood on and SET_DOWN [m] on it again, or let go of in
// the air: the carry between them is where the grip is judged; SLIP [m]. Frame T, SI units. Deterministic. Thread: the
// tissue task's.
#pragma once

#include "scenarios/director/exercise_task.h"
#include "tissue/tissue_frame.h"

namespace trocar {

inline constexpr double kCarriedFrom = 0.002;  ///< m over what it stood on

class CarryWatch {
 public:
  enum class Change : std::uint8_t { kNone, kTaken, kLetGo, kSlips };

  /// Whether the jaws hold it in this frame. @param index of the object in the world
  static bool holds(const TissueFrame& frame, std::int32_t index) { return frame.held() && frame.grip_object == index; }
  /// @param named for events. @param height_m over what it stood on
  Change update(const TissueFrame& frame, std::int32_t index, std::int32_t named, bool lit, double height_m,
                double grip_n, EventLog& log);
  /// It is where it was wanted: taking it is no regrasp from here on.
  void arrive() { grasped_ = false; }

  bool held() const { return held_; }                ///< by the jaws now
  bool up() const { return up_; }                    ///< in the jaws, off what it stood on
  double highest_m() const { return highest_m_; }    ///< since it was grasped last
  double let_go_z_m() const { return let_go_z_m_; }  ///< of its middle, when it was let go of last

 private:
  bool grasped_ = false, held_ = false, up_ = false, slipping_ = false;
  double highest_m_ = 0, let_go_z_m_ = 0;
  double slip_from_m_ = 0;  ///< slipped so far when the present slip began
};

}  // namespace trocar
