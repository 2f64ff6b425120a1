// What the trainee's program holds between screens: who is here, what is chosen, the attempt that runs, the last
// result.
//
// Screens read and change it; nothing here draws. Thread: the window's.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/picture/gl/image.h"
#include "app/window/attempt/attempt_runner.h"
#include "app/window/attempt/settings.h"
#include "app/window/input/key_map.h"
#include "app/window/input/steering.h"
#include "app/window/practice/level_progress.h"
#include "app/window/sound/sound.h"
#include "app/window/words/translator.h"
#include "scenarios/exercise.h"
#include "trainees/desk/queries/programme_query.h"
#include "trainees/progress/past_attempts.h"
#include "trainees/records/attempt_store.h"

namespace trocar {

/// What runs: an attempt, or what nobody grades and nothing keeps.
enum class Play : std::uint8_t { kAttempt, kTutorial, kFree, kGallbladder, kStitching, kFlap };

struct ModelOptions {
  std::filesystem::path database = {};  ///< empty: the default; ":memory:" keeps nothing
  std::string trainee = {};             ///< code, empty: guest
  std::string exercise = {};            ///< straight to its briefing
  std::string level = "L1";
  std::optional<Play> play = {};  ///< straight to it
  std::string organ = "phantom-liver";
  std::string tissue = {};  ///< one of kTissueWords; empty: the exercise's
  std::string input = "auto";
  std::string backend = {};  ///< that input "device" means, as make_backend() knows it; empty: the simulated device
  std::string card = {}, force_sensor = {};             ///< as AttemptSetup has them
  std::filesystem::path calibration = {}, device = {};  ///< as read_device_files() takes them
  std::filesystem::path settings = {};                  ///< empty: settings_file()
  std::string hand = {};  ///< scripted hand in place of a person ("expert"): a demonstration, kept under that name
  std::optional<std::int64_t> seed = {};  ///< given: every attempt draws from it, but a person's exam
  std::optional<double> scale = {};       ///< given: this time only, whatever the settings say
  std::string language = {};              ///< given: this time only
  std::string scope = {};                 ///< "0" or "30" degrees of the tip; given: this time only
  StepGate* steps = nullptr;              ///< as AttemptRequest::steps
};

class PracticeModel {
 public:
  PracticeModel(const ModelOptions& options, const AssetRoots& assets);
  ~PracticeModel();

  const AssetRoots& assets() const;
  const std::vector<Exercise>& exercises() const;
  const Translator& words() const;
  double scale() const;  ///< of text and buttons, 1 to 2
  Settings& settings();
  /// Saves the settings and takes up what they say (language, keys, sound). A full disk is a notice, not an end.
  void settings_changed();
  /// A person's choice: holds over what the command line said, even where the settings said the same before.
  void choose_language(const std::string& code);
  void choose_scale(double scale);
  void choose_scope(const std::string& degrees);
  const std::string& scope() const;  ///< tilt of the scope's tip, degrees: "0" or "30"
  double scope_tilt_rad() const;
  const KeyMap& keys() const;
  Steering& steering();
  Sound& sound();

  /// The scene behind the start page, made in the background from the beginning. @param wait_s how long to wait for it;
  /// null: not yet.
  std::shared_ptr<const SceneView> show_scene(double wait_s) const;
  /// The attempt that the expert plays behind the start page.
  AttemptSetup show_setup() const;

  // who
  const std::string& trainee() const;  ///< "guest" without sign-in
  bool is_guest() const;
  bool is_demonstration() const;  ///< a scripted hand does the attempts; then also a guest
  /// Whoever is here in words, for the head of a page: "Signed in as T-7", "Guest", "Demonstration".
  std::string who() const;
  /// What stands between a typed code and its trainee.
  enum class CodeAsks : std::uint8_t {
    kNothing,
    kNew,  ///< nobody has it: signing in makes a new trainee
    kPin   ///< this station asks for the PIN or password that the trainee has at the desk
  };
  /// kNothing for a code that sign_in() refuses, too.
  CodeAsks code_asks(const std::string& code) const;
  /// A new code becomes a trainee. After a wrong PIN the next one is taken later and later.
  /// @return what was wrong, in the trainee's language; empty when signed in.
  std::string sign_in(const std::string& code, const std::string& pin = "");
  void sign_out();

