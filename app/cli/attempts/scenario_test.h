// A scripted attempt and what must come of it, as a file says: docs/scenario_language.md.
//
// Read strictly, with line and column of what is wrong; names of events, metrics, sub-scores and statuses must be
// known, so that a misspelled expectation is no silent pass.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/attempts/run_command.h"
#include "scenarios/scoring/attempt_result.h"

namespace trocar {

/// Both ends belong to it.
struct Range {
  double low = 0, high = 0;
  bool has(double value) const { return value >= low && value <= high; }
};

struct ExpectedEvent {
  std::string type;
  Range count;
  std::optional<Range> first_s;  ///< of the first one, since START
};
struct ExpectedValue {
  std::string name;  ///< of a metric or a sub-score
  Range between;
};

struct ScenarioTest {
  std::string name;
  std::filesystem::path file;
  RunOptions run;
  std::optional<std::string> status, fault;  ///< fault: its cause, "none" for none
  std::optional<bool> passed;
  std::optional<Range> score, caps;
  std::vector<ExpectedEvent> events;
  std::vector<ExpectedValue> metrics, subscores;
};

/// Files that it names are looked for beside it. @throws InputError "FILE:LINE:COLUMN: message"
ScenarioTest read_scenario_test(const std::filesystem::path& file, const AssetRoots& assets);

/// What came otherwise, a line each; empty: all as expected.
std::vector<std::string> unmet(const ScenarioTest& test, const AttemptResult& result);

}  // namespace trocar
