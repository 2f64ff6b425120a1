#include "tissue/imaging/dicom/rt_structures.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "haptics/input_error.h"
#include "tissue/imaging/dicom/contour_fill.h"
#include "tissue/imaging/dicom/contour_grid.h"
#include "tissue/imaging/dicom/dicom_study.h"
#include "tissue/imaging/dicom/segment_layers.h"

namespace trocar {
namespace {

constexpr std::uint64_t kMostInPlane = std::uint64_t{1} << 24,
                        kMostInAll = std::uint64_t{1} << 29;  // crossings of rows and edges

std::string called(const Structure& structure) {
  return "structure " + std::to_string(structure.number) + " (" + structure.name + ")";
}

/// Contours of one structure by the height of their plane, in slices of the grid.
std::map<double, std::vector<PlaneContour>> by_plane(const Structure& structure, const ContourGrid& grid) {
  std::map<double, std::vector<PlaneContour>> planes;
  for (const Contour& contour : structure.closed) {
    PlaneContour flat;
    double height = 0;
    for (const Eigen::Vector3d& point : contour) {
      const Eigen::Vector3d at = grid.index_of(point);
      flat.emplace_back(at.x(), at.y());
      height += at.z() / static_cast<double>(contour.size());
    }
    const auto near = planes.lower_bound(height - kSamePlaneSlices);
    const bool same = near != planes.end() && near->first <= height + kSamePlaneSlices;
    planes[same ? near->first : height].push_back(std::move(flat));
  }
  return planes;
}

/// Bounds memory and time: no drawing crosses a row a million times.
void require_fillable(const std::map<double, std::vector<PlaneContour>>& planes, const ContourGrid& grid,
                      const Structure& structure, const std::string& file, std::uint64_t& all) {
  for (const auto& [height, contours] : planes) {
    const std::uint64_t here = crossing_count(contours, grid.size[1]);
    all += here;
    if (here > kMostInPlane || all > kMostInAll)
      throw InputError(file + ": " + called(structure) +
                       ": its contours wind to and fro more often than any drawing does: the file is damaged");
  }
}

/// Smallest distance between planes, in slices; 1 for a single plane.
double plane_step(const std::map<double, std::vector<PlaneContour>>& planes) {
  double step = 0;
  const double* before = nullptr;
  for (const auto& [height, contours] : planes) {
    if (before != nullptr && (step == 0 || height - *before < step)) step = height - *before;
    before = &height;
  }
  return step == 0 ? 1 : step;
}

struct Filling {
  SegmentMask mask;
  std::size_t beyond = 0;   ///< planes outside the grid
  std::size_t between = 0;  ///< slices filled from a plane that is not theirs
};

/// Every slice takes the nearest plane within half a step of the planes (half a slice at least).
Filling filled(const std::map<double, std::vector<PlaneContour>>& planes, const ContourGrid& grid) {
  Filling result{SegmentMask(grid.size), 0, 0};
  const double reach = std::max(0.5, 0.5 * plane_step(planes)) + 1e-6;
  for (const auto& [height, contours] : planes) result.beyond += height < -0.5 || height > grid.size[2] - 0.5 ? 1 : 0;
  for (int slice = 0; slice < grid.size[2]; ++slice) {
    auto nearest = planes.lower_bound(slice);
    if (nearest == planes.end() ||
        (nearest != planes.begin() && slice - std::prev(nearest)->first <= nearest->first - slice))
      --nearest;
    if (std::abs(nearest->first - slice) > reach) continue;
    bool any = false;
    fill_even_odd(nearest->second, grid.size[0], grid.size[1], [&](int first, int last, int row) {
      const std::size_t from = grid.offset(0, row, slice);
      std::fill(result.mask.voxels.begin() + static_cast<std::ptrdiff_t>(from) + first,
                result.mask.voxels.begin() + static_cast<std::ptrdiff_t>(from) + last, true);
      any = true;
    });
    if (!any) continue;
    result.mask.mark_slice(slice);
    result.between += std::abs(nearest->first - slice) > kOnSlice ? 1 : 0;
  }
  return result;
}

void note_filling(const Structure& structure, const Filling& filling, std::size_t planes,
                  std::vector<std::string>& notes) {
  const std::string name = called(structure);
  if (filling.beyond > 0)
    notes.push_back("Of the " + std::to_string(planes) + " planes of " + name + ", " + std::to_string(filling.beyond) +
                    " lie outside the grid and were left out: it is cut there.");
  if (filling.between > 0)
    notes.push_back("Contours of " + name + " do not lie in the slices everywhere: " + std::to_string(filling.between) +
                    " slices were filled from the nearest plane.");
  if (filling.mask.empty()) notes.push_back("The " + name + " marks no voxel and was left out.");
}

LabelMap filled_on(const ContourGrid& grid, const std::vector<Structure>& structures, const std::string& file,
                   const Progress& progress) {
  SegmentLayers layers(grid.size, grid.index_to_ras_mm, file);
  std::vector<std::string> notes;
  std::uint64_t crossings = 0;
  std::size_t done = 0;
  for (const Structure& structure : structures) {
    report(progress, "structures", static_cast<double>(done++) / static_cast<double>(structures.size()));
    if (structure.others > 0)
      notes.push_back("Left out of " + called(structure) + ": " + std::to_string(structure.others) +
                      " points or open lines, which enclose nothing.");
    if (structure.closed.empty()) continue;
    const auto planes = by_plane(structure, grid);
    require_fillable(planes, grid, structure, file, crossings);
    const Filling filling = filled(planes, grid);
    note_filling(structure, filling, planes.size(), notes);
    layers.add({0, static_cast<int>(done), structure.name, structure.colour, structure.codes}, filling.mask);
  }
  LabelMap map = layers.take();
  if (map.layers.empty())
    throw InputError(file + ": none of its contours lies within the image: it belongs to another series of images");
  if (map.layers.size() > 1)
    notes.push_back("Structures overlap: they lie in " + std::to_string(map.layers.size()) + " layers.");
  map.notes = std::move(notes);
  return map;
}

/// Takes the contours of all but the wanted structures away; theirs decide the grid then, not the whole body's. All
/// stay when none of the words is one of theirs: the one who asks gets to see what there is.
void keep_wanted(std::vector<Structure>& structures, const std::vector<std::string>& wanted) {
  std::vector<bool> kept;
  for (std::size_t n = 0; n < structures.size(); ++n)
    kept.push_back(std::any_of(wanted.begin(), wanted.end(), [&](const std::string& word) {
      return word == std::to_string(n + 1) ||
             (!folded_name(word).empty() && folded_name(word) == folded_name(structures[n].name));
    }));
  if (std::none_of(kept.begin(), kept.end(), [](bool one) { return one; })) return;
  for (std::size_t n = 0; n < structures.size(); ++n)
    if (!kept[n]) structures[n].closed.clear(), structures[n].others = 0;
}

std::vector<Structure> structures_with_contours(const DicomStudy& study, const Progress& progress,
                                                std::optional<int> series, const std::vector<std::string>& wanted) {
  const std::filesystem::path& path = study.path();
  std::vector<Structure> structures = read_structures(study, progress, series);
  if (structures.size() > 65535) throw InputError(path.string() + ": holds more than 65535 structures");
  keep_wanted(structures, wanted);
  const bool any =
      std::any_of(structures.begin(), structures.end(), [](const Structure& one) { return !one.closed.empty(); });
  if (!any) throw InputError(path.string() + ": holds no closed contours: nothing to fill");
  return structures;
}

}  // namespace

LabelMap read_rtstruct(const std::filesystem::path& path, const ImageVolume& grid, const Progress& progress,
                       std::optional<int> series) {
  return read_rtstruct(DicomStudy(path, progress), grid, progress, series);
}

LabelMap read_rtstruct(const std::filesystem::path& path, const Progress& progress, std::optional<int> series) {
  return read_rtstruct(DicomStudy(path, progress), progress, series);
}

LabelMap read_rtstruct(const DicomStudy& study, const ImageVolume& grid, const Progress& progress,
                       std::optional<int> series, const std::vector<std::string>& wanted) {
  const std::vector<Structure> structures = structures_with_contours(study, progress, series, wanted);
  const std::string file = study.path().string();
  LabelMap map = filled_on(image_contour_grid(grid, structures, file), structures, file, progress);
  map.modality = grid.modality;
  return map;
}

LabelMap read_rtstruct(const DicomStudy& study, const Progress& progress, std::optional<int> series,
                       const std::vector<std::string>& wanted) {
  const std::vector<Structure> structures = structures_with_contours(study, progress, series, wanted);
  const std::string file = study.path().string();
  const ContourGrid grid = own_contour_grid(structures, file);
  LabelMap map = filled_on(grid, structures, file, progress);
  char note[160];
  std::snprintf(note, sizeof note,
                "The contours were filled on a grid of their own: %d x %d x %d voxels of %.3f x %.3f x %.3f mm.",
                grid.size[0], grid.size[1], grid.size[2], grid.step_mm(0), grid.step_mm(1), grid.step_mm(2));
  map.notes.insert(map.notes.begin(), note);
  return map;
}

}  // namespace trocar
