#include "app/screens/practice_desk.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <future>
#include <random>
#include <thread>

#include "app/graphics/show_scene.h"
#include "app/playback/expert_run.h"
#include "app/recorded_result.h"
#include "haptics/input_error.h"
#include "scenarios/board_numbers.h"
#include "scenarios/exercise_loader.h"
#include "trainees/attempt_identity.h"
#include "trainees/trainee_store.h"

namespace trocar {
namespace {

constexpr const char* kGuest = "guest";
constexpr int kBusy_ms = 2000;
constexpr int kStoring_ms = 500;   // that a result may take to the database before the person is told

/// Of LANG, when there is a catalogue for it.
std::string language_of_machine(const std::filesystem::path& folder) {
  for (const char* name : {"LC_ALL", "LC_MESSAGES", "LANG"}) {
    const char* value = std::getenv(name);
    if (value == nullptr || *value == '\0') continue;
    const std::string code = std::string(value).substr(0, 2);
    return std::filesystem::is_regular_file(folder / (code + ".toml")) ? code : "en";
  }
  return "en";
}

}  // namespace

struct PracticeDesk::State {
  DeskOptions options;
  AssetRoots assets;
  std::vector<Exercise> exercises;
  Settings settings, followed;                 // as they are; as they were when they were last taken up
  Words words;
  KeyMap keys;
  std::unique_ptr<Steering> steering;
  std::unique_ptr<Sound> sound;
  bool sound_wanted = true;
  std::unique_ptr<Database> database;
  std::string trainee = kGuest, session = make_uuid();  // of a sign-in
  std::unique_ptr<AttemptRunner> runner;
  std::vector<std::unique_ptr<AttemptRunner>> unstored;   // over, but the database has not taken them yet
  std::optional<AttemptResult> result;
  std::shared_ptr<const Scene> last_scene;
  std::vector<AttemptSummary> unkept;          // of this sitting, newest first, when nothing is kept
  std::vector<PastAttempt> unkept_numbers;     // the same with their metrics
  ExpertRun expert;
  std::shared_future<std::shared_ptr<const SceneView>> show_scene;

