// `trocar check` and `trocar doctor` in words and JSON, and the seeds of a sweep.
#include "app/cli/attempts/check_command.h"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "app/cli/machine/doctor_command.h"
#include "app/cli/machine/doctor_probes.h"
#include "app/cli/sweep/sweep_command.h"
#include "haptics/input_error.h"
#include "tests/app/cli/command_samples.h"
#include "tests/tissue/support/temporary_folder.h"
#include "trainees/store/database.h"

namespace trocar::check_command_test {
namespace {

using Json = nlohmann::json;
using test::message_of;
using test::TemporaryFolder;
using testing_support::small_exercise;

constexpr const char* kFarPort = "mapping = \"fulcrum\"\nport_mm = [210, 158, 60]";

struct Said {
  int code = 0;
  std::string out, err;
};

Said check(const std::vector<std::string>& subjects, int unseen = 0, bool json = false) {
  CheckOptions options;
  options.subjects = subjects;
  options.unseen = unseen;
  options.json = json;
  std::ostringstream out, err;
  const int code = check_command(options, out, err);
  return {code, out.str(), err.str()};
}

TEST(CheckText, ASoundExerciseIsSaidLevelByLevel) {
  const TemporaryFolder folder;
  const Said said = check({folder.write("small.toml", small_exercise()).string()}, 2);
  EXPECT_EQ(said.code, 0) << said.out;
  EXPECT_EQ(said.err, "");
  EXPECT_EQ(said.out.find("small-touch L1 (direct): sound\n  22 boards; worst joint margin "), 0u) << said.out;
  EXPECT_CONTAINS(said.out, "\nsmall-touch exam (direct): sound\n");
  EXPECT_EQ(said.out.find("handle to port"), std::string::npos) << "there is no port";
  EXPECT_CONTAINS(said.out, " N at its 5th percentile\n");
}

TEST(CheckText, APortThatCannotBeUsedSaysTheBoardAndTheDistance) {
  const TemporaryFolder folder;
  const Said said = check({folder.write("aside.toml", small_exercise(kFarPort)).string()});
  EXPECT_EQ(said.code, 2);
  EXPECT_EQ(said.out.find("small-touch L1 (fulcrum): NOT sound: board "), 0u) << said.out;
  EXPECT_CONTAINS(said.out, ": the handle comes too near to the port\n");
  EXPECT_CONTAINS(said.out, ", handle to port ");
}

TEST(CheckText, AForceBeyondTheMotorsIsTheReasonGiven) {
  const TemporaryFolder folder;
  std::string text = small_exercise("mapping = \"direct\"", 30);
  const Said scaled = check({folder.write("scaled.toml", text).string()});
  EXPECT_EQ(scaled.code, 0) << "auto scales it down: " << scaled.out;
  text.replace(text.find("\"auto\""), 6, "1.0");
  const Said said = check({folder.write("hard.toml", text).string()});
  EXPECT_EQ(said.code, 2);
  EXPECT_CONTAINS(said.out, "NOT sound: board 0: gravity and the hard limit ask more torque than a motor can give\n");
}

TEST(CheckPlayed, TheExpertPlaysEachPracticeBoardOnceAndNamesThoseThatHeDoesNotPass) {
  const TemporaryFolder folder;
  const char* kept = std::getenv("XDG_CACHE_HOME");
  const std::string before = kept ? kept : "";
  ::setenv("XDG_CACHE_HOME", folder.path().c_str(), 1);
  std::string text = small_exercise();
  CheckOptions options;
  options.subjects = {folder.write("hasty.toml", text).string()};
  options.unseen = 0;
  options.levels = {"L1"};
  options.play = true;
  options.json = true;
  std::ostringstream json, out, again, err;
  EXPECT_EQ(check_command(options, json, err), 2);
  const Json proofs = Json::parse(json.str());
  ASSERT_EQ(proofs.size(), 1U) << "one level was asked for";
  EXPECT_EQ(proofs[0].at("sound"), true) << "the device can; the time is short";
  const Json played = proofs[0].at("played");
  EXPECT_EQ(played.at("sound"), false);
  EXPECT_EQ(played.at("why"), "board 0: the expert ended it timeout (and 19 more)");
  EXPECT_EQ(played.at("boards").at(19).at("status"), "timeout");
  const auto recordings = [&] {
    std::set<std::filesystem::path> all;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path() / "trocar")) all.insert(entry.path());
    return all;
  };
  EXPECT_EQ(recordings().size(), 20U);
  text.replace(text.find("time_limit_s = 3"), 16, "time_limit_s = 60");
  options.subjects = {folder.write("small.toml", text).string()};
  options.json = false;
  EXPECT_EQ(check_command(options, out, err), 0) << out.str() << err.str();
  EXPECT_CONTAINS(out.str(), "  played by the expert on the simulated plant: 20 boards, ");
  const auto made = recordings();
  EXPECT_EQ(made.size(), 40U);
  EXPECT_EQ(check_command(options, again, err), 0);
  EXPECT_EQ(again.str(), out.str());
  EXPECT_EQ(recordings(), made) << "what was played is kept";
  options.levels = {"L7"};
  EXPECT_EQ(check_command(options, json, err), 2);
  EXPECT_CONTAINS(err.str(), "L7");
  if (kept)
    ::setenv("XDG_CACHE_HOME", before.c_str(), 1);
  else
    ::unsetenv("XDG_CACHE_HOME");
}

