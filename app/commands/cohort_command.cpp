#include "app/commands/cohort_command.h"

#include <ostream>

#include "app/commands/open_database.h"
#include "app/commands/store_json.h"
#include "app/commands/text_table.h"

namespace trocar {

int cohort_command(const CohortOptions& options, std::ostream& out, std::ostream& err) {
  using Align = TextTable::Align;
  Database database = open_database(options.database, OpenMode::kExisting, err);
  const std::vector<CohortRow> rows = cohort(database, options.trainee);
  if (options.json) {
    out << cohort_json(rows);
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
                   {"last (UTC)"}});
  for (const CohortRow& row : rows) {
    table.add({row.trainee, row.exercise_id, cell_rubric(row.exercise_version, row.rubric_sha256), row.level, std::to_string(row.attempts), std::to_string(row.graded),
               std::to_string(row.passes), cell(row.best, 1), cell(row.last, 1), cell(row.mean_peak_force_n, 2),
               cell(row.mean_time_s, 1), cell_time(row.last_utc)});
  }
  table.print(out);
  return 0;
}

}  // namespace trocar
