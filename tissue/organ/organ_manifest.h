// The manifest NAME.organ.toml: what an organ is, where it came from, and what is known about its surface.
//
// TOML, strict: unknown keys, missing keys and wrong types are refused with line and column. One manifest is one
// sequence of bytes: no times, no paths, fixed decimals. Thread: any, not the tick.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tissue/imaging/labels/segment.h"
#include "tissue/mesh/surface/mesh_facts.h"

namespace trocar {

struct OrganSource {
  std::string file;                          ///< name without directories
  std::string sha256;                        ///< of that file
  std::string modality;                      ///< "CT", "MR", "surface", "unknown"
  std::string unit;                          ///< length unit of the source: "mm", "cm", "m"
  std::optional<int> label;                  ///< number in the label map
  std::string label_name;                    ///< "" when no table names it
  std::string label_table;                   ///< "" when none was needed
  std::optional<SegmentColour> colour = {};  ///< that the file shows the label in
  std::vector<SegmentCode> codes = {};       ///< that the file gives the label
};

/// A lattice or a mesh of tetrahedra beside the surface.
struct VolumeMeshFile {
  std::string file;  ///< name beside the manifest
  std::string sha256;
  std::size_t nodes = 0;
  std::size_t cells = 0;  ///< cubes or tetrahedra
  double size_mm = 0;     ///< edge of a cube; largest circumradius of a tetrahedron
  double volume_error_pct = 0;
  double worst = 0;  ///< lattice: share of cells below the least fill; tetrahedra: smallest dihedral angle, degrees
};

struct OrganManifest {
  std::string program;  ///< that made it, "trocar 0.1.0"; "" in files of format 1
  std::string name;
  std::string material;
  bool synthetic = false;
  std::string surface;  ///< file name of the PLY beside the manifest
  std::string surface_sha256;
  std::string licence;
  std::string credit;
  OrganSource source;
  std::vector<std::string> decisions;  ///< on unit, frame and whatever the source left open, as sentences
  MeshFacts mesh;
  std::optional<VolumeMeshFile> lattice, tetrahedra;
};

inline constexpr int kOrganFormat = 2;  ///< 1, without quality, decisions and volume meshes, is read too
inline constexpr std::string_view kOrganSuffix = ".organ.toml";

std::string manifest_text(const OrganManifest& manifest);

/// @param file name for messages
/// @throws InputError with line and column
OrganManifest parse_manifest(const std::string& text, const std::string& file);

/// Whether it names a file in the same folder: no folders, not empty.
bool is_plain_name(const std::string& file);

/// Whole file as bytes. @throws InputError when it cannot be read
std::string read_bytes(const std::filesystem::path& path);
/// The same of a file whose hash is known. @param named_by file that holds the hash, for the message
/// @throws InputError also when the hash is another
std::string read_unchanged(const std::filesystem::path& path, const std::string& sha256, const std::string& named_by);

/// Names of the surface, the lattice and the tetrahedra that a manifest speaks of.
std::vector<std::string> files_beside(const OrganManifest& manifest);

/// A further file: name without folder (it lies beside the organ) or absolute path, and bytes.
struct SideFile {
  std::string name, bytes;
};

/// What can be proved on a surface as it lies in its file: topology, angles and edges, self-intersections. Import
/// enters it, `organ info` proves it anew.
void prove_surface(const TriangleSurface& surface, MeshFacts& facts);

/// Enters the name and the hash of the surface's file into the manifest, and proves it.
/// @param surface becomes what the file holds, rounded to float32: what is counted is what will be loaded
/// @return the file's bytes
std::string enter_surface(const std::filesystem::path& stem, OrganManifest& manifest, TriangleSurface& surface);

/// Writes NAME.organ.toml, NAME.ply and the further files whole or not at all: all are staged beside their place and
/// then renamed.
/// @param stem path without the suffixes; its folder is made when missing
/// @return path of the manifest
/// @throws EnvironmentError when the folder cannot be written or the disk is full; nothing is left behind
std::filesystem::path write_organ(const std::filesystem::path& stem, OrganManifest& manifest, TriangleSurface surface,
                                  const std::vector<SideFile>& more = {});
/// The same after enter_surface. @param surface_bytes what it returned
std::filesystem::path write_entered_organ(const std::filesystem::path& stem, const OrganManifest& manifest,
                                          const std::string& surface_bytes, const std::vector<SideFile>& more = {});

}  // namespace trocar
