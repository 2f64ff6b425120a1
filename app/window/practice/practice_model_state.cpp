#include "app/window/practice/practice_model_state.h"

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <random>

#include "app/session/grading/recorded_result.h"
#include "app/window/attempt/cut_off.h"
#include "haptics/device/backends/make_backend.h"
#include "haptics/input_error.h"
#include "scenarios/files/exercise_loader.h"
#include "scenarios/hands/make_hand.h"
#include "scenarios/kinds/kind.h"
#include "tissue/organ/organ.h"

namespace trocar {
namespace {

constexpr int kBusy_ms = 2000;

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

void PracticeModel::State::take_up(std::string& notice) {
  followed = settings;
  const std::filesystem::path folder = assets.assets / "languages";
  std::string language = options.language.empty() ? settings.language : options.language;
  if (language.empty()) language = language_of_machine(folder);
  try {
    if (language != words.language()) words = language == "en" ? Translator() : Translator(folder, language);
  } catch (const InputError& error) {
    if (!options.language.empty()) throw;
    words = Translator();
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
  if (steering)
    steering->retune(keys, steered);
  else
    steering = std::make_unique<Steering>(keys, steered);
  if (!sound || sound_wanted != settings.sound) sound = std::make_unique<Sound>(settings.sound);
  sound_wanted = settings.sound;
}

void PracticeModel::State::open_database(std::string& notice) {
  const bool named = !options.database.empty();
  try {
    const std::filesystem::path file = named ? options.database : default_database_path();
    database = std::make_unique<Database>(file, OpenMode::kCreate, kBusy_ms);
    recovered = database->recovered();
    if (const std::string said = recovered_words(""); !said.empty()) notice = said;
  } catch (const EnvironmentError& error) {
    if (named) throw;
    database = std::make_unique<Database>(":memory:");
    options.database = ":memory:";
    notice = words("Results cannot be kept: {0}", {error.what()});
  }
}

/// Of the newest one. @param of one trainee; empty: anybody, who is then named.
std::string PracticeModel::State::recovered_words(const std::string& of) const {
  for (auto found = recovered.rbegin(); found != recovered.rend(); ++found) {
    if (!of.empty() && found->trainee != of) continue;
    const AttemptSummary attempt = AttemptStore(*database).find(found->uuid);
    const auto at = std::find_if(exercises.begin(), exercises.end(),
                                 [&](const Exercise& e) { return e.id == attempt.exercise_id; });
    const std::string name = at == exercises.end() ? attempt.exercise_id : at->number;
    return cut_off_words(words, of.empty() && attempt.trainee != kGuest ? name + " (" + attempt.trainee + ")" : name,
                         attempt, std::time(nullptr));
  }
  return "";
}

/// What the first attempt would stumble over. @throws InputError that names what there is.
void PracticeModel::State::check_names() const {
  find_organ(options.organ, assets.assets);
  AttemptSetup on;
  if (!options.backend.empty()) on.backend = options.backend;
  device_model(device, on.backend);
  if (scripted()) require_scripted(on);
  if (scripted()) make_hand(options.hand, 0, assets.hands);
  if (scripted() && !options.trainee.empty())
    throw InputError("--trainee " + options.trainee +
                     ": what --hand does is a demonstration and nobody's attempt; leave one of the two out");
}

std::vector<AttemptSummary> PracticeModel::State::attempts(const std::string& exercise) const {
  std::vector<AttemptSummary> out = database->in_memory() ? unkept : AttemptStore(*database).list({trainee, exercise});
  std::erase_if(
      out, [&](const AttemptSummary& a) { return a.exercise_id != exercise || a.trainee != trainee || !counts(a); });
  return out;
}

/// The scene of an attempt. Where the organ lies is the same for every board of a level, and the search for it takes
/// seconds on a small organ: it is done once for attempts that follow each other on the same organ.
std::shared_ptr<const Scene> PracticeModel::State::built(AttemptSetup setup) const {
  find_level(setup.exercise, setup.level);
  Organ made = organ_of(setup, assets);
  const Scene* last = last_scene.get();
  if (last && kind_of(setup.exercise).on_organ && last->organ.sha256 == made.sha256 &&
      last->setup.exercise.text == setup.exercise.text && last->setup.level == setup.level)
    setup.placement = last->placement;
  return std::make_shared<const Scene>(
      build_scene(setup, std::move(made), backend_capabilities(setup.backend, setup.rate_hz)));
}

/// At sign-in. A database that does not answer has none to show now.
void PracticeModel::State::look_for_note() {
  note.reset();
  if (database->in_memory()) return;
  try {
    note = AssessmentStore(*database).newest_unseen(trainee);
  } catch (const EnvironmentError&) {
  }
}

/// At sign-in and after each attempt. Steps of exercises that this program does not have are left to others.
void PracticeModel::State::look_for_due() {
  due.clear();
  if (database->in_memory() || trainee == kGuest || trainee == kDemonstration) return;
  try {
    due = next_steps(*database, trainee, utc_now());
  } catch (const EnvironmentError&) {
  }
  std::erase_if(due, [this](const Reminder& one) {
    return std::none_of(exercises.begin(), exercises.end(), [&one](const Exercise& e) {
      return e.id == one.step.exercise_id &&
             std::any_of(e.levels.begin(), e.levels.end(),
                         [&one](const ExerciseLevel& level) { return level.name == one.step.level; });
    });
  });
}

/// It stood on the course's page, and the next attempt has begun. What cannot be written now is shown once more.
void PracticeModel::State::note_was_met() {
  if (!note) return;
  try {
    AssessmentStore(*database).mark_seen(note->uuid);
  } catch (const EnvironmentError&) {
  }
  note.reset();
}

std::int64_t attempt_seed(const std::optional<std::int64_t>& asked, bool scripted, const std::string& level) {
  if (asked && (scripted || level != kExamLevel)) return *asked;
  std::random_device device;
  return static_cast<std::int64_t>(device() & 0x7fffffffU);
}

}  // namespace trocar
