// The structure of a glTF file before a library reads it: every index and length within what is there, nothing outside
// its folder.
//
// glTF 2.0 (ISO/IEC 12113). Thread: any.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace trocar {

/// @param bytes the whole .glb or .gltf file @param path where it lies: buffers are looked for beside it
/// @return what will be left out: skins, morph targets
/// @throws InputError naming the file: damaged, version 1, an extension that it needs and that is not read, a buffer
/// elsewhere
std::vector<std::string> check_gltf(std::string_view bytes, const std::filesystem::path& path);

}  // namespace trocar
