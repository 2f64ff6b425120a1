// What `trocar organ import` is asked for: plain values, filled by the command line and by tests.
//
// Lengths in the unit of the names. Thread: any.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tissue/progress.h"
#include "tissue/solid/lattice.h"

namespace trocar {

/// Segmentation without labels; it knows no anatomy (tissue/imaging/labels/segmentation.h).
struct ThresholdOptions {
  std::optional<std::array<double, 2>> window;   ///< lowest and highest value of the image, HU for CT
  std::optional<std::array<double, 3>> seed_mm;  ///< RAS; the piece at this point, grown from it
  double reach_mm = 0;                           ///< with a seed: nothing further from it is looked at; 0 no bound
  double opening_mm = 0, closing_mm = 0;
  bool smooth = false;
};

/// A surface from another program (tissue/organ/surface_import.h).
struct SurfaceChoices {
  std::string unit, frame, up_axis, part;
  std::optional<double> fill_holes_mm;
  bool wrap = false;
  double wrap_alpha_mm = 2;
};

/// What `organ import` and `organ inspect` read, for their help.
constexpr const char* kInputForms =
    "Label map or image (.nii .nii.gz .nrrd .seg.nrrd .mha .mhd), DICOM folder, zip, DICOMDIR or file, surface (.stl "
    ".ply .obj .off .glb .gltf .fbx .vtk .vtp .vtu .msh), or a folder or zip of one mask or surface an organ";

struct OrganImportOptions {
  std::string input;  ///< volume, label map, DICOM folder, zip or file, surface, or folder or zip of one file an organ
  std::vector<std::string> more_inputs;  ///< further masks, or further surfaces, of the same scene
  std::string labels;  ///< label map, SEG or RTSTRUCT that goes with the image `input`; "" when `input` is one
  std::vector<std::string> label;  ///< numbers or names; several make a scene; none when the map holds one label only
  bool all = false;                ///< every label of the map, as a scene
  std::string label_table;         ///< built-in name or file; "" none
  std::optional<int> series;       ///< of several DICOM series
  ThresholdOptions threshold;
  SurfaceChoices surface;
  int triangles = 6000;
  bool largest_only = false;     ///< nothing but the largest part of a label or a surface
  double lattice_mm = 0;         ///< edge of the lattice's cells; 0: no lattice
  double tetrahedra_mm = 0;      ///< size of the tetrahedra; 0: none
  std::string output;            ///< NAME, or NAME.organ.toml, or NAME.scene.toml
  std::string subject;           ///< of a scene: the organ that exercises are done on; "" the liver, else the largest
  std::filesystem::path report;  ///< HTML page; "": none
  std::filesystem::path assets;  ///< root of the shipped assets, for the page's pictures; "": no 3-D pictures
  bool json = false;
  std::string name;  ///< default: the label's name, or the stem of the file
  std::string licence = "unknown";
  std::string credit;
  std::string material;    ///< default: by the name; in a scene: of the labels without a name
  std::string modality;    ///< "CT", "MR"; default: what the files tell, else guessed, else "unknown"
  bool synthetic = false;  ///< set for our own phantom
  Progress progress = {};
};

}  // namespace trocar
