#include "app/window/attempt/disk_room.h"

#include <gtest/gtest.h>

#include "haptics/input_error.h"
#include "trainees/files/free_room.h"

namespace trocar::disk_room_test {
namespace {

constexpr std::uintmax_t kMiB = 1024 * 1024;

TEST(DiskRoom, AMinuteIsSixTenthsOfAMebibyteAtOneKilohertz) {
  const std::uintmax_t reserve = room_needed(0, 1000);
  EXPECT_EQ(room_needed(600, 1000) - reserve, 6 * kMiB) << "ten minutes";
  EXPECT_EQ(room_needed(300, 2000) - reserve, 6 * kMiB) << "twice the rate";
  EXPECT_GE(reserve, 4 * kMiB) << "the database writes too";
}

TEST(DiskRoom, ANearlyFullDiskIsRefusedWithWhatToDo) {
  EXPECT_NO_THROW(require_room("/data", 9 * kMiB, 9 * kMiB));
  try {
    require_room("/data", 9 * kMiB, 9 * kMiB - 1);
    FAIL() << "accepted";
  } catch (const EnvironmentError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("/data"), std::string::npos) << text;
    EXPECT_NE(text.find("8 MiB are free"), std::string::npos) << text;
    EXPECT_NE(text.find("needs 9 MiB"), std::string::npos) << text;
    EXPECT_NE(text.find("make room"), std::string::npos) << text;
  }
}

TEST(DiskRoom, AFolderThatIsYetToBeMadeIsOnTheDiskOfItsParent) {
  const auto parent = std::filesystem::temp_directory_path();
  const std::uintmax_t there = room_free(parent), below = room_free(parent / "not" / "there" / "yet");
  EXPECT_GT(below, 0u);
  EXPECT_NEAR(static_cast<double>(there), static_cast<double>(below), 1e9)
      << "the same disk, whatever others write meanwhile";
}

TEST(DiskRoom, AFileNamedWithoutAFolderLiesInTheCurrentOne) {
  EXPECT_NEAR(static_cast<double>(room_free({})), static_cast<double>(room_free(std::filesystem::current_path())), 1e9);
}

}  // namespace
}  // namespace trocar::disk_room_test
