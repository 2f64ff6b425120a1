// Lift and find: a flap that is lifted to read what is hidden beneath it, as an exercise file describes it, and what a
// board hides.
//
// Lengths m, forces N, angles rad, frame T. Thread: plain values, fixed after loading.
#pragma once

#include "scenarios/exercise.h"
#include "scenarios/hands/percept.h"

namespace trocar {

struct FindRules : KindRules {
  double reach_m = 0;        ///< from the axis of a place: the flap that is taken further off does not count
  double seen_rad = 0;       ///< of the flap about its hinge: from here on the symbol is to be seen
  double grip_low_n = 0;     ///< wanted grip: it holds what is pulled ...
  double grip_high_n = 0;    ///< ... and spares the tissue
  double grip_most_n = 0;    ///< where the pads damage what they hold
  double edge_m = 0;         ///< from the free edge to the middle of a place
  double pin_radius_m = 0;   ///< of the head
  double answer_m = 0;       ///< radius of the balls in which answers are told
  double answer_hold_s = 0;  ///< the tip in one of them
  double answers_before_m = 0, answers_apart_m = 0, answers_above_m = 0;  ///< free edge to their row; organ to row
};

struct HiddenPin {
  Vec3 centre_T = Vec3::Zero(), normal_T = Vec3::UnitZ();  ///< of its head, on the organ
  std::int32_t symbol = 0;                                 ///< below kMostAnswers
};

struct FindBoard : KindRules {
  Vec3 hinge_T = Vec3::Zero(), along_T = Vec3::UnitX();  ///< a place on the hinge, and its direction (unit)
  double thickness_m = 0;                                ///< of the flap
  std::vector<HiddenPin> pins;                           ///< one a target
  std::array<Vec3, kMostAnswers> answers_T;              ///< where each symbol is told
};

}  // namespace trocar
