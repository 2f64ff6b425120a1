// What the desk's live view is told of an attempt while it runs: from the moments that pictures are made of, never from
// the loop.
//
// Events are seen in the director's counts from one moment to the next. The rate is that of the loop's periods against
// the clock. Thread: that in which the moments are shown: the window's, or the session's observer.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>

#include "app/session/session.h"
#include "trainees/live/live_publisher.h"

namespace trocar {

/// Of an attempt, as far as it is known before it runs. @param program "practice window", "trocar run".
LiveMoment live_beginning(const Scene& scene, const std::string& program, const std::string& trainee,
                          const std::string& attempt);

class LiveAttempt {
 public:
  using Clock = std::chrono::steady_clock;

  explicit LiveAttempt(LiveMoment beginning) : moment_(std::move(beginning)) {}

  /// Each moment that is shown. @param now of the clock
  void see(const SessionView& view, bool paused, Clock::time_point now);
  /// Before anything was seen.
  void see_paused() { moment_.phase = "paused"; }
  const LiveMoment& moment() const { return moment_; }

 private:
  struct Counts {
    int done = 0, wrong = 0, excess = 0, timeouts = 0;
  };
  void see_events(const DirectorStatus& status);
  void see_rate(const StylusState& stylus, bool paused, Clock::time_point now);
  void add(double t_s, const char* what, bool grave);

  LiveMoment moment_;
  Counts counts_;
  Phase phase_ = Phase::kReady;
  double peak_n_ = 0, peak_grip_n_ = 0;
  std::uint64_t rate_period_ = 0;
  Clock::time_point rate_at_ = {};
};

/// An observer that tells a desk of the run and hands every moment on. @param next may be empty.
SessionObserver told_live(LivePublisher& publisher, LiveAttempt& attempt, SessionObserver next);

}  // namespace trocar
