#include "app/window/attempt/advice.h"

#include "app/window/attempt/debrief_reason.h"
#include "scenarios/scoring/event_types.h"

namespace trocar {
namespace {

/// The force that one level asks for, "" when there are several.
std::string band_text(const Translator& words, const ExerciseLevel* level) {
  if (!level || level->bands.size() != 1) return "";
  return words("{0} to {1} N", {words.number(level->bands[0].low_n, 1), words.number(level->bands[0].high_n, 1)});
}

std::string critical_advice(const Translator& words, const std::string& event, const Exercise& exercise) {
  if (event == event_type::kCriticalForce)
    return words("Try next: stop as soon as you feel contact, then press; never above {0} N.",
                 {words.number(exercise.hard_force_n, 1)});
  if (event == event_type::kLost)
    return words("Try next: carry each block low and within the board, and let go only over its ring.");
  if (event == event_type::kCrush)
    return words("Try next: close the jaws slowly and stop as soon as the block no longer slides.");
  return words("Try next: the same again, slower.");
}

std::string force_advice(const Translator& words, const std::string& metric, const Exercise& exercise,
                         const ExerciseLevel* level) {
  if (metric == "excess_events")
    return words("Try next: come down slowly over the last 5 mm and stay below {0} N.",
                 {words.number(exercise.hard_force_n, 1)});
  if (metric == "in_band_share") {
    const std::string band = band_text(words, level);
    return band.empty() ? words("Try next: press into the band in one go and then keep still until the disc is done.")
                        : words("Try next: press to {0} in one go, then keep still until the disc is done.", {band});
  }
  if (metric == "grip_window_share")
    return words("Try next: set your grip before you lift, and hold it unchanged until the block stands.");
  if (metric == "crushed")
    return words("Try next: close the jaws slowly and stop as soon as the block no longer slides.");
  return "";
}

std::string motion_advice(const Translator& words, const std::string& metric, const ExerciseLevel* level) {
  if (metric == "block_regrasps")
    return words("Try next: take each block in its middle, firmly enough to carry it at one go.");
  if (metric == "wrong_places") return words("Try next: stop just over the lit disc, look, then go straight down.");
  if (metric == "path_ratio") return words("Try next: decide the way first, then go there in one straight move.");
  if (metric == "matched_in_time_share")
    return words("Try next: turn the instrument while you travel, so that only the last millimetres are left.");
  if (metric == "position_error_m")
    return words("Try next: hold still for the whole time; rest your hand, and move only the tip.");
  if (metric == "angle_error_deg") return words("Try next: bring the tip to its place first, then turn about it.");
  if (metric == "objects_done_share")
    return words("Try next: set each block down whole within its ring before you take the next one.");
  if (metric == "time_s")
    return level && level->expert_time_s > 0
               ? words("Try next: keep this care and save pauses between targets; the expert hand takes {0} s.",
                       {words.number(level->expert_time_s, 0)})
               : words("Try next: keep this care and save pauses between targets.");
  return "";
}

const DebriefRow* row_named(const DebriefFacts& facts, const std::string& subscore) {
  for (const DebriefRow& row : facts.rows)
    if (row.subscore == subscore) return &row;
  return nullptr;
}

std::string row_advice(const Translator& words, const DebriefRow& row, const Exercise& exercise,
                       const ExerciseLevel* level) {
  std::string text = force_advice(words, row.metric, exercise, level);
  if (text.empty()) text = motion_advice(words, row.metric, level);
  return text.empty() ? words("Try next: {0}, now {1}, towards {2}.", {row.name, row.value, row.full}) : text;
}

}  // namespace

AdviceTopic advice_topic(const AttemptResult& result, const DebriefFacts& facts) {
  using Kind = AdviceTopic::Kind;
  if (facts.outcome == Outcome::kDeviceStopped || facts.outcome == Outcome::kVoid) return {Kind::kDevice, "", "", ""};
  if (facts.outcome == Outcome::kStopped) return {Kind::kAgain, "", "", ""};
  if (const Event* event = first_critical(result)) return {Kind::kCritical, "", "", event->type};
  if (const DebriefRow* gate = worst_gate(facts.rows)) return {Kind::kGate, gate->metric, gate->subscore, ""};
  if (const DebriefRow* loss = largest_loss(facts.rows)) return {Kind::kLoss, loss->metric, loss->subscore, ""};
  return {Kind::kOnward, "", "", ""};
}

std::string advice(const Translator& words, const AttemptResult& result, const DebriefFacts& facts,
                   const Exercise& exercise) {
  using Kind = AdviceTopic::Kind;
  const AdviceTopic topic = advice_topic(result, facts);
  const ExerciseLevel* level = level_named(exercise, result.level);
  switch (topic.kind) {
    case Kind::kCritical:
      return critical_advice(words, topic.event, exercise);
    case Kind::kGate:
    case Kind::kLoss:
      return row_advice(words, *row_named(facts, topic.subscore), exercise, level);
    case Kind::kOnward:
      return words("Try next: the same on another board; three passes in a row open the next level.");
    case Kind::kAgain:
      return words("Try next: the whole task once, however slowly; only a finished one is graded.");
    case Kind::kDevice:
      return words("Try next: the same once more; call your teacher if it happens again.");
  }
  return "";
}

}  // namespace trocar
