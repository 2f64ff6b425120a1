// The scripted expert's attempt, again and again: behind the start page, until somebody comes.
//
// The recording is made in the background at the very first start and cached (expert_run.h); until it can be seen
// ready() is false and the page shows its still scene. Nothing begins in the first seconds, so that the first frame,
// and a person who is quick, come first. Frame T, SI. Thread: the window's.
#pragma once

#include <optional>

#include "app/picture/scene/scene_view.h"
#include "app/session/playback/expert_run.h"
#include "app/session/playback/recorded_run.h"

namespace trocar {

class FilmLoop {
 public:
  static constexpr double kPatience_s = 2;  ///< before anything is begun
  static constexpr double kRest_s = 2;      ///< the end is seen, before it begins again

  /// @param what exercise, level, organ and board of the attempt.
  FilmLoop(const AttemptSetup& what, const AssetRoots& assets);
  ~FilmLoop();

  /// Time goes on, and the work in the background is looked after. Never waits for it.
  void advance(double dt_s);
  bool ready() const;
  /// The moment that is shown. Only when ready().
  SceneView view() const;
  const Scene& scene() const;
  double clock_s() const { return clock_s_; }  ///< since RUN began; the rest at the end counts
  /// What hindered it; empty while nothing has.
  std::string refusal() const;

 private:
  AttemptSetup setup_;
  AssetRoots assets_;
  ExpertRun expert_;
  std::optional<RecordedRun> run_;
  bool ready_ = false;
  double waited_s_ = 0, clock_s_ = 0;
};

}  // namespace trocar
