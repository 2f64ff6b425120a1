#include "app/organs/organ_export.h"

#include <algorithm>
#include <iostream>
#include <memory>
#include <set>
#include <vector>

#include <CLI/CLI.hpp>

#include "app/cli/command.h"
#include "app/organs/organ_package.h"
#include "app/session/setup/scene.h"
#include "haptics/input_error.h"
#include "haptics/utf8.h"
#include "tissue/mesh/files/surface_writer.h"
#include "tissue/organ/organ.h"
#include "tissue/organ/staged_file.h"

namespace trocar {
namespace {

namespace fs = std::filesystem;

/// Made by Trocar, of what, and under which licence: one line.
std::string made_of(const Organ& organ) {
  return harmless("Trocar organ " + organ.name + (organ.synthetic ? " (synthetic)" : "") + ", licence " +
                  organ.licence + (organ.credit.empty() ? "" : ", " + organ.credit));
}

/// @param what that named it, for the message.
const SurfaceFormat& format_named(const std::string& name, const std::string& what) {
  const auto found = written_formats().find(name);
  if (found != written_formats().end()) return found->second;
  std::string known;
  for (const auto& [format, unused] : written_formats()) known += (known.empty() ? "" : ", ") + format;
  throw InputError(what + ": \"" + name + "\" is no format that is written; there are " + known);
}

std::vector<SurfacePartOut> parts_of(const std::vector<const Organ*>& organs) {
  std::vector<SurfacePartOut> parts;
  for (const Organ* organ : organs) parts.push_back({harmless(organ->name), made_of(*organ), &organ->surface});
  return parts;
}

void write(const fs::path& file, const std::string& bytes, std::ostream& out) {
  StagedFile staged(file, bytes);
  staged.commit();
  out << file.string() << '\n';
}

void require_new(const fs::path& file) {
  std::error_code none;
  if (fs::exists(file, none)) throw InputError(file.string() + ": is there already; it is not overwritten");
}

std::string file_name(const Organ& organ) {
  std::string name = organ.name;
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return c <= ' ' || c == '/' || c == 0x7F; }, '_');
  return name.starts_with('.') ? "_" + name : name;
}

}  // namespace

int organ_export(const OrganExportOptions& options, std::ostream& out, std::ostream& err) {
  const fs::path given = find_organ(options.organ, options.assets);
  const Organ organ = load_organ(given);
  std::vector<const Organ*> organs{&organ};
  if (without_subject(given) == given)  // a scene without # is all of it
    for (const Organ& adjacent : organ.adjacent) organs.push_back(&adjacent);
  for (const Organ* one : organs)
    if (!has_licence(one->licence)) err << "note: " << one->name << " has no licence: it may not be passed on\n";
  const std::string suffix = options.output.extension().string();
  if (!suffix.empty()) {
    const SurfaceFormat& format = format_named(suffix.substr(1), options.output.string());
    if (organs.size() > 1 && !format.many)
      throw InputError(options.output.string() + ": holds one organ, and here are " + std::to_string(organs.size()) +
                       ": give a folder, NAME.glb or NAME.obj, or name one organ behind #");
    require_new(options.output);
    write(options.output, format.bytes(parts_of(organs)), out);
    return 0;
  }
  const SurfaceFormat& format = format_named(options.format, "--format");
  std::set<fs::path> files;
  for (const Organ* one : organs) {
    const fs::path file = options.output / (file_name(*one) + "." + options.format);
    require_new(file);
    if (!files.insert(file).second)
      throw InputError(file.string() + ": two organs have this name; give NAME.glb or NAME.obj");
  }
  for (const Organ* one : organs)
    write(options.output / (file_name(*one) + "." + options.format), format.bytes(parts_of({one})), out);
  return 0;
}

void add_organ_export(CLI::App& parent, CommandAction& chosen) {
  const auto given = std::make_shared<OrganExportOptions>();
  OrganExportOptions& o = *given;
  CLI::App* command =
      add_command(parent, "export", "An organ or a scene for 3D Slicer and other programs", chosen, [given] {
        given->assets = find_assets().assets;
        return organ_export(*given, std::cout, std::cerr);
      });
  command->add_option("organ", o.organ, kOrganForms)->required();
  command->add_option("-o,--output", o.output, "FILE.ply, .stl, .obj, .vtk or .glb, or a folder for one file an organ")
      ->required()
      ->check(writable_path());
  command->add_option("--format", o.format, "Of the files in a folder: ply, stl, obj, vtk, glb")->capture_default_str();
}

}  // namespace trocar
