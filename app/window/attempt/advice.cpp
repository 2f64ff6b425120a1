#include "app/window/attempt/advice.h"

#include <algorithm>

#include "app/picture/attempt/attempt_scene.h"
#include "app/window/attempt/debrief_reason.h"
#include "app/window/attempt/metric_words.h"
#include "app/window/attempt/number_words.h"
#include "scenarios/kinds/kind.h"
#include "scenarios/scoring/event_types.h"
#include "scenarios/scoring/metrics.h"

namespace trocar {
namespace {

/// What a sentence of advice is made from.
struct Advised {
  const Translator& words;
  const AttemptResult& result;
  const DebriefFacts& facts;
  const Exercise& exercise;
  const ExerciseLevel* level;  ///< null: the exercise has no such level any more
  bool pointer;

  const EventCounts& counts() const { return facts.counts; }
  /// What tells a hand at this input that it touches.
  enum class Contact : std::uint8_t { kFelt, kBar, kTissue };
  Contact contact() const {
    if (!pointer) return Contact::kFelt;
    return level && level->force_display == "after" ? Contact::kTissue : Contact::kBar;
  }
};

std::string press_carefully(const Advised& a) {
  const std::vector<std::string> limit{newtons(a.words, a.exercise.hard_force_n)};
  switch (a.contact()) {
    case Advised::Contact::kFelt:
      return a.words("Try next: stop as soon as you feel contact, then press; never above {0}.", limit);
    case Advised::Contact::kBar:
      return a.words("Try next: stop as soon as the force bar shows contact, then press; never above {0}.", limit);
    case Advised::Contact::kTissue:
      break;
  }
  return a.words("Try next: stop as soon as the tissue gives way, then press little; never above {0}.", limit);
}

std::string critical_advice(const Advised& a) {
  const std::string& event = a.facts.cause.event;
  if (event == event_type::kCriticalForce) return press_carefully(a);
  if (event == event_type::kLost) return a.words("Try next: stay within the board, and let go only where it belongs.");
  if (event == event_type::kCrush)
    return a.words("Try next: close the jaws slowly and stop as soon as the block no longer slides.");
  if (event == event_type::kCutTooSoon)
    return a.words("Try next: count the clips before you take the scissors: two where it comes from, one beyond.");
  if (event == event_type::kWrongStructure)
    return a.words("Try next: follow each structure to where it comes from before you clip or cut it.");
  if (event == event_type::kNeedleLost)
    return a.words("Try next: close the jaws fully on the needle, and keep them shut until it is in the tissue.");
  if (event == event_type::kTear)
    return a.words("Try next: only roll once the point is in; whoever pushes across the needle tears.");
  if (event == event_type::kPerforated)
    return a.words("Try next: let go of the pedal before you move the hook over the liver.");
  if (event == event_type::kGauzeTorn)
    return a.words("Try next: let the tips only just dent the gauze, and open the blades before you move on.");
  return a.words("Try next: the same again, slower.");
}

std::string first_touch(const Advised& a) {
  switch (a.contact()) {
    case Advised::Contact::kFelt:
      return a.words("Try next: stop over the lit disc, then go straight down until you feel it.");
    case Advised::Contact::kBar:
      return a.words("Try next: stop over the lit disc, then press until the force bar shows contact.");
    case Advised::Contact::kTissue:
      break;
  }
  return a.words("Try next: stop over the lit disc, then press until the tissue gives way.");
}

std::string not_tried_advice(const Advised& a) {
  if (judges_pull(judged_part(a.exercise, a.facts.cause.metric)))
    return a.words("Try next: press the open jaws on the lit disc, close them, and lift until enough is exposed.");
  if (is_band_share(a.facts.cause.metric)) return first_touch(a);
  if (a.counts().grasped == 0) return a.words("Try next: go down with open jaws round the lit block, then close them.");
  return a.words("Try next: close the jaws until the block no longer slides, then lift it {0}.",
                 {millimetres(a.words, a.exercise.grasp.lift_m)});
}

std::string in_band_advice(const Advised& a) {
  const bool one = a.level && a.level->bands.size() == 1;
  const std::string band =
      one ? newtons_between(a.words, a.level->bands[0].low_n, a.level->bands[0].high_n) : std::string();
  if (a.contact() == Advised::Contact::kTissue)
    return a.words(
        "Try next: press a little, see how far the tissue gives way, then let it stay until the disc is done.");
  if (a.contact() == Advised::Contact::kBar)
    return one ? a.words("Try next: press until the bar reads {0}, then let go: the force stays.", {band})
               : a.words("Try next: press until the bar stands in its band, then let go: the force stays.");
  return one ? a.words("Try next: press to {0} in one go, then keep still until the disc is done.", {band})
             : a.words("Try next: press into the band in one go and then keep still until the disc is done.");
}

std::string excess_advice(const Advised& a) {
  if (a.counts().squeezed_hard > a.counts().pressed_hard)
    return a.words("Try next: close the jaws slowly and stop at {0}.",
                   {newtons_between(a.words, a.exercise.grip.low_n, a.exercise.grip.high_n)});
  return press_carefully(a);
}

std::string placing_advice(const Advised& a) {
  const EventCounts& n = a.counts();
  if (n.drops > n.misplaced) return a.words("Try next: keep the jaws closed until the block stands on the board.");
  if (n.misplaced > 0)
    return a.words("Try next: bring the block over the middle of its ring, lower it until it stands, then let go.");
  return a.words("Try next: set each block down whole within its ring before you take the next one.");
}

std::string time_advice(const Advised& a) {
  const double model_s = a.level ? model_time_s(*a.level, a.result) : 0;
  const std::vector<std::string> seconds{a.words.number(model_s, 0)};
  if (model_s <= 0) return a.words("Try next: keep this care and save pauses between targets.");
  return a.pointer ? a.words("Try next: keep this care and save pauses between targets; a practised hand takes {0} s.",
                             seconds)
                   : a.words("Try next: keep this care and save pauses between targets; the expert hand takes {0} s.",
                             seconds);
}

std::string pose_advice(const Advised& a, const std::string& metric) {
  if (metric == "angle_error_deg") return a.words("Try next: bring the tip to its place first, then turn about it.");
  if (metric == "position_error_m")
    return a.pointer ? a.words("Try next: make the last millimetres in small moves, then let everything rest.")
                     : a.words("Try next: hold still for the whole time; rest your hand, and move only the tip.");
  if (a.counts().held == 0)
    return a.words("Try next: bring the tip to the end of the lit pen, then turn along it, then hold still.");
  return a.pointer
             ? a.words("Try next: place the tip, then lean the shaft along the pen, and roll it last.")
             : a.words("Try next: turn the instrument while you travel, so that only the last millimetres are left.");
}

/// Of a hand that leads the scope.
std::string scope_advice(const Advised& a, const std::string& metric) {
  if (metric == "horizon_share")
    return a.words("Try next: watch the horizon while you travel, and roll the scope back at once.");
  if (metric == "wall_contacts") return a.words("Try next: draw the scope back before you go across to the next cup.");
  if (metric == "view_jerks") return a.words("Try next: one slow move to each sphere; let the picture come to rest.");
  return a.words("Try next: go back until the lit cup is in the picture, then centre it, then go nearer along it.");
}

std::string next_for(const Advised& a, const DebriefRow& row) {
  const Translator& words = a.words;
  const std::string m(plain_metric(row.metric));
  const bool pulls = judges_pull(judged_part(a.exercise, row.metric));
  if (m == "wrong_places") return words("Try next: stop just over the lit disc, look, then go straight down.");
  if (is_band_share(m) && pulls)
    return a.exercise.breathing.depth_m > 0
               ? words("Try next: lift slowly until the pull is right, then follow the breath with a loose hand.")
               : words("Try next: lift slowly until the pull is right, and keep still there.");
  if (is_band_share(m)) return in_band_advice(a);
  if (m == "force_max_n" && pulls) return words("Try next: lift in one slow move, and stop where the pull is right.");
  if (m == "soft_impulse_ns" || m == "pressed_impulse_ns")
    return words("Try next: let the roll do the work, and press the point on only until it goes in.");
  if (m == "entry_error_m")
    return words("Try next: stop with the point just over the dot, look, and only then lower it.");
  if (m == "exit_error_m")
    return words("Try next: turn the needle so that its circle runs through both dots before it goes in.");
  if (m == "needle_angle_deg")
    return words("Try next: roll about the middle of the needle's circle; the jaws go round it.");
  if (m == "needle_redos") return words("Try next: look where the jaws are on the needle before you close them.");
  if (m == "force_max_n") return words("Try next: let the jaws close round it without a pull, and open before you go.");
  if (m == "clips_correct_share")
    return words("Try next: before you close, look: straight across, tips beyond, clear of the clip beside it.");
  if (m == "clip_errors") return words("Try next: go in deeper until the tips show beyond, and only then close.");
  if (m == "safe_energy_share")
    return words("Try next: lift, look, and only then press; let go as soon as the strand parts or it is dry.");
  if (m == "strands_lifted_share" || m == "strand_clearance_share")
    return words("Try next: lift each strand clear of the liver before the current.");
  if (m == "spurted_ml")
    return words("Try next: go straight to the vessel, press the tip on it, and stay until it is dry.");
  if (m == "strand_current_s")
    return words("Try next: let the strand lie on the foot of the hook, then one short press.");
  if (m == "cut_area_share" || m == "cut_outside_share")
    return words("Try next: before each snip stop over the line and see both tips on it; roll before you press.");
  if (m == "hard_pulls")
    return words("Try next: let the tips only just dent the gauze, and open the blades before you move on.");
  if (m == "clip_angle_deg") return words("Try next: before you close, roll until the jaws lie straight across.");
  if (m == "cut_off_middle_m") return words("Try next: look at both clips and lay the blades half-way between them.");
  if (m == "force_max_n" || (m == "excess_events" && pulls))
    return words("Try next: lift in one slow move, and stop where the pull is right.");
  if (m == "right_answers_share")
    return words("Try next: say the symbol to yourself while you hold, let the flap down, and only then tell it.");
  if (m == "grip_mean_n") return words("Try next: close the jaws only as far as the tissue no longer slides.");
  if (m == "holds_lost") return words("Try next: grip before you lift, and keep the height until the time is over.");
  if (m == "time_to_expose_s") return words("Try next: press the open jaws on, close, and lift at once.");
  if (m == "excess_events") return excess_advice(a);
  if (is_window_share(m))
    return words("Try next: set your grip before you lift, and hold it unchanged until the block stands.");
  if (m == "crushed") return words("Try next: close the jaws slowly and stop as soon as the block no longer slides.");
  if (m == "transfer_errors")
    return words("Try next: stop over the peg, look whether the ring is over its middle, and only then lower it.");
  if (m == "grip_marks") return words("Try next: close slowly, stop in the wanted grip, and keep it while you travel.");
  if (m == "wire_touch_share")
    return words("Try next: where the ring touches stop, ease it back to the middle, and only then go on.");
  if (m == "wire_touches") return words("Try next: look at the gap all round the ring and keep it even as you go.");
  if (m == "ring_angle_deg")
    return words("Try next: begin to roll before a bend, so that the ring stands across the wire all the way round.");
  if (m == "block_regrasps")
    return words("Try next: take each block in its middle, firmly enough to carry it at one go.");
  if (m == "search_share")
    return words("Try next: press the whole region point by point, go back to the hardest places, and then mark.");
  if (m == "pressed_well_share")
    return words("Try next: come down slowly, stop within the band, and press every place with that same force.");
  if (m == "localisation_error_m") return words("Try next: press all round a hard place before you mark its middle.");
  if (m == "objects_done_share") return placing_advice(a);
  if (m == "path_ratio") return words("Try next: decide the way first, then go there in one straight move.");
  if (is_scope(a.exercise) && m != "time_per_target_s") return scope_advice(a, m);
  if (m == "matched_in_time_share" || m == "position_error_m" || m == "angle_error_deg") return pose_advice(a, m);
  if (m == "time_s" || m == "time_per_target_s") return time_advice(a);
  return words("Try next: {0}, now {1}, towards {2}.", {row.name, row.value, row.full});
}

std::string count_of_force(const Advised& a, const DebriefRow& row) {
  const Translator& words = a.words;
  const int pressed = a.counts().pressed_hard, squeezed = a.counts().squeezed_hard;
  const bool jaws = squeezed > pressed;
  const int n = jaws ? squeezed : pressed > 0 ? pressed : static_cast<int>(*row.raw);
  const std::vector<std::string> values{std::to_string(n),
                                        newtons(words, jaws ? a.exercise.grip.excess_n : a.exercise.hard_force_n)};
  if (jaws) return words(n == 1 ? "Once squeezed above {1}." : "{0} times squeezed above {1}.", values);
  return words(n == 1 ? "Once above {1}." : "{0} times above {1}.", values);
}

std::string count_of_placing(const Advised& a) {
  const Translator& words = a.words;
  const EventCounts& n = a.counts();
  if (n.drops > n.misplaced)
    return words(n.drops == 1 ? "One block dropped." : "{0} times a block dropped.", {std::to_string(n.drops)});
  if (n.misplaced > 0)
    return words(n.misplaced == 1 ? "Once set down outside the ring." : "{0} times set down outside the ring.",
                 {std::to_string(n.misplaced)});
  return words("{0} of {1} blocks placed.",
               {std::to_string(std::max(0, n.placed)), std::to_string(a.exercise.layout.count)});
}

std::string count_of_grip(const Advised& a, const DebriefRow& row) {
  const Translator& words = a.words;
  const int slips = a.counts().slips, crushed = a.counts().crushed;
  if (slips > crushed)
    return words(slips == 1 ? "Held too lightly: once it slipped." : "Held too lightly: {0} times it slipped.",
                 {std::to_string(slips)});
  if (crushed > 0)
    return words(crushed == 1 ? "Held too hard: one block crushed." : "Held too hard: {0} blocks crushed.",
                 {std::to_string(crushed)});
  return words("In the wanted grip for {0} of the carrying time.", {row.value});
}

/// What happened, in numbers; "" where the reason and the table say all of it.
std::string count_of(const Advised& a, const DebriefRow& row) {
  const Translator& words = a.words;
  const std::string m(plain_metric(row.metric));
  const bool pulls = judges_pull(judged_part(a.exercise, row.metric));
  if (m == "wrong_places")
    return words(row.raw == 1 ? "Once beside the disc." : "{0} times beside the disc.", {row.value});
  if (m == "excess_events") return count_of_force(a, row);
  if (is_band_share(m) && pulls) return words("In the band for {0} of the holding time.", {row.value});
  if (is_band_share(m)) return words("In the band for {0} of the pressing time.", {row.value});
  if (is_window_share(m)) return count_of_grip(a, row);
  if (m == "crushed") return words(row.raw == 1 ? "One block crushed." : "{0} blocks crushed.", {row.value});
  if (m == "grip_marks") return words(row.raw == 1 ? "Once held too tight." : "{0} times held too tight.", {row.value});
  if (m == "wire_touches")
    return words(row.raw == 1 ? "The ring touched once." : "The ring touched {0} times.", {row.value});
  if (m == "ring_angle_deg") return words("The ring stood {0} off square on average.", {row.value});
  if (m == "block_regrasps")
    return words(row.raw == 1 ? "Once grasped again." : "{0} times grasped again.", {row.value});
  if (m == "cut_area_share") return words("Between cut and line lie {0} of what the line encloses.", {row.value});
  if (m == "cut_outside_share") return words("{0} of the line's length was cut outside the band.", {row.value});
  if (m == "hard_pulls")
    return words(row.raw == 1 ? "Once pulled too hard." : "{0} times pulled too hard.", {row.value});
  if (m == "clip_errors") return words(row.raw == 1 ? "One mistake." : "{0} mistakes.", {row.value});
  if (m == "entry_error_m") return words("In {0} beside the dot on average.", {row.value});
  if (m == "soft_impulse_ns" || m == "pressed_impulse_ns") return words("{0} beyond the force limit.", {row.value});
  if (m == "exit_error_m") return words("Out {0} beside the dot on average.", {row.value});
  if (m == "needle_angle_deg") return words("{0} off the needle's own way on average.", {row.value});
  if (m == "needle_redos") return words(row.raw == 1 ? "Once done again." : "{0} times done again.", {row.value});
  if (m == "spurted_ml") return words("{0} of blood lost.", {row.value});
  if (m == "strand_current_s") return words("{0} of current for each strand on average.", {row.value});
  if (m == "clip_angle_deg") return words("Clips {0} off straight across on average.", {row.value});
  if (m == "cut_off_middle_m") return words("Cut {0} off the middle on average.", {row.value});
  if (m == "objects_done_share") return count_of_placing(a);
  if (m == "horizon_share") return words("Level for {0} of the time.", {row.value});
  if (m == "wall_contacts")
    return words(row.raw == 1 ? "The lens touched once." : "The lens touched {0} times.", {row.value});
  if (m == "view_jerks") return words("{0} jerks of the picture for each sphere.", {row.value});
  if (m == "matched_in_time_share" && a.counts().out_of_time > 0 && is_scope(a.exercise))
    return words(a.counts().out_of_time == 1 ? "Once a sphere ran out of time." : "{0} times a sphere ran out of time.",
                 {std::to_string(a.counts().out_of_time)});
  if (m == "matched_in_time_share" && a.counts().out_of_time > 0)
    return words(a.counts().out_of_time == 1 ? "Once a pen ran out of time." : "{0} times a pen ran out of time.",
                 {std::to_string(a.counts().out_of_time)});
  if (m == "position_error_m") return words("{0} off the place on average.", {row.value});
  if (m == "angle_error_deg") return words("{0} off the turn on average.", {row.value});
  if (m == "path_ratio") return words("The tip went {0} times the shortest way.", {row.value});
  return "";
}

/// Without the count that the reason has given already.
std::string cause_advice(const Advised& a, const DebriefRow& row) {
  const std::string happened = a.facts.cause.kind == DebriefCause::Kind::kBeside ? "" : count_of(a, row);
  return happened.empty() ? next_for(a, row) : happened + " " + next_for(a, row);
}

}  // namespace

std::string advice(const Translator& words, const AttemptResult& result, const DebriefFacts& facts,
                   const Exercise& exercise) {
  using Kind = DebriefCause::Kind;
  const Advised a{words, result, facts, exercise, level_named(exercise, result.level), result.device.without_device()};
  switch (facts.cause.kind) {
    case Kind::kCritical:
      return critical_advice(a);
    case Kind::kNotStarted:
      return words("Try next: bring the tip into the ball at the start and rest there for {0} s.",
                   {brief(words, exercise.start_hold_s)});
    case Kind::kNotTried:
      return not_tried_advice(a);
    case Kind::kGate:
    case Kind::kBeside:
    case Kind::kUndone:
    case Kind::kLoss:
      if (const DebriefRow* row = row_of_subscore(facts, facts.cause.subscore)) return cause_advice(a, *row);
      return words("Try next: the same again, quicker.");
    case Kind::kOnward:
      return words("Try next: the same on another board; three passes in a row open the next level.");
    case Kind::kAgain:
      return words("Try next: the whole task once, however slowly; only a finished one is graded.");
    case Kind::kDevice:
      return words("Try next: the same once more; call your teacher if it happens again.");
    case Kind::kDeadman:
      return words("Try next: keep the deadman closed until the clock stops.");
  }
  return "";
}

}  // namespace trocar
