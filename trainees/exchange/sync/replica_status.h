// How fresh a copy of a central record is, and whether the centre can be reached: at the foot of every page of a desk
// that serves one. Thread: any.
#pragma once

#include <string>

namespace trocar {

struct ReplicaStatus {
  std::string host = {};            ///< of the centre; "" at a station's own desk
  std::string as_of_utc = {};       ///< everything up to then is here
  std::string lost_since_utc = {};  ///< since when the centre cannot be reached; "" it can
  std::string why = {};             ///< in words, with lost_since_utc
  int waiting = 0;                  ///< things written here that the centre does not have yet
};

}  // namespace trocar
