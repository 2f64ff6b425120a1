// `trocar study NAME --out DIR`: does an experiment again and writes its data, plots and summary.
#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

namespace trocar {

struct StudyOptions {
  std::string name;
  std::filesystem::path out;
  bool json = false;
  bool quick = false;                ///< fewer trials of the same kind
  std::uint64_t seed = 1;            ///< of everything that is drawn
  std::filesystem::path plant = {};  ///< plant file, for the studies that take one
  bool nominal = false;              ///< no drawn arms, for the studies that draw them
  std::string sensor = {};           ///< force sensor whose line the forces come through, for the study that reads one
};

/// Names that study_command knows.
std::vector<std::string> study_names();

/// @return 0 when every bar is met, 1 otherwise. @throws InputError for an unknown study.
int study_command(const StudyOptions& options, std::ostream& out, std::ostream& err);

}  // namespace trocar
