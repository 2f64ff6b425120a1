// One attempt of a sweep as it is kept: which one it was, what became of it, and all that another rubric needs.
//
// A row is one line of JSON. Same attempt, same bytes: no time of day, no machine, numbers to the bit. Thread: any.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <tuple>

#include "scenarios/scoring/attempt_result.h"
#include "scenarios/scoring/rubric.h"

namespace trocar {

/// Which attempt: a sweep has one row of each.
struct SweepKey {
  std::string exercise;  ///< id
  std::string level, arm, hand, organ, tissue;
  int board = 0;
  std::int64_t seed = 0;
  bool operator==(const SweepKey&) const = default;
  auto operator<=>(const SweepKey&) const = default;
};

/// "reach-and-orient L2, hand expert, arm drawn, organ phantom-liver (still), board 3, seed 4".
std::string key_words(const SweepKey& key);

struct SweepRow {
  SweepKey key;
  std::string number;            ///< of the exercise, "E01"
  std::string exercise_version;  ///< as its file says
  std::string rubric_sha256;     ///< of the exercise's file: the ruleset
  std::string hand_sha256;       ///< of the hand's scripts
  std::string program;           ///< version
  std::optional<double> skill;   ///< latent, of a person of a population
  Grade grade;  ///< read back from a line: sub-scores have names and values only, metrics the units of this program
  std::string fault;  ///< of the device, empty when none
};

/// Without the end of line.
std::string row_line(const SweepRow& row);

/// @param where "FILE:LINE", for messages. @throws InputError: no row.
SweepRow parse_row(const std::string& line, const std::string& where);

/// Makes the grade again by the ruleset, sub-scores whole. @throws InputError: another score or verdict stands there.
void check_row(SweepRow& row, const Rubric& rubric, const std::string& where);

}  // namespace trocar
