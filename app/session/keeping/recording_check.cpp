#include "app/session/keeping/recording_check.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <optional>
#include <thread>

#include "app/session/grading/recorded_result.h"
#include "haptics/input_error.h"

namespace trocar {
namespace {

constexpr double kSameScore = 1e-9;

std::string outcome_words(const Grade& grade) {
  const std::string score = grade.score ? ", score " + std::to_string(*grade.score) : "";
  return status_name(grade.status) + score + (grade.passed ? ", passed" : "");
}

bool same_outcome(const Grade& a, const Grade& b) {
  const bool both = a.score.has_value() == b.score.has_value();
  return both && a.status == b.status && a.passed == b.passed &&
         (!a.score || std::abs(*a.score - *b.score) <= kSameScore);
}

/// Why the record does not say what the recording gives, "" when it does. An attempt that was cut off has no grade.
std::string graded_problem(const AttemptResult& stored, const Recording& recording) {
  if (stored.cut_off || !recording.end) return "";
  const Grade again = recorded_result(recording, stored.recording_path).grade;
  return same_outcome(stored.grade, again)
             ? ""
             : "gives " + outcome_words(again) + "; the record says " + outcome_words(stored.grade);
}

bool kept_here(const AttemptResult& stored) {
  return !stored.recording_sha256.empty() && std::filesystem::is_regular_file(stored.recording_path);
}

/// The recording that the attempt was kept with; nothing where another, or none, lies in its place.
std::optional<Recording> kept_recording(const AttemptResult& stored) {
  if (!kept_here(stored) || recording_exchanged(stored)) return std::nullopt;
  return read_recording(stored.recording_path);
}

}  // namespace

std::string foreign_recording(Database& database, const AttemptResult& attempt) {
  if (recording_exchanged(attempt)) return kAnotherFile;
  if (attempt.grade.score || !kept_here(attempt)) return "";
  try {
    const Recording recording = read_recording(attempt.recording_path);
    const std::string another =
        AttemptStore(database).recording_problem(attempt.uuid, recording.attempt, recording.signed_by);
    return another.empty() ? "" : "what lies in the place of its recording " + another;
  } catch (const InputError&) {
    return "";
  }
}

std::string recorded_outcome(Database& database, const AttemptResult& attempt) {
  try {
    const auto recording = kept_recording(attempt);
    if (!recording)
      return "The recording that it was kept with is not in its place: nothing is known of how it went on.";
    const std::string another =
        AttemptStore(database).recording_problem(attempt.uuid, recording->attempt, recording->signed_by);
    if (!another.empty())
      return "What lies in the place of its recording " + another + ": it says nothing of this attempt.";
    if (!recording->end) return "Its recording is its own and stops before the attempt did: there is no score.";
    return "Its recording is its own and whole; graded from it: " +
           outcome_words(recorded_result(*recording, attempt.recording_path).grade) +
           ". It counts as aborted until somebody decides on it.";
  } catch (const InputError& error) {
    return std::string("Its recording cannot be read: ") + error.what();
  }
}

std::vector<std::string> check_by_recordings(Database& database, const RecordingCheck& options) {
  const AttemptStore store(database);
  const std::vector<AttemptSummary> attempts = store.list();
  std::vector<std::string> problems;
  std::atomic<std::size_t> next{0};
  std::atomic<std::size_t> done{0};
  std::atomic<bool> stopped{false};
  std::mutex mutex;  // guards the database and problems
  const auto check_one = [&](const AttemptSummary& attempt) {
    std::unique_lock lock(mutex);
    if (attempt.status == "running") return;
    const AttemptResult stored = store.load(attempt.row);
    lock.unlock();
    std::string problem;
    try {
      if (stored.cut_off && kept_here(stored) && !recording_begins(stored.recording_path)) return;
      const auto recording = kept_recording(stored);
      if (!recording) return;
      problem = graded_problem(stored, *recording);
      lock.lock();
      const std::string another = store.recording_problem(stored.uuid, recording->attempt, recording->signed_by);
      if (!another.empty()) problem = another;
    } catch (const std::exception& error) {
      problem = error.what();
    }
    if (!lock.owns_lock()) lock.lock();
    if (!problem.empty())
      problems.push_back("recording " + stored.recording_path + " of attempt " + stored.uuid + ": " + problem);
  };
  const auto work = [&](bool own) {
    for (std::size_t i = next++; i < attempts.size() && !stopped; i = next++) {
      check_one(attempts[i]);
      ++done;
      if (own && options.going && !options.going(done, attempts.size())) stopped = true;
    }
  };
  const unsigned jobs =
      options.jobs > 0 ? static_cast<unsigned>(options.jobs) : std::max(1u, std::thread::hardware_concurrency());
  {
    std::vector<std::jthread> threads;
    for (unsigned i = 1; i < jobs; ++i) threads.emplace_back(work, false);
    try {
      work(true);
    } catch (...) {
      stopped = true;  // the others are waited for
      throw;
    }
  }
  std::sort(problems.begin(), problems.end());
  return problems;
}

}  // namespace trocar
