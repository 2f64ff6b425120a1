#include "tissue/imaging/nifti_header.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <sstream>

#include "haptics/input_error.h"
#include "tissue/imaging/gzip_stream.h"

namespace trocar {
namespace {

static_assert(std::endian::native == std::endian::little, "the reader assumes a little-endian machine");

using HeaderBytes = std::array<unsigned char, 348>;

/// Fields by their byte offset in nifti1.h, in either byte order.
class FieldReader {
 public:
  FieldReader(const HeaderBytes& bytes, bool swapped) : bytes_(bytes), swapped_(swapped) {}

  template <typename T>
  T at(std::size_t offset) const {
    std::array<unsigned char, sizeof(T)> raw;
    std::copy_n(bytes_.begin() + static_cast<std::ptrdiff_t>(offset), sizeof(T), raw.begin());
    if (swapped_) std::reverse(raw.begin(), raw.end());
    return std::bit_cast<T>(raw);
  }

 private:
  const HeaderBytes& bytes_;
  bool swapped_;
};

[[noreturn]] void refuse(const std::string& file, const std::string& field, const std::string& what) {
  throw InputError(file + ": " + field + ": " + what);
}

std::string text(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

int bytes_of(NiftiType type) {
  switch (type) {
    case NiftiType::kUint8:
    case NiftiType::kInt8:
      return 1;
    case NiftiType::kInt16:
    case NiftiType::kUint16:
      return 2;
    case NiftiType::kInt32:
    case NiftiType::kUint32:
    case NiftiType::kFloat32:
      return 4;
    case NiftiType::kFloat64:
      return 8;
  }
  return 0;
}

bool byte_order_swapped(const HeaderBytes& bytes, const std::string& file) {
  const auto plain = FieldReader(bytes, false).at<std::int32_t>(0);
  const auto swapped = FieldReader(bytes, true).at<std::int32_t>(0);
  if (plain == 540 || swapped == 540)
    refuse(file, "sizeof_hdr", "540 is NIfTI-2; only NIfTI-1 is read, please convert");
  if (plain != 348 && swapped != 348) refuse(file, "sizeof_hdr", text(plain) + " instead of 348: not a NIfTI-1 file");
  return swapped == 348;
}

void check_magic(const HeaderBytes& bytes, const std::string& file) {
  if (std::memcmp(bytes.data() + 344, "n+1", 4) == 0) return;
  if (std::memcmp(bytes.data() + 344, "ni1", 4) == 0)
    refuse(file, "magic", "a header of a .hdr/.img pair; only single-file NIfTI-1 is read");
  refuse(file, "magic", "not \"n+1\": not a single-file NIfTI-1");
}

void read_size(const FieldReader& field, const std::string& file, NiftiHeader& header) {
  const int dimensions = field.at<std::int16_t>(40);
  if (dimensions < 3 || dimensions > 7) refuse(file, "dim[0]", text(dimensions) + " dimensions; a volume has 3");
  for (int axis = 0; axis < 3; ++axis) {
    const int extent = field.at<std::int16_t>(42 + 2 * static_cast<std::size_t>(axis));
    if (extent < 2) refuse(file, "dim[" + std::to_string(axis + 1) + "]", text(extent) + ": a volume needs at least 2");
    header.size[static_cast<std::size_t>(axis)] = extent;
  }
  for (int axis = 4; axis <= dimensions; ++axis) {
    const int extent = field.at<std::int16_t>(40 + 2 * static_cast<std::size_t>(axis));
    if (extent != 1)
      refuse(file, "dim[" + std::to_string(axis) + "]", text(extent) + ": a series or vectors; one volume is wanted");
  }
  if (header.voxel_count() > kMaxVoxels)
    refuse(file, "dim", std::to_string(header.voxel_count()) + " voxels, more than " + std::to_string(kMaxVoxels));
}

void read_type(const FieldReader& field, const std::string& file, NiftiHeader& header) {
  const auto code = field.at<std::int16_t>(70);
  header.type = static_cast<NiftiType>(code);
  const int bytes = bytes_of(header.type);
  if (bytes == 0) refuse(file, "datatype", text(code) + " is no real-valued type that is read here");
  if (field.at<std::int16_t>(72) != 8 * bytes)
    refuse(file, "bitpix", text(field.at<std::int16_t>(72)) + " does not fit datatype " + text(code));
  const auto intent = field.at<std::int16_t>(68);
  if (intent != 0 && (intent < 1001 || intent > 1003))  // estimate, label, neuroname
    refuse(file, "intent_code", text(intent) + " is neither a plain image nor labels");
  const double slope = field.at<float>(112), intercept = field.at<float>(116);
  if (!std::isfinite(slope) || !std::isfinite(intercept)) refuse(file, "scl_slope", "not finite");
  header.slope = slope == 0 ? 1 : slope;
  header.intercept = slope == 0 ? 0 : intercept;
  header.data_offset = field.at<float>(108);
  if (!(header.data_offset >= 352 && header.data_offset <= 16 << 20) ||
      header.data_offset != std::floor(header.data_offset))
    refuse(file, "vox_offset", text(header.data_offset) + " is not a place behind the header");
}

Eigen::Vector3d read_pixdim(const FieldReader& field, const std::string& file) {
  Eigen::Vector3d spacing;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double value = field.at<float>(80 + 4 * axis);
    if (!std::isfinite(value) || value < 0.01 || value > 100)
      refuse(file, "pixdim[" + std::to_string(axis + 1) + "]", text(value) + " mm is no voxel size");
    spacing[static_cast<Eigen::Index>(axis)] = value;
  }
  return spacing;
}

Eigen::Affine3d read_sform(const FieldReader& field) {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column)
      matrix(row, column) = field.at<float>(280 + static_cast<std::size_t>(16 * row + 4 * column));
  return Eigen::Affine3d(matrix);
}

/// Quaternion (b, c, d), offset and qfac as nifti1.h defines "method 2".
Eigen::Affine3d read_qform(const FieldReader& field, const Eigen::Vector3d& spacing) {
  const double b = field.at<float>(256), c = field.at<float>(260), d = field.at<float>(264);
  const double a = std::sqrt(std::max(0.0, 1 - (b * b + c * c + d * d)));
  const double qfac = field.at<float>(76) < 0 ? -1 : 1;
  Eigen::Affine3d affine = Eigen::Affine3d::Identity();
  affine.linear() = Eigen::Quaterniond(a, b, c, d).normalized().toRotationMatrix() *
                    Eigen::Vector3d(spacing.x(), spacing.y(), qfac * spacing.z()).asDiagonal();
  affine.translation() << field.at<float>(268), field.at<float>(272), field.at<float>(276);
  return affine;
}

void check_affine(const Eigen::Affine3d& affine, const std::string& field, const std::string& file) {
  if (!affine.matrix().allFinite()) refuse(file, field, "the transform is not finite");
  if (affine.translation().cwiseAbs().maxCoeff() > 1e5) refuse(file, field, "the origin is more than 100 m away");
  Eigen::Matrix3d axes = affine.linear();
  for (int axis = 0; axis < 3; ++axis) {
    const double length = axes.col(axis).norm();
    if (length < 0.01 || length > 100)
      refuse(file, field, "voxel size " + text(length) + " mm along axis " + std::to_string(axis + 1));
    axes.col(axis) /= length;
  }
  // Float32 storage leaves 1e-6; a gantry tilt is 1e-1.
  const double skew = (axes.transpose() * axes - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (skew > 1e-4)
    refuse(file, field, "the axes are not at right angles (shear or gantry tilt, cosine " + text(skew) + ")");
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

void read_frame(const FieldReader& field, const std::string& file, NiftiHeader& header) {
  const Eigen::Vector3d pixdim = read_pixdim(field, file);
  const auto qform = field.at<std::int16_t>(252), sform = field.at<std::int16_t>(254);
  if (qform < 0 || qform > 5 || sform < 0 || sform > 5) refuse(file, "qform_code/sform_code", "unknown code");
  if (qform == 0 && sform == 0)
    refuse(file, "qform_code/sform_code", "both 0: the file does not say where left and right are");
  const int unit = field.at<std::uint8_t>(123) & 7;
  if (unit == 0) header.notes.push_back("xyzt_units says no unit; millimetres assumed");
  if (unit == 1 || unit == 3) refuse(file, "xyzt_units", "lengths in metres or micrometres; millimetres are wanted");
  header.index_to_ras_mm = sform > 0 ? read_sform(field) : read_qform(field, pixdim);
  header.frame_source = sform > 0 ? "sform " + std::to_string(sform) : "qform " + std::to_string(qform);
  check_affine(header.index_to_ras_mm, sform > 0 ? "srow" : "quatern", file);
  if (sform == 0 || qform == 0) return;
  const Eigen::Affine3d from_qform = read_qform(field, pixdim);
  check_affine(from_qform, "quatern", file);
  const double shift = largest_corner_shift(header, from_qform);
  if (shift > 0.1)
    header.notes.push_back("sform and qform place the image up to " + text(shift) + " mm apart; the sform was used");
}

template <typename Real>
bool all_finite(const std::vector<unsigned char>& block, std::size_t bytes, bool swapped) {
  for (std::size_t offset = 0; offset + sizeof(Real) <= bytes; offset += sizeof(Real)) {
    std::array<unsigned char, sizeof(Real)> raw;
    std::copy_n(block.begin() + static_cast<std::ptrdiff_t>(offset), sizeof(Real), raw.begin());
    if (swapped) std::reverse(raw.begin(), raw.end());
    if (!std::isfinite(std::bit_cast<Real>(raw))) return false;
  }
  return true;
}

/// Passes over the rest of the file: every byte must be there, and every real number finite (ITK would make it 0).
void check_data(GzipStream& stream, const NiftiHeader& header, std::uint64_t wanted, const std::string& file) {
  std::vector<unsigned char> block(1 << 16);
  const auto gap = static_cast<std::size_t>(header.data_offset) - HeaderBytes{}.size();
  std::uint64_t present = HeaderBytes{}.size();
  for (std::size_t left = gap; left > 0;) {
    const std::size_t got = stream.read(block.data(), std::min(left, block.size()));
    if (got == 0) break;
    left -= got, present += got;
  }
  while (present < wanted) {
    const std::size_t got = stream.read(block.data(), std::min<std::uint64_t>(block.size(), wanted - present));
    if (got == 0)
      refuse(file, "data",
             "the file ends after " + std::to_string(present) + " of " + std::to_string(wanted) + " bytes");
    present += got;
    const bool finite = header.type == NiftiType::kFloat32   ? all_finite<float>(block, got, header.swapped)
                        : header.type == NiftiType::kFloat64 ? all_finite<double>(block, got, header.swapped)
                                                             : true;
    if (!finite) refuse(file, "data", "holds a voxel that is not a finite number");
  }
  stream.finish_member();
}

}  // namespace

std::size_t NiftiHeader::voxel_count() const {
  return static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) * static_cast<std::size_t>(size[2]);
}

Eigen::Vector3d NiftiHeader::spacing_mm() const { return index_to_ras_mm.linear().colwise().norm().transpose(); }

NiftiHeader parse_nifti_header(const HeaderBytes& bytes, const std::string& file) {
  NiftiHeader header;
  header.swapped = byte_order_swapped(bytes, file);
  check_magic(bytes, file);
  const FieldReader field(bytes, header.swapped);
  read_size(field, file, header);
  read_type(field, file, header);
  read_frame(field, file, header);
  return header;
}

NiftiHeader read_nifti_header(const std::filesystem::path& path) {
  const std::string file = path.string();
  const bool named_gzip = file.ends_with(".nii.gz");
  if (!named_gzip && !file.ends_with(".nii"))
    refuse(file, "extension", "label maps and volumes are read from .nii and .nii.gz");
  GzipStream stream(path);
  if (stream.gzip() != named_gzip)
    refuse(file, "extension",
           named_gzip ? "named .nii.gz, but the bytes are not gzip" : "named .nii, but the bytes are gzip");
  HeaderBytes bytes{};
  const std::size_t got = stream.read(bytes.data(), bytes.size());
  if (got < bytes.size()) refuse(file, "header", "the file ends after " + std::to_string(got) + " of 348 header bytes");
  NiftiHeader header = parse_nifti_header(bytes, file);
  header.gzip = named_gzip;
  const auto wanted = static_cast<std::uint64_t>(header.data_offset) +
                      header.voxel_count() * static_cast<std::uint64_t>(bytes_of(header.type));
  check_data(stream, header, wanted, file);
  return header;
}

}  // namespace trocar
