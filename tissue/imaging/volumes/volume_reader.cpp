#include "tissue/imaging/volumes/volume_reader.h"

#include <array>

#include "haptics/input_error.h"
#include "tissue/imaging/labels/label_grid.h"
#include "tissue/imaging/volumes/byte_stream.h"
#include "tissue/imaging/volumes/meta_image_header.h"
#include "tissue/imaging/volumes/nifti_fields.h"
#include "tissue/imaging/volumes/nifti_header.h"
#include "tissue/imaging/volumes/nrrd_header.h"
#include "tissue/imaging/volumes/volume_assembly.h"
#include "tissue/imaging/volumes/volume_frame.h"

namespace trocar {
namespace {

namespace fs = std::filesystem;

enum class Format { kNone, kNifti, kNrrd, kMetaImage };

struct Ending {
  std::string_view text;
  Format format;
};

constexpr std::array<Ending, 10> kEndings{{{".nii", Format::kNifti},
                                           {".nii.gz", Format::kNifti},
                                           {".hdr", Format::kNifti},
                                           {".hdr.gz", Format::kNifti},
                                           {".img", Format::kNifti},
                                           {".img.gz", Format::kNifti},
                                           {".nrrd", Format::kNrrd},
                                           {".nhdr", Format::kNrrd},
                                           {".mha", Format::kMetaImage},
                                           {".mhd", Format::kMetaImage}}};

Format format_of_name(const fs::path& path) {
  const std::string name = lower_case(path.filename().string());
  for (const Ending& ending : kEndings)
    if (name.ends_with(ending.text)) return ending.format;
  return Format::kNone;
}

std::string start_of(const fs::path& path) {
  std::string bytes(512, '\0');
  bytes.resize(open_plain(path, 0)->read(reinterpret_cast<unsigned char*>(bytes.data()), bytes.size()));
  return bytes;
}

/// What the first bytes say the file is; for messages.
std::string looks_like(const std::string& bytes) {
  const auto begins = [&](std::string_view text) { return bytes.starts_with(text); };
  const std::span<const unsigned char> raw(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
  if (bytes.empty()) return "nothing: the file is empty";
  if (begins("\x1f\x8b")) return "a gzip file";
  if (begins("NRRD000")) return "NRRD";
  if (nifti_header_bytes(raw) != 0) return "a NIfTI header";
  if (begins("ObjectType") || begins("NDims") || bytes.find("\nNDims") != std::string::npos) return "MetaImage";
  if (bytes.size() > 132 && bytes.compare(128, 4, "DICM") == 0) return "DICOM";
  if (begins("PK\x03\x04")) return "a zip archive";
  if (begins("solid")) return "an STL surface";
  if (begins("ply")) return "a PLY surface";
  if (begins("\x89PNG") || begins("\xff\xd8\xff")) return "a picture";
  if (begins("<")) return "XML or a web page";
  return "nothing that is known here";
}

/// The signature that each format has; NIfTI's own reader looks inside gzip.
void check_signature(const fs::path& path, Format format) {
  const std::string bytes = start_of(path);
  const std::string found = looks_like(bytes);
  const bool fits = format == Format::kNrrd        ? found == "NRRD"
                    : format == Format::kMetaImage ? found == "MetaImage" || bytes.find(" = ") != std::string::npos
                                                   : true;
  const char* wanted = format == Format::kNrrd ? "NRRD" : format == Format::kMetaImage ? "MetaImage" : "NIfTI";
  const bool other = format == Format::kNifti && (found == "NRRD" || found == "MetaImage" || found == "DICOM");
  if (!fits || other)
    throw InputError(path.string() + ": extension: the name says " + wanted + ", but the bytes look like " + found);
}

VolumeHeader header_of(const fs::path& path, const VolumeReading& reading) {
  const std::string name = path.string();
  std::error_code error;
  if (fs::is_directory(path, error)) throw InputError(name + ": a folder, not a volume file");
  const Format format = format_of_name(path);
  if (format == Format::kNone)
    throw InputError(name + ": extension: no volume file that is known here; volumes are read from " +
                     volume_formats());
  if (!fs::is_regular_file(path, error)) throw InputError(name + ": no such file");
  check_signature(path, format);
  if (format == Format::kNrrd) return nrrd_volume_header(path, reading);
  if (format == Format::kMetaImage) return meta_image_header(path, reading);
  return nifti_volume_header(path, reading.unit);
}

/// Sheared axes become right-angled ones: what follows measures along the axes.
void straighten(LabelMap& map, const Progress& progress) {
  for (LabelVolume& layer : map.layers) {
    if (skew_of(layer.index_to_ras_mm) <= kSkewTolerance) continue;
    const VoxelGrid grid = squared_grid(grid_of(layer));
    layer = resampled_to(layer, grid, progress);
    if (&layer == &map.layers.front())
      map.notes.push_back("straightened to axes at right angles by the nearest voxel, " + std::to_string(grid.size[0]) +
                          " x " + std::to_string(grid.size[1]) + " x " + std::to_string(grid.size[2]) + " voxels");
  }
}

}  // namespace

bool is_volume_file(const fs::path& path) { return format_of_name(path) != Format::kNone; }

std::string volume_formats() {
  return "NIfTI (.nii, .nii.gz, .hdr with .img), NRRD (.nrrd, .nhdr, .seg.nrrd) and MetaImage (.mha, .mhd)";
}

ImageVolume read_image_volume(const fs::path& path, const Progress& progress, const VolumeReading& reading) {
  const VolumeHeader header = header_of(path, reading);
  if (header.segmentation) throw InputError(path.string() + ": a segmentation, not an image");
  return assemble_image(header, progress);
}

LabelMap read_label_map(const fs::path& path, const Progress& progress, const VolumeReading& reading) {
  const VolumeHeader header = header_of(path, reading);
  LabelMap map = assemble_labels(header, progress);
  if (map.segments.empty()) {
    if (reading.may_be_empty) return map;
    throw InputError(path.string() + ": data: the label map is empty (all voxels are 0)");
  }
  if (lower_case(path.filename().string()).ends_with(".seg.nrrd") && header.segments.empty())
    map.notes.push_back("named as a segmentation (.seg.nrrd), but its header names no segment");
  straighten(map, progress);
  if (header.cut_out || (map.segments.size() == 1 && fills_grid(map.layers.front()))) {
    for (LabelVolume& layer : map.layers) layer = widened(layer);
    map.notes.emplace_back("a cut-out of a larger image: its border was taken to cut no organ");
  }
  for (LabelVolume& layer : map.layers) layer.notes = map.notes;
  return map;
}

}  // namespace trocar
