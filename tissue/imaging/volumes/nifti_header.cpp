#include "tissue/imaging/volumes/nifti_header.h"

#include <algorithm>
#include <cmath>

#include "haptics/input_error.h"
#include "tissue/imaging/volumes/gzip_stream.h"
#include "tissue/imaging/volumes/nifti_fields.h"
#include "tissue/imaging/volumes/nifti_labels.h"
#include "tissue/imaging/volumes/volume_frame.h"
#include "tissue/imaging/volumes/voxel_stream.h"

namespace trocar {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse_header(const std::string& file, const std::string& field, const std::string& what) {
  throw InputError(file + ": " + field + ": " + what);
}

void read_nifti_size(const NiftiFields& fields, const std::string& file, NiftiHeader& header) {
  const std::int64_t dimensions = fields.dim[0];
  if (dimensions < 3 || dimensions > 7)
    refuse_header(file, "dim[0]", std::to_string(dimensions) + " dimensions; a volume has 3");
  for (std::size_t axis = 1; axis <= 3; ++axis) {
    const std::int64_t extent = fields.dim[axis];
    if (extent < 2 || extent > 1 << 20)
      refuse_header(file, "dim[" + std::to_string(axis) + "]", std::to_string(extent) + ": a volume needs at least 2");
    header.size[axis - 1] = static_cast<int>(extent);
  }
  for (std::size_t axis = 4; axis <= static_cast<std::size_t>(dimensions); ++axis)
    if (fields.dim[axis] != 1)
      refuse_header(file, "dim[" + std::to_string(axis) + "]",
                    std::to_string(fields.dim[axis]) + ": a series or vectors; one volume is wanted");
  check_size({header.size[0], header.size[1], header.size[2]}, 1, "dim", file);
}

VoxelType nifti_voxel_type(NiftiType type) {
  switch (type) {
    case NiftiType::kUint8:
      return VoxelType::kUint8;
    case NiftiType::kInt16:
      return VoxelType::kInt16;
    case NiftiType::kInt32:
      return VoxelType::kInt32;
    case NiftiType::kFloat32:
      return VoxelType::kFloat32;
    case NiftiType::kFloat64:
      return VoxelType::kFloat64;
    case NiftiType::kInt8:
      return VoxelType::kInt8;
    case NiftiType::kUint16:
      return VoxelType::kUint16;
    case NiftiType::kUint32:
      return VoxelType::kUint32;
    case NiftiType::kInt64:
      return VoxelType::kInt64;
    case NiftiType::kUint64:
      return VoxelType::kUint64;
  }
  return VoxelType::kUint8;
}

void read_type(const NiftiFields& fields, const std::string& file, NiftiHeader& header) {
  constexpr std::array known{2, 4, 8, 16, 64, 256, 512, 768, 1024, 1280};
  if (std::find(known.begin(), known.end(), fields.datatype) == known.end())
    refuse_header(file, "datatype", std::to_string(fields.datatype) + " is no real-valued type that is read here");
  header.type = static_cast<NiftiType>(fields.datatype);
  if (fields.bitpix != static_cast<int>(8 * bytes_of(nifti_voxel_type(header.type))))
    refuse_header(file, "bitpix",
                  std::to_string(fields.bitpix) + " does not fit datatype " + std::to_string(fields.datatype));
  if (fields.intent != 0 && (fields.intent < 1001 || fields.intent > 1003))  // estimate, label, neuroname
    refuse_header(file, "intent_code", std::to_string(fields.intent) + " is neither a plain image nor labels");
  if (!std::isfinite(fields.slope) || !std::isfinite(fields.intercept)) refuse_header(file, "scl_slope", "not finite");
  header.slope = fields.slope == 0 ? 1 : fields.slope;
  header.intercept = fields.slope == 0 ? 0 : fields.intercept;
}

void read_offset(const NiftiFields& fields, const std::string& file, NiftiHeader& header) {
  header.data_offset = fields.vox_offset;
  const double first = fields.pair ? 0 : fields.version == 1 ? 352 : 544;
  if (!(header.data_offset >= first && header.data_offset <= 16 << 20) ||
      header.data_offset != std::floor(header.data_offset))
    refuse_header(file, "vox_offset", plain(header.data_offset) + " is not a place behind the header");
}

/// Brings the header's lengths to millimetres: by the caller's unit where the header says none, or another than mm.
/// @return what helps when they come out implausible
std::string scale_to_mm(NiftiFields& fields, const std::string& asked, const std::string& file, NiftiHeader& header) {
  const int unit = fields.units & 7;
  const std::string said = unit == 1 ? "metres" : unit == 3 ? "micrometres" : "no unit that is known";
  double scale = unit == 1 ? 1e3 : unit == 3 ? 1e-3 : 1;
  if (!asked.empty()) scale = millimetres_in(asked, "--unit", file);
  if (unit == 2 && scale != 1)
    header.notes.push_back("the header says mm; lengths read in " + asked + ", as was asked for");
  if (unit == 2) return "";
  header.notes.push_back("xyzt_units says " + said + "; " +
                         (!asked.empty()           ? asked + " was taken, as --unit says"
                          : unit == 1 || unit == 3 ? std::string("lengths were brought to millimetres")
                                                   : std::string("millimetres assumed")));
  for (std::size_t axis = 1; axis <= 3; ++axis) fields.pixdim[axis] *= scale, fields.qoffset[axis - 1] *= scale;
  fields.srow *= scale;
  return " (xyzt_units says " + said + "; where that is wrong, --unit mm, cm, m or um says what is right)";
}

/// Edges of a voxel. nifti1.h wants them positive: which way an axis runs is for the sform, or the quaternion and
/// pixdim[0], to say.
Eigen::Vector3d read_pixdim(const NiftiFields& fields, const std::string& file, const std::string& hint,
                            NiftiHeader& header) {
  Eigen::Vector3d spacing;
  for (std::size_t axis = 1; axis <= 3; ++axis) {
    const double value = fields.pixdim[axis];
    if (!(std::abs(value) >= 0.01 && std::abs(value) <= 100))
      refuse_header(file, "pixdim[" + std::to_string(axis) + "]", plain(value) + " mm is no voxel size" + hint);
    spacing[static_cast<Eigen::Index>(axis) - 1] = std::abs(value);
  }
  const bool negative = std::any_of(&fields.pixdim[1], &fields.pixdim[1] + 3, [](double value) { return value < 0; });
  if (negative)
    header.notes.push_back("pixdim holds negative voxel sizes, which have no meaning: their amounts were taken, the " +
                           std::string(fields.sform > 0 ? "sform" : "qform") + " says which way the axes run");
  return spacing;
}

Eigen::Affine3d sform_of(const NiftiFields& fields) {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  matrix.topRows<3>() = fields.srow;
  return Eigen::Affine3d(matrix);
}

/// Quaternion (b, c, d), offset and qfac as nifti1.h defines "method 2".
Eigen::Affine3d qform_of(const NiftiFields& fields, const Eigen::Vector3d& spacing) {
  const auto& [b, c, d] = fields.quatern;
  const double a = std::sqrt(std::max(0.0, 1 - (b * b + c * c + d * d)));
  const double qfac = fields.pixdim[0] < 0 ? -1 : 1;
  Eigen::Affine3d affine = Eigen::Affine3d::Identity();
  affine.linear() = Eigen::Quaterniond(a, b, c, d).normalized().toRotationMatrix() *
                    Eigen::Vector3d(spacing.x(), spacing.y(), qfac * spacing.z()).asDiagonal();
  affine.translation() << fields.qoffset[0], fields.qoffset[1], fields.qoffset[2];
  return affine;
}

double largest_corner_shift(const NiftiHeader& header, const Eigen::Affine3d& other) {
  double shift = 0;
  for (int corner = 0; corner < 8; ++corner) {
    Eigen::Vector3d index;
    for (int axis = 0; axis < 3; ++axis)
      index[axis] = (corner >> axis & 1) != 0 ? header.size[static_cast<std::size_t>(axis)] - 1 : 0;
    shift = std::max(shift, (header.index_to_ras_mm * index - other * index).norm());
  }
  return shift;
}

void read_nifti_frame(NiftiFields fields, const std::string& unit, const std::string& file, NiftiHeader& header) {
  const std::string hint = scale_to_mm(fields, unit, file, header);
  const Eigen::Vector3d pixdim = read_pixdim(fields, file, hint, header);
  const int qform = fields.qform, sform = fields.sform;
  if (qform < 0 || qform > 5 || sform < 0 || sform > 5) refuse_header(file, "qform_code/sform_code", "unknown code");
  if (qform == 0 && sform == 0)
    refuse_header(file, "qform_code/sform_code", "both 0: the file does not say where left and right are");
  header.index_to_ras_mm = sform > 0 ? sform_of(fields) : qform_of(fields, pixdim);
  header.frame_source = sform > 0 ? "sform " + std::to_string(sform) : "qform " + std::to_string(qform);
  check_frame(header.index_to_ras_mm, sform > 0 ? "srow" : "quatern", file, hint, header.notes);
  if (sform == 0 || qform == 0) return;
  const Eigen::Affine3d from_qform = qform_of(fields, pixdim);
  std::vector<std::string> unused;
  check_frame(from_qform, "quatern", file, "", unused);
  const double shift = largest_corner_shift(header, from_qform);
  if (shift > 0.1)
    header.notes.push_back("sform and qform place the image up to " + plain(shift) + " mm apart; the sform was used");
}

/// "scan.hdr" for "scan.img" and the other way round, keeping ".gz".
fs::path partner(const fs::path& path, const std::string& from, const std::string& to) {
  std::string name = path.filename().string();
  const std::size_t place = lower_case(name).rfind(from);
  const bool capital = name[place + 1] >= 'A' && name[place + 1] <= 'Z';
  std::string ending = to;
  if (capital)
    for (char& letter : ending) letter = letter == '.' ? letter : static_cast<char>(letter - 'a' + 'A');
  name.replace(place, from.size(), ending);
  return path.parent_path() / name;
}

/// The voxels of a pair: beside the header, plain or packed.
fs::path image_beside(const fs::path& header) {
  const fs::path image = partner(header, ".hdr", ".img");
  if (fs::is_regular_file(image)) return image;
  const std::string name = image.string();
  const fs::path other =
      lower_case(name).ends_with(".gz") ? fs::path(name.substr(0, name.size() - 3)) : fs::path(name + ".gz");
  if (fs::is_regular_file(other)) return other;
  refuse_header(header.string(), "pair", "its voxels, " + image.filename().string() + ", are not beside it");
}

bool has_gzip_signature(const fs::path& path) { return GzipStream(path).gzip(); }

VolumeHeader described(const NiftiHeader& header, const fs::path& path) {
  VolumeHeader volume;
  volume.format = "NIfTI-" + std::to_string(header.version);
  volume.size = header.size;
  volume.index_to_ras_mm = header.index_to_ras_mm;
  volume.notes = header.notes;
  volume.segments = header.labels;
  volume.description = header.description;
  volume.block.file = path;
  volume.block.type = nifti_voxel_type(header.type);
  volume.block.swapped = header.swapped;
  volume.block.slope = header.slope, volume.block.intercept = header.intercept;
  if (header.pair) volume.block.file = image_beside(path);
  const bool gzip = header.pair ? has_gzip_signature(volume.block.file) : header.gzip;
  volume.block.encoding = gzip ? VoxelEncoding::kDeflated : VoxelEncoding::kRaw;
  (gzip ? volume.block.skipped : volume.block.offset) = static_cast<std::uint64_t>(header.data_offset);
  return volume;
}

/// What follows the header, up to the voxels; of a pair, to the end of its header file.
void read_extensions(GzipStream& stream, std::vector<unsigned char>& bytes, NiftiHeader& header) {
  constexpr std::size_t kMost = std::size_t{16} << 20;
  const std::size_t from = header.version == 1 ? kNifti1Bytes : kNifti2Bytes;
  const std::size_t end = header.pair ? kMost : static_cast<std::size_t>(header.data_offset), got = bytes.size();
  if (end > got) {
    bytes.resize(end);
    bytes.resize(got + stream.read(bytes.data() + got, end - got));
  }
  if (const std::size_t last = std::min(end, bytes.size()); last > from)
    header.labels = nifti_labels(std::span(bytes).subspan(from, last - from), header.swapped, header.notes);
}

NiftiHeader open_header(const fs::path& path, const std::string& unit = {}) {
  const std::string file = path.string(), name = lower_case(file);
  const bool named_gzip = name.ends_with(".gz"), pair = name.ends_with(".hdr") || name.ends_with(".hdr.gz");
  if (!pair && !name.ends_with(".nii") && !name.ends_with(".nii.gz"))
    refuse_header(file, "extension", "NIfTI is read from .nii, .nii.gz and .hdr with .img");
  GzipStream stream(path);
  if (stream.gzip() != named_gzip)
    refuse_header(file, "extension",
                  named_gzip ? "named .gz, but the bytes are not gzip" : "not named .gz, but the bytes are gzip");
  std::vector<unsigned char> bytes(kNifti2Bytes);
  const std::size_t got = stream.read(bytes.data(), bytes.size());
  const std::size_t wanted =
      nifti_header_bytes(std::span(bytes).first(got)) == kNifti2Bytes ? kNifti2Bytes : kNifti1Bytes;
  if (got < wanted)
    refuse_header(file, "header",
                  "the file ends after " + std::to_string(got) + " of " + std::to_string(wanted) + " header bytes");
  NiftiHeader header = parse_nifti_header(std::span(bytes).first(got), file, unit);
  if (header.pair != pair)
    refuse_header(file, "magic",
                  pair ? "a header of a single file (.nii) under the name of a .hdr/.img pair"
                       : "a header of a .hdr/.img pair under the name of a single file");
  header.gzip = named_gzip;
  bytes.resize(got);
  if (header.version == 1) {  // 80 bytes from byte 148, as in nifti1.h
    const std::string text(bytes.begin() + 148, bytes.begin() + 228);
    header.description = text.substr(0, text.find('\0'));
  }
  read_extensions(stream, bytes, header);
  return header;
}

}  // namespace

