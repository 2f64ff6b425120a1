#include "app/organs/organ_report.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tissue/library_versions.h"

namespace trocar {
namespace {

using Json = nlohmann::ordered_json;

double rounded(double value, double digits) {
  const double scale = std::pow(10.0, digits);
  const double result = std::round(value * scale) / scale;
  return result == 0 ? 0 : result;  // no "-0.0"
}

Json distance_json(const SurfaceDistance& distance) {
  return {{"mean", rounded(distance.mean_m * 1e3, 4)},
          {"rms", rounded(distance.rms_m * 1e3, 4)},
          {"p99", rounded(distance.p99_m * 1e3, 4)},
          {"max", rounded(distance.max_m * 1e3, 4)}};
}

Json corner_json(const Vec3& corner) {
  return {rounded(corner.x(), 6), rounded(corner.y(), 6), rounded(corner.z(), 6)};
}

Json source_json(const OrganSource& source) {
  Json json{{"file", source.file}, {"sha256", source.sha256}};
  json["label"] = source.label ? Json(*source.label) : Json(nullptr);
  json["label_name"] = source.label_name;
  json["label_table"] = source.label_table;
  if (source.colour) json["label_colour"] = *source.colour;
  for (const SegmentCode& code : source.codes)
    json["label_codes"].push_back(
        {{"role", code.role}, {"scheme", code.scheme}, {"value", code.value}, {"meaning", code.meaning}});
  json["modality"] = source.modality;
  return json;
}

void add_mesh(Json& json, const MeshFacts& mesh) {
  json["vertices"] = mesh.topology.vertices;
  json["triangles"] = mesh.topology.triangles;
  json["closed"] = mesh.topology.closed();
  json["manifold"] = mesh.topology.manifold();
  json["self_intersections"] = mesh.self_intersections;
  json["degenerate_triangles"] = mesh.topology.degenerate_triangles;
  json["components"] = mesh.topology.components;
  json["genus"] = mesh.topology.genus;
  json["volume_ml"] = rounded(mesh.volume_ml, 4);
  json["label_volume_ml"] = mesh.label_volume_ml ? Json(rounded(*mesh.label_volume_ml, 4)) : Json(nullptr);
  json["volume_error_pct"] = rounded(mesh.volume_error_pct, 4);
  json["kept_volume_ml"] = rounded(mesh.kept_volume_ml, 4);
  json["kept_error_pct"] = rounded(mesh.kept_error_pct, 4);
  json["distance_mm"] = distance_json(mesh.distance);
  json["distance_back_mm"] = distance_json(mesh.distance_back);
  json["hausdorff_mm"] = rounded(mesh.hausdorff_m() * 1e3, 4);
  json["hausdorff_voxels"] = mesh.hausdorff_voxels() ? Json(rounded(*mesh.hausdorff_voxels(), 4)) : Json(nullptr);
  json["centroid_offset_mm"] = rounded(mesh.centroid_offset_m * 1e3, 4);
  json["boundary_edges"] = mesh.topology.boundary_edges;
  json["nonmanifold_edges"] = mesh.topology.nonmanifold_edges;
  json["misoriented_edges"] = mesh.topology.misoriented_edges;
  const MeshQuality& quality = mesh.quality;
  json["angles_deg"] = {{"min", rounded(quality.min_angle_deg, 3)},
                        {"p01", rounded(quality.p01_angle_deg, 3)},
                        {"share_above_15", rounded(quality.share_above_15, 5)}};
  json["edges_mm"] = {{"min", rounded(quality.edge_min_m * 1e3, 3)},
                      {"p05", rounded(quality.edge_p05_m * 1e3, 3)},
                      {"median", rounded(quality.edge_median_m * 1e3, 3)},
                      {"p95", rounded(quality.edge_p95_m * 1e3, 3)},
                      {"max", rounded(quality.edge_max_m * 1e3, 3)}};
}

template <typename Part>
Json parts_json(const std::vector<Part>& parts) {
  Json list = Json::array();
  for (const Part& part : parts)
    list.push_back({{"kind", part.kind}, {"voxels", part.voxels}, {"volume_ml", rounded(part.volume_ml, 4)}});
  return list;
}

Json volume_mesh_json(const std::optional<VolumeMeshFile>& mesh, const char* worst) {
  if (!mesh) return nullptr;
  return {{"file", mesh->file},
          {"sha256", mesh->sha256},
          {"nodes", mesh->nodes},
          {"cells", mesh->cells},
          {"size_mm", rounded(mesh->size_mm, 4)},
          {"volume_error_pct", rounded(mesh->volume_error_pct, 4)},
          {worst, rounded(mesh->worst, 4)}};
}

Json organ_object(const OrganManifest& manifest, const Eigen::AlignedBox3d& bounds) {
  const MeshFacts& mesh = manifest.mesh;
  Json json{{"name", manifest.name},
            {"surface", manifest.surface},
            {"surface_sha256", manifest.surface_sha256},
            {"material", manifest.material}};
  add_mesh(json, mesh);
  json["bbox_m"] = {corner_json(bounds.min()), corner_json(bounds.max())};
  json["cut_at_border"] = mesh.cut_at_border();
  json["border_voxels"] = mesh.border_voxels;
  json["lost"] = parts_json(mesh.lost);
  json["added"] = parts_json(mesh.added);
  json["repairs"] = mesh.repairs;
  json["decisions"] = manifest.decisions;
  json["unit"] = "m";
  json["source_unit"] = manifest.source.unit;
  json["frame"] = "RAS";
  json["source"] = source_json(manifest.source);
  json["licence"] = manifest.licence;
  json["credit"] = manifest.credit;
  json["synthetic"] = manifest.synthetic;
  json["lattice"] = volume_mesh_json(manifest.lattice, "floored_share");
  json["tetrahedra"] = volume_mesh_json(manifest.tetrahedra, "min_dihedral_deg");
  json["program"] = manifest.program;
  Json versions = Json::object();
  for (const auto& [library, version] : library_versions()) versions[library] = version;
  json["versions"] = versions;
  return json;
}

void text_of_volume_mesh(std::ostream& out, const char* title, const std::optional<VolumeMeshFile>& mesh,
                         const char* worst) {
  if (!mesh) return;
  out << "  " << title << mesh->file << ", " << mesh->nodes << " nodes, " << mesh->cells << " cells of "
      << mesh->size_mm << " mm, volume " << mesh->volume_error_pct << " %, " << worst << mesh->worst << "\n";
}

void text_of_parts(std::ostream& out, const MeshFacts& mesh) {
  constexpr std::size_t kMost = 8;
  const auto line = [&](const char* what, const auto& part) {
    out << what << part.kind << " of " << part.volume_ml << " mL";
    if (part.voxels > 0) out << " (" << part.voxels << " voxels)";
    out << "\n";
  };
  for (std::size_t n = 0; n < std::min(mesh.lost.size(), kMost); ++n) line("  lost       ", mesh.lost[n]);
  if (mesh.lost.size() > kMost) out << "  lost       and " << mesh.lost.size() - kMost << " smaller parts\n";
  for (const AddedPart& part : mesh.added) line("  added      ", part);
}

}  // namespace

std::string organ_json(const OrganManifest& manifest, const Eigen::AlignedBox3d& bounds) {
  return organ_object(manifest, bounds).dump(2) + "\n";
}

namespace {
std::string headline(const OrganManifest& manifest) {
  return manifest.name + (manifest.synthetic ? " (synthetic)" : "") + ", material " + manifest.material;
}

/// How far the surface lies off on average, where that is more than a voxel, m.
std::optional<double> off_its_place_m(const MeshFacts& mesh) {
  const double off_m = std::max(mesh.distance.mean_m, mesh.distance_back.mean_m);
  return mesh.voxel_m > 0 && off_m > mesh.voxel_m ? std::optional(off_m) : std::nullopt;
}

/// A mesh of few triangles keeps its volume only where it can keep its form.
void text_of_lost_form(std::ostream& out, const MeshFacts& mesh) {
  constexpr double kVolume = 1;  // per cent of what was kept of the label
  const bool volume = std::abs(mesh.kept_error_pct) > kVolume;
  const std::optional<double> place = off_its_place_m(mesh);
  if (!volume && !place) return;
  out << "  NOT AS LABELLED  ";
  if (volume) out << "its volume is off by " << std::showpos << mesh.kept_error_pct << std::noshowpos << " %";
  if (volume && place) out << ", and ";
  if (place)
    out << "its surface lies " << *place * 1e3 << " mm off on average, voxels are " << mesh.voxel_m * 1e3 << " mm";
  const bool wrapped = std::any_of(mesh.repairs.begin(), mesh.repairs.end(),
                                   [](const std::string& repair) { return repair.find("wrap") != std::string::npos; });
  out << ": " << mesh.topology.triangles << " triangles are too few for this form (--triangles)"
      << (wrapped ? ", or the wrap is too wide (--wrap-alpha)" : "") << "\n";
}
}  // namespace

std::string organ_text(const OrganManifest& manifest, const Eigen::AlignedBox3d& bounds) {
  const MeshFacts& mesh = manifest.mesh;
  const Vec3 extent = bounds.sizes() * 1e3;
  std::ostringstream out;
  out.setf(std::ios::fixed);
  out.precision(2);
  out << headline(manifest) << "\n"
      << "  surface    " << manifest.surface << ", " << mesh.topology.vertices << " vertices, "
      << mesh.topology.triangles << " triangles, " << (mesh.topology.closed() ? "closed" : "OPEN") << ", "
      << (mesh.topology.manifold() ? "manifold" : "NOT MANIFOLD") << ", genus " << mesh.topology.genus << ", "
      << mesh.self_intersections << " self-intersections\n"
      << "  volume     " << mesh.volume_ml << " mL";
  if (mesh.label_volume_ml) out << ", label " << *mesh.label_volume_ml << " mL (" << mesh.volume_error_pct << " %)";
  out << "\n  size       " << extent.x() << " x " << extent.y() << " x " << extent.z() << " mm\n"
      << "  distance   mean " << mesh.distance.mean_m * 1e3 << ", p99 " << mesh.distance.p99_m * 1e3 << ", max "
      << mesh.distance.max_m * 1e3 << " mm from the original surface\n"
      << "  triangles  smallest angle " << mesh.quality.min_angle_deg << " deg, " << 100 * mesh.quality.share_above_15
      << " % from 15 deg on; edges " << mesh.quality.edge_min_m * 1e3 << " to " << mesh.quality.edge_max_m * 1e3
      << " mm\n"
      << "  source     " << manifest.source.file << " (" << manifest.source.modality << ", " << manifest.source.unit
      << "), sha256 " << manifest.source.sha256.substr(0, 16) << "\n";
  for (const SegmentCode& code : manifest.source.codes)
    out << "  code       " << code.role << ": " << code.scheme << " " << code.value << " \"" << code.meaning << "\"\n";
  out << "  licence    " << manifest.licence << (manifest.credit.empty() ? "" : "; ") << manifest.credit << "\n";
  text_of_volume_mesh(out, "lattice    ", manifest.lattice, "share of nearly empty cells ");
  text_of_volume_mesh(out, "tetrahedra ", manifest.tetrahedra, "smallest dihedral angle, degrees ");
  text_of_lost_form(out, mesh);
  if (mesh.cut_at_border())
    out << "  CUT        the image ends inside the organ (" << mesh.border_voxels
        << " voxels): the flat cap is not anatomy\n";
  text_of_parts(out, mesh);
  for (const std::string& repair : mesh.repairs) out << "  repair     " << repair << "\n";
  for (const std::string& decision : manifest.decisions) out << "  decided    " << decision << "\n";
  return out.str();
}

std::string organ_summary(const OrganManifest& manifest, const Eigen::AlignedBox3d& bounds,
                          const std::string& manifest_file) {
  const MeshFacts& mesh = manifest.mesh;
  const OrganSource& source = manifest.source;
  const Vec3 extent = bounds.sizes() * 1e3;
  std::ostringstream out;
  out.setf(std::ios::fixed);
  out.precision(2);
  out << headline(manifest) << ", from "
      << (source.label ? "label " + std::to_string(*source.label) +
                             (source.label_name.empty() ? "" : " \"" + source.label_name + "\"") + " of "
                       : "")
      << source.file << " (" << source.modality << ")\n"
      << "  " << manifest_file << ", " << manifest.surface << ": " << mesh.topology.triangles << " triangles, "
      << (mesh.topology.closed() ? "closed" : "OPEN") << ", "
      << (mesh.topology.manifold() ? "manifold" : "NOT MANIFOLD") << ", " << mesh.self_intersections
      << " self-intersections\n"
      << "  volume     " << mesh.volume_ml << " mL";
  if (mesh.label_volume_ml) out << ", label " << *mesh.label_volume_ml << " mL (" << mesh.volume_error_pct << " %)";
  out << "; size " << extent.x() << " x " << extent.y() << " x " << extent.z() << " mm\n"
      << "  distance   mean " << mesh.distance.mean_m * 1e3 << ", max " << mesh.distance.max_m * 1e3
      << " mm from the original; back mean " << mesh.distance_back.mean_m * 1e3 << ", max "
      << mesh.distance_back.max_m * 1e3 << " mm\n"
      << "  licence    " << manifest.licence << (manifest.credit.empty() ? "" : "; ") << manifest.credit << "\n";
  if (!mesh.lost.empty() || !mesh.added.empty()) {
    const auto total = [](const auto& parts) {
      double sum = 0;
      for (const auto& part : parts) sum += part.volume_ml;
      return sum;
    };
    out << "  parts      " << mesh.lost.size() << " lost (" << total(mesh.lost) << " mL), " << mesh.added.size()
        << " added (" << total(mesh.added) << " mL)\n";
  }
  text_of_lost_form(out, mesh);
  if (mesh.cut_at_border()) out << "  CUT        the image ends inside the organ: the flat cap is not anatomy\n";
  return out.str() + "  more       trocar organ info " + manifest_file + ", or a page with --report\n";
}

std::string lost_form_words(const LostForm& form) {
  std::ostringstream out;
  out.setf(std::ios::fixed);
  out.precision(1);
  out << form.triangles << " triangles ";
  out << (form.enough > 0 ? "are too few for" : "do not keep the form of") << " a body " << form.thickness_m * 1e3
      << " mm thick: ";
  if (form.volume_lost)
    out << "its volume would be off by " << std::showpos << form.volume_error_pct << std::noshowpos << " %";
  else if (form.extent_lost)
    out << "it would be " << form.extent_m * 1e3 << " mm long where it should be " << form.wanted_m * 1e3;
  else
    out << "its surface would lie " << form.mean_m * 1e3 << " mm off on average, a hundredth of it more than "
        << form.p99_m * 1e3 << " mm";
  if (form.enough > 0)
    out << ": --triangles " << form.enough;
  else
    out << ": where ends and edges are sharp, --wrap keeps more of them than a greater --triangles";
  return out.str();
}

namespace {

/// What is told of an organ, and how bad it is.
struct OrganFault {
  double badness = 0, shown = 0;
};

/// "stomach +41.8 %, spleen -0.4 %": the organs of which `fault_of` tells something, the worst first.
template <typename FaultOf>
std::string worst_organs(const std::vector<CompiledMember>& organs, const char* format, FaultOf fault_of) {
  constexpr std::size_t kListed = 4;
  std::vector<std::pair<OrganFault, std::string>> off;
  for (const CompiledMember& organ : organs)
    if (const std::optional<OrganFault> fault = fault_of(organ.manifest.mesh))
      off.emplace_back(*fault, organ.manifest.name);
  std::stable_sort(off.begin(), off.end(),
                   [](const auto& a, const auto& b) { return a.first.badness > b.first.badness; });
  std::vector<std::string> words;
  for (const auto& [fault, name] : off) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), format, fault.shown);
    words.push_back(name + text.data());
  }
  return listed_words(words, kListed);
}