  // what
  std::string exercise_id, level = "L1", organ = "phantom-liver";
  const Exercise& exercise() const;        ///< the chosen one
  bool exercise_given() const;             ///< by the options: straight to its briefing
  std::optional<Play> play_given() const;  ///< likewise
  LevelProgress progress(const std::string& exercise_id, const std::string& level) const;
  /// What to do next, and why: exercise id, level, one sentence.
  struct Advice {
    std::string exercise_id, level, why;
  };
  Advice next() const;  ///< of the trainee's programmes first, where a step of them is open
  /// Steps of the trainee's programmes that are to be done, the latest first (next_steps()), of what this program has;
  /// as they stood at sign-in or after the last attempt. Nothing while the database does not answer.
  const std::vector<Reminder>& due() const;
  /// "Due by 2026-06-30.", "Overdue since 2026-06-30.", "In the programme Autumn."
  std::string due_words(const Reminder& step) const;
  /// Newest note of a teacher for this trainee; none until the record has notes.
  std::optional<std::string> teacher_note() const;

  // the attempt
  /// How the organ of the chosen exercise gives way: one of kTissueWords.
  std::string tissue() const;
  /// Will the next attempt be done at mouse, keys or pad, without a device?
  bool at_pointer() const;
  /// Device of the next attempt, by its back-end's name.
  std::string backend() const;
  /// What the options name of it, as it was read at the beginning.
  const DeviceFiles& device_files() const;
  /// Why the chosen level is locked, and what opens it; empty: it is open. A demonstration may show any.
  std::string locked() const;
  /// Starts one at what is chosen, with a fresh board; a locked level is refused. @return what hindered it, empty when
  /// it runs.
  std::string begin_attempt();
  /// The tutorial, on the phantom's liver, or free play on the chosen organ: always the same board. @return as
  /// begin_attempt().
  std::string begin_play(Play play);
  AttemptRunner* running();  ///< null: none
  Play playing() const;      ///< what runs, or ran last
  /// This station has not shown its tutorial yet, and the start page is where its person begins.
  bool tutorial_due() const;
  /// Takes over the result of a finished or aborted attempt. @return false: it had none (notice says why), or was none.
  bool end_attempt();
  const std::optional<AttemptResult>& result() const;
  /// An attempt that the database keeps, as if it had just ended: to look at it again. @return whether it is there.
  bool open_result(const std::string& uuid);
  /// Scene of the last attempt, for pictures of the debrief; null before the first.
  std::shared_ptr<const Scene> last_scene() const;
  std::filesystem::path recording() const;  ///< of result(), empty: none kept
  /// Recording of the expert at the same exercise and level, made when first asked for (headless, cached). Empty: not
  /// yet.
  std::filesystem::path expert_recording();
  const std::string& expert_refusal() const;  ///< why there will be none, empty while it may still come
  /// Finished attempts of whoever is here, newest first. @param exercise_id empty: all. Nothing while the database does
  /// not answer.
  std::vector<PastAttempt> past(const std::string& exercise_id = "") const;

  /// Once a frame: tells the instructor's desk what goes on here, and takes up a teacher's messages. A message is a
  /// notice at once, but in an exam, where it waits for the end; the recording of an attempt keeps the moment. @param
  /// dt_s since the last one.
  void pass(double dt_s);
  /// A desk looks at the attempt that runs, and a new picture of it is due; said once for each.
  bool desk_wants_picture();
  void show_desk(Image picture);

  /// Where this model keeps attempts: ":memory:" when nothing is kept.
  std::filesystem::path database() const;

  /// At most one thing that the trainee should know now (database busy, disk full); shown by every screen.
  std::string notice;
  std::filesystem::path replay_file;    ///< what the replay screen shall show; empty: recording()
  std::filesystem::path replay_beside;  ///< second run beside it; empty: none
  std::optional<double> replay_at_s;    ///< loop time at which the replay shall begin; nothing: the run's beginning

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace trocar
