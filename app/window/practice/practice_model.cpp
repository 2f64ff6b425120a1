#include "app/window/practice/practice_model.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <numbers>
#include <thread>

#include "app/picture/models/show_scene.h"
#include "app/session/setup/recorded_scene.h"
#include "app/window/practice/practice_model_state.h"
#include "haptics/device/backends/make_backend.h"
#include "haptics/input_error.h"
#include "scenarios/files/exercise_loader.h"
#include "scenarios/kinds/kind.h"
#include "scenarios/layout/board_numbers.h"
#include "trainees/records/attempt_identity.h"
#include "trainees/records/standings.h"
#include "trainees/records/trainee_store.h"
#include "trainees/records/verdicts.h"

namespace trocar {
namespace {

/// Of what nobody grades, in the order of Play.
constexpr std::array kFileOfPlay{"",         "tutorial.toml", "free-play.toml", "gallbladder.toml", "stitching.toml",
                                 "flap.toml"};

constexpr const char *kTutorialOrgan = "phantom-liver", *kWithGallbladder = "phantom-abdomen";
constexpr int kHeldBackFrom = 5;                      // wrong PINs in a row, that the audit trail tells of
constexpr std::chrono::seconds kLongestPinWait{900};  // they double from one second on
constexpr int kStoring_ms = 500;  // that a result may take to the database before the person is told

/// The parser's own words are English and for who writes programs: the line says enough.
std::string unread_words(const Translator& w, const Settings& settings, const std::filesystem::path& file) {
  const std::string kept = unread_settings(file).filename().string();
  if (settings.note_line > 0)
    return w("{0}, line {1}, cannot be read: the usual settings hold. With your next change it is kept as {2}.",
             {file.string(), std::to_string(settings.note_line), kept});
  return w("{0} cannot be read: the usual settings hold. With your next change it is kept as {1}.",
           {file.string(), kept});
}

}  // namespace

PracticeModel::PracticeModel(const ModelOptions& options, const AssetRoots& assets)
    : state_(std::make_unique<State>()) {
  State& s = *state_;
  s.options = options;
  s.assets = assets;
  if (s.scripted()) s.trainee = kDemonstration;
  s.device = read_device_files(options.calibration, options.device);
  s.check_names();
  s.exercises = list_exercises(assets.exercises);
  if (s.exercises.empty()) throw EnvironmentError(assets.exercises.string() + ": holds no exercise");
  s.show_scene = std::async(std::launch::async, [] {
                   return std::make_shared<const SceneView>(trocar::show_scene("abdomen"));
                 }).share();
  s.settings = load_settings(s.settings_file_path());
  s.take_up(notice);
  if (!s.settings.note.empty()) notice = unread_words(s.words, s.settings, s.settings_file_path());
  s.open_database(notice);
  exercise_id = s.exercises.front().id;
  level = options.level;
  organ = options.organ;
  if (!options.exercise.empty()) {
    const Exercise chosen = find_exercise(options.exercise, assets.exercises);
    const auto known =
        std::find_if(s.exercises.begin(), s.exercises.end(), [&](const Exercise& e) { return e.id == chosen.id; });
    if (known == s.exercises.end())
      s.exercises.push_back(chosen);
    else
      *known = chosen;
    exercise_id = chosen.id;
  }
  find_level(exercise(), level);
  if (options.trainee.empty()) return;
  if (code_asks(options.trainee) == CodeAsks::kPin)
    throw InputError("--trainee " + options.trainee + ": this station asks for the PIN; sign in on the start page");
  if (const std::string wrong = sign_in(options.trainee); !wrong.empty())
    throw InputError("--trainee " + options.trainee + ": " + wrong);
}

PracticeModel::~PracticeModel() = default;

const AssetRoots& PracticeModel::assets() const { return state_->assets; }
const std::vector<Exercise>& PracticeModel::exercises() const { return state_->exercises; }
const Translator& PracticeModel::words() const { return state_->words; }
double PracticeModel::scale() const {
  return std::clamp(state_->options.scale.value_or(state_->settings.scale), 1.0, 2.0);
}
const std::string& PracticeModel::scope() const {
  return state_->options.scope.empty() ? state_->settings.scope : state_->options.scope;
}
double PracticeModel::scope_tilt_rad() const { return std::stod(scope()) * std::numbers::pi / 180; }
Settings& PracticeModel::settings() { return state_->settings; }
const KeyMap& PracticeModel::keys() const { return state_->keys; }
Steering& PracticeModel::steering() { return *state_->steering; }
Sound& PracticeModel::sound() { return *state_->sound; }
std::filesystem::path PracticeModel::database() const {
  return state_->database->in_memory() ? std::filesystem::path(":memory:") : state_->database->file();
}

void PracticeModel::choose_language(const std::string& code) {
  state_->options.language.clear();
  state_->settings.language = code;
  settings_changed();
}

void PracticeModel::choose_scale(double scale) {
  state_->options.scale.reset();
  state_->settings.scale = std::clamp(scale, 1.0, 2.0);
  settings_changed();
}

void PracticeModel::choose_scope(const std::string& degrees) {
  state_->options.scope.clear();
  state_->settings.scope = degrees;
  settings_changed();
}

void PracticeModel::settings_changed() {
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

std::shared_ptr<const SceneView> PracticeModel::show_scene(double wait_s) const {
  const auto& scene = state_->show_scene;
  if (!scene.valid() || scene.wait_for(std::chrono::duration<double>(wait_s)) != std::future_status::ready)
    return nullptr;
  return scene.get();
}

AttemptSetup PracticeModel::show_setup() const {
  const std::vector<Exercise>& all = state_->exercises;
  const auto touch = std::find_if(all.begin(), all.end(), [](const Exercise& e) { return kind_of(e).on_organ; });
  AttemptSetup setup;
  setup.exercise = touch == all.end() ? all.front() : *touch;
  setup.level = setup.exercise.levels.front().name;
  setup.organ = "phantom-abdomen";
  return setup;
}

const std::string& PracticeModel::trainee() const { return state_->trainee; }
bool PracticeModel::is_guest() const { return state_->trainee == kGuest || state_->trainee == kDemonstration; }

PracticeModel::CodeAsks PracticeModel::code_asks(const std::string& code) const {
  const State& s = *state_;
  if (code == kDemonstration || code == kGuest) return CodeAsks::kNothing;
  try {
    check_trainee_code(code);
    if (!TraineeStore(*s.database).find(code)) return CodeAsks::kNew;
    return s.guarded(code) ? CodeAsks::kPin : CodeAsks::kNothing;
  } catch (const std::exception&) {
    return CodeAsks::kNothing;  // signing in says what is wrong
  }
}

/// The account that this station asks for; codes differ by more than case.
std::optional<Account> PracticeModel::State::guarded(const std::string& code) const {
  if (!settings.ask_pin) return std::nullopt;
  const auto known = TraineeStore(*database).find(code);
  return known ? AccountStore(*database).of_trainee(known->code) : std::nullopt;
}

/// @return what was wrong with it; "" when it is right.
std::string PracticeModel::State::check_pin(const Account& account, const std::string& pin) {
  using Clock = std::chrono::steady_clock;
  if (!account.disabled_utc.empty()) return words("The account of this code is disabled: ask your teacher.");
  if (pin.empty()) return words("Type your PIN.");
  WrongPins& wrong = wrong_pins[account.uuid];
  const auto left = std::chrono::ceil<std::chrono::seconds>(wrong.until - Clock::now());
  if (left.count() > 0) return words("Wait {0} s, then try again.", {std::to_string(left.count())});
  if (AccountStore(*database).verify(account.login, pin)) {
    wrong_pins.erase(account.uuid);
    return "";
  }
  const auto wait = std::min(kLongestPinWait, std::chrono::seconds(1 << std::min(wrong.count, 20)));
  wrong.until = Clock::now() + wait;
  if (++wrong.count == kHeldBackFrom) AccountStore(*database).held_back(account.uuid);
  return words("This PIN is wrong. Wait {0} s, then try again.", {std::to_string(wait.count())});
}

std::string PracticeModel::sign_in(const std::string& code, const std::string& pin) {
  State& s = *state_;
  if (code.empty()) return s.words("Type your code first.");
  if (code == kDemonstration || code == kGuest)
    return s.words("This code is kept for runs that are nobody's; take another.");
  try {
    if (!StandingStore(*s.database).of(code).active) return s.words("This code is deactivated: ask your teacher.");
    if (const auto account = s.guarded(code))
      if (std::string wrong = s.check_pin(*account, pin); !wrong.empty()) return wrong;
    s.trainee = TraineeStore(*s.database).ensure_trainee(code).code;
    if (const std::string said = s.recovered_words(s.trainee); !said.empty()) notice = said;
    s.look_for_note();
    s.look_for_due();
    s.message.reset();
    s.session = make_uuid();
    return "";
  } catch (const InputError&) {
    return s.words("A code is 1 to 32 letters, digits, dots or dashes, and begins with a letter or digit.");
  } catch (const EnvironmentError& error) {
    return s.words("The database does not answer: {0}", {error.what()});
  }
}

void PracticeModel::sign_out() {
  state_->trainee = state_->scripted() ? kDemonstration : kGuest;
  state_->note.reset();
  state_->due.clear();
  state_->message.reset();
  state_->session = make_uuid();
}

bool PracticeModel::is_demonstration() const { return state_->scripted(); }

std::string PracticeModel::who() const {
  const Translator& w = state_->words;
  if (state_->scripted()) return w("Demonstration");
  return is_guest() ? w("Guest") : w("Signed in as {0}", {trainee()});
}

const Exercise& PracticeModel::exercise() const {
  const auto& all = state_->exercises;
  const auto at = std::find_if(all.begin(), all.end(), [this](const Exercise& e) { return e.id == exercise_id; });
  return at == all.end() ? all.front() : *at;
}

bool PracticeModel::exercise_given() const { return !state_->options.exercise.empty(); }

std::optional<Play> PracticeModel::play_given() const { return state_->options.play; }

LevelProgress PracticeModel::progress(const std::string& id, const std::string& of_level) const {
  const auto& all = state_->exercises;
  const auto at = std::find_if(all.begin(), all.end(), [&id](const Exercise& e) { return e.id == id; });
  return at == all.end() ? LevelProgress{} : level_progress(*at, of_level, state_->attempts(id));
}

const std::vector<Reminder>& PracticeModel::due() const { return state_->due; }

std::string PracticeModel::due_words(const Reminder& step) const {
  const Translator& w = state_->words;
  if (step.due.empty()) return w("In the programme {0}.", {step.programme});
  return w(step.state == StepState::kOverdue ? "Overdue since {0}." : "Due by {0}.", {step.due});
}

PracticeModel::Advice PracticeModel::next() const {
  const Translator& w = state_->words;
  for (const Reminder& one : state_->due)
    if (progress(one.step.exercise_id, one.step.level).unlocked)
      return {one.step.exercise_id, one.step.level, due_words(one)};
  const auto found = next_step(practice_order(state_->exercises, is_guest()),
                               [this](const Exercise& e, const std::string& name) { return progress(e.id, name); });
  if (!found) {
    const Exercise& first = state_->exercises.front();
    return {first.id, first.levels.back().name, w("Everything is passed: stay in practice.")};
  }
  const LevelProgress& s = found->progress;
  const std::string why = s.attempts == 0 ? w("Not tried yet.")
                          : s.passed_in_a_row == 0
                              ? w(s.attempts == 1 ? "Tried once, the row of passes is still to come."
                                                  : "Tried {0} times, the row of passes is still to come.",
                                  {std::to_string(s.attempts)})
                              : w("{0} of 3 passes in a row.", {std::to_string(s.passed_in_a_row)});
  return {found->exercise->id, found->level, why};
}

std::string PracticeModel::State::hand() const {
  return scripted()                 ? options.hand
         : options.input != "auto"  ? options.input
         : settings.input != "auto" ? settings.input
                                    : input_name(steering->kind());
}

bool PracticeModel::State::at_pointer() const { return !scripted() && hand() != input_name(InputKind::kDevice); }

bool PracticeModel::at_pointer() const { return state_->at_pointer(); }

std::string PracticeModel::State::backend() const {
  return at_pointer() ? kPointerBackend : options.backend.empty() ? kSimulatedBackend : options.backend;
}

std::string PracticeModel::backend() const { return state_->backend(); }
const DeviceFiles& PracticeModel::device_files() const { return state_->device; }

std::string PracticeModel::locked() const {
  const std::vector<ExerciseLevel>& levels = exercise().levels;
  const auto at =
      std::find_if(levels.begin(), levels.end(), [this](const ExerciseLevel& one) { return one.name == level; });
  if (state_->scripted() || at == levels.begin() || at == levels.end() || progress(exercise_id, level).unlocked)
    return "";
  const Translator& w = state_->words;
  const std::string& before = std::prev(at)->name;
  return w("{0} is locked: three passes in a row on three boards at {1} open it. So far: {2} of 3.",
           {w(level), w(before), std::to_string(std::min(3, progress(exercise_id, before).passed_in_a_row))});
}

std::optional<std::string> PracticeModel::teacher_note() const {
  const std::optional<Note>& note = state_->note;
  return note ? std::optional(note->printed.empty() ? note->text : note->text + " (" + note->printed + ")")
              : std::nullopt;
}

std::vector<PastAttempt> PracticeModel::past(const std::string& id) const {
  const State& s = *state_;
  std::vector<PastAttempt> out;
  if (s.database->in_memory()) {
    std::copy_if(s.unkept_numbers.begin(), s.unkept_numbers.end(), std::back_inserter(out), [&](const PastAttempt& a) {
      return a.summary.trainee == s.trainee && s.counts(a.summary) && (id.empty() || a.summary.exercise_id == id);
    });
    return out;
  }
  try {
    out = past_attempts(*s.database, s.trainee, id);
    std::erase_if(out, [&](const PastAttempt& a) { return !s.counts(a.summary); });
    return out;
  } catch (const EnvironmentError&) {
    return {};
  }
}

AttemptRequest PracticeModel::State::request(Exercise exercise, const std::string& level,
                                             const std::string& organ) const {
  AttemptRequest out;
  out.setup.exercise = std::move(exercise);
  out.setup.level = level;
  out.setup.organ = organ;
  out.setup.tissue = tissue_of(out.setup.exercise);
  out.setup.hand = hand();
  out.setup.backend = backend();
  if (!at_pointer()) out.setup.device = device;
  out.setup.card = options.card;
  out.setup.force_sensor = options.force_sensor;
  out.setup.realtime = true;
  if (!is_real_device(out.setup.backend)) out.setup.pace = kSimulatedLivePace;
  out.trainee = scripted() ? kDemonstration : trainee;
  out.session = session;
  out.database = options.database;
  out.steered = !scripted();
  out.steps = options.steps;
  return out;
}

/// @return what hindered it, empty when it runs.
std::string PracticeModel::State::run(AttemptRequest wanted, Play what) {
  try {
    runner = std::make_unique<AttemptRunner>(wanted, assets, built(wanted.setup));
    play = what;
    return "";
  } catch (const InputError& error) {
    return error.what();
  } catch (const EnvironmentError& error) {
    return error.what();
  }
}

std::string PracticeModel::begin_attempt() {
  State& s = *state_;
  if (s.runner) return s.words("An attempt is running.");
  if (std::string why = locked(); !why.empty()) return why;
  AttemptRequest request = s.request(exercise(), level, organ);
  request.setup.seed = attempt_seed(s.options.seed, s.scripted(), level);
  request.setup.board = drawn_board(request.setup.seed, level == kExamLevel);
  if (std::string why = s.run(std::move(request), Play::kAttempt); !why.empty()) return why;
  s.last_scene = s.runner->shared_scene();
  s.note_was_met();
  return "";
}

std::string PracticeModel::begin_play(Play what) {
  State& s = *state_;
  if (s.runner) return s.words("An attempt is running.");
  const bool tutorial = what == Play::kTutorial;
  if (tutorial && !s.settings.tutorial_seen) {
    s.settings.tutorial_seen = true;
    if (s.settings.note.empty()) settings_changed();  // a file that cannot be read waits for a person's own change
  }
  try {
    const std::filesystem::path file = s.assets.exercises / "ungraded" / kFileOfPlay.at(static_cast<std::size_t>(what));
    // The liver that is there unless a person says otherwise has no gallbladder.
    const bool lone = what == Play::kGallbladder && organ == kTutorialOrgan;
    AttemptRequest request = s.request(load_exercise(file), "L1",
                                       tutorial ? kTutorialOrgan
                                       : lone   ? kWithGallbladder
                                                : organ);
    request.graded = false;
    return s.run(std::move(request), what);
  } catch (const InputError& error) {
    return error.what();
  }
}

Play PracticeModel::playing() const { return state_->play; }

std::string PracticeModel::tissue() const { return state_->tissue_of(exercise()); }

bool PracticeModel::tutorial_due() const {
  const State& s = *state_;
  return !s.settings.tutorial_seen && !s.scripted() && !exercise_given() && !play_given();
}

AttemptRunner* PracticeModel::running() { return state_->runner.get(); }

bool PracticeModel::end_attempt() {
  State& s = *state_;
  if (!s.runner) return false;
  std::erase_if(s.unstored, [](const std::unique_ptr<AttemptRunner>& old) { return old->stored(); });
  std::unique_ptr<AttemptRunner> runner = std::move(s.runner);
  if (s.play != Play::kAttempt) return false;
  try {
    if (!runner->finished()) runner->abort();
    s.result = runner->result();
    for (int i = 0; i < kStoring_ms && !runner->stored(); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    if (!runner->stored()) {
      notice = s.words("The database is busy: the result is kept and will be stored as soon as it answers.");
      s.unstored.push_back(std::move(runner));
    }
  } catch (const std::exception& error) {
    s.result.reset();
    notice = s.words("The attempt ended without a result: {0}", {error.what()});
    return false;
  }
  if (!s.database->in_memory()) {
    s.look_for_due();
    return true;
  }
  PastAttempt past = past_attempt(*s.result);
  s.unkept.insert(s.unkept.begin(), past.summary);
  s.unkept_numbers.insert(s.unkept_numbers.begin(), std::move(past));
  return true;
}

bool PracticeModel::open_result(const std::string& uuid) {
  State& s = *state_;
  try {
    AttemptResult found = AttemptStore(*s.database).load(uuid);
    exercise_id = found.exercise_id;
    level = found.level;
    s.result = std::move(found);
    if (const auto decision = verdict_of(*s.database, *s.result).decision)
      notice = s.words(decision->passed ? "{0} decided on {1} that this attempt is passed: {2}"
                                        : "{0} decided on {1} that this attempt is not passed: {2}",
                       {decision->printed, decision->utc.substr(0, 10), decision->reason});
    return true;
  } catch (const std::exception& error) {
    notice = s.words("This attempt cannot be opened: {0}", {error.what()});
    return false;
  }
}

const std::optional<AttemptResult>& PracticeModel::result() const { return state_->result; }
std::shared_ptr<const Scene> PracticeModel::last_scene() const { return state_->last_scene; }
std::filesystem::path PracticeModel::recording() const { return state_->result ? state_->result->recording_path : ""; }

std::filesystem::path PracticeModel::expert_recording() {
  State& s = *state_;
  AttemptSetup setup;
  setup.exercise = exercise();
  setup.level = level;
  setup.organ = organ;
  setup.tissue = tissue();
  setup.seed = s.options.seed.value_or(1);
  setup.board = drawn_board(setup.seed, false);
  const bool same = s.result && s.result->exercise_id == exercise_id && s.result->level == level;
  try {
    if (same && !s.result->recording_path.empty()) {  // the very attempt: its exercise, organ, board and way of holding
      if (s.beside.first != s.result->uuid) s.beside = {s.result->uuid, recorded_setup(s.result->recording_path)};
      setup = s.beside.second;
    } else if (same && s.last_scene) {
      setup = s.last_scene->setup;
    }
  } catch (const InputError&) {
    setup.seed = s.result->seed;  // its recording cannot be read: the same board on what is chosen here
    setup.board = s.result->board;
  }
  return s.expert.ask(expert_setup(setup), s.assets);
}

const std::string& PracticeModel::expert_refusal() const { return state_->expert.refusal(); }

}  // namespace trocar
