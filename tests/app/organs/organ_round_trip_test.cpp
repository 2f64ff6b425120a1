// Out and in again: parts that lie apart, cavities with other organs in them, and what is said where they are lost.
#include <gtest/gtest.h>

#include <sstream>

#include "app/organs/organ_export.h"
#include "app/organs/organ_import.h"
#include "app/organs/organ_info.h"
#include "haptics/input_error.h"
#include "tests/tissue/support/shapes.h"
#include "tests/tissue/support/temporary_folder.h"
#include "tissue/imaging/volumes/nifti_writer.h"
#include "tissue/mesh/surface/topology.h"
#include "tissue/organ/organ.h"
#include "tissue/organ/organ_set.h"

namespace trocar::organ_round_trip_test {
namespace {

namespace fs = std::filesystem;
const fs::path kAssets = fs::path(TROCAR_SOURCE_DIR) / "assets";

struct Told {
  int code = 0;
  std::string out, err;
};

Told imported(const OrganImportOptions& options) {
  std::ostringstream out, err;
  const int code = organ_import(options, out, err);
  return {code, out.str(), err.str()};
}

Told info(const fs::path& manifest) {
  std::ostringstream out, err;
  const int code = organ_info({manifest, false}, out, err);
  return {code, out.str(), err.str()};
}

Told exported(const fs::path& organ, const fs::path& output, const std::string& format) {
  std::ostringstream out, err;
  const int code = organ_export({organ.string(), output, format, kAssets}, out, err);
  return {code, out.str(), err.str()};
}

OrganImportOptions asking(const fs::path& input, const fs::path& output) {
  OrganImportOptions options;
  options.input = input.string(), options.output = output.string();
  options.triangles = 800;
  return options;
}

std::string mm_ply(const TriangleSurface& surface) { return test::ascii_ply(surface, 1e3); }

TriangleSurface turned_over(TriangleSurface surface) {
  for (auto& triangle : surface.triangles) std::swap(triangle[1], triangle[2]);
  return surface;
}

/// Label 1 twice, 12 mm apart: a ball of 20 mm and one of 9 mm, which is a tenth of it.
std::string two_pieces() {
  LabelVolume volume = test::ball_volume(36, 2, {-10, 0, 0}, 20);
  const LabelVolume small = test::ball_volume(36, 2, {25, 0, 0}, 9);
  for (std::size_t n = 0; n < small.labels.size(); ++n) volume.labels[n] |= small.labels[n];
  return nifti_gz_bytes(volume.size, volume.index_to_ras_mm, volume.labels);
}

TEST(OrganRoundTrip, AnOrganOfTwoPiecesComesBackWhole) {
  const test::TemporaryFolder folder;
  OrganImportOptions options = asking(folder.write("map.nii.gz", two_pieces()), folder / "pancreas");
  ASSERT_EQ(imported(options).code, 0);
  const double whole = load_organ(folder / "pancreas.organ.toml").surface.volume_m3();
  for (const char* format : {"ply", "stl", "obj", "vtk", "vtp", "glb"}) {
    const fs::path file = folder / (std::string("p.") + format);
    exported(folder / "pancreas.organ.toml", file, "ply");
    OrganImportOptions again = asking(file, folder / (std::string("back_") + format));
    again.material = "pancreas";
    ASSERT_EQ(imported(again).code, 0) << format;
    const TriangleSurface back = load_organ(again.output + ".organ.toml").surface;
    EXPECT_NEAR(back.volume_m3(), whole, 2e-3 * whole) << format;
    EXPECT_EQ(analyse_topology(back).components, 2U) << format;
    EXPECT_CONTAINS(info(again.output + ".organ.toml").out, "kept 2 of 2 components");
    again.largest_only = true, again.output += "_largest";
    const Told one = imported(again);
    EXPECT_CONTAINS(one.err, "the parts that were left out enclose ");
    const std::string told = info(again.output + ".organ.toml").out;
    EXPECT_CONTAINS(told, "lost       part of ");
    EXPECT_EQ(told.find("voxels)"), std::string::npos) << "a surface has none";
  }
}

/// A tumour wholly within the liver, as labels: the liver's surface has a cavity with the tumour in it.
TEST(OrganRoundTrip, AnOrganWithinAnotherOneComesBackInItsCavity) {
  const test::TemporaryFolder folder;
  LabelVolume volume = test::ball_volume(32, 3, {0, 0, 0}, 40);
  const LabelVolume inner = test::ball_volume(32, 3, {5, 0, 0}, 14);
  for (std::size_t n = 0; n < inner.labels.size(); ++n)
    if (inner.labels[n] != 0) volume.labels[n] = 2;
  const fs::path map = folder.write("map.nii.gz", nifti_gz_bytes(volume.size, volume.index_to_ras_mm, volume.labels));
  OrganImportOptions options = asking(map, folder / "a");
  options.all = true;
  options.label_table = folder.write("t.csv", "1,liver\n2,tumour\n").string();
  ASSERT_EQ(imported(options).code, 0);
  const double liver = load_organ(folder / "a.scene.toml#liver").surface.volume_m3();
  for (const char* format : {"ply", "stl"}) {
    const fs::path organs = folder / (std::string("organs_") + format);
    exported(folder / "a.scene.toml", organs, format);
    OrganImportOptions again = asking(organs, folder / (std::string("b_") + format));
    const Told back = imported(again);
    EXPECT_EQ(back.code, 0) << back.err;
    EXPECT_NEAR(load_organ(again.output + ".scene.toml#liver").surface.volume_m3(), liver, 5e-3 * liver) << format;
  }
  exported(folder / "a-liver.organ.toml", folder / "liver.stl", "ply");
  OrganImportOptions alone = asking(folder / "liver.stl", folder / "alone");
  const Told filled = imported(alone);
  EXPECT_CONTAINS(filled.err, "a cavity of ");
  EXPECT_CONTAINS(filled.err, " mL was filled");
  EXPECT_CONTAINS(info(folder / "alone.organ.toml").out, "added      cavity of ");
}

TEST(OrganRoundTrip, TwoOrgansInOnePlaceAreToldAndWarningsSayOfWhich) {
  const test::TemporaryFolder folder;
  fs::create_directory(folder / "s");
  const TriangleSurface liver =
      test::joined(test::sphere(Vec3::Zero(), 0.05, 3), turned_over(test::sphere(Vec3(0, 0.03, 0), 0.008, 2)));
  folder.write("s/liver.ply", mm_ply(liver));
  folder.write("s/tumour.ply", mm_ply(test::sphere(Vec3(0.01, 0, 0), 0.02, 3)));
  OrganImportOptions options = asking(folder / "s", folder / "out");
  options.surface.unit = "mm";
  const Told told = imported(options);
  EXPECT_EQ(told.code, 2);
  EXPECT_CONTAINS(told.err, "warning: tumour lies within liver: the two overlap");
  EXPECT_CONTAINS(told.err, "note: liver: a cavity of ");
  const Told found = info(folder / "out.scene.toml");
  EXPECT_EQ(found.code, 2);
  EXPECT_CONTAINS(found.out, "OVERLAP: tumour lies within liver");
  EXPECT_CONTAINS(test::message_of<InputError>([&] { require_sound(load_organ(folder / "out.scene.toml")); }),
                  "tumour lies within liver");
}

}  // namespace
}  // namespace trocar::organ_round_trip_test
