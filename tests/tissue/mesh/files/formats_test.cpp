// One body written in every format and every form of it comes back as the same surface.
#include <gtest/gtest.h>

#include "haptics/input_error.h"
#include "tests/tissue/mesh/files/scene_writers.h"
#include "tests/tissue/support/temporary_folder.h"
#include "tissue/mesh/surface/topology.h"
#include "tissue/organ/surface_import.h"

namespace trocar::formats_test {
namespace {

using namespace test;

/// An egg off the axes: no turn or mirror image of it falls on itself.
TriangleSurface egg() {
  TriangleSurface surface = sphere(Vec3::Zero(), 0.04, 3);
  for (Vec3& p : surface.vertices)
    p = Vec3(p.x() * 1.5 + 0.01 * p.y(), p.y() + 0.1 * std::abs(p.z()), p.z() * 0.8) + Vec3(0.02, 0.05, -0.01);
  return surface;
}

struct Form {
  std::string name;
  std::string bytes;
  std::string unit = "mm";
};

void expect_egg(const ImportedSurface& imported, const std::string& name, const TriangleSurface& wanted) {
  SCOPED_TRACE(name);
  EXPECT_EQ(imported.surface.triangles.size(), wanted.triangles.size());
  EXPECT_EQ(imported.surface.vertices.size(), wanted.vertices.size());
  EXPECT_NEAR(imported.surface.volume_m3() / wanted.volume_m3(), 1, 1e-5);
  EXPECT_LT((volume_centroid_m(imported.surface) - volume_centroid_m(wanted)).norm(), 1e-7);
  EXPECT_LT((imported.surface.bounds().max() - wanted.bounds().max()).norm(), 1e-7);
  const SurfaceTopology facts = analyse_topology(imported.surface);
  EXPECT_TRUE(facts.closed() && facts.manifold());
  EXPECT_TRUE(imported.warnings.empty()) << imported.warnings[0];
  EXPECT_EQ(imported.source_self_intersections, 0U);
}

std::vector<Form> surface_forms() {
  const TriangleSurface mm = scaled(egg(), 1e3);
  std::vector<Form> forms{{"text.stl", stl_text(mm)},
                          {"binary.stl", stl_binary(mm)},
                          {"solid.stl", stl_binary(mm, "solid of a binary file")},
                          {"UPPER.STL", stl_binary(mm)},
                          {"plain.ply", ascii_ply(mm, 1)},
                          {"plain.obj", obj_text(mm)},
                          {"plain.off", off_text(mm)},
                          {"one.msh", msh_1(mm.vertices, elements_of(mm))}};
  for (const bool binary : {false, true}) {
    forms.push_back({"two.msh", msh_2(mm.vertices, elements_of(mm), binary)});
    forms.push_back({"four.msh", msh_4(mm.vertices, elements_of(mm), binary)});
    for (const bool modern : {false, true})
      for (const bool strips : {false, true})
        for (const bool doubles : {false, true})
          forms.push_back({"legacy.vtk", vtk_surface(mm, {binary, modern, strips, doubles, "title"})});
  }
  forms.push_back({"two_big_endian.msh", msh_2(mm.vertices, elements_of(mm), true, true)});
  for (const XmlData data : {XmlData::kAscii, XmlData::kInline, XmlData::kAppendedRaw, XmlData::kAppendedBase64})
    for (const bool compressed : {false, true})
      for (const bool wide : {false, true})
        for (const bool big_endian : {false, true})
          forms.push_back({"xml.vtp", vtp(mm, {data, compressed, wide, big_endian})});
  return forms;
}

TEST(SurfaceFormats, OneBodyInEveryFormIsOneSurface) {
  TemporaryFolder folder;
  const TriangleSurface wanted = egg();
  for (const Form& form : surface_forms()) {
    const auto path = folder.write(form.name, form.bytes);
    expect_egg(import_surface(path, form.unit), form.name + ": " + form.bytes.substr(0, 200), wanted);
  }
}

TEST(SurfaceFormats, SameFileGivesTheSameBytes) {
  TemporaryFolder folder;
  const auto path = folder.write("a.stl", stl_binary(scaled(egg(), 1e3)));
  const ImportedSurface first = import_surface(path, "mm"), second = import_surface(path, "mm");
  EXPECT_EQ(first.surface.triangles, second.surface.triangles);
  EXPECT_EQ(first.surface.vertices, second.surface.vertices);
  EXPECT_EQ(first.repairs, second.repairs);
}

TEST(SurfaceFormats, TetrahedraGiveTheirOuterSurface) {
  TemporaryFolder folder;
  const TriangleSurface wanted = egg();
  FileTetrahedra mesh = star_of(scaled(wanted, 1e3));
  std::vector<Form> forms{{"a.msh", msh_1(mesh.vertices, elements_of(mesh))}, {"a.vtk", vtk_grid(mesh, {})}};
  for (const bool binary : {false, true}) {
    forms.push_back({"a.msh", msh_2(mesh.vertices, elements_of(mesh), binary)});
    forms.push_back({"a.msh", msh_4(mesh.vertices, elements_of(mesh), binary)});
    forms.push_back({"a.vtk", vtk_grid(mesh, {binary, true, false, true, "title"})});
  }
  for (const XmlData data : {XmlData::kAscii, XmlData::kInline, XmlData::kAppendedRaw, XmlData::kAppendedBase64})
    forms.push_back({"a.vtu", vtu(mesh, {data, data != XmlData::kAscii, false, false})});
  for (const Form& form : forms) {
    const auto path = folder.write(form.name, form.bytes);
    const ImportedSurface imported = import_surface(path, "mm");
    expect_egg(imported, form.name, wanted);
    EXPECT_CONTAINS(imported.decisions.back(), "took the outer surface (512 triangles) of 512 tetrahedra");
    SurfaceImportOptions options;
    options.unit = "mm";
    const ImportedTetrahedra solid = read_tetrahedra(path, options);
    ASSERT_EQ(solid.tetrahedra.size(), 512U) << form.name;
    EXPECT_EQ(solid.vertices.size(), wanted.vertices.size() + 1);
    double volume = 0;
    for (const auto& t : solid.tetrahedra) {
      const auto at = [&](std::size_t n) { return solid.vertices[static_cast<std::size_t>(t[n])]; };
      const double part = (at(1) - at(0)).cross(at(2) - at(0)).dot(at(3) - at(0)) / 6;
      EXPECT_GT(part, 0);
      volume += part;
    }
    EXPECT_NEAR(volume / wanted.volume_m3(), 1, 1e-5) << form.name;
  }
}

TEST(SurfaceFormats, TetrahedraInsideOutAreTurned) {
  TemporaryFolder folder;
  FileTetrahedra mesh = star_of(scaled(egg(), 1e3));
  for (std::size_t t = 0; t < 100; ++t) std::swap(mesh.tetrahedra[t][0], mesh.tetrahedra[t][1]);
  const ImportedSurface imported = import_surface(folder.write("a.vtk", vtk_grid(mesh, {})), "mm");
  EXPECT_NEAR(imported.surface.volume_m3() / egg().volume_m3(), 1, 1e-5);
  EXPECT_CONTAINS(imported.decisions.at(2), "turned 100 of 512 tetrahedra that were stored inside out");
  const auto surface_only = folder.write("b.vtk", vtk_surface(scaled(egg(), 1e3), {}));
  SurfaceImportOptions options;
  options.unit = "mm";
  EXPECT_CONTAINS(message_of<InputError>([&] { read_tetrahedra(surface_only, options); }), "holds no tetrahedra");
}

TEST(SurfaceFormats, MirroredFramesKeepTetrahedraPositive) {
  TemporaryFolder folder;
  const FileTetrahedra mesh = star_of(scaled(egg(), 1e3));
  SurfaceImportOptions options;
  options.unit = "mm", options.frame = "LAS";
  const ImportedTetrahedra solid = read_tetrahedra(folder.write("a.vtk", vtk_grid(mesh, {})), options);
  for (const auto& t : solid.tetrahedra) {
    const auto at = [&](std::size_t n) { return solid.vertices[static_cast<std::size_t>(t[n])]; };
    EXPECT_GT((at(1) - at(0)).cross(at(2) - at(0)).dot(at(3) - at(0)), 0);
  }
}

/// x, y, z of RAS in the axes of glTF: x left, y superior, z anterior.
TriangleSurface in_lsa(TriangleSurface surface) {
  for (Vec3& p : surface.vertices) p = Vec3(-p.x(), p.z(), p.y());
  return surface;
}

TEST(SurfaceFormats, GltfKnowsItsUnitAndAxes) {
  TemporaryFolder folder;
  const Gltf inside = gltf_of({{"egg", in_lsa(egg()), ""}});
  const ImportedSurface binary = import_surface(folder.write("a.glb", glb(inside)), "");
  expect_egg(binary, "glb", egg());
  EXPECT_EQ(binary.unit, "m");
  EXPECT_EQ(binary.frame, "LSA");
  EXPECT_CONTAINS(binary.decisions.at(0), "glTF is in metres by its standard");
  EXPECT_CONTAINS(binary.decisions.at(1), "turned to RAS");
  const Gltf beside = gltf_of({{"egg", in_lsa(egg()), ""}}, ",\"uri\":\"egg.bin\"");
  folder.write("egg.bin", beside.binary);
  expect_egg(import_surface(folder.write("b.gltf", beside.json), ""), "gltf with a buffer beside it", egg());
  const Gltf data = gltf_of({{"egg", in_lsa(egg()), ""}},
                            ",\"uri\":\"data:application/octet-stream;base64," + base64(inside.binary) + "\"");
  expect_egg(import_surface(folder.write("c.gltf", data.json), ""), "gltf with its buffer in it", egg());
}

TEST(SurfaceFormats, GltfNodesAreBakedAndMirrorsTurnedOver) {
  TemporaryFolder folder;
  TriangleSurface moved = in_lsa(egg());
  for (Vec3& p : moved.vertices) p = (p - Vec3(0.5, 0, 0)) / 2;
  for (Vec3& p : moved.vertices)
    p.x() = -p.x();  // the mesh is a mirror image with inward triangles; the node mirrors it back
  const ImportedSurface imported = import_surface(
      folder.write("a.glb", glb(gltf_of({{"egg", moved, ",\"scale\":[-2,2,2],\"translation\":[0.5,0,0]"}}))), "");
  expect_egg(imported, "baked", egg());
}

TEST(SurfaceFormats, FbxLandsAtTheSizeThatItsSettingsSay) {
  TemporaryFolder folder;
  for (const auto& [scale, unit] : {std::pair(1.0, "cm"), {100.0, "m"}, {0.1, "mm"}, {2.54, "2.54 cm"}}) {
    const auto path = folder.write("a.fbx", fbx(scaled(in_lsa(egg()), 100 / scale), fbx_settings(scale)));
    const ImportedSurface imported = import_surface(path, "");
    SCOPED_TRACE(scale);
    EXPECT_EQ(imported.unit, unit);
    expect_egg(imported, "fbx", egg());
  }
  const std::string axes =
      "\t\tP: \"UpAxis\", \"int\", \"Integer\", \"\",2\n\t\tP: \"UpAxisSign\", \"int\", \"Integer\", \"\",1\n"
      "\t\tP: \"FrontAxis\", \"int\", \"Integer\", \"\",1\n\t\tP: \"FrontAxisSign\", \"int\", \"Integer\", \"\",-1\n"
      "\t\tP: \"CoordAxis\", \"int\", \"Integer\", \"\",0\n\t\tP: \"CoordAxisSign\", \"int\", \"Integer\", \"\",1\n";
  TriangleSurface z_up = scaled(egg(), 100);
  for (Vec3& p : z_up.vertices) p = Vec3(-p.x(), -p.y(), p.z());
  const ImportedSurface imported = import_surface(folder.write("z.fbx", fbx(z_up, fbx_settings(1, axes))), "");
  EXPECT_EQ(imported.frame, "LPS");
  expect_egg(imported, "fbx with Z up", egg());
}

TEST(SurfaceFormats, DeclaredUnitsGoBeforeTheFilesOwnAndSaySo) {
  TemporaryFolder folder;
  const auto path = folder.write("a.glb", glb(gltf_of({{"egg", in_lsa(scaled(egg(), 1e3)), ""}})));
  EXPECT_CONTAINS(message_of<InputError>([&] { import_surface(path, ""); }), "its own unit, m, is not plausible");
  const ImportedSurface imported = import_surface(path, "mm");
  expect_egg(imported, "glTF in millimetres", egg());
  EXPECT_CONTAINS(imported.decisions.at(0), "declared, although glTF is in metres");
}

TEST(SurfaceFormats, SlicersSpaceIsTurnedToRas) {
  TemporaryFolder folder;
  TriangleSurface lps = scaled(egg(), 1e3);
  for (Vec3& p : lps.vertices) p = Vec3(-p.x(), -p.y(), p.z());
  const std::string comment = "3D Slicer output. SPACE=LPS";
  std::string ply = ascii_ply(lps, 1);
  ply.insert(ply.find("element"), "comment " + comment + "\n");
  const std::vector<Form> forms{{"a.stl", stl_text(lps, comment)},
                                {"b.stl", stl_binary(lps, comment)},
                                {"a.vtk", vtk_surface(lps, {true, false, false, false, comment})},
                                {"a.obj", obj_text(lps, "# " + comment + "\n")},
                                {"a.ply", ply}};
  for (const Form& form : forms) {
    const ImportedSurface imported = import_surface(folder.write(form.name, form.bytes), "mm");
    expect_egg(imported, form.name, egg());
    EXPECT_EQ(imported.frame, "LPS");
    EXPECT_CONTAINS(imported.decisions.at(1), "SPACE=LPS");
    EXPECT_CONTAINS(imported.decisions.at(1), "turned to RAS");
  }
  const ImportedSurface ras =
      import_surface(folder.write("r.stl", stl_binary(scaled(egg(), 1e3), "3D Slicer output. SPACE=RAS")), "mm");
  expect_egg(ras, "RAS", egg());
  EXPECT_CONTAINS(ras.decisions.at(1), "SPACE=RAS");
}

TEST(SurfaceFormats, FramesAreDeclaredOrAssumedWithAWord) {
  TemporaryFolder folder;
  const auto path = folder.write("a.stl", stl_binary(scaled(in_lsa(egg()), 1e3)));
  EXPECT_CONTAINS(import_surface(path, "mm").decisions.at(1),
                  "frame RAS: STL does not say which way x, y and z point; assumed");
  SurfaceImportOptions options;
  options.unit = "mm", options.frame = "LSA";
  expect_egg(import_surface(path, options), "declared frame", egg());
  options.frame = "", options.up_axis = "y";
  expect_egg(import_surface(path, options), "declared up axis", egg());
  options.frame = "RAS";
  EXPECT_CONTAINS(message_of<InputError>([&] { import_surface(path, options); }), "contradict each other");
  options.frame = "RAX", options.up_axis = "";
  EXPECT_CONTAINS(message_of<InputError>([&] { import_surface(path, options); }), "three letters are wanted");
}

TEST(SurfaceFormats, MirroredFramesKeepTheOutsideOutside) {
  TemporaryFolder folder;
  TriangleSurface mirrored = scaled(egg(), 1e3);
  for (Vec3& p : mirrored.vertices) p.x() = -p.x();
  for (auto& triangle : mirrored.triangles) std::swap(triangle[1], triangle[2]);
  SurfaceImportOptions options;
  options.unit = "mm", options.frame = "LAS";
  const ImportedSurface imported = import_surface(folder.write("a.stl", stl_binary(mirrored)), options);
  expect_egg(imported, "LAS", egg());
  EXPECT_CONTAINS(imported.decisions.at(1), "mirror image");
}

}  // namespace
}  // namespace trocar::formats_test
