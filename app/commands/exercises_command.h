// `trocar check`: exercise files validated, their boards proved reachable.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

namespace trocar {

/// Validates exercises (id or file) and lays out boards 0 to 19 of each on an organ. @return 0 when all are sound, else 2.
int check_command(const std::vector<std::string>& subjects, const std::string& organ, std::ostream& out,
                  std::ostream& err);

}  // namespace trocar
