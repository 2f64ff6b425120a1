#include "trainees/desk/queries/programme_query.h"

#include <algorithm>
#include <map>

#include "haptics/input_error.h"
#include "trainees/desk/queries/desk_rows.h"
#include "trainees/progress/calendar.h"
#include "trainees/records/standings.h"
#include "trainees/records/verdicts.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar {
namespace {

/// Of a step, in the order of the trainee's attempts; whether its score passed as the last column.
std::string step_rows(bool of_one) {
  std::string persons;
  for (const char* input : kPersonsInputs) persons += (persons.empty() ? "'" : ", '") + std::string(input) + "'";
  return "SELECT a.trainee_id, a.id, a.status IN ('fault', 'void'), a.started_utc, " + std::string(sql::kBegun) + ", " +
         (of_one ? "(SELECT passed FROM score WHERE attempt_id = a.id AND revision = 0)" : "0") +
         " FROM attempt a INDEXED BY " + (of_one ? "attempt_by_trainee" : "attempt_by_curve") +
         " WHERE a.exercise_id = ?1 AND a.level = ?2 AND a.status <> 'running' AND CASE ?3 WHEN '' THEN a.hand IN (" +
         persons + ") ELSE a.hand = ?3 END" + (of_one ? " AND a.trainee_id = ?4 ORDER BY a.id" : "");
}

/// Attempts that pass as they count: by the score, and by people where they decided.
class PassedAttempts {
 public:
  PassedAttempts(const Database& database, bool of_one) : decided_(newest_decisions(database)) {
    if (of_one) return;  // its rows bring it along
    sql::Statement rows(database.connection(),
                        "SELECT attempt_id FROM score INDEXED BY score_first WHERE revision = 0 AND passed = 1");
    while (rows.step()) {
      const auto at = static_cast<std::size_t>(rows.integer(0));
      if (at >= by_score_.size()) by_score_.resize(std::max(at + 1, 2 * by_score_.size()));
      by_score_[at] = true;
    }
  }
  bool counts(const sql::Statement& row) const {
    const std::int64_t attempt = row.integer(1);
    const auto at = static_cast<std::size_t>(attempt);
    const auto decision = decided_.find(attempt);
    return judged_passed(row.integer(2) != 0, row.integer(5) != 0 || (at < by_score_.size() && by_score_[at]),
                         decision == decided_.end() ? std::nullopt : std::optional(decision->second));
  }

 private:
  std::map<std::int64_t, bool> decided_;
  std::vector<bool> by_score_ = {};
};

/// To whom the programme is assigned, and by which assignment.
class Assigned {
 public:
  Assigned(Database& database, const std::string& programme) : connection_(database.connection()) {
    for (const Assignment& one : ProgrammeStore(database).assignments()) {
      if (one.programme != programme || !one.withdrawn_utc.empty()) continue;
      if (one.group.empty())
        to_people_.emplace(one.trainee, one);
      else
        to_groups_.push_back(one);  // newest first
    }
  }
  /// Nothing: the programme is not assigned to them.
  const Assignment* of(const desk::Person& person) const {
    if (const auto own = to_people_.find(person.code); own != to_people_.end()) return &own->second;
    for (const Assignment& one : to_groups_)
      if (std::find(person.groups.begin(), person.groups.end(), one.group) != person.groups.end()) return &one;
    return nullptr;
  }
  /// When it was given to that person: those who joined the group later, then.
  std::int64_t given_s(const Assignment& assignment, std::int64_t trainee) const {
    const std::int64_t given = seconds_of_utc(assignment.utc).value_or(0);
    if (assignment.group.empty()) return given;
    sql::Statement joined(connection_,
                          "SELECT utc FROM audit WHERE subject = (SELECT uuid FROM trainee WHERE id = ?) AND detail = ?"
                          " AND action IN ('group joined', 'group joined elsewhere') ORDER BY position DESC LIMIT 1");
    if (!joined.bind(trainee).bind(assignment.group).step()) return given;
    return std::max(given, seconds_of_utc(joined.view(0)).value_or(0));
  }

