#include "tissue/imaging/volumes/voxel_stream.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <string>
#include <vector>

#include "haptics/input_error.h"
#include "tissue/imaging/volumes/byte_stream.h"

namespace trocar {
namespace {

static_assert(std::endian::native == std::endian::little, "the reader assumes a little-endian machine");

constexpr std::uint64_t kPiece = 16384;

[[noreturn]] void ends_early(const VoxelBlock& block, std::uint64_t present, std::uint64_t wanted) {
  throw InputError(block.file.string() + ": data: the file ends after " + std::to_string(present) + " of " +
                   std::to_string(wanted) + " bytes");
}

template <typename Stored>
void decode(const unsigned char* raw, std::span<double> values, const VoxelBlock& block) {
  for (double& value : values) {
    std::array<unsigned char, sizeof(Stored)> bytes;
    std::copy_n(raw, sizeof(Stored), bytes.begin());
    if (block.swapped) std::reverse(bytes.begin(), bytes.end());
    value = block.slope * static_cast<double>(std::bit_cast<Stored>(bytes)) + block.intercept;
    raw += sizeof(Stored);
  }
}

void decode_any(const unsigned char* raw, std::span<double> values, const VoxelBlock& block) {
  switch (block.type) {
    case VoxelType::kInt8:
      return decode<std::int8_t>(raw, values, block);
    case VoxelType::kUint8:
      return decode<std::uint8_t>(raw, values, block);
    case VoxelType::kInt16:
      return decode<std::int16_t>(raw, values, block);
    case VoxelType::kUint16:
      return decode<std::uint16_t>(raw, values, block);
    case VoxelType::kInt32:
      return decode<std::int32_t>(raw, values, block);
    case VoxelType::kUint32:
      return decode<std::uint32_t>(raw, values, block);
    case VoxelType::kInt64:
      return decode<std::int64_t>(raw, values, block);
    case VoxelType::kUint64:
      return decode<std::uint64_t>(raw, values, block);
    case VoxelType::kFloat32:
      return decode<float>(raw, values, block);
    case VoxelType::kFloat64:
      return decode<double>(raw, values, block);
  }
}

/// Numbers between white space or commas.
class TextNumbers {
 public:
  TextNumbers(ByteStream& bytes, std::string file) : bytes_(bytes), file_(std::move(file)), block_(1 << 16) {}

  /// @returns false at the end of the file
  bool next(double& value) {
    std::string word;
    for (int letter = get(); letter >= 0; letter = get()) {
      const bool gap = letter <= ' ' || letter == ',';
      if (gap && !word.empty()) break;
      if (!gap) word.push_back(static_cast<char>(letter));
      if (word.size() > 64) refuse(word);
    }
    if (word.empty()) return false;
    const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || stop != word.data() + word.size()) refuse(word);
    ++count_;
    return true;
  }

 private:
  int get() {
    if (place_ == filled_) {
      filled_ = bytes_.read(block_.data(), block_.size());
      place_ = 0;
      if (filled_ == 0) return -1;
    }
    return block_[place_++];
  }

  [[noreturn]] void refuse(const std::string&) const {
    throw InputError(file_ + ": data: value " + std::to_string(count_) + " of the text is no number");
  }

  ByteStream& bytes_;
  std::string file_;
  std::vector<unsigned char> block_;
  std::size_t place_ = 0, filled_ = 0;
  std::uint64_t count_ = 0;
};

using Take = std::function<void(std::span<const double>)>;

bool stream_text(const VoxelBlock& block, std::uint64_t count, const Progress& progress, const Take& take) {
  const auto bytes = open_plain(block.file, block.offset);
  TextNumbers numbers(*bytes, block.file.string());
  std::vector<double> values(kPiece);
  for (std::uint64_t done = 0; done < count;) {
    const auto piece = static_cast<std::size_t>(std::min(kPiece, count - done));
    for (std::size_t n = 0; n < piece; ++n)
      if (!numbers.next(values[n]))
        throw InputError(block.file.string() + ": data: the text ends after " + std::to_string(done + n) + " of " +
                         std::to_string(count) + " values");
    for (std::size_t n = 0; n < piece; ++n) values[n] = block.slope * values[n] + block.intercept;
    take(std::span(values).first(piece));
    done += piece;
    report(progress, "reading voxels", static_cast<double>(done) / static_cast<double>(count));
  }
  double beyond = 0;
  return numbers.next(beyond);
}

std::uint64_t first_byte(const VoxelBlock& block, std::uint64_t data_bytes) {
  return block.last_in_file ? std::filesystem::file_size(block.file) - data_bytes : block.offset;
}

void pass_over(ByteStream& bytes, const VoxelBlock& block, std::uint64_t wanted) {
  std::vector<unsigned char> dump(1 << 16);
  for (std::uint64_t left = block.skipped; left > 0;) {
    const std::size_t got = bytes.read(dump.data(), std::min<std::uint64_t>(left, dump.size()));
    if (got == 0) ends_early(block, block.offset + block.skipped - left, wanted);
    left -= got;
  }
}

}  // namespace

void check_length(const VoxelBlock& block, std::uint64_t count) {
  const std::string name = block.file.string();
  std::error_code error;
  if (!std::filesystem::is_regular_file(block.file, error)) throw InputError(name + ": no such file");
  const std::uint64_t length = std::filesystem::file_size(block.file, error);
  if (error) throw InputError(name + ": cannot be read");
  const std::uint64_t data = count * bytes_of(block.type);
  const std::uint64_t wanted = block.offset + block.skipped + data;
  if (block.encoding == VoxelEncoding::kRaw && length < wanted) ends_early(block, length, wanted);
  const std::uint64_t rest = length - std::min(length, block.offset);
  if (block.encoding == VoxelEncoding::kDeflated && rest * kLargestInflation + kPiece < block.skipped + data)
    throw InputError(name + ": data: too short: " + std::to_string(rest) + " packed bytes cannot hold " +
                     std::to_string(data) + " bytes of voxels");
  if (block.encoding == VoxelEncoding::kText && rest + 1 < 2 * count)
    throw InputError(name + ": data: too short: " + std::to_string(rest) + " bytes of text cannot hold " +
                     std::to_string(count) + " values");
}

bool stream_voxels(const VoxelBlock& block, std::uint64_t count, const Progress& progress, const Take& take) {
  check_length(block, count);
  if (block.encoding == VoxelEncoding::kText) return stream_text(block, count, progress, take);
  const std::size_t width = bytes_of(block.type);
  const std::uint64_t wanted = block.offset + block.skipped + count * width;
  const auto bytes = block.encoding == VoxelEncoding::kDeflated
                         ? open_deflated(block.file, block.offset)
                         : open_plain(block.file, first_byte(block, count * width));
  if (!block.last_in_file) pass_over(*bytes, block, wanted);
  std::vector<unsigned char> raw(kPiece * width);
  std::vector<double> values(kPiece);
  for (std::uint64_t done = 0; done < count;) {
    const auto piece = static_cast<std::size_t>(std::min(kPiece, count - done));
    const std::size_t got = bytes->read(raw.data(), piece * width);
    if (got < piece * width) ends_early(block, block.offset + block.skipped + done * width + got, wanted);
    decode_any(raw.data(), std::span(values).first(piece), block);
    take(std::span<const double>(values).first(piece));
    done += piece;
    if (done % (kPiece * 64) == 0 || done == count)
      report(progress, "reading voxels", static_cast<double>(done) / static_cast<double>(count));
  }
  unsigned char beyond = 0;
  return bytes->read(&beyond, 1) > 0;  // one step further also proves the checksum of a gzip stream
}

}  // namespace trocar
