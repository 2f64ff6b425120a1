// The film of `trocar replay`: one run with its display, or two side by side, to a film file or to numbered pictures.
#pragma once

#include <iosfwd>
#include <optional>

#include "app/cli/attempts/recording_command.h"
#include "app/cli/attempts/recording_subject.h"
#include "app/picture/scene/preset.h"
#include "app/session/session.h"

namespace trocar {

/// Whether pictures are wanted on a film's clock: from 1 s before RUN, at a speed, with another run beside.
bool is_film(const RecordingOptions& options);

/// Preset of a film's pictures. @param asked a preset's name or "auto": full where a GPU draws; a software rasteriser
/// takes soft, which is made for it, and `err` says so: full takes about three times as long. @throws EnvironmentError
/// without EGL.
Preset film_preset(const std::string& asked, std::ostream& err);

/// @return what the loop left; none where keyframes were played and it was not run. @throws InputError,
/// EnvironmentError; Interrupted on Ctrl-C, and then no film stays.
std::optional<SessionOutcome> replay_as_film(const RecordingOptions& options, const Subject& subject,
                                             const AssetRoots& assets, std::ostream& err);

}  // namespace trocar