/// "stomach +41.8 % of their volume (...); vein 4.1 mm between ...": where organs of a scene are not their labels, or
/// have triangles that no solver likes; "" where all are well.
std::string not_as_labelled(const std::vector<CompiledMember>& organs) {
  using Fault = std::optional<OrganFault>;
  constexpr double kVolumePct = 0.2, kLeastAngleDeg = 5;
  constexpr double kHalfDiagonal = 0.866;  // voxels
  const std::string volumes = worst_organs(organs, " %+.1f %%", [](const MeshFacts& mesh) -> Fault {
    const double off = std::abs(mesh.volume_error_pct);
    return mesh.label_volume_ml && off > kVolumePct ? Fault({off, mesh.volume_error_pct}) : std::nullopt;
  });
  const std::string places = worst_organs(organs, " %.1f mm", [](const MeshFacts& mesh) -> Fault {
    const double off = mesh.centroid_offset_m;
    return mesh.voxel_m > 0 && off > kHalfDiagonal * mesh.voxel_m ? Fault({off, off * 1e3}) : std::nullopt;
  });
  const std::string forms = worst_organs(organs, " %.1f mm", [](const MeshFacts& mesh) -> Fault {
    const std::optional<double> off = off_its_place_m(mesh);
    return off ? Fault({*off, *off * 1e3}) : std::nullopt;
  });
  const std::string angles = worst_organs(organs, " %.1f deg", [](const MeshFacts& mesh) -> Fault {
    const double least = mesh.quality.min_angle_deg;
    return mesh.topology.triangles > 0 && least < kLeastAngleDeg ? Fault({-least, least}) : std::nullopt;
  });
  std::string text;
  const auto add = [&](const std::string& list, const char* what) {
    if (!list.empty()) text += (text.empty() ? "" : "; ") + list + what;
  };
  add(volumes, " of their volume (parts, cavities, bridges: trocar organ info)");
  add(forms, " off their surface on average (more --triangles)");
  add(places, " between the centres of label and surface (thin ends are gone: more --triangles)");
  add(angles, " in the sharpest triangle");
  return text;
}

}  // namespace

