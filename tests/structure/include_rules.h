// Who may include whom: the one table of the architecture, applied to the text of a file.
#pragma once

#include <string>
#include <vector>

namespace trocar {

struct Include {
  std::string name;
  bool system = false;   ///< in angle brackets
  std::size_t line = 0;  ///< from 1
};

std::vector<Include> includes_of(const std::string& text);

/// One line "FILE:LINE: includes X: rule" for each include that its place in the tree does not allow.
/// @param path from the repository's root: says which rules hold.
std::vector<std::string> include_violations(const std::string& path, const std::string& text);

}  // namespace trocar
