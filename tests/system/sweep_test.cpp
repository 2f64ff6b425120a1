// `trocar sweep` from outside: the same bytes whatever the number of jobs, checks decide the exit code.
#include "tests/system/system_fixture.h"

namespace trocar::test::sweep_test {
namespace {

using Sweep = SystemTest;

TEST_F(Sweep, TheNumberOfJobsDoesNotShow) {
  const Translator words{"sweep", exercise_of(3, 12), "--hand", "idle," + dip(), "--level",
                         "L1",    "--seeds",          "3..5",   "--json"};
  Translator one = words, three = words;
  one.insert(one.end(), {"--jobs", "1"});
  three.insert(three.end(), {"--jobs", "3"});
  const Json json = json_of(one, 0);
  EXPECT_EQ(json, json_of(three, 0));
  ASSERT_EQ(json["cells"].size(), 1u);
  const Json& cell = json["cells"][0];
  ASSERT_EQ(cell["hands"].size(), 2u);
  EXPECT_EQ(cell["hands"][0]["scores"], Json({0.0, 0.0, 0.0}));
  EXPECT_EQ(cell["checks"].size(), 2u);
}

TEST_F(Sweep, AFailedCheckIsExitCodeOne) {
  // Nobody finishes in three seconds: the expert's mean is far below its bar.
  const Json json =
      json_of({"sweep", exercise_of(3, 12), "--hand", "expert", "--level", "L1", "--seeds", "1", "--json"}, 1);
  EXPECT_EQ(json["met"], false);
}

TEST_F(Sweep, ALineThatDoesNotApplySaysSo) {
  const Translator words{"sweep", "reach-and-orient", "--hand", "heavy-handed", "--level", "L1", "--seeds", "1"};
  const Outcome text = trocar(words);
  EXPECT_EQ(text.exit_code, 0) << text.out << text.err;
  EXPECT_NE(text.out.find("  n/a      heavy-handed passes: the exercise judges no force\n"), std::string::npos)
      << text.out;
  Translator json = words;
  json.push_back("--json");
  const Json cell = json_of(json, 0)["cells"][0];
  EXPECT_EQ(cell["checks"][1]["not_asked"], "the exercise judges no force");
  EXPECT_TRUE(cell["checks"][1]["met"]);
  EXPECT_EQ(cell["without_number"], Json::array());
  EXPECT_TRUE(cell["hands"][0].contains("pass_share"));
}

TEST_F(Sweep, AWorseArmStandsBesideTheDrawnOne) {
  const Json json = json_of({"sweep", exercise_of(3, 12), "--hand", "expert", "--level", "L1", "--seeds", "1", "--arm",
                             "drawn,friction,degraded", "--json"},
                            1);
  ASSERT_EQ(json["cells"].size(), 3u);
  EXPECT_EQ(json["cells"][1]["arm"], "friction");
  EXPECT_EQ(json["cells"][1]["checks"][0]["name"], "expert: drawn arm - friction");
  EXPECT_TRUE(json["cells"][1]["checks"][0].contains("not_asked")) << "only the degraded arm must cost points";
  EXPECT_EQ(json["cells"][2]["checks"][0]["bar"], ">= 5");
  EXPECT_FALSE(json["cells"][2]["checks"][0]["met"]) << "nobody earns anything in three seconds";
  const Json turned = json_of({"sweep", exercise_of(3, 12), "--hand", "expert", "--level", "L1", "--seeds", "1",
                               "--arm", "degraded,drawn", "--json"},
                              1);
  EXPECT_EQ(turned["cells"][0]["checks"], json["cells"][2]["checks"]) << "in whatever order";
}

TEST_F(Sweep, RefusesWhatItCannotRun) {
  expect_refusal({"sweep", "surface-touch", "--hand", "nobody"}, 2, "nobody");
  expect_refusal({"sweep", "surface-touch", "--level", "L9"}, 2, "L9");
  expect_refusal({"sweep", "surface-touch", "--seeds", "5..1"}, 2, "--seeds 5..1");
  expect_refusal({"sweep", "surface-touch", "--seeds=-9223372036854775808..9223372036854775807"}, 2, "--seeds");
  expect_refusal({"sweep", "surface-touch", "--seeds", "9223372036854775807"}, 2, "--seeds");
  expect_refusal({"sweep", "surface-touch", "--seeds", "1..x"}, 2, "two whole numbers");
  expect_refusal({"sweep", "surface-touch", "--arm", "rusty"}, 2, "--arm rusty");
  expect_refusal({"sweep", "no-such-exercise"}, 2, "no-such-exercise");
}

}  // namespace
}  // namespace trocar::test::sweep_test
