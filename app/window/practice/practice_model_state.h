// What a PracticeModel keeps. Only app/window/practice/practice_model*.cpp includes this.
//
// Thread: the window's.
#pragma once

#include <chrono>
#include <future>
#include <map>
#include <utility>

#include "app/session/keeping/live_attempt.h"
#include "app/session/playback/expert_run.h"
#include "app/window/practice/practice_model.h"
#include "trainees/records/accounts.h"
#include "trainees/records/assessments.h"
#include "trainees/records/attempt_identity.h"

namespace trocar {

inline constexpr const char* kGuest = "guest";
inline constexpr const char* kDemonstration = "demonstration";  // whose the runs of scripted hands are

/// What was asked for, or drawn anew. A person's exam always is: who could choose the seed could have sat its board
/// before, under another code.
std::int64_t attempt_seed(const std::optional<std::int64_t>& asked, bool scripted, const std::string& level);

struct PracticeModel::State {
  ModelOptions options;
  AssetRoots assets;
  DeviceFiles device;
  std::vector<Exercise> exercises;
  Settings settings, followed;  // as they are; as they were when they were last taken up
  Translator words;
  KeyMap keys;
  std::unique_ptr<Steering> steering;
  std::unique_ptr<Sound> sound;
  bool sound_wanted = true;
  std::unique_ptr<Database> database;
  std::string trainee = kGuest, session = make_uuid();  // session: of a sign-in
  std::optional<Note> note;                             // of a teacher, that the trainee has not met yet
  std::vector<Reminder> due;                            // of the trainee's programmes
  std::unique_ptr<AttemptRunner> runner;
  Play play = Play::kAttempt;                            // of the runner
  std::vector<std::unique_ptr<AttemptRunner>> unstored;  // over, but the database has not taken them yet
  std::optional<AttemptResult> result;
  std::shared_ptr<const Scene> last_scene;
  std::vector<AttemptSummary> unkept;       // of this sitting, newest first, when nothing is kept
  std::vector<PastAttempt> unkept_numbers;  // the same with their metrics
  ExpertRun expert;
  std::pair<std::string, AttemptSetup> beside;  // attempt that the expert was asked for, and its setup
  std::shared_future<std::shared_ptr<const SceneView>> show_scene;

  std::unique_ptr<LivePublisher> live;   // from the first frame on, where results are kept
  std::optional<LiveAttempt> told;       // of the runner
  std::string told_phase, told_trainee;  // as the desk was told last
  std::optional<Note> message;           // of a teacher, not shown yet
  double unasked_s = 1e9;                // since messages were asked for

  std::filesystem::path settings_file_path() const {
    return options.settings.empty() ? settings_file() : options.settings;
  }
  std::vector<RecoveredAttempt> recovered;  // found cut off when the database was opened

  /// Of PINs at this station, by trainee; until the right one comes.
  struct WrongPins {
    int count = 0;
    std::chrono::steady_clock::time_point until = {};  // none is taken before
  };
  std::map<std::string, WrongPins> wrong_pins;
  std::optional<Account> guarded(const std::string& code) const;
  std::string check_pin(const Account& account, const std::string& pin);

  bool scripted() const { return !options.hand.empty(); }
  std::string hand() const;  // of the next attempt
  bool at_pointer() const;
  std::string backend() const;  // of the next attempt
  bool counts(const AttemptSummary& attempt) const { return scripted() || !by_scripted_hand(attempt); }
  std::string recovered_words(const std::string& of) const;
  void check_names() const;
  void take_up(std::string& notice);
  void open_database(std::string& notice);
  std::vector<AttemptSummary> attempts(const std::string& exercise) const;
  void look_for_note();
  void note_was_met();
  void look_for_due();
  void tell_desk(bool guest);
  void look_for_message();
  bool show_message(std::string& notice);
  std::shared_ptr<const Scene> built(AttemptSetup setup) const;
  /// How the organ of an exercise gives way: one of kTissueWords.
  const std::string& tissue_of(const Exercise& exercise) const {
    return options.tissue.empty() ? exercise.tissue : options.tissue;
  }
  AttemptRequest request(Exercise exercise, const std::string& level, const std::string& organ) const;
  std::string run(AttemptRequest request, Play what);
};

}  // namespace trocar
