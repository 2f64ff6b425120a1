#include "tests/app/window/attempt/runner_samples.h"

#include <unistd.h>

#include <chrono>
#include <thread>

#include "app/session/recording/event_codec.h"
#include "scenarios/files/exercise_loader.h"

namespace trocar {

RunnerFolder::RunnerFolder()
    : path_(std::filesystem::temp_directory_path() / ("runner-" + std::to_string(::getpid()))) {
  std::filesystem::remove_all(path_);
  std::filesystem::create_directories(path_);
}
RunnerFolder::~RunnerFolder() { std::filesystem::remove_all(path_); }

AttemptRequest short_request(const std::filesystem::path& database, const std::string& script) {
  AttemptRequest request;
  std::string text = find_exercise("surface-touch", find_assets().exercises).text;
  text.replace(text.find("count = 12"), 10, "count = 2");
  request.setup.exercise = parse_exercise(text, "short.toml");
  request.setup.organ = "phantom-liver";
  request.setup.hand = script.empty() ? "mouse" : script;
  request.setup.seed = 5;
  request.setup.board = 1;
  request.trainee = "T-1";
  request.database = database;
  request.steered = script.empty();
  return request;
}

bool wait_for(const std::function<bool()>& what) {
  for (int i = 0; i < 6000; ++i) {
    if (what()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

AttemptResult stored_attempt(const std::filesystem::path& file) {
  Database database(file, OpenMode::kExisting);
  return AttemptStore(database).load("latest");
}

bool verified(const std::filesystem::path& file) {
  const Recording recording = read_recording(file);
  if (!recording.end) return false;
  const RecordedSetup recorded = parse_scene_json(recording.session, file.string());
  const Scene scene = build_scene(recorded.setup, find_assets(), recorded.daq);
  const SessionOutcome replayed = replay_session(scene, recording);
  return replayed.state_hash == recording.end->state_hash && replayed.scoring_json == recording.end->summary_json &&
         encode_events(replayed.events) == encode_events(without_marks(recording.events));
}

}  // namespace trocar
