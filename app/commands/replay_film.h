// The film of `trocar replay`: one run with its display, or two side by side, to a film file or to numbered pictures.
#pragma once

#include <iosfwd>

#include "app/commands/recording_command.h"
#include "app/commands/recording_subject.h"
#include "app/session.h"

namespace trocar {

/// Whether pictures are wanted on a film's clock: from 1 s before RUN, at a speed, with another run beside.
bool is_film(const RecordingOptions& options);

/// @return what the loop left. @throws InputError, EnvironmentError; Interrupted on Ctrl-C, and then no film stays.
SessionOutcome replay_as_film(const RecordingOptions& options, const Subject& subject, const AssetRoots& assets, std::ostream& err);

}  // namespace trocar
