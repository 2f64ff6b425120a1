#include "app/cli/attempts/picture_command.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <numbers>
#include <optional>
#include <string_view>

#include <CLI/CLI.hpp>

#include "app/cli/command.h"
#include "app/picture/gl/headless_context.h"
#include "app/picture/models/show_scene.h"
#include "app/picture/scene/marks_montage.h"
#include "app/picture/scene/preset.h"
#include "app/picture/scene/renderer.h"
#include "app/session/setup/scene.h"
#include "app/window/run/run_view.h"
#include "haptics/input_error.h"
#include "tissue/organ/staged_file.h"

namespace trocar {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

std::string listed(const std::vector<std::string>& names) {
  std::string out;
  for (const std::string& name : names) out += (out.empty() ? "" : ", ") + name;
  return out;
}

void check(const PictureOptions& options) {
  const std::vector<std::string> scenes = picture_scenes();
  if (std::find(scenes.begin(), scenes.end(), options.scene) == scenes.end())
    throw InputError("picture: no scene is called '" + options.scene + "'; there are " + listed(scenes));
  if (options.preset != "auto" && !preset_named(options.preset))
    throw InputError("picture: no preset is called '" + options.preset + "'; there are low, soft, full and auto");
  if (options.scope != "0" && options.scope != "30")
    throw InputError("picture: a scope has a tip of 0 or 30 degrees, not '" + options.scope + "'");
  if (!(std::abs(options.post_deg) <= 360))
    throw InputError("picture: the light post is turned by at most 360 degrees");
  if (options.scene == "marks" && (options.scope != "0" || options.post_deg != 0))
    throw InputError(
        "picture: the twelve marks are pointed at through a straight scope; --scope and --post belong to the other "
        "scenes");
  const int least_w = options.scene == "marks" ? 640 : 320, least_h = options.scene == "marks" ? 360 : 240;
  if (options.width < least_w || options.height < least_h || options.width > 7680 || options.height > 4320)
    throw InputError("picture: the size must lie between " + std::to_string(least_w) + " x " + std::to_string(least_h) +
                     " and 7680 x 4320 pixels, not " + std::to_string(options.width) + " x " +
                     std::to_string(options.height));
}

/// The scene as the scope that was asked for shows it.
SceneView scoped_scene(const PictureOptions& options) {
  SceneView view = show_scene(options.scene, options.seed);
  view.camera =
      moved_camera(view.camera, {.post_rad = options.post_deg * kDegree}, options.scope == "30" ? 30 * kDegree : 0);
  return view;
}

}  // namespace

std::vector<std::string> picture_scenes() {
  std::vector<std::string> scenes = show_scene_names();
  scenes.emplace_back("marks");
  return scenes;
}

int picture_command(const PictureOptions& options, const std::filesystem::path& asset_root, std::ostream& out,
                    std::ostream& err) {
  check(options);
  HeadlessContext context;
  RenderOptions render;
  render.grain = !options.no_grain;
  render.preset = options.preset == "auto" ? measure_preset(context, asset_root, options.width, options.height)
                                           : *preset_named(options.preset);
  err << "drawing " << options.scene << ", preset " << preset_name(render.preset) << ", with "
      << context.info().renderer << "\n";
  Renderer renderer(context, asset_root, render);
  const Image image = options.scene == "marks" ? marks_montage(renderer, options.width, options.height, options.seed)
                                               : renderer.render(scoped_scene(options), options.width, options.height);
  const std::vector<std::uint8_t> png = encode_png(image);
  StagedFile file(options.output, std::string_view(reinterpret_cast<const char*>(png.data()), png.size()));
  file.commit();
  out << options.output.string() << "\n";
  return 0;
}

void add_picture(CLI::App& parent, CommandAction& chosen) {
  const auto given = std::make_shared<PictureOptions>();
  PictureOptions& o = *given;
  CLI::App* picture =
      add_command(parent, "picture", "A picture of the show scene, as this machine draws it", chosen,
                  [given] { return picture_command(*given, find_assets().assets, std::cout, std::cerr); });
  picture->add_option("--out", o.output, "PNG file")->required()->check(writable_path());
  picture->add_option("--scene", o.scene, "One of: " + listed(picture_scenes()))->capture_default_str();
  picture->add_option("--preset", o.preset, "low, soft, full, or auto: chosen by timing")->capture_default_str();
  picture->add_option("--scope", o.scope, "Tip of the scope: 0 or 30 degrees")->capture_default_str();
  picture->add_option("--post", o.post_deg, "Degrees by which the light post is turned")->capture_default_str();
  picture->add_option("--width", o.width, "Pixels")->capture_default_str();
  picture->add_option("--height", o.height, "Pixels")->capture_default_str();
  picture->add_flag("--no-grain", o.no_grain, "Without sensor grain: smaller files");
  picture->add_option("--seed", o.seed, "Of lumps and lobes")->capture_default_str()->check(seed_range());
}

}  // namespace trocar
