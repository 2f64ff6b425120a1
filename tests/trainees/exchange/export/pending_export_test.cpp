// All or nothing: what is there is never touched, and what was not committed leaves no trace.
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>

#include "tests/trainees/exchange/export/export_samples.h"
#include "trainees/exchange/export/pending_export.h"

namespace trocar::pending_export_test {
namespace {

namespace fs = std::filesystem;
using Shape = PendingExport::Shape;
using test::bytes_of_file;
using test::names_in;

class PendingExportTest : public TemporaryFolder {
 protected:
  std::string refused(const fs::path& out, Shape shape = Shape::kFile) {
    return message_of<InputError>([&] { PendingExport pending(out, shape); });
  }
};

TEST_F(PendingExportTest, AFileStandsOnlyWhenCommitted) {
  const fs::path out = folder_ / "all.json";
  {
    PendingExport pending(out, Shape::kFile);
    pending.file() << "half";
    EXPECT_FALSE(fs::exists(out));
  }
  EXPECT_TRUE(names_in(folder_).empty()) << "given up without a trace";
  PendingExport pending(out, Shape::kFile);
  pending.file() << "whole";
  pending.commit();
  EXPECT_EQ(bytes_of_file(out), "whole");
  EXPECT_EQ(names_in(folder_), std::vector<std::string>{"all.json"});
}

TEST_F(PendingExportTest, AFolderStandsOnlyWhenCommitted) {
  const fs::path out = folder_ / "tables";
  {
    PendingExport pending(out, Shape::kFolder);
    pending.file("a.csv") << "a";
    pending.file("deep/er/b.csv") << "b";
    EXPECT_FALSE(fs::exists(out));
  }
  EXPECT_TRUE(names_in(folder_).empty());
  PendingExport pending(out, Shape::kFolder);
  pending.file("a.csv") << "a";
  pending.file("deep/er/b.csv") << "b";
  pending.commit();
  EXPECT_EQ(names_in(out), (std::vector<std::string>{"a.csv", "deep"}));
  EXPECT_EQ(bytes_of_file(out / "deep/er/b.csv"), "b");
  EXPECT_EQ(names_in(folder_), std::vector<std::string>{"tables"});
}

TEST_F(PendingExportTest, IsForItsOwnerAloneWhateverTheUmask) {
  const auto rights = [](const fs::path& path) {
    return static_cast<int>(fs::status(path).permissions() & fs::perms(0777));
  };
  for (const mode_t mask : {mode_t{0}, mode_t{022}, mode_t{0777}}) {
    const fs::path file = folder_ / ("all" + std::to_string(mask)), out = folder_ / ("tables" + std::to_string(mask));
    const mode_t before = umask(mask);
    {
      PendingExport one(file, Shape::kFile);
      one.file() << "x";
      one.commit();
      PendingExport many(out, Shape::kFolder);
      many.file("deep/er/b.csv") << "b";
      many.commit();
    }
    umask(before);
    EXPECT_EQ(rights(file), 0600) << mask;
    EXPECT_EQ(rights(out / "deep/er/b.csv"), 0600) << mask;
    for (const char* folder : {"", "deep", "deep/er"}) EXPECT_EQ(rights(out / folder), 0700) << folder << mask;
  }
}

TEST_F(PendingExportTest, ATrailingSlashIsTheFolder) {
  PendingExport pending(folder_ / "tables/", Shape::kFolder);
  pending.file("a.csv") << "a";
  pending.commit();
  EXPECT_EQ(bytes_of_file(folder_ / "tables/a.csv"), "a");
}

TEST_F(PendingExportTest, NothingIsOverwritten) {
  std::ofstream(folder_ / "file") << "mine";
  fs::create_directory(folder_ / "empty");
  fs::create_symlink("nowhere", folder_ / "link");
  for (const char* name : {"file", "empty", "empty/", "link"}) {
    for (const Shape shape : {Shape::kFile, Shape::kFolder}) {
      EXPECT_NE(refused(folder_ / name, shape).find("exists already"), std::string::npos) << name;
    }
  }
  EXPECT_EQ(bytes_of_file(folder_ / "file"), "mine");
  EXPECT_EQ(names_in(folder_).size(), 3u);
}

TEST_F(PendingExportTest, WhatIsWrittenIsItsOwnersAlone) {
  const mode_t before = umask(0);  // a user who lets everybody read
  PendingExport file(folder_ / "file", Shape::kFile);
  file.file() << "x";
  file.commit();
  PendingExport tables(folder_ / "tables", Shape::kFolder);
  tables.file("a.csv") << "x";
  tables.commit();
  umask(before);
  for (const char* name : {"file", "tables/a.csv"}) {
    struct stat info {};
    ASSERT_EQ(stat((folder_ / name).c_str(), &info), 0);
    EXPECT_EQ(info.st_mode & 0777U, 0600U) << name;
  }
}

TEST_F(PendingExportTest, AFileGivesWayWhenToldAndOnlyWhenTheNewOneIsWhole) {
  const auto replaced = [&](const char* name, Shape shape = Shape::kFile) {
    return PendingExport(folder_ / name, shape, PendingExport::Existing::kReplaced);
  };
  std::ofstream(folder_ / "file") << "old";
  {
    PendingExport given_up(folder_ / "file", Shape::kFile, PendingExport::Existing::kReplaced);
    given_up.file() << "half";
  }
  EXPECT_EQ(bytes_of_file(folder_ / "file"), "old");
  PendingExport pending(folder_ / "file", Shape::kFile, PendingExport::Existing::kReplaced);
  pending.file() << "new";
  pending.commit();
  EXPECT_EQ(bytes_of_file(folder_ / "file"), "new");
  fs::create_directory(folder_ / "folder");
  fs::create_symlink("file", folder_ / "link");
  EXPECT_THROW(replaced("folder"), InputError);
  EXPECT_THROW(replaced("link"), InputError);
  EXPECT_THROW(replaced("folder", Shape::kFolder), InputError) << "a folder never gives way";
}

TEST_F(PendingExportTest, NorWhatCameMeanwhile) {
  PendingExport pending(folder_ / "out", Shape::kFile);
  pending.file() << "ours";
  std::ofstream(folder_ / "out") << "theirs";
  EXPECT_THROW(pending.commit(), InputError);
  EXPECT_EQ(bytes_of_file(folder_ / "out"), "theirs");
  PendingExport tables(folder_ / "tables", Shape::kFolder);
  tables.file("a") << "ours";
  fs::create_directory(folder_ / "tables");  // plain rename() would take an empty folder's place
  EXPECT_THROW(tables.commit(), InputError);
  EXPECT_TRUE(names_in(folder_ / "tables").empty());
}

TEST_F(PendingExportTest, AMissingFolderIsRefusedAndNotMade) {
  EXPECT_NE(refused(folder_ / "nowhere/out").find("there is no folder"), std::string::npos);
  EXPECT_NE(refused(folder_ / "nowhere/out", Shape::kFolder).find("make it first"), std::string::npos);
  EXPECT_TRUE(names_in(folder_).empty());
  EXPECT_NE(refused("").find("no name"), std::string::npos);
  EXPECT_NE(refused("/").find("no name"), std::string::npos);
  EXPECT_NE(refused(folder_ / "..").find("no name"), std::string::npos);
}

TEST_F(PendingExportTest, WhatTheMachineRefusesIsSaid) {
  std::ofstream(folder_ / "file") << "mine";
  EXPECT_NE(message_of<EnvironmentError>([&] {
              PendingExport pending(folder_ / "file" / "out", Shape::kFile);
              pending.file() << "x";
            }).find("cannot write"),
            std::string::npos);
  EXPECT_NE(message_of<EnvironmentError>([&] {
              PendingExport pending(folder_ / "file" / "out", Shape::kFolder);
            }).find("cannot make"),
            std::string::npos);
}

TEST_F(PendingExportTest, AFullDiskIsNoSuccess) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  PendingExport pending(folder_ / "tables", Shape::kFolder);
  fs::create_symlink("/dev/full", fs::directory_iterator(folder_)->path() / "a.csv");
  pending.file("a.csv") << "rows";
  EXPECT_NE(message_of<EnvironmentError>([&] { pending.commit(); }).find("cannot write"), std::string::npos);
  EXPECT_FALSE(fs::exists(folder_ / "tables"));
}

}  // namespace
}  // namespace trocar::pending_export_test
