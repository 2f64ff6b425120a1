// A score made again from exported traces by a program that shares no code with this one.
#include <algorithm>
#include <filesystem>
#include <fstream>

#include "tests/system/system_fixture.h"

namespace trocar::test::rescoring_test {
namespace {

class Rescoring : public SystemTest {
 protected:
  void attempt(const std::string& exercise, const std::string& hand, const std::string& level,
               const std::string& tissue = "still") const {
    const Outcome run =
        trocar({"run", exercise, "--hand", hand, "--level", level, "--tissue", tissue, "--seed", "3", "--db", "r.db"});
    EXPECT_LE(run.exit_code, 1) << run.err;
  }
  Outcome rescored() const {
    Launch python;
    python.program = "/usr/bin/python3";
    python.folder = folder_.path();
    python.arguments = {std::string(TROCAR_SOURCE_DIR) + "/docs/rescoring/rescore.py"};
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / "traces"))
      python.arguments.push_back(entry.path().string());
    return run_program(python);
  }
};

TEST_F(Rescoring, AgreesToABillionthOnEveryExercise) {
  attempt("reach-and-orient", "intermediate", "L1");
  attempt("surface-touch", "novice", "L1");
  attempt("limited-grasp", "intermediate", "L1");
  attempt("camera-navigation", "novice", "L2");
  attempt("peg-transfer", "novice", "L2");
  attempt("ring-on-wire", "novice", "L2");
  attempt("retract-and-hold", "intermediate", "L1", "normal");
  attempt(exercise_of(3, 12), "idle", "L1");
  const Outcome exported = trocar({"export", "traces", "--out", "traces", "--db", "r.db"});
  ASSERT_EQ(exported.exit_code, 0) << exported.err;
  const Outcome made = rescored();
  EXPECT_EQ(made.exit_code, 0) << made.out << made.err;
  EXPECT_EQ(std::count(made.out.begin(), made.out.end(), '\n'), 8) << made.out;
}

TEST_F(Rescoring, TellsAnAlteredTrace) {
  attempt("limited-grasp", "expert", "L1");
  ASSERT_EQ(trocar({"export", "traces", "--out", "traces", "--db", "r.db"}).exit_code, 0);
  const std::filesystem::path folder = std::filesystem::directory_iterator(folder_ / "traces")->path();
  std::ofstream(folder / "events.csv", std::ios::app) << "30,CRUSH,major,0,2,N,0,0,0\r\n";
  const Outcome made = rescored();
  EXPECT_EQ(made.exit_code, 1);
  EXPECT_NE(made.out.find("crushed, value: 1, Trocar says 0"), std::string::npos) << made.out;
}

}  // namespace
}  // namespace trocar::test::rescoring_test
