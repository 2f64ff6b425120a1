// HEADER payload: JSON with the rate, the channels (name, unit, quantum) and the session's own text.
//
// {"attempt": "...", "channels": [{"name","quantum","unit"}, ...], "rate_hz": 1000.0, "session": "..."}. "session" is
// opaque here: whatever the session needs to replay and regrade. It should hold nothing that differs between two equal
// runs, so that equal runs give equal files. "attempt" says whose the recording is (seal.h); not there: of no attempt.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/session/recording/tick_codec.h"

namespace trocar {

struct RecordingHeader {
  std::string session;  ///< UTF-8, any content
  double rate_hz = 1000;
  std::string attempt = {};                    ///< UTF-8; "" of no attempt
  std::vector<RecordedChannel> channels = {};  ///< reading: the columns of its rows, in their order
};

/// @throws InputError when the session's text is not UTF-8 or the rate is not in (0, 1e6] Hz.
std::string encode_header(const RecordingHeader& header);

/// @throws InputError: not JSON, a field missing, or a channel that this program does not know in that unit and
/// quantum.
RecordingHeader decode_header(std::string_view payload);

}  // namespace trocar
