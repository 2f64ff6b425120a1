#include "app/import/import_source.h"

#include <algorithm>
#include <filesystem>

#include "haptics/digest/digest.h"
#include "haptics/input_error.h"
#include "tissue/imaging/dicom/dicom_reader.h"
#include "tissue/imaging/dicom/dicom_segmentation.h"
#include "tissue/imaging/dicom/rt_structures.h"
#include "tissue/imaging/label_grid.h"
#include "tissue/imaging/segmentation.h"
#include "tissue/imaging/volume_reader.h"
#include "tissue/mesh/surface_import.h"

namespace trocar {
namespace {

namespace fs = std::filesystem;

constexpr double kCertainlyHounsfield = -500;  // no MR magnitude image goes below 0

/// "liver" from "dir/liver.nii.gz".
std::string plain_stem(const fs::path& path) {
  const std::string file = path.filename().string();
  for (const std::string_view suffix : {".nii.gz", ".seg.nrrd"})
    if (file.ends_with(suffix)) return file.substr(0, file.size() - suffix.size());
  return path.stem().string();
}

std::size_t count_of(const std::vector<DicomSeries>& series, DicomKind kind) {
  return static_cast<std::size_t>(
      std::count_if(series.begin(), series.end(), [&](const DicomSeries& one) { return one.kind == kind; }));
}

const DicomSeries* chosen(const std::vector<DicomSeries>& series, std::optional<int> number) {
  for (const DicomSeries& one : series)
    if (number && one.number == *number) return &one;
  return nullptr;
}

std::string listed(const std::vector<DicomSeries>& series) {
  std::string text;
  for (const DicomSeries& one : series) text += "\n  " + describe(one);
  return text;
}

/// Labels of a DICOM input: a segmentation or a structure set, on the grid of the image when there is one.
LabelMap read_dicom_labels(const std::string& input, std::optional<int> number, const std::optional<ImageVolume>& image,
                           const Progress& progress) {
  const std::vector<DicomSeries> series = list_dicom(input, progress);
  const DicomSeries* one = chosen(series, number);
  const bool segmentation = one ? one->kind == DicomKind::kSegmentation : count_of(series, DicomKind::kSegmentation) > 0;
  const bool structures = one ? one->kind == DicomKind::kStructureSet : count_of(series, DicomKind::kStructureSet) > 0;
  const std::optional<int> which = one ? std::optional<int>(one->number) : std::nullopt;
  if (segmentation) return read_dicom_segmentation(input, progress, which);
  if (structures && image) return read_rtstruct(input, *image, progress, which);
  if (structures) return read_rtstruct(input, progress, which);
  throw InputError(input + ": holds DICOM images and no labels: give the labels with --labels FILE (SEG, RTSTRUCT, NIfTI, NRRD), or "
                   "segment by values with --threshold LOW HIGH" + listed(series));
}

LabelMap read_labels(const std::string& file, const OrganImportOptions& options, const std::optional<ImageVolume>& image) {
  if (is_volume_file(file)) return read_label_map(file, options.progress, {.unit = options.surface.unit, .space = options.surface.frame});
  return read_dicom_labels(file, options.labels.empty() ? options.series : std::nullopt, image, options.progress);
}

ImageVolume read_image(const OrganImportOptions& options) {
  if (is_volume_file(options.input))
    return read_image_volume(options.input, options.progress, {.unit = options.surface.unit, .space = options.surface.frame});
  return read_dicom_series(options.input, options.series, options.progress);
}

/// The images beside the labels of one DICOM input, when there is just one series of them: pictures are drawn on it, no more.
std::optional<ImageVolume> images_beside(const OrganImportOptions& options) {
  if (is_volume_file(options.input)) return std::nullopt;
  const std::vector<DicomSeries> series = list_dicom(options.input, options.progress);
  if (count_of(series, DicomKind::kImage) != 1) return std::nullopt;
  const auto images = std::find_if(series.begin(), series.end(), [](const DicomSeries& one) { return one.kind == DicomKind::kImage; });
  if (!images->problem.empty()) return std::nullopt;
  return read_dicom_series(options.input, images->number, options.progress);
}

LabelMap segmented(const OrganImportOptions& options, const ImageVolume& image) {
  const ThresholdOptions& asked = options.threshold;
  SegmentationOptions how;
  how.low = (*asked.window)[0], how.high = (*asked.window)[1];
  if (asked.seed_mm) how.seed_ras_mm = Eigen::Vector3d((*asked.seed_mm)[0], (*asked.seed_mm)[1], (*asked.seed_mm)[2]);
  how.reach_mm = asked.reach_mm, how.opening_mm = asked.opening_mm, how.closing_mm = asked.closing_mm;
  how.keep = asked.seed_mm ? Keep::kSeeded : Keep::kLargest;
  how.smooth = asked.smooth;
  LabelMap map;
  map.layers.push_back(segment(image, how, options.progress));
  map.segments.push_back({0, 1, ""});
  map.modality = image.modality;
  return map;
}

/// Labels that lie elsewhere than the image are not its labels.
void check_place(const ImageVolume& image, const LabelMap& map, const std::string& file, std::vector<std::string>& notes) {
  bool alike = true;
  for (const LabelVolume& layer : map.layers) {
    const double gap = gap_mm(grid_of(image), grid_of(layer));
    if (gap > 0)
      throw InputError(file + ": the label map lies " + std::to_string(gap).substr(0, 6) + " mm outside the image: not its labels");
    alike = alike && same_grid(grid_of(image), grid_of(layer));
  }
  if (!alike)
    notes.push_back("the labels have another grid than the image; both lie in one patient space, surfaces are made on the labels' grid");
}

std::string modality_of(const OrganImportOptions& options, const ImportSource& source) {
  if (!options.modality.empty()) return options.modality;
  if (source.image && source.image->modality != "unknown") return source.image->modality;
  if (source.image && !source.image->values.empty() &&
      *std::min_element(source.image->values.begin(), source.image->values.end()) < kCertainlyHounsfield)
    return "CT";
  return source.map.modality;
}

/// Name and hash of what the labels came from.
void tell_origin(const OrganImportOptions& options, ImportSource& source) {
  const std::string& file = source.file;
  source.source.sha256 = hash_of_input(file);
  const bool dicom = !is_volume_file(file);
  source.stem = dicom ? "organ" : plain_stem(file);
  source.source.file = dicom ? "DICOM" : fs::path(file).filename().string();
  source.source.unit = options.surface.unit.empty() ? "mm" : options.surface.unit;
  source.source.modality = modality_of(options, source);
}

}  // namespace

bool is_surface_input(const OrganImportOptions& options) {
  return !fs::is_directory(options.input) && is_surface_file(options.input);
}

std::string hash_of_input(const std::string& input) {
  if (!fs::is_directory(input)) return digest::of_file(input);
  std::vector<std::string> hashes;
  for (const auto& entry : fs::recursive_directory_iterator(input))
    if (entry.is_regular_file()) hashes.push_back(digest::of_file(entry.path()));
  std::sort(hashes.begin(), hashes.end());
  std::string all;
  for (const std::string& hash : hashes) all += hash;
  return digest::of_bytes(all);
}

ImportSource read_import_source(const OrganImportOptions& options) {
  ImportSource source;
  std::error_code missing;
  for (const std::string& file : {options.input, options.labels})
    if (!file.empty() && !fs::exists(file, missing)) throw InputError(file + ": no such file or folder");
  const bool by_window = options.threshold.window.has_value();
  if (by_window && (!options.label.empty() || options.all)) throw InputError("--threshold makes one label; it does not go with --label or --all");
  if (!by_window && (options.threshold.seed_mm || options.threshold.reach_mm > 0 || options.threshold.opening_mm > 0 || options.threshold.closing_mm > 0 || options.threshold.smooth))
    throw InputError("--seed-point, --reach, --opening, --closing and --smooth go with --threshold LOW HIGH");
  if (options.threshold.reach_mm > 0 && !options.threshold.seed_mm) throw InputError("--reach counts from a --seed-point");
  if (by_window && !options.labels.empty()) throw InputError("--threshold makes the labels; it does not go with --labels");
  if (by_window || !options.labels.empty()) source.image = read_image(options);
  source.file = options.labels.empty() ? options.input : options.labels;
  if (by_window) {
    source.map = segmented(options, *source.image);
  } else {
    if (!source.image) source.image = images_beside(options);
    source.map = read_labels(source.file, options, source.image);
  }
  if (source.image && !by_window) check_place(*source.image, source.map, source.file, source.map.notes);
  tell_origin(options, source);
  return source;
}

}  // namespace trocar
