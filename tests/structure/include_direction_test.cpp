// Modules know each other in one direction only, and third-party types stay behind sources.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/structure/include_rules.h"
#include "tests/structure/source_text.h"
#include "tests/structure/source_tree.h"

namespace trocar::include_direction_test {
namespace {

std::string quoted(const std::string& name) { return "#include \"" + name + "\"\n"; }
std::string angled(const std::string& name) { return "#include <" + name + ">\n"; }

struct Case {
  const char* path;
  std::string text;
};

TEST(BlankLiterals, LeavesStructureOnly) {
  EXPECT_EQ(blank_literals("a(\"}\"); // }\nb"), "a(\" \");     \nb");
  EXPECT_EQ(blank_literals("x = '{'; y = 1'000;"), "x = ' '; y = 1'000;");
  EXPECT_EQ(blank_literals("/* {\n */ c"), "    \n    c");
  EXPECT_EQ(blank_literals("\"\\\"{\" d"), "\"   \" d");
  EXPECT_EQ(blank_literals("R\"x(\" { )\" )x\" e").find('{'), std::string::npos);
  EXPECT_EQ(blank_literals("#if 1\n"), "#if 1\n");
}

TEST(IncludesOf, FindsIncludesAndNothingElse) {
  const auto found = includes_of(
      "// #include \"a.h\"\n#include \"b/c.h\"\n  #  include <vector>\n/*\n#include <d>\n*/\n"
      "auto s = R\"(\n#include <e>\n)\";\n");
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].name, "b/c.h");
  EXPECT_FALSE(found[0].system);
  EXPECT_EQ(found[0].line, 2u);
  EXPECT_EQ(found[1].name, "vector");
  EXPECT_TRUE(found[1].system);
  EXPECT_EQ(found[1].line, 3u);
}

TEST(IncludeRules, RefuseWhatGoesAgainstTheDirection) {
  const std::vector<Case> cases{{"haptics/haptic_loop.cpp", quoted("tissue/organ/organ.h")},
                                {"haptics/haptic_loop.h", quoted("scenarios/scoring/trace.h")},
                                {"haptics/device/plant/device_plant.cpp", quoted("haptics/kinematics/hybrid_arm.h")},
                                {"haptics/device/plant/plant_motor.h", quoted("haptics/device/device_model.h")},
                                {"haptics/device/simulated_daq.cpp", quoted("haptics/device/transmission.h")},
                                {"haptics/device/plant/hand_model.cpp", quoted("haptics/control/passivity.h")},
                                {"haptics/device/data_acquisition.h", quoted("haptics/device/device_model.h")},
                                {"haptics/quantities.h", quoted("haptics/fault.h")},
                                {"tissue/organ/organ.cpp", quoted("scenarios/exercise.h")},
                                {"tissue/mesh/surface/remesh.cpp", quoted("app/session/setup/scene.h")},
                                {"haptics/haptic_loop.cpp", quoted("haptics/digest/digest.h")},
                                {"haptics/digest/digest.cpp", quoted("haptics/fault.h")},
                                {"scenarios/director/director.cpp", quoted("trainees/store/database.h")},
                                {"scenarios/scoring/score.cpp", quoted("scenarios/exercise.h")},
                                {"scenarios/scoring/metrics.cpp", quoted("haptics/haptic_loop.h")},
                                {"trainees/store/database.cpp", quoted("scenarios/director/director.h")},
                                {"trainees/records/cohort.cpp", quoted("tissue/organ/organ.h")},
                                {"app/session/recording/chunk.cpp", quoted("app/cli/attempts/run_command.h")},
                                {"app/picture/scene/renderer.cpp", quoted("trainees/store/database.h")},
                                {"app/session/session.cpp", quoted("tests/support/sample_attempt.h")}};
  for (const Case& one : cases)
    EXPECT_EQ(include_violations(one.path, one.text).size(), 1u) << one.path << ' ' << one.text;
}

