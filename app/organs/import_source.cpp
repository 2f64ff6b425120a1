#include "app/organs/import_source.h"

#include <algorithm>
#include <filesystem>

#include "haptics/digest/digest.h"
#include "haptics/input_error.h"
#include "tissue/imaging/dicom/dicom_reader.h"
#include "tissue/imaging/dicom/dicom_segmentation.h"
#include "tissue/imaging/dicom/dicom_study.h"
#include "tissue/imaging/dicom/rt_structures.h"
#include "tissue/imaging/labels/label_grid.h"
#include "tissue/imaging/labels/segmentation.h"
#include "tissue/imaging/volumes/volume_reader.h"
#include "tissue/organ/file_lock.h"
#include "tissue/organ/surface_import.h"

namespace trocar {
namespace {

namespace fs = std::filesystem;

std::size_t count_of(const std::vector<DicomSeries>& series, DicomKind kind) {
  return static_cast<std::size_t>(
      std::count_if(series.begin(), series.end(), [&](const DicomSeries& one) { return one.kind == kind; }));
}

std::string listed(const std::vector<DicomSeries>& series) {
  std::string text;
  for (const DicomSeries& one : series) text += "\n  " + describe(one);
  return text;
}

/// Neither images nor labels: a damaged file, or an object of another kind (a report, a dose, a presentation state).
/// Nothing to import without --threshold: damaged, of another kind (a report, a plan, a presentation state), or images
/// alone.
void require_labels(const std::string& input, const std::vector<DicomSeries>& series) {
  if (count_of(series, DicomKind::kSegmentation) + count_of(series, DicomKind::kStructureSet) > 0) return;
  if (series.size() == 1 && !series.front().problem.empty()) throw InputError(series.front().problem);
  if (count_of(series, DicomKind::kImage) == 0)
    throw InputError(
        input +
        ": holds neither images nor labels, but DICOM of another kind (reports, plans, presentation states) "
        "or damaged files: give the folder of the images, a SEG or an RTSTRUCT" +
        listed(series));
  throw InputError(input +
                   ": holds DICOM images and no labels: give the labels with --labels FILE (SEG, RTSTRUCT, NIfTI, "
                   "NRRD), or segment by values with --threshold LOW HIGH" +
                   listed(series));
}

/// Labels of a DICOM input: a segmentation or a structure set, on the grid of the image when there is one.
LabelMap read_dicom_labels(const DicomStudy& study, std::optional<int> number, const std::optional<ImageVolume>& image,
                           const std::vector<std::string>& wanted, bool every, const Progress& progress) {
  const std::vector<DicomSeries> series = study.series();
  const auto holds = [&](DicomKind kind) {
    return std::any_of(series.begin(), series.end(),
                       [&](const DicomSeries& one) { return one.kind == kind && (!number || one.number == *number); });
  };
  if (holds(DicomKind::kSegmentation)) return read_dicom_segmentation(study, progress, number, every);
  if (holds(DicomKind::kStructureSet))
    return image ? read_rtstruct(study, *image, progress, number, wanted)
                 : read_rtstruct(study, progress, number, wanted);
  throw InputError(study.path().string() + ": series " + std::to_string(number.value_or(0)) + " holds no labels" +
                   listed(series));
}

VolumeReading reading_of(const OrganImportOptions& options) {
  return {.unit = options.surface.unit, .space = options.surface.frame};
}

ImageVolume read_image(const OrganImportOptions& options) {
  if (is_volume_file(options.input)) return read_image_volume(options.input, options.progress, reading_of(options));
  return read_dicom_series(options.input, options.series, options.progress);
}

/// The images beside the labels of one DICOM input, when there is just one series of them: pictures are drawn on it, no
/// more.
std::optional<ImageVolume> images_beside(const DicomStudy& study, const Progress& progress) {
  const std::vector<DicomSeries> series = study.series();
  if (count_of(series, DicomKind::kImage) != 1) return std::nullopt;
  const auto images =
      std::find_if(series.begin(), series.end(), [](const DicomSeries& one) { return one.kind == DicomKind::kImage; });
  if (!images->problem.empty()) return std::nullopt;
  return read_dicom_series(study, images->number, progress);
}

/// Labels that are asked for by --label, or by --name alone.
std::vector<std::string> wanted_words(const OrganImportOptions& options) {
  if (!options.label.empty() || options.all) return options.label;
  return options.name.empty() ? std::vector<std::string>{} : std::vector<std::string>{options.name};
}

/// One mask an organ, in files of their own.
bool read_masks(const OrganImportOptions& options, const std::optional<OrganFiles>& given, ImportSource& source) {
  std::optional<OrganFiles> of_labels;
  if (!options.labels.empty()) of_labels = organ_files({options.labels}, options.progress);
  const std::optional<OrganFiles>& files = options.labels.empty() ? given : of_labels;
  if (!files || files->volumes.empty()) return false;
  CombinedMasks masks =
      combined_masks(*files, files->asked(files->volumes, options), reading_of(options), options.progress);
  source.map = std::move(masks.map);
  source.origin = std::move(masks.origin);
  if (!source.image) source.image = std::move(masks.image);
  return true;
}

/// The labels of the file that holds them, and the images beside them in a DICOM input that was given alone.
void read_labels(const OrganImportOptions& options, const std::optional<OrganFiles>& masks, ImportSource& source) {
  if (read_masks(options, masks, source)) return;
  if (is_volume_file(source.file)) {
    source.map = read_label_map(source.file, options.progress, reading_of(options));
    return;
  }
  const DicomStudy study(source.file, options.progress);
  require_labels(source.file, study.series());
  if (!source.image && !is_volume_file(options.input)) source.image = images_beside(study, options.progress);
  source.map = read_dicom_labels(study, options.labels.empty() ? options.series : std::nullopt, source.image,
                                 wanted_words(options), options.all, options.progress);
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

/// A cut-out of the image is laid on its grid, where all of it lies in it: then only the image's own border cuts
/// organs.
void lay_on(const VoxelGrid& grid, LabelMap& map) {
  if (!common_grid(grid, grid_of(map.layers.front()))) return;
  std::vector<LabelVolume> whole;
  for (const LabelVolume& layer : map.layers) {
    whole.push_back(resampled_to(layer, grid));
    if (whole.back().label_counts() != layer.label_counts()) return;
  }
  map.layers = std::move(whole);
}

/// Labels that lie elsewhere than the image are not its labels; labels on a grid of their own are carried to it for
/// image values.
void relate(ImportSource& source, const Progress& progress) {
  const VoxelGrid grid = grid_of(*source.image);
  const auto on_it = [&] { return same_grid(grid, grid_of(source.map.layers.front())); };  // all layers have one grid
  if (on_it()) return;
  lay_on(grid, source.map);
  if (on_it()) return;
  for (const LabelVolume& layer : source.map.layers) {
    source.on_image.push_back(on_grid_of(*source.image, layer, source.file, progress));
    if (source.on_image.size() == 1) source.map.notes.push_back(source.on_image.front().notes.back());
  }
}

std::string modality_of(const OrganImportOptions& options, const ImportSource& source) {
  if (!options.modality.empty()) return options.modality;
  if (source.image && source.image->modality != "unknown") return source.image->modality;
  if (source.image && certainly_hounsfield(*source.image)) return "CT";
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

void check_source_options(const OrganImportOptions& options) {
  std::error_code missing;
  std::vector<std::string> inputs = options.more_inputs;
  inputs.insert(inputs.end(), {options.input, options.labels});
  for (const std::string& file : inputs)
    if (!file.empty() && !fs::exists(file, missing)) throw InputError(file + ": no such file or folder");
  if (!options.more_inputs.empty() && (!options.labels.empty() || options.threshold.window))
    throw InputError("--labels and --threshold go with one image; of several inputs each is a mask or a surface");
  const ThresholdOptions& asked = options.threshold;
  const bool by_window = asked.window.has_value();
  if (by_window && (!options.label.empty() || options.all))
    throw InputError("--threshold makes one label; it does not go with --label or --all");
  if (by_window && !options.label_table.empty())
    throw InputError(
        "--threshold marks values, which no table numbered: it does not go with --label-table (--name says what it "
        "is)");
  if (!by_window &&
      (asked.seed_mm || asked.reach_mm > 0 || asked.opening_mm > 0 || asked.closing_mm > 0 || asked.smooth))
    throw InputError("--seed-point, --reach, --opening, --closing and --smooth go with --threshold LOW HIGH");
  if (asked.reach_mm > 0 && !asked.seed_mm) throw InputError("--reach counts from a --seed-point");
  if (by_window && !options.labels.empty())
    throw InputError("--threshold makes the labels; it does not go with --labels");
}

}  // namespace

bool is_surface_input(const OrganImportOptions& options) {
  return !fs::is_directory(options.input) && is_surface_file(options.input) && options.more_inputs.empty();
}

std::string hash_of_input(const std::string& input) {
  if (!fs::is_directory(input)) return digest::of_file(input);
  std::vector<std::string> hashes;
  for (const auto& entry : fs::recursive_directory_iterator(input))
    if (entry.is_regular_file() && !is_name_lock(entry.path())) hashes.push_back(digest::of_file(entry.path()));
  std::sort(hashes.begin(), hashes.end());
  std::string all;
  for (const std::string& hash : hashes) all += hash;
  return digest::of_bytes(all);
}

ImportSource read_import_source(const OrganImportOptions& options, const std::optional<OrganFiles>& masks) {
  check_source_options(options);
  ImportSource source;
  source.file = options.labels.empty() ? options.input : options.labels;
  const bool by_window = options.threshold.window.has_value();
  if (by_window || !options.labels.empty()) source.image = read_image(options);
  if (by_window)
    source.map = segmented(options, *source.image);
  else
    read_labels(options, masks, source);
  if (source.image && !by_window) relate(source, options.progress);
  tell_origin(options, source);
  return source;
}

LabelValues image_values(const ImportSource& source, const Segment& segment) {
  if (!source.image) return {};
  const LabelVolume& layer =
      source.on_image.empty() ? source.map.layers[segment.layer] : source.on_image[segment.layer];
  return layer.size == source.image->size ? values_under(*source.image, layer, segment.number) : LabelValues{};
}

}  // namespace trocar
