#include "scenarios/kinds/camera/camera_task.h"

#include <algorithm>
#include <cmath>

#include "scenarios/kinds/camera/scope_view.h"

namespace trocar {
namespace {

constexpr double kLensRadius = 0.0025;  // m: the end of the shaft
constexpr double kWallRearm = 0.3;      // s free of it until a contact counts as new
constexpr double kWallRepeat = 1.0;     // s of staying in contact that count as one more
constexpr double kEach = 2.0 / 3;       // of the middle's circle that place and turn may each take, as told to a hand
constexpr double kToastOfWall = 0.5;    // of the monitor: just touched

}  // namespace

CameraTask::CameraTask(const Exercise& exercise, const ExerciseLevel& level, const std::vector<Target>& poses)
    : rules_(own_rules<CameraRules>(exercise)),
      level_(own_rules<CameraLevel>(level)),
      R_IC_(picture_in_instrument(own_rules<CameraLevel>(level).tilt_rad)),
      coached_(level.force_display != "after"),
      poses_(poses),
      accounts_(poses.size()),
      hold_(exercise.hold_s, kHoldGrace),
      wall_(kToastOfWall, kToastOfWall, kWallRearm, kWallRepeat) {
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    cups_.push_back(cup_of(poses_[i], rules_, own_rules<CameraLevel>(level)));
    waiting_.push_back(static_cast<std::int32_t>(i));
  }
}

void CameraTask::begin(EventLog& log) { light(log); }

void CameraTask::light(EventLog& log) {
  hold_.reset();
  motion_.restart();
  lit_at_s_ = log.t_s;
  lost_for_s_ = 0;
  if (!finished()) log.add(event_type::kTargetLit, Severity::kInfo, object());
}

CameraTask::Sight CameraTask::look(const Pose& X_TI) const {
  const Cup& cup = cups_[static_cast<std::size_t>(object())];
  const Mat3 R_TC = X_TI.R * R_IC_;
  const Vec3 way = cup.sphere_T - X_TI.p;
  Sight sight;
  sight.distance_m = way.norm();
  sight.sphere_C = R_TC.transpose() * way / std::max(1e-9, sight.distance_m);
  sight.off_middle_rad = std::atan2(sight.sphere_C.head<2>().norm(), sight.sphere_C.z());
  sight.horizon_rad = horizon_of(R_TC).value_or(0);
  sight.whole = cup.shows_sphere(X_TI.p);
  return sight;
}

bool CameraTask::good(const Sight& sight) const {
  return sight.whole && sight.off_middle_rad <= level_.centre_rad && sight.distance_m >= rules_.nearest_m &&
         sight.distance_m <= rules_.farthest_m && std::abs(sight.horizon_rad) <= level_.horizon_rad;
}

void CameraTask::watch_horizon(const TaskInput& input, EventLog& log) {
  Account& account = accounts_[static_cast<std::size_t>(object())];
  if (std::abs(sight_.horizon_rad) <= level_.horizon_rad) {
    if (!frozen(input.stylus)) account.level_s += input.dt_s;
    lost_for_s_ = 0;
    return;
  }
  account.rolled_s += input.dt_s;
  lost_for_s_ += input.dt_s;
  if (lost_for_s_ < rules_.lost_s) return;
  lost_for_s_ = 0;
  log.add(event_type::kHorizonLost, Severity::kMinor, object(), std::abs(sight_.horizon_rad), "rad");
}

void CameraTask::watch_walls(const TaskInput& input, EventLog& log) {
  const Vec3& lens = input.stylus.X_TI.p;
  const bool touches = input.stylus.contact || std::any_of(cups_.begin(), cups_.end(), [&](const Cup& cup) {
                         return cup.distance_m(lens) <= kLensRadius;
                       });
  if (!wall_.update(touches ? 1 : 0, input.dt_s)) return;
  ++walls_;
  log.add(event_type::kWallContact, Severity::kMinor, object(), input.stylus.V_TI_T.linear.norm(), "m/s");
}

/// Of all the time that this sphere has been lit.
void CameraTask::account(EventLog& log) {
  const Account& account = accounts_[static_cast<std::size_t>(object())];
  const double level = std::min(account.level_s, rules_.counted_s), all = level + account.rolled_s;
  log.add(event_type::kHorizonKept, Severity::kInfo, object(), all > 0 ? level / all : 0, "1");
  log.add(event_type::kViewJerks, Severity::kInfo, object(), account.jerks, "1");
}

void CameraTask::update(const TaskInput& input, EventLog& log) {
  if (finished()) return;
  sight_ = look(input.stylus.X_TI);
  if (motion_.update(sight_.sphere_C, input.dt_s)) ++accounts_[static_cast<std::size_t>(object())].jerks;
  watch_horizon(input, log);
  watch_walls(input, log);
  if (input.held(hold_, good(sight_))) {
    log.add(event_type::kTargetHeld, Severity::kInfo, object(), log.t_s - lit_at_s_, "s");
    account(log);
    waiting_.pop_front();
    return light(log);
  }
  if (log.t_s - lit_at_s_ < rules_.timeout_s) return;
  ++timeouts_;
  log.add(event_type::kTargetTimeout, Severity::kMinor, object(), rules_.timeout_s, "s");
  account(log);
  waiting_.push_back(waiting_.front());
  waiting_.pop_front();
  light(log);
}

void CameraTask::hints(DirectorStatus& status) const {
  const std::string count =
      "Sphere " + std::to_string(status.targets_done + 1) + " of " + std::to_string(cups_.size()) + ".";
  if (wall_.above()) return say(status, "The lens touches", "Draw the scope back.", true);
  if (hold_.progress() > 0 || good(sight_)) return say(status, "Good - hold", count);
  if (!coached_ || sight_.off_middle_rad > level_.centre_rad)
    return say(status, "Bring the lit sphere into the ring", count);
  if (sight_.distance_m < rules_.nearest_m) return say(status, "Draw the scope back", "It is too near.");
  if (sight_.distance_m > rules_.farthest_m) return say(status, "Go nearer", "It is too far away.");
  if (!sight_.whole) return say(status, "Look along the cup", "Its wall hides the sphere.");
  say(status, "Level the picture", "The tick at the rim is up.");
}

void CameraTask::describe(const TaskInput&, DirectorStatus& status) const {
  status.targets_done = static_cast<int>(cups_.size() - waiting_.size());
  status.target_index = object();
  for (std::size_t i = 0; i < cups_.size(); ++i) status.done.set(i);
  for (const std::int32_t cup : waiting_) status.done.reset(static_cast<std::size_t>(cup));
  status.timeouts = timeouts_;
  status.wrong_places = walls_;
  status.hold_progress = hold_.progress();
  status.cue = Cue::kOrient;
  status.force_shown = false;
  if (finished()) return;
  const Target& pose = poses_[static_cast<std::size_t>(object())];
  const Cup& cup = cups_[static_cast<std::size_t>(object())];
  status.demand = {pose.centre_T,
                   pose.normal_T,
                   kEach * level_.centre_rad * rules_.drawn_m,
                   true,
                   pose.R_TI,
                   kEach * level_.centre_rad,
                   {}};
  status.demand.object = {{Mat3::Identity(), cup.sphere_T}, Vec3::Constant(rules_.sphere_m)};
  status.demand.goal_T = cup.sphere_T;
  status.position_error_m = sight_.distance_m;
  status.angle_error_rad = sight_.off_middle_rad;
  status.horizon_rad = sight_.horizon_rad;
  hints(status);
}

}  // namespace trocar