TEST(IncludeRules, RefuseThirdPartyTypesInHeaders) {
  for (const char* name : {"CGAL/Surface_mesh.h", "itkImage.h", "assimp/scene.h", "fcl/fcl.h", "sqlite3.h", "GL/gl.h",
                           "EGL/egl.h", "epoxy/gl.h", "toml++/toml.h", "nlohmann/json.hpp", "CLI/CLI.hpp", "png.h",
                           "ft2build.h", "zstd.h", "openssl/sha.h"}) {
    for (const char* path : {"tissue/organ/organ.h", "app/session/session.h", "app/picture/scene/renderer.h",
                             "trainees/store/database.h"}) {
      EXPECT_EQ(include_violations(path, angled(name)).size(), 1u) << path << " <" << name << ">";
    }
  }
}

TEST(IncludeRules, RefuseThirdPartyLibrariesOutsideTheirModule) {
  const std::vector<Case> cases{{"haptics/haptic_loop.cpp", angled("nlohmann/json.hpp")},
                                {"scenarios/director/director.cpp", angled("CGAL/Surface_mesh.h")},
                                {"trainees/records/cohort.cpp", angled("CGAL/Surface_mesh.h")},
                                {"app/session/session.cpp", angled("sqlite3.h")},
                                {"app/session/session.cpp", angled("epoxy/gl.h")},
                                {"app/session/session.cpp", angled("CLI/CLI.hpp")}};
  for (const Case& one : cases)
    EXPECT_EQ(include_violations(one.path, one.text).size(), 1u) << one.path << ' ' << one.text;
}

TEST(IncludeRules, SayFileLineAndRule) {
  const auto found = include_violations("tissue/organ/organ.cpp", "\n" + quoted("app/session/setup/scene.h"));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0], "tissue/organ/organ.cpp:2: includes app/session/setup/scene.h: tissue knows haptics only");
}

TEST(IncludeRules, AllowWhatTheArchitectureDraws) {
  const std::vector<Case> cases{
      {"haptics/haptic_loop.h", quoted("haptics/quantities.h") + angled("Eigen/Core") + angled("vector")},
      {"haptics/device/simulated_daq.cpp",
       quoted("haptics/device/plant/device_plant.h") + quoted("haptics/device/data_acquisition.h")},
      {"tissue/mesh/surface/remesh.cpp", quoted("haptics/input_error.h") + angled("CGAL/Surface_mesh.h")},
      {"tissue/organ/organ.cpp", quoted("haptics/digest/digest.h")},
      {"scenarios/director/director.cpp",
       quoted("tissue/mesh/surface/triangle_surface.h") + quoted("scenarios/scoring/rubric.h")},
      {"trainees/records/attempt_store.h", quoted("scenarios/scoring/attempt_result.h")},
      {"trainees/store/database.cpp", angled("sqlite3.h") + angled("sys/stat.h")},
      {"app/session/session.cpp", quoted("trainees/records/attempt_store.h") + angled("nlohmann/json.hpp")},
      {"app/picture/scene/renderer.cpp", angled("epoxy/gl.h")},
      {"tests/haptics/oracle_test.cpp", angled("fcl/fcl.h") + quoted("tests/support/sample_attempt.h")},
      {"tests/system/run_test.cpp", quoted("app/session/session.h") + angled("nlohmann/json.hpp")}};
  for (const Case& one : cases)
    EXPECT_TRUE(include_violations(one.path, one.text).empty()) << one.path << ' ' << one.text;
}

TEST(IncludeDirection, EveryFileKeepsIt) {
  std::size_t seen = 0;
  for (const SourceFile& file : source_tree()) {
    if (!file.cpp()) continue;
    seen += includes_of(file.text).size();
    for (const std::string& violation : include_violations(file.path, file.text)) ADD_FAILURE() << violation;
  }
  EXPECT_GT(seen, 1000u) << "the scanner no longer sees the includes";
}

TEST(IncludeDirection, EveryHeaderIsIncludedOnceOnlyAndSaysWhatItIs) {
  for (const SourceFile& file : source_tree()) {
    if (!file.header()) continue;
    EXPECT_NE(file.text.find("\n#pragma once\n"), std::string::npos) << file.path;
    EXPECT_TRUE(file.text.starts_with("// ")) << file.path << ": opens with no word on what it is";
  }
}

}  // namespace
}  // namespace trocar::include_direction_test
