// A short attempt of a scripted hand, recorded to a file: what films are made of in tests.
#pragma once

#include <filesystem>

#include "app/session/session.h"

namespace trocar {

/// E02 cut to two discs and the block, 30 s at most.
AttemptSetup short_setup(const std::string& hand = "expert");
Scene short_scene(const std::string& hand = "expert");
/// Runs it in lockstep. @return the file.
std::filesystem::path record_short(const std::filesystem::path& file, const std::string& hand = "expert",
                                   const SessionObserver& observe = {});

}  // namespace trocar
