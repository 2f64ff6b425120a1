// What stands between a text from outside and the TOML parser, which goes a level deeper into the stack for each part
// of a dotted key and counts only nested values: forty thousand parts ended the program.
#pragma once

#include <string>
#include <string_view>

namespace trocar {

inline constexpr int kMostKeyParts = 32;

/// @throws InputError with its place: a key or table name ("a.b.c") of more parts.
void require_short_keys(std::string_view toml, const std::string& name);

}  // namespace trocar
