// Several organs of one image in one frame: a TOML file NAME.scene.toml that names the organ files beside it.
//
// One organ is the subject, on which an exercise is done; the others lie round it where the image had them, are seen
// and touched. Frame RAS, metres. Thread: any, not the tick.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "tissue/organ/organ.h"
#include "tissue/organ/organ_manifest.h"

namespace trocar {

/// Two organs that lie against each other.
struct OrganContact {
  std::string a, b;     ///< names; a before b in the file's order
  double area_m2 = 0;   ///< of the common face
  bool shared = false;  ///< the common face is made of the same triangles in both
  bool operator==(const OrganContact&) const = default;
};

/// Where an organ lies against something of the image that is not in the scene: what holds it, or what was left out.
struct OrganAttachment {
  std::string organ;  ///< name
  std::string label;  ///< name of the label that it lies against, or its number
  double area_m2 = 0;
  std::vector<std::int32_t> triangles;  ///< of the organ's surface
  bool operator==(const OrganAttachment&) const = default;
};

/// Two organs that overlap: their surfaces cut each other, or one lies within the other.
struct OrganCrossing {
  std::string a, b;       ///< names; a before b in the file's order, or a within b
  std::size_t pairs = 0;  ///< of triangles that cut each other; 0 where a (a piece of it) lies within b
  bool operator==(const OrganCrossing&) const = default;
};

struct OrganSet {
  std::string name;
  std::string subject;              ///< name of one of the organs
  std::vector<std::string> files;   ///< manifests beside the scene file
  std::vector<std::string> sha256;  ///< of the manifests' bytes, in their order
  std::vector<OrganContact> contacts;
  std::vector<OrganCrossing> crossings = {};  ///< none of a sound scene
  std::vector<OrganAttachment> attachments;
  std::vector<std::string> more_files;  ///< others that belong to it, "abdomen.vessels.toml"
};

inline constexpr int kOrganSetFormat = 1;
inline constexpr std::string_view kOrganSetSuffix = ".scene.toml";

std::string organ_set_text(const OrganSet& set);

/// @param file name for messages. @throws InputError with line and column
OrganSet parse_organ_set(const std::string& text, const std::string& file);

/// The subject as an organ, with the others as its neighbours; credits and licences of all joined, sha256 that of the
/// scene file.
/// @param subject another subject than the file's; "" for that
/// @throws InputError naming file and place: a member missing, changed or damaged, an unknown subject, two organs of
/// one name
Organ load_organ_set(const std::filesystem::path& path, const std::string& subject = "");

/// One organ to be written.
struct CompiledMember {
  OrganManifest manifest;
  TriangleSurface surface;
  std::string surface_bytes = {};  ///< of the surface's file, once enter_surface made them
};

/// Path without suffix of one organ of a scene: STEM-NAME.
std::filesystem::path member_stem(const std::filesystem::path& stem, const std::string& name);

/// "liver and spleen cut each other: 3 pairs of triangles", "tumour lies within liver: the two overlap"
std::string overlap_words(const OrganCrossing& crossing);

/// The overlaps between the organs of a scene, as the scene file holds them and `organ info` finds them.
std::vector<OrganCrossing> organ_crossings(const std::vector<CompiledMember>& members);

/// Enters the surfaces (enter_surface) and the crossings between them, once.
void enter_surfaces(const std::filesystem::path& stem, OrganSet& set, std::vector<CompiledMember>& members);

/// What keeps an organ or a scene from being sound, one short sentence each: surfaces that cut themselves or each
/// other. Import, page, `organ info` and the refusals of exercises all take their words from here.
std::vector<std::string> faults_of(const std::vector<CompiledMember>& members,
                                   const std::vector<OrganCrossing>& crossings);

/// @throws InputError naming the file when the organ's surface or that of an adjacent one cuts itself or another:
/// contact and cutting need an inside and an outside everywhere
void require_sound(const Organ& organ);

/// Writes STEM.scene.toml, STEM-<organ>.organ.toml and .ply for each organ and the further files, all or nothing:
/// everything is staged beside its place and then renamed, the scene file last.
/// @param members manifests; their surface names and hashes are filled in, unless surface_bytes tells that they are
/// @return path of the scene file
/// @throws EnvironmentError when the folder cannot be written or the disk is full; nothing is left behind
std::filesystem::path write_organ_set(const std::filesystem::path& stem, OrganSet& set,
                                      std::vector<CompiledMember>& members, const std::vector<SideFile>& more);

}  // namespace trocar
