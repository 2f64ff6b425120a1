// Recordings go only when asked, whole or not at all, in pieces, and with their person.
#include <fstream>
#include <iterator>
#include <random>

#include "haptics/digest/digest.h"
#include "tests/trainees/exchange/sync/cutting_proxy.h"
#include "tests/trainees/exchange/sync/stations.h"
#include "trainees/records/erasure.h"
#include "trainees/records/replica_facts.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar::recordings_sync_test {
namespace {

namespace fs = std::filesystem;

using test::CuttingProxy;
using test::kTeacher;
using test::Stations;
using Lines = std::vector<std::string>;

class Recordings : public Stations {
 protected:
  void SetUp() override {
    Stations::SetUp();
    if (IsSkipped()) return;
    Database north = station("north");
    small_ = recorded(north, "T-a", 5000);
    large_ = recorded(north, "T-b", 2500000);  // three pieces
    PushOptions options{central_};
    options.station_name = "north";
    push_to_central(north, options);
  }
  /// An attempt with a recording of so many bytes.
  AttemptId recorded(Database& database, const std::string& code, std::size_t bytes) {
    const AttemptStore reading(database);
    const AttemptId id = AttemptStore(database).begin_attempt(sample_start(code));
    fs::create_directories(id.recording.parent_path());
    std::mt19937 random(static_cast<unsigned>(bytes));
    std::string text(bytes, '\0');
    for (char& c : text) c = static_cast<char>(random());
    std::ofstream(id.recording, std::ios::binary) << text;
    AttemptResult result = sample_result();
    result.recording_sha256 = digest::of_readable_file(id.recording);
    AttemptStore(database).finish_attempt(id, result);
    return id;
  }
  PushReport push_recorded(const CentralAddress& to) {
    Database north = station("north");
    PushOptions options{to};
    options.recordings = true;
    return push_to_central(north, options);
  }
  Database desk_with_recordings(const std::string& name = "desk") {
    Database database = station(name);
    EXPECT_EQ(replicate_central(database, {central_, true}).problems, Lines{});
    EXPECT_EQ(problems_of(database), "");
    return database;
  }
  static std::string bytes_of(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  AttemptId small_, large_;
};

TEST_F(Recordings, StayAtTheStationUnlessAskedFor) {
  EXPECT_EQ(one("SELECT count(*) FROM recording"), "0");
  Database copy = desk_with_recordings();
  const AttemptResult result = AttemptStore(copy).load(small_.uuid);
  EXPECT_NE(result.recording_path, "");
  EXPECT_FALSE(fs::exists(fetched_recording(copy.file(), small_.uuid)));
  EXPECT_EQ(station_of_attempt(copy, small_.uuid), "north");
  Database north = station("north");
  EXPECT_EQ(station_of_attempt(north, small_.uuid), "");
}

TEST_F(Recordings, ArriveByteForByteForTheDeskAlone) {
  EXPECT_EQ(push_recorded(central_).added.at("recording"), 2);
  EXPECT_FALSE(push_recorded(central_).added.contains("recording"));
  EXPECT_EQ(one("SELECT max(length(data)), count(*) FROM recording_chunk"), "1048576|4");
  // Beside north.db they are found where they are: the desk is on another machine.
  fs::create_directories(folder_ / "elsewhere");
  Database copy = desk_with_recordings("elsewhere/desk");
  for (const AttemptId& id : {small_, large_}) {
    const fs::path file = AttemptStore(copy).load(id.uuid).recording_path;
    EXPECT_EQ(file, fetched_recording(copy.file(), id.uuid));
    EXPECT_EQ(bytes_of(file), bytes_of(id.recording));
    EXPECT_EQ(fs::status(file).permissions() & (fs::perms::group_all | fs::perms::others_all), fs::perms::none);
  }
  EXPECT_FALSE(replicate_central(copy, {central_, true}).added.contains("recording"));
}

TEST_F(Recordings, GoOnWhereTheLineWasCut) {
  CuttingProxy proxy(server_);
  const CentralAddress there = proxy.through(central_);
  int lost = 0;
  for (const long bytes : {20000L, 2300000L, 2300000L, 4000000L}) {
    proxy.cut_after(bytes);
    lost += !message_of<EnvironmentError>([&] { push_recorded(there); }).empty();
    EXPECT_LE(std::stoi(one("SELECT count(*) FROM recording WHERE complete")), 2);
  }
  EXPECT_GE(lost, 2);
  proxy.mend();
  push_recorded(there);
  EXPECT_EQ(one("SELECT count(*) FROM recording WHERE complete"), "2");
  fs::create_directories(folder_ / "elsewhere");
  Database copy = station("elsewhere/desk");
  for (const long bytes : {60000L, 2300000L, 2400000L}) {
    proxy.cut_after(bytes);
    message_of<EnvironmentError>([&] { replicate_central(copy, {there, true}); });
    for (const AttemptId& id : {small_, large_}) {
      const fs::path file = fetched_recording(copy.file(), id.uuid);
      if (!fs::exists(file)) continue;
      EXPECT_EQ(bytes_of(file), bytes_of(id.recording)) << "never half of one under its name";
    }
  }
  proxy.mend();
  replicate_central(copy, {there, true});
  for (const AttemptId& id : {small_, large_})
    EXPECT_EQ(bytes_of(fetched_recording(copy.file(), id.uuid)), bytes_of(id.recording));
}

TEST_F(Recordings, ThatWereChangedAreNotPushedAndNotTaken) {
  std::ofstream(small_.recording, std::ios::app) << "x";
  const PushReport pushed = push_recorded(central_);
  ASSERT_EQ(pushed.problems.size(), 1u);
  EXPECT_NE(pushed.problems[0].find("is not what attempt " + small_.uuid + " recorded"), std::string::npos)
      << pushed.problems[0];
  ask("UPDATE recording_chunk SET data = decode('00', 'hex') WHERE position = 1 RETURNING 1");
  fs::create_directories(folder_ / "elsewhere");
  Database copy = station("elsewhere/desk");
  const PullReport pulled = replicate_central(copy, {central_, true});
  ASSERT_EQ(pulled.problems.size(), 1u);
  EXPECT_NE(pulled.problems[0].find("what the centre has is not what was recorded"), std::string::npos)
      << pulled.problems[0];
  EXPECT_FALSE(fs::exists(fetched_recording(copy.file(), large_.uuid)));
}

TEST_F(Recordings, GoWithTheirPersonEverywhere) {
  push_recorded(central_);
  fs::create_directories(folder_ / "elsewhere");
  Database copy = desk_with_recordings("elsewhere/desk");
  const fs::path there = fetched_recording(copy.file(), large_.uuid);
  ASSERT_TRUE(fs::exists(there));
  Database north = station("north");
  erase_trainee(north, "T-b", ErasureKind::kTraining, "request of the person", kTeacher);
  EXPECT_FALSE(fs::exists(large_.recording));
  push_recorded(central_);
  EXPECT_EQ(one("SELECT count(*) FROM recording"), "1");
  EXPECT_EQ(one("SELECT count(*) FROM recording_chunk"), "1") << "T-a's";
  replicate_central(copy, {central_, true});
  EXPECT_FALSE(fs::exists(there));
  EXPECT_TRUE(fs::exists(fetched_recording(copy.file(), small_.uuid)));
}

TEST_F(Recordings, OfSomebodyWhoWasErasedElsewhereDoNotComeBack) {
  Database north = station("north");
  north.backup(folder_ / "south.db");
  Database south = station("south");
  erase_trainee(south, "T-b", ErasureKind::kTraining, "request of the person", kTeacher);
  PushOptions options{central_};
  options.new_station = true;
  options.station_name = "south";
  push_to_central(south, options);
  push_recorded(central_);  // the north has not heard
  EXPECT_EQ(one("SELECT count(*) FROM recording"), "1");
}

}  // namespace
}  // namespace trocar::recordings_sync_test
