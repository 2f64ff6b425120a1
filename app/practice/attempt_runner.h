// One attempt of a person, live, in threads of its own: the window looks at its newest moment and steers the hand.
//
//   AttemptRunner run(request, assets);          // begins: store, loop, recorder
//   while (!run.finished()) { run.steer(intent); draw(run.newest()); }
//   run.result();                                 // graded and stored, or throws what went wrong
//
// The 1 kHz loop never waits for a picture. Threads: all members from the window's thread; the attempt owns the others.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "app/input/input_event.h"
#include "app/run_moment.h"
#include "app/scene.h"
#include "haptics/device/hand.h"
#include "scenarios/scoring/attempt_result.h"

namespace trocar {

struct AttemptRequest {
  AttemptSetup setup = {};                    ///< realtime; `hand` is the input's name ("mouse") or a scripted one
  std::string trainee = "guest";
  std::filesystem::path database = {};        ///< as RunOptions::database
  bool steered = true;                        ///< a person's intents move the hand; false: the script that setup names
};

class AttemptRunner {
 public:
  /// Builds the scene and starts. @throws InputError, EnvironmentError before anything is stored.
  AttemptRunner(const AttemptRequest& request, const AssetRoots& assets);
  /// Aborts what still runs, and waits for it.
  ~AttemptRunner();

  const Scene& scene() const;
  /// The newest moment; its reference stays until the next call.
  const RunMoment& newest();
  void steer(const HandIntent& intent);
  /// Everything stands still, device and clock of the exercise too; nothing is lost.
  void pause(bool paused);
  bool paused() const;
  void abort();
  bool finished() const;
  /// After finished(). @throws what ended the run if it was no grade.
  const AttemptResult& result() const;
  /// Lines for the trainee (late loop, organ small): of the run so far.
  std::vector<std::string> notes() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace trocar
