// The keys of peg transfer: read as written, and every mistake refused at its line and column.
#include "scenarios/kinds/pegs/pegs_reader.h"

#include <gtest/gtest.h>

#include "scenarios/kinds/pegs/pegs_rules.h"
#include "tests/scenarios/support/bad_exercise.h"
#include "tests/scenarios/support/pegs_bench.h"

namespace trocar::pegs_reader_test {
namespace {

TEST(PegsReader, ReadsTheCatalogueGeometry) {
  const Exercise exercise = peg_transfer();
  const auto& rules = own_rules<PegsRules>(exercise);
  EXPECT_EQ(rules.rings(), 6);
  EXPECT_NEAR(rules.peg_radius_m, 0.0016, 1e-12);
  EXPECT_NEAR(rules.peg_height_m, 0.025, 1e-12);
  EXPECT_NEAR(rules.column_m, 0.015, 1e-12);
  EXPECT_NEAR(rules.row_m, 0.025, 1e-12);
  EXPECT_NEAR(rules.ring_side_m, 0.018, 1e-12);
  EXPECT_NEAR(rules.hole_radius_m, 0.0045, 1e-12);
  EXPECT_NEAR(rules.ring_height_m, 0.010, 1e-12);
  EXPECT_NEAR(rules.ring_mass_kg, 0.002, 1e-12);
  EXPECT_EQ(rules.slip_below_n, 1.2);
  EXPECT_EQ(rules.mark_above_n, 3.5);
  EXPECT_EQ(exercise.time_limit_s, 300);
  for (const ExerciseLevel& level : exercise.levels)
    EXPECT_NEAR(own_rules<PegsLevel>(level).place_tolerance_m, 0.002, 1e-12) << level.name;
}

TEST(PegsReader, RefusesWhatCannotBeLaidOut) {
  struct Refused {
    const char *from, *to, *message;
  };
  const Refused all[] = {
      {"hole_mm = 9", "hole_mm = 3", "the peg does not fit into 'hole_mm'"},
      {"hole_mm = 9", "hole_mm = 11", "'hole_mm' is wider than the ring"},
      {"mark_above_n = 3.5", "mark_above_n = 1.0", "'mark_above_n' must be above 'slip_below_n'"},
      {"hold_with_n = [1.4, 3.0]", "hold_with_n = [1.0, 3.0]", "between 'slip_below_n' and 'mark_above_n'"},
      {"rows = 3", "rows = 4", "the 'count' of [targets]"},
      {"columns = 2", "columns = 8", "at most"},
      {"lift_mm = 34", "lift_mm = 20", "'lift_mm' is lower than the pegs"},
      {"widest_gap_mm = 60", "widest_gap_mm = 50", "'widest_gap_mm' must not be below 'least_gap_mm'"},
      {"widest_gap_mm = 60", "widest_gap_mm = 150", "outside the board"},
      {"place_tolerance_mm = 2", "place_tolerance_mm = 4", "wider than the play"},
      {"pitch_mm = [15, 25]", "pitch_mm = 15", "pitch_mm"},
      {"diameter_mm = 3.2", "diameter = 3.2", "diameter_mm"},
  };
  for (const Refused& bad : all) {
    const std::string said = test::refusal(test::edited(peg_transfer().text, bad.from, bad.to));
    EXPECT_EQ(said.rfind("bad.toml:", 0), 0u) << bad.to << ": " << said;
    EXPECT_NE(said.find(bad.message), std::string::npos) << bad.to << ": " << said;
  }
}

TEST(PegsReader, NamesLineAndColumn) {
  const std::string text = test::edited(peg_transfer().text, "hole_mm = 9", "hole_mm = 3");
  const auto at = text.find("hole_mm = 3");
  const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
  EXPECT_EQ(test::refusal(text).rfind("bad.toml:" + std::to_string(line) + ":", 0), 0u);
}

}  // namespace
}  // namespace trocar::pegs_reader_test