 private:
  sqlite3* connection_;
  std::map<std::string, Assignment> to_people_ = {};
  std::vector<Assignment> to_groups_ = {};
};

bool same_code(const std::string& a, const std::string& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) {
    return std::tolower(static_cast<unsigned char>(x)) == std::tolower(static_cast<unsigned char>(y));
  });
}

class GridMaker {
 public:
  GridMaker(Database& database, const std::string& programme, const GridFilter& filter, const std::string& now_utc)
      : database_(database), connection_(database.connection()), filter_(filter) {
    const auto now = seconds_of_utc(now_utc);
    if (!now) throw InputError("clock: \"" + now_utc + "\" is no time");
    now_s_ = *now;
    out_.name = programme;
    out_.programme = ProgrammeStore(database).find(programme);
    choose_people();
  }

  ProgrammeGrid made() {
    if (out_.lines.empty()) return std::move(out_);
    const bool of_one = !filter_.trainee.empty();
    const PassedAttempts passed(database_, of_one);
    sql::Statement rows(connection_, step_rows(of_one));
    for (std::size_t step = 0; step < out_.programme.steps.size(); ++step) fill(step, rows, passed);
    std::sort(out_.lines.begin(), out_.lines.end(),
              [](const ProgrammeLine& a, const ProgrammeLine& b) { return a.code < b.code; });
    return std::move(out_);
  }

 private:
  void choose_people() {
    const Assigned assigned(database_, out_.name);
    const std::set<std::int64_t> away = deactivated(connection_), erased = desk::training_erased(connection_);
    const auto& steps = out_.programme.steps;
    const bool own_days =
        std::any_of(steps.begin(), steps.end(), [](const ProgrammeStep& step) { return step.due_days > 0; });
    for (const auto& [id, person] : desk::people(connection_)) {
      const bool active = !away.contains(id);
      if (erased.contains(id) || !wanted(person, active)) continue;
      const Assignment* by = assigned.of(person);
      if (by == nullptr) continue;
      const std::int64_t given_s = own_days ? assigned.given_s(*by, id) : 0;
      ProgrammeLine line{person.code, person.name, person.groups, active, by->group, by->due, {}};
      for (const ProgrammeStep& step : steps) line.cells.push_back({{}, {}, step_due(step, by->due, given_s)});
      line_of_.emplace(id, out_.lines.size());
      ids_.push_back(id);
      out_.lines.push_back(std::move(line));
    }
  }

  bool wanted(const desk::Person& person, bool active) const {
    if (!filter_.trainee.empty()) return same_code(person.code, filter_.trainee);
    if (!active && !filter_.deactivated) return false;
    return filter_.group.empty() ||
           std::find(person.groups.begin(), person.groups.end(), filter_.group) != person.groups.end();
  }

  void fill(std::size_t at, sql::Statement& rows, const PassedAttempts& passed) {
    const ProgrammeStep& step = out_.programme.steps[at];
    std::vector<std::vector<StepAttempt>> attempts(out_.lines.size());
    rows.bind(step.exercise_id).bind(step.level).bind(step.input);
    if (!filter_.trainee.empty()) rows.bind(ids_.front());
    std::int64_t trainee = 0;
    std::vector<StepAttempt>* own = nullptr;
    while (rows.step()) {
      if (rows.integer(0) != trainee) {
        trainee = rows.integer(0);
        const auto line = line_of_.find(trainee);
        own = line == line_of_.end() ? nullptr : &attempts[line->second];
      }
      if (own == nullptr) continue;
      const bool passes = passed.counts(rows);
      own->push_back(
          {rows.integer(1), passes ? seconds_of_utc(rows.view(3)).value_or(0) : 0, passes, rows.integer(4) != 0});
    }
    rows.run();
    sql::Statement board(connection_, "SELECT board FROM attempt WHERE id = ?");
    const auto board_of = [&](std::int64_t row) {
      board.bind(row).step();
      const int found = static_cast<int>(board.integer(0));
      board.run();
      return found;
    };
    for (std::size_t i = 0; i < out_.lines.size(); ++i) {
      // The index has a person's attempts by input and rubric.
      std::sort(attempts[i].begin(), attempts[i].end(),
                [](const StepAttempt& a, const StepAttempt& b) { return a.row < b.row; });
      ProgrammeCell& cell = out_.lines[i].cells[at];
      cell.progress = progress_of(step, attempts[i], board_of);
      const auto held = certificates_.find({ids_[i], step.exercise_id, step.level});
      const bool certified = held != certificates_.end() && held->second.in_question.empty();
      cell.state = state_of(step, cell.progress, certified, cell.due_s, now_s_);
    }
  }

