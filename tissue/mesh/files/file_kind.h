// What a surface file is: by its extension, which its first bytes must bear out.
//
// Thread: any.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace trocar {

enum class SurfaceKind { kStl, kPly, kObj, kOff, kGlb, kGltf, kFbx, kVtk, kVtp, kVtu, kMsh };

/// By the extension, in any case; empty for others.
std::optional<SurfaceKind> kind_by_extension(const std::filesystem::path& path);

/// What the bytes look like, "a PNG picture"; "" when they look like nothing that is known here.
std::string looks_like(std::string_view bytes);

/// Extension and first bytes together.
/// @throws InputError saying what the extension promises and what the bytes look like, or which formats are read
SurfaceKind surface_kind(const std::filesystem::path& path, std::string_view bytes);

}  // namespace trocar
