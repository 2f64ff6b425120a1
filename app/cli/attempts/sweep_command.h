// `trocar sweep`: many scripted attempts, and whether the score tells skill apart.
//
// Every attempt runs in lockstep and in memory: nothing is stored, the same sweep gives the same bytes whatever the
// number of jobs. Thread: starts `jobs` threads, each with attempts of its own.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

namespace trocar {

struct SweepOptions {
  std::vector<std::string> exercises;  ///< ids, numbers or files; empty: the whole catalogue
  std::vector<std::string> hands{"expert", "intermediate", "novice", "clumsy", "speed-runner", "heavy-handed", "idle"};
  std::vector<std::string> levels;         ///< empty: every level of the exercise
  std::string seeds = "1..10";             ///< A..B
  std::vector<std::string> arms{"drawn"};  ///< the seed's own, or worse ones (kArms in sweep_command.cpp)
  std::string organ = "phantom-liver";
  std::string tissue;  ///< one of kTissueWords; empty: the exercise's
  int jobs = 0;        ///< 0: one a processor
  bool json = false;
};

/// @return 0 when every check of scenarios/scoring/construct_validity.h is met, else 1. @throws InputError.
int sweep_command(const SweepOptions& options, std::ostream& out, std::ostream& err);

/// First and last seed of "A..B" or "A". @throws InputError.
std::pair<std::int64_t, std::int64_t> parse_seeds(const std::string& text);

}  // namespace trocar
