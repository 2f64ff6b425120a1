#include "tests/tissue/imaging/dicom/dicom_fixture.h"

#include <zlib.h>

#include <cmath>
#include <cstdio>
#include <cstring>

namespace trocar::test {
namespace {

const char* syntax_of(Encoding encoding) {
  switch (encoding) {
    case Encoding::kImplicit:
      return "1.2.840.10008.1.2";
    case Encoding::kBigEndian:
      return "1.2.840.10008.1.2.2";
    case Encoding::kDeflated:
      return "1.2.840.10008.1.2.1.99";
    case Encoding::kExplicit:
      break;
  }
  return "1.2.840.10008.1.2.1";
}

std::string deflated(const std::string& bytes) {
  z_stream stream{};
  deflateInit2(&stream, 6, Z_DEFLATED, -MAX_WBITS, 8, Z_DEFAULT_STRATEGY);
  std::string result(deflateBound(&stream, bytes.size()) + 16, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(result.data());
  stream.avail_out = static_cast<uInt>(result.size());
  deflate(&stream, Z_FINISH);
  result.resize(stream.total_out);
  deflateEnd(&stream);
  return result;
}

std::string printed(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.10g", value);
  return text;
}

std::string joined(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : "\\") + printed(value);
  return text;
}

bool long_head(const char* vr) {
  for (const char* one : {"OB", "OW", "OF", "OD", "SQ", "UN", "UT"})
    if (std::strcmp(one, vr) == 0) return true;
  return false;
}

}  // namespace

std::string Elements::number(std::uint64_t value, int size) const {
  std::string bytes;
  for (int n = 0; n < size; ++n) {
    const int shift = 8 * (encoding_ == Encoding::kBigEndian ? size - 1 - n : n);
    bytes += static_cast<char>(value >> shift & 0xFF);
  }
  return bytes;
}

std::string Elements::head(std::uint32_t tag, const char* vr, std::size_t length) const {
  std::string bytes = number(tag >> 16, 2) + number(tag & 0xFFFF, 2);
  const bool item = tag >> 16 == 0xFFFE;
  if (encoding_ == Encoding::kImplicit || item) return bytes + number(length, 4);
  bytes += vr;
  return long_head(vr) ? bytes + std::string(2, '\0') + number(length, 4) : bytes + number(length, 2);
}

Elements& Elements::bytes(std::uint32_t tag, const char* vr, const std::string& value) {
  elements_[tag] = head(tag, vr, value.size()) + value;
  return *this;
}

Elements& Elements::text(std::uint32_t tag, const char* vr, const std::string& value) {
  std::string padded = value;
  if (padded.size() % 2 != 0) padded += std::strcmp(vr, "UI") == 0 ? '\0' : ' ';
  return bytes(tag, vr, padded);
}

Elements& Elements::numbers(std::uint32_t tag, const std::vector<double>& values) {
  return text(tag, "DS", joined(values));
}

Elements& Elements::word(std::uint32_t tag, unsigned value) { return bytes(tag, "US", number(value, 2)); }

Elements& Elements::sequence(std::uint32_t tag, const std::vector<Elements>& items, bool undefined) {
  std::string all;
  for (const Elements& item : items) {
    const std::string inside = item.encoded();
    all += head(0xFFFEE000, "", undefined ? 0xFFFFFFFFU : inside.size()) + inside;
    if (undefined) all += head(0xFFFEE00D, "", 0);
  }
  if (undefined) all += head(0xFFFEE0DD, "", 0);
  elements_[tag] = head(tag, "SQ", undefined ? 0xFFFFFFFFU : all.size()) + all;
  return *this;
}

Elements& Elements::fragments(const std::vector<std::string>& pieces, const std::vector<std::uint32_t>& table) {
  std::string all = head(0x7FE00010, "OB", 0xFFFFFFFFU) + head(0xFFFEE000, "", 4 * table.size());
  for (const std::uint32_t offset : table) all += number(offset, 4);
  for (const std::string& piece : pieces) all += head(0xFFFEE000, "", piece.size()) + piece;
  elements_[0x7FE00010] = all + head(0xFFFEE0DD, "", 0);
  return *this;
}

Elements& Elements::raw(std::uint32_t tag, const std::string& whole) {
  elements_[tag] = whole;
  return *this;
}

Elements& Elements::erase(std::uint32_t tag) {
  elements_.erase(tag);
  return *this;
}

std::string Elements::encoded() const {
  std::string all;
  for (const auto& [tag, bytes] : elements_) all += bytes;
  return all;
}

std::string dicom_file(const Elements& data, const std::string& syntax) {
  Elements meta;
  meta.text(0x00020010, "UI", syntax.empty() ? syntax_of(data.encoding()) : syntax);
  const std::string inside = meta.encoded(), body = data.encoded();
  Elements length;
  length.bytes(0x00020000, "UL", std::string{static_cast<char>(inside.size()), 0, 0, 0});
  return std::string(128, '\0') + "DICM" + length.encoded() + inside +
         (data.encoding() == Encoding::kDeflated ? deflated(body) : body);
}

std::string SliceFixture::pixels() const {
  std::string bytes;
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const auto stored_value = static_cast<std::uint32_t>(value(i, j));
      for (int n = 0; n < allocated / 8; ++n) {
        const int place = encoding == Encoding::kBigEndian ? allocated / 8 - 1 - n : n;
        bytes += static_cast<char>(stored_value >> 8 * place & 0xFF);
      }
    }
  if (bytes.size() % 2 != 0) bytes += '\0';
  if (encoding == Encoding::kBigEndian && allocated == 8)  // OW: pairs lie crosswise
    for (std::size_t n = 0; n + 1 < bytes.size(); n += 2) std::swap(bytes[n], bytes[n + 1]);
  return bytes;
}

