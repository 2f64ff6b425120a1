// The one exception for bad input while loading: its message names file and place. Maps to exit code 2.
#pragma once

#include <stdexcept>
#include <string>

namespace trocar {

/// Bad input: message "FILE:LINE:COLUMN: what" or "FILE: what".
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
  InputError(const std::string& file, int line, int column, const std::string& what)
      : std::runtime_error(file + ":" + std::to_string(line) + ":" + std::to_string(column) + ": " + what) {}
};

/// The machine lacks something (no EGL, database not writable). Maps to exit code 3.
class EnvironmentError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace trocar
