// Whether each recording is that of its attempt and still gives what the record says: read, its chain and signature
// looked at, and graded again.
//
// What a record says can be rewritten together with every hash in it; a recording can not without the station's key,
// and a score that it does not give shows. Thread: the caller's, and others of its own while it runs.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "trainees/records/attempt_store.h"

namespace trocar {

/// Why what lies in the place of an attempt's recording is not to be shown as its own, "" when it may be: another file
/// than it was kept with, or, where nothing was graded from it, one that is another attempt's or not signed here.
/// What is no whole recording is told by whoever reads it. @throws EnvironmentError: the file cannot be read.
std::string foreign_recording(Database& database, const AttemptResult& attempt);

/// What the recording of an attempt that was cut off is and gives, a sentence for who decides on the attempt.
std::string recorded_outcome(Database& database, const AttemptResult& attempt);

struct RecordingCheck {
  int jobs = 0;  ///< threads; 0: one a core
  std::function<bool(std::size_t done, std::size_t all)> going =
      {};  ///< now and then, in the caller's thread: false stops
};

/// Of every attempt of this database whose recording is in its place with the bytes that it was kept with; of others
/// AttemptStore::check_recordings() tells. One that was cut off before its recording began has none to look at.
/// @returns a line each.
std::vector<std::string> check_by_recordings(Database& database, const RecordingCheck& options = {});

}  // namespace trocar
