// Programs that tell and a desk that looks: two at once, one that dies, one that is stopped, files that are none.
#include "trainees/live/live_stations.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <thread>

#include "haptics/input_error.h"
#include "tests/tissue/support/temporary_folder.h"
#include "trainees/live/live_clock.h"
#include "trainees/live/live_folder.h"
#include "trainees/live/live_publisher.h"

namespace trocar::live_stations_test {
namespace {

namespace fs = std::filesystem;
using State = LiveStation::State;

LiveMoment moment(const std::string& trainee, const std::string& phase = "running", double force_n = 0.5) {
  LiveMoment out;
  out.program = "test";
  out.trainee = trainee;
  out.attempt = "a-" + trainee;
  out.phase = phase;
  out.force_n = force_n;
  return out;
}

template <typename Condition>
bool comes(const Condition& condition) {
  for (int i = 0; i < 1500; ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

/// Another program that tells of `trainee` until it is killed.
class Program {
 public:
  Program(const fs::path& database, const std::string& trainee) {
    pid_ = ::fork();
    if (pid_ != 0) return;
    LivePublisher publisher(database);
    for (int i = 0;; ++i) {
      publisher.tell(moment(trainee, "running", 0.001 * i));
      ::usleep(20000);
    }
  }
  ~Program() { kill(SIGKILL); }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;
  void signal(int which) const { ::kill(pid_, which); }
  void kill(int which) {
    if (pid_ <= 0) return;
    ::kill(pid_, which);
    ::waitpid(pid_, nullptr, 0);
    pid_ = 0;
  }
  pid_t pid() const { return pid_; }

 private:
  pid_t pid_ = 0;
};

class LiveStationsTest : public testing::Test {
 protected:
  LiveStations look() const { return look_at_stations(database_); }
  bool shown(const std::string& trainee, State state) const {
    for (const LiveStation& station : look().stations)
      if (station.told.moment.trainee == trainee && station.state == state) return true;
    return false;
  }
  void age(const fs::path& file, double by_s) const {
    fs::last_write_time(file, fs::file_time_type::clock::now() - std::chrono::seconds(static_cast<int>(by_s)));
  }

  test::TemporaryFolder folder_;
  fs::path database_ = folder_.path() / "ward.db", live_ = folder_.path() / "ward.live";
};

TEST_F(LiveStationsTest, WhatIsToldIsSeenAndGoesWithTheProgram) {
  EXPECT_TRUE(look().stations.empty());
  {
    LivePublisher publisher(database_);
    publisher.tell(moment("T-7"));
    ASSERT_TRUE(comes([&] { return shown("T-7", State::kRunning); }));
    const LiveStation station = look().stations.at(0);
    EXPECT_EQ(station.told.process.pid, ::getpid());
    EXPECT_EQ(station.told.machine, machine_name());
    EXPECT_EQ(station.told.moment.force_n, 0.5);
  }
  EXPECT_TRUE(look().stations.empty());
  EXPECT_TRUE(look().unreadable.empty());
}

TEST_F(LiveStationsTest, NumbersAreWrittenOnlyWhileSomebodyLooksAndNewsAlways) {
  LivePublisher publisher(database_);
  const LiveFolder folder(database_, LiveFolder::Open::kExisting);
  const auto written = [&] {
    const std::vector<std::string> names = folder.names();
    const auto text = names.empty() ? std::nullopt : folder.read(names.front());
    return text ? parse_live_text(*text) : std::nullopt;
  };
  publisher.tell(moment("T-7", "running", 0.5));
  ASSERT_TRUE(comes([&] { return written().has_value(); }));
  publisher.tell(moment("T-7", "running", 0.75));
  std::this_thread::sleep_for(std::chrono::milliseconds(1500));
  EXPECT_EQ(written()->moment.force_n, 0.5) << "nobody looks";
  EXPECT_FALSE(publisher.wanted());
  publisher.tell(moment("T-7", "paused", 1.0));
  EXPECT_TRUE(comes([&] { return written()->moment.phase == "paused"; }));
  look();
  EXPECT_TRUE(comes([&] { return publisher.wanted(); }));
  publisher.tell(moment("T-7", "paused", 1.25));
  EXPECT_TRUE(comes([&] { return written()->moment.force_n == 1.25; }));
}

TEST_F(LiveStationsTest, APictureComesWhileSomebodyLooksAndGoesWithTheProgram) {
  const std::string jpeg = "\xFF\xD8 a picture";
  {
    LivePublisher publisher(database_);
    publisher.tell(moment("T-7"));
    ASSERT_TRUE(comes([&] { return fs::exists(live_); }));
    EXPECT_FALSE(publisher.picture_wanted()) << "nobody has looked";
    look();
    ASSERT_TRUE(comes([&] { return publisher.picture_wanted(); }));
    EXPECT_FALSE(publisher.picture_wanted()) << "one at a time";
    publisher.show([] { return std::string(LiveFolder::kLargest + 1, 'x'); });
    publisher.show([&jpeg] { return jpeg; });
    ASSERT_TRUE(comes([&] { return !look().stations.at(0).picture.empty(); }));
    const std::string name = look().stations.at(0).picture;
    EXPECT_EQ(look_at_picture(database_, name), jpeg);
    age(live_ / name, 60);
    EXPECT_EQ(look().stations.at(0).picture, "") << "not of this moment";
    std::ofstream(live_ / name) << "<svg/>";
    EXPECT_EQ(look_at_picture(database_, name), std::nullopt) << "no JPEG";
    publisher.show([]() -> std::string { throw EnvironmentError("no picture"); });
  }
  EXPECT_TRUE(fs::is_empty(live_) || LiveFolder(database_, LiveFolder::Open::kExisting).names().empty());
  for (const auto& entry : fs::directory_iterator(live_)) EXPECT_NE(entry.path().extension(), ".jpg");
}

TEST_F(LiveStationsTest, APictureIsNothingElseThanAPictureOfTheFolder) {
  LiveFolder folder(database_, LiveFolder::Open::kMake);
  ASSERT_TRUE(folder.write("a.json", "\xFF\xD8 no picture"));
  for (const char* name : {"a.json", "../ward.db", "..", "", ".jpg", "/etc/passwd", "b.jpg"})
    EXPECT_EQ(look_at_picture(database_, name), std::nullopt) << name;
}

TEST_F(LiveStationsTest, TwoProgramsAndTwoInOneAreFour) {
  Program other(database_, "T-1"), another(database_, "T-2");
  LivePublisher here(database_), here_too(database_);
  here.tell(moment("T-3"));
  here_too.tell(moment("T-4"));
  ASSERT_TRUE(comes([&] { return look().stations.size() == 4; }));
  std::vector<std::string> codes;
  for (const LiveStation& station : look().stations) codes.push_back(station.told.moment.trainee);
  EXPECT_EQ(codes, (std::vector<std::string>{"T-1", "T-2", "T-3", "T-4"}));
}

TEST_F(LiveStationsTest, AKilledProgramHasEndedUnexpectedlyAndIsForgottenInTime) {
  Program program(database_, "T-1");
  ASSERT_TRUE(comes([&] { return shown("T-1", State::kRunning); }));
  program.kill(SIGKILL);
  EXPECT_TRUE(shown("T-1", State::kEnded));
  const std::string name = LiveFolder(database_, LiveFolder::Open::kExisting).names().at(0);
  age(live_ / name, LivePublisher::kLeftFor_s + 60);
  EXPECT_TRUE(look().stations.empty());
  const LivePublisher next(database_);
  EXPECT_FALSE(fs::exists(live_ / name)) << "the next program takes it away";
}

TEST_F(LiveStationsTest, AnotherProcessOfTheSameNumberIsNotTakenForIt) {
  LiveFolder folder(database_, LiveFolder::Open::kMake);
  StatusSnapshot told;
  told.moment = moment("T-1");
  told.process = this_process();
  told.machine = machine_name();
  told.told_s = since_boot_s();
  ASSERT_TRUE(folder.write("a.json", live_text(told)));
  EXPECT_TRUE(shown("T-1", State::kRunning));
  told.process.start -= 100;
  ASSERT_TRUE(folder.write("a.json", live_text(told)));
  EXPECT_TRUE(shown("T-1", State::kEnded));
}

TEST_F(LiveStationsTest, AProgramThatStandsStillDoesNotAnswer) {
  Program program(database_, "T-1");
  ASSERT_TRUE(comes([&] { return shown("T-1", State::kRunning); }));
  program.signal(SIGSTOP);
  EXPECT_TRUE(comes([&] { return shown("T-1", State::kQuiet); }));
  EXPECT_FALSE(shown("T-1", State::kEnded));
  program.signal(SIGCONT);
  EXPECT_TRUE(comes([&] { return shown("T-1", State::kRunning); }));
}

TEST_F(LiveStationsTest, OldNewsOfAProgramThatNobodyLookedAtIsNotSilence) {
  LiveFolder folder(database_, LiveFolder::Open::kMake);
  StatusSnapshot told;
  told.moment = moment("T-1");
  told.process = this_process();
  told.machine = machine_name();
  told.told_s = since_boot_s() - 3000;
  ASSERT_TRUE(folder.write("a.json", live_text(told)));
  const LiveStations first = look();
  ASSERT_EQ(first.stations.size(), 1u);
  EXPECT_EQ(first.stations[0].state, State::kRunning) << "it was not asked before";
  EXPECT_NEAR(first.stations[0].age_s, 3000, 60);
  EXPECT_TRUE(shown("T-1", State::kQuiet)) << "now it was, and has not answered";
}

TEST_F(LiveStationsTest, AProgramOfAnotherMachineIsJudgedByItsSilenceAlone) {
  LiveFolder folder(database_, LiveFolder::Open::kMake);
  StatusSnapshot told;
  told.moment = moment("T-9");
  told.process = {4, "another boot", 5};
  told.machine = "another-" + machine_name();
  ASSERT_TRUE(folder.write("a.json", live_text(told)));
  EXPECT_TRUE(shown("T-9", State::kRunning));
  age(live_ / "a.json", 60);
  EXPECT_TRUE(shown("T-9", State::kQuiet));
}

TEST_F(LiveStationsTest, GarbageLinksAndForeignFilesAreNamedAndNeverShown) {
  LivePublisher publisher(database_);
  publisher.tell(moment("T-7"));
  ASSERT_TRUE(comes([&] { return shown("T-7", State::kRunning); }));
  LiveFolder folder(database_, LiveFolder::Open::kExisting);
  ASSERT_TRUE(folder.write("!garbage.json", "{\"form\":"));
  const std::string secret = live_text({moment("T-secret"), this_process(), machine_name(), "", "", since_boot_s()});
  std::ofstream(folder_.path() / "secret") << secret;
  ::chmod((folder_.path() / "secret").c_str(), 0600);
  fs::create_symlink(folder_.path() / "secret", live_ / "!link.json");
  std::ofstream(live_ / "!wide.json") << secret;
  ::chmod((live_ / "!wide.json").c_str(), 0666);
  const LiveStations seen = look();
  ASSERT_EQ(seen.stations.size(), 1u);
  EXPECT_EQ(seen.stations[0].told.moment.trainee, "T-7");
  EXPECT_EQ(seen.unreadable, (std::vector<std::string>{"!garbage.json", "!link.json", "!wide.json"}));
}

TEST_F(LiveStationsTest, AFolderThatCannotBeUsedHindersNobody) {
  fs::create_directory(live_);
  ::chmod(live_.c_str(), 0777);
  {
    LivePublisher publisher(database_);
    publisher.tell(moment("T-7"));
    EXPECT_FALSE(publisher.wanted());
  }
  EXPECT_TRUE(fs::is_empty(live_));
  EXPECT_NE(look().refusal, "");
  LivePublisher nowhere(folder_.path() / "none" / "x.db"), memory(":memory:"), nothing("");
  for (LivePublisher* one : {&nowhere, &memory, &nothing}) one->tell(moment("T-7"));
}

}  // namespace
}  // namespace trocar::live_stations_test