TEST(CheckText, AnUnknownSubjectDoesNotHideTheNext) {
  const TemporaryFolder folder;
  const Said said = check({"surface-tuch", folder.write("small.toml", small_exercise()).string()});
  EXPECT_EQ(said.code, 2) << "although the one that is known is sound";
  EXPECT_EQ(said.err.find("trocar: "), 0u);
  EXPECT_CONTAINS(said.err, "surface-tuch");
  EXPECT_CONTAINS(said.err, "surface-touch");
  EXPECT_CONTAINS(said.out, "small-touch L1 (direct): sound");
}

TEST(CheckJson, HoldsEveryBoardAndTheReason) {
  const TemporaryFolder folder;
  const Said said = check({folder.write("small.toml", small_exercise()).string(),
                           folder.write("aside.toml", small_exercise(kFarPort)).string()},
                          3, true);
  EXPECT_EQ(said.code, 2);
  const Json json = Json::parse(said.out);
  ASSERT_EQ(json.size(), 4u) << "two levels each";
  const Json &good = json[0], &bad = json[2];
  EXPECT_EQ(good.at("exercise"), "small-touch");
  EXPECT_EQ(good.at("why"), "");
  EXPECT_TRUE(good.at("sound"));
  EXPECT_FALSE(good.at("worst").contains("handle_to_port_m"));
  ASSERT_EQ(good.at("boards").size(), 23u);
  EXPECT_EQ(good.at("boards").at(19).at("board"), 19);
  EXPECT_EQ(good.at("boards").at(22).at("board"), 1002);
  EXPECT_EQ(json[1].at("boards").at(22).at("board"), 2000002) << "the exam's own";
  double margin = 1e9;
  for (const Json& board : good.at("boards")) {
    margin = std::min(margin, board.at("worst").at("joint_margin_deg").get<double>());
  }
  EXPECT_DOUBLE_EQ(good.at("worst").at("joint_margin_deg"), margin) << "the worst of all";
  EXPECT_FALSE(bad.at("sound"));
  const auto near = [](const Json& board) {
    return board.at("worst").at("handle_to_port_m").get<double>() < ReachRules{}.handle_to_port_m;
  };
  const auto first = std::find_if(bad.at("boards").begin(), bad.at("boards").end(), near);
  ASSERT_NE(first, bad.at("boards").end());
  EXPECT_EQ(bad.at("why"), "board " + first->at("board").dump() + ": the handle comes too near to the port");
}

TEST(CheckCommand, AMapThatCannotBeWrittenIsTheMachinesFault) {
  const TemporaryFolder folder;
  CheckOptions options;
  options.subjects = {folder.write("small.toml", small_exercise()).string()};
  options.unseen = 0;
  options.map = folder / "none" / "map.svg";
  std::ostringstream out, err;
  const std::string message = message_of<EnvironmentError>([&] { check_command(options, out, err); });
  EXPECT_CONTAINS(message, "map.svg: cannot be written");
}

Said doctor(const std::filesystem::path& database, bool json) {
  std::ostringstream out, err;
  const int code = doctor_command({.database = database, .json = json}, out, err);
  return {code, out.str(), err.str()};
}

/// The finding of this name.
Json finding(const Json& json, const std::string& name) {
  for (const Json& found : json.at("findings")) {
    if (found.at("name") == name) return found;
  }
  ADD_FAILURE() << name << " is not in " << json;
  return {};
}