  Database& database_;
  sqlite3* connection_;
  const GridFilter& filter_;
  std::int64_t now_s_ = 0;
  ProgrammeGrid out_ = {};
  std::map<std::int64_t, std::size_t> line_of_ = {};
  std::vector<std::int64_t> ids_ = {};  ///< of the lines, while they are filled
  std::map<desk::CertifiedSkill, desk::HeldCertificate> certificates_ = desk::certificates_held(database_);
};

Reminder reminder_of(const ProgrammeGrid& grid, const ProgrammeLine& line, std::size_t at, std::int64_t now_s) {
  const ProgrammeCell& cell = line.cells[at];
  const ProgrammeStep& step = grid.programme.steps[at];
  Reminder out{
      line.code, line.name, grid.name, line.groups, step, "", 0, cell.state, missing_words(step, cell.progress)};
  if (!cell.due_s) return out;
  out.due = due_day(*cell.due_s);
  out.days = static_cast<int>((*cell.due_s - 1) / kSecondsADay - now_s / kSecondsADay);
  return out;
}

bool to_do(const ProgrammeCell& cell) {
  return cell.state == StepState::kOverdue || cell.state == StepState::kNotStarted ||
         cell.state == StepState::kLearning;
}

}  // namespace

ProgrammeGrid programme_grid(Database& database, const std::string& programme, const GridFilter& filter,
                             const std::string& now_utc) {
  sql::execute(database.connection(), "PRAGMA cache_size = -65536");  // as cohort_lines()
  const sql::ReadSnapshot snapshot(database.connection());
  return GridMaker(database, programme, filter, now_utc).made();
}

std::vector<Reminder> reminders(Database& database, const std::string& programme, const std::string& group, int days,
                                const std::string& now_utc) {
  std::vector<Reminder> out;
  const std::int64_t now_s = seconds_of_utc(now_utc).value_or(0);
  for (const KeptProgramme& kept : ProgrammeStore(database).list()) {
    if (!kept.problem.empty() || (!programme.empty() && kept.text.name != programme)) continue;
    const ProgrammeGrid grid = programme_grid(database, kept.text.name, {group, "", false}, now_utc);
    for (const ProgrammeLine& line : grid.lines) {
      for (std::size_t at = 0; at < line.cells.size(); ++at) {
        if (!to_do(line.cells[at]) || !line.cells[at].due_s) continue;
        Reminder one = reminder_of(grid, line, at, now_s);
        if (one.days <= days) out.push_back(std::move(one));
      }
    }
  }
  std::stable_sort(out.begin(), out.end(), [](const Reminder& a, const Reminder& b) {
    return std::tie(a.days, a.code) < std::tie(b.days, b.code);
  });
  return out;
}

std::vector<Reminder> next_steps(Database& database, const std::string& trainee, const std::string& now_utc) {
  std::vector<Reminder> out, undated;
  const std::int64_t now_s = seconds_of_utc(now_utc).value_or(0);
  for (const KeptProgramme& kept : ProgrammeStore(database).list()) {
    if (!kept.problem.empty()) continue;
    const ProgrammeGrid grid = programme_grid(database, kept.text.name, {"", trainee, true}, now_utc);
    bool first = true;
    for (const ProgrammeLine& line : grid.lines) {
      for (std::size_t at = 0; at < line.cells.size(); ++at) {
        if (!to_do(line.cells[at])) continue;
        if (line.cells[at].due_s)
          out.push_back(reminder_of(grid, line, at, now_s));
        else if (first)
          undated.push_back(reminder_of(grid, line, at, now_s));
        first = false;
      }
    }
  }
  std::stable_sort(out.begin(), out.end(), [](const Reminder& a, const Reminder& b) { return a.days < b.days; });
  out.insert(out.end(), undated.begin(), undated.end());
  return out;
}

std::string due_day(std::int64_t due_s) { return utc_of_seconds(due_s - 1).substr(0, 10); }

}  // namespace trocar
