#include "tissue/imaging/volumes/nifti_fields.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "haptics/input_error.h"

namespace trocar {
namespace {

[[noreturn]] void refuse_field(const std::string& file, const std::string& field, const std::string& what) {
  throw InputError(file + ": " + field + ": " + what);
}

/// Fields by their byte offset, in either byte order.
class FieldReader {
 public:
  FieldReader(std::span<const unsigned char> bytes, bool swapped) : bytes_(bytes), swapped_(swapped) {}

  template <typename T>
  T at(std::size_t offset) const {
    std::array<unsigned char, sizeof(T)> raw;
    std::copy_n(bytes_.begin() + static_cast<std::ptrdiff_t>(offset), sizeof(T), raw.begin());
    if (swapped_) std::reverse(raw.begin(), raw.end());
    return std::bit_cast<T>(raw);
  }

  template <typename T>
  void srow(std::size_t offset, NiftiFields& fields) const {
    for (std::size_t n = 0; n < 12; ++n)
      fields.srow(static_cast<int>(n / 4), static_cast<int>(n % 4)) = at<T>(offset + n * sizeof(T));
  }

 private:
  std::span<const unsigned char> bytes_;
  bool swapped_;
};

template <typename Count, typename Real>
void decode_extents(const FieldReader& field, std::size_t dim, std::size_t pixdim, NiftiFields& fields) {
  for (std::size_t n = 0; n < 8; ++n) {
    fields.dim[n] = field.at<Count>(dim + n * sizeof(Count));
    fields.pixdim[n] = field.at<Real>(pixdim + n * sizeof(Real));
  }
}

/// Both transforms; in either format they stand one behind the other.
template <typename Real>
void decode_transforms(const FieldReader& field, std::size_t quatern, NiftiFields& fields) {
  for (std::size_t n = 0; n < 3; ++n) {
    fields.quatern[n] = field.at<Real>(quatern + n * sizeof(Real));
    fields.qoffset[n] = field.at<Real>(quatern + (3 + n) * sizeof(Real));
  }
  field.srow<Real>(quatern + 6 * sizeof(Real), fields);
}

void decode_1(const FieldReader& field, NiftiFields& fields) {
  decode_extents<std::int16_t, float>(field, 40, 76, fields);
  fields.intent = field.at<std::int16_t>(68);
  fields.datatype = field.at<std::int16_t>(70);
  fields.bitpix = field.at<std::int16_t>(72);
  fields.vox_offset = field.at<float>(108);
  fields.slope = field.at<float>(112);
  fields.intercept = field.at<float>(116);
  fields.units = field.at<std::uint8_t>(123);
  fields.qform = field.at<std::int16_t>(252);
  fields.sform = field.at<std::int16_t>(254);
  decode_transforms<float>(field, 256, fields);
}

void decode_2(const FieldReader& field, NiftiFields& fields) {
  decode_extents<std::int64_t, double>(field, 16, 104, fields);
  fields.datatype = field.at<std::int16_t>(12);
  fields.bitpix = field.at<std::int16_t>(14);
  fields.vox_offset = static_cast<double>(field.at<std::int64_t>(168));
  fields.slope = field.at<double>(176);
  fields.intercept = field.at<double>(184);
  fields.qform = field.at<std::int32_t>(344);
  fields.sform = field.at<std::int32_t>(348);
  decode_transforms<double>(field, 352, fields);
  fields.units = field.at<std::int32_t>(500);
  fields.intent = field.at<std::int32_t>(504);
}

bool is_magic(std::span<const unsigned char> bytes, std::size_t offset, const char* magic, std::size_t length) {
  return std::memcmp(bytes.data() + offset, magic, length) == 0;
}

void check_magic(std::span<const unsigned char> bytes, const std::string& file, NiftiFields& fields) {
  const std::size_t offset = fields.version == 1 ? 344 : 4;
  const std::string one = fields.version == 1 ? std::string("n+1\0", 4) : std::string("n+2\0\r\n\x1a\n", 8);
  const std::string two = fields.version == 1 ? std::string("ni1\0", 4) : std::string("ni2\0\r\n\x1a\n", 8);
  fields.pair = is_magic(bytes, offset, two.data(), two.size());
  if (fields.pair || is_magic(bytes, offset, one.data(), one.size())) return;
  if (fields.version == 1 && is_magic(bytes, offset, "\0\0\0\0", 4))
    refuse_field(file, "magic",
                 "empty: an Analyze 7.5 header, which does not say where left and right are; save it as NIfTI");
  refuse_field(file, "magic",
               "not \"" + one.substr(0, 3) + "\": not a NIfTI-" + std::to_string(fields.version) + " file");
}

}  // namespace

std::size_t nifti_header_bytes(std::span<const unsigned char> bytes) {
  if (bytes.size() < 4) return 0;
  for (const bool swapped : {false, true}) {
    const auto size = FieldReader(bytes, swapped).at<std::int32_t>(0);
    if (size == static_cast<std::int32_t>(kNifti1Bytes) || size == static_cast<std::int32_t>(kNifti2Bytes))
      return static_cast<std::size_t>(size);
  }
  return 0;
}

NiftiFields decode_nifti(std::span<const unsigned char> bytes, const std::string& file) {
  const std::size_t size = nifti_header_bytes(bytes);
  if (size == 0)
    refuse_field(
        file, "sizeof_hdr",
        std::to_string(FieldReader(bytes, false).at<std::int32_t>(0)) + " instead of 348 or 540: not a NIfTI file");
  if (bytes.size() < size)
    refuse_field(file, "sizeof_hdr",
                 std::to_string(size) + (size == kNifti2Bytes ? " is NIfTI-2" : " is NIfTI-1") + ", but only " +
                     std::to_string(bytes.size()) + " header bytes are there");
  NiftiFields fields;
  fields.version = size == kNifti2Bytes ? 2 : 1;
  fields.swapped = FieldReader(bytes, false).at<std::int32_t>(0) != static_cast<std::int32_t>(size);
  check_magic(bytes, file, fields);
  const FieldReader field(bytes, fields.swapped);
  if (fields.version == 1)
    decode_1(field, fields);
  else
    decode_2(field, fields);
  return fields;
}

}  // namespace trocar
