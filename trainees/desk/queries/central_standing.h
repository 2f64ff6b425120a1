// How a desk that serves a central record stands with the centre: shown on every page. Thread: any.
#pragma once

#include <string>

namespace trocar::review {

struct CentralStanding {
  std::string host = {};            ///< of the centre; "" at a station's own desk
  std::string as_of_utc = {};       ///< everything up to then is here
  std::string lost_since_utc = {};  ///< since when the centre cannot be reached; "" it can
  std::string why = {};             ///< in words, with lost_since_utc
  int waiting = 0;                  ///< things written at this desk that are not there yet
};

}  // namespace trocar::review
