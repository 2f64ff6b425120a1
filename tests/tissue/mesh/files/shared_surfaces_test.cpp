// Every surface file of the shared data folder, imported or refused as it should be; skipped, loudly, where the folder
// is missing.
//
// Volumes, counts of triangles and units are those of the folder's manifests, measured there by other programs.
#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>

#include "haptics/input_error.h"
#include "tests/tissue/support/label_files.h"
#include "tests/tissue/support/temporary_folder.h"
#include "tissue/imaging/labels/label_volume.h"
#include "tissue/mesh/surface/topology.h"
#include "tissue/organ/surface_import.h"

namespace trocar::shared_surfaces_test {
namespace {

class SharedSurfaces : public ::testing::Test {
 protected:
  void SetUp() override {
    const char* elsewhere = std::getenv("TROCAR_SHARED");
    data_ = std::filesystem::path(elsewhere != nullptr ? elsewhere : TROCAR_SOURCE_DIR "/../shared") / "data";
    if (std::filesystem::is_directory(data_)) return;
    std::cerr << "SKIPPED: no shared data in " << data_ << "; real surfaces were NOT tested\n";
    GTEST_SKIP() << "no shared data in " << data_;
  }

  ImportedSurface import(const std::string& file, SurfaceImportOptions options = {}) const {
    return import_surface(data_ / "meshes" / file, options);
  }

  std::string refusal(const std::string& file, SurfaceImportOptions options = {}) const {
    return test::message_of<InputError>([&] { import(file, options); });
  }

  static SurfaceImportOptions unit(const std::string& name) {
    SurfaceImportOptions options;
    options.unit = name;
    return options;
  }
  static SurfaceImportOptions part(const std::string& name) {
    SurfaceImportOptions options;
    options.part = name;
    return options;
  }

