// Hostile NIfTI files: whatever the bytes, the answer is a label map or an InputError, never a crash.
#include <gtest/gtest.h>

#include <random>

#include "haptics/input_error.h"
#include "tests/tissue/support/label_files.h"
#include "tests/tissue/support/nifti_fixture.h"
#include "tests/tissue/support/temporary_folder.h"
#include "tissue/imaging/labels/label_volume.h"
#include "tissue/imaging/volumes/gzip_stream.h"

namespace trocar::nifti_fuzz_test {
namespace {

std::string small_file() {
  test::NiftiFixture file;
  file.at(2, 2, 2) = 1;
  file.at(3, 2, 2) = 5;
  return file.bytes();
}

/// True when the bytes were read, false when they were refused; anything else ends the test.
bool accepted(const std::filesystem::path& path) {
  try {
    const LabelVolume volume = test::read_label_volume(path);
    EXPECT_EQ(volume.labels.size(), volume.offset(0, 0, volume.size[2]));
    EXPECT_TRUE(volume.index_to_ras_mm.matrix().allFinite());
    return true;
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(path.filename().string()), std::string::npos) << error.what();
    return false;
  }
}

TEST(NiftiFuzz, EveryTruncationIsRefused) {
  test::TemporaryFolder folder;
  const std::string whole = small_file(), packed = gzip_compressed(whole);
  for (std::size_t length = 0; length < whole.size(); length += 16) {
    EXPECT_FALSE(accepted(folder.write("cut.nii", whole.substr(0, length)))) << length;
    EXPECT_FALSE(accepted(folder.write("cut.nii.gz", gzip_compressed(whole.substr(0, length))))) << length;
  }
  for (std::size_t length = 0; length < packed.size(); ++length)
    EXPECT_FALSE(accepted(folder.write("cut.nii.gz", packed.substr(0, length)))) << length;
  EXPECT_TRUE(accepted(folder.write("whole.nii.gz", packed)));
}

TEST(NiftiFuzz, EveryFlippedHeaderBitIsReadOrRefused) {
  test::TemporaryFolder folder;
  const std::string whole = small_file();
  std::size_t refused = 0;
  for (std::size_t bit = 0; bit < 352 * 8; ++bit) {
    std::string bytes = whole;
    bytes[bit / 8] = static_cast<char>(bytes[bit / 8] ^ (1 << bit % 8));
    refused += accepted(folder.write("flip.nii", bytes)) ? 0 : 1;
  }
  EXPECT_GT(refused, 200U);  // the fields that matter; free text and unused bytes may change
}

TEST(NiftiFuzz, RandomDamageIsReadOrRefused) {
  test::TemporaryFolder folder;
  const std::string whole = small_file(), packed = gzip_compressed(whole);
  std::mt19937_64 random(20260101);
  for (int round = 0; round < 1500; ++round) {
    const bool gzip = round % 3 == 0;
    std::string bytes = gzip ? packed : whole;
    for (std::uint64_t hits = 1 + random() % 6; hits > 0; --hits)
      bytes[random() % std::min<std::size_t>(bytes.size(), 352)] = static_cast<char>(random());
    accepted(folder.write(gzip ? "random.nii.gz" : "random.nii", bytes));
  }
}

}  // namespace
}  // namespace trocar::nifti_fuzz_test
