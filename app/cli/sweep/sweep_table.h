// What `trocar sweep` prints: outcomes by hand and the orderings that they must show, as a table or as JSON.
#pragma once

#include <iosfwd>
#include <map>
#include <string>
#include <vector>

#include "app/cli/sweep/sweep_jobs.h"

namespace trocar {

/// One exercise at one level on one kind of arm: outcomes by hand, and the checks over them. Persons of a population
/// count as one hand.
struct SweepCell {
  const SweepArm* arm = nullptr;
  std::string exercise, level;  ///< the exercise as it was asked for
  ValidityScope scope;
  std::vector<std::string> hands;  ///< as they were asked for
  std::map<std::string, HandOutcomes> outcomes;
  std::map<std::string, std::map<std::string, int>> caps;  ///< by hand: sentence and how often
  std::vector<SweepRow> without_number;
  std::vector<ValidityCheck> checks;
};

/// @param jobs that were run, those of a cell behind each other.
std::vector<SweepCell> collect_cells(const std::vector<SweepJob>& jobs);

/// Whether every check of every cell is met.
bool all_met(const std::vector<SweepCell>& cells);

/// A list of {"name","value","bar","met"}; value and bar null and "not_asked" besides where it does not apply.
std::string checks_json(const std::vector<ValidityCheck>& checks);

void print_cells(const std::vector<SweepCell>& cells, std::ostream& out);
std::string cells_json(const std::vector<SweepCell>& cells, const std::string& seeds);

}  // namespace trocar
