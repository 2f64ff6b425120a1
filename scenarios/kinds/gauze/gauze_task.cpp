#include "scenarios/kinds/gauze/gauze_task.h"

#include <algorithm>
#include <cmath>

#include "scenarios/kinds/gauze/gauze_layout.h"

namespace trocar {
namespace {

constexpr double kPullEnds = 0.8, kPullRearm = 0.1;  // of the limit; s
constexpr double kCutAhead = 0.45;  // of a step, from what is cut to the middle of the next snip: they overlap a little
constexpr double kFirstAhead = 0.5;     // the same from the edge, which gives way more: the rim parts with the cut
constexpr double kOnLine = 0.4;         // of a step: the last snip of the way in just meets the closed line
constexpr double kGoodShare = 0.5;      // of the band about the line, that is aimed for
constexpr double kAheadGoal = 1.0;      // of a step, from there to where the line goes
constexpr double kBlamedFor = 2.5;      // s for which a mistake is shown
constexpr double kLeastOutside = 1e-4;  // of the line, that is told

}  // namespace

GauzeTask::GauzeTask(const Exercise& exercise, const ExerciseLevel& level, const Board& board)
    : rules_(own_rules<GauzeRules>(exercise)),
      board_(own_rules<GauzeBoard>(board)),
      level_(level),
      targets_(board.targets),
      line_(board_.line, own_rules<GauzeLevel>(level).off_m),
      pulls_(rules_.most_pull_n, kPullEnds * rules_.most_pull_n, kPullRearm) {}

void GauzeTask::begin(EventLog& log) {
  asked_ = -1;
  ask_next(log);
}

/// The step in which the first place lies that is not cut past.
void GauzeTask::ask_next(EventLog& log) {
  for (std::size_t n = 0; n < targets_.size(); ++n) {
    if (done_[n]) continue;
    bool past = true;
    for (const double share : {0.1, 0.3, 0.5, 0.7, 0.9})
      past = past && line_.cut_at((static_cast<double>(n) + share) * step_m());
    if (!past && !finished()) continue;
    done_.set(n);
    log.add(event_type::kTargetHeld, Severity::kInfo, static_cast<std::int32_t>(n), log.t_s - lit_at_s_, "s");
  }
  if (finished()) return;
  const double from = line_.uncut_from_m(), all = line_.way_in_m() + line_.round_m();
  double arc = std::min(from + (from > 0 ? kCutAhead : kFirstAhead) * rules_.step_m, all);
  if (from < line_.way_in_m()) arc = std::min(arc, line_.way_in_m() - kOnLine * rules_.step_m);
  if (asked_ >= 0 && arc == next_arc_m_) return;
  next_arc_m_ = arc;
  const LinePlace at = line_.at(arc);
  R_TI_ = blades_along(level_, board_.R_TI_rest, board_.middle_T + Vec3(at.at.x(), at.at.y(), 0),
                       {at.along.x(), at.along.y(), 0}, roll_rad_);
  const auto asked =
      std::min(static_cast<std::int32_t>(from / step_m()), static_cast<std::int32_t>(targets_.size()) - 1);
  if (asked == asked_) return;
  asked_ = asked;
  lit_at_s_ = log.t_s;
  log.add(event_type::kTargetLit, Severity::kInfo, asked_);
}

void GauzeTask::judge(const SheetCutSeen& cut, EventLog& log) {
  const auto on_gauze = [&](const Vec3& place_T) -> Eigen::Vector2d { return (place_T - board_.middle_T).head<2>(); };
  const CutLine::Added added = line_.add(on_gauze(cut.from_rest_T), on_gauze(cut.to_rest_T), cut.from_rim, cut.to_rim);
  log.add(event_type::kSnip, Severity::kInfo, asked_, added.area_share);
  if (added.outside_share < kLeastOutside) return;
  log.add(event_type::kOffLine, Severity::kMinor, asked_, added.outside_share);
  ++off_count_;
  told_ = {"Off the line", "Lay the blades on the line before you close them.", log.t_s};
}

void GauzeTask::follow_pull(const TaskInput& input, EventLog& log) {
  const TissueFrame& frame = *input.tissue;
  if (pulls_.update(frame.sheet_pull_n, input.dt_s)) {
    log.add(event_type::kPulledHard, Severity::kMinor, asked_, frame.sheet_pull_n, "N");
    told_ = {"Too much pull on the gauze", "Press just enough that it lies between the blades.", log.t_s};
  }
  if (tears_ >= 0 && frame.surgery.tears > tears_ && !torn_) {
    torn_ = true;
    log.add(event_type::kGauzeTorn, Severity::kCritical, asked_, frame.sheet_pull_n, "N");
    told_ = {"The gauze is torn", "Press just enough that it lies between the blades.", log.t_s};
  }
  tears_ = frame.surgery.tears;
}

void GauzeTask::update(const TaskInput& input, EventLog& log) {
  now_s_ = log.t_s;
  if (finished() || !input.tissue) return;
  const TissueFrame& frame = *input.tissue;
  follow_pull(input, log);
  // What was cut before the run is nobody's.
  if (cuts_ < 0) cuts_ = frame.sheet_cut_count;
  for (cuts_ = std::max(cuts_, frame.sheet_cut_count - kMaxSheetCutsSeen); cuts_ < frame.sheet_cut_count; ++cuts_)
    judge(frame.sheet_cut[static_cast<std::size_t>(cuts_ % kMaxSheetCutsSeen)], log);
  ask_next(log);
}

Vec3 GauzeTask::line_T(const TissueFrame* frame, double arc_m) const {
  const LinePlace at = line_.at(arc_m);
  const double share = arc_m / (line_.way_in_m() + line_.round_m());
  return on_gauze_now_T(targets_, done_, frame, board_.middle_T + Vec3(at.at.x(), at.at.y(), 0), share);
}

void GauzeTask::describe(const TaskInput& input, DirectorStatus& status) const {
  status.done = done_;
  status.targets_done = static_cast<int>(done_.count());
  status.target_index = object();
  status.wrong_places = off_count_;
  status.hold_progress = 0;
  if (finished()) return;
  const double all = line_.way_in_m() + line_.round_m();
  status.exposure = line_.uncut_from_m() / all;
  Demand& demand = status.demand;
  demand = {};
  demand.centre_T = line_T(input.tissue, next_arc_m_);
  demand.goal_T = line_T(input.tissue, std::min(all, next_arc_m_ + kAheadGoal * rules_.step_m));
  demand.radius_m = kGoodShare * own_rules<GauzeLevel>(level_).off_m;
  demand.R_TI = R_TI_;
  demand.angle_tolerance_rad = std::atan2(demand.radius_m, rules_.step_m);
  demand.band = {rules_.press_low_n, rules_.press_high_n};
  status.cue = Cue::kSnip;
  const double pull = input.tissue ? input.tissue->sheet_pull_n : 0;
  status.force_shown = force_shown(level_.force_display, pull > rules_.press_high_n);
  if (told_.at_s >= 0 && now_s_ - told_.at_s < kBlamedFor) return say(status, told_.message, told_.hint, true);
  if (next_arc_m_ < line_.way_in_m())
    return say(status, "Cut in from the edge", "Straight along the line to the circle.");
  say(status, "Cut along the line", "Open blades on the line, press a little, close.");
}

}  // namespace trocar
