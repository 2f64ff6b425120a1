#include "app/organs/organ_render.h"

#include <cstdint>
#include <iostream>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>

#include "app/cli/command.h"
#include "app/picture/gl/headless_context.h"
#include "app/picture/models/organ_scene.h"
#include "app/picture/scene/renderer.h"
#include "app/session/setup/scene.h"
#include "haptics/input_error.h"
#include "tissue/organ/organ.h"
#include "tissue/organ/staged_file.h"

namespace trocar {

int organ_render(const OrganRenderOptions& options, const std::filesystem::path& asset_root, std::ostream& out,
                 std::ostream& err) {
  if (options.width < 320 || options.height < 240 || options.width > 7680 || options.height > 4320)
    throw InputError("organ render: the size must lie between 320 x 240 and 7680 x 4320 pixels, not " +
                     std::to_string(options.width) + " x " + std::to_string(options.height));
  const Organ organ = load_organ(options.manifest);
  HeadlessContext context;
  err << "drawing " << organ.name << " with " << context.info().renderer << "\n";
  Renderer renderer(context, asset_root);
  const std::vector<std::uint8_t> png = encode_png(renderer.render(organ_scene(organ), options.width, options.height));
  StagedFile file(options.output, std::string_view(reinterpret_cast<const char*>(png.data()), png.size()));
  file.commit();
  out << options.output.string() << "\n";
  return 0;
}

namespace {
struct OrganRenderArguments {
  OrganRenderOptions options;
  std::string organ;
};
}  // namespace

void add_organ_render(CLI::App& parent, CommandAction& chosen) {
  const auto given = std::make_shared<OrganRenderArguments>();
  OrganRenderOptions& o = given->options;
  CLI::App* render = add_command(parent, "render", "A picture of an organ or a scene", chosen, [given] {
    const std::filesystem::path assets = find_assets().assets;
    given->options.manifest = find_organ(given->organ, assets);
    return organ_render(given->options, assets, std::cout, std::cerr);
  });
  render->add_option("-o,--output", o.output, "PNG file")->required()->check(writable_path());
  render->add_option("--width", o.width, "px")->capture_default_str();
  render->add_option("--height", o.height, "px")->capture_default_str();
  render->add_option("organ", given->organ, kOrganForms)->required();
}

}  // namespace trocar
