// The loop's own memory of a stop as a CSV file beside the recording: changes of state, then the ticks round them.
//
// The recording holds every tick's input and trace; this file adds what the loop sent to the DACs and what it warned
// of.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "haptics/control/safety_log.h"

namespace trocar {

/// "# period,t_s,from,to,cause,channel,value" lines, then a header line and one line a tick.
std::string safety_csv(const std::vector<SafetyTransition>& transitions, const std::vector<SafetyRow>& rows,
                       double rate_hz);

/// What such a file says, field by field as it stands there.
struct SafetyFile {
  using Fields = std::vector<std::string>;
  std::vector<Fields> changes;  ///< of state: period, s, from, to, cause, channel, value
  Fields columns;               ///< of a row
  std::vector<Fields> rows;     ///< a tick each, in order of time
};
/// @throws InputError naming file and line: cut off, or none of this kind; EnvironmentError: cannot be read.
SafetyFile read_safety_file(const std::filesystem::path& file);

/// UUID.trec -> UUID.safety.csv
std::filesystem::path safety_file_of(const std::filesystem::path& recording);

/// @throws EnvironmentError naming the file.
void write_safety_file(const std::filesystem::path& file, const std::string& csv);

}  // namespace trocar
