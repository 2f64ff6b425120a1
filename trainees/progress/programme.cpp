#include "trainees/progress/programme.h"

#include <algorithm>
#include <set>
#include <sstream>

#include <toml++/toml.h>

#include "haptics/input_error.h"
#include "haptics/toml_keys.h"
#include "trainees/progress/calendar.h"

namespace trocar {
namespace {

constexpr int kMostPasses = 100, kMostDays = 100, kLongestDue = 3660;
constexpr std::size_t kLongestWord = 64;

InputError step_error(const std::string& name, const toml::source_region& where, const std::string& what) {
  return InputError(name, static_cast<int>(where.begin.line), static_cast<int>(where.begin.column), what);
}

toml::table parsed_programme(const std::string& text, const std::string& name) {
  require_short_keys(text, name);
  try {
    return toml::parse(text, name);
  } catch (const toml::parse_error& error) {
    throw step_error(name, error.source(), std::string(error.description()));
  }
}

class StepReader {
 public:
  StepReader(const toml::table& table, const std::string& file) : table_(table), file_(file) {}

  std::string word(const char* key, bool needed) {
    const toml::node* node = asked(key);
    if (node == nullptr && needed) throw step_error(file_, table_.source(), std::string("missing key '") + key + "'");
    if (node == nullptr) return "";
    const auto text = node->value<std::string>();
    const bool fits = node->is_string() && !text->empty() && text->size() <= kLongestWord &&
                      std::none_of(text->begin(), text->end(),
                                   [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == '|'; });
    if (!fits)
      throw step_error(file_, node->source(), std::string("'") + key + "' must be a text of 1 to 64 characters");
    return *text;
  }

  int count(const char* key, int otherwise, int most) {
    const toml::node* node = asked(key);
    if (node == nullptr) return otherwise;
    const auto value = node->is_integer() ? node->value<std::int64_t>() : std::nullopt;
    if (!value || *value < 1 || *value > most)
      throw step_error(file_, node->source(),
                       std::string("'") + key + "' must be a whole number from 1 to " + std::to_string(most));
    return static_cast<int>(*value);
  }

  bool flag(const char* key) {
    const toml::node* node = asked(key);
    if (node == nullptr) return false;
    if (!node->is_boolean())
      throw step_error(file_, node->source(), std::string("'") + key + "' must be true or false");
    return *node->value<bool>();
  }

  void finish() const {
    std::string known;
    for (const std::string& key : asked_) known += (known.empty() ? "" : ", ") + key;
    for (const auto& [key, value] : table_)
      if (std::find(asked_.begin(), asked_.end(), key.str()) == asked_.end())
        throw step_error(file_, key.source(),
                         "unknown key '" + std::string(key.str()) + "' in [[step]]: known are " + known);
  }

 private:
  const toml::node* asked(const char* key) {
    asked_.emplace_back(key);
    return table_.get(key);
  }

  const toml::table& table_;
  const std::string& file_;
  std::vector<std::string> asked_;
};

ProgrammeStep read_step(const toml::table& table, const std::string& name) {
  StepReader reader(table, name);
  ProgrammeStep step;
  step.exercise_id = reader.word("exercise", true);
  step.level = reader.word("level", true);
  step.passes = reader.count("passes", 1, kMostPasses);
  step.in_a_row = reader.flag("in_a_row");
  step.days = reader.count("days", 1, kMostDays);
  step.sign_off = reader.flag("sign_off");
  step.due_days = reader.count("due_days", 0, kLongestDue);
  step.input = reader.word("input", false);
  if (!step.input.empty() &&
      std::find(std::begin(kPersonsInputs), std::end(kPersonsInputs), step.input) == std::end(kPersonsInputs))
    throw step_error(name, table.source(),
                     "input '" + step.input +
                         "' is none that a person holds: mouse, keyboard, gamepad, spacemouse, "
                         "device");
  reader.finish();
  if (step.days > step.passes)
    throw step_error(name, table.source(), "'days' must not exceed 'passes': a pass is on one day");
  return step;
}

std::string quoted_toml(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) out += c == '"' || c == '\\' ? std::string("\\") + c : std::string(1, c);
  return out + "\"";
}

std::string times(int n, const char* one, const char* many) { return std::to_string(n) + " " + (n == 1 ? one : many); }

/// Rows of passes, of whose attempts the boards are asked only once a row is long enough to matter.
class PassRow {
 public:
  PassRow(const ProgrammeStep& step, const std::function<int(std::int64_t)>& board_of)
      : wanted_(step.passes), board_of_(board_of) {}
  void add(const StepAttempt& attempt) {
    if (!attempt.begun) return;
    if (!attempt.passed) {
      rows_.clear();
      boards_.clear();
      return;
    }
    rows_.push_back(attempt.row);
    longest_ = std::max(longest_, std::min(static_cast<int>(rows_.size()), wanted_ - 1));
    if (static_cast<int>(rows_.size()) < wanted_) return;
    while (boards_.size() < rows_.size()) {
      boards_.push_back(board_of_(rows_[boards_.size()]));
      different_.clear();
    }
    different_.insert(boards_.begin(), boards_.end());
    const int boards = static_cast<int>(different_.size());
    done_ = done_ || boards >= wanted_;
    if (done_) longest_ = std::max(longest_, boards);
  }
  bool done() const { return done_; }
  int longest() const { return longest_; }

