// A hand by name or from a script file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "scenarios/hands/hand.h"
#include "scenarios/hands/hand_script.h"

namespace trocar {

/// @param name_or_script a name of hands_dir ("expert"), a path to a .toml file, or one of a population
/// ("population#17"). @param seed of everything random; persons of a population differ under the same one.
/// @param attempt of a learner, from 1; the hands that it is made of are looked up in hands_dir.
/// @throws InputError listing the known names, or from the script.
std::unique_ptr<Hand> make_hand(const std::string& name_or_script, std::uint64_t seed,
                                const std::filesystem::path& hands_dir, int attempt = 1);
/// A script that needs no other. @throws InputError for a learner and a population.
std::unique_ptr<Hand> make_hand(const HandScript& script, std::uint64_t seed);

/// Bytes of the scripts that a hand is made of: whoever hashes them tells two versions of a hand apart. @throws as
/// make_hand().
std::string hand_bytes(const std::string& name_or_script, const std::filesystem::path& hands_dir);

}  // namespace trocar
