// How far the recordings of a record have been graded again, and what that found. Thread: any.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace trocar::review {

struct RecordingsChecked {
  bool running = false;
  std::size_t done = 0, all = 0;           ///< attempts looked at, and of how many
  std::vector<std::string> problems = {};  ///< of the last check that ended, one line each
  std::string finished_utc = {};           ///< when that was; "" none has ended yet
};

}  // namespace trocar::review