 private:
  int wanted_;
  const std::function<int(std::int64_t)>& board_of_;
  std::vector<std::int64_t> rows_ = {};
  std::vector<int> boards_ = {};
  std::set<int> different_ = {};
  int longest_ = 0;
  bool done_ = false;
};

struct StateWords {
  StepState state;
  const char *key, *words;
};
constexpr StateWords kStates[] = {
    {StepState::kOverdue, "overdue", "overdue"},    {StepState::kNotStarted, "not-started", "not started"},
    {StepState::kLearning, "learning", "learning"}, {StepState::kToSign, "to-sign", "to sign off"},
    {StepState::kPassed, "passed", "passed"},       {StepState::kCertified, "certified", "certified"}};

const StateWords& words_of_state(StepState state) {
  return *std::find_if(std::begin(kStates), std::end(kStates), [&](const StateWords& w) { return w.state == state; });
}

}  // namespace

Programme read_programme(const std::string& toml, const std::string& name) {
  const toml::table document = parsed_programme(toml, name);
  for (const auto& [key, value] : document)
    if (key.str() != "step")
      throw step_error(name, key.source(),
                       "unknown key '" + std::string(key.str()) + "': a programme is [[step]] after [[step]]");
  const toml::array* steps = document.get_as<toml::array>("step");
  if (steps == nullptr || steps->empty() || !steps->is_array_of_tables())
    throw step_error(name, document.source(), "a programme needs at least one [[step]]");
  Programme programme;
  for (const toml::node& node : *steps) {
    ProgrammeStep step = read_step(*node.as_table(), name);
    for (const ProgrammeStep& other : programme.steps)
      if (other.exercise_id == step.exercise_id && other.level == step.level && other.input == step.input)
        throw step_error(name, node.source(), "this exercise, level and input is a step already");
    programme.steps.push_back(std::move(step));
    if (programme.steps.size() > kMostSteps)
      throw step_error(name, node.source(), "a programme has at most " + std::to_string(kMostSteps) + " steps");
  }
  return programme;
}

std::string programme_toml(const Programme& programme) {
  std::string out;
  for (const ProgrammeStep& step : programme.steps) {
    out += std::string(out.empty() ? "" : "\n") + "[[step]]\nexercise = " + quoted_toml(step.exercise_id) +
           "\nlevel = " + quoted_toml(step.level) + "\npasses = " + std::to_string(step.passes) + "\n";
    if (step.in_a_row) out += "in_a_row = true\n";
    if (step.days != 1) out += "days = " + std::to_string(step.days) + "\n";
    if (step.sign_off) out += "sign_off = true\n";
    if (step.due_days != 0) out += "due_days = " + std::to_string(step.due_days) + "\n";
    if (!step.input.empty()) out += "input = " + quoted_toml(step.input) + "\n";
  }
  return out;
}

