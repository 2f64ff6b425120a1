// One attempt of a person, live, in threads of its own: the window looks at its newest moment and steers the hand.
//
//   AttemptRunner run(request, assets);          // begins: store, loop, recorder
//   while (!run.finished()) { run.steer(intent); draw(run.newest()); }
//   run.result();                                 // graded and stored, or throws what went wrong
//
// The 1 kHz loop never waits for a picture. Whatever its end, the attempt is kept as `trocar run` keeps it: recorded to
// disk twice a second, graded from the recording, stored; a database that is busy at the end is asked again until the
// runner goes. What is not graded (tutorial, free play) leaves nothing behind. Threads: all members from the window's
// thread; the attempt owns the others.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/session/run_moment.h"
#include "app/session/setup/scene.h"
#include "app/window/input/input_event.h"
#include "scenarios/hands/hand.h"
#include "scenarios/scoring/attempt_result.h"

namespace trocar {

class StepGate;

struct AttemptRequest {
  AttemptSetup setup = {};  ///< realtime; `hand` is the input's name ("mouse") or a scripted one
  std::string trainee = "guest";
  std::string session = {};             ///< UUID of their sign-in here
  std::filesystem::path database = {};  ///< as RunOptions::database
  bool steered = true;                  ///< a person's intents move the hand; false: the script that setup names
  StepGate* steps = nullptr;  ///< time passes as it says, not by the clock; no pause then. Outlives the runner
  bool graded = true;         ///< false: nothing is recorded, graded or stored, whatever the database
};

class AttemptRunner {
 public:
  /// Builds the scene and starts; live, whatever the setup says, unless the request has a gate. @throws InputError,
  /// EnvironmentError (disk nearly full, database busy) before anything is stored.
  AttemptRunner(const AttemptRequest& request, const AssetRoots& assets);
  /// The same on a scene that has been built already.
  AttemptRunner(const AttemptRequest& request, const AssetRoots& assets, std::shared_ptr<const Scene> scene);
  /// Aborts what still runs, and waits for it: graded, and stored if the database takes it at once.
  ~AttemptRunner();

  const Scene& scene() const;
  std::shared_ptr<const Scene> shared_scene() const;
  /// The newest moment; its reference stays until the next call.
  const RunMoment& newest();
  /// @return number of the intent, from 1: RunMoment::steered tells when the device has felt it.
  std::uint64_t steer(const HandIntent& intent);
  /// Whether the hand moves: the device is active. Before, intents wait.
  bool ready() const;
  /// Where the hand pulls to now: the newest intent, or what its speed has let it reach of that.
  const HandIntent& target();
  /// Everything stands still, simulated device and clock of the exercise too; nothing is lost, and the run report says
  /// when and how long. An exam has no pause. @return whether it is as asked.
  bool pause(bool paused);
  bool paused() const;
  /// The newest moment becomes an event of the recording, to find it again (app/session/bookmark.h).
  void mark();
  /// The newest moment becomes an event too: a teacher's message was shown then.
  void mark_message();
  /// UUID under which it is kept.
  const std::string& attempt() const;
  /// The cable of the simulated board: out, the board answers nothing and the attempt stands still as in a pause, with
  /// all it holds; in, it goes on unless a person's pause holds it. @return whether it is as asked: an exam has no
  /// pause, there a silent board is a fault.
  bool plug(bool in);
  bool board_answers() const;
  void abort();
  /// The result is there (stored or not).
  bool finished() const;
  /// The database has it.
  bool stored() const;
  /// After finished(), or after abort(): then it waits for the end. @throws what ended the run if it was no grade.
  const AttemptResult& result() const;
  /// Lines for the trainee (late loop, organ small): of the run so far.
  std::vector<std::string> notes() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace trocar
