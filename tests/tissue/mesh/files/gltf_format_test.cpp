// glTF: what the check refuses before a library reads it, nodes and parts, and files beside it.
#include <gtest/gtest.h>

#include "haptics/input_error.h"
#include "tests/tissue/mesh/files/scene_writers.h"
#include "tests/tissue/support/temporary_folder.h"
#include "tissue/mesh/files/gltf_check.h"
#include "tissue/mesh/surface/topology.h"
#include "tissue/organ/surface_import.h"

namespace trocar::gltf_format_test {
namespace {

using namespace test;

const TriangleSurface kBox = box(Vec3::Zero(), Vec3::Constant(0.1));

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

class GltfCheck : public ::testing::Test {
 protected:
  /// The check's words about a document in which one thing was changed.
  std::string refusal(const std::string& from, const std::string& to) {
    const Gltf file = gltf_of({{"a", kBox, ""}});
    return message_of<InputError>([&] {
      check_gltf(glb({replaced(file.json, from, to), file.binary}), folder_ / "a.glb");
    });
  }
  TemporaryFolder folder_;
};

TEST_F(GltfCheck, GoodFilesPass) {
  const Gltf file = gltf_of({{"a", kBox, ""}, {"b", kBox, ",\"rotation\":[0,0,0,1]"}});
  EXPECT_TRUE(check_gltf(glb(file), folder_ / "a.glb").empty());
}

TEST_F(GltfCheck, VersionsAndExtensions) {
  EXPECT_CONTAINS(refusal("\"version\":\"2.0\"", "\"version\":\"1.0\""), "glTF version 1.0 is not read");
  EXPECT_CONTAINS(refusal("{\"asset\"", "{\"extensionsRequired\":[\"KHR_draco_mesh_compression\"],\"asset\""),
                  "needs the extension KHR_draco_mesh_compression");
  EXPECT_CONTAINS(refusal("{\"asset\"", "{\"extensionsRequired\":[\"KHR_mesh_quantization\"],\"asset\""),
                  "KHR_mesh_quantization");
  const Gltf file = gltf_of({{"a", kBox, ""}}, "", ",\"extensionsRequired\":[\"KHR_materials_unlit\"],\"skins\":[{}]");
  EXPECT_CONTAINS(check_gltf(glb(file), folder_ / "a.glb").at(0), "skins were left out");
}

TEST_F(GltfCheck, LengthsAndIndicesStayInside) {
  EXPECT_CONTAINS(refusal("\"byteLength\":96", "\"byteLength\":9600"), "a view reaches beyond its buffer");
  EXPECT_CONTAINS(refusal("\"count\":8", "\"count\":9"), "an accessor reaches beyond its view");
  EXPECT_CONTAINS(refusal("\"count\":8", "\"count\":18446744073709551615"), "values of an accessor");
  EXPECT_CONTAINS(refusal("\"count\":8", "\"count\":-1"), "count is no count");
  EXPECT_CONTAINS(refusal("\"bufferView\":0", "\"bufferView\":7"), "bufferView names number 7 of 2");
  EXPECT_CONTAINS(refusal("\"POSITION\":0", "\"POSITION\":2"), "POSITION names number 2 of 2");
  EXPECT_CONTAINS(refusal("\"indices\":1", "\"indices\":9"), "indices names number 9");
  EXPECT_CONTAINS(refusal("\"mesh\":0", "\"mesh\":4"), "mesh names number 4 of 1");
  EXPECT_CONTAINS(refusal("\"componentType\":5126", "\"componentType\":5121"), "positions are not of three floats");
  EXPECT_CONTAINS(refusal("\"type\":\"SCALAR\"", "\"type\":\"NOTHING\""), "an accessor without a type");
  EXPECT_CONTAINS(refusal("\"bufferView\":0", "\"sparse\":{},\"bufferView\":0"), "sparse accessors are not read");
  EXPECT_CONTAINS(refusal("\"byteLength\":96", "\"byteLength\":\"x\""), "byteLength is no count");
}

TEST_F(GltfCheck, NodesMustBeATree) {
  EXPECT_CONTAINS(refusal("\"mesh\":0", "\"mesh\":0,\"children\":[0]"), "a scene names a node that is no root");
  EXPECT_CONTAINS(refusal("\"mesh\":0", "\"mesh\":0,\"children\":[5]"), "the nodes are no tree");
  EXPECT_CONTAINS(refusal("\"nodes\":[0]", "\"nodes\":[3]"), "no root");
  EXPECT_CONTAINS(refusal("\"mesh\":0", "\"mesh\":0,\"children\":\"x\""), "of a false type");
}

TEST_F(GltfCheck, ContainersAreChecked) {
  const std::string whole = glb(gltf_of({{"a", kBox, ""}}));
  const auto words = [&](const std::string& bytes) {
    return message_of<InputError>([&] { check_gltf(bytes, folder_ / "a.glb"); });
  };
  for (std::size_t length = 4; length < whole.size() - 8; length += 7)
    EXPECT_CONTAINS(words(whole.substr(0, length)), "a.glb");
  std::string old = whole;
  old[4] = 1;
  EXPECT_CONTAINS(words(old), "glTF version 1 is not read");
  EXPECT_CONTAINS(words("{ not json"), "damaged JSON");
  EXPECT_CONTAINS(words("[]"), "damaged JSON");
  EXPECT_CONTAINS(words("{}"), "is missing or of a false type");
}

TEST_F(GltfCheck, BuffersLieBesideTheFileOnly) {
  const auto words = [&](const std::string& uri) {
    const Gltf file = gltf_of({{"a", kBox, ""}}, ",\"uri\":\"" + uri + "\"");
    return message_of<InputError>([&] { check_gltf(file.json, folder_ / "a.gltf"); });
  };
  for (const std::string uri : {"../a.bin", "/etc/passwd", "sub/a.bin", "..\\\\a.bin", "http://example.org/a.bin",
                                "file:a.bin", "%2e%2e%2fa.bin", ".hidden"})
    EXPECT_CONTAINS(words(uri), "is not a plain file name beside it");
  EXPECT_CONTAINS(words("missing.bin"), "its buffer missing.bin is missing beside it");
  folder_.write("short.bin", "abc");
  EXPECT_CONTAINS(words("short.bin"), "has only 3: it is cut off");
  std::filesystem::create_symlink("/etc/hostname", folder_ / "link.bin");
  EXPECT_CONTAINS(words("link.bin"), "is missing beside it");
}

TEST(GltfParts, NodesAreListedAndTakenByName) {
  TemporaryFolder folder;
  const auto path =
      folder.write("a.glb", glb(gltf_of({{"liver", box(Vec3::Zero(), Vec3::Constant(0.1)), ""},
                                         {"spleen", box(Vec3::Constant(0.15), Vec3::Constant(0.2)), ""}})));
  const auto parts = list_surface_parts(path);
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(parts[0].name, "liver");
  EXPECT_EQ(parts[1].triangles, 12U);
  SurfaceImportOptions options;
  options.part = "spleen";
  EXPECT_NEAR(import_surface(path, options).surface.volume_m3(), 1.25e-4, 1e-9);
  options.part = "kidney";
  EXPECT_CONTAINS(message_of<InputError>([&] { import_surface(path, options); }),
                  "has no part \"kidney\" (its parts: liver, spleen)");
  EXPECT_NEAR(import_surface(path, "").surface.volume_m3(), 1.125e-3, 1e-9);
  options = {};
  options.only_largest = true;
  const ImportedSurface one = import_surface(path, options);
  EXPECT_NEAR(one.surface.volume_m3(), 1e-3, 1e-9);
  EXPECT_NEAR(one.lost_volumes_m3.at(0), 1.25e-4, 1e-9);
  EXPECT_CONTAINS(one.warnings.at(0), "12.5 % of what was kept");
}

TEST(GltfParts, PatchesOfSeveralNodesAreWeldedAcrossThem) {
  TemporaryFolder folder;
  const TriangleSurface whole = sphere(Vec3::Zero(), 0.05, 3);
  TriangleSurface one = whole, two = whole;
  one.triangles.assign(whole.triangles.begin(), whole.triangles.begin() + 200);
  two.triangles.assign(whole.triangles.begin() + 200, whole.triangles.end());
  const auto path = folder.write("a.glb", glb(gltf_of({{"one", one, ""}, {"two", two, ""}})));
  const ImportedSurface imported = import_surface(path, "");
  EXPECT_EQ(imported.surface.triangles.size(), whole.triangles.size());
  EXPECT_EQ(imported.surface.vertices.size(), whole.vertices.size());
  SurfaceImportOptions options;
  options.part = "one";
  EXPECT_CONTAINS(message_of<InputError>([&] { import_surface(path, options); }), "the surface is open");
}

TEST(GltfParts, ANodeAboveOthersTakesThemAll) {
  TemporaryFolder folder;
  Gltf file = gltf_of({{"a", kBox, ""}, {"b", kBox, ",\"translation\":[0.2,0,0]"}});
  file.json = replaced(file.json, "\"nodes\":[0,1]", "\"nodes\":[2]");
  file.json = replaced(file.json, "],\"meshes\"",
                       ",{\"name\":\"both\",\"children\":[0,1],\"translation\":[0,1,0]}],\"meshes\"");
  SurfaceImportOptions options;
  options.part = "both";
  const ImportedSurface imported = import_surface(folder.write("a.glb", glb(file)), options);
  EXPECT_EQ(analyse_topology(imported.surface).components, 2U);
  EXPECT_NEAR(imported.surface.bounds().min().z(), 1,
              1e-6);  // the translation of the node above is baked: Y is superior
}

}  // namespace
}  // namespace trocar::gltf_format_test