void require_known(const Programme& programme, const std::string& name, const KnownLevels& known) {
  for (std::size_t i = 0; i < programme.steps.size(); ++i) {
    const ProgrammeStep& step = programme.steps[i];
    const std::string place = "programme \"" + name + "\", step " + std::to_string(i + 1) + ": ";
    const auto exercise = known.find(step.exercise_id);
    if (exercise == known.end()) throw InputError(place + "there is no exercise \"" + step.exercise_id + "\"");
    const auto& levels = exercise->second;
    if (!levels.empty() && std::find(levels.begin(), levels.end(), step.level) == levels.end())
      throw InputError(place + step.exercise_id + " has no level \"" + step.level + "\"");
  }
}

bool is_programme(const std::string& toml) {
  try {
    return parsed_programme(toml, "").contains("step");
  } catch (const InputError&) {
    return false;
  }
}

std::string rule_words(const ProgrammeStep& step) {
  return times(step.passes, "pass", "passes") +
         (step.in_a_row && step.passes > 1 ? " in a row, on as many boards" : "") +
         (step.days > 1 ? ", on " + std::to_string(step.days) + " days" : "") +
         (step.input.empty() ? "" : ", with " + step.input) + (step.sign_off ? ", and signed off" : "");
}

StepProgress progress_of(const ProgrammeStep& step, const std::vector<StepAttempt>& attempts,
                         const std::function<int(std::int64_t row)>& board_of) {
  StepProgress out;
  PassRow row(step, board_of);
  std::set<std::int64_t> days;
  for (const StepAttempt& attempt : attempts) {
    ++out.attempts;
    out.last_row = attempt.row;
    if (attempt.passed) {
      ++out.passes;
      days.insert(attempt.started_s / kSecondsADay);
    }
    if (out.reached_s) continue;  // boards are asked for no longer
    if (step.in_a_row) row.add(attempt);
    const bool often = step.in_a_row ? row.done() : out.passes >= step.passes;
    if (often && static_cast<int>(days.size()) >= step.days) out.reached_s = attempt.started_s;
  }
  out.days = static_cast<int>(days.size());
  out.best_row = row.longest();
  return out;
}

std::string missing_words(const ProgrammeStep& step, const StepProgress& progress) {
  if (progress.reached_s) return "";
  const int passes = step.in_a_row ? progress.best_row : progress.passes;
  std::string out;
  if (passes < step.passes)
    out = std::to_string(passes) + " of " + times(step.passes, "pass", "passes") + (step.in_a_row ? " in a row" : "");
  if (step.days > 1 && progress.days < step.days)
    out += (out.empty() ? "" : ", ") + std::to_string(progress.days) + " of " + times(step.days, "day", "days");
  return out;
}

const char* step_state_key(StepState state) { return words_of_state(state).key; }
const char* step_state_words(StepState state) { return words_of_state(state).words; }

std::optional<StepState> step_state_keyed(const std::string& key) {
  for (const StateWords& words : kStates)
    if (key == words.key) return words.state;
  return std::nullopt;
}

StepState state_of(const ProgrammeStep& step, const StepProgress& progress, bool certified,
                   std::optional<std::int64_t> due_s, std::int64_t now_s) {
  if (certified) return StepState::kCertified;
  if (progress.reached_s) return step.sign_off ? StepState::kToSign : StepState::kPassed;
  if (due_s && now_s >= *due_s) return StepState::kOverdue;
  return progress.attempts > 0 ? StepState::kLearning : StepState::kNotStarted;
}

std::int64_t end_of_day(const std::string& day) {
  const auto begin = day.size() == 10 ? seconds_of_utc(day + "T00:00:00Z") : std::nullopt;
  if (!begin || day < "2000") throw InputError("deadline \"" + day + "\": give a day such as 2026-06-30");
  return *begin + kSecondsADay;
}

std::optional<std::int64_t> step_due(const ProgrammeStep& step, const std::string& due, std::int64_t given_s) {
  std::optional<std::int64_t> out;
  if (!due.empty()) out = end_of_day(due);
  if (step.due_days > 0) {
    const std::int64_t own = (given_s / kSecondsADay + step.due_days + 1) * kSecondsADay;
    out = std::min(own, out.value_or(own));
  }
  return out;
}

}  // namespace trocar
