// Exercise files with a mistake in them, and what the loader says of it.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "haptics/input_error.h"
#include "scenarios/files/exercise_loader.h"

namespace trocar::test {

/// The text with the first `from` replaced by `to`.
inline std::string edited(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  if (at != std::string::npos) return text.replace(at, from.size(), to);
  ADD_FAILURE() << "not in the file: " << from;
  return text;
}

/// The loader's message about a file "bad.toml" of that text; "accepted" when it has none.
inline std::string refusal(const std::string& text) {
  try {
    parse_exercise(text, "bad.toml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace trocar::test