std::string scene_summary(const OrganSet& set, const std::vector<CompiledMember>& organs,
                          const std::string& manifest_file) {
  constexpr std::size_t kListed = 5;
  std::vector<const CompiledMember*> largest;
  std::size_t triangles = 0;
  for (const CompiledMember& organ : organs) {
    largest.push_back(&organ);
    triangles += organ.manifest.mesh.topology.triangles;
  }
  std::stable_sort(largest.begin(), largest.end(), [](const CompiledMember* a, const CompiledMember* b) {
    return a->manifest.mesh.volume_ml > b->manifest.mesh.volume_ml;
  });
  std::ostringstream out;
  out.setf(std::ios::fixed);
  out.precision(2);
  out << set.name << ": " << organs.size() << " organs, exercises are done on " << set.subject << "\n  "
      << manifest_file << ": " << triangles << " triangles; " << set.contacts.size()
      << (set.contacts.size() == 1 ? " pair of organs lies against each other\n"
                                   : " pairs of organs lie against each other\n");
  for (std::size_t n = 0; n < std::min(kListed, largest.size()); ++n) {
    const OrganManifest& manifest = largest[n]->manifest;
    out << "  " << manifest.name << " (" << manifest.material << "): " << manifest.mesh.volume_ml << " mL, "
        << manifest.mesh.topology.triangles << " triangles, mean distance " << manifest.mesh.distance.mean_m * 1e3
        << " mm\n";
  }
  if (largest.size() > kListed) out << "  and " << largest.size() - kListed << " smaller ones\n";
  if (const std::string off = not_as_labelled(organs); !off.empty()) out << "  not as labelled: " << off << "\n";
  return out.str() + "  more       trocar organ info " + manifest_file + ", or a page with --report\n";
}

