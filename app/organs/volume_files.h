// The files beside an organ's surface: lattice, tetrahedra, vessel graph; made when they are asked for.
//
// Names: STEM.lattice (tissue/solid/lattice.h), STEM.msh (Gmsh 2.2, metres, RAS), STEM.vessels.toml. Thread: any, not
// the tick.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/organs/import_options.h"
#include "tissue/imaging/labels/label_volume.h"
#include "tissue/organ/organ_manifest.h"

namespace trocar {

/// Where an organ was made from; no labels for a surface of another program.
struct LabelledOrgan {
  const LabelVolume* labels = nullptr;
  int number = 0;
};

/// Lattice and tetrahedra as the options ask; their facts enter the manifest.
/// @throws InputError: tetrahedra or cells of a size that cannot be
std::vector<SideFile> volume_meshes(const OrganImportOptions& options, const std::filesystem::path& stem,
                                    const TriangleSurface& surface, const LabelledOrgan& made_from,
                                    OrganManifest& manifest);

/// Whether an organ of this name is a tube that a centreline describes: artery, vein, duct, vena cava, ureter.
bool is_tubular(const std::string& name);

/// Centrelines of a tubular organ with the radii: one file, or none when the organ is no tube.
std::vector<SideFile> vessel_files(const OrganImportOptions& options, const std::filesystem::path& stem,
                                   const LabelledOrgan& made_from, const std::string& name);

}  // namespace trocar
