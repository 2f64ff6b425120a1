// `trocar device fk`, `trocar device calibrate` and the device studies from outside.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>

#include "tests/system/system_fixture.h"

namespace trocar::test::device_bench_test {
namespace {

using DeviceBench = SystemTest;

TEST_F(DeviceBench, ForwardSolutionsAreListedWithNegativeAngles) {
  const Json json = json_of({"device", "fk", "--deg", "30,20,25,-60,-50,120", "--json"}, 0);
  EXPECT_EQ(json.at("solutions").size(), 8u);
  EXPECT_EQ(json_of({"device", "fk", "--deg", "30", "20", "25", "-60", "-50", "120", "--json"}, 0), json);
}

TEST_F(DeviceBench, ForwardRefusesWhatIsNotSixAngles) {
  expect_refusal({"device", "fk"}, 2, "either --deg");
  expect_refusal({"device", "fk", "--deg", "1,2,3"}, 2, "3 angles given");
  expect_refusal({"device", "fk", "--deg", "1,2,3,4,5,left"}, 2, "--deg");
  expect_refusal({"device", "fk", "--csv", "absent.csv", "--out", "o.csv"}, 2, "absent.csv");
}

TEST_F(DeviceBench, CalibrationWritesAFileAndNamesBadInput) {
  const Json json = json_of({"device", "calibrate", "--seed", "4", "--gain", "5", "--out", "c.json", "--json"}, 0);
  EXPECT_EQ(Json::parse(file_bytes(folder_ / "c.json")), json);
  for (const Json& channel : json.at("channels")) EXPECT_NEAR(channel.at("gain_over_nominal").get<double>(), 5, 0.08);
  expect_refusal({"device", "calibrate", "--gain", "0"}, 2, "shows no torque");
  expect_refusal({"device", "calibrate", "--gain", "11"}, 2, "0 to 10");
  expect_refusal({"device", "calibrate", "--out", "no/such/folder.json"}, 2, "there is no folder no/such");
}

TEST_F(DeviceBench, SeedsBelowNothingEmptyNamesAndTimesThatAreNoneAreRefused) {
  expect_refusal({"device", "selftest", "--seed", "-1"}, 2, "--seed");
  expect_refusal({"device", "plant", "--seed", "99999999999999999999"}, 2, "--seed");
  expect_refusal({"device", "plant", "--plant", ""}, 2, "a file is asked for");
  expect_refusal({"device", "monitor", "--device", ""}, 2, "a file is asked for");
  expect_refusal({"device", "monitor", "--lockstep", "--seconds", "nan"}, 2, "--seconds");
  std::ofstream(folder_ / "taken") << "a file";
  expect_refusal({"study", "motor", "--quick", "--out", (folder_ / "taken").string()}, 3, "cannot be made a folder");
}

TEST_F(DeviceBench, StudiesInTheirQuickFormWriteTheSameBytesTwice) {
  for (const char* name : {"kinematics", "motor", "workspace"}) {
    const Json json = json_of({"study", name, "--quick", "--out", "a", "--json"}, 0);
    json_of({"study", name, "--quick", "--out", "b", "--json"}, 0);
    EXPECT_EQ(json.at("study"), name);
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / "a")) {
      EXPECT_EQ(file_bytes(entry.path()), file_bytes(folder_ / "b" / entry.path().filename())) << entry.path();
    }
  }
}

TEST_F(DeviceBench, AFolderThatCannotBeWrittenIsTheMachinesFault) {
  folder_.write("in_the_way", "a file");
  for (const char* out : {"in_the_way", "in_the_way/deep"}) {
    const Outcome outcome = trocar({"study", "motor", "--quick", "--out", out});
    EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
    EXPECT_NE(outcome.err.find("in_the_way"), std::string::npos) << "names the place: " << outcome.err;
    EXPECT_EQ(outcome.out, "");
  }
  EXPECT_EQ(file_bytes(folder_ / "in_the_way"), "a file");
}

TEST_F(DeviceBench, AStoredCalibrationIsCheckedOnItsDevice) {
  json_of({"device", "calibrate", "--seed", "2", "--gain", "5", "--out", "c.json", "--json"}, 0);
  EXPECT_EQ(trocar({"device", "calibrate", "--seed", "2", "--gain", "5", "--check", "c.json"}).exit_code, 0);
  EXPECT_EQ(trocar({"device", "calibrate", "--seed", "2", "--check", "c.json"}).exit_code, 1) << "another gain";
  folder_.write("c.json", "{\"channels\":[]}");
  expect_refusal({"device", "calibrate", "--check", "c.json"}, 2, "array of seven");
  expect_refusal({"device", "calibrate", "--check", "absent.json"}, 2, "absent.json");
}

TEST_F(DeviceBench, TablesOfForwardSolutionsFeedTheInverse) {
  // Solution 0 of each row is the device: its pose goes back to the angles it came from.
  folder_.write("q.csv", "q1_rad,q2_rad,q3_rad,q4_rad,q5_rad,q6_rad\n0.7,0.8,0.75,-0.9,-1.3,0.4\n");
  EXPECT_EQ(trocar({"device", "fk", "--csv", "q.csv", "--out", "fk.csv"}).exit_code, 0);
  const std::string table = file_bytes(folder_ / "fk.csv");
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 9) << "a header and eight solutions";
  trocar({"device", "ik", "--csv", "fk.csv", "--out", "ik.csv"});
  std::istringstream lines(file_bytes(folder_ / "ik.csv"));
  std::string line;
  bool found = false;
  while (std::getline(lines, line)) {
    std::istringstream fields(line);
    std::vector<double> numbers;
    for (std::string field; std::getline(fields, field, ',');) numbers.push_back(std::atof(field.c_str()));
    if (numbers.size() != 9 || numbers[0] != 0 || numbers[2] != 1) continue;
    found = found || (std::abs(numbers[3] - 0.7) < 1e-9 && std::abs(numbers[6] + 0.9) < 1e-9 &&
                      std::abs(numbers[8] - 0.4) < 1e-9);
  }
  EXPECT_TRUE(found) << table;
}

}  // namespace
}  // namespace trocar::test::device_bench_test
