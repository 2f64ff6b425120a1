// How often a sweep is repeated: a few times in every run, many times under the ctest label long, which sets the
// variable.
#pragma once

#include <cstdlib>

namespace trocar::test {

/// The whole number in environment variable `variable`, or `usual` where it is not set.
inline int repeats(const char* variable, int usual) {
  const char* given = std::getenv(variable);
  return given ? std::atoi(given) : usual;
}

}  // namespace trocar::test
