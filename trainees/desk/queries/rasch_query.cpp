// Abilities and difficulties over the whole database; an item is exercise, level and input.
#include <algorithm>

#include "trainees/desk/queries/desk_queries.h"
#include "trainees/records/verdicts.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar {
namespace {

using Item = std::tuple<std::string, std::string, std::string>;  ///< exercise, level, input

std::string name_of(const Item& item) {
  return std::get<0>(item) + '\n' + std::get<1>(item) + '\n' + std::get<2>(item);
}

constexpr const char* kCells =
    "SELECT a.trainee_id, a.exercise_id, a.level, a.hand, count(*), sum(coalesce(s.passed, 0)) FROM attempt a INDEXED "
    "BY attempt_by_curve"
    " LEFT JOIN score s INDEXED BY score_first ON s.attempt_id = a.id AND s.revision = 0"
    " WHERE a.status IN ('completed', 'timeout', 'aborted') AND a.trainee_id NOT IN (SELECT trainee_id FROM erasure "
    "WHERE kind = 'training' AND row_holds('erasure', id))"
    " GROUP BY a.exercise_id, a.level, a.hand,"
    " substr(a.ruleset_sha256, 1, 16), a.trainee_id";

/// Few attempts have a decision, so what they change is added afterwards: 10^5 attempts are not each asked for theirs.
std::string corrections() {
  return std::string("SELECT a.trainee_id, a.exercise_id, a.level, a.hand, 0, ") + sql::kPassed +
         " - coalesce(s.passed, 0) FROM attempt a LEFT JOIN score s ON s.attempt_id = a.id AND s.revision = 0" +
         sql::decision() +
         " WHERE a.id IN (SELECT attempt_id FROM verdict_override) AND a.status IN ('completed', 'timeout', 'aborted')";
}

struct Cells {
  std::map<std::pair<std::string, Item>, RaschCell> all = {};
  int attempts = 0;

  void add(sqlite3* connection, const std::string& query) {
    sql::Statement rows(connection, query);
    while (rows.step()) {
      const Item item{rows.text(1), rows.text(2), rows.text(3)};
      RaschCell& cell =
          all.try_emplace({rows.text(0), item}, RaschCell{rows.text(0), name_of(item), 0, 0}).first->second;
      cell.tries += static_cast<int>(rows.integer(4));
      cell.passes += static_cast<int>(rows.integer(5));
      attempts += static_cast<int>(rows.integer(4));
    }
  }
};

void add_items(const Cells& cells, const RaschFit& fit, const ProgressRules& rules, RaschReport& report) {
  std::map<std::string, Item> items;
  for (const auto& [key, cell] : cells.all) items[cell.item] = key.second;
  for (const RaschEstimate& estimate : fit.items) {
    const auto& [exercise, level, hand] = items[estimate.name];
    if (estimate.standard_error < rules.rasch_largest_se) report.items.push_back({exercise, level, hand, estimate});
  }
  std::stable_sort(report.items.begin(), report.items.end(),
                   [](const RaschItem& a, const RaschItem& b) { return a.estimate.logit < b.estimate.logit; });
}

}  // namespace

RaschReport rasch_report(Database& database, const ProgressRules& rules) {
  Cells cells;
  cells.add(database.connection(), kCells);
  cells.add(database.connection(), corrections());
  RaschReport out;
  out.attempts = cells.attempts;
  if (out.attempts < rules.rasch_least_attempts) {
    out.missing = "There are " + std::to_string(out.attempts) + " of the " +
                  std::to_string(rules.rasch_least_attempts) + " attempts that an estimate asks for.";
    return out;
  }
  std::vector<RaschCell> all;
  for (const auto& [key, cell] : cells.all) all.push_back(cell);
  const auto fit = fit_rasch(all);
  if (!fit) {
    out.missing = "Nobody can be compared yet: trainees must have passed and failed the same exercises.";
    return out;
  }
  for (const RaschEstimate& estimate : fit->trainees) out.abilities[estimate.name] = estimate;
  out.set_aside = fit->set_aside;
  add_items(cells, *fit, rules, out);
  return out;
}

}  // namespace trocar
