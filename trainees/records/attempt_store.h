// Attempts: begun before the loop starts, finished in one transaction, never changed afterwards.
//
//   AttemptId id = store.begin_attempt(start);   // status "running"
//   ... run, record to id.recording, score ...
//   store.finish_attempt(id, result);            // result, events, metrics, sub-scores, hash: all or nothing
//
// An attempt whose process dies in between is ended as aborted when the database is next opened. Thread: that of the
// Database, never the haptic task.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "haptics/digest/signature.h"
#include "scenarios/scoring/attempt_result.h"
#include "trainees/store/database.h"

namespace trocar {

/// Level whose boards a trainee meets once: a second attempt at the same exercise and board is refused, whatever its
/// seed, organ and hand.
inline constexpr const char* kExamLevel = "exam";

/// What is known before the loop starts.
struct AttemptStart {
  std::string trainee;  ///< code, created when new
  std::string exercise_id, exercise_version, exercise_number, exercise_title;
  std::string exercise_text;  ///< bytes of the exercise file; their sha256 is the rubric's
  std::string level;
  std::int64_t seed = 0;
  int board = 0;
  std::string hand;
  std::string assists = {};  ///< as AttemptResult has it
  std::string program;       ///< its version
  std::string organ_name, organ_source, organ_sha256, organ_credit;
  bool organ_synthetic = false;
  std::string calibration = {},
              calibration_device = {};     ///< text of the calibration file and what it was made on; "" nominal
  std::string session = {}, station = {};  ///< UUID of a sign-in at a station and that one's name; "" none
  /// Where it is recorded. Not given: beside the database (none when in memory). Empty: not recorded.
  std::optional<std::filesystem::path> recording;
  std::string started_utc = {};  ///< empty: now. Given only for invented attempts and those that another station made
};

struct AttemptId {
  std::int64_t row = 0;
  std::string uuid;
  std::filesystem::path recording;  ///< file to record to, empty when none
  std::string rubric_sha256;        ///< of the exercise's bytes
  std::string started_utc;
  /// What binds the recording to it (app/session/recording/seal.h): JSON of the UUIDs of attempt and trainee, exercise,
  /// ruleset, level, seed, board, hand and the station's public key; and that key, where there is one.
  std::string identity;
  std::optional<SigningKey> key = {};
};

/// One line of a list.
struct AttemptSummary {
  std::int64_t row = 0;  ///< its number in this database; at another station the same attempt has another
  std::string uuid, trainee, exercise_id, level, hand, started_utc;
  std::int64_t seed = 0;
  int board = 0;
  std::string status;  ///< status_name(), or "running"
  std::optional<double> score;
  bool passed = false;  ///< what counts: the newest decision of a person, else the score's verdict (verdicts.h)
  std::string grade;
  bool organ_synthetic = false;
  std::string exercise_version, rubric_sha256;
  std::string integrity;                          ///< why it was aborted or void
  bool cut_off = false;                           ///< its program ended before it did
  bool ended_by_device = false;                   ///< by it, or unfit as a record: in no curve (verdicts.h)
  bool begun = true;                              ///< its clock had started; only of what has no number it may not
  bool passed_by_score = false;                   ///< what the score says, whatever was decided
  std::string decided_by = {}, decided_utc = {};  ///< of the newest decision, "" without one
  bool soft_real_time = false;  ///< live on a device, and its loop was refused real-time priority (pacing.h)
};

/// Empty fields do not filter.
struct AttemptFilter {
  std::string trainee, exercise_id;
  int limit = 0;  ///< newest so many; 0: all
};

class AttemptStore {
 public:
  explicit AttemptStore(Database& database) : database_(&database) {}

  /// @throws InputError for a bad trainee code, a second sitting of an exam or a database that is a copy for a desk,
  /// EnvironmentError when the database cannot take it.
  AttemptId begin_attempt(const AttemptStart& start);

  /// Writes the result. What the attempt began with (trainee, exercise, organ, seed) is not taken from `result`; its
  /// recording_path replaces the one at the beginning when given.
  /// @param finished_utc empty: now. Given only for invented attempts, whose clock is another.
  /// @throws InputError when the attempt is not running (finished before, or aborted by recovery), or would end before
  /// it began.
  void finish_attempt(const AttemptId& id, const AttemptResult& result, const std::string& finished_utc = "");

  /// The stored result. What has no column comes back empty: safety_log_path, and of the device force_sensor,
  /// stiffness, reason and where the fault was; the recording's run report keeps those of the device. @throws
  /// InputError: unknown, or still running.
  AttemptResult load(std::int64_t row) const;
  AttemptResult load(std::string_view name) const { return load(find(name).row); }

  /// Attempt by "latest", by its number in this database (AttemptSummary::row, digits that do not begin with 0), or by
  /// a beginning or an end of its UUID of at least 4 characters. A number that is taken is that attempt's, even where
  /// it ends another's UUID.
  /// @throws InputError when none or several match.
  AttemptSummary find(std::string_view name) const;
  /// Newest first.
  std::vector<AttemptSummary> list(const AttemptFilter& filter = {}) const;
  std::optional<AttemptSummary> latest(const std::string& trainee = "") const;

  /// Exercise file as it stood for an attempt, by at least 4 digits of its sha256. @throws InputError: unknown,
  /// several.
  std::string exercise_text(const std::string& rubric_sha256) const;

  /// Why a recording is not that of the attempt, "" when it is: what it says of itself, and by which key that is
  /// signed. Nothing is asked of those that began before recordings named their attempt, nor of a demo's; of those of
  /// other stations, that they are signed.
  std::string recording_problem(const std::string& attempt_uuid, const std::string& identity,
                                const std::string& signed_by) const;

  /// Recordings that finished attempts name but that are missing or changed, and recordings in the database's folder
  /// that no attempt names (an attempt was removed) or that an erasure left, one line each.
  std::vector<std::string> check_recordings() const;

 private:
  Database* database_;
};

inline constexpr const char* kAnotherFile = "another file lies in the place of its recording";

/// Whether what lies in the place of its recording is another file than the attempt was kept with. @throws
/// EnvironmentError: it cannot be read.
bool recording_exchanged(const AttemptResult& stored);

}  // namespace trocar
