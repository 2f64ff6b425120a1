#include "tissue/mesh/files/placement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <sstream>

#include "haptics/input_error.h"
#include "tissue/mesh/files/organ_sizes.h"
#include "tissue/mesh/files/patient_axes.h"

namespace trocar {
namespace {

constexpr std::array<std::pair<const char*, double>, 4> kUnits{{{"mm", 1e-3}, {"cm", 1e-2}, {"m", 1.0}, {"um", 1e-6}}};

bool plausible(double diagonal_m) { return diagonal_m >= kSmallestOrganM && diagonal_m <= kLargestOrganM; }

/// "bounding box 221.9 x 214.3 x 190.3; an organ measures 5 to 600 mm across, so it would be in mm"
std::string size_hint(const Eigen::AlignedBox3d& bounds, const std::string& organ) {
  const Vec3 extent = bounds.sizes();
  const auto size = organ_size(organ);
  std::ostringstream out;
  out << "bounding box " << extent.x() << " x " << extent.y() << " x " << extent.z() << "; ";
  std::string any, fitting;
  for (const auto& [name, factor] : kUnits) {
    const double longest_mm = extent.maxCoeff() * factor * 1e3;
    if (plausible(extent.norm() * factor)) any += (any.empty() ? "" : " or ") + std::string(name);
    if (size && longest_mm >= size->least_mm && longest_mm <= size->most_mm)
      fitting += (fitting.empty() ? "" : " or ") + std::string(name);
  }
  out << "an organ measures 5 to 600 mm across, so "
      << (any.empty() ? "no unit among mm, cm, m, um fits" : "it would be in " + any);
  if (size)
    out << "; of " << size->with_article() << " one expects " << size->least_mm << " to " << size->most_mm << " mm, "
        << (fitting.empty() ? "which no unit gives" : "which " + fitting + " gives");
  return out.str();
}

std::string unit_name(double unit_m) {
  for (const auto& [name, factor] : kUnits)
    if (std::abs(unit_m - factor) < 1e-9 * factor) return name;
  std::ostringstream out;
  out << unit_m * 100 << " cm";
  return out.str();
}

std::string format_name(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& letter : extension) letter = static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
  return extension.empty() ? extension : extension.substr(1);
}

void decide_unit(const SurfaceFile& file, const SurfaceImportOptions& options, const Eigen::AlignedBox3d& bounds,
                 const std::string& organ, const std::string& path, Placement& result) {
  if (options.unit.empty() && !file.unit_m)
    throw InputError(path + ": " + format_name(path) +
                     " carries no unit, say --unit mm, cm, m or um: " + size_hint(bounds, organ));
  result.unit_m = options.unit.empty() ? *file.unit_m : metres_per(options.unit);
  result.unit = unit_name(result.unit_m);
  if (!plausible(bounds.diagonal().norm() * result.unit_m))
    throw InputError(path + ": " +
                     (options.unit.empty() ? "its own unit, " + result.unit + "," : "--unit " + options.unit) +
                     " is not plausible: " + size_hint(bounds, organ));
  if (options.unit.empty()) {
    result.decisions.push_back("unit " + result.unit + ": " + file.unit_source);
    return;
  }
  const bool against = file.unit_m && std::abs(*file.unit_m - result.unit_m) > 1e-9 * result.unit_m;
  result.decisions.push_back("unit " + result.unit + ": declared" + (against ? ", although " + file.unit_source : ""));
}

void decide_frame(const SurfaceFile& file, const SurfaceImportOptions& options, const std::string& path,
                  Placement& result) {
  if (!options.frame.empty() && !options.up_axis.empty() && options.frame != frame_of_up_axis(options.up_axis))
    throw InputError(path + ": frame " + options.frame + " and up axis " + options.up_axis +
                     " contradict each other: give one of them");
  const std::string declared = !options.frame.empty()    ? options.frame
                               : options.up_axis.empty() ? ""
                                                         : frame_of_up_axis(options.up_axis);
  result.frame = !declared.empty() ? declared : !file.frame.empty() ? file.frame : "RAS";
  result.to_ras = to_ras(result.frame);
  std::string why = "declared";
  if (!declared.empty() && !file.frame.empty() && declared != file.frame)
    why += ", although it says " + file.frame + " (" + file.frame_source + ")";
  if (declared.empty())
    why = file.frame.empty() ? format_name(path) + " does not say which way x, y and z point; assumed"
                             : file.frame_source;
  if (result.frame != "RAS") why += "; turned to RAS";
  if (result.mirrors()) why += "; this frame is a mirror image, so the triangles were turned over too";
  result.decisions.push_back("frame " + result.frame + ": " + why);
}

}  // namespace

double metres_per(const std::string& unit) {
  for (const auto& [name, factor] : kUnits)
    if (unit == name) return factor;
  throw InputError("--unit " + unit + ": mm, cm, m or um is wanted");
}

Placement placement_of(const SurfaceFile& file, const SurfaceImportOptions& options, const Eigen::AlignedBox3d& bounds,
                       const std::string& organ, const std::string& path) {
  Placement result;
  decide_unit(file, options, bounds, organ, path, result);
  decide_frame(file, options, path, result);
  return result;
}

}  // namespace trocar
