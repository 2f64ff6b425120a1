#include "tissue/organ/staged_file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <csignal>

#include "haptics/input_error.h"
#include "tests/tissue/support/temporary_folder.h"
#include "tissue/organ/organ_manifest.h"

namespace trocar::staged_file_test {
namespace {

std::size_t entries(const std::filesystem::path& folder) {
  return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder), {}));
}

TEST(StagedFile, AppearsOnlyWhenCommitted) {
  test::TemporaryFolder folder;
  {
    StagedFile file(folder / "a", "bytes");
    EXPECT_FALSE(std::filesystem::exists(folder / "a"));
    file.commit();
  }
  EXPECT_EQ(read_bytes(folder / "a"), "bytes");
  EXPECT_EQ(entries(folder.path()), 1U);
}

TEST(StagedFile, LeavesNothingBehindWhenAbandoned) {
  test::TemporaryFolder folder;
  folder.write("a", "old");
  { const StagedFile file(folder / "a", "new"); }
  EXPECT_EQ(read_bytes(folder / "a"), "old");
  EXPECT_EQ(entries(folder.path()), 1U);
}

TEST(StagedFile, MakesTheFolder) {
  test::TemporaryFolder folder;
  StagedFile(folder / "deep/er/a", "x").commit();
  EXPECT_EQ(read_bytes(folder / "deep/er/a"), "x");
}

TEST(StagedFile, AFileInThePlaceOfTheFolderIsAnEnvironmentError) {
  test::TemporaryFolder folder;
  folder.write("not-a-folder", "x");
  EXPECT_CONTAINS(test::message_of<EnvironmentError>([&] { StagedFile(folder / "not-a-folder/a", "x"); }),
                  "cannot be written");
}

/// The disk is "full" after 4 KiB: the kernel refuses to let files grow further.
class SmallDisk {
 public:
  SmallDisk() : old_handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &old_);
    rlimit small = old_;
    small.rlim_cur = 4096;
    ::setrlimit(RLIMIT_FSIZE, &small);
  }
  ~SmallDisk() {
    ::setrlimit(RLIMIT_FSIZE, &old_);
    std::signal(SIGXFSZ, old_handler_);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

 private:
  rlimit old_{};
  void (*old_handler_)(int);
};

TEST(StagedFile, AFullDiskIsAnEnvironmentErrorAndLeavesTheOldFile) {
  test::TemporaryFolder folder;
  folder.write("a", "old");
  std::string message;
  {
    const SmallDisk disk;
    message = test::message_of<EnvironmentError>([&] { StagedFile(folder / "a", std::string(100'000, 'x')); });
  }
  EXPECT_CONTAINS(message, "cannot be written");
  EXPECT_EQ(read_bytes(folder / "a"), "old");
  EXPECT_EQ(entries(folder.path()), 1U);
}

TEST(StagedFile, ASecondWriterOfTheSameFileIsRefused) {
  test::TemporaryFolder folder;
  StagedFile first(folder / "x.ply", "one");
  EXPECT_CONTAINS(test::message_of<EnvironmentError>([&] { StagedFile second(folder / "x.ply", "two"); }),
                  "just writing it");
  first.commit();
  std::ifstream in(folder / "x.ply");
  std::string text;
  in >> text;
  EXPECT_EQ(text, "one");
}

}  // namespace
}  // namespace trocar::staged_file_test
