// A kinematic closed loop for calibrating hands: hand -> point mass behind a spring -> tissue -> director -> hand.
//
// The tip is a mass of 0.4 kg drawn to the intent through 98 N/m (a pen grip of 400 N/m and an arm of 130 N/m in
// series, as the simulated device has) and 8 N s/m; the surface answers with the exercise's
// stiffness along its normal. The hand sees positions 150 ms late with 0.3 mm of noise, and forces with 0.03 N.
#pragma once

#include <memory>
#include <string>

#include "scenarios/director/director.h"
#include "scenarios/hands/hand.h"
#include "scenarios/kinds/touch/disc_layout.h"
#include "scenarios/layout/height_field.h"
#include "scenarios/scoring/score.h"

namespace trocar {

struct PracticeAttempt {
  Trace trace;
  std::vector<Event> events;
  ScoringContext context;
  Grade grade;
};

/// A shipped exercise, and an organ placed for it where it needs one.
struct PracticeRoom {
  explicit PracticeRoom(const std::string& exercise_id = "surface-touch");
  Exercise exercise;
  TriangleSurface organ_T;
  HeightField field;
};

struct WorldTuning {
  double hand_stiffness_n_per_m = 98, hand_damping = 8, mass_kg = 0.4;
  double longest_s = 300;
  std::string level = "L1";
};

/// One attempt from device ready to the end of the exercise.
PracticeAttempt practise(const PracticeRoom& room, Hand& hand, int board, std::uint64_t seed,
                         const WorldTuning& tuning = {});
/// A shipped hand by name.
PracticeAttempt practise(const PracticeRoom& room, const std::string& hand, int board, std::uint64_t seed,
                         const WorldTuning& tuning = {});

/// First metric of that name. Fails the process when unknown.
std::optional<double> metric(const Grade& grade, const std::string& name);

}  // namespace trocar
