// `trocar device fk`, `trocar device calibrate` and the device studies from outside.
#include "tests/system/system_fixture.h"

namespace trocar::test {
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
  expect_refusal({"device", "calibrate", "--out", "no/such/folder.json"}, 3, "cannot be written");
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

}  // namespace
}  // namespace trocar::test
