#include "tissue/imaging/dicom/pixel_codes.h"

#include <cstdint>

#include "haptics/input_error.h"

namespace trocar {
namespace {

struct CodedSize {
  int rows = 0, columns = 0, components = 0, bits = 0;
};

struct Bytes {
  std::string_view all;
  int at(std::size_t n) const { return n < all.size() ? static_cast<unsigned char>(all[n]) : -1; }
  std::int64_t big(std::size_t n, int count) const {
    if (n + static_cast<std::size_t>(count) > all.size()) return -1;
    std::int64_t value = 0;
    for (int k = 0; k < count; ++k) value = value << 8 | at(n + static_cast<std::size_t>(k));
    return value;
  }
  std::uint32_t little32(std::size_t n) const {
    std::uint32_t value = 0;
    for (int k = 3; k >= 0; --k) value = value << 8 | static_cast<std::uint32_t>(at(n + static_cast<std::size_t>(k)));
    return value;
  }
};

bool frame_header(int marker) {
  return (marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC) || marker == 0xF7;
}

/// Walks the marker segments of JPEG and JPEG-LS to the frame header.
CodedSize jpeg_size(const Bytes& bytes) {
  if (bytes.big(0, 2) != 0xFFD8) return {};
  std::size_t at = 2;
  while (bytes.at(at) == 0xFF) {
    const int marker = bytes.at(at + 1);
    if (marker == 0xFF) {
      ++at;  // a fill byte
      continue;
    }
    const std::int64_t length = bytes.big(at + 2, 2);
    if (length < 2) return {};
    if (frame_header(marker))
      return {static_cast<int>(bytes.big(at + 5, 2)), static_cast<int>(bytes.big(at + 7, 2)), bytes.at(at + 9),
              bytes.at(at + 4)};
    at += 2 + static_cast<std::size_t>(length);
  }
  return {};
}

CodedSize jpeg2000_size(const Bytes& bytes) {
  const std::size_t start = bytes.all.find(std::string_view("\xFF\x4F\xFF\x51", 4));
  if (start == std::string_view::npos || (start != 0 && bytes.big(0, 4) != 12))
    return {};                          // 12: a JP2 file round the code
  const std::size_t field = start + 8;  // Xsiz of the SIZ segment
  const std::int64_t width = bytes.big(field, 4), height = bytes.big(field + 4, 4);
  const std::int64_t left = bytes.big(field + 8, 4), top = bytes.big(field + 12, 4), parts = bytes.big(field + 32, 2);
  const std::int64_t tile_width = bytes.big(field + 16, 4), tile_height = bytes.big(field + 20, 4);
  const int depth = bytes.at(field + 34);
  if (depth < 0 || left < 0 || top < 0 || width - left > 65535 || height - top > 65535 || width <= left ||
      height <= top)
    return {};
  if (tile_width < 1 || tile_height < 1 ||
      ((width + tile_width - 1) / tile_width) * ((height + tile_height - 1) / tile_height) > 4096)
    return {};
  return {static_cast<int>(height - top), static_cast<int>(width - left), static_cast<int>(parts), (depth & 0x7F) + 1};
}

/// The end marker, but for padding: writers put zeros, blanks or a single 0xFF behind it.
bool ends_with_end_marker(std::string_view bytes) {
  while (!bytes.empty() && (bytes.back() == '\0' || bytes.back() == ' ')) bytes.remove_suffix(1);
  const std::string_view end("\xFF\xD9", 2);
  return bytes.ends_with(end) || (bytes.ends_with('\xFF') && bytes.substr(0, bytes.size() - 1).ends_with(end));
}

/// What one RLE segment gives, stopping at `enough`; less where it is cut off.
std::string unpacked_segment(std::string_view coded, std::size_t enough) {
  std::string given;
  for (std::size_t at = 0; at < coded.size() && given.size() < enough;) {
    const int code = static_cast<unsigned char>(coded[at++]);
    if (code == 128) continue;
    const std::size_t count = static_cast<std::size_t>(code < 128 ? code + 1 : 257 - code);
    const std::size_t taken = code < 128 ? count : 1;
    if (at + taken > coded.size()) break;
    given += code < 128 ? std::string(coded.substr(at, count)) : std::string(count, coded[at]);
    at += taken;
  }
  return given;
}

}  // namespace

void check_compressed_frame(std::string_view bytes, const DicomImage& image, const std::string& name) {
  const Bytes all{bytes};
  const CodedSize size = image.syntax->coding == PixelCoding::kJpeg2000 ? jpeg2000_size(all) : jpeg_size(all);
  const std::string kind(image.syntax->name);
  if (size.rows <= 0) throw InputError(name + ": its pixels are not " + kind + ", as the header says, or are damaged");
  if (size.rows != image.rows || size.columns != image.columns || size.components != 1)
    throw InputError(name + ": its compressed pixels are " + std::to_string(size.columns) + " x " +
                     std::to_string(size.rows) + " in " + std::to_string(size.components) +
                     " colours, its header says " + std::to_string(image.columns) + " x " + std::to_string(image.rows) +
                     " grey");
  if (size.bits < 1 || size.bits > image.format.allocated)
    throw InputError(name + ": its compressed pixels have " + std::to_string(size.bits) + " bits, its header says " +
                     std::to_string(image.format.allocated));
  if (!ends_with_end_marker(bytes))
    throw InputError(name + ": its compressed pixels are cut off; copy or export it again");
}

std::string decode_rle_frame(std::string_view bytes, const DicomImage& image, const std::string& name) {
  const Bytes all{bytes};
  const auto planes = static_cast<std::size_t>(image.format.allocated / 8);
  if (bytes.size() < 64 || all.little32(0) != planes)
    throw InputError(name + ": its RLE frame does not hold " + std::to_string(planes) +
                     " planes of bytes: it is damaged");
  const std::size_t pixels = static_cast<std::size_t>(image.rows) * static_cast<std::size_t>(image.columns);
  std::string values(pixels * planes, '\0');
  for (std::size_t n = 0; n < planes; ++n) {
    const std::size_t from = all.little32(4 + 4 * n), to = n + 1 < planes ? all.little32(8 + 4 * n) : bytes.size();
    const bool inside = from >= 64 && from <= to && to <= bytes.size();
    const std::string plane = inside ? unpacked_segment(bytes.substr(from, to - from), pixels) : "";
    if (plane.size() < pixels)
      throw InputError(name + ": its RLE pixels are cut off or damaged; copy or export it again");
    for (std::size_t pixel = 0; pixel < pixels; ++pixel) values[(pixel + 1) * planes - 1 - n] = plane[pixel];
  }
  return values;
}

}  // namespace trocar
