// A programme: a sequence of steps, each an exercise at a level with the rule that passes it. And how far somebody is
// with a step, from the attempts and the clock that is given.
//
// Kept as TOML in a curriculum of its name, [[step]] after [[step]]; the desk's form reads and writes the same text.
//
//   exercise = "surface-touch", level = "L1"   needed
//   passes = 3         so often the pass mark reached, or a person's "passed" (1..100, default 1)
//   in_a_row = true    ... one after the other on as many boards, as levels open (unlock.h)
//   days = 2           ... on so many different days, UTC (1..100, default 1)
//   sign_off = true    and an instructor's certificate of exercise and level
//   due_days = 30      deadline of its own, days after the programme was given (1..3660)
//   input = "device"   attempts with this input alone count; without it those of every input of a person
//   (kPersonsInputs)
//
// Pure: no clock is read. Thread: any.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace trocar {

struct ProgrammeStep {
  std::string exercise_id = {}, level = {};
  int passes = 1;
  bool in_a_row = false;
  int days = 1;
  bool sign_off = false;
  int due_days = 0;        ///< 0: no deadline of its own
  std::string input = {};  ///< "": any
  bool operator==(const ProgrammeStep&) const = default;
};

inline constexpr std::size_t kMostSteps = 60;

/// What people hold, and the invented ones of a demo; whatever else stands as an attempt's hand is a script, whose
/// attempts are demonstrations and nobody's passes.
inline constexpr const char* kPersonsInputs[] = {"mouse", "keyboard", "gamepad", "spacemouse", "device", "invented"};

struct Programme {
  std::vector<ProgrammeStep> steps = {};
};

/// @param name for messages. @throws InputError with line and column: an unknown key, a value that means nothing, no
/// step, one step twice.
Programme read_programme(const std::string& toml, const std::string& name);
/// The same back; what has its default is left out.
std::string programme_toml(const Programme& programme);
/// Levels of each exercise that there is; none of an exercise: any.
using KnownLevels = std::map<std::string, std::vector<std::string>>;
/// @throws InputError naming the step: an exercise or a level that there is not.
void require_known(const Programme& programme, const std::string& name, const KnownLevels& known);
/// Whether a text has steps, readable or not: it is a programme's and no rules of progress.
bool is_programme(const std::string& toml);

/// "3 passes in a row, on 2 days, signed off".
std::string rule_words(const ProgrammeStep& step);

/// An attempt as a step sees it.
struct StepAttempt {
  std::int64_t row = 0;
  std::int64_t started_s = 0;  ///< since 1970
  bool passed = false;         ///< as it counts (trainees/records/verdicts.h)
  bool begun = true;           ///< its clock had started
};

struct StepProgress {
  int attempts = 0, passes = 0;
  int best_row = 0;  ///< boards of the longest row of passes; only where the rule asks for one
  int days = 0;      ///< with a pass
  std::optional<std::int64_t> reached_s = {};  ///< start of the attempt that fulfilled the rule
  std::int64_t last_row = 0;                   ///< newest attempt, 0 without
};

/// @param attempts of one trainee at the step, oldest first. @param board_of by the attempt's row; asked only where the
/// rule is for passes in a row.
StepProgress progress_of(const ProgrammeStep& step, const std::vector<StepAttempt>& attempts,
                         const std::function<int(std::int64_t row)>& board_of);
/// "2 of 3 passes", "1 of 2 days": what is still missing of the rule; "" when nothing is.
std::string missing_words(const ProgrammeStep& step, const StepProgress& progress);

enum class StepState : std::uint8_t {
  kOverdue,     ///< the deadline is over and the rule not fulfilled
  kNotStarted,  ///< no attempt
  kLearning,    ///< attempts, rule not fulfilled
  kToSign,      ///< fulfilled, but for the certificate that the step asks for
  kPassed,
  kCertified,  ///< an instructor's certificate of exercise and level is held, whatever the attempts say
};
inline constexpr StepState kStepStates[] = {StepState::kOverdue, StepState::kNotStarted, StepState::kLearning,
                                            StepState::kToSign,  StepState::kPassed,     StepState::kCertified};
const char* step_state_key(StepState state);    ///< "not-started": in addresses and files
const char* step_state_words(StepState state);  ///< "not started"
std::optional<StepState> step_state_keyed(const std::string& key);

/// @param due_s first second that is too late, since 1970; nothing: no deadline.
StepState state_of(const ProgrammeStep& step, const StepProgress& progress, bool certified,
                   std::optional<std::int64_t> due_s, std::int64_t now_s);

/// First second after the day "2026-06-30". @throws InputError: no day of the calendar.
std::int64_t end_of_day(const std::string& day);

/// Deadline of a step: the earlier of the assignment's own and of the step's days, which count from when the programme
/// was given to that person. @param due day, "" for none. @param given_s since 1970.
std::optional<std::int64_t> step_due(const ProgrammeStep& step, const std::string& due, std::int64_t given_s);

}  // namespace trocar
