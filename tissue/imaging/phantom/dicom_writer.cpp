#include "tissue/imaging/phantom/dicom_writer.h"

#include <bit>
#include <cstdio>
#include <cstring>
#include <deque>
#include <stdexcept>

#include "tissue/organ/staged_file.h"

namespace trocar {
namespace {

static_assert(std::endian::native == std::endian::little, "values are written in this machine's byte order");

constexpr const char* kCtImageStorage = "1.2.840.10008.5.1.4.1.1.2";
constexpr const char* kExplicitLittleEndian = "1.2.840.10008.1.2.1";
constexpr int kIntercept = -1024, kLargestStored = 4095;

template <typename T>
void append_element(std::string& bytes, T value) {
  const std::size_t at = bytes.size();
  bytes.resize(at + sizeof(T));
  std::memcpy(bytes.data() + at, &value, sizeof(T));
}

/// One data element with an explicit value representation; values are padded to an even length.
void element(std::string& bytes, std::uint16_t group, std::uint16_t number_text, const char* representation,
             std::string value) {
  const std::string_view vr(representation);
  const bool binary = vr == "UI" || vr == "OB" || vr == "OW";
  if (value.size() % 2 != 0) value += binary ? '\0' : ' ';
  append_element(bytes, group);
  append_element(bytes, number_text);
  bytes += vr;
  if (vr == "OB" || vr == "OW") {
    append_element(bytes, std::uint16_t{0});
    append_element(bytes, static_cast<std::uint32_t>(value.size()));
  } else {
    append_element(bytes, static_cast<std::uint16_t>(value.size()));
  }
  bytes += value;
}

void number_text(std::string& bytes, std::uint16_t group, std::uint16_t tag, int value) {
  std::string packed;
  append_element(packed, static_cast<std::uint16_t>(value));
  element(bytes, group, tag, "US", packed);
}

/// A decimal string of at most 16 characters.
std::string decimal(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", value == 0 ? 0.0 : value);
  return text;
}

/// FNV-1a of the image: the same image, the same identifiers.
std::uint64_t fingerprint(const CtPhantom& phantom) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (const std::int16_t value : phantom.hounsfield)
    hash = (hash ^ static_cast<std::uint16_t>(value)) * 1099511628211ULL;
  return hash;
}

std::string identifier(std::uint64_t image, std::uint64_t part) {
  return "2.25." + std::to_string((image ^ (part * 0x9E3779B97F4A7C15ULL)) | 1ULL << 63);
}

struct Identifiers {
  std::string study, series, frame, instance;
};

Identifiers identifiers_of(std::uint64_t image, int k) {
  return {identifier(image, 1), identifier(image, 2), identifier(image, 3),
          identifier(image, 16 + static_cast<std::uint64_t>(k))};
}

std::string file_meta(const Identifiers& id) {
  std::string meta;
  element(meta, 0x0002, 0x0001, "OB", std::string("\0\1", 2));
  element(meta, 0x0002, 0x0002, "UI", kCtImageStorage);
  element(meta, 0x0002, 0x0003, "UI", id.instance);
  element(meta, 0x0002, 0x0010, "UI", kExplicitLittleEndian);
  element(meta, 0x0002, 0x0012, "UI", "2.25.85207264183265");
  std::string length, bytes(128, '\0');
  append_element(length, static_cast<std::uint32_t>(meta.size()));
  bytes += "DICM";
  element(bytes, 0x0002, 0x0000, "UL", length);
  return bytes + meta;
}

void identity(std::string& bytes, const Identifiers& id) {
  element(bytes, 0x0008, 0x0005, "CS", "ISO_IR 100");
  element(bytes, 0x0008, 0x0008, "CS", "DERIVED\\PRIMARY\\AXIAL");
  element(bytes, 0x0008, 0x0016, "UI", kCtImageStorage);
  element(bytes, 0x0008, 0x0018, "UI", id.instance);
  for (const std::uint16_t date : {0x0020, 0x0023}) element(bytes, 0x0008, date, "DA", "20000101");
  for (const std::uint16_t time : {0x0030, 0x0033}) element(bytes, 0x0008, time, "TM", "000000");
  element(bytes, 0x0008, 0x0050, "SH", "");
  element(bytes, 0x0008, 0x0060, "CS", "CT");
  element(bytes, 0x0008, 0x0070, "LO", "Trocar");
  element(bytes, 0x0008, 0x0090, "PN", "");
  element(bytes, 0x0008, 0x103E, "LO", "synthetic CT phantom");
  element(bytes, 0x0010, 0x0010, "PN", "PHANTOM");
  element(bytes, 0x0010, 0x0020, "LO", "PHANTOM");
  element(bytes, 0x0010, 0x0030, "DA", "");
  element(bytes, 0x0010, 0x0040, "CS", "");
}

void geometry(std::string& bytes, const LabelVolume& grid, int k, const Identifiers& id) {
  const Eigen::Vector3d corner = grid.index_to_ras_mm * Eigen::Vector3d(grid.size[0] - 1, grid.size[1] - 1, k);
  const double thickness = grid.index_to_ras_mm.linear()(2, 2);
  element(bytes, 0x0018, 0x0050, "DS", decimal(thickness));
  element(bytes, 0x0018, 0x0060, "DS", "120");
  element(bytes, 0x0018, 0x5100, "CS", "HFS");
  element(bytes, 0x0020, 0x000D, "UI", id.study);
  element(bytes, 0x0020, 0x000E, "UI", id.series);
  element(bytes, 0x0020, 0x0010, "SH", "1");
  element(bytes, 0x0020, 0x0011, "IS", "1");
  element(bytes, 0x0020, 0x0013, "IS", std::to_string(k + 1));
  element(bytes, 0x0020, 0x0032, "DS", decimal(-corner.x()) + "\\" + decimal(-corner.y()) + "\\" + decimal(corner.z()));
  element(bytes, 0x0020, 0x0037, "DS", "1\\0\\0\\0\\1\\0");
  element(bytes, 0x0020, 0x0052, "UI", id.frame);
  element(bytes, 0x0020, 0x1040, "LO", "");
}

void pixel_format(std::string& bytes, const LabelVolume& grid) {
  const Eigen::Matrix3d step = grid.index_to_ras_mm.linear();
  number_text(bytes, 0x0028, 0x0002, 1);
  element(bytes, 0x0028, 0x0004, "CS", "MONOCHROME2");
  number_text(bytes, 0x0028, 0x0010, grid.size[1]);
  number_text(bytes, 0x0028, 0x0011, grid.size[0]);
  element(bytes, 0x0028, 0x0030, "DS", decimal(step(1, 1)) + "\\" + decimal(step(0, 0)));
  number_text(bytes, 0x0028, 0x0100, 16);
  number_text(bytes, 0x0028, 0x0101, 12);
  number_text(bytes, 0x0028, 0x0102, 11);
  number_text(bytes, 0x0028, 0x0103, 0);
  element(bytes, 0x0028, 0x1050, "DS", "50");
  element(bytes, 0x0028, 0x1051, "DS", "400");
  element(bytes, 0x0028, 0x1052, "DS", std::to_string(kIntercept));
  element(bytes, 0x0028, 0x1053, "DS", "1");
  element(bytes, 0x0028, 0x1054, "LO", "HU");
}

/// Rows from front to back, columns from the patient's right to the left: the view from the feet.
std::string pixels(const CtPhantom& phantom, int k) {
  const LabelVolume& grid = phantom.labels;
  std::string packed;
  packed.reserve(2 * static_cast<std::size_t>(grid.size[0]) * static_cast<std::size_t>(grid.size[1]));
  for (int j = grid.size[1] - 1; j >= 0; --j)
    for (int i = grid.size[0] - 1; i >= 0; --i) {
      const int stored = phantom.hounsfield[grid.offset(i, j, k)] - kIntercept;
      if (stored < 0 || stored > kLargestStored) throw std::invalid_argument("write_phantom_dicom: HU beyond 12 bits");
      append_element(packed, static_cast<std::uint16_t>(stored));
    }
  return packed;
}

std::string slice(const CtPhantom& phantom, int k, std::uint64_t image) {
  const Identifiers id = identifiers_of(image, k);
  std::string bytes = file_meta(id);
  identity(bytes, id);
  geometry(bytes, phantom.labels, k, id);
  pixel_format(bytes, phantom.labels);
  element(bytes, 0x7FE0, 0x0010, "OW", pixels(phantom, k));
  return bytes;
}

}  // namespace

std::string phantom_dicom_slice(const CtPhantom& phantom, int k) { return slice(phantom, k, fingerprint(phantom)); }

void write_phantom_dicom(const std::filesystem::path& folder, const CtPhantom& phantom) {
  const std::uint64_t image = fingerprint(phantom);
  std::deque<StagedFile> files;
  for (int k = 0; k < phantom.labels.size[2]; ++k) {
    char name[32];
    std::snprintf(name, sizeof name, "slice-%04d.dcm", k + 1);
    files.emplace_back(folder / name, slice(phantom, k, image));
  }
  for (StagedFile& file : files) file.commit();
}

}  // namespace trocar
