// An organ as the simulator loads it: a TOML manifest and the binary PLY surface beside it.
//
// Frame of the surface: RAS patient axes (x right, y anterior, z superior), metres, origin as in the image.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tissue/mesh/surface/triangle_surface.h"

namespace trocar {

struct Organ {
  std::string name;            ///< "liver"
  std::string material;        ///< name of the material, "liver"
  TriangleSurface surface;     ///< closed, outward, m
  bool synthetic = false;      ///< made by our own phantom: must be shown wherever the organ is shown
  bool cut_at_border = false;  ///< the image ended inside the organ; the cap is flat and not anatomy
  std::string modality;        ///< "CT", "MR", "surface"
  std::string source_file;     ///< name of the file it was made from (no directories)
  std::string source_sha256;   ///< of that file
  std::string licence;         ///< SPDX-like key or text; "unknown" when nobody said
  std::string credit;          ///< one line to show with the organ
  std::string sha256;          ///< of the surface file's bytes: identifies the organ in records
  std::filesystem::path manifest;
  std::vector<Organ>
      adjacent;  ///< the other organs of its scene, in the same frame; without adjacent ones of their own
};

/// Reads NAME.organ.toml and the surface it names; or NAME.scene.toml, whose subject it is (NAME.scene.toml#spleen:
/// another one).
/// @throws InputError naming file and place: missing file, unknown key, wrong hash, surface open or empty.
Organ load_organ(const std::filesystem::path& manifest);

/// The file of "FILE#ORGAN".
std::filesystem::path without_subject(const std::filesystem::path& given);

/// The manifest meant by a user: a path to one, or the name of an organ or a scene that ships ("phantom-liver").
/// "#ORGAN" behind a scene chooses its subject.
/// @param assets root of the shipped assets; organs lie in its folder `organs`
/// @throws InputError listing the names that there are
std::filesystem::path find_organ(const std::string& name_or_path, const std::filesystem::path& assets);

}  // namespace trocar
