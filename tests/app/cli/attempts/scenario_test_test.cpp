// Scripted attempts with expectations: what is read, what is refused and where, what is found wanting.
#include "app/cli/attempts/scenario_test.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <sstream>

#include "app/cli/attempts/test_command.h"
#include "haptics/input_error.h"
#include "tests/tissue/support/temporary_folder.h"

namespace trocar::scenario_test_test {
namespace {

using test::message_of;

const std::string kIdle =
    "name = \"idle\"\n"
    "[run]\n"
    "exercise = \"reach-and-orient\"\n"
    "hand = \"idle\"\n"
    "inject = [\"encoder-jump:2@1\"]\n"  // over after a second
    "[expect]\n";

class ScenarioTests : public testing::Test {
 protected:
  std::filesystem::path file(const std::string& expect, const std::string& name = "a.test.toml") const {
    folder_.write(name, kIdle + expect);
    return folder_ / name;
  }
  ScenarioTest read(const std::string& expect) const { return read_scenario_test(file(expect), find_assets()); }
  std::string refusal(const std::string& expect) const {
    const std::string message = message_of<InputError>([&] { read(expect); });
    const std::string path = (folder_ / "a.test.toml").string();
    EXPECT_EQ(message.find(path), 0u) << message;
    return message.substr(std::min(message.size(), path.size()));
  }
  test::TemporaryFolder folder_;
};

AttemptResult result() {
  AttemptResult out;
  out.grade.status = AttemptStatus::kCompleted;
  out.grade.score = 80;
  out.grade.passed = true;
  out.grade.metrics = {{"time_s", 30, "s"}, {"path_ratio", std::nullopt, "1"}};
  out.grade.subscores.emplace_back();
  out.grade.subscores.back().name = "time";
  out.grade.subscores.back().value = 0.5;
  for (const auto& [t, type] : {std::pair{2.0, "START"}, {5.0, "TARGET_HELD"}, {7.0, "TARGET_HELD"}}) {
    Event event;
    event.t_s = t;
    event.type = type;
    out.events.push_back(event);
  }
  return out;
}

TEST_F(ScenarioTests, ReadARunAndWhatMustComeOfIt) {
  const ScenarioTest test = read(
      "status = \"completed\"\npassed = true\nscore = [75, 100]\ncaps = [0, 0]\nfault = \"none\"\n"
      "[[expect.events]]\ntype = \"TARGET_HELD\"\ncount = [2, 2]\nfirst_s = [2, 4]\n"
      "[[expect.metrics]]\nname = \"time_s\"\nbetween = [20, 40]\n"
      "[[expect.subscores]]\nname = \"time\"\nbetween = [0.5, 0.5]\n");
  EXPECT_EQ(test.name, "idle");
  EXPECT_EQ(test.run.hand, "idle");
  EXPECT_EQ(test.run.level, "L1");
  EXPECT_EQ(unmet(test, result()), std::vector<std::string>{});
}

TEST_F(ScenarioTests, SayWhatCameOtherwise) {
  const ScenarioTest test = read(
      "status = \"void\"\npassed = false\nscore = [0, 59]\ncaps = [1, 3]\nfault = \"encoder-jump\"\n"
      "[[expect.events]]\ntype = \"TARGET_HELD\"\ncount = [3, 9]\nfirst_s = [4, 9]\n"
      "[[expect.events]]\ntype = \"CRUSH\"\ncount = [0, 0]\nfirst_s = [0, 1]\n"
      "[[expect.metrics]]\nname = \"path_ratio\"\nbetween = [1, 2]\n"
      "[[expect.subscores]]\nname = \"time\"\nbetween = [0.6, 1]\n");
  EXPECT_EQ(
      unmet(test, result()),
      (std::vector<std::string>{
          "status is completed, expected void", "fault is none, expected encoder-jump",
          "passed is true, expected false", "score is 80, expected 0 to 59", "number of caps is 0, expected 1 to 3",
          "number of TARGET_HELD is 2, expected 3 to 9", "time of the first TARGET_HELD is 3, expected 4 to 9",
          "time of the first CRUSH is not defined, expected 0 to 1", "path_ratio is not defined, expected 1 to 2",
          "sub-score time is 0.5, expected 0.6 to 1"}));
  AttemptResult none = result();
  none.grade.score.reset();
  EXPECT_EQ(unmet(read("score = [0, 100]\n"), none),
            std::vector<std::string>{"score is not defined, expected 0 to 100"});
}

TEST_F(ScenarioTests, RefuseWhatCouldNotFailOrIsMisspelled) {
  EXPECT_NE(refusal("").find(":6:1: [expect] expects nothing: such a test cannot fail"), std::string::npos);
  EXPECT_NE(refusal("stauts = \"void\"\n").find("did you mean 'status'?"), std::string::npos);
  EXPECT_NE(refusal("status = \"viod\"\n").find(":7:10: "), std::string::npos);
  EXPECT_NE(refusal("score = [90, 80]\n").find(":7:9: 'score' must be [low, high]"), std::string::npos);
  EXPECT_NE(refusal("[[expect.events]]\ntype = \"CRUHS\"\ncount = [0, 0]\n").find("did you mean 'CRUSH'?"),
            std::string::npos);
  EXPECT_NE(refusal("[[expect.metrics]]\nname = \"tiem_s\"\nbetween = [0, 1]\n").find("did you mean 'time_s'?"),
            std::string::npos);
  EXPECT_NE(refusal("[[expect.subscores]]\nname = \"crushed\"\nbetween = [0, 1]\n").find("'name' is \"crushed\""),
            std::string::npos)
      << "E01 has no such sub-score";
}

TEST_F(ScenarioTests, AreRunAsAFolderWithOneLineEachAndXmlForCi) {
  file("status = \"fault\"\nfault = \"encoder-jump\"\n", "good.test.toml");
  file("passed = true\n", "fails.test.toml");
  std::filesystem::create_directory(folder_ / "deeper");
  folder_.write("deeper/bad.test.toml", "name = \"<bad> & more\"\n");
  folder_.write("notes.toml", "no test");
  TestOptions options;
  options.paths = {folder_.path()};
  options.junit = folder_ / "out.xml";
  std::ostringstream out, err;
  EXPECT_EQ(test_command(options, out, err), 2);
  const std::string said = out.str();
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 5) << said;
  EXPECT_NE(said.find("good.test.toml: idle  ("), std::string::npos);
  EXPECT_NE(said.find("passed is false, expected true"), std::string::npos);
  EXPECT_LT(said.find("BAD "), said.find("FAIL")) << "in the order of the files";
  EXPECT_LT(said.find("FAIL"), said.find("pass "));
  EXPECT_NE(err.str().find("1 of 3 passed, on the simulated plant"), std::string::npos);
  std::ifstream written(folder_ / "out.xml");
  const std::string xml{std::istreambuf_iterator<char>(written), {}};
  EXPECT_NE(xml.find("tests=\"3\" failures=\"1\" errors=\"1\""), std::string::npos) << xml;
  EXPECT_NE(xml.find("<failure message=\"passed is false, expected true\">"), std::string::npos) << xml;
  options.filter = "good";
  options.junit.clear();
  EXPECT_EQ(test_command(options, out, err), 0);
  options.filter = "fails";
  EXPECT_EQ(test_command(options, out, err), 1);
  options.filter = "nothing like it";
  EXPECT_NE(message_of<InputError>([&] { test_command(options, out, err); }).find("no test has this"),
            std::string::npos);
  options.paths = {folder_ / "missing"};
  EXPECT_NE(message_of<InputError>([&] { test_command(options, out, err); }).find("no such file or folder"),
            std::string::npos);
}

TEST(ShippedScenarioTests, AllPass) {
  TestOptions options;
  options.paths = {std::filesystem::path(TROCAR_SOURCE_DIR) / "scenarios/tests"};
  std::ostringstream out, err;
  EXPECT_EQ(test_command(options, out, err), 0) << out.str();
}

}  // namespace
}  // namespace trocar::scenario_test_test
