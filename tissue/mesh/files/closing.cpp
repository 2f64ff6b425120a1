#include "tissue/mesh/files/closing.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <numeric>

#include "haptics/input_error.h"
#include "tissue/imaging/child_process.h"
#include "tissue/imaging/labels/label_mask.h"
#include "tissue/mesh/files/organ_sizes.h"
#include "tissue/mesh/files/soup_weld.h"
#include "tissue/mesh/files/surface_pieces.h"
#include "tissue/mesh/files/winding.h"
#include "tissue/mesh/surface/rescue.h"
#include "tissue/mesh/surface/surface_check.h"
#include "tissue/mesh/surface/topology.h"

namespace trocar {
namespace {

constexpr double kLeastVolumeM3 = 1e-9;  // 1 mm^3: a flat or collinear shape encloses nothing
constexpr double kWeldTolerance = 1e-6;  // of the bounding box's diagonal: float32 keeps 1e-7
constexpr std::size_t kMostForIntersections = 2'000'000;

std::string fixed(double value, int decimals) {
  char text[48];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  return text;
}
std::string mm(double metres) { return fixed(metres * 1e3, 2) + " mm"; }
std::string ml(double cubic_metres) { return fixed(cubic_metres * 1e6, 3) + " mL"; }

/// A list of plain values as it lies in memory, its length before it: for our own child process on this machine only.
template <typename Value>
std::string as_bytes(const std::vector<Value>& values) {
  const std::uint64_t count = values.size();
  std::string bytes(reinterpret_cast<const char*>(&count), sizeof count);
  return bytes.append(reinterpret_cast<const char*>(values.data()), count * sizeof(Value));
}

template <typename Value>
void take_bytes(const std::string& bytes, std::size_t& from, std::vector<Value>& values) {
  std::uint64_t count = 0;
  std::memcpy(&count, bytes.data() + from, sizeof count);
  values.resize(count);
  std::memcpy(static_cast<void*>(values.data()), bytes.data() + from + sizeof count, count * sizeof(Value));
  from += sizeof count + count * sizeof(Value);
}

void weld(ImportedSurface& result, const std::string& file) {
  WeldFacts facts;
  const double diagonal_m = result.surface.bounds().diagonal().norm();
  result.surface = weld_soup(result.surface, kWeldTolerance * diagonal_m, facts);
  if (facts.vertices_after < facts.vertices_before)
    result.repairs.push_back("welded " + std::to_string(facts.vertices_before) + " vertices to " +
                             std::to_string(facts.vertices_after));
  if (facts.collapsed > 0)
    result.repairs.push_back("removed " + std::to_string(facts.collapsed) + " triangles with two corners in one place");
  if (facts.repeated > 0)
    result.repairs.push_back("removed " + std::to_string(facts.repeated) + " further copies of triangles");
  if (facts.opposed > 0)
    result.repairs.push_back(facts.double_sided ? "the surface was stored with both its sides: kept one of each two"
                                                : "removed both sides of walls without thickness: " +
                                                      std::to_string(facts.opposed) + " triangles");
  if (result.surface.triangles.empty()) throw InputError(file + ": no triangle is left: every one is without area");
}

void fill(const SurfaceImportOptions& options, const std::string& file, ImportedSurface& result) {
  std::vector<FilledHole> holes;
  result.surface = holes_filled(result.surface, *options.fill_holes_mm * 1e-3, holes, file);
  std::stable_sort(holes.begin(), holes.end(),
                   [](const FilledHole& a, const FilledHole& b) { return a.span_m > b.span_m; });
  constexpr std::size_t kListed = 20;
  for (std::size_t n = 0; n < std::min(holes.size(), kListed); ++n)
    result.repairs.push_back("filled a hole of " + std::to_string(holes[n].edges) + " edges that spans " +
                             mm(holes[n].span_m) + " (" + fixed(holes[n].area_m2 * 1e6, 1) + " mm2)");
  if (holes.size() > kListed)
    result.repairs.push_back("filled " + std::to_string(holes.size() - kListed) + " smaller holes");
}

/// The wrap in a process of its own: CGAL cannot be asked to stop, a process can. Ctrl-C counts at once, and memory is
/// bounded.
TriangleSurface wrapped_apart(const TriangleSurface& soup, const WrapSettings& settings, const std::string& file,
                              WrapFacts& facts, const Progress& progress) {
  constexpr ChildLimits kLimits{std::uint64_t{4} << 30, 3600};
  const auto waiting = [&](std::string_view, double share) { report(progress, "wrapping", share); };
  const std::string bytes = in_child(file + ": wrapping", kLimits, waiting, [&] {
    WrapFacts made;
    const TriangleSurface wrapped =
        shrink_wrapped(soup, settings.alpha_mm * 1e-3, settings.offset_mm * 1e-3, made, file);
    return as_bytes(wrapped.vertices) + as_bytes(wrapped.triangles) + as_bytes(std::vector{made});
  });
  TriangleSurface surface;
  std::size_t from = 0;
  take_bytes(bytes, from, surface.vertices);
  take_bytes(bytes, from, surface.triangles);
  std::vector<WrapFacts> told;
  take_bytes(bytes, from, told);
  facts = told.at(0);
  return surface;
}

void wrap(const WrapSettings& settings, const std::string& file, ImportedSurface& result, const Progress& progress) {
  WrapFacts facts;
  result.surface = wrapped_apart(result.surface, settings, file, facts, progress);
  result.repairs.push_back("wrapped with alpha " + fixed(settings.alpha_mm, 2) + " mm, laid " +
                           fixed(settings.offset_mm, 2) + " mm outside (" + ml(facts.volume_outside_m3) +
                           ") and pulled back by " + fixed(100 * facts.pulled_back, 0) + " % of that (" +
                           ml(facts.volume_m3) + ")");
  result.repairs.push_back("the wrap lies " + mm(facts.to_input.mean_m) + " from the source in the mean and " +
                           mm(facts.to_input.max_m) + " at most; the source lies " + mm(facts.from_input.mean_m) +
                           " from the wrap in the mean and " + mm(facts.from_input.max_m) +
                           " at most (what lies within counts)");
}

void check_closed(const TriangleSurface& surface, const SurfaceImportOptions& options, const std::string& file) {
  const SurfaceTopology facts = analyse_topology(surface);
  const std::string way_out = ": repair it where it was made, or ask for --wrap";
  const std::string more = facts.nonmanifold_edges > 0 ? "; also " + std::to_string(facts.nonmanifold_edges) +
                                                             " edges of more than two triangles"
                                                       : "";
  if (facts.boundary_edges > 0)
    throw InputError(file + ": the surface is open: " + std::to_string(facts.boundary_edges) + " boundary edges" +
                     more +
                     (options.fill_holes_mm ? " are left" + way_out
                                            : std::string(" (holes are not filled unasked)") + way_out +
                                                  (more.empty() ? " or --fill-holes with the widest span in mm" : "")));
  if (facts.nonmanifold_edges > 0)
    throw InputError(file + ": not a manifold: " + std::to_string(facts.nonmanifold_edges) +
                     " edges of more than two triangles" + way_out);
  if (facts.nonmanifold_vertices > 0)
    throw InputError(file + ": not a manifold: " + std::to_string(facts.nonmanifold_vertices) +
                     " vertices where parts touch" + way_out);
}

void rescue(const SurfaceImportOptions& options, const std::string& file, ImportedSurface& result,
            const Progress& progress) {
  if (options.wrap) {
    report(progress, "wrapping", -1);
    return wrap(*options.wrap, file, result, progress);
  }
  if (!options.fill_holes_mm) return;
  const SurfaceTopology facts = analyse_topology(result.surface);
  if (facts.nonmanifold_edges > 0 || facts.boundary_edges == 0) return;
  report(progress, "filling holes", -1);
  fill(options, file, result);
}

/// Parts from the least share on that is kept of a label's, too. Cavities are left to settle_cavities.
void keep_surface_parts(const std::vector<double>& stored_m3, bool only_largest, ImportedSurface& result) {
  const std::size_t triangles = result.surface.triangles.size();
  SurfacePieces pieces = sorted_pieces(result.surface, stored_m3, only_largest ? 2 : PartsRule{}.least_share);
  result.surface = std::move(pieces.kept);
  result.cavities = std::move(pieces.cavities);
  result.lost_volumes_m3 = std::move(pieces.lost_m3);
  if (pieces.count == 1) return;
  const double lost = std::accumulate(result.lost_volumes_m3.begin(), result.lost_volumes_m3.end(), 0.0);
  result.repairs.push_back(
      (pieces.parts == 1 ? "kept the largest of " : "kept " + std::to_string(pieces.parts) + " of ") +
      std::to_string(pieces.count) + " components (" + std::to_string(result.surface.triangles.size()) + " of " +
      std::to_string(triangles) + " triangles)" +
      (result.lost_volumes_m3.empty()
           ? ""
           : "; those left out enclose " + ml(lost) + ", the largest of them " + ml(result.lost_volumes_m3[0])));
  if (pieces.within > 0)
    result.repairs.push_back("left out " + std::to_string(pieces.within) +
                             " components that lie within others and enclose nothing more");
  if (lost > 0.02 * result.surface.volume_m3())
    result.warnings.push_back("the parts that were left out enclose " +
                              fixed(100 * lost / result.surface.volume_m3(), 1) + " % of what was kept");
}

/// Walls of twice the volume by the area; a solid organ has thick ones.
void warn_of_thin_shells(ImportedSurface& result) {
  const Vec3 sides = result.surface.bounds().sizes();
  const double volume = result.surface.volume_m3(), thickness = 2 * volume / surface_area_m2(result.surface);
  const double share = volume / sides.prod();
  if (share > 0.08 || thickness > 0.06 * sides.norm()) return;
  result.warnings.push_back("encloses only " + ml(volume) + ", " + fixed(100 * share, 1) +
                            " % of its bounding box, with walls about " + mm(thickness) +
                            " thick: a hollow shell or a tree of tubes, not a solid organ");
}

void warn_of_size(const std::string& organ, ImportedSurface& result) {
  const auto size = organ_size(organ);
  const double longest_mm = result.surface.bounds().sizes().maxCoeff() * 1e3;
  if (!size || (longest_mm >= size->least_mm && longest_mm <= size->most_mm)) return;
  result.warnings.push_back("measures " + fixed(longest_mm, 1) + " mm, of " + size->with_article() + " one expects " +
                            fixed(size->least_mm, 0) + " to " + fixed(size->most_mm, 0) + " mm: check the unit");
}

void count_intersections(ImportedSurface& result) {
  if (result.surface.triangles.size() > kMostForIntersections) {
    result.warnings.push_back("more than 2 million triangles: not looked for places where the surface cuts itself");
    return;
  }
  result.source_self_intersections = count_self_intersections(result.surface);
  if (result.source_self_intersections > 0)
    result.repairs.push_back("the source cut itself in " + std::to_string(result.source_self_intersections) +
                             " pairs of triangles");
}

}  // namespace

void settle_cavities(ImportedSurface& result, const std::function<bool(const TriangleSurface&)>& keep) {
  for (const TriangleSurface& cavity : result.cavities) {
    const double volume_m3 = cavity.volume_m3();
    if (keep(cavity)) {
      append_turned(result.surface, cavity);
      result.repairs.push_back("kept a cavity of " + ml(volume_m3));
      continue;
    }
    result.filled_volumes_m3.push_back(volume_m3);
    result.warnings.push_back("a cavity of " + ml(volume_m3) + " was filled");
  }
  result.cavities.clear();
}

void close_surface(const TriangleSurface& soup, const SurfaceImportOptions& options, const std::string& organ,
                   const std::string& file, ImportedSurface& result, const Progress& progress) {
  result.surface = soup;
  report(progress, "welding", 0);
  weld(result, file);
  rescue(options, file, result, progress);
  report(progress, "checking", 0);
  check_closed(result.surface, options, file);
  const std::vector<double> stored_m3 = piece_volumes_m3(result.surface);
  std::size_t turned = 0;
  if (!wind_outward(result.surface, turned)) throw InputError(file + ": the surface has no inside and outside");
  keep_surface_parts(stored_m3, options.only_largest, result);
  if (turned > 0) result.repairs.push_back("turned " + std::to_string(turned) + " triangles outwards");
  if (!(result.surface.volume_m3() >= kLeastVolumeM3))
    throw InputError(file + ": the surface encloses no volume (less than 1 mm^3): it is flat or collinear");
  report(progress, "checking", 0.5);
  count_intersections(result);
  warn_of_thin_shells(result);
  warn_of_size(organ, result);
}

}  // namespace trocar
