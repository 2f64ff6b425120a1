// `trocar doctor`: what this machine offers the program, and what is missing.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>

namespace trocar {

struct DoctorOptions {
  std::filesystem::path database;      ///< empty: the default path
  std::string card = {}, sensor = {};  ///< to be asked too: card or boards, and a force sensor, as run takes them
  std::filesystem::path device = {};   ///< whose [sensor] says how many counts a newton has
  bool json = false;
};

/// Looks only: no database is made, migrated or repaired.
/// Each finding is ok, a warning or a problem, and says what to do.
/// @return 0 when everything that a run needs is there, 3 with a problem. What only a live run with a device would like
/// (real-time priority, locked memory, a real-time kernel) is a warning.
int doctor_command(const DoctorOptions& options, std::ostream& out, std::ostream& err);

}  // namespace trocar
