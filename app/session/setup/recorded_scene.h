// The scene of a recording: its own setup, on the organ of today, which must be the same one.
//
// Used by everything that runs a recording again. Thread: loading only.
#pragma once

#include <filesystem>
#include <string>

#include "app/session/recording/recording_reader.h"
#include "app/session/setup/scene.h"

namespace trocar {

/// @param file of the recording, for messages. @param organ where the organ lies now, "" as recorded.
/// @throws InputError: organ missing or another one, or recorded with another force scale than this program computes.
Scene recorded_scene(const Recording& recording, const std::filesystem::path& file, const AssetRoots& assets,
                     const std::string& organ = "");

/// The setup alone, without loading any organ. @throws InputError: unreadable.
AttemptSetup recorded_setup(const std::filesystem::path& file);

}  // namespace trocar
