// The session: puts device, loop, world, director, hand and recorder together. Runs an attempt, replays a recording,
// grades either. Knows neither the store nor the picture: the commands bring those along.
//
// Lockstep, live and replay differ only in back-end and executor. A grade is always made from the DECODED recording, so
// what is stored and what a regrade computes agree to the bit. Thread: the caller's; a live run starts its own.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "app/session/bookmark.h"
#include "app/session/lanes/pause_switch.h"
#include "app/session/recording/recording_reader.h"
#include "app/session/recording/recording_writer.h"
#include "app/session/setup/scene.h"
#include "haptics/device/backend.h"
#include "scenarios/hands/hand.h"
#include "scenarios/scoring/attempt_result.h"

namespace trocar {

class ThreadedExecutor;  // app/session/lanes/threaded_executor.h

/// What a picture may see of the director: it runs on in another thread.
class DirectorView {
 public:
  DirectorView(const DirectorStatus& status, const Board& board) : status_(status), board_(board) {}
  DirectorView(const Director& director) : DirectorView(director.status(), director.board()) {}
  const DirectorStatus& status() const { return status_; }
  const Board& board() const { return board_; }

 private:
  const DirectorStatus& status_;
  const Board& board_;
};

/// Called with what a picture or a progress line needs: in lockstep at the tissue rate, live when there is time for it.
struct SessionView {
  const Scene& scene;
  const TickRecord& record;
  const DirectorView director;
  double t_s;
  const TissueFrame* tissue = nullptr;  ///< newest frame of the world's objects; nullptr: none known
  SurfacePtr organ_T = nullptr;         ///< newest of the organ; nullptr: as the scene has it
  std::vector<SurfacePtr> thin_T = {};  ///< of the thin parts; empty: as the scene has them
};
using SessionObserver = std::function<void(const SessionView&)>;

/// What a run may be given beside its setup.
struct SessionHooks {
  SessionObserver observe = {};
  /// Live: observe in the tissue task's thread after each of its steps, so that nothing newer can be had. It must not
  /// wait.
  bool observe_each_step = false;
  std::function<bool()> interrupted = {};            ///< asked now and then: true ends the attempt as aborted
  std::function<std::unique_ptr<Hand>()> hand = {};  ///< in place of the one that the setup names
  const MarkCount* marks = nullptr;                  ///< live: each step up is an event of the recording (bookmark.h)
  const MarkCount* messages = nullptr;               ///< likewise, of messages that were shown
  std::function<bool()> board_answers =
      {};  ///< live: while it says no, everything stands still; needs `pause`, and no exam
  std::function<void(const ThreadedExecutor&)> paced = {};  ///< live: told when the run is over, how it was paced
  /// live: told every few seconds how warm the motors are, in the recorder's thread, and at the end in the caller's
  std::function<void(const MotorStates&)> motors = {};
  KeyframeRule keyframes = {};   ///< for playback
  RecordingSeal seal = {};       ///< of record_session(): whose the recording is
  PauseSwitch* pause = nullptr;  ///< live: lets everything stand still, the simulated device too
};

/// What one run of the loop leaves behind, before grading.
struct SessionOutcome {
  AttemptStatus status = AttemptStatus::kAborted;
  std::vector<Event> events;
  RunReport device;
  std::string safety_csv;  ///< the loop's memory of a stop (recorder/safety_file.h), empty without one
  std::uint64_t state_hash = 0;
  std::string state_hash_hex;
  std::uint64_t patch_triangles_dropped = 0;
  std::vector<std::string> notes;  ///< what the trainee or operator should know, a line each
  std::string scoring_json;        ///< what grading must know (scenarios/director/scoring_context.h): summary of END
};

/// An attempt on the back-end that the setup names. @param writer receives every tick and is closed.
/// Live when the setup says so (threads, the clock), else in lockstep, which a back-end with a clock of its own
/// refuses. @throws InputError, EnvironmentError of the writer.
SessionOutcome run_session(const Scene& scene, const AssetRoots& assets, const SessionHooks& hooks,
                           RecordingWriter& writer);
SessionOutcome run_session(const Scene& scene, const AssetRoots& assets, RecordingWriter& writer,
                           const SessionObserver& observe = {}, const std::function<bool()>& interrupted = {});

/// Runs into a file, or into memory when none is given, and reads the recording back: what is graded is what was
/// written.
std::pair<SessionOutcome, Recording> record_session(const Scene& scene, const AssetRoots& assets,
                                                    const SessionHooks& hooks, const std::filesystem::path& file);
std::pair<SessionOutcome, Recording> record_session(const Scene& scene, const AssetRoots& assets,
                                                    const std::filesystem::path& file,
                                                    const SessionObserver& observe = {},
                                                    const std::function<bool()>& interrupted = {});

/// The same loop fed with the recorded device input. @param scene built from the recording's own setup.
SessionOutcome replay_session(const Scene& scene, const Recording& recording, const SessionObserver& observe = {});

/// Before anything of a run is set up. @throws InputError: a script cannot move what the setup names, only a person
/// can.
void require_scripted(const AttemptSetup& setup);
/// Configuration of the simulated back-end of a setup.
SimulatedDaqConfig simulated_device(const AttemptSetup& setup);
/// The back-end that a setup names. @throws InputError when there is none of that name.
Backend setup_backend(const AttemptSetup& setup);

struct GradedRecording {
  Grade grade = {};
  std::vector<Event> events = {};  ///< those of force with their peaks (scenarios/director/event_peaks.h)
};

/// Grade of a recording by its own rubric, or by another exercise file's. The recording is enough: no organ, no device.
/// @param rubric_of exercise whose rubric to use; nullptr: the one embedded in the recording.
GradedRecording grade_recording(const Recording& recording, const std::string& name,
                                const Exercise* rubric_of = nullptr);

/// Saturation and passivity shares, as the run report states them, from the decoded trace.
void fill_shares(const Recording& recording, RunReport& device);

}  // namespace trocar
