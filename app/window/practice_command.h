// `trocar practice`: the trainee's window; or, headless, a picture of every screen for docs and tests.
#pragma once

#include <filesystem>
#include <iosfwd>

#include "app/window/practice/practice_model.h"

namespace trocar {

struct PracticeOptions {
  ModelOptions model = {};
  std::filesystem::path screens = {};  ///< folder for pictures of the screens; empty: the window
  int width = 1280, height = 720;      ///< px
  bool fullscreen = false;
  bool timing = false;  ///< says on `err` when the first frame stood, and how many there were
};

/// @return exit code: 0 closed, or pictures written.
/// @throws EnvironmentError: no display, no OpenGL; says what works without. InputError: bad options.
int practice_command(const PracticeOptions& options, std::ostream& out, std::ostream& err);

}  // namespace trocar
