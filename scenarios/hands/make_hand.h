// A hand by name or from a script file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "scenarios/hands/hand.h"
#include "scenarios/hands/hand_script.h"

namespace trocar {

/// @param name_or_script a name of hands_dir ("expert") or a path to a .toml file. @param seed of everything random.
/// @param attempt of a learner, from 1; its two hands are looked up in hands_dir.
/// @throws InputError listing the known names, or from the script.
std::unique_ptr<Hand> make_hand(const std::string& name_or_script, std::uint64_t seed,
                                const std::filesystem::path& hands_dir, int attempt = 1);
/// A script that needs no other. @throws InputError for a learner.
std::unique_ptr<Hand> make_hand(const HandScript& script, std::uint64_t seed);

}  // namespace trocar
