#include "app/window/debrief/debrief_screen.h"

#include <algorithm>

#include "app/session/grading/recorded_result.h"
#include "app/window/attempt/advice.h"
#include "app/window/attempt/metric_words.h"

namespace trocar {
namespace {

constexpr double kBefore_s = 3;  // a replay begins so long before the moment that was chosen

/// The exercise of the result as the catalogue has it now.
const Exercise& exercise_of(const PracticeModel& model, const AttemptResult& result) {
  for (const Exercise& exercise : model.exercises())
    if (exercise.id == result.exercise_id) return exercise;
  return model.exercise();
}

std::vector<PastAttempt> comparable(const PracticeModel& model, const AttemptResult& result) {
  std::vector<PastAttempt> out;
  for (const PastAttempt& attempt : model.past(result.exercise_id)) {
    const AttemptSummary& s = attempt.summary;
    if (s.uuid != result.uuid && s.level == result.level && s.hand == result.hand &&
        s.rubric_sha256 == result.rubric_sha256 && s.started_utc <= result.started_utc)
      out.push_back(attempt);
  }
  return out;
}

std::map<std::string, double> numbers_of(const std::filesystem::path& recording) {
  try {
    const auto result = regrade_file(recording);
    return result ? past_attempt(*result).metrics : std::map<std::string, double>();
  } catch (const std::exception&) {
    return {};
  }
}

bool ready(const auto& future) {
  return future.valid() && future.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

}  // namespace

void DebriefScreen::look_at(PracticeModel& model) {
  result_ = model.result();
  page_ = {};
  content_ = {};
  past_ = {comparable(model, *result_), {}};
  say(model);
  content_.plots.lines = force_lines(exercise_of(model, *result_), result_->level);
  const std::filesystem::path recording = model.recording();
  content_.can_watch = content_.can_compare = !recording.empty();
  if (recording.empty()) {
    content_.plots_note = model.words()("Nothing was recorded, so there are no forces to show.");
    return;
  }
  content_.plots_note = model.words()("Reading the forces...");
  loading_ = std::async(std::launch::async, [recording]() -> Loaded {
    try {
      return {load_force_trace(recording), ""};
    } catch (const std::exception& error) {
      return {std::nullopt, error.what()};
    }
  });
}

/// All texts, in the language of now.
void DebriefScreen::say(PracticeModel& model) {
  const Translator& w = model.words();
  const Exercise& exercise = exercise_of(model, *result_);
  language_ = w.language();
  content_.facts = debrief_facts(w, *result_, exercise, past_);
  content_.advice = advice(w, *result_, content_.facts, exercise);
  content_.explained.clear();
  for (const DebriefRow& row : content_.facts.rows) content_.explained.push_back(explained(w, row, *result_, exercise));
  const ExerciseLevel* level = level_named(exercise, result_->level);
  content_.heading = w("{0} {1}, {2}, board {3}, by {4}",
                       {exercise.number, w.made(exercise.title), level ? level->name : result_->level,
                        std::to_string(result_->board), hand_words(w, result_->hand)});
  const PracticeModel::Advice next = model.next();
  content_.next_name = next.exercise_id == result_->exercise_id && next.level == result_->level
                           ? ""
                           : next.exercise_id + " " + next.level;
  for (const Exercise& e : model.exercises())
    if (e.id == next.exercise_id && !content_.next_name.empty()) content_.next_name = e.number + " " + next.level;
  if (trace_) content_.plots.events = plot_events(w, result_->events, *trace_);
}

void DebriefScreen::take_trace(PracticeModel& model) {
  if (!ready(loading_)) return;
  Loaded loaded = loading_.get();
  trace_ = std::move(loaded.trace);
  if (!trace_ || trace_->t_s.empty()) {
    trace_.reset();
    content_.plots_note = loaded.wrong.empty() ? model.words()("The recording holds no moment of the run.")
                                               : model.words()("The recording cannot be read: {0}", {loaded.wrong});
    return;
  }
  content_.plots.trace = &*trace_;
  content_.plots.events = plot_events(model.words(), result_->events, *trace_);
}

void DebriefScreen::take_expert(PracticeModel& model) {
  if (ready(expert_numbers_)) {
    past_.expert = expert_numbers_.get();
    say(model);
  }
  if (!expert_wanted_ || !expert_.empty()) return;
  expert_ = model.expert_recording();
  if (!expert_.empty()) {
    content_.compare_note.clear();
    expert_numbers_ = std::async(std::launch::async, numbers_of, expert_);
  } else if (!model.expert_refusal().empty()) {
    expert_wanted_ = false;
    content_.compare_note = model.words()("The expert's run cannot be made: {0}", {model.expert_refusal()});
  } else {
    content_.compare_note = model.words()("The expert is doing the same board; this takes some seconds.");
  }
}

std::optional<ScreenName> DebriefScreen::retry(PracticeModel& model) const {
  model.exercise_id = result_->exercise_id;
  model.level = result_->level;
  const std::string hindered = model.begin_attempt();
  if (hindered.empty()) return ScreenName::kRun;
  model.notice = hindered;
  return std::nullopt;
}

std::optional<ScreenName> DebriefScreen::follow(DebriefChoice choice, PracticeModel& model) {
  switch (choice) {
    case DebriefChoice::kNone:
      break;
    case DebriefChoice::kRetry:
      return retry(model);
    case DebriefChoice::kNext: {
      const PracticeModel::Advice next = model.next();
      model.exercise_id = next.exercise_id;
      model.level = next.level;
      return ScreenName::kBriefing;
    }
    case DebriefChoice::kWatch:
      model.replay_file = model.recording();
      model.replay_beside.clear();
      model.replay_at_s.reset();
      if (const auto chosen = page_.chosen_s())
        model.replay_at_s = std::max(trace_ ? trace_->begin_s : 0.0, *chosen - kBefore_s);
      return ScreenName::kReplay;
    case DebriefChoice::kCompare:
      expert_wanted_ = true;
      break;
    case DebriefChoice::kProgress:
      return ScreenName::kProgress;
    case DebriefChoice::kSignIn:
      return ScreenName::kStart;
    case DebriefChoice::kBack:
      return ScreenName::kBack;
  }
  if (!expert_wanted_ || expert_.empty()) return std::nullopt;
  model.replay_file = model.recording();
  model.replay_beside = expert_;
  model.replay_at_s.reset();
  return ScreenName::kReplay;
}

void DebriefScreen::settle(PracticeModel& model, double wait_s) {
  if (!model.result()) return;
  if (!result_ || result_->uuid != model.result()->uuid) look_at(model);
  if (loading_.valid()) loading_.wait_for(std::chrono::duration<double>(wait_s));
}

std::optional<ScreenName> DebriefScreen::frame(Ui& ui, PracticeModel& model, double /*dt_s*/) {
  if (!model.result()) return ScreenName::kStart;
  if (!result_ || result_->uuid != model.result()->uuid) look_at(model);
  if (language_ != model.words().language()) say(model);
  take_trace(model);
  take_expert(model);
  content_.guest = model.is_guest() && !model.is_demonstration();
  return follow(page_.draw(ui, content_), model);
}

}  // namespace trocar
