// Clip and cut: the duct and the artery to be clipped and divided, and what a clip must be to count, as an exercise
// file describes it.
//
// Of the exercise's ducts the first is the cystic duct and the second the cystic artery; the third and the fourth, from
// whose axes those come, must be spared.
// Lengths m along a structure count from its first point, where its content comes from. Thread: plain values, fixed
// after loading.
#pragma once

#include <array>

#include "scenarios/exercise.h"

namespace trocar {

inline constexpr int kClipStructures = 2;  ///< that are divided
inline constexpr int kClipsEach = 3;       ///< two before the cut, one beyond it
inline constexpr int kClipsBefore = 2;

/// What is asked for, in its order: both named, both clipped, both divided.
enum class ClipStep : std::uint8_t { kName, kClip, kCut };
struct ClipAim {
  ClipStep step = ClipStep::kName;
  int structure = 0;
  int clip = 0;  ///< of that structure, 0 .. kClipsEach - 1
};
inline constexpr int kFirstClipAim = kClipStructures;
inline constexpr int kFirstCutAim = kFirstClipAim + kClipStructures * kClipsEach;
inline constexpr int kClipAims = kFirstCutAim + kClipStructures;

constexpr ClipAim clip_aim(int target) {
  if (target < kFirstClipAim) return {ClipStep::kName, target, 0};
  if (target < kFirstCutAim)
    return {ClipStep::kClip, (target - kFirstClipAim) / kClipsEach, (target - kFirstClipAim) % kClipsEach};
  return {ClipStep::kCut, target - kFirstCutAim, 0};
}

struct ClipRules : KindRules {
  std::array<double, kClipsEach> clip_at_m{};  ///< along a structure, where clips are asked for
  double cut_at_m = 0;                         ///< where the cut is
  double tips_beyond_m = 0;                    ///< of the axis, where the tips are asked to stand
  double touch_s = 0;                          ///< that a touch which names lasts
  double pull_low_n = 0, pull_high_n = 0;      ///< of a pull that tries a clip and spares it
  double clip_gap_m = 0;                       ///< at least, between two clips
  double spared_m = 0;                         ///< at least, from the wall of what must be spared to a clip
  double angle_rad = 0;                        ///< at most, from straight across
  double cut_gap_m = 0;                        ///< at least, from a clip to the cut
  double clip_width_m = 0;                     ///< along the structure
  double blood_ml = 0;                         ///< of blood lost: a critical error beyond
  double clear_m = 0;                          ///< of the axes over the tissue beneath, but where they dive into it
  double turn_rad = 0, shift_m = 0;            ///< by which boards differ, either way
};

struct ClipLevel : KindRules {
  bool places_shown = true;  ///< marks say where clips and cuts are asked for; else only which structure
};

}  // namespace trocar
