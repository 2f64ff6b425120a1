// What import_surface promises whatever the format: no names out of headers, regions and parts by name, speed, the same
// answer twice.
#include <gtest/gtest.h>

#include <chrono>

#include "haptics/input_error.h"
#include "tests/tissue/mesh/files/scene_writers.h"
#include "tests/tissue/support/temporary_folder.h"
#include "tissue/mesh/surface/topology.h"
#include "tissue/organ/surface_import.h"

namespace trocar::surface_import_promises_test {
namespace {

using namespace test;

TriangleSurface ball_mm(int levels = 3) { return scaled(sphere(Vec3(0.02, 0.05, -0.01), 0.04, levels), 1e3); }

std::string sentences(const ImportedSurface& imported) {
  std::string text;
  for (const auto* list : {&imported.decisions, &imported.repairs, &imported.warnings})
    for (const std::string& sentence : *list) text += sentence + "\n";
  return text;
}

/// All the words that come out of a file, whether it is read or not.
std::string words_about(const std::filesystem::path& path, const std::string& unit) {
  try {
    return sentences(import_surface(path, unit));
  } catch (const InputError& error) {
    return error.what();
  }
}

TEST(SurfacePromises, NamesInHeadersAndCommentsComeOutNowhere) {
  TemporaryFolder folder;
  const std::string patient = "DOE^JANE 19500101 Mercy Hospital";
  std::string ply = ascii_ply(ball_mm(), 1);
  ply.insert(ply.find("element"), "comment " + patient + "\n");
  std::string xml = vtp(ball_mm(), {});
  xml.insert(xml.find("<PolyData>"), "<!-- " + patient + " -->\n");
  std::string document =
      gltf_of({{"a", scaled(ball_mm(), 1e-3), ""}}, "", ",\"extras\":{\"who\":\"" + patient + "\"}").json;
  document.replace(document.find("\"version\":\"2.0\""), 15, "\"version\":\"2.0\",\"copyright\":\"" + patient + "\"");
  const Gltf scene{document, gltf_of({{"a", scaled(ball_mm(), 1e-3), ""}}).binary};
  const std::vector<std::pair<std::string, std::string>> files{
      {"a.stl", stl_binary(ball_mm(), patient)},
      {"a.ply", ply},
      {"a.obj", obj_text(ball_mm(), "# " + patient + "\n")},
      {"a.off", "OFF # " + patient + off_text(ball_mm()).substr(3)},
      {"a.vtk", vtk_surface(ball_mm(), {false, false, false, false, patient})},
      {"b.vtk", vtk_surface(ball_mm(), {true, true, false, false, patient})},
      {"a.vtp", xml},
      {"a.glb", glb(scene)},
      {"a.fbx", "; FBX 7.4.0 project file\n; " + patient + fbx(scaled(ball_mm(), 0.1), fbx_settings(1)).substr(24)}};
  for (const auto& [name, bytes] : files)
    for (const std::string unit : {"mm", "m", ""})
      for (const std::size_t cut : {std::size_t{0}, bytes.size() / 2, bytes.size() - 60}) {
        const std::string words = words_about(folder.write(name, bytes.substr(0, bytes.size() - cut)), unit);
        for (const char* piece : {"DOE", "JANE", "1950", "Mercy"})
          EXPECT_EQ(words.find(piece), std::string::npos) << name << ": " << words;
      }
}

TEST(SurfacePromises, RegionsOfTetrahedraAreTakenByName) {
  TemporaryFolder folder;
  // Two cubes of tetrahedra side by side in one Gmsh file, the left one named.
  const FileTetrahedra left = star_of(box(Vec3::Zero(), Vec3::Constant(50))),
                       right = star_of(box(Vec3(50, 0, 0), Vec3(90, 40, 40)));
  std::string text =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n3 1 \"left lobe\"\n$EndPhysicalNames\n$Nodes\n18\n";
  for (std::size_t n = 0; n < 9; ++n) text += std::to_string(n + 1) + " " + triple(left.vertices[n]) + "\n";
  for (std::size_t n = 0; n < 9; ++n) text += std::to_string(n + 10) + " " + triple(right.vertices[n]) + "\n";
  text += "$EndNodes\n$Elements\n24\n";
  for (std::size_t t = 0; t < 24; ++t) {
    const auto& corners = t < 12 ? left.tetrahedra[t] : right.tetrahedra[t - 12];
    text += std::to_string(t + 1) + (t < 12 ? " 4 2 1 1" : " 4 2 2 2");
    for (const std::int32_t corner : corners) text += " " + std::to_string(corner + (t < 12 ? 1 : 10));
    text += "\n";
  }
  const auto path = folder.write("a.msh", text + "$EndElements\n");
  SurfaceImportOptions options;
  options.unit = "mm", options.part = "left lobe";
  const ImportedSurface lobe = import_surface(path, options);
  EXPECT_NEAR(lobe.surface.volume_m3(), 125e-6, 1e-12);
  ASSERT_EQ(lobe.parts.size(), 2U);
  EXPECT_EQ(lobe.parts[1].name, "volume 2");
  EXPECT_EQ(lobe.parts[0].triangles, 12U);
  const ImportedTetrahedra solid = read_tetrahedra(path, options);
  EXPECT_EQ(solid.tetrahedra.size(), 12U);
  EXPECT_EQ(solid.vertices.size(), 9U);
  EXPECT_EQ(solid.unit, "mm");
  options.part = "volume 2";
  EXPECT_NEAR(import_surface(path, options).surface.volume_m3(), 64e-6, 1e-12);
  EXPECT_EQ(read_tetrahedra(path, options).regions.front(), 1);
  options.part = "right lobe";
  EXPECT_CONTAINS(message_of<InputError>([&] { import_surface(path, options); }),
                  "has no part \"right lobe\" (its parts: left lobe, volume 2)");
}

TEST(SurfacePromises, UnitsAndFramesGoForTetrahedraToo) {
  TemporaryFolder folder;
  const auto path = folder.write("a.vtk", vtk_grid(star_of(ball_mm()), {}));
  EXPECT_CONTAINS(message_of<InputError>([&] { read_tetrahedra(path, {}); }), "VTK carries no unit");
  SurfaceImportOptions options;
  options.unit = "mm", options.frame = "LPS";
  const ImportedTetrahedra solid = read_tetrahedra(path, options);
  Vec3 low = solid.vertices[0];
  for (const Vec3& p : solid.vertices) low = low.cwiseMin(p);
  EXPECT_NEAR(low.x(), -0.06, 1e-6);
  EXPECT_NEAR(low.y(), -0.09, 1e-6);
  EXPECT_NEAR(low.z(), -0.05, 1e-6);
}

TEST(SurfacePromises, RefusalsListThePartsOfTheFile) {
  TemporaryFolder folder;
  TriangleSurface open = scaled(ball_mm(), 1e-3);
  open.triangles.resize(100);
  std::vector<GltfNode> nodes;
  for (int n = 0; n < 15; ++n) nodes.push_back({"patch " + std::to_string(n), open, ""});
  const std::string message = words_about(folder.write("a.glb", glb(gltf_of(nodes))), "");
  EXPECT_CONTAINS(message, "; or take one part with --part (its parts: patch 0, patch 1");
  EXPECT_CONTAINS(message, "patch 11 and 3 more)");
}

TEST(SurfacePromises, AHundredThousandTrianglesTakeSeconds) {
  TemporaryFolder folder;
  const auto path = folder.write("a.stl", stl_binary(ball_mm(7)));  // 131 072
  const auto start = std::chrono::steady_clock::now();
  const ImportedSurface imported = import_surface(path, "mm");
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  EXPECT_EQ(imported.surface.triangles.size(), 131072U);
  EXPECT_EQ(imported.surface.vertices.size(), 65538U);
  EXPECT_LT(seconds, 60);  // two seconds on a slow core; sanitizers and busy machines take more
}

TEST(SurfacePromises, IsSurfaceFileKnowsTheExtensions) {
  for (const char* name :
       {"a.stl", "a.PLY", "b/c.obj", "a.off", "a.glb", "a.gltf", "a.fbx", "a.vtk", "a.vtp", "a.vtu", "a.msh"})
    EXPECT_TRUE(is_surface_file(name)) << name;
  for (const char* name : {"a.nii.gz", "a.nrrd", "a.dcm", "a", "stl", "a.toml"})
    EXPECT_FALSE(is_surface_file(name)) << name;
}

TEST(SurfacePromises, MirroredAndMixedWindingsAllEndOutward) {
  TemporaryFolder folder;
  TriangleSurface mixed = ball_mm();
  for (std::size_t t = 0; t < mixed.triangles.size(); t += 2) std::swap(mixed.triangles[t][0], mixed.triangles[t][1]);
  const ImportedSurface imported = import_surface(folder.write("a.obj", obj_text(mixed)), "mm");
  EXPECT_NEAR(imported.surface.volume_m3() * 1e9, ball_mm().volume_m3(), 1);
  EXPECT_EQ(analyse_topology(imported.surface).misoriented_edges, 0U);
  EXPECT_CONTAINS(sentences(imported), "turned 256 triangles outwards");
}

TEST(SurfacePromises, UnusedVerticesDoNotCount) {
  TemporaryFolder folder;
  TriangleSurface strays = ball_mm();
  strays.vertices.emplace_back(1e6, 1e6, 1e6);  // would make the box a kilometre wide
  const ImportedSurface imported = import_surface(folder.write("a.off", off_text(strays)), "mm");
  EXPECT_EQ(imported.surface.vertices.size(), ball_mm().vertices.size());
  EXPECT_TRUE(imported.repairs.empty()) << imported.repairs[0];
}

}  // namespace
}  // namespace trocar::surface_import_promises_test