std::string scene_report_json(const OrganSet& set, const std::vector<CompiledMember>& organs) {
  Json json{{"name", set.name}, {"subject", set.subject}, {"frame", "RAS"}, {"unit", "m"}};
  json["organs"] = Json::array();
  for (const CompiledMember& organ : organs)
    json["organs"].push_back(organ_object(organ.manifest, organ.surface.bounds()));
  json["contacts"] = Json::array();
  for (const OrganContact& contact : set.contacts)
    json["contacts"].push_back({{"a", contact.a},
                                {"b", contact.b},
                                {"area_cm2", rounded(contact.area_m2 * 1e4, 3)},
                                {"shared", contact.shared}});
  json["crossings"] = Json::array();
  for (const OrganCrossing& crossing : set.crossings)
    json["crossings"].push_back({{"a", crossing.a}, {"b", crossing.b}, {"pairs", crossing.pairs}});
  json["attachments"] = Json::array();
  for (const OrganAttachment& attachment : set.attachments)
    json["attachments"].push_back(
        {{"organ", attachment.organ}, {"label", attachment.label}, {"area_cm2", rounded(attachment.area_m2 * 1e4, 3)}});
  json["files"] = set.more_files;
  return json.dump(2) + "\n";
}

std::string scene_report_text(const OrganSet& set, const std::vector<CompiledMember>& organs) {
  std::string text =
      set.name + ": " + std::to_string(organs.size()) + " organs, exercises are done on " + set.subject + "\n";
  for (const CompiledMember& organ : organs) text += organ_text(organ.manifest, organ.surface.bounds());
  std::ostringstream out;
  out.setf(std::ios::fixed);
  out.precision(2);
  for (const OrganContact& contact : set.contacts)
    out << contact.a << " lies against " << contact.b << " over " << contact.area_m2 * 1e4 << " cm2"
        << (contact.shared ? ", the same triangles in both" : "") << "\n";
  for (const OrganCrossing& crossing : set.crossings) out << "OVERLAP: " << overlap_words(crossing) << "\n";
  return text + out.str();
}

}  // namespace trocar
