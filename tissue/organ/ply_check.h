// Proves that a PLY file holds every element its header announces, before a library sees it: assimp 5.2.5 runs for ever
// on files that end early.
//
// Format: PLY 1.0, ascii or binary of either byte order. Thread: any, not the tick.
#pragma once

#include <string>
#include <string_view>

namespace trocar {

/// @param file name for messages
/// @throws InputError naming the file and the header line, or the element at which the data ends
void check_ply(std::string_view bytes, const std::string& file);

}  // namespace trocar
