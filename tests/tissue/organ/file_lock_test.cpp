#include "tissue/organ/file_lock.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

#include "haptics/input_error.h"
#include "tests/tissue/support/temporary_folder.h"
#include "tissue/organ/organ_manifest.h"

namespace trocar::file_lock_test {
namespace {

namespace fs = std::filesystem;

std::string refusal(const fs::path& stem) {
  return test::message_of<EnvironmentError>([&] { const NameLock lock(stem); });
}

TEST(NameLock, IsOnePrograms) {
  const test::TemporaryFolder folder;
  {
    const NameLock first(folder / "out"), other(folder / "out-liver");
    EXPECT_CONTAINS(refusal(folder / "out"), "out: another program is just writing it");
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      int code = 0;  // not refused
      try {
        const NameLock second(folder / "out");
      } catch (const EnvironmentError&) {
        code = 3;
      }
      ::_exit(code);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_EQ(WEXITSTATUS(status), 3);
  }
  EXPECT_TRUE(fs::is_empty(folder.path())) << "no lock is left";
  const NameLock again(folder / "out");
}

/// Opening, locking and unlinking of several holders fall between each other in every order.
TEST(NameLock, IsHeldOnceAtATime) {
  const test::TemporaryFolder folder;
  std::atomic<int> holders = 0, held = 0, most = 0;
  const auto work = [&] {
    for (int n = 0; n < 2000; ++n) {
      try {
        const NameLock lock(folder / "out");
        most = std::max(most.load(), ++holders);
        ++held;
        --holders;
      } catch (const EnvironmentError&) {
        continue;  // another thread has it
      }
    }
  };
  std::vector<std::thread> threads;
  for (int n = 0; n < 4; ++n) threads.emplace_back(work);
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(most, 1);
  EXPECT_GT(held, 0);
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(NameLock, WhatAKilledProgramLeftLocksNobodyOut) {
  const test::TemporaryFolder folder;
  folder.write(".out.lock", "");
  { const NameLock lock(folder / "out"); }
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

/// The folders that were made for it go too, unless something was put into them.
TEST(NameLock, LeavesNoEmptyFolder) {
  const test::TemporaryFolder folder;
  { const NameLock lock(folder / "a/b/out"); }
  EXPECT_TRUE(fs::is_empty(folder.path()));
  {
    const NameLock lock(folder / "a/b/out");
    folder.write("a/out.ply", "x");
  }
  EXPECT_TRUE(fs::exists(folder / "a/out.ply"));
  EXPECT_FALSE(fs::exists(folder / "a/b"));
}

TEST(NameLock, ItsFileIsNoInput) {
  EXPECT_TRUE(is_name_lock("folder/.out.lock"));
  EXPECT_FALSE(is_name_lock("folder/out.lock"));
  EXPECT_FALSE(is_name_lock("folder/.out.nii.gz"));
}

TEST(OpenLocked, KeepsTheBytesAndNamesTheSystemsReason) {
  const test::TemporaryFolder folder;
  folder.write("a", "old");
  ::close(open_locked(folder / "a", folder / "a"));
  EXPECT_EQ(read_bytes(folder / "a"), "old");
  folder.write("file", "x");
  EXPECT_CONTAINS(test::message_of<EnvironmentError>([&] { open_locked(folder / "file/a", folder / "file/a"); }),
                  "cannot be written: ");
}

/// Two programs open the file; the first unlinks it and ends its lock. What the second then opens is a new file, and a
/// third cannot lock the same.
TEST(OpenLocked, AFileThatLostItsNameIsNotTheLock) {
  const test::TemporaryFolder folder;
  const fs::path file = folder / ".out.lock";
  const int opened_before = ::open(file.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0644);
  { const NameLock first(folder / "out"); }
  const int lock = open_locked(file, folder / "out");
  struct stat old = {}, fresh = {};
  ASSERT_EQ(::fstat(opened_before, &old), 0);
  ASSERT_EQ(::fstat(lock, &fresh), 0);
  EXPECT_NE(old.st_ino, fresh.st_ino);
  EXPECT_CONTAINS(refusal(folder / "out"), "just writing it");
  ::close(opened_before), ::close(lock);
}

}  // namespace
}  // namespace trocar::file_lock_test
