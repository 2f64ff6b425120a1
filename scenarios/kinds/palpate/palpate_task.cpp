#include "scenarios/kinds/palpate/palpate_task.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "scenarios/kinds/palpate/palpate_layout.h"
#include "tissue/tissue_frame.h"

namespace trocar {
namespace {

constexpr double kLetGoShare = 0.5;  // of the pinch, below which the fingers have let go
constexpr double kMarkToast = 2.0;   // s for which a mark is spoken of

int cells(double extent_m, double cell_m) { return std::max(1, static_cast<int>(std::lround(extent_m / cell_m))); }

}  // namespace

PalpateTask::PalpateTask(const Exercise& exercise, const ExerciseLevel& level, const Board& board)
    : rules_(own_rules<PalpateRules>(exercise)),
      level_(own_rules<PalpateLevel>(level)),
      display_(level.force_display),
      centre_T_(board.centre_T),
      start_T_(board.start_T),
      start_sphere_m_(exercise.start_sphere_m),
      half_x_m_(exercise.layout.region_x_m / 2),
      half_y_m_(exercise.layout.region_y_m / 2),
      hold_(rules_.mark_hold_s, kHoldGrace) {
  const std::size_t wanted = std::min(rules_.nodules.size(), board.nodules.size());
  nodules_.assign(board.nodules.begin(), board.nodules.begin() + static_cast<std::ptrdiff_t>(wanted));
  found_.assign(wanted, false);
  columns_ = cells(2 * half_x_m_, rules_.searched_cell_m);
  rows_ = cells(2 * half_y_m_, rules_.searched_cell_m);
  searched_.assign(static_cast<std::size_t>(columns_ * rows_), false);
  pressed_ = searched_;
}

void PalpateTask::follow_search(const Vec3& place_T, double force_n) {
  if (force_n < rules_.searched_n) return;
  const Vec3 off = place_T - centre_T_;
  if (std::abs(off.x()) >= half_x_m_ || std::abs(off.y()) >= half_y_m_) return;
  const int column = static_cast<int>((off.x() + half_x_m_) / (2 * half_x_m_) * columns_);
  const int row = static_cast<int>((off.y() + half_y_m_) / (2 * half_y_m_) * rows_);
  const int cell = row * columns_ + column;
  searched_[static_cast<std::size_t>(cell)] = true;
  if (force_n > press_n_) {
    press_n_ = force_n;
    press_cell_ = cell;
  }
}

/// The tip leaves the tissue, or the search ends: the first press of a cell is judged by the most of its force.
void PalpateTask::end_press(EventLog& log) {
  const double force_n = std::exchange(press_n_, 0);
  if (force_n <= 0 || pressed_[static_cast<std::size_t>(press_cell_)]) return;
  pressed_[static_cast<std::size_t>(press_cell_)] = true;
  const bool well = force_n >= rules_.press_low_n && force_n <= rules_.press_high_n;
  log.add(event_type::kPlacePressed, well ? Severity::kInfo : Severity::kMinor, press_cell_,
          1 / static_cast<double>(pressed_.size()), "1");
}

double PalpateTask::searched_share() const {
  return static_cast<double>(std::count(searched_.begin(), searched_.end(), true)) /
         static_cast<double>(searched_.size());
}

void PalpateTask::end(EventLog& log) {
  end_press(log);
  ended_ = true;
  log.add(event_type::kSearchEnded, Severity::kInfo, -1, searched_share(), "1");
}

void PalpateTask::set_mark(const Vec3& place_T, EventLog& log) {
  std::size_t nearest = nodules_.size();
  double least = 0;
  for (std::size_t i = 0; i < nodules_.size(); ++i) {
    const double off = off_along_surface(place_T, nodules_[i], rules_.nodules[i].top_m);
    if (found_[i] || (nearest < nodules_.size() && off >= least)) continue;
    nearest = i;
    least = off;
  }
  last_hit_ = nearest < nodules_.size() && least <= nodules_[nearest].radius_m + rules_.hit_m;
  if (last_hit_) {
    found_[nearest] = true;
    ++hits_;
    log.add(event_type::kNoduleFound, Severity::kInfo, static_cast<std::int32_t>(nearest), least, "m");
  } else {
    log.add(event_type::kFalseMark, Severity::kMajor, -1, least, "m");
  }
  marked_T_[static_cast<std::size_t>(marks_++)] = place_T;
  since_mark_s_ = 0;
  if (marks_ >= static_cast<int>(nodules_.size())) end(log);
}

void PalpateTask::update(const TaskInput& input, EventLog& log) {
  if (ended_) return;
  const StylusState& state = input.stylus;
  since_mark_s_ += input.dt_s;
  touching_ = state.contact && state.tip_contact;
  in_start_ = !touching_ && (state.X_TI.p - start_T_).norm() <= start_sphere_m_;
  const bool moved = input.tissue && input.tissue->touched_rest_T;
  const Vec3 place = touching_ ? (moved ? *input.tissue->touched_rest_T : state.contact_point_T) : state.X_TI.p;
  if (touching_ && !frozen(state)) follow_search(place, state.F_I_T.force.norm());
  if (!touching_) end_press(log);
  const bool pinched = state.grip_force_n >= rules_.mark_n;
  let_go_ = let_go_ || state.grip_force_n < kLetGoShare * rules_.mark_n;
  const bool wanted = pinched && let_go_ && (touching_ || in_start_);
  if (!wanted || hold_.progress() <= 0) hold_from_T_ = place;
  if ((place - hold_from_T_).norm() > rules_.still_m) {
    hold_.reset();
    hold_from_T_ = place;
  }
  holding_ = wanted && !frozen(state);
  if (!input.held(hold_, wanted)) return;
  hold_.reset();
  let_go_ = holding_ = false;
  if (touching_) return set_mark(place, log);
  end(log);
}

void PalpateTask::hints(const TaskInput& input, DirectorStatus& status) const {
  if (input.too_hard && display_ != "after") {
    const std::string wanted = band_text({rules_.press_low_n, rules_.press_high_n});
    return say(status, "Too hard - ease off", "Keep to " + wanted + ".", true);
  }
  const std::string count = std::to_string(marks_) + " of " + std::to_string(nodules_.size());
  if (since_mark_s_ < kMarkToast) {
    if (!level_.found_shown) return say(status, "Marked", "Marks: " + count + ".");
    if (last_hit_) return say(status, "Found", "Marks: " + count + ".");
    return say(status, "Nothing there", "Marks: " + count + ".", true);
  }
  if (holding_) return say(status, in_start_ ? "Ending the search" : "Marking", "Keep still and keep the pinch.");
  if (touching_) return say(status, "Is it harder here than beside it?", "Pinch to mark the place.");
  say(status, "Feel for what is hidden", "Marks: " + count + ".");
}

void PalpateTask::describe(const TaskInput& input, DirectorStatus& status) const {
  status.cue = Cue::kSearch;
  status.target_index = -1;
  status.targets_done = level_.found_shown ? hits_ : marks_;
  if (level_.found_shown) {
    for (std::size_t i = 0; i < found_.size(); ++i) status.done.set(i, found_[i]);
    status.wrong_places = marks_ - hits_;
  }
  status.hold_progress = hold_.progress();
  status.mark_count = marks_;
  status.marks_T = marked_T_;
  status.exposure = nodules_.empty() ? 0 : static_cast<double>(marks_) / static_cast<double>(nodules_.size());
  if (ended_) return;
  status.grip = {rules_.pad_thickness_m, rules_.pad_n_per_m};
  const WantedForce band{rules_.press_low_n, rules_.press_high_n};
  status.demand = {};
  status.demand.centre_T = centre_T_;
  status.demand.radius_m = std::min(half_x_m_, half_y_m_);
  status.demand.band = band;
  status.demand.object.X_TO.p = centre_T_;
  status.demand.object.size_m = {2 * half_x_m_, 2 * half_y_m_, 0};
  const double force = input.stylus.F_I_T.force.norm();
  status.force_shown = force_shown(display_, touching_ && (force < band.low_n || force > band.high_n));
  hints(input, status);
}

}  // namespace trocar
