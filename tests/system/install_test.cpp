// An installed program uses what was installed beside it, not the source tree it was built from.
#include <unistd.h>

#include <map>
#include <sstream>

#include "tests/system/system_fixture.h"

namespace trocar::test::install_test {
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

  Outcome installed(Translator arguments) const {
    Launch with = launch(std::move(arguments));
    with.program = folder_ / "prefix/bin/trocar";
    return run_program(with);
  }
  /// First words of the lines that list subcommands in a help text.
  static Translator commands_of(const std::string& help) {
    Translator commands;
    std::istringstream lines(help.substr(help.find("Subcommands:")));
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with("  ") && line.size() > 2 && line[2] != ' ')
        commands.push_back(line.substr(2, line.find(' ', 2) - 2));
    }
    EXPECT_GT(commands.size(), 10u);
    return commands;
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
  const Translator run{"run",  exercise_of(3, 12), "--hand", "only-here", "--organ", "only-here",
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

TEST_F(Installed, NothingOfTheSourceTreeIsUsed) {
  fs::rename(share(""), folder_ / "away");
  const Outcome run = installed({"exercises"});
  EXPECT_EQ(run.exit_code, 3);
  EXPECT_NE(run.err.find("share/trocar"), std::string::npos) << run.err;
  EXPECT_EQ(run.err.find(TROCAR_SOURCE_DIR), std::string::npos) << "it looked into the source tree: " << run.err;
  Launch named = launch({"exercises"});
  named.program = folder_ / "prefix/bin/trocar";
  named.environment["TROCAR_ASSETS"] = (folder_ / "away").string();
  EXPECT_EQ(run_program(named).exit_code, 0) << "TROCAR_ASSETS says where";
}

TEST_F(Installed, RunsThroughALinkFromAnyFolder) {
  fs::create_directories(folder_ / "elsewhere/bin");
  fs::create_symlink("../../prefix/bin/trocar", folder_ / "elsewhere/bin/tr");
  Launch linked = launch(short_run({"--db", "t.db"}));
  linked.program = folder_ / "elsewhere/bin/tr";
  EXPECT_EQ(run_program(linked).exit_code, 1);
  Launch away = launch({"exercises"});
  away.program = folder_ / "prefix/bin/trocar";
  away.folder = folder_ / "elsewhere";
  EXPECT_EQ(run_program(away).exit_code, 0);
}

TEST_F(Installed, ItStillWorksAfterThePrefixHasMoved) {
  fs::rename(folder_ / "prefix", folder_ / "elsewhere");
  std::ofstream(folder_ / "elsewhere/share/trocar/exercises/surface-touch.toml")
      << replaced(shipped_exercise(), "title = \"Surface touch\"", "title = \"Moved\"");
  Launch moved = launch({"exercises"});
  moved.program = folder_ / "elsewhere/bin/trocar";
  EXPECT_NE(run_program(moved).out.find("Moved"), std::string::npos);
}

TEST_F(Installed, DestdirTakesThePrefix) {
  Launch install = launch({"--install", TROCAR_BUILD_DIR, "--prefix", "/usr"});
  install.program = TROCAR_CMAKE;
  install.environment["DESTDIR"] = (folder_ / "stage").string();
  ASSERT_EQ(run_program(install).exit_code, 0);
  Launch staged = launch({"exercises"});
  staged.program = folder_ / "stage/usr/bin/trocar";
  EXPECT_EQ(run_program(staged).exit_code, 0);
}

TEST_F(Installed, TheManualPageNamesEveryCommandAndRendersWithoutAWarning) {
  const fs::path page = folder_ / "prefix/share/man/man1/trocar.1";
  std::string text = file_bytes(page);
  for (std::size_t at; (at = text.find("\\-")) != std::string::npos;) text.erase(at, 1);
  for (const std::string& command : commands_of(trocar({"--help"}).out)) {
    EXPECT_NE(text.find(".SS trocar " + command + "\n"), std::string::npos) << command;
    std::istringstream words(trocar({command, "--help"}).out);
    for (std::string word; words >> word;) {
      if (word.starts_with("--") && word.size() > 2) {
        word.erase(word.find_last_not_of(",.:;") + 1);
        EXPECT_NE(text.find(word), std::string::npos) << command << ' ' << word;
      }
    }
  }
  if (!fs::exists("/usr/bin/groff")) GTEST_SKIP() << "no groff here: the page was not rendered";
  Launch groff = launch({"-man", "-Tutf8", "-ww", page.string()});
  groff.program = "/usr/bin/groff";
  const Outcome rendered = run_program(groff);
  EXPECT_EQ(rendered.exit_code, 0);
  EXPECT_EQ(rendered.err, "");
  EXPECT_NE(rendered.out.find("passed where something is graded"), std::string::npos);
}

TEST_F(Installed, BashCompletesCommandsAndFlags) {
  const std::string script = (folder_ / "prefix/share/bash-completion/completions/trocar").string();
  const auto completed = [&](const std::string& words, int last) {
    Launch bash = launch({"-c", "source '" + script + "'; COMP_WORDS=(" + words +
                                    "); COMP_CWORD=" + std::to_string(last) + "; _trocar; echo \"${COMPREPLY[@]}\""});
    bash.program = "/bin/bash";
    return run_program(bash).out;
  };
  for (const std::string& command : commands_of(trocar({"--help"}).out)) {
    EXPECT_NE((" " + completed("trocar ''", 1)).find(" " + command + " "), std::string::npos) << command;
  }
  EXPECT_EQ(completed("trocar run --se", 2), "--seed --sensor\n");
  EXPECT_EQ(completed("trocar db che", 2), "check\n");
  EXPECT_EQ(completed("trocar trainee show CODE --lim", 4), "--limit\n");
  EXPECT_EQ(completed("trocar run --frob", 2), "\n");
}

TEST_F(Installed, TheOtherShellsHaveTheirScripts) {
  const std::string fish = file_bytes(folder_ / "prefix/share/fish/vendor_completions.d/trocar.fish");
  EXPECT_NE(fish.find("complete -c trocar -n '__fish_seen_subcommand_from run' -l seed -r"), std::string::npos);
  EXPECT_TRUE(file_bytes(folder_ / "prefix/share/zsh/site-functions/_trocar").starts_with("#compdef trocar\n"));
  expect_refusal({"completion", "tcsh"}, 2, "bash, zsh and fish are known");
}

/// As in a container or a bare machine: no rights, no home, no display, no language.
TEST_F(Installed, DoctorIsTrueWithoutRightsAndSaysWhatToDo) {
  Launch bare = launch({"doctor", "--json"});
  for (const char* variable : {"HOME", "XDG_DATA_HOME", "DISPLAY", "WAYLAND_DISPLAY", "LANG", "LC_ALL", "LC_CTYPE"})
    bare.environment[variable] = "";
  if (::geteuid() == 0) {
    bare.arguments = {"--bounding-set=-all", "--inh-caps=-all", bare.program.string(), "doctor", "--json"};
    bare.program = "/usr/bin/setpriv";
  }
  const Outcome told = run_program(bare);
  EXPECT_EQ(told.exit_code, 3) << told.out << told.err;
  const Json json = Json::parse(told.out);
  EXPECT_EQ(json.at("sound"), false);
  std::map<std::string, Json> of;
  for (const Json& finding : json.at("findings")) {
    EXPECT_TRUE(of.emplace(finding.at("name"), finding).second) << finding << ": said twice";
    EXPECT_TRUE(finding.at("state") == "ok" || finding.at("state") == "warning" || finding.at("state") == "problem");
  }
  const auto says = [&](const char* name, const char* state, const char* words) {
    EXPECT_EQ(of[name].value("state", ""), state) << of[name];
    EXPECT_NE(of[name].value("text", "").find(words), std::string::npos) << of[name];
  };
  says("database", "problem", "set HOME or give --db FILE");
  says("display", "warning", "--headless");
  says("locale", "warning", "none is set");
  says("real-time", "warning", "does not get SCHED_FIFO 80");
  EXPECT_FALSE(of.contains("rtprio")) << "one line about one thing";
  EXPECT_TRUE(of.contains("network") && of.contains("boards") && of.contains("clock"));
  bare.environment["container"] = "podman";
  EXPECT_NE(run_program(bare).out.find("--cap-add=SYS_NICE"), std::string::npos) << "limits.conf is no help there";
  bare.arguments.pop_back();
  const std::string lines = run_program(bare).out;
  for (const auto& [name, finding] : of)
    EXPECT_NE(lines.find(" " + name + " "), std::string::npos) << name << ": the same facts as lines";
}

TEST_F(Installed, DoctorFindsWhatIsThereAndWhatIsNot) {
  Launch sound = launch({"doctor", "--json"});
  sound.program = folder_ / "prefix/bin/trocar";
  const Outcome good = run_program(sound);
  EXPECT_EQ(good.exit_code, 0) << good.out;
  EXPECT_EQ(Json::parse(good.out)["sound"], true);
  EXPECT_FALSE(fs::exists(folder_ / "data")) << "it only looks";
  fs::rename(share("exercises"), share("gone"));
  const Outcome bad = installed({"doctor"});
  EXPECT_EQ(bad.exit_code, 3);
  EXPECT_NE(bad.out.find("problem  assets"), std::string::npos) << bad.out;
  folder_.write("text.db", std::string(5000, 'z'));
  EXPECT_NE(trocar({"doctor", "--db", "text.db"}).out.find("problem  database    "), std::string::npos);
}

}  // namespace
}  // namespace trocar::test::install_test
