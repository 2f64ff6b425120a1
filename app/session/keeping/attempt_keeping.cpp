#include "app/session/keeping/attempt_keeping.h"

#include <unistd.h>

#include "app/session/grading/recorded_result.h"
#include "app/session/recording/safety_file.h"
#include "haptics/digest/digest.h"
#include "haptics/input_error.h"

namespace trocar {
namespace {

/// What the loop remembers of a stop, beside the recording. @return the file, empty without one.
std::string keep_stop(const AttemptId& id, const SessionOutcome& outcome) {
  if (outcome.safety_csv.empty() || id.recording.empty()) return "";
  const std::filesystem::path file = safety_file_of(id.recording);
  write_safety_file(file, outcome.safety_csv);
  return file.string();
}

/// The machine's name in its network.
std::string station_name() {
  char name[256] = "";
  return gethostname(name, sizeof name - 1) == 0 ? name : "";
}

}  // namespace

AttemptStart attempt_start(const Scene& scene, const std::string& trainee, const std::string& session) {
  AttemptStart start;
  start.trainee = trainee;
  start.exercise_id = scene.setup.exercise.id;
  start.exercise_version = scene.setup.exercise.version;
  start.exercise_number = scene.setup.exercise.number;
  start.exercise_title = scene.setup.exercise.title;
  start.program = program_of_record();
  start.exercise_text = scene.setup.exercise.text;
  start.level = scene.level.name;
  start.seed = scene.setup.seed;
  start.board = scene.setup.board;
  start.hand = scene.setup.hand;
  if (!scene.loop.daq.motors) start.assists = pointer_assists(scene.level);
  start.organ_name = scene.organ.name;
  start.organ_source = scene.organ.source_file;
  start.organ_sha256 = scene.organ.sha256;
  start.organ_credit = scene.organ.credit;
  start.organ_synthetic = scene.organ.synthetic;
  if (scene.setup.device.calibration) {
    start.calibration = scene.setup.device.calibration->text;
    start.calibration_device = "simulated";
  }
  start.session = session;
  start.station = session.empty() ? "" : station_name();
  return start;
}

std::pair<SessionOutcome, Recording> record_or_abort(AttemptStore& store, const AttemptId& id, const Scene& scene,
                                                     const AssetRoots& assets, const SessionHooks& hooks) {
  SessionHooks bound = hooks;
  bound.seal = {id.identity, id.key};
  try {
    return record_session(scene, assets, bound, id.recording);
  } catch (const EnvironmentError& error) {
    AttemptResult result;
    result.grade.grade = "not graded";
    result.integrity = error.what();
    if (std::filesystem::is_regular_file(id.recording))
      result.recording_sha256 = digest::of_readable_file(id.recording);
    try {
      store.finish_attempt(id, result);
    } catch (const EnvironmentError&) {
      // The same disk: the attempt is ended as aborted when the database is next opened. The first reason is the news.
    }
    throw;
  }
}

AttemptResult kept_result(const AttemptStart& start, const AttemptId& id, const SessionOutcome& outcome,
                          const Recording& recording) {
  AttemptResult result = recorded_result(recording, id.recording);
  result.uuid = id.uuid;
  result.started_utc = id.started_utc;
  result.exercise_id = start.exercise_id;
  result.exercise_version = start.exercise_version;
  result.level = start.level;
  result.seed = start.seed;
  result.board = start.board;
  result.trainee = start.trainee;
  result.hand = start.hand;
  result.assists = start.assists;
  result.organ_name = start.organ_name;
  result.organ_source = start.organ_source;
  result.organ_sha256 = start.organ_sha256;
  result.organ_credit = start.organ_credit;
  result.organ_synthetic = start.organ_synthetic;
  result.rubric_sha256 = id.rubric_sha256;
  result.safety_log_path = keep_stop(id, outcome);
  return result;
}

void store_or_say(AttemptStore& store, const AttemptId& id, const AttemptResult& result) {
  try {
    store.finish_attempt(id, result);
  } catch (const EnvironmentError& error) {
    if (id.recording.empty()) throw;
    std::string score = status_name(result.grade.status);
    if (result.grade.score) score += ", score " + std::to_string(*result.grade.score);
    throw EnvironmentError(std::string(error.what()) + "\ntrocar: the attempt was not stored (" + score +
                           "); its recording " + id.recording.string() +
                           " holds the result, on which a person can decide at the desk");
  }
}

}  // namespace trocar
