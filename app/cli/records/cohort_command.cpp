#include "app/cli/records/cohort_command.h"

#include <algorithm>
#include <iostream>
#include <memory>

#include <CLI/CLI.hpp>

#include "app/cli/command.h"
#include "app/cli/records/open_database.h"
#include "app/cli/records/store_json.h"
#include "app/cli/text_table.h"
#include "trainees/records/attempt_identity.h"

namespace trocar {
namespace {

/// Gravest first, each once; "-" where nothing but learning is to be said.
std::string cell_flags(const CohortRow& row, const std::vector<CohortLine>& lines) {
  std::vector<Flag> flags;
  for (const CohortLine& line : lines)
    if (of_row(line, row))
      for (const Judgement& j : line.judgements)
        if (j.flag != Flag::kLearning) flags.push_back(j.flag);
  std::sort(flags.begin(), flags.end());
  flags.erase(std::unique(flags.begin(), flags.end()), flags.end());
  std::string out;
  for (const Flag flag : flags) out += (out.empty() ? "" : ", ") + std::string(flag_name(flag));
  return out.empty() ? "-" : out;
}

}  // namespace

ProgressRules rules_told(Database& database, std::ostream& err) {
  ProgressRules rules = rules_in_force(database);
  if (!rules.unread.empty()) err << "trocar: " << rules.unread << "; the rules before them are in force\n";
  return rules;
}

int cohort_command(const CohortOptions& options, std::ostream& out, std::ostream& err) {
  using Align = TextTable::Align;
  Database database = open_database(options.database, OpenMode::kExisting, err);
  const std::vector<CohortRow> rows = cohort(database, options.trainee, options.deactivated);
  CohortFilter filter;
  filter.trainee = options.trainee;
  filter.deactivated = options.deactivated;
  const std::vector<CohortLine> lines = cohort_lines(database, rules_told(database, err), filter, utc_now());
  if (options.json) {
    out << cohort_json(rows, lines);
    return 0;
  }
  TextTable table({{"trainee"},
                   {"exercise"},
                   {"rubric"},
                   {"level"},
                   {"attempts", Align::kRight},
                   {"graded", Align::kRight},
                   {"passes", Align::kRight},
                   {"best", Align::kRight},
                   {"last", Align::kRight},
                   {"mean peak N", Align::kRight},
                   {"mean time s", Align::kRight},
                   {"last (UTC)"},
                   {"flags"}});
  for (const CohortRow& row : rows) {
    table.add({row.trainee, row.exercise_id, cell_rubric(row.exercise_version, row.rubric_sha256), row.level,
               std::to_string(row.attempts), std::to_string(row.graded), std::to_string(row.passes), cell(row.best, 1),
               cell(row.last, 1), cell(row.mean_peak_force_n, 2), cell(row.mean_time_s, 1), cell_time(row.last_utc),
               cell_flags(row, lines)});
  }
  table.print(out);
  if (const int erased = people_erased(database); erased > 0) err << erased << " erased and left out\n";
  return 0;
}

void add_cohort(CLI::App& parent, CommandAction& chosen) {
  const auto given = std::make_shared<CohortOptions>();
  CohortOptions& o = *given;
  CLI::App* cohort = add_command(parent, "cohort", "Who tried what, how often, how well", chosen,
                                 [given] { return cohort_command(*given, std::cout, std::cerr); });
  cohort->add_option("--db", o.database, "Database file");
  cohort->add_option("--trainee", o.trainee, "One trainee only");
  cohort->add_flag("--deactivated", o.deactivated, "People who are deactivated, too");
  cohort->add_flag("--json", o.json, "As JSON");
}

}  // namespace trocar
