#include "app/organs/organ_page.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "app/organs/organ_page_style.h"
#include "app/organs/organ_pictures.h"
#include "tissue/library_versions.h"
#include "tissue/mesh/surface/mesh_quality.h"
#include "trainees/markup/html.h"
#include "trainees/markup/svg.h"

namespace trocar {
namespace {

std::string mm(double metres, int digits = 2) { return fixed_text(metres * 1e3, digits); }

std::string row(const std::string& name, const std::string& value) {
  return "<tr><td>" + escape_html(name) + "</td><td>" + value + "</td></tr>";
}

std::string tag(bool good, const std::string& words) {
  return std::string("<span class=\"tag") + (good ? " ok" : "") + "\">" + escape_html(words) + "</span>";
}

std::string verdict(const CompiledMember& organ) {
  const MeshFacts& mesh = organ.manifest.mesh;
  std::string tags = tag(mesh.topology.closed(), mesh.topology.closed() ? "closed" : "OPEN") +
                     tag(mesh.topology.manifold(), mesh.topology.manifold() ? "manifold" : "NOT MANIFOLD") +
                     tag(mesh.self_intersections == 0, std::to_string(mesh.self_intersections) + " self-intersections");
  if (mesh.quality.share_above_15 < 0.99)
    tags +=
        tag(false, "thin triangles: " + fixed_text(100 * (1 - mesh.quality.share_above_15), 2) + " % below 15\u00b0");
  if (mesh.cut_at_border()) tags += tag(false, "cut at the volume border");
  if (!mesh.lost.empty()) tags += tag(false, "parts were lost");
  if (organ.manifest.synthetic) tags += tag(false, "SYNTHETIC: made by a program, not a patient");
  return "<p>" + tags + "</p>";
}

std::string distance_words(const SurfaceDistance& distance, double voxel_m) {
  std::string text = "mean " + mm(distance.mean_m) + ", rms " + mm(distance.rms_m) + ", 99 % " + mm(distance.p99_m) +
                     ", largest " + mm(distance.max_m) + " mm";
  if (voxel_m > 0) text += " (largest " + fixed_text(distance.max_m / voxel_m, 2) + " voxels)";
  return text;
}

std::string volume_rows(const MeshFacts& mesh) {
  std::string rows;
  if (mesh.label_volume_ml) rows += row("Volume of the label's voxels", fixed_text(*mesh.label_volume_ml, 2) + " mL");
  rows += row("Volume that was to be kept", fixed_text(mesh.kept_volume_ml, 2) + " mL");
  rows += row("Volume of the mesh", fixed_text(mesh.volume_ml, 2) + " mL (" + fixed_text(mesh.volume_error_pct, 2) +
                                        " % of the label, " + fixed_text(mesh.kept_error_pct, 3) +
                                        " % of what was to be kept)");
  rows += row("Centre against that of the source", mm(mesh.centroid_offset_m) + " mm");
  return rows;
}

std::string values_row(const LabelValues& values, const std::string& modality) {
  if (values.voxels == 0) return row("Image values under the label", "none: no voxel of the image lies in it");
  const std::string unit = modality == "CT" ? " HU" : "";
  return row("Image values under the label",
             "mean " + fixed_text(values.mean, 1) + unit + ", standard deviation " + fixed_text(values.deviation, 1) +
                 unit + ", 90 % between " + fixed_text(values.p05, 0) + " and " + fixed_text(values.p95, 0) + unit);
}

std::string figures(const CompiledMember& organ, const LabelValues* values) {
  const MeshFacts& mesh = organ.manifest.mesh;
  const Vec3 size = organ.surface.bounds().sizes();
  std::string rows = volume_rows(mesh);
  if (values) rows += values_row(*values, organ.manifest.source.modality);
  rows += row("Size (right-left, front-back, head-foot)",
              mm(size.x(), 1) + " x " + mm(size.y(), 1) + " x " + mm(size.z(), 1) + " mm");
  rows += row("Vertices, triangles",
              std::to_string(mesh.topology.vertices) + ", " + std::to_string(mesh.topology.triangles));
  rows += row("Components, handles (genus)",
              std::to_string(mesh.topology.components) + ", " + std::to_string(mesh.topology.genus));
  rows += row("Open, non-manifold, misoriented edges", std::to_string(mesh.topology.boundary_edges) + ", " +
                                                           std::to_string(mesh.topology.nonmanifold_edges) + ", " +
                                                           std::to_string(mesh.topology.misoriented_edges));
  rows += row("Distance, mesh to source", distance_words(mesh.distance, mesh.voxel_m));
  rows += row("Distance, source to mesh", distance_words(mesh.distance_back, mesh.voxel_m));
  rows += row("Smallest angle; 1 % quantile; triangles with all angles from 15\u00b0",
              fixed_text(mesh.quality.min_angle_deg, 1) + "\u00b0; " + fixed_text(mesh.quality.p01_angle_deg, 1) +
                  "\u00b0; " + fixed_text(100 * mesh.quality.share_above_15, 2) + " %");
  rows += row("Edges: shortest, median, longest", mm(mesh.quality.edge_min_m) + ", " + mm(mesh.quality.edge_median_m) +
                                                      ", " + mm(mesh.quality.edge_max_m) + " mm");
  for (const auto& [name, file, unit] :
       {std::tuple("Lattice", &organ.manifest.lattice, "share of nearly empty cells "),
        std::tuple("Tetrahedra", &organ.manifest.tetrahedra, "smallest dihedral angle ")})
    if (*file)
      rows += row(name, escape_html((*file)->file) + ": " + std::to_string((*file)->nodes) + " nodes, " +
                            std::to_string((*file)->cells) + " cells of " + fixed_text((*file)->size_mm, 1) +
                            " mm, volume " + fixed_text((*file)->volume_error_pct, 2) + " %, " + unit +
                            fixed_text((*file)->worst, 2));
  return "<table class=\"facts\">" + rows + "</table>";
}

/// Bars of a histogram with a labelled axis.
std::string histogram(const std::vector<double>& values, double from, double to, const std::string& unit,
                      const std::string& title) {
  constexpr int kBins = 24;
  constexpr double kWidth = 420, kHeight = 150, kLeft = 12, kBottom = 120, kTop = 22;
  std::vector<std::size_t> bins(kBins, 0);
  for (const double value : values)
    ++bins[static_cast<std::size_t>(std::clamp((value - from) / (to - from) * kBins, 0.0, kBins - 1.0))];
  const double most = static_cast<double>(std::max<std::size_t>(1, *std::max_element(bins.begin(), bins.end())));
  const double step = (kWidth - 2 * kLeft) / kBins;
  std::string body = svg::label(kLeft, 14, title, "start", " font-weight=\"600\"");
  for (int n = 0; n < kBins; ++n) {
    const double height = (kBottom - kTop) * static_cast<double>(bins[static_cast<std::size_t>(n)]) / most;
    body += svg::rect(kLeft + n * step, kBottom - height, step - 1, height, "fill=\"#0072b2\"");
  }
  body += svg::line(kLeft, kBottom, kWidth - kLeft, kBottom, "stroke=\"#27313b\"");
  for (int n = 0; n <= 4; ++n)
    body += svg::label(kLeft + n * (kWidth - 2 * kLeft) / 4, kBottom + 18,
                       number_text(std::round((from + n * (to - from) / 4) * 100) / 100) + (n == 4 ? " " + unit : ""),
                       n == 0   ? "start"
                       : n == 4 ? "end"
                                : "middle");
  return "<svg viewBox=\"0 0 " + svg::px(kWidth) + " " + svg::px(kHeight) + "\" role=\"img\" aria-label=\"" +
         escape_html(title) + "\">" + body + "</svg>";
}

std::string histograms(const CompiledMember& organ) {
  std::vector<double> edges;
  for (const auto& triangle : organ.surface.triangles)
    for (std::size_t n = 0; n < 3; ++n)
      if (triangle[n] < triangle[(n + 1) % 3])
        edges.push_back(1e3 * (organ.surface.vertices[static_cast<std::size_t>(triangle[n])] -
                               organ.surface.vertices[static_cast<std::size_t>(triangle[(n + 1) % 3])])
                                  .norm());
  const double longest = edges.empty() ? 1 : *std::max_element(edges.begin(), edges.end());
  const double step = svg::nice_step(longest, 4);
  return "<div class=\"row\"><figure>" +
         histogram(edges, 0, 4 * step >= longest ? 4 * step : longest, "mm", "Edge lengths") + "</figure><figure>" +
         histogram(smallest_angles_deg(organ.surface), 0, 60, "\u00b0", "Smallest angle of each triangle") +
         "</figure></div>";
}

template <typename Part>
std::string part_lines(const std::vector<Part>& parts, const std::string& verb,
                       const std::function<std::string(const Part&)>& words) {
  constexpr std::size_t kMost = 12;
  std::string lines;
  for (std::size_t n = 0; n < std::min(parts.size(), kMost); ++n)
    lines += "<li>" + verb + " " + escape_html(words(parts[n])) + "</li>";
  if (parts.size() > kMost) lines += "<li>and " + std::to_string(parts.size() - kMost) + " smaller ones</li>";
  return lines;
}

std::string changes(const CompiledMember& organ) {
  const MeshFacts& mesh = organ.manifest.mesh;
  std::string items;
  const auto sentence = [&](const std::string& text) { items += "<li>" + escape_html(text) + "</li>"; };
  items += part_lines<LostPart>(mesh.lost, "lost:", [](const LostPart& part) {
    return part.kind + " of " + fixed_text(part.volume_ml, 3) + " mL";
  });
  items += part_lines<AddedPart>(mesh.added, "added:", [](const AddedPart& part) {
    return part.kind + " of " + fixed_text(part.volume_ml, 3) + " mL";
  });
  for (const std::string& repair : mesh.repairs) sentence(repair);
  for (const std::string& decision : organ.manifest.decisions) sentence(decision);
  return items.empty() ? "<p>Nothing was lost, added, repaired or assumed.</p>" : "<ul>" + items + "</ul>";
}

std::string origin(const OrganManifest& manifest) {
  const OrganSource& source = manifest.source;
  std::string rows = row("Made from", escape_html(source.file) + " (" + escape_html(source.modality) + ", lengths in " +
                                          escape_html(source.unit) + ")");
  if (source.label)
    rows += row("Label", std::to_string(*source.label) +
                             (source.label_name.empty() ? ", without a name"
                                                        : " \u201c" + escape_html(source.label_name) + "\u201d") +
                             (source.label_table.empty() ? "" : ", named by " + escape_html(source.label_table)));
  rows += row("Material", escape_html(manifest.material));
  rows += row("Frame, unit of the organ", "RAS (x right, y front, z head), metres");
  rows += row("Licence", escape_html(manifest.licence) +
                             (manifest.licence == "unknown" ? " \u2013 must be known before it may be passed on" : ""));
  rows += row("Credit", manifest.credit.empty() ? "none given" : escape_html(manifest.credit));
  rows += row("sha256 of the source", "<span class=\"mono\">" + escape_html(source.sha256) + "</span>");
  rows += row("sha256 of the surface", "<span class=\"mono\">" + escape_html(manifest.surface_sha256) + "</span>");
  return "<table class=\"facts\">" + rows + "</table>";
}

std::string picture_row(const std::vector<PagePicture>& pictures) {
  std::string cells;
  for (const PagePicture& picture : pictures)
    cells += "<figure><img alt=\"" + escape_html(picture.caption) + "\" src=\"data:image/png;base64," +
             base64(picture.png) + "\"><figcaption class=\"dim\">" + escape_html(picture.caption) +
             "</figcaption></figure>";
  return "<div class=\"row\">" + cells + "</div>";
}

std::string pictures_section(const OrganPageContent& content) {
  const PagePictures pictures = page_pictures(content);
  std::string key;
  for (std::size_t n = 0; n < content.organs.size(); ++n)
    key += "<span><b style=\"background:" + css_colour(outline_colour(n)) + ";height:10px\"></b>" +
           escape_html(content.organs[n].manifest.name) + "</span>";
  std::string html =
      "<h2>Pictures</h2>" + picture_row(pictures.slices) + "<p class=\"key\">Outlines of the meshes: " + key + "</p>";
  html += pictures.views.empty()
              ? "<p class=\"dim\">No views in three dimensions: " + escape_html(pictures.missing) + "</p>"
              : picture_row(pictures.views);
  return html;
}

std::string organ_section(const CompiledMember& organ, bool several, const LabelValues* values) {
  return (several ? "<h2>" + escape_html(organ.manifest.name) + "</h2>" : "<h2>Figures</h2>") + verdict(organ) +
         figures(organ, values) + histograms(organ) + "<h2>Lost, added, repaired, assumed</h2>" + changes(organ) +
         "<h2>Origin</h2>" + origin(organ.manifest);
}

std::string crossings(const OrganSet& set) {
  std::string tags = tag(set.crossings.empty(), std::to_string(set.crossings.size()) + " pairs of organs overlap");
  for (const OrganCrossing& crossing : set.crossings) tags += tag(false, overlap_words(crossing));
  return "<p>" + tags + "</p>";
}

std::string contacts(const OrganSet& set) {
  if (set.contacts.empty()) return "";
  std::string rows = "<tr><th>Organs</th><th>Common face</th><th>Triangles</th></tr>";
  for (const OrganContact& contact : set.contacts)
    rows += "<tr><td>" + escape_html(contact.a) + " \u2013 " + escape_html(contact.b) + "</td><td>" +
            fixed_text(contact.area_m2 * 1e4, 2) + " cm\u00b2</td><td>" +
            (contact.shared ? "the same in both" : "each its own") + "</td></tr>";
  return "<h2>Contacts</h2><table>" + rows + "</table>";
}

constexpr const char* kMoreStyle =
    ".row{display:flex;gap:12px;flex-wrap:wrap}.row figure{margin:0;flex:1 1 "
    "280px;min-width:0}figcaption{font-size:.88rem}ul{margin:4px 0;padding-left:20px}";

}  // namespace

std::string organ_page(const OrganPageContent& content) {
  const bool several = content.organs.size() > 1;
  const OrganManifest& first = content.organs.front().manifest;
  const std::string name = content.set ? content.set->name : first.name;
  std::string body = "<div class=\"head\"><h1>Organ import: " + escape_html(name) + "</h1><span class=\"dim\">" +
                     escape_html(first.program) + "</span></div>";
  if (content.set)
    body += "<p>" + std::to_string(content.organs.size()) +
            " organs of one image in one frame; exercises are done on " + escape_html(content.set->subject) + ".</p>";
  body += pictures_section(content);
  for (std::size_t n = 0; n < content.organs.size(); ++n)
    body += organ_section(content.organs[n], several, n < content.values.size() ? &content.values[n] : nullptr);
  if (content.set) body += crossings(*content.set) + contacts(*content.set);
  for (const std::string& note : content.notes) body += "<p>" + escape_html(note) + "</p>";
  std::string versions;
  for (const auto& [library, version] : library_versions())
    versions += (versions.empty() ? "" : ", ") + library + " " + version;
  body += "<footer>Made by " + escape_html(first.program) + " with " + escape_html(versions) +
          ". Distances are between surfaces: the mesh and the border of the label's voxels. A trainer's organ, not a "
          "diagnosis.</footer>";
  return "<!DOCTYPE html><html lang=\"en\"><head><meta charset=\"utf-8\"><title>Organ import: " + escape_html(name) +
         "</title><style>" + std::string(kOrganPageStyle) + kMoreStyle + "</style></head><body>" + body +
         "</body></html>\n";
}

}  // namespace trocar
