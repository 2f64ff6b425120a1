// Bytes packed, streamed, written as NIfTI and passed on by a child: round trips of random data, damage by its name.
#include <gtest/gtest.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <random>
#include <string>
#include <vector>

#include "haptics/input_error.h"
#include "tests/tissue/support/label_files.h"
#include "tests/tissue/support/temporary_folder.h"
#include "tissue/imaging/child_process.h"
#include "tissue/imaging/labels/label_volume.h"
#include "tissue/imaging/phantom/scanner.h"
#include "tissue/imaging/volumes/byte_stream.h"
#include "tissue/imaging/volumes/gzip_stream.h"
#include "tissue/imaging/volumes/nifti_writer.h"
#include "tissue/imaging/volumes/volume_reader.h"

namespace trocar::streams_more_test {
namespace {

std::string random_bytes(std::size_t count, std::uint64_t seed, std::uint64_t kinds = 256) {
  std::mt19937_64 engine(seed);
  std::string bytes(count, '\0');
  for (char& byte : bytes) byte = static_cast<char>(engine() % kinds);
  return bytes;
}

template <typename Stream>
std::string drained(Stream& stream, std::size_t piece) {
  std::string bytes;
  std::vector<unsigned char> block(piece);
  for (std::size_t got = piece; got == piece;) {
    got = stream.read(block.data(), piece);
    bytes.append(reinterpret_cast<const char*>(block.data()), got);
  }
  return bytes;
}

/// What zlib itself makes of a gzip file's bytes.
std::string inflated(const std::string& packed, std::size_t most) {
  z_stream stream{};
  EXPECT_EQ(inflateInit2(&stream, MAX_WBITS + 16), Z_OK);
  std::string bytes(most, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  stream.avail_in = static_cast<uInt>(packed.size());
  stream.next_out = reinterpret_cast<Bytef*>(bytes.data());
  stream.avail_out = static_cast<uInt>(bytes.size());
  EXPECT_EQ(inflate(&stream, Z_FINISH), Z_STREAM_END);
  bytes.resize(stream.total_out);
  inflateEnd(&stream);
  return bytes;
}

TEST(GzipCompressed, IsOneMemberWithoutNameOrTimeThatZlibUnpacks) {
  for (const std::size_t count : {0, 1, 2, 100, 65536, 150001}) {
    const std::string bytes = random_bytes(count, count + 1), packed = gzip_compressed(bytes);
    EXPECT_EQ(inflated(packed, count + 100), bytes);
    EXPECT_EQ(packed.substr(0, 3), "\x1f\x8b\x08");
    EXPECT_EQ(packed[3], '\0');  // no flags: neither a name nor a comment
    EXPECT_EQ(packed.substr(4, 4), std::string(4, '\0'));
    std::uint32_t length = 0;
    std::memcpy(&length, packed.data() + packed.size() - 4, 4);
    EXPECT_EQ(length, count);
    EXPECT_EQ(gzip_compressed(bytes), packed);
  }
}

TEST(GzipCompressed, NeverShrinksMoreThanTheStatedFactor) {
  for (const std::size_t count : {std::size_t{100000}, std::size_t{3000000}}) {
    const std::string packed = gzip_compressed(std::string(count, '\0'));
    EXPECT_LT(packed.size(), count / 500);
    EXPECT_GE(packed.size() * kLargestInflation, count);
  }
}

TEST(GzipStream, GivesTheBytesOfAPlainAndOfAPackedFileInPiecesOfAnySize) {
  test::TemporaryFolder folder;
  const std::string bytes = random_bytes(70001, 3, 9);
  const auto plain = folder.write("plain", bytes), packed = folder.write("packed", gzip_compressed(bytes));
  for (const std::size_t piece : {7, 4096, 70000, 70001, 70002, 200000}) {
    GzipStream from_plain(plain), from_packed(packed);
    EXPECT_FALSE(from_plain.gzip());
    EXPECT_TRUE(from_packed.gzip());
    EXPECT_EQ(drained(from_plain, piece), bytes);
    EXPECT_EQ(drained(from_packed, piece), bytes);
    EXPECT_NO_THROW(from_packed.finish_member());
    EXPECT_NO_THROW(from_plain.finish_member());
  }
}

TEST(GzipStream, JudgesByTheFirstBytesAndNotByTheName) {
  test::TemporaryFolder folder;
  EXPECT_FALSE(GzipStream(folder.write("a.gz", "plain text")).gzip());
  EXPECT_FALSE(GzipStream(folder.write("b.gz", "\x1f")).gzip());
  EXPECT_FALSE(GzipStream(folder.write("c.gz", "")).gzip());
  EXPECT_TRUE(GzipStream(folder.write("d.nii", gzip_compressed("x"))).gzip());
}

TEST(GzipStream, AWrongChecksumIsFoundWhenTheMemberIsFinished) {
  test::TemporaryFolder folder;
  const std::string bytes = random_bytes(5000, 4);
  for (const std::size_t from_end : {1, 4, 5, 8}) {
    std::string packed = gzip_compressed(bytes);
    packed[packed.size() - from_end] = static_cast<char>(packed[packed.size() - from_end] ^ 0x11);
    const auto path = folder.write("sum.gz", packed);
    EXPECT_CONTAINS(test::message_of<InputError>([&] {
                      GzipStream stream(path);
                      std::vector<unsigned char> block(bytes.size());
                      stream.read(block.data(), block.size());
                      stream.finish_member();
                    }),
                    "sum.gz: data: damaged gzip stream");
  }
}

TEST(GzipStream, WhatCannotBeReadIsNamed) {
  test::TemporaryFolder folder;
  EXPECT_CONTAINS(test::message_of<InputError>([&] { GzipStream stream(folder / "none"); }), "none: no such file");
  EXPECT_CONTAINS(test::message_of<InputError>([&] { GzipStream stream(folder.path()); }), "no such file");
  for (const bool deflated : {false, true})
    EXPECT_CONTAINS(test::message_of<InputError>(
                        [&] { deflated ? open_deflated(folder / "none", 0) : open_plain(folder / "none", 0); }),
                    "none: no such file");
}

TEST(ByteStreamOffsets, AnyOffsetGivesTheRestOfTheFile) {
  test::TemporaryFolder folder;
  const std::string bytes = random_bytes(3000, 5), packed = gzip_compressed(bytes);
  const auto plain = folder.write("plain", bytes);
  for (const std::size_t offset : {0, 1, 1499, 2999, 3000, 9000}) {
    const auto stream = open_plain(plain, offset);
    EXPECT_EQ(drained(*stream, 64), bytes.substr(std::min<std::size_t>(offset, bytes.size())));
    unsigned char more = 0;
    EXPECT_EQ(stream->read(&more, 1), 0U);
    const auto behind = folder.write("behind", random_bytes(offset, 6) + packed);
    EXPECT_EQ(drained(*open_deflated(behind, offset), 777), bytes);
  }
}

TEST(ByteStreamDamage, EveryCutOfAShortStreamIsNoticed) {
  test::TemporaryFolder folder;
  const std::string packed = gzip_compressed(random_bytes(60, 7));
  for (std::size_t length = 0; length < packed.size(); ++length) {
    const auto path = folder.write("cut.gz", packed.substr(0, length));
    EXPECT_CONTAINS(test::message_of<InputError>([&] { drained(*open_deflated(path, 0), 4096); }), "cut.gz: data:");
  }
}

/// A turned, sheared frame whose numbers float32 holds.
Eigen::Affine3d slanted_frame() {
  Eigen::Affine3d frame = Eigen::Affine3d::Identity();
  frame.linear() << 1.5, 0.25, 0, -0.25, 1.5, 0, 0, 0, 2.5;
  frame.translation() = Eigen::Vector3d(-120.5, 33.25, 900);
  return frame;
}

TEST(NiftiWriterRoundTrip, ImagesKeepEveryValueOfSixteenBits) {
  test::TemporaryFolder folder;
  const std::array<int, 3> size{17, 13, 11};
  std::mt19937_64 engine(8);
  std::vector<std::int16_t> values;
  for (int n = 0; n < 17 * 13 * 11; ++n) values.push_back(static_cast<std::int16_t>(engine()));
  values[0] = -32768, values[1] = 32767;
  const ImageVolume image = read_image_volume(folder.write("i.nii.gz", nifti_gz_bytes(size, slanted_frame(), values)));
  EXPECT_EQ(image.size, size);
  EXPECT_LT((image.index_to_ras_mm.matrix() - slanted_frame().matrix()).cwiseAbs().maxCoeff(), 1e-6);
  for (std::size_t n = 0; n < values.size(); ++n) EXPECT_EQ(image.values[n], values[n]);
}

TEST(NiftiWriterRoundTrip, LabelsKeepTheirNumbersUpToTheLast) {
  test::TemporaryFolder folder;
  Eigen::Affine3d frame = Eigen::Affine3d::Identity();
  frame.linear() = Eigen::Vector3d(0.75, 1.25, 3).asDiagonal();
  std::vector<std::uint16_t> labels(9 * 8 * 7, 0);
  std::mt19937_64 engine(9);
  for (std::uint16_t& voxel : labels) voxel = static_cast<std::uint16_t>(engine() % 40 * 1600);
  labels[5] = 65535;
  const LabelVolume back = test::read_label_volume(folder.write("l.nii.gz", nifti_gz_bytes({9, 8, 7}, frame, labels)));
  EXPECT_EQ(back.labels, labels);
  EXPECT_NEAR(back.voxel_volume_ml(), 0.75 * 1.25 * 3e-3, 1e-9);
}

TEST(NiftiWriterBytes, AreTheSameForTheSameVolumeAndSayWhatTheyHold) {
  const std::vector<std::int16_t> values(24, -1000);
  const std::string packed = nifti_gz_bytes({4, 3, 2}, slanted_frame(), values);
  EXPECT_EQ(nifti_gz_bytes({4, 3, 2}, slanted_frame(), values), packed);
  const std::string bytes = inflated(packed, 1000);
  ASSERT_EQ(bytes.size(), 352U + 48);
  EXPECT_EQ(bytes.substr(344, 4), std::string("n+1\0", 4));
  const auto at = [&](std::size_t offset, auto kind) {
    std::memcpy(&kind, bytes.data() + offset, sizeof kind);
    return kind;
  };
  EXPECT_EQ(at(0, std::int32_t{}), 348);
  EXPECT_EQ(at(70, std::int16_t{}), 4);
  EXPECT_EQ(at(254, std::int16_t{}), 1);
  EXPECT_EQ(at(80, 0.0F), static_cast<float>(std::hypot(1.5, 0.25)));
  EXPECT_EQ(at(292, 0.0F), -120.5F);
  EXPECT_EQ(at(352, std::int16_t{}), -1000);
  EXPECT_NE(inflated(nifti_gz_bytes({3, 4, 2}, slanted_frame(), values), 1000), bytes);
}

TEST(NiftiWriterBytes, TooManyOrTooFewValuesAreRefused) {
  for (const std::size_t count : {0, 23, 25})
    EXPECT_THROW(nifti_gz_bytes({4, 3, 2}, slanted_frame(), std::vector<std::uint16_t>(count)), std::invalid_argument);
}

TEST(ChildProcessResults, RandomBytesComeBackWhateverTheyAre) {
  for (const std::size_t count : {1, 255, 4096, 100003}) {
    const std::string bytes = random_bytes(count, count);
    EXPECT_EQ(in_child("a", {}, {}, [&] { return bytes; }), bytes);
  }
}

TEST(ChildProcessResults, WhatTheWorkChangesStaysInTheChild) {
  int changed = 1;
  const pid_t here = getpid();
  const std::string there = in_child("a", {}, {}, [&] {
    changed = 2;
    return std::to_string(getpid());
  });
  EXPECT_EQ(changed, 1);
  EXPECT_NE(there, std::to_string(here));
  EXPECT_EQ(getpid(), here);
}

TEST(ChildProcessResults, ARefusalDoesNotHinderTheNextWork) {
  for (int n = 0; n < 5; ++n) {
    const std::string reason = "scan.dcm:" + std::to_string(n) + ": odd";
    EXPECT_EQ(test::message_of<InputError>(
                  [&] { in_child("scan.dcm", {}, {}, [&]() -> std::string { throw InputError(reason); }); }),
              reason);
    EXPECT_EQ(in_child("scan.dcm", {}, {}, [n] { return std::to_string(n); }), std::to_string(n));
  }
}

TEST(ChildProcessResults, AChildMayHaveAChildOfItsOwn) {
  const auto inner = [] { return in_child("inner", {}, {}, [] { return std::string("x"); }); };
  EXPECT_EQ(in_child("outer", {}, {}, [&] { return "<" + inner() + ">"; }), "<x>");
}

TEST(ScannerLinearity, WithoutNoiseSumsAndShiftsPassThrough) {
  const std::array<int, 3> size{14, 12, 10};
  std::mt19937_64 engine(10);
  std::uniform_real_distribution<float> even(-500, 500);
  std::vector<float> a(14 * 12 * 10), b(a.size()), sum(a.size());
  for (std::size_t n = 0; n < a.size(); ++n) a[n] = even(engine), b[n] = even(engine), sum[n] = 2 * a[n] + b[n] + 40;
  const auto [low, high] = std::minmax_element(a.begin(), a.end());
  const float lowest = *low, highest = *high;
  for (std::vector<float>* image : {&a, &b, &sum}) phantom::scan(*image, size, {.voxel_mm = 1, .noise_hu = 0});
  for (std::size_t n = 0; n < a.size(); ++n) {
    EXPECT_NEAR(sum[n], 2 * a[n] + b[n] + 40, 2e-3);
    EXPECT_GE(a[n], lowest - 1e-3F);  // a mean never leaves the range
    EXPECT_LE(a[n], highest + 1e-3F);
  }
}

TEST(ScannerNoise, IsAddedAndGrowsInProportion) {
  const std::array<int, 3> size{16, 16, 16};
  std::vector<float> still(4096, 50), one(4096, 50), three(4096, 50);
  phantom::scan(still, size, {.voxel_mm = 1.5, .noise_hu = 0, .seed = 5});
  phantom::scan(one, size, {.voxel_mm = 1.5, .noise_hu = 10, .seed = 5});
  phantom::scan(three, size, {.voxel_mm = 1.5, .noise_hu = 30, .seed = 5});
  for (std::size_t n = 0; n < still.size(); ++n) {
    EXPECT_NEAR(still[n], 50, 1e-3);
    EXPECT_NEAR(three[n] - 50, 3 * (one[n] - 50), 5e-3);
  }
}

}  // namespace
}  // namespace trocar::streams_more_test
