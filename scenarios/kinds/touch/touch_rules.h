// Surface touch: the squeeze that ends it, as an exercise file describes it; its discs are the TargetLayout of every
// kind.
//
// Lengths m, forces N, times s. Thread: plain values, fixed after loading.
#pragma once

namespace trocar {

/// The grip event that ends the exercise.
struct GripTask {
  double block_thickness_m = 0, block_stiffness_n_per_m = 0;
  double low_n = 0, high_n = 0, hold_s = 0;
  double excess_n = 0;  ///< GRIP_EXCESS above this
};

}  // namespace trocar
