#include "tissue/organ/organ_set.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>

#include "haptics/digest/digest.h"
#include "haptics/input_error.h"
#include "tissue/mesh/files/surface_pieces.h"
#include "tissue/mesh/files/winding.h"
#include "tissue/mesh/surface/surface_check.h"
#include "tissue/organ/staged_file.h"
#include "tissue/organ/toml_table.h"

namespace trocar {
namespace {

constexpr double kM2PerCm2 = 1e-4;

/// Distinct texts of the organs, the subject's first.
std::string joined(const std::vector<std::string>& texts) {
  std::vector<std::string> distinct;
  for (const std::string& text : texts)
    if (!text.empty() && std::find(distinct.begin(), distinct.end(), text) == distinct.end()) distinct.push_back(text);
  std::string all;
  for (const std::string& text : distinct) all += (all.empty() ? "" : "; ") + text;
  return all;
}

std::vector<Organ> load_members(const OrganSet& set, const std::filesystem::path& path) {
  std::vector<Organ> organs;
  std::set<std::string> names;
  for (std::size_t n = 0; n < set.files.size(); ++n) {
    const std::filesystem::path member = path.parent_path() / set.files[n];
    read_unchanged(member, set.sha256[n], path.string());
    organs.push_back(load_organ(member));
    if (!names.insert(organs.back().name).second)
      throw InputError(path.string() + ": two organs are named \"" + organs.back().name + "\"");
  }
  return organs;
}

std::string listed_organs(const std::vector<Organ>& organs) {
  std::string names;
  for (const Organ& organ : organs) names += (names.empty() ? "" : ", ") + organ.name;
  return names;
}

/// Credits, licences and flags of the whole scene, shown wherever it is shown.
void speak_for_all(Organ& subject) {
  std::vector<std::string> credits{subject.credit}, licences{subject.licence};
  for (const Organ& organ : subject.adjacent) {
    credits.push_back(organ.credit);
    licences.push_back(organ.licence);
    subject.synthetic = subject.synthetic || organ.synthetic;
    subject.cut_at_border = subject.cut_at_border || organ.cut_at_border;
  }
  subject.credit = joined(credits);
  subject.licence = joined(licences);
}

OrganAttachment read_attachment(TomlTable& table) {
  OrganAttachment attachment{table.text("organ"), table.text("label"), table.number("area_cm2") * kM2PerCm2, {}};
  for (const double triangle : table.numbers("triangles")) {
    if (triangle < 0 || triangle > 1e9 || triangle != std::floor(triangle))
      table.refuse("triangles", "triangles holds numbers of triangles");
    attachment.triangles.push_back(static_cast<std::int32_t>(triangle));
  }
  table.finish();
  return attachment;
}

bool holds_any(const TriangleSurface& surface, const std::vector<Vec3>& points) {
  const Eigen::AlignedBox3d box = surface.bounds();
  return std::any_of(points.begin(), points.end(),
                     [&](const Vec3& point) { return box.contains(point) && encloses(surface, point); });
}

}  // namespace

std::string organ_set_text(const OrganSet& set) {
  TomlWriter out;
  out.add("format", kOrganSetFormat);
  out.add("name", set.name);
  out.add("frame", "RAS");
  out.add("unit", "m");
  out.add("subject", set.subject);
  out.add("files", set.more_files);
  for (std::size_t n = 0; n < set.files.size(); ++n) {
    out.array_table("organ");
    out.add("file", set.files[n]);
    out.add("sha256", set.sha256[n]);
  }
  for (const OrganContact& contact : set.contacts) {
    out.array_table("contact");
    out.add("a", contact.a);
    out.add("b", contact.b);
    out.add("area_cm2", contact.area_m2 / kM2PerCm2, 3);
    out.add("shared", contact.shared);
  }
  for (const OrganCrossing& crossing : set.crossings) {
    out.array_table("crossing");
    out.add("a", crossing.a);
    out.add("b", crossing.b);
    out.add("pairs", crossing.pairs);
  }
  for (const OrganAttachment& attachment : set.attachments) {
    out.array_table("attachment");
    out.add("organ", attachment.organ);
    out.add("label", attachment.label);
    out.add("area_cm2", attachment.area_m2 / kM2PerCm2, 3);
    std::string triangles;
    for (const std::int32_t triangle : attachment.triangles)
      triangles += (triangles.empty() ? "" : ", ") + std::to_string(triangle);
    out.raw("triangles", "[" + triangles + "]");
  }
  return std::move(out).text();
}

OrganSet parse_organ_set(const std::string& text, const std::string& file) {
  TomlTable table = TomlTable::parse(text, file);
  if (table.integer("format") != kOrganSetFormat) table.refuse("format", "format must be 1");
  table.expect("frame", "RAS");
  table.expect("unit", "m");
  OrganSet set;
  set.name = table.text("name");
  set.subject = table.text("subject");
  set.more_files = table.texts("files");
  for (const std::string& name : set.more_files)
    if (!is_plain_name(name)) table.refuse("files", "files holds names of files beside the scene");
  for (TomlTable& organ : table.tables("organ")) {
    set.files.push_back(organ.text("file"));
    set.sha256.push_back(organ.text("sha256"));
    if (!is_plain_name(set.files.back())) organ.refuse("file", "file must be the name of a file beside the scene");
    organ.finish();
  }
  if (set.files.empty()) table.refuse("organ", "a scene holds at least one organ");
  if (table.has("contact"))
    for (TomlTable& contact : table.tables("contact")) {
      set.contacts.push_back(
          {contact.text("a"), contact.text("b"), contact.number("area_cm2") * kM2PerCm2, contact.boolean("shared")});
      contact.finish();
    }
  if (table.has("crossing"))
    for (TomlTable& crossing : table.tables("crossing")) {
      set.crossings.push_back({crossing.text("a"), crossing.text("b"), crossing.count("pairs")});
      crossing.finish();
    }
  if (table.has("attachment"))
    for (TomlTable& attachment : table.tables("attachment")) set.attachments.push_back(read_attachment(attachment));
  table.finish();
  return set;
}

Organ load_organ_set(const std::filesystem::path& path, const std::string& subject) {
  const std::string bytes = read_bytes(path);
  const OrganSet set = parse_organ_set(bytes, path.string());
  std::vector<Organ> organs = load_members(set, path);
  const std::string wanted = subject.empty() ? set.subject : subject;
  const auto found =
      std::find_if(organs.begin(), organs.end(), [&](const Organ& organ) { return organ.name == wanted; });
  if (found == organs.end())
    throw InputError(path.string() + ": no organ \"" + wanted + "\" to be the subject; there are " +
                     listed_organs(organs));
  Organ result = std::move(*found);
  organs.erase(found);
  result.adjacent = std::move(organs);
  result.sha256 = digest::of_bytes(result.sha256 + digest::of_bytes(bytes));
  result.manifest = path;
  speak_for_all(result);
  return result;
}

std::filesystem::path member_stem(const std::filesystem::path& stem, const std::string& name) {
  return stem.string() + "-" + name;
}

std::string overlap_words(const OrganCrossing& crossing) {
  if (crossing.pairs == 0) return crossing.a + " lies within " + crossing.b + ": the two overlap";
  return crossing.a + " and " + crossing.b + " cut each other: " + std::to_string(crossing.pairs) +
         " pairs of triangles";
}

std::vector<OrganCrossing> organ_crossings(const std::vector<CompiledMember>& members) {
  std::vector<const TriangleSurface*> surfaces;
  for (const CompiledMember& member : members) surfaces.push_back(&member.surface);
  std::vector<OrganCrossing> crossings;
  std::set<std::pair<std::size_t, std::size_t>> cut;
  for (const auto& [first, second, pairs] : surface_crossings(surfaces)) {
    crossings.push_back({members[first].manifest.name, members[second].manifest.name, pairs});
    cut.insert({first, second});
  }
  for (std::size_t inner = 0; inner < surfaces.size(); ++inner) {
    const std::vector<Vec3> points = points_within(*surfaces[inner]);
    for (std::size_t outer = 0; outer < surfaces.size(); ++outer)
      if (outer != inner && !cut.contains(std::minmax(inner, outer)) && holds_any(*surfaces[outer], points))
        crossings.push_back({members[inner].manifest.name, members[outer].manifest.name, 0});
  }
  return crossings;
}

void enter_surfaces(const std::filesystem::path& stem, OrganSet& set, std::vector<CompiledMember>& members) {
  for (CompiledMember& member : members)
    if (member.surface_bytes.empty())
      member.surface_bytes = enter_surface(member_stem(stem, member.manifest.name), member.manifest, member.surface);
  set.crossings = organ_crossings(members);
}

std::vector<std::string> faults_of(const std::vector<CompiledMember>& members,
                                   const std::vector<OrganCrossing>& crossings) {
  std::vector<std::string> faults;
  for (const CompiledMember& member : members)
    if (const std::size_t cuts = member.manifest.mesh.self_intersections; cuts > 0)
      faults.push_back(member.manifest.name + " cuts itself: " + std::to_string(cuts) + " pairs of triangles");
  for (const OrganCrossing& crossing : crossings) faults.push_back(overlap_words(crossing));
  return faults;
}

void require_sound(const Organ& organ) {
  std::vector<CompiledMember> members;
  const auto add = [&](const Organ& one) {
    CompiledMember& member = members.emplace_back();
    member.manifest.name = one.name;
    member.surface = one.surface;
    member.manifest.mesh.self_intersections = count_self_intersections(one.surface);
  };
  add(organ);
  for (const Organ& other : organ.adjacent) add(other);
  const std::vector<std::string> faults = faults_of(members, organ_crossings(members));
  if (faults.empty()) return;
  std::string text = organ.manifest.string() + ": no exercise can be done on it: " + faults.front();
  if (faults.size() > 1) text += ", and " + std::to_string(faults.size() - 1) + " more faults";
  throw InputError(
      text +
      ": `trocar organ info` lists them; import its organs again from labels that do not overlap, or one by itself");
}

std::filesystem::path write_organ_set(const std::filesystem::path& stem, OrganSet& set,
                                      std::vector<CompiledMember>& members, const std::vector<SideFile>& more) {
  std::vector<std::unique_ptr<StagedFile>> staged;
  const auto stage = [&](const std::filesystem::path& path, const std::string& bytes) {
    staged.push_back(std::make_unique<StagedFile>(path, bytes));
  };
  enter_surfaces(stem, set, members);
  set.files.clear();
  set.sha256.clear();
  for (CompiledMember& member : members) {
    const std::string name = member_stem(stem, member.manifest.name).string();
    const std::string text = manifest_text(member.manifest);
    stage(name + ".ply", member.surface_bytes);
    stage(name + std::string(kOrganSuffix), text);
    set.files.push_back(std::filesystem::path(name).filename().string() + std::string(kOrganSuffix));
    set.sha256.push_back(digest::of_bytes(text));
  }
  set.more_files.clear();
  for (const SideFile& file : more) {
    stage(stem.parent_path() / file.name, file.bytes);
    if (is_plain_name(file.name)) set.more_files.push_back(file.name);
  }
  std::filesystem::path path = stem.string() + std::string(kOrganSetSuffix);
  stage(path, organ_set_text(set));
  for (const auto& file : staged) file->commit();
  return path;
}

}  // namespace trocar
