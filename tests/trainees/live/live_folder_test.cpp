#include "trainees/live/live_folder.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>

#include "tests/tissue/support/temporary_folder.h"

namespace trocar::live_folder_test {
namespace {

namespace fs = std::filesystem;
using Open = LiveFolder::Open;

class LiveFolderTest : public testing::Test {
 protected:
  mode_t mode_of(const fs::path& path) const {
    struct stat found = {};
    return ::lstat(path.c_str(), &found) == 0 ? found.st_mode & 07777U : 0U;
  }
  test::TemporaryFolder folder_;
  fs::path database_ = folder_.path() / "ward.db";
  fs::path live_ = folder_.path() / "ward.live";
};

TEST_F(LiveFolderTest, IsTheOwnersAloneWhateverTheUmask) {
  const mode_t before = ::umask(0);
  LiveFolder folder(database_, Open::kMake);
  ASSERT_TRUE(folder.write("a.json", "one\n"));
  folder.look();
  ::umask(before);
  EXPECT_EQ(mode_of(live_), 0700U);
  EXPECT_EQ(mode_of(live_ / "a.json"), 0600U);
  EXPECT_EQ(mode_of(live_ / "looked"), 0600U);
  EXPECT_EQ(folder.read("a.json"), "one\n");
}

TEST_F(LiveFolderTest, WritesOverAndLeavesNoParts) {
  LiveFolder folder(database_, Open::kMake);
  std::ofstream(live_ / "a.json.part") << "of a program that died";
  ASSERT_TRUE(folder.write("a.json", "one"));
  ASSERT_TRUE(folder.write("a.json", "two"));
  EXPECT_EQ(folder.read("a.json"), "two");
  EXPECT_EQ(folder.names(), std::vector<std::string>{"a.json"});
  EXPECT_FALSE(fs::exists(live_ / "a.json.part"));
  folder.remove("a.json");
  EXPECT_FALSE(folder.read("a.json"));
}

TEST_F(LiveFolderTest, FollowsNoLink) {
  LiveFolder folder(database_, Open::kMake);
  const fs::path other = folder_.path() / "diary";
  std::ofstream(other) << "private";
  ::chmod(other.c_str(), 0600);
  fs::create_symlink(other, live_ / "b.json");
  EXPECT_FALSE(folder.read("b.json"));
  fs::create_symlink(other, live_ / "c.json.part");
  ASSERT_TRUE(folder.write("c.json", "mine"));
  fs::remove(live_ / "looked");
  fs::create_symlink(other, live_ / "looked");
  folder.look();
  EXPECT_FALSE(folder.last_look_s());
  std::string kept;
  std::ifstream(other) >> kept;
  EXPECT_EQ(kept, "private") << "nothing is written through a link";
}

TEST_F(LiveFolderTest, RefusesALinkInPlaceOfTheFolderAndOneOpenToOthers) {
  const fs::path elsewhere = folder_.path() / "elsewhere";
  fs::create_directory(elsewhere);
  fs::permissions(elsewhere, fs::perms::owner_all);
  fs::create_directory_symlink(elsewhere, live_);
  EXPECT_FALSE(LiveFolder(database_, Open::kMake).open());
  EXPECT_NE(LiveFolder(database_, Open::kExisting).refusal(), "");
  fs::remove(live_);
  fs::create_directory(live_);
  ::chmod(live_.c_str(), 0755);
  const LiveFolder open_to_others(database_, Open::kMake);
  EXPECT_FALSE(open_to_others.open());
  EXPECT_NE(open_to_others.refusal().find("open to others"), std::string::npos) << open_to_others.refusal();
}

TEST_F(LiveFolderTest, ReadsNoPipeNoFolderNothingOpenToOthersAndNothingLarge) {
  LiveFolder folder(database_, Open::kMake);
  ASSERT_EQ(::mkfifo((live_ / "pipe.json").c_str(), 0600), 0);
  fs::create_directory(live_ / "folder.json");
  std::ofstream(live_ / "wide.json") << "x";
  ::chmod((live_ / "wide.json").c_str(), 0644);
  ASSERT_TRUE(folder.write("large.json", std::string(LiveFolder::kLargest + 1, 'x')));
  ASSERT_TRUE(folder.write("whole.json", std::string(LiveFolder::kLargest, 'x')));
  for (const char* name : {"pipe.json", "folder.json", "wide.json", "large.json", "none.json"})
    EXPECT_FALSE(folder.read(name)) << name;
  EXPECT_EQ(folder.read("whole.json")->size(), LiveFolder::kLargest);
}

TEST_F(LiveFolderTest, WithoutAFileOfADatabaseOrAFolderThereIsNothing) {
  for (const char* none : {"", ":memory:"}) EXPECT_FALSE(LiveFolder(none, Open::kMake).open());
  const LiveFolder missing(database_, Open::kExisting);
  EXPECT_FALSE(missing.open());
  EXPECT_EQ(missing.refusal(), "") << "nobody ran here yet";
  EXPECT_FALSE(fs::exists(live_)) << "looking makes nothing";
  std::ofstream(live_) << "a file";
  LiveFolder blocked(database_, Open::kMake);
  EXPECT_FALSE(blocked.open());
  EXPECT_FALSE(blocked.write("a.json", "x"));
  EXPECT_TRUE(blocked.names().empty());
}

}  // namespace
}  // namespace trocar::live_folder_test
