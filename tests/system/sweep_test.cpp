// `trocar sweep` from outside: the same bytes whatever the number of jobs, checks decide the exit code.
#include "tests/system/system_fixture.h"

namespace trocar::test {
namespace {

using Sweep = SystemTest;

TEST_F(Sweep, TheNumberOfJobsDoesNotShow) {
  const Words words{"sweep", exercise_of(3, 12), "--hand", "idle," + dip(), "--level", "L1", "--seeds", "3..5", "--json"};
  Words one = words, three = words;
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
  const Json json = json_of({"sweep", exercise_of(3, 12), "--hand", "expert", "--level", "L1", "--seeds", "1", "--json"}, 1);
  EXPECT_EQ(json["met"], false);
}

TEST_F(Sweep, RefusesWhatItCannotRun) {
  expect_refusal({"sweep", "surface-touch", "--hand", "nobody"}, 2, "nobody");
  expect_refusal({"sweep", "surface-touch", "--level", "L9"}, 2, "L9");
  expect_refusal({"sweep", "surface-touch", "--seeds", "5..1"}, 2, "--seeds 5..1");
  expect_refusal({"sweep", "surface-touch", "--seeds=-9223372036854775808..9223372036854775807"}, 2, "--seeds");
  expect_refusal({"sweep", "surface-touch", "--seeds", "9223372036854775807"}, 2, "--seeds");
  expect_refusal({"sweep", "surface-touch", "--seeds", "1..x"}, 2, "two whole numbers");
  expect_refusal({"sweep", "no-such-exercise"}, 2, "no-such-exercise");
}

}  // namespace
}  // namespace trocar::test
