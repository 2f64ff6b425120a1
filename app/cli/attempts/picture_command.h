// `trocar picture`: a picture of the show scene, as the renderer draws it on this machine; no window is needed.
//
// Thread: main.
#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

namespace trocar {

struct PictureOptions {
  std::filesystem::path output;    ///< PNG
  std::string scene = "abdomen";   ///< of show_scene(), or "marks": the twelve marks of a laparoscopic view, pointed at
  std::string preset = "full";     ///< "low", "soft", "full", or "auto": chosen by timing
  int width = 1280, height = 720;  ///< px, 320 x 240 to 7680 x 4320
  std::uint64_t seed = 1;          ///< of lumps and lobes
  std::string scope = "0";         ///< tilt of the scope's tip, degrees: "0" or "30"
  double post_deg = 0;             ///< the light post's turn: of the notch, and of where a tilted tip looks
  bool no_grain = false;           ///< without sensor grain: smaller files
};

/// Every scene that the command knows.
std::vector<std::string> picture_scenes();

/// @return 0; the written path goes to `out`, preset and driver to `err`.
/// @throws InputError for an unknown scene or preset or a bad size, EnvironmentError without EGL or when the file
/// cannot be written.
int picture_command(const PictureOptions& options, const std::filesystem::path& asset_root, std::ostream& out,
                    std::ostream& err);

}  // namespace trocar
