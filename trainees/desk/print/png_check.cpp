#include "trainees/desk/print/png_check.h"

#include <zlib.h>

#include <cstdint>

namespace trocar::printed {
namespace {

constexpr std::size_t kSignature = 8, kFrame = 12;  // of a chunk: length, kind, checksum

std::uint32_t number_at(const std::string& bytes, std::size_t at) {
  std::uint32_t out = 0;
  for (std::size_t i = 0; i < 4; ++i) out = (out << 8) | static_cast<unsigned char>(bytes[at + i]);
  return out;
}

}  // namespace

bool whole_png(const std::string& bytes) {
  if (!bytes.starts_with("\x89PNG\r\n\x1a\n")) return false;
  std::string before;
  bool pixels = false;
  for (std::size_t at = kSignature; at + kFrame <= bytes.size();) {
    const std::size_t length = number_at(bytes, at);
    if (length > bytes.size() - at - kFrame) return false;
    const std::string kind = bytes.substr(at + 4, 4);
    const auto* data = reinterpret_cast<const Bytef*>(bytes.data() + at + 4);
    if (crc32(0, data, static_cast<uInt>(length + 4)) != number_at(bytes, at + 8 + length)) return false;
    if (before.empty() && kind != "IHDR") return false;
    pixels = pixels || kind == "IDAT";
    at += kFrame + length;
    if (kind == "IEND") return pixels && at == bytes.size();
    before = kind;
  }
  return false;
}

}  // namespace trocar::printed
