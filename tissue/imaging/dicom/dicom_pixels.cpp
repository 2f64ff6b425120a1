#include "tissue/imaging/dicom/dicom_pixels.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>

#include "haptics/input_error.h"
#include "tissue/imaging/child_process.h"
#include "tissue/imaging/dicom/gdcm_frame.h"
#include "tissue/imaging/dicom/pixel_codes.h"

namespace trocar {
namespace {

constexpr std::size_t kBatchBytes = std::size_t{32} << 20;

std::size_t frame_bytes(const DicomImage& image) {
  return static_cast<std::size_t>(image.rows) * static_cast<std::size_t>(image.columns) *
         static_cast<std::size_t>(image.format.allocated / 8);
}

/// The bytes in which the pixels lie: the file, or what it inflates to.
std::unique_ptr<ByteSource> pixel_source(const DicomInstance& instance) {
  if (!instance.image->syntax->deflated) return std::make_unique<ByteSource>(instance.path, instance.name);
  std::unique_ptr<ByteSource> source;
  InflateBudget budget;
  read_dicom_elements(instance.path, instance.name, budget, &source);
  return source;
}

void to_little_endian(std::string& bytes, std::size_t width) {
  for (std::size_t n = 0; n + width <= bytes.size(); n += width)
    std::reverse(bytes.begin() + static_cast<std::ptrdiff_t>(n),
                 bytes.begin() + static_cast<std::ptrdiff_t>(n + width));
}

std::string native_frame(ByteSource& source, const DicomImage& image, std::size_t frame) {
  const std::size_t size = frame_bytes(image), width = static_cast<std::size_t>(image.format.allocated / 8);
  const std::uint64_t at = image.pixels.offset + frame * size;
  if (!image.syntax->big_endian) return source.bytes(at, size);
  if (width > 1 || !image.pixels.words) {
    std::string bytes = source.bytes(at, size);
    to_little_endian(bytes, width);
    return bytes;
  }
  std::string result;  // bytes in big endian words lie crosswise
  for (std::uint64_t n = frame * size; n < (frame + 1) * size; ++n) {
    char byte = 0;
    if (!source.read(image.pixels.offset + (n ^ 1), &byte, 1)) source.read(image.pixels.offset + n, &byte, 1);
    result.push_back(byte);
  }
  return result;
}

/// First and last + 1 of the fragments of one frame (PS3.5 A.4): one each, or by the offset table, or all of the only
/// frame.
std::pair<std::size_t, std::size_t> fragments_of(const DicomImage& image, std::size_t frame, const std::string& name) {
  const auto& pixels = image.pixels;
  const auto frames = static_cast<std::size_t>(image.frames);
  if (frames == 1) return {0, pixels.fragments.size()};
  if (pixels.fragments.size() == frames) return {frame, frame + 1};
  const auto starts_at = [&](std::size_t offset) {
    const std::uint64_t base = pixels.fragments.front().first;  // offsets count from the first fragment's item head
    for (std::size_t n = 0; n < pixels.fragments.size(); ++n)
      if (pixels.fragments[n].first - base == offset) return n;
    throw InputError(name + ": its table of frames does not fit its compressed pixels: it is damaged");
  };
  if (pixels.frame_offsets.size() != frames)
    throw InputError(name + ": its " + std::to_string(frames) + " frames come in " +
                     std::to_string(pixels.fragments.size()) + " pieces without a table of where each begins");
  const std::size_t first = starts_at(pixels.frame_offsets[frame]);
  return {first, frame + 1 < frames ? starts_at(pixels.frame_offsets[frame + 1]) : pixels.fragments.size()};
}

std::string compressed_frame(ByteSource& source, const DicomImage& image, std::size_t frame, const std::string& name) {
  const auto [first, last] = fragments_of(image, frame, name);
  std::string bytes;
  for (std::size_t n = first; n < last; ++n)
    bytes += source.bytes(image.pixels.fragments[n].first, image.pixels.fragments[n].second);
  return bytes;
}

/// Decoders print to both; the child has nobody to talk to.
void silence_outputs() {
  const int nowhere = open("/dev/null", O_WRONLY);
  if (nowhere < 0) return;
  dup2(nowhere, 1);
  dup2(nowhere, 2);
  close(nowhere);
}

bool compressed(const DicomPixels::Wish& wish) { return wish.instance->image->pixels.encapsulated; }

std::string decode_batch(const std::vector<DicomPixels::Wish>& wishes, std::size_t first, std::size_t last) {
  silence_outputs();
  std::string all;
  for (std::size_t n = first; n < last; ++n) {
    const DicomInstance& instance = *wishes[n].instance;
    const DicomImage& image = *instance.image;
    ByteSource source(instance.path, instance.name);
    const std::string name =
        image.frames > 1 ? instance.name + ": frame " + std::to_string(wishes[n].frame + 1) : instance.name;
    const std::string bytes = compressed_frame(source, image, wishes[n].frame, name);
    if (image.syntax->coding == PixelCoding::kRle) {
      all += decode_rle_frame(bytes, image, name);
      continue;
    }
    check_compressed_frame(bytes, image, name);
    all += decode_frame_gdcm(bytes, image, name);
  }
  return all;
}

/// Decodes wishes from `first` on in one child and hands them over. @return the first wish that was not decoded
std::size_t take_compressed(const std::vector<DicomPixels::Wish>& wishes, std::size_t first, const Progress& progress,
                            const DicomPixels::Take& take) {
  std::size_t last = first, bytes = 0;
  while (last < wishes.size() && compressed(wishes[last]) && (last == first || bytes < kBatchBytes))
    bytes += frame_bytes(*wishes[last++].instance->image);
  const bool several = wishes[first].instance != wishes[last - 1].instance;
  const std::string what =
      wishes[first].instance->name + (several ? " or one of the files after it" : "") + ": decoding";
  const std::string all = in_child(what, ChildLimits{std::uint64_t{1} << 30, 300}, progress,
                                   [&] { return decode_batch(wishes, first, last); });
  if (all.size() != bytes) throw InputError(wishes[first].instance->name + ": was not decoded whole");
  for (std::size_t n = first, at = 0; n < last; ++n) {
    const DicomImage& image = *wishes[n].instance->image;
    take(n, unpacked(all.substr(at, frame_bytes(image)), image.format));
    at += frame_bytes(image);
  }
  return last;
}

template <typename Stored>
std::vector<float> unpacked_as(const std::string& bytes, const PixelFormat& format) {
  std::vector<float> values(bytes.size() / sizeof(Stored));
  const std::uint64_t mask = (std::uint64_t{1} << format.stored) - 1, sign = std::uint64_t{1} << (format.stored - 1);
  const int shift = format.high_bit + 1 - format.stored;
  for (std::size_t n = 0; n < values.size(); ++n) {
    Stored stored;
    std::memcpy(&stored, bytes.data() + n * sizeof(Stored), sizeof(Stored));
    const std::uint64_t bits = (std::uint64_t{stored} >> shift) & mask;
    const bool negative = format.is_signed && (bits & sign) != 0;
    values[n] = static_cast<float>(negative ? static_cast<std::int64_t>(bits) - static_cast<std::int64_t>(mask) - 1
                                            : static_cast<std::int64_t>(bits));
  }
  return values;
}

}  // namespace

std::vector<float> unpacked(const std::string& bytes, const PixelFormat& format) {
  if (format.allocated == 8) return unpacked_as<std::uint8_t>(bytes, format);
  if (format.allocated == 16) return unpacked_as<std::uint16_t>(bytes, format);
  return unpacked_as<std::uint32_t>(bytes, format);
}

void DicomPixels::read(const std::vector<Wish>& wishes, const Progress& progress, const Take& take) {
  std::unique_ptr<ByteSource> source;
  const DicomInstance* open_instance = nullptr;
  for (std::size_t n = 0; n < wishes.size();) {
    report(progress, "decoding slices", static_cast<double>(n) / static_cast<double>(wishes.size()));
    if (compressed(wishes[n])) {
      n = take_compressed(wishes, n, progress, take);
      continue;
    }
    const DicomInstance& instance = *wishes[n].instance;
    if (open_instance != &instance) source = pixel_source(instance), open_instance = &instance;
    take(n, unpacked(native_frame(*source, *instance.image, wishes[n].frame), instance.image->format));
    ++n;
  }
  report(progress, "decoding slices", 1);
}

}  // namespace trocar
