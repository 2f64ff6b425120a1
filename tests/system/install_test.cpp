// An installed program uses what was installed beside it, not the source tree it was built from.
#include "tests/system/system_fixture.h"

namespace trocar::test {
namespace {

namespace fs = std::filesystem;

class Installed : public SystemTest {
 protected:
  void SetUp() override {
    Launch install = launch({"--install", TROCAR_BUILD_DIR, "--prefix", (folder_ / "prefix").string()});
    install.program = TROCAR_CMAKE;
    const Outcome outcome = run_program(install);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  }

  Outcome installed(Words arguments) const {
    Launch with = launch(std::move(arguments));
    with.program = folder_ / "prefix/bin/trocar";
    return run_program(with);
  }
  fs::path share(const std::string& name) const { return folder_.path() / "prefix/share/trocar" / name; }
};

TEST_F(Installed, AllThatShipsIsThere) {
  const fs::path source = TROCAR_SOURCE_DIR;
  const std::pair<const char*, const char*> folders[] = {{"scenarios/exercises", "exercises"},
                                                         {"scenarios/hands", "hands"},
                                                         {"assets/organs", "assets/organs"},
                                                         {"assets/shaders", "assets/shaders"}};
  for (const auto& [from, to] : folders) {
    for (const auto& entry : fs::directory_iterator(source / from)) {
      const fs::path& path = entry.path();
      if (path.extension() == ".h" || path.extension() == ".cpp") continue;
      EXPECT_TRUE(fs::exists(share(to) / path.filename())) << to << '/' << path.filename();
    }
  }
  for (const auto& entry : fs::recursive_directory_iterator(share(""))) {
    EXPECT_NE(entry.path().extension(), ".cpp") << entry.path();
    EXPECT_NE(entry.path().extension(), ".h") << entry.path();
  }
}

TEST_F(Installed, TheInstalledCopiesAreTheOnesInUse) {
  // Each kind of asset is given something that exists nowhere but in the prefix.
  std::ofstream(share("exercises/surface-touch.toml"))
      << replaced(shipped_exercise(), "title = \"Surface touch\"", "title = \"Only here\"");
  std::ofstream(share("hands/only-here.toml")) << kDip;
  fs::copy_file(share("assets/organs/phantom-liver.ply"), share("assets/organs/only-here.ply"));
  std::ofstream(share("assets/organs/only-here.organ.toml")) << replaced(
      file_bytes(share("assets/organs/phantom-liver.organ.toml")), "'phantom-liver.ply'", "'only-here.ply'");
  EXPECT_NE(installed({"exercises"}).out.find("Only here"), std::string::npos);
  EXPECT_EQ(trocar({"exercises"}).out.find("Only here"), std::string::npos);
  const Words run{"run",  exercise_of(3, 12), "--hand", "only-here", "--organ", "only-here",
                  "--db", ":memory:",         "--json"};
  const Outcome there = installed(run);
  EXPECT_EQ(there.exit_code, 1) << there.err;
  EXPECT_EQ(trocar(run).exit_code, 2) << "the build's own program does not know that hand";
}

TEST_F(Installed, AnInstalledRunIsTheSameRun) {
  const Outcome there = installed(short_run({"--db", ":memory:"}));
  EXPECT_EQ(there.exit_code, 1) << there.err;
  EXPECT_EQ(Json::parse(there.out)["state_hash"], json_of(short_run({"--db", ":memory:"}), 1)["state_hash"]);
}

TEST_F(Installed, ItStillWorksAfterThePrefixHasMoved) {
  fs::rename(folder_ / "prefix", folder_ / "elsewhere");
  std::ofstream(folder_ / "elsewhere/share/trocar/exercises/surface-touch.toml")
      << replaced(shipped_exercise(), "title = \"Surface touch\"", "title = \"Moved\"");
  Launch moved = launch({"exercises"});
  moved.program = folder_ / "elsewhere/bin/trocar";
  EXPECT_NE(run_program(moved).out.find("Moved"), std::string::npos);
}

}  // namespace
}  // namespace trocar::test
