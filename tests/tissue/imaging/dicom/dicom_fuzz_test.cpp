// Hostile files of every kind that the DICOM readers take: the answer is a value or an InputError, soon and within
// bounds.
//
// Seeded; TROCAR_FUZZ_SECONDS makes it run that long a family instead of one and a half seconds.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <random>

#include "tests/tissue/imaging/dicom/dicom_folder.h"
#include "tests/tissue/imaging/dicom/gdcm_fixture.h"
#include "tests/tissue/imaging/dicom/segmentation_fixture.h"
#include "tests/tissue/imaging/dicom/zip_fixture.h"
#include "tissue/imaging/dicom/dicom_segmentation.h"
#include "tissue/imaging/dicom/rt_structures.h"

namespace trocar::test::dicom_fuzz_test {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_per_family() {
  const char* text = std::getenv("TROCAR_FUZZ_SECONDS");
  return text != nullptr ? std::atof(text) : 1.5;
}

/// Changes a few bytes: any value, a bit, the largest and smallest numbers, a copied or a lost piece, a shorter end.
std::string mutated(std::string bytes, std::mt19937_64& random, std::size_t from) {
  const auto place = [&] { return from + random() % std::max<std::size_t>(1, bytes.size() - from); };
  for (std::uint64_t hits = 1 + random() % 4; hits > 0 && bytes.size() > from + 8; --hits) {
    const std::size_t at = place();
    switch (random() % 7) {
      case 0:
        bytes[at] = static_cast<char>(random());
        break;
      case 1:
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << random() % 8));
        break;
      case 2:
        bytes[at] = static_cast<char>(random() % 2 == 0 ? 0xFF : 0);
        break;
      case 3:
        for (std::size_t n = at; n < std::min(at + 4, bytes.size()); ++n) bytes[n] = static_cast<char>(0xFF);
        break;
      case 4:
        bytes.insert(at, bytes.substr(place(), random() % 40));
        break;
      case 5:
        bytes.erase(at, random() % 20);
        break;
      default:
        if (random() % 4 == 0) bytes.resize(at);
        break;
    }
  }
  return bytes;
}

struct Tally {
  int read = 0, refused = 0;
  double slowest = 0;
};

/// Runs `work` on mutations of the seeds until the time is up.
Tally fuzz(const std::vector<std::string>& seeds, std::size_t from,
           const std::function<void(const std::string&)>& work) {
  std::mt19937_64 random(20260722);
  Tally tally;
  const auto end = Clock::now() + std::chrono::duration<double>(seconds_per_family());
  for (std::size_t round = 0; round < 20 || Clock::now() < end; ++round) {
    const std::string bytes = mutated(seeds[round % seeds.size()], random, from);
    const auto start = Clock::now();
    try {
      work(bytes);
      ++tally.read;
    } catch (const InputError& error) {
      EXPECT_GT(std::string(error.what()).size(), 10U);
      ++tally.refused;
    }
    tally.slowest = std::max(tally.slowest, std::chrono::duration<double>(Clock::now() - start).count());
  }
  std::cout << tally.read << " read, " << tally.refused << " refused, slowest " << tally.slowest << " s\n";
  EXPECT_GT(tally.refused, 0);
  EXPECT_LT(tally.slowest, 20);
  return tally;
}

void require_sound(const ImageVolume& volume) {
  ASSERT_EQ(volume.values.size(), volume.offset(0, 0, volume.size[2]));
  ASSERT_TRUE(volume.index_to_ras_mm.matrix().allFinite());
  ASSERT_GT(volume.index_to_ras_mm.linear().determinant(), 0);
}

void require_sound(const LabelMap& map) {
  ASSERT_FALSE(map.segments.empty());
  for (const Segment& segment : map.segments) ASSERT_LT(segment.layer, map.layers.size());
  for (const LabelVolume& layer : map.layers) {
    ASSERT_EQ(layer.labels.size(), layer.offset(0, 0, layer.size[2]));
    ASSERT_TRUE(layer.index_to_ras_mm.matrix().allFinite());
  }
}

TEST(DicomFuzz, PlainSlices) {
  const DicomFolder folder;
  const auto slices = stack_of(3, 2);
  folder.write_all(slices);
  std::vector<std::string> seeds;
  for (const Encoding encoding :
       {Encoding::kExplicit, Encoding::kImplicit, Encoding::kBigEndian, Encoding::kDeflated}) {
    SliceFixture slice = slices[1];
    slice.encoding = encoding;
    slice.change = [](Elements& d) {
      d.sequence(0x00081115, {Elements(d.encoding()).text(0x00081155, "UI", "1.2")}, true);
    };
    seeds.push_back(slice.file());
  }
  fuzz(seeds, 132, [&](const std::string& bytes) {
    folder.write("a01", bytes);
    for (const DicomSeries& series : list_dicom(folder.path())) ASSERT_FALSE(describe(series).empty());
    require_sound(folder.read());
  });
}

TEST(DicomFuzz, EnhancedFiles) {
  const DicomFolder folder;
  const auto slices = stack_of(4, 2);
  fuzz({dicom_file(enhanced(slices))}, 132,
       [&](const std::string& bytes) { require_sound(read_dicom_series(folder.write("multi", bytes))); });
}