  std::filesystem::path data_;
};

std::string sentences(const ImportedSurface& imported) {
  std::string text;
  for (const auto* list : {&imported.decisions, &imported.repairs, &imported.warnings})
    for (const std::string& sentence : *list) text += "\n    " + sentence;
  return text;
}

struct Expected {
  const char* file;
  const char* unit;        ///< to declare; "" where the file knows
  double volume_ml;        ///< of all components together, by the manifest
  std::size_t components;  ///< before any was left out
};

void expect_good(const ImportedSurface& imported, const Expected& expected) {
  const SurfaceTopology facts = analyse_topology(imported.surface);
  EXPECT_TRUE(facts.closed() && facts.manifold()) << expected.file;
  double volume = imported.surface.volume_m3();
  EXPECT_GT(volume, 0) << expected.file;
  for (const double lost : imported.lost_volumes_m3) volume += lost;
  for (const TriangleSurface& cavity : imported.cavities) volume += cavity.volume_m3();
  // Quads of the tongue and of the FBX files can be cut along either diagonal: 0.03 %.
  EXPECT_NEAR(volume * 1e6, expected.volume_ml, 3e-4 * expected.volume_ml) << expected.file;
  EXPECT_EQ(facts.components + imported.lost_volumes_m3.size() + imported.cavities.size(), expected.components)
      << expected.file;
  std::cout << "  " << expected.file << ": " << imported.surface.triangles.size() << " triangles, "
            << imported.surface.volume_m3() * 1e6 << " mL, genus " << facts.genus << sentences(imported) << "\n";
}

TEST_F(SharedSurfaces, EveryClosedFileComesInWithItsVolume) {
  for (const Expected& expected :
       std::initializer_list<Expected>{{"ucl_liver_mm/gallbladder.vtk", "mm", 15.172, 1},
                                       {"ucl_liver_mm/arteries.vtk", "mm", 55.439, 1},
                                       {"ucl_liver_mm/biliary_tract.vtk", "mm", 0.6742, 1},
                                       {"ucl_liver_mm/gastric_vein.vtk", "mm", 0.74152, 1},
                                       {"ucl_liver_mm/hepatic_veins.vtk", "mm", 51.164, 1},
                                       {"ucl_liver_mm/liver_cysts.vtk", "mm", 10.736, 23},
                                       {"ucl_liver_mm/liver_tumours.vtk", "mm", 96.680, 1},
                                       {"ucl_liver_mm/portal_vein.vtk", "mm", 27.256, 2},
                                       {"ucl_liver_mm/liver.vtk", "mm", 2316.2, 6},
                                       {"ucl_liver_mm/liver.ply", "mm", 1711.6, 1},
                                       {"ucl_liver_mm/liver_sub.ply", "mm", 2313.0, 1},
                                       {"ucl_liver_mm/liver_downsample.stl", "mm", 1581.3, 1},
                                       {"sofa_arbitrary_units/liver-smooth.obj", "cm", 39.267, 1},
                                       {"sofa_arbitrary_units/liver.obj", "cm", 36.569, 1},
                                       {"sofa_arbitrary_units/liver2.obj", "cm", 1.1471, 1},
                                       {"sofa_arbitrary_units/pelvis_f.obj", "cm", 0.23077, 1},
                                       {"sofa_arbitrary_units/tongue.obj", "cm", 2.4792, 1},
                                       {"sofa_arbitrary_units/liver.msh", "cm", 36.561, 1},
                                       {"sofa_arbitrary_units/liver2.msh", "cm", 1.1251, 1},
                                       {"sofa_arbitrary_units/liver.vtk", "mm", 1477.2, 4},
                                       {"hra_male_glb/VH_M_Gallbladder.glb", "", 5.1149, 1},
                                       {"hra_male_glb/VH_M_Gallbladder.fbx", "", 5.1149, 1},
                                       {"hra_male_glb/VH_M_Spleen.glb", "", 229.88, 1},
                                       {"hra_male_glb/VH_M_Spleen.fbx", "", 229.88, 1}}) {
    SCOPED_TRACE(expected.file);
    ASSERT_NO_THROW(expect_good(import(expected.file, unit(expected.unit)), expected));
  }
}

TEST_F(SharedSurfaces, GlbAndFbxOfOneOrganLandInOnePlace) {
  for (const std::string organ : {"VH_M_Gallbladder", "VH_M_Spleen"}) {
    const ImportedSurface glb = import("hra_male_glb/" + organ + ".glb"),
                          fbx = import("hra_male_glb/" + organ + ".fbx");
    EXPECT_EQ(glb.unit, "m");
    EXPECT_EQ(fbx.unit, "cm");
    EXPECT_EQ(glb.frame, "LSA");
    EXPECT_LT((volume_centroid_m(glb.surface) - volume_centroid_m(fbx.surface)).norm(), 1e-5) << organ;
    EXPECT_NEAR(fbx.surface.volume_m3() / glb.surface.volume_m3(), 1, 1e-4) << organ;
  }
}

// The body stands upright in the library: the spleen is left of the gallbladder and behind it, the bladder far below
// both.
TEST_F(SharedSurfaces, ReferenceOrgansStandUprightInPatientAxes) {
  const Vec3 gallbladder = volume_centroid_m(import("hra_male_glb/VH_M_Gallbladder.glb").surface);
  const Vec3 spleen = volume_centroid_m(import("hra_male_glb/VH_M_Spleen.glb").surface);
  SurfaceImportOptions wrapped;
  wrapped.wrap = WrapSettings{4, 0.4};
  const Vec3 bladder = volume_centroid_m(import("hra_male_glb/VH_M_Urinary_Bladder.glb", wrapped).surface);
  EXPECT_GT(gallbladder.x(), 0.05);
  EXPECT_LT(spleen.x(), -0.05);
  EXPECT_GT(gallbladder.y(), spleen.y() + 0.05);
  EXPECT_LT(bladder.z(), gallbladder.z() - 0.25);
  EXPECT_NEAR(bladder.x(), 0, 0.02);
}

TEST_F(SharedSurfaces, SpleenIsFivePatchesWeldedAcrossNodes) {
  const ImportedSurface spleen = import("hra_male_glb/VH_M_Spleen.glb");
  ASSERT_EQ(spleen.parts.size(), 5U);
  EXPECT_EQ(spleen.parts[0].name, "VH_M_colic_surface_of_spleen");
  EXPECT_EQ(spleen.surface.triangles.size(), 16872U);
  EXPECT_EQ(spleen.surface.vertices.size(), 8438U);
  EXPECT_CONTAINS(sentences(spleen), "took 5 of 5 parts as one surface");
  EXPECT_CONTAINS(refusal("hra_male_glb/VH_M_Spleen.glb", part("VH_M_hilum_of_spleen")), "the surface is open");
  EXPECT_EQ(import("hra_male_glb/VH_M_Spleen.glb", part("VH_M_spleen")).surface.triangles.size(),
            16872U);  // the node above them
  EXPECT_CONTAINS(refusal("hra_male_glb/VH_M_Spleen.glb", part("liver")),
                  "has no part \"liver\" (its parts: VH_M_colic");
}

TEST_F(SharedSurfaces, LiverCapsuleIsNamedAThinShell) {
  const std::string all = refusal("hra_male_glb/VH_M_Liver.glb");
  EXPECT_CONTAINS(all, "the surface is open");
  EXPECT_CONTAINS(all, "--part");
  EXPECT_CONTAINS(all, "VH_M_liver_capsule");
  EXPECT_EQ(list_surface_parts(data_ / "meshes" / "hra_male_glb" / "VH_M_Liver.glb").size(), 26U);
  const ImportedSurface capsule = import("hra_male_glb/VH_M_Liver.glb", part("VH_M_liver_capsule"));
  EXPECT_NEAR(capsule.surface.volume_m3() * 1e6, 74.4, 0.1);
  ASSERT_FALSE(capsule.warnings.empty());
  EXPECT_CONTAINS(capsule.warnings.back(), "a hollow shell");
  std::cout << sentences(capsule) << "\n";
}

TEST_F(SharedSurfaces, OpenAndTangledOrgansAreRefusedWithTheWayOut) {
  for (const std::string organ : {"SBU_M_Intestine_Large", "VH_M_Biliary_Tree", "VH_M_Kidney_L", "VH_M_Liver",
                                  "VH_M_Pancreas", "VH_M_Small_Intestine", "VH_M_Ureter_L", "VH_M_Urinary_Bladder"}) {
    const std::string message = refusal("hra_male_glb/" + organ + ".glb");
    EXPECT_CONTAINS(message, "--wrap");
    EXPECT_CONTAINS(message, organ);
    std::cout << "  " << message.substr(message.rfind('/') + 1) << "\n";
  }
}

TEST_F(SharedSurfaces, WrapRescuesThePancreasAndTheLiver) {
  SurfaceImportOptions options;
  options.wrap = WrapSettings{2, 0.2};
  const ImportedSurface pancreas = import("hra_male_glb/VH_M_Pancreas.glb", options);
  EXPECT_NEAR(pancreas.surface.volume_m3() * 1e6, 77.23,
              0.02 * 77.23);  // the manifest's signed volume; 12 edges of it are tangled
  options.wrap = WrapSettings{5, 0.5};
  const ImportedSurface liver = import("hra_male_glb/VH_M_Liver.glb", options);
  EXPECT_GT(liver.surface.volume_m3() * 1e6, 1000);  // filled, unlike its double wall
  EXPECT_LT(liver.surface.volume_m3() * 1e6, 2500);
  for (const ImportedSurface* organ : {&pancreas, &liver}) {
    const SurfaceTopology facts = analyse_topology(organ->surface);
    EXPECT_TRUE(facts.closed() && facts.manifold());
    EXPECT_EQ(organ->source_self_intersections, 0U);
    std::cout << "  " << facts.triangles << " triangles, " << organ->surface.volume_m3() * 1e6 << " mL"
              << sentences(*organ) << "\n";
  }
}

TEST_F(SharedSurfaces, HolesOfRealOrgansAreFilledOrRefusedBySize) {
  SurfaceImportOptions options;
  for (const auto& [organ, widest_mm] :
       {std::pair("VH_M_Biliary_Tree", 40.0), {"VH_M_Small_Intestine", 60.0}, {"VH_M_Ureter_L", 40.0}}) {
    options.fill_holes_mm = 0.5;
    EXPECT_CONTAINS(refusal(std::string("hra_male_glb/") + organ + ".glb", options), "holes are wider than the 0.5");
    options.fill_holes_mm = widest_mm;
    const ImportedSurface filled = import(std::string("hra_male_glb/") + organ + ".glb", options);
    const SurfaceTopology facts = analyse_topology(filled.surface);
    EXPECT_TRUE(facts.closed() && facts.manifold()) << organ;
    EXPECT_CONTAINS(sentences(filled), "filled a hole of");
    std::cout << "  " << organ << ": " << filled.surface.volume_m3() * 1e6 << " mL" << sentences(filled) << "\n";
  }
}

TEST_F(SharedSurfaces, ArbitraryUnitsAreRefusedWithAHint) {
  EXPECT_CONTAINS(refusal("sofa_arbitrary_units/liver.obj"), "OBJ carries no unit, say --unit mm, cm, m or um");
  EXPECT_CONTAINS(refusal("sofa_arbitrary_units/liver.obj"),
                  "of a liver one expects 150 to 300 mm, which no unit gives");
  EXPECT_CONTAINS(refusal("ucl_liver_mm/liver.vtk"), "of a liver one expects 150 to 300 mm, which mm gives");
  EXPECT_CONTAINS(refusal("ucl_liver_mm/liver.vtk", unit("m")), "is not plausible");
  EXPECT_CONTAINS(refusal("sofa_arbitrary_units/liver.vtk"), "VTK carries no unit");
}

TEST_F(SharedSurfaces, SofaLiverIsTurnedOutwardsAndLosesItsSpecks) {
  const ImportedSurface liver = import("sofa_arbitrary_units/liver.vtk", unit("mm"));
  EXPECT_EQ(liver.surface.triangles.size(), 9988U);
  EXPECT_EQ(liver.lost_volumes_m3.size(), 3U);
  EXPECT_GT(liver.surface.volume_m3(), 1.4e-3);
  EXPECT_CONTAINS(sentences(liver), "kept the largest of 4 components (9988 of 10000 triangles)");
  EXPECT_CONTAINS(sentences(liver), "turned 10000 triangles outwards");
}

TEST_F(SharedSurfaces, SofaTetrahedraAreReadAsVolumes) {
  const auto solid = read_tetrahedra(data_ / "meshes" / "sofa_arbitrary_units" / "liver.msh", unit("cm"));
  EXPECT_EQ(solid.tetrahedra.size(), 596U);
  EXPECT_EQ(solid.vertices.size(), 181U);
  double volume = 0;
  for (const auto& t : solid.tetrahedra) {
    const auto at = [&](std::size_t n) { return solid.vertices[static_cast<std::size_t>(t[n])]; };
    volume += (at(1) - at(0)).cross(at(2) - at(0)).dot(at(3) - at(0)) / 6;
  }
  EXPECT_NEAR(volume * 1e6, 36.561, 0.002);
  EXPECT_EQ(read_tetrahedra(data_ / "meshes" / "sofa_arbitrary_units" / "liver2.msh", unit("cm")).tetrahedra.size(),
            1493U);
}

TEST_F(SharedSurfaces, SlicerGallbladdersCoincideAndLieOnTheirMask) {
  const auto folder = data_ / "ct_abdomen_totalseg";
  const ImportedSurface lps = import_surface(folder / "derived_same_liver" / "gallbladder_slicer_ascii_LPS.stl", "mm");
  const ImportedSurface ras = import_surface(folder / "derived_same_liver" / "gallbladder_slicer_binary_RAS.stl", "mm");
  ASSERT_EQ(lps.surface.vertices.size(), 602U);
  ASSERT_EQ(ras.surface.vertices.size(), 602U);
  for (std::size_t v = 0; v < 602; ++v)  // six digits of text
    EXPECT_LT((lps.surface.vertices[v] - ras.surface.vertices[v]).norm(), 1e-6);
  EXPECT_NEAR(lps.surface.volume_m3() * 1e6, 34.48, 0.005);
  const LabelVolume mask = test::read_label_volume(folder / "masks_v1" / "gallbladder.nii.gz");
  Vec3 sum = Vec3::Zero();
  std::size_t voxels = 0, n = 0;
  for (int k = 0; k < mask.size[2]; ++k)
    for (int j = 0; j < mask.size[1]; ++j)
      for (int i = 0; i < mask.size[0]; ++i, ++n)
        if (mask.labels[n] != 0) sum += mask.index_to_ras_mm * Vec3(i, j, k), ++voxels;
  ASSERT_EQ(voxels, 1300U);
  const double off_mm = (volume_centroid_m(lps.surface) * 1e3 - sum / static_cast<double>(voxels)).norm();
  EXPECT_LT(off_mm, 0.5);
  std::cout << "  centroid " << off_mm << " mm from the mask's\n" << sentences(lps) << "\n";
}

TEST_F(SharedSurfaces, NoFileOfTheFolderIsForgotten) {
  std::size_t read = 0, refused = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(data_ / "meshes")) {
    if (!entry.is_regular_file() || entry.path().extension() == ".md") continue;
    EXPECT_TRUE(is_surface_file(entry.path())) << entry.path();
    EXPECT_FALSE(list_surface_parts(entry.path()).empty()) << entry.path();
    try {
      import_surface(entry.path(), entry.path().parent_path().filename() == "hra_male_glb" ? "" : "mm");
      ++read;
    } catch (const InputError& error) {
      EXPECT_CONTAINS(error.what(), entry.path().filename().string());
      ++refused;
    }
  }
  EXPECT_EQ(read, 20U);
  EXPECT_EQ(refused, 12U);  // eight that are open or tangled, four that are too small for millimetres
}

}  // namespace
}  // namespace trocar::shared_surfaces_test
