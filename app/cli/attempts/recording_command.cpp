#include "app/cli/attempts/recording_command.h"

#include <cmath>
#include <optional>
#include <ostream>

#include "app/cli/attempts/attempt_json.h"
#include "app/cli/attempts/recording_subject.h"
#include "app/cli/attempts/replay_film.h"
#include "app/cli/attempts/run_command.h"
#include "app/picture/attempt/attempt_picture.h"
#include "app/picture/films/video_writer.h"
#include "app/session/grading/recorded_result.h"
#include "app/session/lanes/state_hash.h"
#include "app/session/recording/chunk.h"
#include "app/session/recording/event_codec.h"
#include "app/session/session.h"
#include "app/session/setup/recorded_scene.h"
#include "haptics/input_error.h"
#include "scenarios/files/exercise_loader.h"

namespace trocar {
namespace {

constexpr double kSameScore = 1e-9;
constexpr double kPicturesPerSecond = 10;

/// Once, with pictures at the times of `trocar run --frames`.
SessionOutcome replay_plainly(const RecordingOptions& options, const Subject& subject, const AssetRoots& assets,
                              std::ostream& err) {
  const Scene scene = recorded_scene(subject.recording, subject.file, assets, options.organ);
  if (options.frames.empty()) return replay_session(scene, subject.recording);
  AttemptPainter painter(assets, subject.stored ? subject.stored->trainee : "", options.width, options.height);
  FrameWriter frames(painter, options.frames, options.fps.value_or(kPicturesPerSecond));
  const SessionOutcome outcome =
      replay_session(scene, subject.recording, [&](const SessionView& view) { frames.observe(view); });
  err << "trocar: " << frames.written() << " frames in " << options.frames.string() << '\n';
  return outcome;
}

}  // namespace

int replay_command(const RecordingOptions& options, std::ostream& out, std::ostream& err) {
  const AssetRoots assets = find_assets();
  if (!options.video.empty()) check_video_file(options.video);  // before minutes of work
  const Subject subject = find_subject(options.subject, options.database, err);
  const SessionOutcome outcome =
      is_film(options) ? replay_as_film(options, subject, assets, err) : replay_plainly(options, subject, assets, err);
  out << "ticks     " << outcome.device.ticks << '\n' << "replayed  " << outcome.state_hash_hex << '\n';
  if (!options.verify) return 0;
  if (subject.recording.version < kOldestVerifiable) {
    throw InputError(subject.file.string() + ": has recording format " + std::to_string(subject.recording.version) +
                     ", whose state hash was formed otherwise: it can be replayed and graded but not verified");
  }
  if (!subject.recording.end) throw InputError(subject.file.string() + ": has no end, so there is no hash to verify");
  StateHash recorded(subject.recording.end->state_hash);
  out << "recorded  " << recorded.hex() << '\n';
  const bool agree = outcome.state_hash == subject.recording.end->state_hash &&
                     encode_events(outcome.events) == encode_events(without_marks(subject.recording.events)) &&
                     outcome.scoring_json == subject.recording.end->summary_json;
  out << (agree ? "verified: every tick, tissue frame and event agrees\n"
                : "NOT verified: ticks, events or the exercise's numbers differ\n");
  return agree ? 0 : 2;
}

int score_command(const RecordingOptions& options, std::ostream& out, std::ostream& err) {
  const Subject subject = find_subject(options.subject, options.database, err);
  std::optional<Exercise> other;
  if (!options.rubric.empty()) other = load_exercise(options.rubric);
  AttemptResult result = subject.stored.value_or(AttemptResult{});
  result.grade = grade_recording(subject.recording, subject.file.string(), other ? &*other : nullptr);
  result.events = subject.recording.events;
  result.recording_sha256 = subject.recording.sha256;
  result.recording_path = subject.file.string();
  fill_stiffness(subject.recording, subject.file.string(), result.device);
  if (!subject.stored) {
    const RecordedSetup recorded = parse_scene_json(subject.recording.session, subject.file.string());
    result.exercise_id = recorded.setup.exercise.id;
    result.exercise_version = recorded.setup.exercise.version;
    result.level = recorded.setup.level;
    result.seed = recorded.setup.seed;
    result.board = recorded.setup.board;
    result.hand = recorded.setup.hand;
    result.organ_sha256 = recorded.organ_sha256;
    fill_shares(subject.recording, result.device);
    result.rubric_sha256 = recorded.setup.exercise.rubric.sha256;
    if (subject.recording.end) result.state_hash = StateHash(subject.recording.end->state_hash).hex();
  }
  if (other) result.rubric_sha256 = other->rubric.sha256;
  if (options.json)
    out << attempt_json(result);
  else
    print_result(result, out);
  if (subject.stored && !other) {
    const auto& before = subject.stored->grade.score;
    const auto& now = result.grade.score;
    if (before.has_value() != now.has_value() || (before && std::abs(*before - *now) > kSameScore)) {
      err << "trocar: the stored score " << (before ? std::to_string(*before) : "none")
          << " is not what the recording gives\n";
      return 2;
    }
    err << "trocar: equal to the stored score\n";
  }
  return exit_code(result);
}

}  // namespace trocar
