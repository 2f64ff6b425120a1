#include "app/cli/attempts/recording_command.h"

#include <cmath>
#include <iostream>
#include <memory>
#include <optional>

#include <CLI/CLI.hpp>

#include "app/cli/attempts/attempt_json.h"
#include "app/cli/attempts/recording_subject.h"
#include "app/cli/attempts/replay_film.h"
#include "app/cli/attempts/run_command.h"
#include "app/cli/command.h"
#include "app/cli/records/export_command.h"
#include "app/picture/attempt/attempt_picture.h"
#include "app/picture/films/video_writer.h"
#include "app/session/grading/recorded_result.h"
#include "app/session/lanes/state_hash.h"
#include "app/session/playback/recorded_run.h"
#include "app/session/recording/chunk.h"
#include "app/session/recording/event_codec.h"
#include "app/session/session.h"
#include "app/session/setup/recorded_scene.h"
#include "haptics/input_error.h"
#include "scenarios/director/scoring_context.h"
#include "scenarios/files/exercise_loader.h"

namespace trocar {
namespace {

constexpr double kSameScore = 1e-9;
constexpr double kPicturesPerSecond = 10;
constexpr double kMoment_s = 0.01;

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

/// The same pictures from keyframes.
void play_plainly(const RecordingOptions& options, const Subject& subject, const AssetRoots& assets,
                  std::ostream& err) {
  const RecordedRun run(subject.file, assets, options.organ);
  AttemptPainter painter(assets, subject.stored ? subject.stored->trainee : "", options.width, options.height);
  FrameWriter frames(painter, options.frames, options.fps.value_or(kPicturesPerSecond));
  for (double t_s = run.at(0).t_s; t_s <= run.end_s(); t_s += kMoment_s)
    frames.observe(view_of(run.scene(), run.at(t_s)));
  err << "trocar: " << frames.written() << " frames in " << options.frames.string() << '\n';
}

/// Pictures are played from keyframes where there are any; the loop is run where it must be. @return what it left.
std::optional<SessionOutcome> replayed(const RecordingOptions& options, const Subject& subject,
                                       const AssetRoots& assets, std::ostream& err) {
  const bool keyframes = !subject.recording.tissue.empty();
  std::optional<SessionOutcome> outcome;
  if (is_film(options))
    outcome = replay_as_film(options, subject, assets, err);
  else if (keyframes && !options.frames.empty())
    play_plainly(options, subject, assets, err);
  else
    return replay_plainly(options, subject, assets, err);
  if (outcome || !options.verify) return outcome;
  return replay_session(recorded_scene(subject.recording, subject.file, assets, options.organ), subject.recording);
}

/// Numbers of the exercise; a recording may be from before some were kept.
bool same_context(const std::string& made, const std::string& recorded) {
  if (made == recorded) return true;
  ScoringContext now = parse_scoring_context(made, "replay");
  const ScoringContext then = parse_scoring_context(recorded, "recording");
  if (then.counted_hold_s == 0) now.counted_hold_s = 0;
  return now == then;
}

}  // namespace

int replay_command(const RecordingOptions& options, std::ostream& out, std::ostream& err) {
  const AssetRoots assets = find_assets();
  if (!options.video.empty()) check_video_file(options.video);  // before minutes of work
  const Subject subject = find_subject(options.subject, options.database, err);
  const std::optional<SessionOutcome> ran = replayed(options, subject, assets, err);
  if (!ran) return 0;
  const SessionOutcome& outcome = *ran;
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
                     same_context(outcome.scoring_json, subject.recording.end->summary_json);
  out << (agree ? "verified: every tick, tissue frame and event agrees\n"
                : "NOT verified: ticks, events or the exercise's numbers differ\n");
  return agree ? 0 : 2;
}

int score_command(const RecordingOptions& options, std::ostream& out, std::ostream& err) {
  const Subject subject = find_subject(options.subject, options.database, err);
  std::optional<Exercise> other;
  if (!options.rubric.empty()) other = load_exercise(options.rubric);
  AttemptResult result = subject.stored.value_or(AttemptResult{});
  GradedRecording graded = grade_recording(subject.recording, subject.file.string(), other ? &*other : nullptr);
  result.grade = std::move(graded.grade);
  result.events = std::move(graded.events);
  result.recording_sha256 = subject.recording.sha256;
  result.recording_path = subject.file.string();
  result.device.stiffness = recorded_stiffness(subject.recording, subject.file.string());
  if (!subject.stored) {
    const RecordedSetup recorded = parse_scene_json(subject.recording.session, subject.file.string());
    result.exercise_id = recorded.setup.exercise.id;
    result.exercise_version = recorded.setup.exercise.version;
    result.level = recorded.setup.level;
    result.seed = recorded.setup.seed;
    result.board = recorded.setup.board;
    result.hand = recorded.setup.hand;
    if (!recorded.daq.motors)
      result.assists = pointer_assists(find_level(recorded.setup.exercise, recorded.setup.level));
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
    if (subject.stored->cut_off) {
      err << "trocar: its program ended before this was stored: the attempt counts as aborted, until a person decides "
             "on it at the desk\n";
      return exit_code(result);
    }
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

namespace {

void add_subject(CLI::App& command, RecordingOptions& o) {
  command.add_option("recording", o.subject, "Recording file or attempt (UUID part, 'latest')")->required();
  command.add_option("--db", o.database, "Database file");
}

struct ScoreArguments {
  RecordingOptions recording;
  std::string jigsaws_side;
};

int run_score(const ScoreArguments& given) {
  if (given.jigsaws_side.empty()) return score_command(given.recording, std::cout, std::cerr);
  return kinematics_command({given.recording.subject, given.jigsaws_side, given.recording.json}, std::cout);
}

}  // namespace

void add_replay(CLI::App& parent, CommandAction& chosen) {
  const auto given = std::make_shared<RecordingOptions>();
  RecordingOptions& o = *given;
  CLI::App* replay = add_command(parent, "replay", "Run the loop again from a recording", chosen,
                                 [given] { return replay_command(*given, std::cout, std::cerr); });
  replay->add_flag("--verify", o.verify, "Compare the state hash with the recorded one");
  replay->add_option("--frames", o.frames, "Folder for PNG frames")->check(writable_path());
  replay->add_option("--video", o.video, "Film: FILE.mp4, .webm or .mkv, by ffmpeg")->check(writable_path());
  replay->add_option("--fps", o.fps, "Frames per second (default: 10, of a film 25)")->check(CLI::Range(0.1, 60.0));
  replay->add_option("--speed", o.speed, "Of the film: 0.25 is slow motion, 4 four times as fast")
      ->capture_default_str()
      ->check(CLI::Range(0.05, 20.0));
  replay->add_option("--width", o.width, "Of the pictures, px: from 320, with --beside from 720")
      ->capture_default_str()
      ->check(CLI::Range(320, 7680));
  replay->add_option("--height", o.height, "Of the pictures, px: from 240, with --beside from 400")
      ->capture_default_str()
      ->check(CLI::Range(240, 4320));
  replay
      ->add_option("--preset", o.preset,
                   "Of a film's pictures: low, soft, full, or auto: full, and soft where no GPU draws")
      ->capture_default_str()
      ->check(CLI::IsMember({"auto", "low", "soft", "full"}));
  replay->add_option("--beside", o.beside, "Second run in the same film: recording, attempt, or 'expert'")
      ->check(file_name());
  replay->add_option("--organ", o.organ, "Where the recorded organ lies now");
  add_subject(*replay, o);
}

void add_score(CLI::App& parent, CommandAction& chosen) {
  const auto given = std::make_shared<ScoreArguments>();
  RecordingOptions& o = given->recording;
  CLI::App* score =
      add_command(parent, "score", "Grade again from the raw record", chosen, [given] { return run_score(*given); });
  CLI::Option* rubric = score->add_option("--rubric", o.rubric, "Exercise file whose rubric to use instead");
  score
      ->add_option("--jigsaws", given->jigsaws_side,
                   "Not a recording but kinematics of 76 columns: motion metrics of the right or left tool")
      ->check(CLI::IsMember({"right", "left"}))
      ->excludes(rubric);
  score->add_flag("--json", o.json, "Result as JSON on stdout");
  add_subject(*score, o);
}

}  // namespace trocar
