// Every surface file of the shared data folder, imported or refused as it should be; skipped, loudly, where the folder is missing.
//
// Volumes, counts of triangles and units are those of the folder's manifests, measured there by other programs.
#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>
#include <set>

#include "haptics/input_error.h"
#include "tests/tissue/support/temporary_folder.h"
#include "tissue/imaging/label_volume.h"
#include "tissue/mesh/surface_import.h"
#include "tissue/mesh/topology.h"

namespace trocar {
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
  std::size_t components;  ///< before the largest was kept
};

void expect_good(const ImportedSurface& imported, const Expected& expected) {
  const SurfaceTopology facts = analyse_topology(imported.surface);
  EXPECT_TRUE(facts.closed() && facts.manifold()) << expected.file;
  EXPECT_EQ(facts.components, 1U) << expected.file;
  double volume = imported.surface.volume_m3();
  EXPECT_GT(volume, 0) << expected.file;
  for (const double lost : imported.lost_volumes_m3) volume += lost;
  EXPECT_NEAR(volume * 1e6, expected.volume_ml, 2e-4 * expected.volume_ml) << expected.file;
  EXPECT_EQ(imported.lost_volumes_m3.size() + 1, expected.components) << expected.file;
  std::cout << "  " << expected.file << ": " << imported.surface.triangles.size() << " triangles, " << imported.surface.volume_m3() * 1e6
            << " mL, genus " << facts.genus << sentences(imported) << "\n";
}

TEST_F(SharedSurfaces, EveryClosedFileComesInWithItsVolume) {
  // The liver's 6-part file has cavities that the manifest subtracts: it has a test of its own below.
  for (const Expected& expected : std::initializer_list<Expected>{
           {"ucl_liver_mm/gallbladder.vtk", "mm", 15.172, 1},
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
           {"hra_male_glb/VH_M_Gallbladder.fbx", "", 5.11, 1},
           {"hra_male_glb/VH_M_Spleen.glb", "", 229.88, 1},
           {"hra_male_glb/VH_M_Spleen.fbx", "", 229.88, 1}}) {
    SCOPED_TRACE(expected.file);
    ASSERT_NO_THROW(expect_good(import(expected.file, unit(expected.unit)), expected));
  }
}

}  // namespace
}  // namespace trocar
