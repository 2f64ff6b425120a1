// PLY and FBX through the library in its child process: what exporters write, and what damage does.
#include <gtest/gtest.h>

#include "haptics/input_error.h"
#include "tests/tissue/mesh/files/scene_writers.h"
#include "tests/tissue/support/temporary_folder.h"
#include "tissue/mesh/files/read_surface_file.h"
#include "tissue/mesh/files/scene_file.h"
#include "tissue/organ/ply_file.h"
#include "tissue/organ/surface_import.h"

namespace trocar::scene_formats_test {
namespace {

using namespace test;

const TriangleSurface kBox = box(Vec3::Zero(), Vec3(10, 20, 30));

class Scenes : public ::testing::Test {
 protected:
  SurfaceFile read(const std::string& name, const std::string& bytes) {
    return read_surface_file(folder_.write(name, bytes), {});
  }
  std::string refusal(const std::string& name, const std::string& bytes) {
    return message_of<InputError>([&] { read(name, bytes); });
  }
  TemporaryFolder folder_;
};

TEST_F(Scenes, PlyOfQuadsWithNormalsAndColours) {
  const std::string text =
      "ply\nformat ascii 1.0\ncomment by a scanner\nelement vertex 8\nproperty double x\nproperty double y\nproperty "
      "double z\n"
      "property float nx\nproperty float ny\nproperty float nz\nproperty uchar red\nelement face 6\nproperty list "
      "uchar uint vertex_indices\n"
      "property uchar green\nend_header\n0 0 0 0 0 1 255\n1 0 0 0 0 1 255\n1 1 0 0 0 1 255\n0 1 0 0 0 1 255\n0 0 1 0 0 "
      "1 255\n1 0 1 0 0 1 255\n"
      "1 1 1 0 0 1 255\n0 1 1 0 0 1 255\n4 3 2 1 0 9\n4 4 5 6 7 9\n4 0 1 5 4 9\n4 1 2 6 5 9\n4 2 3 7 6 9\n4 3 0 4 7 "
      "9\n";
  const SurfaceFile file = read("a.ply", text);
  ASSERT_EQ(file.parts.size(), 1U);
  EXPECT_EQ(file.parts[0].surface.triangles.size(), 12U);
  EXPECT_NEAR(file.parts[0].surface.volume_m3(), 1, 1e-9);
  EXPECT_FALSE(file.unit_m);
}

TEST_F(Scenes, PlyInBothBinaryOrders) {
  for (const bool big_endian : {false, true}) {
    std::string bytes =
        std::string("ply\nformat ") + (big_endian ? "binary_big_endian" : "binary_little_endian") +
        " 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\nelement face 12\n"
        "property list uchar int vertex_indices\nend_header\n";
    for (const Vec3& p : kBox.vertices)
      for (int axis = 0; axis < 3; ++axis) put(bytes, static_cast<float>(p[axis]), big_endian);
    for (const auto& triangle : kBox.triangles) {
      bytes += '\3';
      for (const std::int32_t vertex : triangle) put(bytes, vertex, big_endian);
    }
    EXPECT_NEAR(read("a.ply", bytes).parts.at(0).surface.volume_m3(), 6000, 1e-6) << big_endian;
    EXPECT_CONTAINS(refusal("a.ply", bytes.substr(0, bytes.size() - 1)), "the file ends at face 11 of 12");
  }
}

TEST_F(Scenes, OurOwnSurfaceFilesComeBack) {
  const auto path = folder_.write("organ.ply", ply_bytes(scaled(kBox, 1e-3)));
  EXPECT_NEAR(import_surface(path, "m").surface.volume_m3(), 6e-6, 1e-11);
}

TEST_F(Scenes, PlyWithoutFacesOrWithBadOnes) {
  std::string cloud = ascii_ply(kBox, 1);
  cloud = cloud.substr(0, cloud.find("element face")) + "end_header\n" + cloud.substr(cloud.find("end_header\n") + 11);
  EXPECT_CONTAINS(refusal("a.ply", cloud), "a.ply");
  std::string bad = ascii_ply(kBox, 1);
  bad.replace(bad.rfind("3 3 7 5"), 7, "3 3 7 8");
  EXPECT_CONTAINS(refusal("a.ply", bad), "names vertex 8");
}

TEST_F(Scenes, FbxNodesCarryNameScaleAndPlace) {
  std::string text = fbx(kBox, fbx_settings(1));
  const std::string properties =
      "\t\tProperties70:  {\n\t\t\tP: \"Lcl Translation\", \"Lcl Translation\", \"\", \"A\",100,0,0\n"
      "\t\t\tP: \"Lcl Scaling\", \"Lcl Scaling\", \"\", \"A\",2,2,2\n\t\t}\n\t}\n}\nConnections";
  const std::size_t at = text.find("\t\tProperties70:  {\n\t\t}\n\t}\n}\nConnections");
  ASSERT_NE(at, std::string::npos);
  text = text.substr(0, at) + properties + text.substr(text.find(":  {", text.find("Connections")));
  const SurfaceFile file = read("a.fbx", text);
  ASSERT_EQ(file.parts.size(), 1U);
  EXPECT_EQ(file.parts[0].name, "organ");
  EXPECT_NEAR(file.parts[0].surface.volume_m3(), 8 * 6000, 1e-3);
  EXPECT_NEAR(file.parts[0].surface.bounds().min().x(), 100, 1e-4);
  EXPECT_EQ(*file.unit_m, 0.01);
}

TEST_F(Scenes, FbxSettingsThatAreNoScaleAreRefused) {
  EXPECT_CONTAINS(refusal("a.fbx", fbx(kBox, fbx_settings(1e9))), "UnitScaleFactor of the FBX settings is no scale");
  EXPECT_CONTAINS(refusal("a.fbx", fbx(kBox, fbx_settings(-1))), "no scale");
}

TEST_F(Scenes, FbxWithoutAxesIsTakenAsYUp) {
  const SurfaceFile file = read("a.fbx", fbx(kBox, fbx_settings(1)));
  EXPECT_EQ(file.frame, "LSA");
  EXPECT_CONTAINS(file.unit_source, "UnitScaleFactor 1 (times a centimetre)");
}

TEST_F(Scenes, DamagedScenesAreRefusedByName) {
  EXPECT_CONTAINS(refusal("a.fbx", std::string("Kaydara FBX Binary  \0\x1a\0", 23) + std::string(40, '\xff')), "a.fbx");
  EXPECT_CONTAINS(refusal("a.fbx", "; FBX 7.4.0 project file\nFBXHeaderExtension:  {\n"), "a.fbx");
  EXPECT_CONTAINS(refusal("a.fbx", "; FBX 7.4.0 project file\n"), "a.fbx");
}

// A Wavefront file names its materials: nothing but the file itself may be opened for it.
TEST_F(Scenes, OtherFilesAreNeverOpened) {
  folder_.write("m.mtl", "newmtl a\nmap_Kd /etc/passwd\n");
  EXPECT_EQ(read("a.obj", obj_text(kBox, "mtllib m.mtl\nmtllib ../../../etc/passwd\nusemtl a\n"))
                .parts.at(0)
                .surface.triangles.size(),
            12U);
}

TEST_F(Scenes, ProgressIsAskedWhileTheChildReads) {
  const auto path = folder_.write("a.ply", ascii_ply(kBox, 1));
  int asked = 0;
  read_surface_file(path, [&](std::string_view, double) { ++asked; });
  EXPECT_GT(asked, 0);
  struct Stopped {};
  EXPECT_THROW(read_surface_file(path, [](std::string_view, double) { throw Stopped(); }), Stopped);
}

TEST_F(Scenes, MissingEmptyAndFolderPaths) {
  EXPECT_CONTAINS(message_of<InputError>([&] { read_surface_file(folder_ / "none.stl", {}); }), "no such file");
  EXPECT_CONTAINS(message_of<InputError>([&] { read_surface_file(folder_.path(), {}); }), "no such file");
  EXPECT_CONTAINS(refusal("a.stl", ""), "the file is empty");
  EXPECT_CONTAINS(refusal("a.off", "OFF\n0 0 0\n"), "holds no triangles");
  EXPECT_CONTAINS(refusal("a.obj", "v 0 0 0\nv 1 0 0\n"), "holds no triangles");
}

TEST_F(Scenes, FilesAboveTheCapAreNotOpened) {
  const auto path = folder_.write("a.stl", "solid x");
  std::filesystem::resize_file(path, kMaxSurfaceBytes + 1);
  EXPECT_CONTAINS(message_of<InputError>([&] { read_surface_file(path, {}); }), "larger than 512 MiB");
}

}  // namespace
}  // namespace trocar::scene_formats_test