TEST(DicomFuzz, CompressedPixels) {
  const DicomFolder folder;
  const auto slices = stack_of(3, 2);
  Elements data = enhanced(slices);
  std::vector<std::string> pieces;
  for (const SliceFixture& slice : slices) pieces.push_back(rle_frame(slice.pixels(), 2));
  data.fragments(pieces);
  fuzz({dicom_file(data, kRle)}, 1200,
       [&](const std::string& bytes) { require_sound(read_dicom_series(folder.write("multi", bytes))); });
}

/// Frames as encoders write them, damaged where the code lies: JPEG lossless and baseline, JPEG-LS, JPEG 2000.
TEST(DicomFuzz, CodesOfEveryDecoder) {
  const DicomFolder folder;
  SliceFixture like;
  like.columns = 24, like.rows = 16, like.allocated = like.stored = 8, like.is_signed = false;
  auto slices = stack_of(3, 2, like);
  folder.write_all(slices);
  std::vector<std::string> seeds;
  for (const char* syntax : {"50", "70", "80", "90"})
    seeds.push_back(compressed(slices[1].file(), "1.2.840.10008.1.2.4." + std::string(syntax)));
  const std::size_t code = seeds.front().find(std::string("\xE0\x7F\x10\0OB", 6));
  ASSERT_NE(code, std::string::npos);
  fuzz(seeds, code - 60, [&](const std::string& bytes) {
    folder.write("a01", bytes);
    require_sound(folder.read());
  });
}

TEST(DicomFuzz, Segmentations) {
  const DicomFolder folder;
  SegmentationFixture binary, fractional;
  fractional.maximum = 255;
  for (int k = 0; k < 4; ++k) {
    binary.frames.push_back({1, {0, 0, 3.0 * k}, std::vector<int>(35, k % 2)});
    fractional.frames.push_back({1, {0, 0, 3.0 * k}, std::vector<int>(35, 60 * k)});
  }
  fuzz({binary.file(), fractional.file()}, 132,
       [&](const std::string& bytes) { require_sound(read_dicom_segmentation(folder.write("seg", bytes))); });
}

TEST(DicomFuzz, StructureSets) {
  const DicomFolder folder;
  StructureFixture box, ring{2, "Ring", {}, "CLOSED_PLANAR"};
  ImageVolume grid;
  grid.size = {30, 30, 8};
  grid.index_to_ras_mm.translation() = Eigen::Vector3d(-15, -15, 0);
  for (int k = 0; k < 5; ++k)
    box.contours.push_back(rectangle(-5, -5, 5, 5, k)), ring.contours.push_back(circle({0, 0, 1.0 * k}, 8, 12));
  const std::string seed = dicom_file(structure_set({box, ring}));
  fuzz({seed}, 132, [&](const std::string& bytes) { require_sound(read_rtstruct(folder.write("rt", bytes), grid)); });
  fuzz({seed}, 600, [&](const std::string& bytes) { require_sound(read_rtstruct(folder.write("rt", bytes))); });
}

TEST(DicomFuzz, ZipsAndDirectories) {
  const TemporaryFolder folder;
  const auto slices = stack_of(3, 2);
  const auto zip =
      write_zip(folder / "scan.zip", {{"a", slices[0].file()}, {"b", slices[1].file()}, {"c", slices[2].file()}});
  std::ifstream in(zip, std::ios::binary);
  fuzz({std::string(std::istreambuf_iterator<char>(in), {})}, 4,
       [&](const std::string& bytes) { require_sound(read_dicom_series(folder.write("x.zip", bytes))); });
  const TemporaryFolder& disc = folder;
  std::filesystem::create_directories(disc / "I");
  std::vector<Elements> records;
  for (std::size_t n = 0; n < 3; ++n) {
    disc.write("I/" + std::to_string(n), slices[n].file());
    records.push_back(Elements().text(0x00041430, "CS", "IMAGE").text(0x00041500, "CS", "I\\" + std::to_string(n)));
  }
  const std::string seed = dicom_file(Elements().sequence(0x00041220, records));
  fuzz({seed}, 132, [&](const std::string& bytes) { require_sound(read_dicom_series(disc.write("DICOMDIR", bytes))); });
}

TEST(DicomFuzz, SmallFilesThatClaimALotAreRefusedAtOnce) {
  const DicomFolder folder;
  const auto start = Clock::now();
  const auto refused = [&](const std::function<void(Elements&)>& change, const char* syntax = "") {
    SliceFixture slice;
    slice.change = change;
    const auto file = folder.write("claim", slice.file(syntax));
    EXPECT_THROW(read_dicom_series(file), InputError);
    EXPECT_THROW(read_dicom_segmentation(file), InputError);
    list_dicom(file);
  };
  refused([](Elements& d) { d.word(0x00280010, 65535).word(0x00280011, 65535).text(0x00280008, "IS", "1000"); });
  refused([](Elements& d) { d.word(0x00280010, 8192).word(0x00280011, 8192).fragments({"\xFF\xD8\xFF\xD9"}); },
          "1.2.840.10008.1.2.4.70");
  refused([](Elements& d) { d.text(0x00280008, "IS", "200000").sequence(0x52009230, std::vector<Elements>(3)); });
  refused([](Elements& d) {
    d.text(0x00080016, "UI", kSegmentationClass).word(0x00280010, 65535).word(0x00280011, 65535);
  });
  refused([](Elements& d) { d.raw(0x7FE00010, std::string("\xE0\x7F\x10\0OW\0\0\xFE\xFF\xFF\xFF", 12)); });
  EXPECT_LT(std::chrono::duration<double>(Clock::now() - start).count(), 5);
}

}  // namespace
}  // namespace trocar::test::dicom_fuzz_test
