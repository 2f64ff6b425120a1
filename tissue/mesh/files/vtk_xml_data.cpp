#include "tissue/mesh/files/vtk_xml_data.h"

#include <zlib.h>

#include <algorithm>
#include <array>

#include "haptics/input_error.h"

namespace trocar {
namespace {

constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 30;
constexpr std::uint64_t kZlibMost = 1040;  ///< no zlib stream grows more than 1032 times

int base64_value(char letter) {
  if (letter >= 'A' && letter <= 'Z') return letter - 'A';
  if (letter >= 'a' && letter <= 'z') return letter - 'a' + 26;
  if (letter >= '0' && letter <= '9') return letter - '0' + 52;
  return letter == '+' ? 62 : letter == '/' ? 63 : -1;
}

/// Packed bytes read from the front: raw, or groups of four letters.
class PackedBytes {
 public:
  PackedBytes(std::string_view packed, bool base64, const std::string& file)
      : packed_(packed), base64_(base64), file_(file) {}

  /// Of all that is left.
  std::uint64_t most_left() const { return base64_ ? packed_.size() / 4 * 3 : packed_.size(); }

  /// A run that was packed by itself: base64 pads it to whole groups.
  std::string run(std::uint64_t bytes) {
    if (bytes > most_left()) throw InputError(file_ + ": the data end within an array: the file is cut off");
    const auto count = static_cast<std::size_t>(bytes);
    if (base64_) return letters(count, (count + 2) / 3 * 4);
    std::string result(packed_.substr(0, count));
    packed_.remove_prefix(count);
    return result;
  }

  /// Whether the run of so many bytes from here on is padded at its end.
  bool padded(std::size_t bytes) const {
    const std::size_t end = (bytes + 2) / 3 * 4;
    const std::size_t first = end - (3 - bytes % 3);  // of the padding; a stream that goes on has none here
    return base64_ && bytes % 3 != 0 && packed_.size() >= end && packed_[first] == '=';
  }

 private:
  std::string letters(std::size_t bytes, std::size_t count) {
    if (packed_.size() < count) throw InputError(file_ + ": the data end within an array: the file is cut off");
    std::string result;
    result.reserve(bytes + 2);
    for (std::size_t at = 0; at < count; at += 4) {
      std::uint32_t group = 0;
      for (std::size_t n = 0; n < 4; ++n) {
        const char letter = packed_[at + n];
        const int value = letter == '=' && at + 4 == count ? 0 : base64_value(letter);
        if (value < 0) throw InputError(file_ + ": damaged base64 data");
        group = group << 6 | static_cast<std::uint32_t>(value);
      }
      for (const int shift : {16, 8, 0}) result += static_cast<char>(group >> shift & 255);
    }
    packed_.remove_prefix(count);
    result.resize(bytes);
    return result;
  }

  std::string_view packed_;
  bool base64_;
  const std::string& file_;
};

std::vector<std::int64_t> lengths(const std::string& raw, const VtkXmlPacking& packing) {
  const NumberType type = packing.header_bytes == 8 ? NumberType::kInt64 : NumberType::kUint32;
  return stored_wholes(raw, type, packing.big_endian);
}

void check_length(std::int64_t bytes, std::uint64_t most, const std::string& file) {
  if (bytes < 0 || static_cast<std::uint64_t>(bytes) > most)
    throw InputError(file + ": an array states " + std::to_string(bytes) +
                     " bytes, more than the file can hold: it is cut off or damaged");
}

std::string plain_array(PackedBytes& packed, const VtkXmlPacking& packing, const std::string& file) {
  const std::size_t header = packing.header_bytes;
  const bool apart = packed.padded(header);  // the length was packed by itself
  PackedBytes whole = packed;
  const std::int64_t bytes = lengths(packed.run(header), packing)[0];
  check_length(bytes, packed.most_left() + 8, file);
  if (apart) return packed.run(static_cast<std::uint64_t>(bytes));
  return whole.run(header + static_cast<std::uint64_t>(bytes)).substr(header);
}

std::string inflated(const std::string& block, std::size_t size, const std::string& file) {
  std::string result(size, '\0');
  uLongf length = static_cast<uLongf>(size);
  const int status = uncompress(reinterpret_cast<Bytef*>(result.data()), &length,
                                reinterpret_cast<const Bytef*>(block.data()), static_cast<uLong>(block.size()));
  if (status != Z_OK || length != size) throw InputError(file + ": damaged zlib data in an array");
  return result;
}

/// Number of blocks, size of each, size of the last, packed size of each; then the blocks.
std::string compressed_array(PackedBytes& packed, const VtkXmlPacking& packing, const std::string& file) {
  const std::size_t header = packing.header_bytes;
  PackedBytes start = packed;
  const auto first = lengths(start.run(3 * header), packing);
  const std::int64_t blocks = first[0], size = first[1], last = first[2];
  if (blocks == 0) return {};
  check_length(blocks, packed.most_left() / header, file);
  check_length(size, kMostBytes, file);
  check_length(last, static_cast<std::uint64_t>(size), file);
  const auto stated = lengths(packed.run((3 + static_cast<std::uint64_t>(blocks)) * header), packing);
  std::uint64_t packed_bytes = 0;
  for (std::size_t block = 3; block < stated.size(); ++block) {
    check_length(stated[block], packed.most_left(), file);
    packed_bytes += static_cast<std::uint64_t>(stated[block]);
  }
  const std::uint64_t total = static_cast<std::uint64_t>(blocks - 1) * static_cast<std::uint64_t>(size) +
                              static_cast<std::uint64_t>(last == 0 ? size : last);
  check_length(static_cast<std::int64_t>(total), std::min(kMostBytes, packed_bytes * kZlibMost + 64), file);
  const std::string all = packed.run(packed_bytes);
  std::string result;
  std::size_t at = 0;
  for (std::size_t block = 3; block < stated.size(); ++block) {
    const bool is_last = block + 1 == stated.size();
    const auto wanted = static_cast<std::size_t>(is_last && last != 0 ? last : size);
    result += inflated(all.substr(at, static_cast<std::size_t>(stated[block])), wanted, file);
    at += static_cast<std::size_t>(stated[block]);
  }
  return result;
}

}  // namespace

std::string unpacked_array(std::string_view packed, bool base64, const VtkXmlPacking& packing,
                           const std::string& file) {
  PackedBytes bytes(packed, base64, file);
  return packing.compressed ? compressed_array(bytes, packing, file) : plain_array(bytes, packing, file);
}

NumberType vtk_xml_type(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, NumberType>, 10> kTypes{{{"Int8", NumberType::kInt8},
                                                                            {"UInt8", NumberType::kUint8},
                                                                            {"Int16", NumberType::kInt16},
                                                                            {"UInt16", NumberType::kUint16},
                                                                            {"Int32", NumberType::kInt32},
                                                                            {"UInt32", NumberType::kUint32},
                                                                            {"Int64", NumberType::kInt64},
                                                                            {"UInt64", NumberType::kUint64},
                                                                            {"Float32", NumberType::kFloat32},
                                                                            {"Float64", NumberType::kFloat64}}};
  for (const auto& [known, type] : kTypes)
    if (name == known) return type;
  return NumberType::kNone;
}

}  // namespace trocar
