// Who stands where in a programme: people by steps, from the attempts as they stand; nothing is stored.
//
// With 10^5 attempts of 500 people the grid takes under 100 ms of CPU (tests/bench/desk_bench.cpp). Thread: the
// Database's.
#pragma once

#include <string>
#include <vector>

#include "trainees/records/programmes.h"

namespace trocar {

struct ProgrammeCell {
  StepState state = StepState::kNotStarted;
  StepProgress progress = {};
  std::optional<std::int64_t> due_s = {};  ///< first second that is too late, since 1970
};

/// One person to whom the programme is assigned.
struct ProgrammeLine {
  std::string code = {}, name = {};
  std::vector<std::string> groups = {};
  bool active = true;
  std::string through = {};               ///< group that it is assigned to; "" where to the person
  std::string due = {};                   ///< day of that assignment, "" none
  std::vector<ProgrammeCell> cells = {};  ///< as the steps
};

struct ProgrammeGrid {
  std::string name = {};
  Programme programme = {};
  std::vector<ProgrammeLine> lines = {};  ///< by code
};

/// Empty fields do not filter.
struct GridFilter {
  std::string group = {}, trainee = {};
  bool deactivated = false;  ///< those too; of one trainee always
};

/// @param now_utc the clock for deadlines. @throws InputError: no such programme, or its text cannot be read.
ProgrammeGrid programme_grid(Database& database, const std::string& programme, const GridFilter& filter,
                             const std::string& now_utc);

/// A step that somebody has yet to do, with its deadline.
struct Reminder {
  std::string code = {}, name = {}, programme = {};
  std::vector<std::string> groups = {};
  ProgrammeStep step = {};
  std::string due = {};  ///< last day, "2026-06-30"
  int days = 0;          ///< from the given day to that one; negative: so many days late
  StepState state = StepState::kNotStarted;
  std::string missing = {};  ///< "1 of 3 passes"
};

/// What is overdue or due within so many days, the latest first. @param programme, group "" for all.
std::vector<Reminder> reminders(Database& database, const std::string& programme, const std::string& group, int days,
                                const std::string& now_utc);

/// The same of one person, over all programmes, without a limit of days; steps without a deadline come last, of each
/// programme only the first one.
std::vector<Reminder> next_steps(Database& database, const std::string& trainee, const std::string& now_utc);

/// Last day of a deadline, "2026-06-30".
std::string due_day(std::int64_t due_s);

}  // namespace trocar
