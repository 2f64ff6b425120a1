// Headers taken apart: the text of a NRRD line by line, the bytes of NIfTI at the places that the format documents
// name.
#include <bit>

#include "tests/tissue/imaging/volumes/volume_files.h"
#include "tissue/imaging/volumes/nifti_fields.h"
#include "tissue/imaging/volumes/nrrd_fields.h"
#include "tissue/imaging/volumes/nrrd_header.h"

namespace trocar::header_fields_test {
namespace {

TEST(NrrdFields, NamesValuesKeysAndLines) {
  test::TemporaryFolder folder;
  const std::string text =
      "NRRD0005\r\n# comment: not a field\r\nSpace Origin: (1,2,3)\r\nkinds: domain  list\r\nKey One:=a: b := "
      "c\r\nempty:\r\n\r\nDATA";
  const NrrdFields header = read_nrrd_fields(folder.write("a.nrrd", text));
  EXPECT_EQ(header.fields.size(), 3U);
  EXPECT_EQ(header.wanted("spaceorigin").text, "(1,2,3)");
  EXPECT_EQ(header.wanted("spaceorigin").line, 3);
  EXPECT_EQ(header.wanted("empty").text, "");
  ASSERT_EQ(header.keys.size(), 1U);
  EXPECT_EQ(header.keys.at("Key One").text, "a: b := c");
  EXPECT_TRUE(header.ended);
  EXPECT_EQ(header.data_offset, text.size() - 4);
  EXPECT_CONTAINS(test::message_of<InputError>([&] { header.wanted("sizes"); }), "a.nrrd: sizes: missing");
  EXPECT_CONTAINS(test::message_of<InputError>([&] { header.refuse("kinds", "odd"); }), "a.nrrd:4:1: kinds: odd");
}

TEST(NrrdFields, HeaderWithoutAnEndIsKnownAsOne) {
  test::TemporaryFolder folder;
  const NrrdFields header = read_nrrd_fields(folder.write("a.nhdr", "NRRD0001\ntype: float"));
  EXPECT_FALSE(header.ended);
  EXPECT_EQ(header.wanted("type").text, "float");
  const std::string endless = "NRRD0001\n" + std::string(5 << 20, '#');
  EXPECT_CONTAINS(test::message_of<InputError>([&] { read_nrrd_fields(folder.write("b.nrrd", endless)); }),
                  "longer than 4 MiB");
}

TEST(NrrdFields, LongHeadersOfManySegmentsAreRead) {
  test::TemporaryFolder folder;
  std::string text = "NRRD0004\ntype: short\n";
  for (int n = 0; n < 4000; ++n) text += "Segment" + std::to_string(n) + "_Tags:=" + std::string(40, 'x') + "\n";
  const NrrdFields header = read_nrrd_fields(folder.write("a.seg.nrrd", text + "\nDATA"));
  EXPECT_EQ(header.keys.size(), 4000U);
  EXPECT_EQ(header.data_offset, text.size() + 1);
}

NrrdFields with(const std::string& field, const std::string& value) {
  NrrdFields header;
  header.file = "f.nrrd";
  header.fields[field] = {value, 7};
  return header;
}

TEST(NrrdFields, NumbersVectorsAndWords) {
  const auto numbers = nrrd_numbers(with("spacings", "NaN 1.5\t-2e1 none +3"), "spacings");
  ASSERT_EQ(numbers.size(), 5U);
  EXPECT_FALSE(numbers[0] || numbers[3]);
  EXPECT_EQ(*numbers[1], 1.5);
  EXPECT_EQ(*numbers[2], -20);
  EXPECT_EQ(*numbers[4], 3);
  const auto vectors = nrrd_vectors(with("spacedirections", "none (1, 2,3)(-4,5e0,+6)  none"), "spacedirections");
  ASSERT_EQ(vectors.size(), 4U);
  EXPECT_EQ(*vectors[1], Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(*vectors[2], Eigen::Vector3d(-4, 5, 6));
  EXPECT_EQ(nrrd_words(with("units", "\"mm\" \"a b\" c"), "units"), (std::vector<std::string>{"mm", "a b", "c"}));
  EXPECT_EQ(whole_number(with("dimension", "3"), "dimension", 1, 16), 3);
}

TEST(NrrdFields, WhatIsNoneOfTheseIsRefusedWithItsLine) {
  const auto vectors = [](const std::string& value) {
    return test::message_of<InputError>([&] { nrrd_vectors(with("spaceorigin", value), "spaceorigin"); });
  };
  for (const char* value : {"(1,2)", "(1,2,3,4)", "(1,2,x)", "(1,2,)", "1,2,3", "(1,2,3", "nonsense"})
    EXPECT_CONTAINS(vectors(value), "f.nrrd:7:1: spaceorigin");
  std::string many;
  for (int n = 0; n < 20; ++n) many += "none ";
  EXPECT_CONTAINS(vectors(many), "more than 16");
  for (const char* value : {"3.5", "three", "", "17", "0", "99999999999999999999", "3 4"})
    EXPECT_THROW(whole_number(with("dimension", value), "dimension", 1, 16), InputError) << value;
  EXPECT_THROW(nrrd_numbers(with("sizes", "4 five"), "sizes"), InputError);
}

TEST(DetachedFile, StaysInItsFolder) {
  test::TemporaryFolder folder;
  std::filesystem::create_directories(folder / "sub");
  const auto header = folder.write("a.nhdr", "NRRD0004\n");
  folder.write("v.raw", "v"), folder.write("sub/w.raw", "w");
  EXPECT_EQ(detached_file(header, "v.raw", "data file"), folder / "v.raw");
  EXPECT_EQ(detached_file(header, "./v.raw", "data file"), folder / "v.raw");
  EXPECT_EQ(detached_file(header, "sub/../v.raw", "data file"), folder / "v.raw");
  EXPECT_EQ(detached_file(header, "sub/w.raw", "data file"), folder / "sub/w.raw");
  for (const char* name : {"/etc/hostname", "..", "../a", "sub/../../x", "..\\x", "sub\\w.raw", "", ".", "sub",
                           "none.raw", "LIST 2", "a%d"})
    EXPECT_THROW(detached_file(header, name, "data file"), InputError) << name;
  EXPECT_THROW(detached_file(header, std::string("v.raw\0x", 7), "data file"), InputError);
  EXPECT_THROW(detached_file(header, std::string(5000, 'x'), "data file"), InputError);
}

/// Writes a number at its place, in either byte order.
template <typename T>
void put(std::string& bytes, std::size_t offset, T value, bool swapped) {
  auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
  if (swapped) std::reverse(raw.begin(), raw.end());
  std::copy(raw.begin(), raw.end(), bytes.begin() + static_cast<std::ptrdiff_t>(offset));
}

NiftiFields decoded(const std::string& bytes) {
  return decode_nifti({reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()}, "f.nii");
}

TEST(NiftiFields, VersionOneAtItsPlaces) {
  for (const bool swapped : {false, true}) {
    std::string bytes(348, '\0');
    put<std::int32_t>(bytes, 0, 348, swapped);
    for (std::size_t n = 0; n < 8; ++n) {
      put(bytes, 40 + 2 * n, static_cast<std::int16_t>(3 + n), swapped);
      put(bytes, 76 + 4 * n, 0.5F * static_cast<float>(n), swapped);
    }
    put<std::int16_t>(bytes, 68, 1002, swapped);
    put<std::int16_t>(bytes, 70, 512, swapped), put<std::int16_t>(bytes, 72, 16, swapped);
    put(bytes, 108, 416.0F, swapped), put(bytes, 112, 2.0F, swapped), put(bytes, 116, -7.0F, swapped);
    bytes[123] = 10;
    put<std::int16_t>(bytes, 252, 1, swapped), put<std::int16_t>(bytes, 254, 4, swapped);
    for (std::size_t n = 0; n < 6; ++n) put(bytes, 256 + 4 * n, static_cast<float>(n + 1), swapped);
    for (std::size_t n = 0; n < 12; ++n) put(bytes, 280 + 4 * n, static_cast<float>(10 * n), swapped);
    std::memcpy(bytes.data() + 344, "ni1", 4);
    const NiftiFields fields = decoded(bytes);
    EXPECT_EQ(fields.version, 1);
    EXPECT_EQ(fields.swapped, swapped);
    EXPECT_TRUE(fields.pair);
    for (std::size_t n = 0; n < 8; ++n) EXPECT_EQ(fields.dim[n], static_cast<std::int64_t>(3 + n));
    EXPECT_EQ(fields.pixdim[3], 1.5);
    EXPECT_EQ(fields.intent, 1002);
    EXPECT_EQ(fields.datatype, 512);
    EXPECT_EQ(fields.bitpix, 16);
    EXPECT_EQ(fields.vox_offset, 416);
    EXPECT_EQ(fields.slope, 2);
    EXPECT_EQ(fields.intercept, -7);
    EXPECT_EQ(fields.units, 10);
    EXPECT_EQ(fields.qform, 1);
    EXPECT_EQ(fields.sform, 4);
    EXPECT_EQ(fields.quatern, (std::array<double, 3>{1, 2, 3}));
    EXPECT_EQ(fields.qoffset, (std::array<double, 3>{4, 5, 6}));
    EXPECT_EQ(fields.srow(1, 0), 40);
    EXPECT_EQ(fields.srow(2, 3), 110);
  }
}

TEST(NiftiFields, VersionTwoAtItsPlaces) {
  for (const bool swapped : {false, true}) {
    std::string bytes(540, '\0');
    put<std::int32_t>(bytes, 0, 540, swapped);
    std::memcpy(bytes.data() + 4, "n+2\0\r\n\x1a\n", 8);
    put<std::int16_t>(bytes, 12, 16, swapped), put<std::int16_t>(bytes, 14, 32, swapped);
    for (std::size_t n = 0; n < 8; ++n) {
      put(bytes, 16 + 8 * n, static_cast<std::int64_t>(1) << (4 * n), swapped);
      put(bytes, 104 + 8 * n, 0.25 * static_cast<double>(n), swapped);
    }
    put<std::int64_t>(bytes, 168, 544, swapped);
    put(bytes, 176, 3.0, swapped), put(bytes, 184, -1.5, swapped);
    put<std::int32_t>(bytes, 344, 2, swapped), put<std::int32_t>(bytes, 348, 3, swapped);
    for (std::size_t n = 0; n < 6; ++n) put(bytes, 352 + 8 * n, 0.1 * static_cast<double>(n), swapped);
    for (std::size_t n = 0; n < 12; ++n) put(bytes, 400 + 8 * n, 7.0 * static_cast<double>(n), swapped);
    put<std::int32_t>(bytes, 500, 2, swapped), put<std::int32_t>(bytes, 504, 1002, swapped);
    const NiftiFields fields = decoded(bytes);
    EXPECT_EQ(fields.version, 2);
    EXPECT_EQ(fields.swapped, swapped);
    EXPECT_FALSE(fields.pair);
    EXPECT_EQ(fields.dim[7], std::int64_t{1} << 28);
    EXPECT_EQ(fields.pixdim[5], 1.25);
    EXPECT_EQ(fields.datatype, 16);
    EXPECT_EQ(fields.vox_offset, 544);
    EXPECT_EQ(fields.slope, 3);
    EXPECT_EQ(fields.intercept, -1.5);
    EXPECT_EQ(fields.qform, 2);
    EXPECT_EQ(fields.sform, 3);
    EXPECT_EQ(fields.quatern[2], 0.1 * 2);
    EXPECT_EQ(fields.qoffset[0], 0.1 * 3);
    EXPECT_EQ(fields.srow(0, 3), 21);
    EXPECT_EQ(fields.units, 2);
    EXPECT_EQ(fields.intent, 1002);
  }
}

TEST(NiftiFields, ShortOrForeignBytesAreRefused) {
  EXPECT_EQ(nifti_header_bytes({}), 0U);
  std::string bytes(348, '\0');
  EXPECT_CONTAINS(test::message_of<InputError>([&] { decoded(bytes); }), "sizeof_hdr");
  put<std::int32_t>(bytes, 0, 540, false);
  EXPECT_CONTAINS(test::message_of<InputError>([&] { decoded(bytes); }), "only 348 header bytes");
  put<std::int32_t>(bytes, 0, 348, true);
  EXPECT_CONTAINS(test::message_of<InputError>([&] { decoded(bytes); }), "Analyze 7.5");
  bytes[344] = 'x';
  EXPECT_CONTAINS(test::message_of<InputError>([&] { decoded(bytes); }), "magic");
}

}  // namespace
}  // namespace trocar::header_fields_test
