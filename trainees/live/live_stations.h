// What a desk reads of the programs that share its database: one entry for each, and what could not be read.
//
// A program that died without a farewell has ended unexpectedly: its process is looked for by its identity, not by the
// age of what it said. One that lives but has said nothing while a desk looked does not answer. Thread: any; nothing
// throws.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "trainees/live/live_moment.h"

namespace trocar {

struct LiveStation {
  enum class State : std::uint8_t { kRunning, kQuiet, kEnded };
  StatusSnapshot told = {};
  State state = State::kRunning;
  double age_s = 0;          ///< of what it said
  std::string picture = {};  ///< name of its picture; "" where there is none of this moment
};

struct LiveStations {
  std::vector<LiveStation> stations = {};    ///< that run first, then by trainee
  std::vector<std::string> unreadable = {};  ///< names of files that are none of a program's, or not to be trusted
  std::string refusal = {};                  ///< why nothing at all is read
};

/// Programs write only while somebody looks: this tells them so. @param database its file.
LiveStations look_at_stations(const std::filesystem::path& database);
/// JPEG of a station's picture; nothing where there is none of that name, or it is not to be trusted.
std::optional<std::string> look_at_picture(const std::filesystem::path& database, const std::string& name);

}  // namespace trocar
