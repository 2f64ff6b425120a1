// Bytes, voxels and their places, below the formats: every type, order and encoding against values made by the test
// itself.
#include "tissue/imaging/volumes/voxel_stream.h"

#include <limits>
#include <random>

#include "tests/tissue/imaging/volumes/volume_files.h"
#include "tissue/imaging/volumes/byte_stream.h"
#include "tissue/imaging/volumes/gzip_stream.h"

namespace trocar::voxel_stream_test {
namespace {

std::vector<double> all_values(const VoxelBlock& block, std::uint64_t count, bool* more = nullptr) {
  std::vector<double> values;
  const bool rest = stream_voxels(block, count, {}, [&](std::span<const double> piece) {
    EXPECT_LE(piece.size(), 16384U);
    values.insert(values.end(), piece.begin(), piece.end());
  });
  if (more != nullptr) *more = rest;
  return values;
}

std::string all_bytes(ByteStream& stream, std::size_t piece) {
  std::string all, block(piece, '\0');
  while (const std::size_t got = stream.read(reinterpret_cast<unsigned char*>(block.data()), piece))
    all.append(block, 0, got);
  return all;
}

std::string some_bytes(std::size_t count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::string bytes(count, '\0');
  for (char& byte : bytes) byte = static_cast<char>(random() % 7);
  return bytes;
}

TEST(ByteStream, PlainAndPackedGiveTheSameBytesInPiecesOfAnySize) {
  test::TemporaryFolder folder;
  const std::string bytes = some_bytes(200000, 1);
  const auto plain = folder.write("plain", "head" + bytes);
  const auto gzip = folder.write("gzip", "head" + gzip_compressed(bytes));
  const auto zlib = folder.write("zlib", "head" + test::zlib_packed(bytes));
  for (const std::size_t piece : {std::size_t{1000}, std::size_t{65536}, std::size_t{300000}}) {
    EXPECT_EQ(all_bytes(*open_plain(plain, 4), piece), bytes);
    EXPECT_EQ(all_bytes(*open_deflated(gzip, 4), piece), bytes);
    EXPECT_EQ(all_bytes(*open_deflated(zlib, 4), piece), bytes);
  }
}

TEST(ByteStream, MembersOfOneGzipFileFollowEachOther) {
  test::TemporaryFolder folder;
  const std::string first = some_bytes(70000, 2), second = some_bytes(90000, 3);
  const auto path = folder.write("two", gzip_compressed(first) + gzip_compressed(second));
  EXPECT_EQ(all_bytes(*open_deflated(path, 0), 4096), first + second);
  const auto tail = folder.write("tail", gzip_compressed(first) + "something else");
  EXPECT_EQ(all_bytes(*open_deflated(tail, 0), 4096), first);
}

TEST(ByteStream, DamageIsNoticed) {
  test::TemporaryFolder folder;
  const std::string packed = gzip_compressed(some_bytes(50000, 4));
  const auto refused = [&](const std::string& bytes) {
    const auto path = folder.write("bad.gz", bytes);
    return test::message_of<InputError>([&] { all_bytes(*open_deflated(path, 0), 4096); });
  };
  EXPECT_CONTAINS(refused(""), "ends early");
  EXPECT_CONTAINS(refused("no gzip at all"), "damaged gzip");
  EXPECT_CONTAINS(refused(packed.substr(0, packed.size() - 1)), "ends early");
  for (const std::size_t place :
       {std::size_t{0}, std::size_t{2}, packed.size() / 2, packed.size() - 8, packed.size() - 2}) {
    std::string damaged = packed;
    damaged[place] = static_cast<char>(damaged[place] ^ 0x40);
    EXPECT_CONTAINS(refused(damaged), "bad.gz");
  }
  EXPECT_CONTAINS(test::message_of<InputError>([&] { open_plain(folder / "gone", 0); }), "no such file");
  EXPECT_CONTAINS(test::message_of<InputError>([&] { open_plain(folder.path(), 0); }), "no such file");
}

/// Extremes of the type and a few between.
template <typename Stored>
std::vector<double> extremes() {
  using Limits = std::numeric_limits<Stored>;
  std::vector<double> values{0, 1, 2, 100, static_cast<double>(Limits::max() / 2)};
  if constexpr (std::is_integral_v<Stored>) {
    values.push_back(static_cast<double>(Limits::min()));
    if constexpr (sizeof(Stored) < 8) values.push_back(static_cast<double>(Limits::max()));
  } else {
    values.insert(values.end(), {-0.25, 1e30, -1e-30});
    for (double& value : values) value = static_cast<Stored>(value);
  }
  return values;
}

template <typename Stored>
void check_type(VoxelType type) {
  test::TemporaryFolder folder;
  EXPECT_EQ(bytes_of(type), sizeof(Stored));
  const std::vector<double> values = extremes<Stored>();
  for (const bool swapped : {false, true}) {
    const std::string bytes = test::packed<Stored>(values, swapped);
    VoxelBlock block;
    block.type = type, block.swapped = swapped;
    block.file = folder.write("raw", "12345" + bytes), block.offset = 5;
    EXPECT_EQ(all_values(block, values.size()), values);
    block.file = folder.write("packed", "12345" + gzip_compressed("abc" + bytes));
    block.encoding = VoxelEncoding::kDeflated, block.skipped = 3;
    EXPECT_EQ(all_values(block, values.size()), values);
    block.file = folder.write("last", "a head of unknown length" + bytes);
    block.encoding = VoxelEncoding::kRaw, block.skipped = 0, block.offset = 0, block.last_in_file = true;
    EXPECT_EQ(all_values(block, values.size()), values);
  }
}

TEST(VoxelStream, EveryTypeInBothByteOrders) {
  check_type<std::int8_t>(VoxelType::kInt8);
  check_type<std::uint8_t>(VoxelType::kUint8);
  check_type<std::int16_t>(VoxelType::kInt16);
  check_type<std::uint16_t>(VoxelType::kUint16);
  check_type<std::int32_t>(VoxelType::kInt32);
  check_type<std::uint32_t>(VoxelType::kUint32);
  check_type<std::int64_t>(VoxelType::kInt64);
  check_type<std::uint64_t>(VoxelType::kUint64);
  check_type<float>(VoxelType::kFloat32);
  check_type<double>(VoxelType::kFloat64);
}

TEST(VoxelStream, SlopeAndInterceptAreApplied) {
  test::TemporaryFolder folder;
  VoxelBlock block;
  block.file = folder.write("raw", std::string("\x01\x02\x03", 3));
  block.slope = -2, block.intercept = 10;
  EXPECT_EQ(all_values(block, 3), (std::vector<double>{8, 6, 4}));
  block.file = folder.write("text", "1 2,\n3");
  block.encoding = VoxelEncoding::kText;
  EXPECT_EQ(all_values(block, 3), (std::vector<double>{8, 6, 4}));
}

TEST(VoxelStream, LongFilesComeInPiecesAndReportTheirShare) {
  test::TemporaryFolder folder;
  std::vector<double> values;
  for (int n = 0; n < 50000; ++n) values.push_back(n % 30000);
  VoxelBlock block;
  block.type = VoxelType::kInt16;
  block.file = folder.write("raw", test::packed<std::int16_t>(values));
  double last = 0;
  std::size_t seen = 0;
  stream_voxels(
      block, values.size(), [&](std::string_view, double share) { last = share; },
      [&](std::span<const double> piece) {
        for (const double value : piece) EXPECT_EQ(value, values[seen++]);
      });
  EXPECT_EQ(seen, values.size());
  EXPECT_EQ(last, 1);
}

TEST(VoxelStream, ToldWhenTheFileHoldsMore) {
  test::TemporaryFolder folder;
  bool more = false;
  VoxelBlock block;
  block.file = folder.write("raw", "abcd");
  all_values(block, 4, &more);
  EXPECT_FALSE(more);
  all_values(block, 3, &more);
  EXPECT_TRUE(more);
  block.encoding = VoxelEncoding::kDeflated;
  block.file = folder.write("packed", gzip_compressed("abcd"));
  all_values(block, 4, &more);
  EXPECT_FALSE(more);
  all_values(block, 3, &more);
  EXPECT_TRUE(more);
  block.encoding = VoxelEncoding::kText;
  block.file = folder.write("text", "1 2 3 4\n");
  all_values(block, 4, &more);
  EXPECT_FALSE(more);
  all_values(block, 3, &more);
  EXPECT_TRUE(more);
}

TEST(VoxelStream, LengthIsJudgedBeforeAnythingIsRead) {
  test::TemporaryFolder folder;
  const auto refused = [&](const VoxelBlock& block, std::uint64_t count) {
    return test::message_of<InputError>([&] { check_length(block, count); });
  };
  VoxelBlock block;
  block.type = VoxelType::kFloat64;
  block.file = folder.write("voxels", std::string(100, ' '));
  block.offset = 20;
  EXPECT_NO_THROW(check_length(block, 10));
  EXPECT_CONTAINS(refused(block, 11), "the file ends after 100 of 108 bytes");
  block.last_in_file = true;  // the header before the voxels is still there
  EXPECT_NO_THROW(check_length(block, 10));
  EXPECT_CONTAINS(refused(block, 11), "the file ends after 100 of 108 bytes");
  block.last_in_file = false, block.encoding = VoxelEncoding::kDeflated;
  EXPECT_NO_THROW(check_length(block, 80 * kLargestInflation / 8));
  EXPECT_CONTAINS(refused(block, std::uint64_t{1} << 29), "too short");
  block.encoding = VoxelEncoding::kText;
  EXPECT_NO_THROW(check_length(block, 40));
  EXPECT_CONTAINS(refused(block, 41), "80 bytes of text cannot hold 41 values");
  block.offset = 5000;
  EXPECT_CONTAINS(refused(block, 41), "too short");
  block.file = folder / "gone";
  EXPECT_CONTAINS(refused(block, 1), "gone: no such file");
}

TEST(VoxelStream, TextIsReadToTheLetter) {
  test::TemporaryFolder folder;
  const auto text = [&](const std::string& words, std::uint64_t count) {
    VoxelBlock block;
    block.encoding = VoxelEncoding::kText;
    block.file = folder.write("text", words);
    return all_values(block, count);
  };
  EXPECT_EQ(text("1\t-2.5\r\n3e2 , .5", 4), (std::vector<double>{1, -2.5, 300, 0.5}));
  EXPECT_THROW(text("1 2 0x3 4", 4), InputError);
  EXPECT_THROW(text("1 2 3..4 5", 4), InputError);
  EXPECT_THROW(text("1 2 " + std::string(300, '9'), 3), InputError);
  EXPECT_THROW(text("1 2                  ", 3), InputError);
}

}  // namespace
}  // namespace trocar::voxel_stream_test
