// The files of a record are for their owner alone, whatever the umask, and one that an older program left open is
// closed.
#include "trainees/store/record_files.h"

#include <sys/stat.h>

#include <fstream>

#include "tests/trainees/records/store_samples.h"

namespace trocar::record_files_test {
namespace {

namespace fs = std::filesystem;

class RecordFiles : public TemporaryFolder {
 protected:
  /// "NAME 600" of everything in the folder, sorted.
  std::vector<std::string> rights() const {
    std::vector<std::string> out;
    for (const auto& entry : fs::recursive_directory_iterator(folder_)) {
      char text[8];
      std::snprintf(text, sizeof text, " %o", static_cast<unsigned>(entry.status().permissions() & fs::perms(0777)));
      out.push_back(entry.path().lexically_relative(folder_).string() + text);
    }
    std::sort(out.begin(), out.end());
    return out;
  }
  fs::path file_ = folder_ / "t.db";
};

TEST_F(RecordFiles, AreMadeForTheirOwnerAloneWhateverTheUmask) {
  for (const mode_t mask : {mode_t{0}, mode_t{022}}) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    const mode_t before = umask(mask);
    Database database(file_);
    store_attempt(database, sample_start(), sample_result());
    umask(before);
    EXPECT_EQ(rights(),
              (std::vector<std::string>{"t.db 600", "t.db-shm 600", "t.db-wal 600", "t.db.anchor 600", "t.db.key 600"}))
        << mask;
  }
}

TEST_F(RecordFiles, ThatStoodOpenAreClosedWhenTheirOwnerOpensThem) {
  { Database database(file_); }
  for (const char* folder : {"t.recordings", "t.films", "t.live", "other.recordings"}) {
    fs::create_directories(folder_ / folder);
    std::ofstream(folder_ / folder / "a") << "x";
    fs::permissions(folder_ / folder / "a", fs::perms(0644));
    fs::permissions(folder_ / folder, fs::perms(0755));
  }
  for (const char* beside : {"t.db.schema3.backup", "t.db2"}) std::ofstream(folder_ / beside) << "x";
  for (const char* loose : {"t.db", "t.db.anchor", "t.db.schema3.backup", "t.db2"})
    fs::permissions(folder_ / loose, fs::perms(0664));
  fs::permissions(folder_, fs::perms(0755));
  EXPECT_EQ(record_files_open_to_others(file_).size(), 9U);
  Database database(file_, OpenMode::kExisting);
  EXPECT_EQ(rights(), (std::vector<std::string>{
                          "other.recordings 755", "other.recordings/a 644", "t.db 600", "t.db-shm 600", "t.db-wal 600",
                          "t.db.anchor 600", "t.db.key 600", "t.db.schema3.backup 600", "t.db2 664", "t.films 700",
                          "t.films/a 600", "t.live 700", "t.live/a 600", "t.recordings 700", "t.recordings/a 600"}));
  EXPECT_TRUE(record_files_open_to_others(file_).empty());
  EXPECT_EQ(fs::status(folder_).permissions(), fs::perms(0755)) << "the folder is its owner's own affair";
}

TEST_F(RecordFiles, OfSomebodyElseStayAsTheyAre) {
  { Database database(file_); }
  if (getuid() != 0) GTEST_SKIP() << "only root can give a file away";
  fs::permissions(file_, fs::perms(0644));
  ASSERT_EQ(chown(file_.c_str(), 65534, 65534), 0);
  { Database database(file_, OpenMode::kExisting); }
  EXPECT_EQ(fs::status(file_).permissions(), fs::perms(0644));
}

TEST_F(RecordFiles, ThatAreNoDatabaseOfOursAreNotTouched) {
  std::ofstream(file_) << std::string(2000, 'x');
  fs::permissions(file_, fs::perms(0644));
  EXPECT_THROW(Database database(file_), InputError);
  EXPECT_EQ(fs::status(file_).permissions(), fs::perms(0644));
}

}  // namespace
}  // namespace trocar::record_files_test