Elements SliceFixture::elements() const {
  Elements data(encoding);
  data.text(0x00080008, "CS", "ORIGINAL\\PRIMARY\\AXIAL").text(0x00080016, "UI", sop_class);
  data.text(0x00080018, "UI", series + "." + std::to_string(std::lround(1000 * position.z())))
      .text(0x00080060, "CS", modality);
  data.text(0x0020000D, "UI", study).text(0x0020000E, "UI", series).text(0x00200011, "IS", series_number);
  data.numbers(0x00200032, {position.x(), position.y(), position.z()});
  data.numbers(0x00200037,
               {along_row.x(), along_row.y(), along_row.z(), along_column.x(), along_column.y(), along_column.z()});
  data.text(0x00200052, "UI", "1.2.9").word(0x00280002, 1).text(0x00280004, "CS", photometric);
  data.word(0x00280010, static_cast<unsigned>(rows)).word(0x00280011, static_cast<unsigned>(columns));
  data.numbers(0x00280030, {column_step, row_step});
  data.word(0x00280100, static_cast<unsigned>(allocated)).word(0x00280101, static_cast<unsigned>(stored));
  data.word(0x00280102, static_cast<unsigned>(stored - 1)).word(0x00280103, is_signed ? 1 : 0);
  if (rescale) data.numbers(0x00281052, {intercept}).numbers(0x00281053, {slope});
  data.bytes(0x7FE00010, "OW", pixels());
  change(data);
  return data;
}

std::vector<SliceFixture> stack_of(int count, double step, const SliceFixture& like) {
  std::vector<SliceFixture> slices;
  const Eigen::Vector3d normal = like.along_row.cross(like.along_column);
  for (int k = 0; k < count; ++k) {
    SliceFixture& slice = slices.emplace_back(like);
    slice.position = like.position + step * k * normal;
    slice.value = [k](int i, int j) { return 1000 * k + 10 * j + i; };
  }
  return slices;
}

Elements enhanced(const std::vector<SliceFixture>& slices) {
  const SliceFixture& first = slices.front();
  Elements data = first.elements();
  for (const std::uint32_t tag : {0x00200032U, 0x00200037U, 0x00280030U, 0x00281052U, 0x00281053U}) data.erase(tag);
  const Encoding as = first.encoding;
  Elements shared(as);
  const Eigen::Vector3d &u = first.along_row, &v = first.along_column;
  shared.sequence(0x00209116, {Elements(as).numbers(0x00200037, {u.x(), u.y(), u.z(), v.x(), v.y(), v.z()})});
  shared.sequence(0x00289110, {Elements(as).numbers(0x00280030, {first.column_step, first.row_step})}, true);
  std::vector<Elements> frames;
  std::string pixels;
  for (const SliceFixture& slice : slices) {
    Elements frame(as);
    frame.sequence(0x00209113,
                   {Elements(as).numbers(0x00200032, {slice.position.x(), slice.position.y(), slice.position.z()})});
    frame.sequence(0x00289145,
                   {Elements(as).numbers(0x00281052, {slice.intercept}).numbers(0x00281053, {slice.slope})});
    frames.push_back(frame);
    pixels += slice.pixels();
  }
  data.text(0x00080016, "UI", kEnhancedCtClass).text(0x00280008, "IS", std::to_string(slices.size()));
  data.sequence(0x52009229, {shared}).sequence(0x52009230, frames, true).bytes(0x7FE00010, "OW", pixels);
  return data;
}

std::string rle_frame(const std::string& little_endian_pixels, int bytes_per_pixel) {
  std::string header(64, '\0'), body;
  header[0] = static_cast<char>(bytes_per_pixel);
  for (int plane = 0; plane < bytes_per_pixel; ++plane) {
    const auto offset = static_cast<std::uint32_t>(64 + body.size());
    std::memcpy(header.data() + 4 + 4 * plane, &offset, 4);
    std::string bytes;
    for (std::size_t n = static_cast<std::size_t>(bytes_per_pixel - 1 - plane); n < little_endian_pixels.size();
         n += static_cast<std::size_t>(bytes_per_pixel))
      bytes += little_endian_pixels[n];
    for (std::size_t at = 0; at < bytes.size(); at += 128) {
      const std::string run = bytes.substr(at, 128);
      body += static_cast<char>(run.size() - 1);
      body += run;
    }
    if (body.size() % 2 != 0) body += static_cast<char>(-128);
  }
  return header + body;
}

}  // namespace trocar::test
