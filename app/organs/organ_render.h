// `trocar organ render FILE`: a picture of an organ as it will look in an exercise.
//
// Thread: main. No window is needed.
#pragma once

#include <filesystem>
#include <iosfwd>

namespace trocar {

struct OrganRenderOptions {
  std::filesystem::path manifest;  ///< NAME.organ.toml
  std::filesystem::path output;    ///< PNG
  int width = 1280, height = 720;  ///< px, 320 x 240 to 7680 x 4320
};

/// @return 0; the written path goes to `out`, progress to `err`.
/// @throws InputError for a bad manifest or size, EnvironmentError without EGL or when the picture cannot be written.
int organ_render(const OrganRenderOptions& options, const std::filesystem::path& asset_root, std::ostream& out,
                 std::ostream& err);

}  // namespace trocar
