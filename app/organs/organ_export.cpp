#include "app/organs/organ_export.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <map>
#include <memory>
#include <sstream>
#include <vector>

#include <CLI/CLI.hpp>

#include "app/cli/command.h"
#include "app/cli/progress_display.h"
#include "app/organs/organ_package.h"
#include "app/session/setup/scene.h"
#include "haptics/input_error.h"
#include "haptics/utf8.h"
#include "tissue/imaging/labels/segment.h"
#include "tissue/imaging/volumes/volume_frame.h"
#include "tissue/mesh/files/surface_writer.h"
#include "tissue/organ/organ.h"
#include "tissue/organ/staged_file.h"
#include "tissue/solid/tetrahedra_file.h"
#include "tissue/solid/tissue_table.h"

namespace trocar {
namespace {

namespace fs = std::filesystem;

/// Made by Trocar, of what, and under which licence: one line.
std::string made_of(const Organ& organ) {
  return harmless("Trocar organ " + organ.name + (organ.synthetic ? " (synthetic)" : "") + ", licence " +
                  organ.licence + (organ.credit.empty() ? "" : ", " + organ.credit));
}

/// @param name in any case. @param what that named it, for the message.
template <typename Format>
const Format& format_named(const std::map<std::string, Format>& formats, const std::string& name,
                           const std::string& what) {
  const auto found = formats.find(lower_case(name));
  if (found != formats.end()) return found->second;
  std::string known;
  for (const auto& [format, unused] : formats) known += (known.empty() ? "" : ", ") + format;
  throw InputError(what + ": \"" + name + "\" is no format that is written; there are " + known);
}

std::vector<SurfacePartOut> parts_of(const std::vector<const Organ*>& organs) {
  std::vector<SurfacePartOut> parts;
  for (const Organ* organ : organs)
    parts.push_back({harmless(organ->name), harmless(organ->material), made_of(*organ), &organ->surface});
  return parts;
}

/// All of the files, or none of them.
void write(const std::vector<std::pair<fs::path, std::string>>& files, std::ostream& out) {
  std::vector<std::unique_ptr<StagedFile>> staged;
  for (const auto& [file, bytes] : files) staged.push_back(std::make_unique<StagedFile>(file, bytes));
  for (std::size_t n = 0; n < files.size(); ++n) {
    staged[n]->commit();
    out << files[n].first.string() << '\n';
  }
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

void export_tetrahedra(const std::vector<const Organ*>& organs, const OrganExportOptions& options, std::ostream& out) {
  const std::string suffix = options.output.extension().string();
  if (suffix.empty())
    throw InputError(options.output.string() + ": tetrahedra go into one file: NAME.msh, NAME.vtu or NAME.feb");
  const TetrahedraFormat format =
      format_named(written_tetrahedra(), suffix.substr(1), options.output.string() + " with --tetrahedra");
  require_new(options.output);
  const TissueTable tissues = TissueTable::load(options.assets / "tissues.toml");
  std::vector<const TriangleSurface*> surfaces;
  std::vector<TetrahedraPartOut> parts;
  for (const Organ* organ : organs) {
    surfaces.push_back(&organ->surface);
    const std::string& tissue = tissues.knows(organ->material) ? organ->material : organ->name;
    parts.push_back({harmless(organ->name), made_of(*organ), tissues.find(tissue), tissues.knows(tissue)});
  }
  const BuiltTetrahedra built =
      make_tetrahedra(surfaces, {.cell_m = *options.tetrahedra_mm * 1e-3, .progress = options.progress});
  const TetrahedraFacts& facts = built.facts;
  for (std::size_t n = 0; n < organs.size(); ++n)
    if (facts.regions[n].tetrahedra == 0)
      throw InputError(organs[n]->name +
                       ": nothing of it lies outside smaller organs, or it is too thin for this size");
  write({{options.output, format(built.mesh, parts)}}, out);
  std::ostringstream line;
  line << std::fixed << std::setprecision(2) << facts.tetrahedra << " tetrahedra, " << facts.nodes
       << " nodes; smallest dihedral angle " << facts.min_dihedral_deg << " degrees; volume within "
       << std::abs(facts.volume_error_pct) << " %, distance from the surfaces " << facts.surface_rms_m * 1e3
       << " mm (rms), at most " << facts.surface_max_m * 1e3 << " mm\n";
  out << line.str();
}

void export_folder(const std::vector<const Organ*>& organs, const OrganExportOptions& options, std::ostream& out) {
  const SurfaceFormat& format = format_named(written_formats(), options.format, "--format");
  std::map<fs::path, const Organ*> files;
  for (const Organ* one : organs) {
    const fs::path file = options.output / (file_name(*one) + "." + options.format);
    require_new(file);
    if (!files.emplace(file, one).second)
      throw InputError(file.string() + ": two organs have this name; give NAME.glb or NAME.obj");
  }
  std::vector<std::pair<fs::path, std::string>> written;
  for (const auto& [file, organ] : files) written.emplace_back(file, format.bytes(parts_of({organ})));
  const bool made = !fs::exists(options.output);
  try {
    write(written, out);
  } catch (const EnvironmentError&) {
    std::error_code none;
    if (made) fs::remove(options.output, none);  // if it is empty
    throw;
  }
}

void export_surfaces(const std::vector<const Organ*>& organs, const OrganExportOptions& options, std::ostream& out) {
  const std::string suffix = options.output.extension().string();
  if (suffix.empty()) return export_folder(organs, options, out);
  if (written_tetrahedra().contains(lower_case(suffix.substr(1))))
    throw InputError(options.output.string() + ": holds tetrahedra: give their size, --tetrahedra 8");
  const SurfaceFormat& format = format_named(written_formats(), suffix.substr(1), options.output.string());
  if (organs.size() > 1 && !format.many)
    throw InputError(options.output.string() + ": holds one organ, and here are " + std::to_string(organs.size()) +
                     ": give a folder, NAME.glb or NAME.obj, or name one organ behind #");
  require_new(options.output);
  write({{options.output, format.bytes(parts_of(organs))}}, out);
}

void note_licences(const std::vector<const Organ*>& organs, std::ostream& err) {
  constexpr std::size_t kListed = 4;
  std::vector<std::string> without;
  for (const Organ* one : organs)
    if (!has_licence(one->licence)) without.push_back(one->name);
  if (!without.empty())
    err << "note: " << listed_words(without, kListed)
        << (without.size() == 1 ? " has no licence: it may not be passed on\n"
                                : " have no licence: they may not be passed on\n");
}

}  // namespace

int organ_export(const OrganExportOptions& options, std::ostream& out, std::ostream& err) {
  const fs::path given = find_organ(options.organ, options.assets);
  const Organ organ = load_organ(given);
  std::vector<const Organ*> organs{&organ};
  if (without_subject(given) == given)  // a scene without # is all of it
    for (const Organ& adjacent : organ.adjacent) organs.push_back(&adjacent);
  options.tetrahedra_mm ? export_tetrahedra(organs, options, out) : export_surfaces(organs, options, out);
  note_licences(organs, err);
  return 0;
}

void add_organ_export(CLI::App& parent, CommandAction& chosen) {
  const auto given = std::make_shared<OrganExportOptions>();
  OrganExportOptions& o = *given;
  CLI::App* command =
      add_command(parent, "export", "An organ or a scene for 3D Slicer and other programs", chosen, [given] {
        given->assets = find_assets().assets;
        ProgressDisplay progress(std::cerr, error_is_terminal());
        given->progress = progress.function();
        const int code = organ_export(*given, std::cout, std::cerr);
        progress.clear();
        return code;
      });
  command->add_option("organ", o.organ, kOrganForms)->required();
  command
      ->add_option("-o,--output", o.output,
                   "FILE.ply, .stl, .obj, .vtk, .vtp or .glb, or a folder for one file an organ; with --tetrahedra "
                   "FILE.msh, .vtu or .feb")
      ->required()
      ->check(writable_path());
  command->add_option("--format", o.format, "Of the files in a folder: ply, stl, obj, vtk, vtp, glb")
      ->capture_default_str();
  command->add_option("--tetrahedra", o.tetrahedra_mm,
                      "Tetrahedra of this size, mm, one region an organ: .msh and .feb in metres, .vtu in mm");
}

}  // namespace trocar
