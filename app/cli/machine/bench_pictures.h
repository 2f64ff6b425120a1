// What a picture of the scope costs on this machine, by scene and preset, at 1280 x 720, nothing read back.
//
// Thread: main.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

namespace trocar {

struct PictureCost {
  std::string scene, preset;
  double cpu_ms = 0;  ///< a picture, all threads of the process: what a software rasteriser really takes
  double per_s = 0;   ///< pictures a second by the clock, with whatever else the machine does
};

/// Draws the show scene's board and abdomen with every preset. Empty, with a line on `err`, where nothing can be drawn.
std::vector<PictureCost> picture_costs(const std::filesystem::path& asset_root, std::ostream& err);

void print_pictures(const std::vector<PictureCost>& costs, std::ostream& out);

}  // namespace trocar
