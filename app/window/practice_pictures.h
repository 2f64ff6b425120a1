// `trocar practice --screens`: a PNG of every page, headless, with an attempt by a scripted hand for those that need
// one.
#pragma once

#include <iosfwd>

#include "app/window/practice_command.h"

namespace trocar {

/// Every page, help, menu, pause and device panel included, into options.screens; file names on `out`. @return exit
/// code.
/// @throws EnvironmentError: no OpenGL, the folder cannot be made, no attempt. InputError: bad options.
int picture_screens(const PracticeOptions& options, std::ostream& out);

}  // namespace trocar
