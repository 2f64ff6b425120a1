// One part of a run: what the trainee has to do now, judged from one haptic state per tissue period.
//
// The director strings parts together (discs, then a squeeze; pens; ...) and keeps what all share: start, clock,
// safety, end. Each kind has parts of its own in its room (scenarios/kinds). Frame T, SI units. Deterministic: same
// states in, same events out. Thread: the tissue task's.
#pragma once

#include <string>
#include <vector>

#include "haptics/exchange/stylus_state.h"
#include "scenarios/director/director.h"
#include "scenarios/director/threshold_monitor.h"
#include "scenarios/exercise.h"

namespace trocar {

/// Events so far, stamped with the present time and tip.
struct EventLog {
  std::vector<Event> events;
  double t_s = 0;
  Vec3 tip_T = Vec3::Zero();

  void add(EventType type, Severity severity, std::int32_t object = -1, double value = 0, const std::string& unit = "");
};

/// Clutch or port make the instrument stand still, whatever the hand does.
inline bool frozen(const StylusState& stylus) { return stylus.clutched || stylus.port_held; }

/// What a part is told each period.
struct TaskInput {
  const StylusState& stylus;
  const TissueFrame* tissue = nullptr;  ///< objects of the world; nullptr when it has none
  double dt_s = 0;
  bool too_hard = false;  ///< contact above the hard limit, not yet eased off

  /// A period of a hold, which begins anew where the instrument stands still. @return true once it is complete
  bool held(HoldTimer& hold, bool inside) const {
    if (!frozen(stylus)) return hold.update(inside, dt_s);
    hold.reset();
    return false;
  }
};

class ExerciseTask {
 public:
  virtual ~ExerciseTask() = default;
  /// The part begins now: it may ask for its first object.
  virtual void begin(EventLog& log) = 0;
  virtual void update(const TaskInput& input, EventLog& log) = 0;
  /// In place of update() once it is finished and later parts run: what is undone of it.
  virtual void keep_watch(const TaskInput&, EventLog&) {}
  virtual bool finished() const = 0;
  /// Object that the trainee is busy with, -1 when none: events of the safety watch name it.
  virtual std::int32_t object() const = 0;
  /// Writes what screen and hand shall see: cue, demand, progress, counts, message. Other fields are the director's.
  virtual void describe(const TaskInput& input, DirectorStatus& status) const = 0;
};

/// Sets message, hint and warning.
void say(DirectorStatus& status, const std::string& message, const std::string& hint, bool warning = false);

/// The same, that another instrument is to be taken in hand.
void say_take(DirectorStatus& status, InstrumentKind instrument);

/// Is a measured force shown now? @param display always | band | after. @param outside the wanted band, while it
/// matters.
bool force_shown(const std::string& display, bool outside);

/// "0.4 to 0.8 N", "0.45 to 0.75 N"
std::string band_text(const WantedForce& band);

}  // namespace trocar
