// `trocar sweep`: many scripted attempts, and whether the score tells skill apart.
//
// Every attempt runs in lockstep and in memory: the same sweep gives the same bytes whatever the number of jobs. With a
// folder each attempt is kept there as soon as it is over, and what is there is not run again. Thread: starts `jobs`
// threads, each with attempts of its own.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "app/cli/sweep/sweep_jobs.h"

namespace trocar {

struct SweepOptions {
  SweepPlan plan;
  std::filesystem::path out;  ///< folder of the rows (sweep_folder.h); empty: nothing is stored
  std::string part;           ///< "3/8": of eight jobs the third; empty: all of it
  int list_jobs = 0;          ///< run nothing, list so many jobs; 0: run
  int jobs = 0;               ///< attempts at once; 0: one a processor
  bool json = false;
};

/// @return 0 when every check of scenarios/scoring/validity/construct_validity.h is met, else 1; of one part, and of a
/// list of jobs, 0. @throws InputError. EnvironmentError when it was interrupted: the folder keeps what is over.
int sweep_command(const SweepOptions& options, std::ostream& out, std::ostream& err);

struct SweepMergeOptions {
  std::vector<std::filesystem::path> from;
  std::filesystem::path out;  ///< empty: the only one of `from`
};
/// All rows of all folders into attempts.jsonl of one, sorted: again and again the same bytes. @throws InputError.
int sweep_merge(const SweepMergeOptions& options, std::ostream& out, std::ostream& err);

/// report.html, table.csv and validity.json of a folder. @return 0 when every check is met, else 1. @throws InputError.
int sweep_report(const std::filesystem::path& folder, std::ostream& out, std::ostream& err);

}  // namespace trocar