TEST(Doctor, JsonHasAFindingForEachThingAndLeavesNothingBehind) {
  const TemporaryFolder folder;
  const Said said = doctor(folder / "t.db", true);
  const Json json = Json::parse(said.out);
  std::vector<std::string> names;
  bool problem = false;
  for (const Json& found : json.at("findings")) {
    names.push_back(found.at("name"));
    EXPECT_TRUE((std::set<std::string>{"ok", "warning", "problem"}.count(found.at("state")))) << found;
    EXPECT_NE(found.at("text"), "") << found;
    problem = problem || found.at("state") == "problem";
  }
  EXPECT_EQ(names, (std::vector<std::string>{"version", "processors", "assets", "picture", "database", "kernel",
                                             "real-time", "memlock", "idle-states", "governor", "display", "locale",
                                             "clock", "serial", "boards", "network", "disk"}));
  EXPECT_EQ(json.at("sound"), !problem);
  EXPECT_EQ(said.code, problem ? 3 : 0);
  const std::string schema = ", database schema " + std::to_string(shipped_migrations().back().version);
  EXPECT_CONTAINS(finding(json, "version").at("text").get<std::string>(), schema);
  EXPECT_CONTAINS(finding(json, "database").at("text").get<std::string>(), "t.db: not there yet");
  EXPECT_TRUE(std::filesystem::is_empty(folder.path())) << "it looks only";
}

TEST(Doctor, SaysTheSchemaOfADatabaseAndRefusesAFileThatIsNone) {
  const TemporaryFolder folder;
  { Database database(folder / "t.db"); }
  const std::string schema = "schema " + std::to_string(shipped_migrations().back().version);
  const Json good = finding(Json::parse(doctor(folder / "t.db", true).out), "database");
  EXPECT_EQ(good.at("state"), "ok");
  EXPECT_CONTAINS(good.at("text").get<std::string>(), schema);
  const Said bad = doctor(folder.write("text.db", "this is no database, only some words in a file\n"), false);
  EXPECT_EQ(bad.code, 3);
  EXPECT_CONTAINS(bad.out, "problem  database    ");
  EXPECT_CONTAINS(bad.out, "text.db");
}

TEST(Doctor, TheRoomIsThatOfTheNearestFolderThatExists) {
  const TemporaryFolder folder;
  const Json disk = finding(Json::parse(doctor(folder / "a" / "b" / "t.db", true).out), "disk");
  EXPECT_CONTAINS(disk.at("text").get<std::string>(), " MiB free in " + folder.path().string() + ", about ");
}

/// State and text of a finding with this --card.
Json card_finding(const std::string& card, const std::string& name) {
  std::ostringstream out, err;
  doctor_command({.database = ":memory:", .card = card, .json = true}, out, err);
  return finding(Json::parse(out.str()), name);
}

TEST(Doctor, LooksAtBothBoardsThatTheCardNames) {
  const TemporaryFolder folder;
  const auto board = [&](const std::string& name, std::size_t bytes) {
    std::filesystem::create_directories(folder / name);
    folder.write(name + "/resource0", std::string(bytes, '\0'));
    return (folder / name).string();
  };
  const std::string first = board("0000:03:00.0", 4096), second = board("0000:03:01.0", 4096);
  std::filesystem::create_directory_symlink("/nowhere/uio_pci_generic", folder / "0000:03:01.0/driver");
  const Json sound = card_finding(first + "," + second, "boards");
  EXPECT_EQ(sound.at("state"), "ok") << sound;
  EXPECT_CONTAINS(sound.at("text").get<std::string>(), first + ": there, bound to no driver; ");
  EXPECT_CONTAINS(sound.at("text").get<std::string>(), second + ": there, bound to uio_pci_generic");
  EXPECT_NE(card_finding(first + "," + second, "network").at("state"), "problem") << "two folders are no address";
  const auto trouble = [&](const std::string& card) {
    const Json found = card_finding(card, "boards");
    EXPECT_EQ(found.at("state"), "problem") << found;
    return found.at("text").get<std::string>();
  };
  EXPECT_CONTAINS(trouble(first), "two boards are expected");
  EXPECT_CONTAINS(trouble(first + ",/nowhere/0000:09:00.0"), "/nowhere/0000:09:00.0: is not there; lspci -D");
  EXPECT_CONTAINS(trouble("/dev/uio98,/dev/uio99"), "/dev/uio99: is not there; bind the board to uio_pci_generic");
  EXPECT_CONTAINS(trouble(folder.path().string() + "," + second), "has no resource0");
  EXPECT_CONTAINS(trouble(board("small", 16) + "," + second), "too few registers");
}

