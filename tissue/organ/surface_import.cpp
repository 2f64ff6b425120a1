#include "tissue/organ/surface_import.h"

#include <algorithm>

#include "haptics/input_error.h"
#include "tissue/imaging/labels/segment.h"
#include "tissue/mesh/files/closing.h"
#include "tissue/mesh/files/file_kind.h"
#include "tissue/mesh/files/placement.h"
#include "tissue/mesh/files/read_surface_file.h"
#include "tissue/mesh/files/tetrahedra.h"

namespace trocar {
namespace {

std::vector<SurfacePart> solid_parts(const FileTetrahedra& mesh) {
  std::vector<SurfacePart> parts;
  for (const std::string& name : mesh.region_names) parts.push_back({name, 0});
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
    ++parts[mesh.regions.empty() ? 0 : static_cast<std::size_t>(mesh.regions[t])].triangles;
  return parts;
}

/// Tetrahedra go before surfaces that are stored beside them.
std::vector<SurfacePart> parts_of(const SurfaceFile& file) {
  if (!file.tetrahedra.tetrahedra.empty()) return solid_parts(file.tetrahedra);
  std::vector<SurfacePart> parts;
  for (const FilePart& part : file.parts) parts.push_back({part.name, part.surface.triangles.size()});
  return parts;
}

/// " (its parts: a, b, c and 7 more)", "" for one without a name.
std::string listed_pieces(const std::vector<SurfacePart>& parts) {
  constexpr std::size_t kListed = 12;
  if (parts.size() < 2 && (parts.empty() || parts[0].name.empty())) return {};
  std::vector<std::string> names;
  for (const SurfacePart& part : parts) names.push_back(part.name);
  return " (its parts: " + listed_words(names, kListed) + ")";
}

void append_surface(TriangleSurface& whole, const TriangleSurface& part) {
  const auto shift = static_cast<std::int32_t>(whole.vertices.size());
  whole.vertices.insert(whole.vertices.end(), part.vertices.begin(), part.vertices.end());
  for (const auto& [a, b, c] : part.triangles) whole.triangles.push_back({a + shift, b + shift, c + shift});
}

bool is_taken(const FilePart& part, const std::string& wanted) {
  return wanted.empty() || part.name == wanted ||
         std::find(part.groups.begin(), part.groups.end(), wanted) != part.groups.end();
}

[[noreturn]] void no_such_part(const std::string& wanted, const std::vector<SurfacePart>& parts,
                               const std::string& file) {
  throw InputError(file + ": has no part \"" + printable(wanted) + "\"" + listed_pieces(parts));
}

std::optional<std::int32_t> wanted_region(const FileTetrahedra& mesh, const std::string& wanted,
                                          const std::string& file) {
  if (wanted.empty()) return std::nullopt;
  for (std::size_t n = 0; n < mesh.region_names.size(); ++n)
    if (mesh.region_names[n] == wanted) return static_cast<std::int32_t>(n);
  no_such_part(wanted, solid_parts(mesh), file);
}

TriangleSurface taken_from_solid(SurfaceFile& read, const SurfaceImportOptions& options, const std::string& file) {
  const FileTetrahedra& mesh = read.tetrahedra;
  const TriangleSurface surface = outer_surface(mesh, wanted_region(mesh, options.part, file));
  read.remarks.push_back("took the outer surface (" + std::to_string(surface.triangles.size()) + " triangles) of " +
                         std::to_string(mesh.tetrahedra.size()) + " tetrahedra" +
                         (read.parts.empty() ? "" : "; surfaces stored beside them were left out"));
  return surface;
}

TriangleSurface taken_piece(SurfaceFile& read, const SurfaceImportOptions& options, const std::string& file) {
  if (!read.tetrahedra.tetrahedra.empty()) return taken_from_solid(read, options, file);
  TriangleSurface surface;
  std::size_t count = 0;
  for (FilePart& part : read.parts) {
    if (!is_taken(part, options.part)) continue;
    ++count;
    append_surface(surface, part.surface);
    part.surface = {};
  }
  if (count == 0) no_such_part(options.part, parts_of(read), file);
  if (count > 1 || count < read.parts.size())
    read.remarks.push_back("took " + std::to_string(count) + " of " + std::to_string(read.parts.size()) + " parts" +
                           (count > 1 ? " as one surface, welded across them" : ""));
  return surface;
}

Eigen::AlignedBox3d bounds_of_triangles(const TriangleSurface& surface) {
  Eigen::AlignedBox3d box;
  for (const auto& triangle : surface.triangles)
    for (const std::int32_t vertex : triangle) box.extend(surface.vertices[static_cast<std::size_t>(vertex)]);
  return box;
}

std::string organ_of(const SurfaceImportOptions& options, const std::filesystem::path& path) {
  return !options.organ.empty() ? options.organ : options.part + " " + path.stem().string();
}

void place(TriangleSurface& surface, const Placement& placement) {
  for (Vec3& vertex : surface.vertices) vertex = placement.placed(vertex);
  if (!placement.mirrors()) return;
  for (auto& triangle : surface.triangles) std::swap(triangle[1], triangle[2]);
}

void check_import_options(const SurfaceImportOptions& options, const std::string& file) {
  if (!options.unit.empty()) metres_per(options.unit);
  if (options.fill_holes_mm && !(*options.fill_holes_mm > 0 && *options.fill_holes_mm <= 1000))
    throw InputError(file + ": the widest hole to fill must lie between 0 and 1000 mm");
  if (options.wrap && !(options.wrap->alpha_mm > 0 && options.wrap->alpha_mm <= 1000 && options.wrap->offset_mm > 0))
    throw InputError(file + ": alpha and offset of a wrap must be above 0 (and at most 1000 mm)");
}

}  // namespace

bool is_surface_file(const std::filesystem::path& path) { return kind_by_extension(path).has_value(); }

ImportedSurface import_surface(const std::filesystem::path& path, const SurfaceImportOptions& options,
                               const Progress& progress) {
  const std::string file = path.string();
  check_import_options(options, file);
  SurfaceFile read = read_surface_file(path, progress);
  ImportedSurface result;
  result.parts = parts_of(read);
  result.name = read.name, result.material = read.material;
  TriangleSurface surface = taken_piece(read, options, file);
  const std::string organ = organ_of(options, path);
  const Placement placement = placement_of(read, options, bounds_of_triangles(surface), organ, file);
  result.unit = placement.unit, result.frame = placement.frame, result.decisions = placement.decisions;
  result.decisions.insert(result.decisions.end(), read.remarks.begin(), read.remarks.end());
  read = {};
  place(surface, placement);
  try {
    close_surface(surface, options, organ, file, result, progress);
  } catch (const InputError& refusal) {
    if (result.parts.size() < 2 || !options.part.empty()) throw;
    throw InputError(refusal.what() + std::string("; or take one part with --part") + listed_pieces(result.parts));
  }
  report(progress, "checking", 1);
  return result;
}

ImportedSurface import_surface(const std::filesystem::path& path, const std::string& unit) {
  SurfaceImportOptions options;
  options.unit = unit;
  return import_surface(path, options);
}

std::vector<SurfacePart> list_surface_parts(const std::filesystem::path& path, const Progress& progress) {
  return parts_of(read_surface_file(path, progress));
}

ImportedTetrahedra read_tetrahedra(const std::filesystem::path& path, const SurfaceImportOptions& options,
                                   const Progress& progress) {
  const std::string file = path.string();
  const SurfaceFile read = read_surface_file(path, progress);
  const FileTetrahedra& mesh = read.tetrahedra;
  if (mesh.tetrahedra.empty()) throw InputError(file + ": holds no tetrahedra, only triangles");
  const auto region = wanted_region(mesh, options.part, file);
  const TriangleSurface outside = outer_surface(mesh, region);
  const Placement placement = placement_of(read, options, bounds_of_triangles(outside), organ_of(options, path), file);
  ImportedTetrahedra result;
  result.unit = placement.unit, result.frame = placement.frame, result.decisions = placement.decisions;
  result.repairs = read.remarks;
  result.parts = solid_parts(mesh);
  std::vector<std::int32_t> renumbered(mesh.vertices.size(), -1);
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    const std::int32_t number = mesh.regions.empty() ? 0 : mesh.regions[t];
    if (region && number != *region) continue;
    auto corners = mesh.tetrahedra[t];
    for (std::int32_t& corner : corners) {
      std::int32_t& target = renumbered[static_cast<std::size_t>(corner)];
      if (target < 0) {
        target = static_cast<std::int32_t>(result.vertices.size());
        result.vertices.push_back(placement.placed(mesh.vertices[static_cast<std::size_t>(corner)]));
      }
      corner = target;
    }
    if (placement.mirrors()) std::swap(corners[2], corners[3]);
    result.tetrahedra.push_back(corners);
    result.regions.push_back(number);
  }
  return result;
}

}  // namespace trocar