std::size_t NiftiHeader::voxel_count() const {
  return static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) * static_cast<std::size_t>(size[2]);
}

Eigen::Vector3d NiftiHeader::spacing_mm() const { return index_to_ras_mm.linear().colwise().norm().transpose(); }

NiftiHeader parse_nifti_header(std::span<const unsigned char> bytes, const std::string& file, const std::string& unit) {
  const NiftiFields fields = decode_nifti(bytes, file);
  NiftiHeader header;
  header.version = fields.version;
  header.swapped = fields.swapped;
  header.pair = fields.pair;
  read_nifti_size(fields, file, header);
  read_type(fields, file, header);
  read_offset(fields, file, header);
  read_nifti_frame(fields, unit, file, header);
  return header;
}

NiftiHeader read_nifti_header(const fs::path& path) {
  NiftiHeader header = open_header(path);
  const VolumeHeader volume = described(header, path);
  stream_voxels(volume.block, volume.value_count(), {}, [&](std::span<const double> values) {
    for (const double value : values)
      if (!std::isfinite(value)) refuse_header(path.string(), "data", "holds a voxel that is not a finite number");
  });
  return header;
}

VolumeHeader nifti_volume_header(const fs::path& path, const std::string& unit) {
  const std::string name = lower_case(path.string());
  const bool image = name.ends_with(".img") || name.ends_with(".img.gz");
  fs::path header = image ? partner(path, ".img", ".hdr") : path;
  if (image && !fs::is_regular_file(header)) {
    const std::string other = lower_case(header.string()).ends_with(".gz")
                                  ? header.string().substr(0, header.string().size() - 3)
                                  : header.string() + ".gz";
    if (!fs::is_regular_file(other))
      refuse_header(path.string(), "pair", "its header, " + header.filename().string() + ", is not beside it");
    header = other;
  }
  return described(open_header(header, unit), header);
}

}  // namespace trocar
