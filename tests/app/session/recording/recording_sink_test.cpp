// The file of a recording is created by its own attempt and by no other: two at once with one name, a name that is
// taken, a device instead of a file.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "app/session/recording/recording_sink.h"
#include "haptics/input_error.h"
#include "tests/tissue/support/temporary_folder.h"

namespace trocar::recording_sink_test {
namespace {

std::string bytes_of(const std::filesystem::path& file) {
  std::ostringstream bytes;
  bytes << std::ifstream(file, std::ios::binary).rdbuf();
  return bytes.str();
}

TEST(RecordingSink, TheSecondOfTwoIsTurnedAwayAndTheFirstIsWhole) {
  test::TemporaryFolder folder;
  const std::filesystem::path file = folder / "two.trec";
  FileSink first(file);
  first.append("first");
  EXPECT_THROW(FileSink{file}, EnvironmentError);
  first.append(" and more");
  first.sync();
  EXPECT_EQ(bytes_of(file), "first and more");
}

TEST(RecordingSink, AFileThatIsThereIsLeftAlone) {
  test::TemporaryFolder folder;
  std::ofstream(folder / "old.trec") << "precious";
  try {
    FileSink sink(folder / "old.trec");
    ADD_FAILURE() << "written over";
  } catch (const EnvironmentError& error) {
    EXPECT_NE(std::string(error.what()).find("old.trec"), std::string::npos) << error.what();
  }
  EXPECT_EQ(bytes_of(folder / "old.trec"), "precious");
}

TEST(RecordingSink, ADeviceMayStandThere) {
  FileSink sink("/dev/null");
  EXPECT_NO_THROW(sink.append("nothing is kept"));
}

TEST(RecordingSink, MakesItsFolder) {
  test::TemporaryFolder folder;
  FileSink sink(folder / "a" / "b" / "c.trec");
  sink.append("x");
  EXPECT_EQ(bytes_of(folder / "a" / "b" / "c.trec"), "x");
}

}  // namespace
}  // namespace trocar::recording_sink_test
