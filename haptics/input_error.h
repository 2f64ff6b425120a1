// The two exceptions of the program: InputError for what somebody gave it (the message names file and place),
// EnvironmentError for what the machine lacks. The loop throws neither.
#pragma once

#include <stdexcept>
#include <string>

namespace trocar {

/// Bad input: message "FILE:LINE:COLUMN: what" or "FILE: what". Maps to exit code 2.
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
