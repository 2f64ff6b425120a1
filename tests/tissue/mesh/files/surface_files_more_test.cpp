// Whole surface files: poses and units that must not matter, the check of PLY, files that appear whole, filled holes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "haptics/input_error.h"
#include "tests/tissue/mesh/files/scene_writers.h"
#include "tests/tissue/support/shapes.h"
#include "tests/tissue/support/temporary_folder.h"
#include "tissue/mesh/files/file_kind.h"
#include "tissue/mesh/files/patient_axes.h"
#include "tissue/mesh/surface/rescue.h"
#include "tissue/mesh/surface/topology.h"
#include "tissue/organ/organ_manifest.h"
#include "tissue/organ/ply_check.h"
#include "tissue/organ/ply_file.h"
#include "tissue/organ/staged_file.h"
#include "tissue/organ/surface_import.h"

namespace trocar::test::surface_files_more_test {
namespace {

TriangleSurface ellipsoid() {
  TriangleSurface surface = sphere(Vec3::Zero(), 1, 3);
  for (Vec3& point : surface.vertices) point = point.cwiseProduct(Vec3(0.05, 0.03, 0.02)) + Vec3(0.01, -0.02, 0.03);
  return surface;
}

/// The body written in every frame and declared as such lies in one place afterwards.
TEST(SurfaceFilesMore, TheFrameOfTheFileLeavesTheOrganWhereItIs) {
  const TemporaryFolder folder;
  const TriangleSurface body = ellipsoid();
  for (const std::string frame : {"RAS", "LPS", "LSA", "SRA", "LAS", "ARS", "IPR"}) {
    TriangleSurface turned = scaled(body, 1000);
    for (Vec3& point : turned.vertices) point = to_ras(frame).transpose() * point;
    if (to_ras(frame).determinant() < 0)
      for (auto& triangle : turned.triangles) std::swap(triangle[1], triangle[2]);
    SurfaceImportOptions options;
    options.unit = "mm", options.frame = frame;
    const ImportedSurface imported = import_surface(folder.write("a.off", off_text(turned)), options);
    EXPECT_EQ(imported.frame, frame);
    EXPECT_NEAR(imported.surface.volume_m3(), body.volume_m3(), 1e-6 * body.volume_m3()) << frame;
    EXPECT_LT((volume_centroid_m(imported.surface) - volume_centroid_m(body)).norm(), 1e-7) << frame;
    EXPECT_TRUE(analyse_topology(imported.surface).manifold());
  }
}

TEST(SurfaceFilesMore, TheOrderOfTrianglesAndTheirSenseLeaveTheOrganWhereItIs) {
  const TemporaryFolder folder;
  std::mt19937_64 random(401);
  const TriangleSurface body = ellipsoid();
  for (int round = 0; round < 6; ++round) {
    TriangleSurface mixed = scaled(body, 100);
    std::shuffle(mixed.triangles.begin(), mixed.triangles.end(), random);
    for (auto& triangle : mixed.triangles)
      if (random() % 2 == 0) std::swap(triangle[0], triangle[2]);
    const ImportedSurface imported = import_surface(folder.write("a.obj", obj_text(mixed)), "cm");
    EXPECT_EQ(imported.surface.triangles.size(), body.triangles.size());
    EXPECT_NEAR(imported.surface.volume_m3(), body.volume_m3(), 1e-6 * body.volume_m3());
    EXPECT_LT((volume_centroid_m(imported.surface) - volume_centroid_m(body)).norm(), 1e-7);
  }
}

TEST(SurfaceFilesMore, AnImportWrittenAndImportedAgainIsTheSameFile) {
  const TemporaryFolder folder;
  const ImportedSurface first = import_surface(folder.write("a.stl", stl_binary(scaled(ellipsoid(), 1000))), "mm");
  const std::string bytes = ply_bytes(first.surface);
  EXPECT_EQ(ply_bytes(import_surface(folder.write("a.stl", stl_binary(scaled(ellipsoid(), 1000))), "mm").surface),
            bytes);
  const TriangleSurface back = parse_ply(bytes, "a.ply");
  EXPECT_EQ(ply_bytes(back), bytes);
  EXPECT_EQ(back.triangles, first.surface.triangles);
  EXPECT_NEAR(back.volume_m3(), ellipsoid().volume_m3(), 1e-5 * ellipsoid().volume_m3());
}

TEST(SurfaceFilesMore, TetrahedraComeInWithTheVolumeOfTheirSurface) {
  const TemporaryFolder folder;
  const FileTetrahedra star = star_of(scaled(ellipsoid(), 1000));
  SurfaceImportOptions options;
  options.unit = "mm";
  for (const bool binary : {false, true}) {
    const auto path = folder.write("a.msh", msh_4(star.vertices, elements_of(star), binary));
    const ImportedTetrahedra mesh = read_tetrahedra(path, options);
    double six_volumes = 0;
    for (const auto& t : mesh.tetrahedra) {
      const auto at = [&](std::size_t n) { return mesh.vertices[static_cast<std::size_t>(t[n])]; };
      const double part = (at(1) - at(0)).cross(at(2) - at(0)).dot(at(3) - at(0));
      EXPECT_GT(part, 0);
      six_volumes += part;
    }
    const double surface = import_surface(path, options).surface.volume_m3();
    EXPECT_NEAR(six_volumes / 6, surface, 1e-9 * surface);
    EXPECT_NEAR(surface, ellipsoid().volume_m3(), 1e-6 * surface);
  }
}

TEST(SurfaceFilesMore, PartsAreListedWithTheirTrianglesAndTakenAlone) {
  const TemporaryFolder folder;
  const TriangleSurface large = scaled(ellipsoid(), 1000), small = box(Vec3(200, 0, 0), Vec3(230, 20, 25));
  const auto path = folder.write("a.stl", stl_text(large, "left lobe") + stl_text(small, "stone"));
  const auto parts = list_surface_parts(path);
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(parts[0].name, "left lobe");
  EXPECT_EQ(parts[0].triangles, large.triangles.size());
  EXPECT_EQ(parts[1].triangles, 12U);
  SurfaceImportOptions options;
  options.unit = "mm", options.part = "stone";
  EXPECT_NEAR(import_surface(path, options).surface.volume_m3(), 30e-3 * 20e-3 * 25e-3, 1e-12);
  options.part = "gravel";
  const std::string message = message_of<InputError>([&] { import_surface(path, options); });
  EXPECT_CONTAINS(message, "gravel");
  EXPECT_CONTAINS(message, "stone");
}

TEST(FileKindMore, EveryExtensionInAnyCaseIsASurfaceFileAndNothingElseIs) {
  for (const char* name : {"a.stl", "a.PLY", "a.Obj", "a.off", "a.glb", "a.gltf", "a.FBX", "a.vtk", "a.vtp", "a.VTU",
                           "a.msh", "a.b.stl"}) {
    EXPECT_TRUE(is_surface_file(name)) << name;
    EXPECT_TRUE(kind_by_extension(name).has_value()) << name;
  }
  for (const char* name : {"stl", ".stl", "a.stl.gz", "a", "a.", "a.st", "a.stlx", "a.nii", "a.stl/b"}) {
    EXPECT_FALSE(is_surface_file(name)) << name;
    EXPECT_FALSE(kind_by_extension(name).has_value()) << name;
  }
}

std::string binary_ply(const TriangleSurface& surface, bool big_endian) {
  std::string bytes = "ply\nformat binary_" + std::string(big_endian ? "big" : "little") +
                      "_endian 1.0\nelement vertex " + std::to_string(surface.vertices.size()) +
                      "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
                      std::to_string(surface.triangles.size()) +
                      "\nproperty list ushort int vertex_indices\nend_header\n";
  for (const Vec3& point : surface.vertices)
    for (int axis = 0; axis < 3; ++axis) put(bytes, point[axis], big_endian);
  for (const auto& triangle : surface.triangles) {
    put(bytes, std::uint16_t{3}, big_endian);
    for (const std::int32_t index : triangle) put(bytes, index, big_endian);
  }
  return bytes;
}

TEST(PlyCheckMore, EveryCutNamesTheElementAtWhichTheDataEnd) {
  const TriangleSurface body = box(Vec3::Zero(), Vec3::Ones());
  for (const bool big_endian : {false, true}) {
    const std::string whole = binary_ply(body, big_endian);
    EXPECT_NO_THROW(check_ply(whole, "a.ply"));
    const std::size_t data = whole.size() - 8 * 24 - 12 * 14;
    for (std::size_t length = data; length < whole.size(); ++length) {
      const std::size_t at = length - data;
      const std::string wanted = at < 8 * 24 ? "vertex " + std::to_string(at / 24) + " of 8"
                                             : "face " + std::to_string((at - 8 * 24) / 14) + " of 12";
      EXPECT_CONTAINS(message_of<InputError>([&] { check_ply(whole.substr(0, length), "a.ply"); }),
                      "a.ply: the file ends at " + wanted);
    }
  }
}

TEST(PlyCheckMore, HeadersAreRefusedWithTheirLine) {
  const auto refusal = [](const std::string& head) {
    return message_of<InputError>([&] { check_ply(head, "a.ply"); });
  };
  EXPECT_CONTAINS(refusal("plum\n"), "a.ply:1:1: \"ply\" expected");
  EXPECT_CONTAINS(refusal("ply\nformat ternary 1.0\n"), "a.ply:2:1: unknown format ternary");
  EXPECT_CONTAINS(refusal("ply\nformat ascii 1.0\ncomment x\nproperty float x\n"),
                  "a.ply:4:1: \"property\" is not expected here");
  EXPECT_CONTAINS(refusal("ply\nformat ascii 1.0\nelement vertex 20000001\n"), "a.ply:3:1: element count is no number");
  EXPECT_CONTAINS(refusal("ply\nformat ascii 1.0\nelement v 1\nproperty real x\n"), "a.ply:4:1: unknown type real");
  EXPECT_CONTAINS(refusal("ply\nformat ascii 1.0\nelement v 1\nproperty list float int x\n"),
                  "no whole number counts this list");
  EXPECT_CONTAINS(refusal("ply\nelement v 0\nproperty int x\nend_header\n"), "names no format");
  EXPECT_CONTAINS(refusal("ply\nformat ascii 1.0\nelement v 1\nend_header\n1\n"), "element v has no property");
  EXPECT_CONTAINS(refusal("ply\nformat ascii 1.0\n"), "the header does not end");
}

TEST(StagedFileMore, EachCommitReplacesTheWholeFileAndFreesItsLock) {
  const TemporaryFolder folder;
  std::mt19937_64 random(402);
  for (int round = 0; round < 20; ++round) {
    std::string bytes(random() % 5000, '\0');
    for (char& byte : bytes) byte = static_cast<char>(random());
    StagedFile(folder / "a", bytes).commit();
    EXPECT_EQ(read_bytes(folder / "a"), bytes);
  }
  { const StagedFile left(folder / "a", "left alone"); }
  StagedFile again(folder / "a", "again"), other(folder / "b", "other");
  again.commit(), other.commit();
  EXPECT_EQ(read_bytes(folder / "a"), "again");
  EXPECT_EQ(read_bytes(folder / "b"), "other") << "two files of one folder are written side by side";
}

/// A box without one face: the hole's rim is a square of known span, and a flat lid brings the volume back.
TEST(HolesMore, AMissingFaceOfABoxIsMeasuredAndCovered) {
  const Vec3 size(0.06, 0.04, 0.05);
  for (std::size_t face = 0; face < 6; ++face) {
    TriangleSurface open = box(Vec3::Zero(), size);
    open.triangles.erase(open.triangles.begin() + static_cast<std::ptrdiff_t>(2 * face),
                         open.triangles.begin() + static_cast<std::ptrdiff_t>(2 * face + 2));
    Vec3 rim = size;
    rim[2 - static_cast<Eigen::Index>(face / 2)] = 0;
    std::vector<FilledHole> holes;
    EXPECT_CONTAINS(message_of<InputError>([&] { holes_filled(open, 0.9 * rim.norm(), holes, "a.stl"); }), "a.stl");
    holes.clear();
    const TriangleSurface filled = holes_filled(open, 1.1 * rim.norm(), holes, "a.stl");
    ASSERT_EQ(holes.size(), 1U);
    EXPECT_EQ(holes[0].edges, 4U);
    EXPECT_NEAR(holes[0].span_m, rim.norm(), 1e-9);
    EXPECT_TRUE(analyse_topology(filled).closed());
    EXPECT_GE(holes[0].area_m2, 0.99 * size.prod() / (size - rim).norm()) << "no lid is smaller than the flat one";
  }
}

}  // namespace
}  // namespace trocar::test::surface_files_more_test
