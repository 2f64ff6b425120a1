// Usage: help of every subcommand, and what is refused before anything runs.
#include <map>

#include "tests/system/system_fixture.h"

namespace trocar::test::usage_test {
namespace {

using Usage = SystemTest;

const std::map<std::string, Translator>& other_commands_and_flags() {
  static const std::map<std::string, Translator> table{
      {"run", {"--hand",      "--level", "--seed",        "--trainee", "--db",     "--organ",  "--board", "--record",
               "--frames",    "--video", "--fps",         "--backend", "--card",   "--sensor", "--rate",  "--contact",
               "--passivity", "--clamp", "--calibration", "--device",  "--inject", "--json"}},
      {"practice", {"--level",    "--trainee", "--input",   "--organ", "--db",     "--scale",       "--language",
                    "--settings", "--hand",    "--seed",    "--width", "--height", "--fullscreen",  "--screens",
                    "--timing",   "--scope",   "--backend", "--card",  "--sensor", "--calibration", "--device"}},
      {"test", {"--filter", "--junit", "--jobs", "--list"}},
      {"sweep", {"--hand", "--level", "--seeds", "--organ", "--jobs", "--json"}},
      {"replay",
       {"--frames", "--fps", "--verify", "--organ", "--db", "--video", "--speed", "--width", "--height", "--beside",
        "--preset"}},
      {"score", {"--rubric", "--jigsaws", "--db", "--json"}},
      {"export",
       {"csv", "json", "xapi", "traces", "--out", "--trainee", "--group", "--exercise", "--home-page", "--cmi5",
        "--db"}},
      {"demo", {"--headless", "--out", "--organ", "--exercise", "--level", "--video"}},
      {"bench", {"--organ", "--json"}},
      {"study", {"--out", "--quick", "--seed", "--sensor", "--json"}},
      {"version", {}},
      {"exercises", {"--json", "--explain"}},
      {"check", {"--organ"}},
      {"device",
       {"eval", "ik", "fk", "calibrate", "identify", "faults", "selftest", "monitor", "home", "pinch", "stop"}},
      {"device faults", {"--backend", "--seed", "--rate", "--json"}},
      {"device selftest", {"--backend", "--seed", "--rate", "--inject", "--json"}},
      {"device stop", {"attempt", "--ticks", "--db", "--json"}},
      {"device card", {"--json"}},
      {"device home",
       {"--backend", "--card", "--method", "--device", "--learn", "--repeat", "--limit", "--seed", "--plant",
        "--inject", "--json"}},
      {"device pinch",
       {"--backend", "--card", "--design", "--travel", "--ratio", "--most", "--noise", "--limit", "--seed", "--plant",
        "--out", "--json"}},
      {"device boards", {"device"}},
      {"device sensor", {"--seconds", "--bias", "--device", "--json"}},
      {"device monitor",
       {"--backend", "--card", "--seconds", "--lockstep", "--seed", "--rate", "--calibration", "--device", "--inject",
        "--json"}},
      {"device fk", {"--deg", "--csv", "--out", "--json"}},
      {"device calibrate", {"--seed", "--gain", "--out", "--check", "--json"}},
      {"device eval", {"--csv", "--out", "--device"}},
      {"device identify",
       {"--seed", "--poses", "--span", "--payload", "--sensor", "--calibration-out", "--quick", "--out", "--json"}},
      {"device ik", {"--csv", "--out"}},
      {"organ", {"import", "info", "render", "phantom"}},
      {"organ import", {"--labels", "--label", "--triangles", "--unit", "-o", "--json"}},
      {"organ info", {"--json"}},
      {"organ export", {"-o", "--format", "--tetrahedra"}},
      {"organ render", {"-o", "--width", "--height"}},
      {"picture", {"--out", "--scene", "--preset", "--width", "--height", "--seed", "--no-grain"}},
      {"organ phantom", {"--out", "--seed", "--json"}},
      {"doctor", {"--db", "--card", "--sensor", "--device", "--json"}},
      {"completion", {"shell"}},
      {"manual", {}}};
  return table;
}

/// Those about people and what is kept of them.
const std::map<std::string, Translator>& commands_about_people() {
  static const std::map<std::string, Translator> table{
      {"trainee",
       {"add", "list", "show", "edit", "import", "group", "deactivate", "reactivate", "note", "export", "consent",
        "erase"}},
      {"trainee import", {"--db", "--preview", "--group", "--author"}},
      {"trainee group", {"--db", "--leave", "--author"}},
      {"trainee deactivate", {"--db", "--reason", "--author"}},
      {"trainee reactivate", {"--db", "--reason", "--author"}},
      {"programme", {"list", "show", "save", "assign", "withdraw", "grid", "reminders"}},
      {"programme list", {"--db"}},
      {"programme show", {"--db"}},
      {"programme save", {"--db", "--author"}},
      {"programme assign", {"--db", "--group", "--trainee", "--due", "--author"}},
      {"programme withdraw", {"--db", "--reason", "--author"}},
      {"programme grid", {"--db", "--group", "--deactivated", "--csv"}},
      {"programme reminders", {"--db", "--programme", "--group", "--days", "--csv"}},
      {"trainee edit", {"--db", "--name", "--email", "--json"}},
      {"trainee note", {"--db", "--attempt", "--author"}},
      {"trainee export", {"--db", "-o"}},
      {"trainee consent", {"--db", "--purpose", "--text", "--withdrawn", "--author"}},
      {"trainee erase", {"--db", "--training", "--reason", "--author", "--yes"}},
      {"trainee add", {"--db", "--json"}},
      {"trainee list", {"--db", "--json"}},
      {"trainee show", {"--db", "--limit", "--json"}},
      {"cohort", {"--db", "--trainee", "--deactivated", "--json"}},
      {"review", {"serve", "account", "demo", "report"}},
      {"review serve",
       {"--port", "--lan", "--cert", "--key", "--name", "--db", "--demo", "--from", "--password-file",
        "--allow-weak-tls", "--recordings"}},
      {"review demo", {"--db", "--jobs", "--remove"}},
      {"review report",
       {"--trainee", "--cohort", "--group", "--attempt", "--certificate", "--out", "--notes", "--force", "--db"}},
      {"review account", {"add", "password", "disable", "enable", "list"}},
      {"review account password", {"--own", "--as", "--db"}},
      {"review account add", {"--name", "--role", "--trainee", "--db"}},
      {"review account list", {"--json", "--db"}},
      {"lrs",
       {"--home-page", "--user", "--password-file", "--ca-file", "--allow-plain-http", "--batch", "--patience",
        "--trainee", "--group", "--exercise", "--attempt", "--json", "--db"}},
      {"sync",
       {"link", "unlink", "central", "admit", "dismiss", "--allow-weak-tls", "--to", "--from", "--with-identity",
        "--recordings", "--apply-erasures", "--new-station", "--db"}},
      {"sync link", {"--at", "--password-file", "--allow-weak-tls", "--author"}},
      {"sync unlink", {"--at", "--password-file", "--allow-weak-tls", "--author"}},
      {"sync central", {"--at", "--password-file", "--allow-weak-tls", "--json"}},
      {"sync admit", {"--at", "--password-file", "--allow-weak-tls", "--desk", "--station", "--password-out"}},
      {"sync dismiss", {"--at", "--password-file", "--allow-weak-tls"}},
      {"db", {"check", "backup", "migrate", "anchor", "key", "head", "rubric", "retention"}},
      {"db retention", {"--db", "--days", "--erase", "--training", "--author", "--yes"}},
      {"db check", {"--db", "--json", "--quick", "--witness", "--password-file", "--allow-weak-tls"}},
      {"db key", {"--db", "--renew"}},
      {"db head", {"--db", "--export"}},
      {"db backup", {"--db", "--out", "--without-recordings"}},
      {"db migrate", {"--db"}},
      {"db anchor", {"--db"}},
      {"db rubric", {"--db"}}};
  return table;
}

std::map<std::string, Translator> commands_and_flags() {
  std::map<std::string, Translator> all = commands_about_people();
  all.insert(other_commands_and_flags().begin(), other_commands_and_flags().end());
  return all;
}

Translator split(const std::string& text) {
  std::istringstream in(text);
  return {std::istream_iterator<std::string>(in), {}};
}

TEST_F(Usage, HelpOfEverySubcommandNamesItsFlags) {
  for (const auto& [command, flags] : commands_and_flags()) {
    Translator words = split(command);
    words.push_back("--help");
    const Outcome outcome = trocar(words);
    EXPECT_EQ(outcome.exit_code, 0) << command;
    EXPECT_EQ(outcome.err, "") << command;
    for (const std::string& flag : flags)
      EXPECT_NE(outcome.out.find(flag), std::string::npos) << command << ' ' << flag;
  }
}

TEST_F(Usage, HelpOfTheProgramNamesEveryCommandOfTheTable) {
  const Outcome outcome = trocar({"--help"});
  EXPECT_EQ(outcome.exit_code, 0);
  for (const auto& [command, flags] : commands_and_flags()) {
    EXPECT_NE(outcome.out.find("  " + split(command)[0]), std::string::npos) << command;
  }
}

TEST_F(Usage, VersionIsTheProjects) {
  const Outcome outcome = trocar({"version"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.out, "trocar " TROCAR_VERSION "\n");
  const Outcome flag = trocar({"--version"});
  EXPECT_EQ(flag.exit_code, 0);
  EXPECT_EQ(flag.out, outcome.out);
}

TEST_F(Usage, AMisspeltWordIsNamedWithTheOneThatWasMeant) {
  expect_refusal({"replai", "x.trec"}, 2, "not understood: replai; did you mean 'replay'?");
  expect_refusal({"organ", "rendr"}, 2, "not understood: rendr; did you mean 'render'?");
  expect_refusal({"run", "surface-touch", "--hnad", "expert"}, 2, "not understood: --hnad; did you mean '--hand'?");
  expect_refusal({"run", "surface-touch", "--hand=expert", "--sede=4"}, 2,
                 "not understood: --sede; did you mean '--seed'?");
  expect_refusal({"--vresion"}, 2, "not understood: --vresion; did you mean '--version'?");
  const Outcome far = trocar({"xyzzy"});
  EXPECT_NE(far.err.find("not understood: xyzzy\n"), std::string::npos) << far.err;
  const Outcome missing = trocar({"run", "surface-touch"});
  EXPECT_EQ(missing.err.find("not understood"), std::string::npos)
      << "everything that stands there is understood: " << missing.err;
  const Outcome value = trocar({"device", "fk", "--deg", "-1,x", "--jsn"});
  EXPECT_NE(value.err.find("not understood: --jsn"), std::string::npos)
      << "a value may begin with a dash: " << value.err;
}

TEST_F(Usage, ATypedPathNeedsItsFolder) {
  const std::string said = "there is no folder typo; make it first";
  for (const Translator& words :
       {Translator{"run", "surface-touch", "--hand", "idle", "--db", "typo/a.db"},
        Translator{"run", "E02", "--hand", "idle", "--record", "typo/a.trec"},
        Translator{"run", "E02", "--hand", "idle", "--frames", "typo/f"}, Translator{"demo", "--out", "typo/demo"},
        Translator{"picture", "--out", "typo/a.png"}, Translator{"practice", "--db", "typo/a.db"},
        Translator{"practice", "--screens", "typo/s"}, Translator{"replay", "a.trec", "--video", "typo/a.mp4"},
        Translator{"trainee", "add", "T-1", "--db", "typo/a.db"}, Translator{"organ", "phantom", "--out", "typo/p"},
        Translator{"study", "kinematics", "--out", "typo/k"}, Translator{"device", "plant", "--out", "typo/p.toml"},
        Translator{"db", "backup", "--out", "typo/b.db"}}) {
    expect_refusal(words, 2, said);
    EXPECT_FALSE(std::filesystem::exists(folder_ / "typo")) << words[0];
  }
  EXPECT_EQ(trocar({"trainee", "add", "T-1"}).exit_code, 0) << "the data folder is the program's own, and made";
  EXPECT_TRUE(std::filesystem::exists(folder_ / "data" / "trocar" / "trocar.db"));
}

TEST_F(Usage, AnExerciseIsNamedByIdNumberOrFile) {
  for (const char* word : {"2", "e02", "Surface-Touch"}) {
    const Outcome outcome = trocar({"exercises", "--explain", word});
    EXPECT_EQ(outcome.exit_code, 0) << word;
    EXPECT_EQ(outcome.out.find("E02  surface-touch"), 0u) << word;
  }
  for (const Translator& words :
       {Translator{"run", "99", "--hand", "idle", "--db", ":memory:"}, Translator{"check", "99"},
        Translator{"practice", "99", "--db", ":memory:", "--screens", "s"}, Translator{"sweep", "99"},
        Translator{"demo", "--exercise", "99"}}) {
    expect_refusal(words, 2, "unknown exercise '99': known are E01 reach-and-orient, E02 surface-touch, E03");
  }
}

TEST_F(Usage, TissueThatStandsStillIsNotLifted) {
  expect_refusal({"run", "E09", "--hand", "idle", "--tissue", "still", "--db", ":memory:"}, 2, "must give way");
}

TEST_F(Usage, TwoRunsInOneFilmHaveOneLimit) {
  const std::string help = trocar({"replay", "--help"}).out;
  EXPECT_NE(help.find("with --beside from 720"), std::string::npos);
  EXPECT_NE(help.find("with --beside from 400"), std::string::npos);
  ASSERT_EQ(trocar(short_run({"--db", ":memory:", "--record", "a.trec"})).exit_code & ~1, 0);
  expect_refusal({"replay", "a.trec", "--beside", "a.trec", "--frames", "f", "--width", "719", "--height", "400"}, 2,
                 "at least 720 x 400 px, not 719 x 400");
  expect_refusal({"replay", "a.trec", "--beside", "a.trec", "--frames", "f", "--width", "720", "--height", "399"}, 2,
                 "at least 720 x 400");
}

TEST_F(Usage, NoSubcommandIsBadUsage) {
  expect_refusal({}, 2, "subcommand is required");
  for (const char* group : {"device", "organ", "trainee", "db"}) expect_refusal({group}, 2, "subcommand is required");
}

TEST_F(Usage, UnknownCommandFlagOrMissingValueIsBadUsage) {
  expect_refusal({"fly"}, 2, "fly");
  expect_refusal({"organ", "fly"}, 2, "fly");
  for (const auto& [command, flags] : commands_and_flags()) {
    Translator words = split(command);
    words.push_back("--frobnicate");
    const Outcome outcome = trocar(words);
    EXPECT_EQ(outcome.exit_code, 2) << command;
    EXPECT_NE(outcome.err, "") << command;
  }
  expect_refusal({"run", "surface-touch", "--hand"}, 2, "--hand");
  expect_refusal({"run", "surface-touch"}, 2, "--hand");
  expect_refusal({"run", "--hand", "expert"}, 2, "exercise");
  expect_refusal(short_run({"--rate", "1500"}), 2, "--rate");
  expect_refusal(short_run({"--fps", "0"}), 2, "--fps");
  expect_refusal(short_run({"--board", "20"}), 2, "practice boards are 0 to 19");
  expect_refusal({"run", "surface-touch", "--hand", "idle", "--level", "exam", "--board", "3", "--db", ":memory:"}, 2,
                 "an exam's board is unseen, and drawn by --seed");
  expect_refusal(short_run({"--contact", "magic"}), 2, "known are proxy, thesis");
  expect_refusal(short_run({"--passivity", "magic"}), 2, "known are budgeted, increment, off");
  expect_refusal(short_run({"--seed", "many"}), 2, "--seed");
}

TEST_F(Usage, CatalogueListsAndExplains) {
  const Json catalogue = json_of({"exercises", "--json"}, 0);
  ASSERT_EQ(catalogue.size(), 14u);
  EXPECT_EQ(catalogue[1]["id"], "surface-touch");
  EXPECT_EQ(catalogue[1]["number"], "E02");
  EXPECT_EQ(catalogue[1]["rubric_sha256"].get<std::string>().size(), 64u);
  EXPECT_NE(trocar({"exercises"}).out.find("E02  surface-touch"), std::string::npos);
  const Outcome explained = trocar({"exercises", "--explain", "path_ratio"});
  EXPECT_EQ(explained.exit_code, 0);
  EXPECT_EQ(explained.out.find("path_ratio ["), 0u) << explained.out;
  expect_refusal({"exercises", "--explain", "elegance"}, 2, "unknown metric, exercise or sub-score; known are");
}

TEST_F(Usage, CheckProvesShippedBoardsAndRefusesBadFiles) {
  const Outcome sound = trocar({"check", "surface-touch"});
  EXPECT_EQ(sound.exit_code, 0) << sound.out << sound.err;
  EXPECT_NE(sound.out.find("surface-touch L1 (direct): sound"), std::string::npos) << sound.out;
  EXPECT_NE(sound.out.find("40 boards"), std::string::npos) << sound.out;
  folder_.write("bad.toml", replaced(shipped_exercise(), "hold_s = 1.0", "hold_s = \"long\""));
  expect_refusal({"check", "bad.toml"}, 2, "bad.toml:");
}

}  // namespace
}  // namespace trocar::test::usage_test
