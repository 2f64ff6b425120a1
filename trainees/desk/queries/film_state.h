// How it stands with the film of an attempt. Thread: plain value.
#pragma once

#include <cstdint>
#include <string>

namespace trocar::review {

struct FilmState {
  enum class Stage : std::uint8_t { kNone, kMaking, kReady, kFailed } stage = Stage::kNone;
  double share = 0;         ///< of kMaking, 0..1
  std::string words = {};   ///< what is done now, or why it failed
  std::uint64_t bytes = 0;  ///< of kReady
};

}  // namespace trocar::review
