#include "tissue/mesh/files/file_kind.h"

#include <gtest/gtest.h>

#include "haptics/input_error.h"
#include "tests/tissue/mesh/files/scene_writers.h"
#include "tests/tissue/support/temporary_folder.h"

namespace trocar::file_kind_test {
namespace {

using namespace std::string_literals;
using namespace test;

std::string refusal(const std::string& name, const std::string& bytes) {
  return message_of<InputError>([&] { surface_kind(name, bytes); });
}

TEST(FileKind, ExtensionsInAnyCase) {
  EXPECT_EQ(kind_by_extension("a/b.STL"), SurfaceKind::kStl);
  EXPECT_EQ(kind_by_extension("a/b.Glb"), SurfaceKind::kGlb);
  EXPECT_EQ(kind_by_extension("liver.ply"), SurfaceKind::kPly);
  EXPECT_FALSE(kind_by_extension("liver.nii.gz"));
  EXPECT_FALSE(kind_by_extension("liver"));
  EXPECT_FALSE(kind_by_extension(".stl"));
}

TEST(FileKind, EachFormatIsKnownByItsFirstBytes) {
  const TriangleSurface shape = box(Vec3::Zero(), Vec3::Ones());
  const FileTetrahedra solid = star_of(shape);
  const std::vector<std::tuple<std::string, std::string, SurfaceKind>> cases{
      {"a.stl", stl_text(shape), SurfaceKind::kStl},
      {"a.stl", stl_binary(shape), SurfaceKind::kStl},
      {"a.ply", ascii_ply(shape, 1), SurfaceKind::kPly},
      {"a.obj", obj_text(shape), SurfaceKind::kObj},
      {"a.off", off_text(shape), SurfaceKind::kOff},
      {"a.vtk", vtk_surface(shape, {}), SurfaceKind::kVtk},
      {"a.vtp", vtp(shape, {}), SurfaceKind::kVtp},
      {"a.vtu", vtu(solid, {}), SurfaceKind::kVtu},
      {"a.msh", msh_1(shape.vertices, elements_of(shape)), SurfaceKind::kMsh},
      {"a.msh", msh_4(shape.vertices, elements_of(shape), true), SurfaceKind::kMsh},
      {"a.glb", glb(gltf_of({{"a", shape, ""}})), SurfaceKind::kGlb},
      {"a.gltf", gltf_of({{"a", shape, ""}}).json, SurfaceKind::kGltf},
      {"a.fbx", fbx(shape, fbx_settings(1)), SurfaceKind::kFbx}};
  for (const auto& [name, bytes, kind] : cases) EXPECT_EQ(surface_kind(name, bytes), kind) << name;
  for (const auto& [name, bytes, kind] : cases)  // every format under every other's name
    for (const auto& [other_name, other_bytes, other_kind] : cases) {
      if (kind == other_kind) continue;
      EXPECT_CONTAINS(refusal(name, other_bytes), "signature: the name promises");
    }
}

TEST(FileKind, SaysWhatTheBytesLookLike) {
  EXPECT_CONTAINS(refusal("a.stl", "ply\nformat ascii 1.0\n"), "promises an STL file, but it looks like a PLY file");
  EXPECT_CONTAINS(refusal("a.ply", "# vtk DataFile Version 3.0\n"), "looks like a VTK legacy file");
  EXPECT_CONTAINS(refusal("a.vtk", "PK\3\4rest"), "a zip archive");
  EXPECT_CONTAINS(refusal("a.obj", "\x89PNG\r\n"), "a PNG picture");
  EXPECT_CONTAINS(refusal("a.glb", "<!DOCTYPE html><html>404"), "a web page (perhaps a failed download)");
  EXPECT_CONTAINS(refusal("a.vtp", "<VTKFile type=\"ImageData\">"), "another kind of VTK XML file");
  EXPECT_CONTAINS(refusal("a.vtp", "<VTKFile type=\"UnstructuredGrid\">"), "a VTK XML unstructured grid");
  EXPECT_CONTAINS(refusal("a.stl", std::string(128, '\0') + "DICM more"), "a DICOM file");
  EXPECT_CONTAINS(refusal("a.stl", "\x1f\x8b"s + "packed"), "gzip");
  EXPECT_CONTAINS(refusal("a.stl", "\x5c\x01\0\0"s + std::string(344, '\0')), "a NIfTI volume");
  EXPECT_CONTAINS(refusal("a.msh", "nothing known"), "does not begin like one");
  EXPECT_CONTAINS(refusal("a.off", "v 1 2 3\nf 1 2 3\n"), "a Wavefront OBJ file");
}

TEST(FileKind, OtherFormatsAreRefusedByNameWithAdvice) {
  EXPECT_CONTAINS(refusal("a.3mf", "PK\3\4"), "3MF is not read: export STL or PLY");
  EXPECT_CONTAINS(refusal("a.STEP", "ISO-10303-21;"), "STEP holds exact shapes");
  EXPECT_CONTAINS(refusal("a.blend", "BLENDER"), "Blender");
  EXPECT_CONTAINS(refusal("a.vti", "<VTKFile"), "is a volume");
  EXPECT_CONTAINS(refusal("a.xyz", "ply\n"), "extension: surfaces are read from .stl .ply");
  EXPECT_CONTAINS(refusal("a.xyz", "ply\n"), "it looks like a PLY file");
  EXPECT_CONTAINS(refusal("a.stl", ""), "the file is empty");
}

// assimp 5.2.5 takes some binary VTK files for OBJ when it is asked to guess.
TEST(FileKind, VtkThatHoldsLettersOfObjStaysVtk) {
  const std::string bytes =
      "# vtk DataFile Version 3.0\nvtk output\nBINARY\nDATASET POLYDATA\nPOINTS 3 float\nv 1 2 3\nf 1 2 3\n";
  EXPECT_EQ(surface_kind("a.vtk", bytes), SurfaceKind::kVtk);
  EXPECT_CONTAINS(refusal("a.obj", bytes), "looks like a VTK legacy file");
}

TEST(FileKind, BinaryStlWithSolidInItsHeaderIsKnownByItsLength) {
  const TriangleSurface shape = box(Vec3::Zero(), Vec3::Ones());
  EXPECT_EQ(looks_like(stl_binary(shape, "solid something")), "an STL file");
  EXPECT_EQ(looks_like(stl_binary(shape, "anything")), "an STL file");
  EXPECT_EQ(looks_like("anything"), "");
}

}  // namespace
}  // namespace trocar::file_kind_test
