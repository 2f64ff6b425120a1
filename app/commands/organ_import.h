// `trocar organ import`: a label map (NIfTI-1) or a closed surface (PLY) becomes an organ file.
//
// Report on `out`, remarks on `err`. Errors leave as InputError (exit code 2) or EnvironmentError (3).
#pragma once

#include <iosfwd>
#include <string>

#include "tissue/mesh/organ_compiler.h"
#include "tissue/mesh/organ_manifest.h"

namespace trocar {

struct OrganImportOptions {
  std::string input;   ///< label map, or volume when `labels` is given, or .ply
  std::string labels;  ///< label map that goes with the volume; "" when `input` is one
  std::string label;   ///< number, or name in the label table; "" when the map holds one label only
  std::string label_table = "totalsegmentator-v1";
  int triangles = 6000;
  std::string unit;    ///< of a .ply: "mm", "cm", "m"; label maps are millimetres
  std::string output;  ///< NAME or NAME.organ.toml
  bool json = false;
  std::string name;  ///< default: the label's name, or the stem of the file
  std::string licence = "unknown";
  std::string credit;
  std::string material;    ///< default: the name
  std::string modality;    ///< "CT", "MR"; default: guessed from the volume, "unknown" for a bare label map
  bool synthetic = false;  ///< set for our own phantom
};

/// Compiles and writes the organ. @return exit code 0
int organ_import(const OrganImportOptions& options, std::ostream& out, std::ostream& err);

/// An organ that was written, for commands that go on with it.
struct WrittenOrgan {
  OrganManifest manifest;
  TriangleSurface surface;
};

/// The work of organ_import without its report.
WrittenOrgan import_organ(const OrganImportOptions& options, std::ostream& err);

}  // namespace trocar
