// Which attempts a sweep is made of, and how one of them is run: in lockstep, in memory, graded from the recording.
//
// Thread: any; a job belongs to one.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "app/cli/sweep/sweep_row.h"
#include "app/session/setup/scene.h"
#include "haptics/control/passivity.h"
#include "scenarios/scoring/validity/construct_validity.h"

namespace trocar {

/// What is swept over.
struct SweepPlan {
  std::vector<std::string> exercises;  ///< ids, numbers or files; empty: the whole catalogue
  /// Hands; NAME#A..B stands for the persons A to B of a population.
  std::vector<std::string> hands{"expert", "intermediate", "novice", "clumsy", "speed-runner", "heavy-handed", "idle"};
  std::vector<std::string> levels;  ///< empty: every level of the exercise
  std::string seeds = "1..10";      ///< A..B
  std::string boards;               ///< A..B, of practice or unseen, each with each seed; empty: drawn by the seed
  std::vector<std::string> arms{"drawn"};  ///< the seed's own, or worse ones (kSweepArms)
  std::string organ = "phantom-liver";
  std::string tissue;  ///< one of kTissueWords; empty: the exercise's
};

/// What an attempt's simulated arm is made of: the one that its seed draws, or worse.
struct SweepArm {
  const char* name;
  double friction = 1;  ///< times the drawn one, Coulomb and viscous
  double current = 1;   ///< of what the motors' largest torque needs
  PassivityLaw law = PassivityLaw::kBudgeted;
};
inline constexpr std::array<SweepArm, 5> kSweepArms{{{"drawn"},
                                                     {"friction", 2},
                                                     {"saturation", 1, 0.5},
                                                     {"increment", 1, 1, PassivityLaw::kIncrement},
                                                     {"degraded", 2, 0.5, PassivityLaw::kIncrement}}};

/// One attempt of the sweep and, once it was run, what became of it.
struct SweepJob {
  std::string given, given_hand, given_organ;  ///< exercise, hand and organ as they were asked for
  const SweepArm* arm = &kSweepArms[0];
  ValidityScope scope;
  std::shared_ptr<const std::string> ruleset;  ///< bytes of the exercise's file
  SweepRow row;                                ///< without grade and fault before it was run
};

/// Of an attempt that stopped: because the arm went too fast?
bool too_fast(const std::string& fault);

/// In the order exercise, level, arm, hand, board, seed. @throws InputError: a name, a level, a range that there is
/// not.
std::vector<SweepJob> list_jobs(const SweepPlan& plan, const AssetRoots& assets);

/// Fills in grade and fault. @param interrupted asked during the run. @returns false when it was stopped by that.
bool run_job(SweepJob& job, const AssetRoots& assets, const std::function<bool()>& interrupted);

/// First and last of "A..B" or "A". @param option "--seeds", for messages. @throws InputError.
std::pair<std::int64_t, std::int64_t> parse_range(const std::string& option, const std::string& text);

}  // namespace trocar