TEST(Doctor, TriesWhetherTheDisplayAnswers) {
  for (const char* nobody : {":77", ":77.0", "", "0", ":", ":x", "localhost:59999", ":123456789012"})
    EXPECT_FALSE(x_answers(nobody)) << nobody;
  EXPECT_FALSE(wayland_answers("wayland-77"));
  const TemporaryFolder folder;
  const int socket = ::socket(AF_UNIX, SOCK_STREAM, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string name = "/tmp/trocar-display-" + std::to_string(::getpid());
  name.copy(address.sun_path, sizeof address.sun_path - 1);
  ASSERT_EQ(::bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  EXPECT_FALSE(wayland_answers(name)) << "a socket's file, and nobody behind it";
  ASSERT_EQ(::listen(socket, 1), 0);
  EXPECT_TRUE(wayland_answers(name));
  ::close(socket);
  std::filesystem::remove(name);
}

TEST(Doctor, ADatabaseNeedsAFolderThatCanBeWritten) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write anywhere";
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "closed");
  std::filesystem::permissions(folder / "closed",
                               std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  const Json found = finding(Json::parse(doctor(folder / "closed" / "t.db", true).out), "database");
  std::filesystem::permissions(folder / "closed", std::filesystem::perms::owner_all);
  EXPECT_EQ(found.at("state"), "problem");
  EXPECT_CONTAINS(found.at("text").get<std::string>(), "closed: is not writable; give another place");
}

using Seeds = std::pair<std::int64_t, std::int64_t>;

TEST(ParseSeeds, ARangeOrOne) {
  EXPECT_EQ(parse_range("--seeds", "1..10"), Seeds(1, 10));
  EXPECT_EQ(parse_range("--seeds", "7"), Seeds(7, 7));
  EXPECT_EQ(parse_range("--seeds", "4..4"), Seeds(4, 4));
  EXPECT_EQ(parse_range("--seeds", "-5..-2"), Seeds(-5, -2));
  EXPECT_EQ(parse_range("--seeds", "1..10000"), Seeds(1, 10000)) << "the most there may be";
}

TEST(ParseSeeds, RefusesWhatIsNoRangeNamingIt) {
  for (const char* bad : {"", "x", "1..", "..4", "..", "1...3", "1..3..5", " 1", "1 ..3", "1.5", "+1", "1-3",
                          "9223372036854775808", "1..1e3"}) {
    EXPECT_EQ(message_of<InputError>([&] { parse_range("--seeds", bad); }),
              "--seeds " + std::string(bad) + ": A..B, two whole numbers");
  }
  for (const char* bad : {"5..1", "1..10001", "-1..-2", "-5000..5000"}) {
    EXPECT_CONTAINS(message_of<InputError>([&] { parse_range("--seeds", bad); }), "A <= B, at most 10000 of them");
  }
}

TEST(SweepCommand, RefusesNoHandAnUnknownHandAndAnUnknownLevelBeforeItRuns) {
  const TemporaryFolder folder;
  SweepOptions options;
  options.plan.exercises = {folder.write("small.toml", small_exercise()).string()};
  std::ostringstream out, err;
  const auto refusal = [&] { return message_of<InputError>([&] { sweep_command(options, out, err); }); };
  options.plan.hands = {};
  EXPECT_CONTAINS(refusal(), "name at least one hand");
  options.plan.hands = {"idle", "octopus"};
  EXPECT_CONTAINS(refusal(), "octopus");
  options.plan.hands = {"idle"};
  options.plan.levels = {"L2"};
  EXPECT_CONTAINS(refusal(), "L2");
  EXPECT_EQ(out.str() + err.str(), "");
}

TEST(SweepCommand, TheTableCountsEveryAttemptOfEveryLevel) {
  const TemporaryFolder folder;
  SweepOptions options;
  options.plan.exercises = {folder.write("small.toml", small_exercise()).string()};
  options.plan.hands = {"expert"};
  options.plan.seeds = "3..4";
  options.jobs = 2;
  std::ostringstream out, err;
  const int code = sweep_command(options, out, err);
  EXPECT_TRUE(code == 0 || code == 1) << code;
  EXPECT_EQ(err.str().find("trocar: 4 attempts on the simulated plant, nothing is stored\n"), 0u) << err.str();
  EXPECT_CONTAINS(out.str(), "small.toml  L1\n");
  EXPECT_CONTAINS(out.str(), "small.toml  exam\n");
  EXPECT_CONTAINS(out.str(), "  expert         2  ");
  EXPECT_EQ(code == 1, out.str().find("NOT MET") != std::string::npos) << out.str();
}

}  // namespace
}  // namespace trocar::check_command_test
