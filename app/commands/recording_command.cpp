#include "app/commands/recording_command.h"

#include <cmath>
#include <optional>
#include <ostream>

#include "app/attempt_picture.h"
#include "app/commands/attempt_json.h"
#include "app/commands/open_database.h"
#include "app/commands/run_command.h"
#include "app/executor/state_hash.h"
#include "app/recorded_result.h"
#include "app/recorder/chunk.h"
#include "app/recorder/event_codec.h"
#include "app/recorder/recording_reader.h"
#include "app/session.h"
#include "haptics/input_error.h"
#include "scenarios/exercise_loader.h"
#include "trainees/attempt_store.h"

namespace trocar {
namespace {

constexpr double kSameScore = 1e-9;

/// A recording and, when it was named by an attempt, what the database says of it.
struct Subject {
  std::filesystem::path file;
  Recording recording;
  std::optional<AttemptResult> stored;
};

Subject find_subject(const RecordingOptions& options, std::ostream& err) {
  Subject subject;
  if (std::filesystem::is_regular_file(options.subject)) {
    subject.file = options.subject;
  } else {
    if (options.subject.find('/') != std::string::npos || options.subject.find('.') != std::string::npos) {
      throw InputError(options.subject + ": no such recording");
    }
    Database open = open_database(options.database, OpenMode::kExisting, err);
    subject.stored = AttemptStore(open).load(options.subject);
    subject.file = subject.stored->recording_path;
    if (subject.file.empty()) throw InputError("attempt " + subject.stored->uuid + " was not recorded to a file");
  }
  subject.recording = read_recording(subject.file);
  if (!subject.recording.torn.empty()) err << "trocar: " << subject.file.string() << ": " << subject.recording.torn << '\n';
  if (subject.stored && subject.stored->recording_sha256 != subject.recording.sha256) {
    throw InputError(subject.file.string() + ": the recording is not the one that was graded (its sha256 differs)");
  }
  return subject;
}

Scene recorded_scene(const RecordingOptions& options, const Subject& subject, const AssetRoots& assets) {
  RecordedSetup recorded = parse_scene_json(subject.recording.session, subject.file.string());
  if (!options.organ.empty()) recorded.setup.organ = options.organ;
  // Before anything is laid out on it: another organ may well have no room for the board.
  Organ organ = organ_of(recorded.setup, assets);
  if (organ.sha256 != recorded.organ_sha256) {
    throw InputError(organ.manifest.string() +
                     ": not the organ of the recording (its sha256 differs); name that one with --organ");
  }
  const Scene scene = build_scene(recorded.setup, std::move(organ), recorded.daq);
  if (scene.loop.map.force_scale != recorded.force_scale) {
    throw InputError(subject.file.string() + ": recorded with another force scale than this program computes; it can be "
                     "graded (trocar score) but not replayed");
  }
  return scene;
}

}  // namespace

int replay_command(const RecordingOptions& options, std::ostream& out, std::ostream& err) {
  const AssetRoots assets = find_assets();
  const Subject subject = find_subject(options, err);
  const Scene scene = recorded_scene(options, subject, assets);
  SessionOutcome outcome;
  if (options.frames.empty()) {
    outcome = replay_session(scene, subject.recording);
  } else {
    AttemptPainter painter(scene, assets, subject.stored ? subject.stored->trainee : "");
    FrameWriter frames(painter, options.frames, options.fps);
    outcome = replay_session(scene, subject.recording, [&](const SessionView& view) { frames.observe(view); });
    err << "trocar: " << frames.written() << " frames in " << options.frames.string() << '\n';
  }
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
                     encode_events(outcome.events) == encode_events(subject.recording.events) &&
                     outcome.scoring_json == subject.recording.end->summary_json;
  out << (agree ? "verified: every tick, tissue frame and event agrees\n"
                : "NOT verified: ticks, events or the exercise's numbers differ\n");
  return agree ? 0 : 2;
}

int score_command(const RecordingOptions& options, std::ostream& out, std::ostream& err) {
  const Subject subject = find_subject(options, err);
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
  if (options.json) out << attempt_json(result);
  else print_result(result, out);
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