  std::filesystem::path settings_file_path() const { return options.settings.empty() ? settings_file() : options.settings; }
  void take_up(std::string& notice);
  void open_database(std::string& notice);
  std::vector<AttemptSummary> attempts(const std::string& exercise) const;
  std::int64_t seed() const;
};

void PracticeDesk::State::take_up(std::string& notice) {
  followed = settings;
  const std::filesystem::path folder = assets.assets / "languages";
  std::string language = options.language.empty() ? settings.language : options.language;
  if (language.empty()) language = language_of_machine(folder);
  try {
    if (language != words.language()) words = language == "en" ? Words() : Words(folder, language);
  } catch (const InputError& error) {
    if (!options.language.empty()) throw;
    words = Words();
    notice = words("The language that was chosen cannot be used: {0}", {error.what()});
  }
  keys = KeyMap();
  try {
    keys.apply(settings.keys);
  } catch (const InputError& error) {
    keys = KeyMap();
    notice = words("Your keys cannot be used, the usual ones hold: {0}", {error.what()});
  }
  const SteeringOptions steered{settings.left_handed, settings.like_a_fulcrum, settings.sensitivity};
  if (steering) steering->retune(keys, steered);
  else steering = std::make_unique<Steering>(keys, steered);
  if (!sound || sound_wanted != settings.sound) sound = std::make_unique<Sound>(settings.sound);
  sound_wanted = settings.sound;
}

void PracticeDesk::State::open_database(std::string& notice) {
  const bool named = !options.database.empty();
  try {
    const std::filesystem::path file = named ? options.database : default_database_path();
    database = std::make_unique<Database>(file, OpenMode::kCreate, kBusy_ms, regrade_file);
    if (!database->recovered().empty())
      notice = words("An attempt that was cut off has been closed; its recording is kept.");
  } catch (const EnvironmentError& error) {
    if (named) throw;
    database = std::make_unique<Database>(":memory:");
    options.database = ":memory:";
    notice = words("Results cannot be kept: {0}", {error.what()});
  }
}

std::vector<AttemptSummary> PracticeDesk::State::attempts(const std::string& exercise) const {
  if (!database->in_memory()) return AttemptStore(*database).list({trainee, exercise});
  std::vector<AttemptSummary> out;
  std::copy_if(unkept.begin(), unkept.end(), std::back_inserter(out),
               [&](const AttemptSummary& a) { return a.exercise_id == exercise && a.trainee == trainee; });
  return out;
}

std::int64_t PracticeDesk::State::seed() const {
  if (options.seed) return *options.seed;
  std::random_device device;
  return static_cast<std::int64_t>(device() & 0x7fffffffU);
}

PracticeDesk::PracticeDesk(const DeskOptions& options, const AssetRoots& assets) : state_(std::make_unique<State>()) {
  State& s = *state_;
  s.options = options;
  s.assets = assets;
  s.exercises = list_exercises(assets.exercises);
  if (s.exercises.empty()) throw EnvironmentError(assets.exercises.string() + ": holds no exercise");
  s.show_scene = std::async(std::launch::async, [] { return std::make_shared<const SceneView>(trocar::show_scene("abdomen")); }).share();
  s.settings = load_settings(s.settings_file_path());
  notice = s.settings.note;
  s.take_up(notice);
  s.open_database(notice);
  exercise_id = s.exercises.front().id;
  level = options.level;
  organ = options.organ;
  if (!options.exercise.empty()) {
    const Exercise chosen = find_exercise(options.exercise, assets.exercises);
    const auto known = std::find_if(s.exercises.begin(), s.exercises.end(), [&](const Exercise& e) { return e.id == chosen.id; });
    if (known == s.exercises.end()) s.exercises.push_back(chosen);
    else *known = chosen;
    exercise_id = chosen.id;
  }
  find_level(exercise(), level);
  if (options.trainee.empty()) return;
  if (const std::string wrong = sign_in(options.trainee); !wrong.empty()) throw InputError("--trainee " + options.trainee + ": " + wrong);
}

PracticeDesk::~PracticeDesk() = default;

const AssetRoots& PracticeDesk::assets() const { return state_->assets; }
const std::vector<Exercise>& PracticeDesk::exercises() const { return state_->exercises; }
const Words& PracticeDesk::words() const { return state_->words; }
double PracticeDesk::scale() const { return std::clamp(state_->options.scale.value_or(state_->settings.scale), 1.0, 2.0); }
Settings& PracticeDesk::settings() { return state_->settings; }
const KeyMap& PracticeDesk::keys() const { return state_->keys; }
Steering& PracticeDesk::steering() { return *state_->steering; }
Sound& PracticeDesk::sound() { return *state_->sound; }
std::filesystem::path PracticeDesk::database() const {
  return state_->database->in_memory() ? std::filesystem::path(":memory:") : state_->database->file();
}

void PracticeDesk::choose_language(const std::string& code) {
  state_->options.language.clear();
  state_->settings.language = code;
  settings_changed();
}

void PracticeDesk::choose_scale(double scale) {
  state_->options.scale.reset();
  state_->settings.scale = std::clamp(scale, 1.0, 2.0);
  settings_changed();
}

void PracticeDesk::settings_changed() {
  State& s = *state_;
  // What was chosen here holds over what the command line said; what was not touched stays as it said.
  if (s.settings.scale != s.followed.scale) s.options.scale.reset();
  if (s.settings.language != s.followed.language) s.options.language.clear();
  s.take_up(notice);
  try {
    save_settings(s.settings_file_path(), s.settings);
  } catch (const EnvironmentError& error) {
    notice = s.words("The settings hold now but cannot be kept: {0}", {error.what()});
  }
}

std::shared_ptr<const SceneView> PracticeDesk::show_scene(double wait_s) const {
  const auto& scene = state_->show_scene;
  if (!scene.valid() || scene.wait_for(std::chrono::duration<double>(wait_s)) != std::future_status::ready) return nullptr;
  return scene.get();
}

AttemptSetup PracticeDesk::show_setup() const {
  const std::vector<Exercise>& all = state_->exercises;
  const auto touch = std::find_if(all.begin(), all.end(), [](const Exercise& e) { return e.kind == ExerciseKind::kTouch; });
  AttemptSetup setup;
  setup.exercise = touch == all.end() ? all.front() : *touch;
  setup.level = setup.exercise.levels.front().name;
  setup.organ = "phantom-abdomen";
  return setup;
}

const std::string& PracticeDesk::trainee() const { return state_->trainee; }
bool PracticeDesk::is_guest() const { return state_->trainee == kGuest; }

std::string PracticeDesk::sign_in(const std::string& code) {
  State& s = *state_;
  if (code.empty()) return s.words("Type your code first.");
  try {
    s.trainee = TraineeStore(*s.database).ensure_trainee(code).code;
    s.session = make_uuid();
    return "";
  } catch (const InputError&) {
    return s.words("A code is 1 to 32 letters, digits, dots or dashes, and begins with a letter or digit.");
  } catch (const EnvironmentError& error) {
    return s.words("The database does not answer: {0}", {error.what()});
  }
}

void PracticeDesk::sign_out() {
  state_->trainee = kGuest;
  state_->session = make_uuid();
}

const Exercise& PracticeDesk::exercise() const {
  const auto& all = state_->exercises;
  const auto at = std::find_if(all.begin(), all.end(), [this](const Exercise& e) { return e.id == exercise_id; });
  return at == all.end() ? all.front() : *at;
}

bool PracticeDesk::exercise_given() const { return !state_->options.exercise.empty(); }

Standing PracticeDesk::standing(const std::string& id, const std::string& of_level) const {
  const auto& all = state_->exercises;
  const auto at = std::find_if(all.begin(), all.end(), [&id](const Exercise& e) { return e.id == id; });
  return at == all.end() ? Standing{} : standing_of(*at, of_level, state_->attempts(id));
}

PracticeDesk::Advice PracticeDesk::next() const {
  const Words& w = state_->words;
  std::size_t most = 0;
  for (const Exercise& e : state_->exercises) most = std::max(most, e.levels.size());
  for (std::size_t i = 0; i < most; ++i) {
    for (const Exercise& e : state_->exercises) {
      if (i >= e.levels.size()) continue;
      const std::string& name = e.levels[i].name;
      const Standing s = standing(e.id, name);
      if (!s.unlocked || opens_next(s.newest_first)) continue;
      if (s.attempts == 0) return {e.id, name, w("Not tried yet.")};
      if (s.passed_in_a_row == 0)
        return {e.id, name, w("Tried {0} times, the row of passes is still to come.", {std::to_string(s.attempts)})};
      return {e.id, name, w("{0} of 3 passes in a row.", {std::to_string(s.passed_in_a_row)})};
    }
  }
  const Exercise& first = state_->exercises.front();
  return {first.id, first.levels.back().name, w("Everything is passed: stay in practice.")};
}

std::optional<std::string> PracticeDesk::teacher_note() const { return std::nullopt; }

std::vector<PastAttempt> PracticeDesk::past(const std::string& id) const {
  const State& s = *state_;
  std::vector<PastAttempt> out;
  if (s.database->in_memory()) {
    std::copy_if(s.unkept_numbers.begin(), s.unkept_numbers.end(), std::back_inserter(out), [&](const PastAttempt& a) {
      return a.summary.trainee == s.trainee && (id.empty() || a.summary.exercise_id == id);
    });
    return out;
  }
  try {
    return past_attempts(*s.database, s.trainee, id);
  } catch (const EnvironmentError&) {
    return {};
  }
}

std::string PracticeDesk::begin_attempt() {
  State& s = *state_;
  if (s.runner) return s.words("An attempt is running.");
  const bool scripted = !s.options.hand.empty();
  if (!scripted && !standing(exercise_id, level).unlocked)
    return s.words("{0} is locked: it opens after three passes in a row on three boards at the level before.", {level});
  AttemptRequest request;
  request.setup.exercise = exercise();
  request.setup.level = level;
  request.setup.organ = organ;
  request.setup.hand = scripted ? s.options.hand : s.options.input != "auto" ? s.options.input
                       : s.settings.input != "auto" ? s.settings.input : input_name(s.steering->kind());
  request.setup.seed = s.seed();
  request.setup.board = drawn_board(request.setup.seed, level == kExamLevel);
  request.setup.realtime = true;
  request.setup.pace = kSimulatedLivePace;
  request.trainee = s.trainee;
  request.session = s.session;
  request.database = s.options.database;
  request.steered = !scripted;
  try {
    s.runner = std::make_unique<AttemptRunner>(request, s.assets);
    s.last_scene = s.runner->shared_scene();
    return "";
  } catch (const InputError& error) {
    return error.what();
  } catch (const EnvironmentError& error) {
    return error.what();
  }
}

void PracticeDesk::begin_steering() {
  State& s = *state_;
  if (!s.runner) return;
  const Scene& scene = s.runner->scene();
  const StylusState& stylus = s.runner->newest().record.stylus;
  s.steering->begin(stylus.X_TI, stylus.jaw_opening_m, scene.board.centre_T, steering_reach(scene.setup.exercise, scene.level));
}

AttemptRunner* PracticeDesk::running() { return state_->runner.get(); }

bool PracticeDesk::end_attempt() {
  State& s = *state_;
  if (!s.runner) return false;
  std::erase_if(s.unstored, [](const std::unique_ptr<AttemptRunner>& old) { return old->stored(); });
  std::unique_ptr<AttemptRunner> runner = std::move(s.runner);
  try {
    if (!runner->finished()) runner->abort();
    s.result = runner->result();
    for (int i = 0; i < kStoring_ms && !runner->stored(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    if (!runner->stored()) {
      notice = s.words("The database is busy: the result is kept and will be stored as soon as it answers.");
      s.unstored.push_back(std::move(runner));
    }
  } catch (const std::exception& error) {
    s.result.reset();
    notice = s.words("The attempt ended without a result: {0}", {error.what()});
    return false;
  }
  if (!s.database->in_memory()) return true;
  AttemptSummary summary;
  summary.uuid = s.result->uuid;
  summary.trainee = s.trainee;
  summary.exercise_id = s.result->exercise_id;
  summary.level = s.result->level;
  summary.started_utc = s.result->started_utc;
  summary.board = s.result->board;
  summary.status = status_name(s.result->grade.status);
  summary.score = s.result->grade.score;
  summary.passed = s.result->grade.passed;
  s.unkept.insert(s.unkept.begin(), summary);
  s.unkept_numbers.insert(s.unkept_numbers.begin(), past_attempt(*s.result));
  s.unkept_numbers.front().summary.trainee = s.trainee;
  return true;
}

bool PracticeDesk::open_result(const std::string& uuid) {
  State& s = *state_;
  try {
    AttemptResult found = AttemptStore(*s.database).load(uuid);
    exercise_id = found.exercise_id;
    level = found.level;
    s.result = std::move(found);
    return true;
  } catch (const std::exception& error) {
    notice = s.words("This attempt cannot be opened: {0}", {error.what()});
    return false;
  }
}

const std::optional<AttemptResult>& PracticeDesk::result() const { return state_->result; }
std::shared_ptr<const Scene> PracticeDesk::last_scene() const { return state_->last_scene; }
std::filesystem::path PracticeDesk::recording() const { return state_->result ? state_->result->recording_path : ""; }

std::filesystem::path PracticeDesk::expert_recording() {
  State& s = *state_;
  AttemptSetup setup;
  setup.exercise = exercise();
  setup.level = level;
  setup.organ = organ;
  setup.hand = "expert";
  setup.seed = s.result ? s.result->seed : 1;
  setup.board = s.result ? s.result->board : drawn_board(setup.seed, false);
  return s.expert.ask(setup, s.assets);
}

const std::string& PracticeDesk::expert_refusal() const { return state_->expert.refusal(); }

}  // namespace trocar
