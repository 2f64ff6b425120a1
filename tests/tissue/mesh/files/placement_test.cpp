// Who says what unit and axes a file has, and what a person is told about it.
#include "tissue/mesh/files/placement.h"

#include <gtest/gtest.h>

#include <random>

#include "haptics/input_error.h"
#include "tests/tissue/support/temporary_folder.h"

namespace trocar::placement_test {
namespace {

Eigen::AlignedBox3d cube(double side) { return {Vec3::Zero(), Vec3::Constant(side)}; }

SurfaceFile silent() { return {}; }

SurfaceFile metric() {
  SurfaceFile file;
  file.unit_m = 1, file.unit_source = "the standard says metres", file.frame = "LSA",
  file.frame_source = "the standard says so";
  return file;
}

SurfaceImportOptions declared(const std::string& unit, const std::string& frame = "", const std::string& up = "") {
  SurfaceImportOptions options;
  options.unit = unit, options.frame = frame, options.up_axis = up;
  return options;
}

Placement placed(const SurfaceFile& file, const SurfaceImportOptions& options, double side,
                 const std::string& organ = "") {
  return placement_of(file, options, cube(side), organ, "dir/a.stl");
}

std::string refusal(const SurfaceFile& file, const SurfaceImportOptions& options, double side,
                    const std::string& organ = "") {
  return test::message_of<InputError>([&] { placed(file, options, side, organ); });
}

TEST(Placement, EveryUnitScalesToMetres) {
  for (const auto& [unit, side] : {std::pair("mm", 100.0), {"cm", 10.0}, {"m", 0.1}, {"um", 1e5}}) {
    const Placement placement = placed(silent(), declared(unit), side);
    EXPECT_NEAR(placement.placed(Vec3(side, 0, 0)).x(), 0.1, 1e-15) << unit;
    EXPECT_EQ(placement.unit, unit);
    EXPECT_EQ(placement.decisions.at(0), "unit " + std::string(unit) + ": declared");
  }
  EXPECT_EQ(metres_per("mm"), 1e-3);
  EXPECT_CONTAINS(test::message_of<InputError>([] { metres_per("inch"); }), "--unit inch: mm, cm, m or um is wanted");
}

TEST(Placement, AMissingUnitIsRefusedWithTheUnitsThatWouldFit) {
  EXPECT_CONTAINS(refusal(silent(), {}, 100),
                  "dir/a.stl: STL carries no unit, say --unit mm, cm, m or um: bounding box 100 x 100 x 100");
  EXPECT_CONTAINS(refusal(silent(), {}, 100), "it would be in mm");
  EXPECT_CONTAINS(refusal(silent(), {}, 10), "it would be in mm or cm");
  EXPECT_CONTAINS(refusal(silent(), {}, 0.1), "it would be in m");
  EXPECT_CONTAINS(refusal(silent(), {}, 1e5), "it would be in um");
  EXPECT_CONTAINS(refusal(silent(), {}, 1e-4), "no unit among mm, cm, m, um fits");
}

TEST(Placement, TheOrgansNameSharpensTheHint) {
  const std::string liver = refusal(silent(), {}, 20, "liver");
  EXPECT_CONTAINS(liver, "it would be in mm or cm");  // 20 mm or 200 mm
  EXPECT_CONTAINS(liver, "of a liver one expects 150 to 300 mm, which cm gives");
  EXPECT_CONTAINS(refusal(silent(), {}, 60, "gallbladder"),
                  "of a gallbladder one expects 30 to 130 mm, which mm gives");
  EXPECT_CONTAINS(refusal(silent(), {}, 6, "liver"), "which no unit gives");
  EXPECT_CONTAINS(refusal(silent(), {}, 6, "Hepatic_arteries"), "of an artery one expects 20 to 500 mm");
}

TEST(Placement, TheFilesOwnUnitIsTaken) {
  const Placement placement = placed(metric(), {}, 0.1);
  EXPECT_EQ(placement.unit, "m");
  EXPECT_EQ(placement.decisions.at(0), "unit m: the standard says metres");
  EXPECT_CONTAINS(refusal(metric(), {}, 100), "its own unit, m, is not plausible");
  EXPECT_CONTAINS(refusal(silent(), declared("m"), 100), "--unit m is not plausible");
  EXPECT_CONTAINS(placed(metric(), declared("mm"), 100).decisions.at(0),
                  "unit mm: declared, although the standard says metres");
  EXPECT_EQ(placed(metric(), declared("m"), 0.1).decisions.at(0), "unit m: declared");
}

TEST(Placement, FramesAreTakenDeclaredOrAssumed) {
  EXPECT_EQ(placed(silent(), declared("m"), 0.1).decisions.at(1),
            "frame RAS: STL does not say which way x, y and z point; assumed");
  EXPECT_EQ(placed(metric(), {}, 0.1).decisions.at(1), "frame LSA: the standard says so; turned to RAS");
  EXPECT_EQ(placed(silent(), declared("m", "LPS"), 0.1).decisions.at(1), "frame LPS: declared; turned to RAS");
  EXPECT_EQ(placed(metric(), declared("m", "LPS"), 0.1).decisions.at(1),
            "frame LPS: declared, although it says LSA (the standard says so); turned to RAS");
  EXPECT_EQ(placed(metric(), declared("m", "LSA"), 0.1).decisions.at(1), "frame LSA: declared; turned to RAS");
  EXPECT_EQ(placed(silent(), declared("m", "", "y"), 0.1).frame, "LSA");
  EXPECT_CONTAINS(placed(silent(), declared("m", "LAS"), 0.1).decisions.at(1), "a mirror image");
}

TEST(Placement, ContradictionsAreRefused) {
  EXPECT_CONTAINS(refusal(silent(), declared("m", "RAS", "y"), 0.1), "frame RAS and up axis y contradict each other");
  EXPECT_NO_THROW(placed(silent(), declared("m", "LSA", "y"), 0.1));
  EXPECT_CONTAINS(refusal(silent(), declared("m", "down"), 0.1), "three letters are wanted");
}

// Lengths and volumes stay, whatever the frame; only the sign of a mirror changes.
TEST(Placement, FramesKeepDistances) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> drawn(-1, 1);
  for (const std::string frame : {"RAS", "LPS", "LSA", "SRA", "LAS", "PIR", "ASR"}) {
    const Placement placement = placed(silent(), declared("mm", frame), 100);
    const Vec3 a(drawn(random), drawn(random), drawn(random)), b(drawn(random), drawn(random), drawn(random)),
        c(drawn(random), drawn(random), drawn(random));
    EXPECT_NEAR((placement.placed(a) - placement.placed(b)).norm(), 1e-3 * (a - b).norm(), 1e-15);
    const double volume = a.dot(b.cross(c));
    EXPECT_NEAR(placement.placed(a).dot(placement.placed(b).cross(placement.placed(c))),
                (placement.mirrors() ? -1e-9 : 1e-9) * volume, 1e-20)
        << frame;
  }
}

}  // namespace
}  // namespace trocar::placement_test
