// Hostile volume files of every format: whatever the bytes, the answer is a volume or an InputError that names the
// file.
//
// Each format runs for a second or two; TROCAR_FUZZ_SECONDS in the environment makes each run that long.
#include <chrono>
#include <cstdlib>
#include <random>

#include "tests/tissue/imaging/volumes/volume_files.h"
#include "tests/tissue/support/nifti_fixture.h"
#include "tissue/imaging/labels/label_table_file.h"
#include "tissue/imaging/volumes/gzip_stream.h"

namespace trocar::volume_fuzz_test {
namespace {

constexpr int kRounds = 700;  // of the normal suite: the same on every machine

/// Words that sit at places where headers break.
const std::vector<std::string> kWords{"-1",
                                      "0",
                                      "1e400",
                                      "nan",
                                      "inf",
                                      "99999999999999999999",
                                      "none",
                                      "LIST",
                                      "(",
                                      ")",
                                      ",",
                                      ":",
                                      ":=",
                                      "=",
                                      "\n",
                                      "\n\n",
                                      "\"",
                                      "4294967296",
                                      "2147483647",
                                      "-2147483648",
                                      "../",
                                      "/",
                                      "%d",
                                      "1e-320",
                                      "True",
                                      "gzip",
                                      "ascii",
                                      "raw",
                                      "byte skip: -1\n",
                                      "HeaderSize = -1\n",
                                      "Segment0_Layer:=1\n",
                                      "kinds: list domain domain\n"};

void damage(std::string& bytes, std::mt19937_64& random, std::size_t head) {
  for (std::uint64_t hits = 1 + random() % 4; hits > 0 && !bytes.empty(); --hits) {
    const std::size_t place = random() % std::min(bytes.size(), head);
    switch (random() % 6) {
      case 0:
        bytes[place] = static_cast<char>(random());
        break;
      case 1:
        bytes[place] = static_cast<char>(bytes[place] ^ (1 << random() % 8));
        break;
      case 2:
        bytes.insert(place, kWords[random() % kWords.size()]);
        break;
      case 3:
        bytes.erase(place, 1 + random() % 12);
        break;
      case 4:
        bytes.replace(place, std::min<std::size_t>(1 + random() % 4, bytes.size() - place),
                      kWords[random() % kWords.size()]);
        break;
      default:
        bytes.resize(bytes.size() - random() % std::min<std::size_t>(bytes.size(), 40));
    }
  }
}

template <typename Read>
int outcome(const std::filesystem::path& path, Read read) {
  try {
    read(path);
    return 1;
  } catch (const InputError& error) {
    const std::string message = error.what();
    const bool named = message.find(path.stem().stem().string()) != std::string::npos ||
                       message.find("voxels.raw") != std::string::npos;
    EXPECT_TRUE(named) << message;
    return 0;
  }
}

void read_both(const std::filesystem::path& path, int& accepted) {
  accepted += outcome(path, [](const std::filesystem::path& file) {
    const ImageVolume image = read_image_volume(file);
    EXPECT_EQ(image.values.size(), image.offset(0, 0, image.size[2]));
    EXPECT_TRUE(image.index_to_ras_mm.matrix().allFinite());
    for (const float value : image.values) EXPECT_TRUE(std::isfinite(value));
  });
  accepted += outcome(path, [](const std::filesystem::path& file) {
    const LabelMap map = read_label_map(file);
    EXPECT_FALSE(map.segments.empty());
    for (const Segment& segment : map.segments) EXPECT_LT(segment.layer, map.layers.size());
    for (const LabelVolume& layer : map.layers) EXPECT_EQ(layer.labels.size(), layer.offset(0, 0, layer.size[2]));
  });
}

/// @param head bytes at the start that are damaged: the header, and a little of the data
template <typename Attempt>
void fuzz(std::uint64_t seed, Attempt attempt) {
  const char* seconds = std::getenv("TROCAR_FUZZ_SECONDS");
  const auto end =
      std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds != nullptr ? std::atof(seconds) : 0);
  std::mt19937_64 random(seed);
  int rounds = 0;
  for (; rounds < kRounds || std::chrono::steady_clock::now() < end; ++rounds) attempt(random);
  std::cout << rounds << " damaged files\n";
}

void fuzz_file(const std::string& name, const std::vector<std::string>& whole, std::uint64_t seed) {
  test::TemporaryFolder folder;
  folder.write("voxels.raw", test::packed<std::int16_t>(test::told_indices()));
  int accepted = 0;
  for (const std::string& bytes : whole) read_both(folder.write(name, bytes), accepted);
  EXPECT_GT(accepted, 0);  // the files before the damage are good
  fuzz(seed, [&](std::mt19937_64& random) {
    std::string bytes = whole[random() % whole.size()];
    damage(bytes, random, 700);
    read_both(folder.write(name, bytes), accepted);
  });
}

const std::string kNrrd =
    "NRRD0004\ntype: short\ndimension: 3\nspace: left-posterior-superior\nsizes: 4 3 2\n"
    "space directions: (2,0,0) (0,3,0) (0,0,4)\nkinds: domain domain domain\nendian: little\nspace origin: (1,2,3)\n";

TEST(VolumeFuzz, Nrrd) {
  const std::string voxels = test::packed<std::int16_t>(test::told_indices());
  std::string text;
  for (const double value : test::told_indices()) text += std::to_string(value) + " ";
  fuzz_file("fuzzed.nrrd",
            {kNrrd + "encoding: raw\n\n" + voxels, kNrrd + "encoding: gzip\n\n" + gzip_compressed(voxels),
             kNrrd + "encoding: ascii\n\n" + text, kNrrd + "encoding: raw\ndata file: voxels.raw\n"},
            1);
}

TEST(VolumeFuzz, SegNrrd) {
  const std::string start =
      "NRRD0004\ntype: unsigned char\ndimension: 4\nspace: left-posterior-superior\nsizes: 2 4 3 2\n"
      "space directions: none (2,0,0) (0,3,0) (0,0,4)\nkinds: list domain domain domain\nencoding: gzip\nspace origin: "
      "(1,2,3)\n"
      "Segment0_Name:=liver\nSegment0_LabelValue:=1\nSegment0_Layer:=0\nSegment1_Name:=lobe\nSegment1_LabelValue:="
      "1\nSegment1_Layer:=1\n";
  std::vector<double> values(48, 0);
  values[3] = values[8] = 1;
  fuzz_file("fuzzed.seg.nrrd", {start + "\n" + gzip_compressed(test::packed<std::uint8_t>(values))}, 2);
}

TEST(VolumeFuzz, MetaImage) {
  const std::string start =
      "ObjectType = Image\nNDims = 3\nBinaryData = True\nTransformMatrix = 1 0 0 0 1 0 0 0 1\nOffset = 1 2 3\n"
      "CenterOfRotation = 0 0 0\nAnatomicalOrientation = RAI\nElementSpacing = 2 3 4\nDimSize = 4 3 2\nElementType = "
      "MET_SHORT\n";
  const std::string voxels = test::packed<std::int16_t>(test::told_indices());
  fuzz_file("fuzzed.mha",
            {start + "ElementDataFile = LOCAL\n" + voxels,
             start + "CompressedData = True\nElementDataFile = LOCAL\n" + test::zlib_packed(voxels),
             start + "HeaderSize = -1\nElementDataFile = voxels.raw\n"},
            3);
}

TEST(VolumeFuzz, Nifti) {
  test::NiftiFixture file;
  file.at(2, 2, 2) = 1;
  const std::string one = file.bytes();
  fuzz_file("fuzzed.nii", {one}, 4);
}

TEST(VolumeFuzz, PackedNifti) {
  test::NiftiFixture file;
  file.at(2, 2, 2) = 1;
  test::TemporaryFolder folder;
  const std::string whole = file.bytes();
  int accepted = 0;
  fuzz(5, [&](std::mt19937_64& random) {
    std::string bytes = whole;
    if (random() % 2 == 0) damage(bytes, random, 400);
    bytes = gzip_compressed(bytes);
    if (random() % 2 == 0) damage(bytes, random, bytes.size());
    read_both(folder.write("fuzzed.nii.gz", bytes), accepted);
  });
  EXPECT_GT(accepted, 0);
}

TEST(VolumeFuzz, LabelTables) {
  const std::vector<std::string> whole{"number,name\n1,liver\n5,\"gall bladder\"\n",
                                       "1 liver 1 2 3 4\n5 spleen 1 2 3 4\n", "    1  255 0 0  1 1 1  \"liver\"\n",
                                       "1\tliver\n2\tspleen\n"};
  int accepted = 0;
  fuzz(6, [&](std::mt19937_64& random) {
    std::string bytes = whole[random() % whole.size()];
    damage(bytes, random, 700);
    accepted += outcome("fuzzed.csv", [&](const std::filesystem::path& file) {
      const OwnLabelTable table = parse_label_table(bytes, file.string());
      EXPECT_FALSE(table.table().labels.empty());
    });
  });
  EXPECT_GT(accepted, 0);
}

}  // namespace
}  // namespace trocar::volume_fuzz_test
