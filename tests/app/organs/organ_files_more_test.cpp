// Manifests of both formats, strict tables, scenes and materials: round trips, places of refusals, and what may not
// depend on order.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "haptics/digest/digest.h"
#include "haptics/input_error.h"
#include "tests/tissue/support/shapes.h"
#include "tests/tissue/support/temporary_folder.h"
#include "tissue/library_versions.h"
#include "tissue/organ/material_table.h"
#include "tissue/organ/organ_manifest.h"
#include "tissue/organ/organ_set.h"
#include "tissue/organ/toml_table.h"

namespace trocar::organ_files_more_test {
namespace {

/// Numbers that the fixed decimals of the file can hold.
double decimals(std::mt19937& generator, int digits) {
  const double scale = std::pow(10.0, digits);
  return std::uniform_int_distribution<int>(1, 900000)(generator) / scale;
}

std::string words(std::mt19937& generator) {
  static const std::vector<std::string> kPieces{"liver", " ",   "\"", "'",    "\\",  "ä",  "#",
                                                "=",     "[x]", "\t", "½ mL", "'''", "end"};
  std::string text;
  for (int n = std::uniform_int_distribution<int>(0, 6)(generator); n > 0; --n)
    text += kPieces[generator() % kPieces.size()];
  return text;
}

VolumeMeshFile volume_mesh(std::mt19937& generator, const std::string& file) {
  return {file,
          digest::of_bytes(file),
          generator() % 100000,
          generator() % 100000,
          decimals(generator, 4),
          -decimals(generator, 4),
          decimals(generator, 4)};
}

OrganManifest random_manifest(std::mt19937& generator) {
  OrganManifest manifest;
  manifest.program = "trocar 0.1.0";
  manifest.name = words(generator), manifest.material = words(generator), manifest.credit = words(generator),
  manifest.licence = words(generator);
  manifest.synthetic = generator() % 2 == 0;
  manifest.surface = "a.ply", manifest.surface_sha256 = digest::of_bytes(manifest.name);
  manifest.source = {"map.nii.gz",     digest::of_bytes("map"), "CT", "mm", std::nullopt,
                     words(generator), words(generator)};
  if (generator() % 2 == 0) manifest.source.label = static_cast<int>(generator() % 65536);
  for (int n = static_cast<int>(generator() % 4); n > 0; --n)
    manifest.decisions.push_back(words(generator)), manifest.mesh.repairs.push_back(words(generator));
  MeshFacts& mesh = manifest.mesh;
  mesh.topology.vertices = generator() % 10000, mesh.topology.triangles = generator() % 10000;
  mesh.volume_ml = decimals(generator, 4), mesh.kept_volume_ml = decimals(generator, 4);
  if (generator() % 2 == 0) mesh.label_volume_ml = decimals(generator, 4);
  mesh.distance.mean_m = decimals(generator, 7), mesh.distance.max_m = decimals(generator, 7),
  mesh.border_voxels = generator() % 100;
  mesh.lost = {{"part", generator() % 100, decimals(generator, 4)}};
  mesh.added = {{"cavity", generator() % 100, decimals(generator, 4)}};
  mesh.quality.min_angle_deg = decimals(generator, 4), mesh.quality.edge_max_m = decimals(generator, 6);
  if (generator() % 2 == 0) manifest.lattice = volume_mesh(generator, "a.lattice");
  if (generator() % 2 == 0) manifest.tetrahedra = volume_mesh(generator, "a.msh");
  return manifest;
}

TEST(ManifestRoundTrip, OneTextIsOneManifestForAHundredRandomOnes) {
  std::mt19937 generator(2024);
  for (int n = 0; n < 100; ++n) {
    const OrganManifest wanted = random_manifest(generator);
    const std::string text = manifest_text(wanted);
    const OrganManifest read = parse_manifest(text, "x");
    ASSERT_EQ(manifest_text(read), text) << n;
    EXPECT_EQ(read.name, wanted.name);
    EXPECT_EQ(read.credit, wanted.credit);
    EXPECT_EQ(read.decisions, wanted.decisions);
    EXPECT_EQ(read.source.label, wanted.source.label);
    EXPECT_EQ(read.lattice.has_value(), wanted.lattice.has_value());
    EXPECT_EQ(read.tetrahedra.has_value(), wanted.tetrahedra.has_value());
    const double base = wanted.mesh.label_volume_ml.value_or(wanted.mesh.kept_volume_ml);
    EXPECT_NEAR(read.mesh.volume_error_pct, 100 * (wanted.mesh.volume_ml - base) / base,
                1e-3 * (1 + std::abs(read.mesh.volume_error_pct)));
  }
}

TEST(ManifestRoundTrip, LatticeAndTetrahedraComeBackFieldByField) {
  std::mt19937 generator(5);
  OrganManifest wanted = random_manifest(generator);
  wanted.lattice = VolumeMeshFile{"a.lattice", "12ab", 1331, 1000, 10, -0.25, 0.125};
  wanted.tetrahedra = VolumeMeshFile{"a.msh", "34cd", 500, 2000, 7.5, 0.5, 12.25};
  const OrganManifest read = parse_manifest(manifest_text(wanted), "x");
  for (const auto& [mine, other] :
       {std::pair(*read.lattice, *wanted.lattice), std::pair(*read.tetrahedra, *wanted.tetrahedra)}) {
    EXPECT_EQ(mine.file, other.file);
    EXPECT_EQ(mine.sha256, other.sha256);
    EXPECT_EQ(mine.nodes, other.nodes);
    EXPECT_EQ(mine.cells, other.cells);
    EXPECT_EQ(mine.size_mm, other.size_mm);
    EXPECT_EQ(mine.volume_error_pct, other.volume_error_pct);
    EXPECT_EQ(mine.worst, other.worst);
  }
}

std::string without(std::string text, const std::string& from, const std::string& to) {
  const std::size_t begin = text.find(from), end = text.find(to, begin);
  EXPECT_NE(begin, std::string::npos) << from;
  return text.erase(begin, (end == std::string::npos ? text.size() : end) - begin);
}

std::string plain_text() {
  OrganManifest manifest;
  manifest.name = manifest.material = "liver", manifest.program = "trocar 0.1.0", manifest.surface = "a.ply",
  manifest.licence = "CC0-1.0";
  manifest.source = {"map.nii.gz", "ab", "CT", "mm", 5, "liver", ""};
  manifest.mesh.kept_volume_ml = manifest.mesh.volume_ml = 10;
  manifest.lattice = VolumeMeshFile{"a.lattice", "12", 8, 1, 10, 0, 0};
  return manifest_text(manifest);
}

std::string swapped(std::string text, const std::string& from, const std::string& to) {
  EXPECT_NE(text.find(from), std::string::npos) << from;
  return text.replace(text.find(from), from.size(), to);
}

std::string refusal(const std::string& text) {
  return test::message_of<InputError>([&] { parse_manifest(text, "x.organ.toml"); });
}

TEST(ManifestFormats, TheOlderOneIsReadWithoutWhatItDidNotHave) {
  std::string old = swapped(plain_text(), "format = 2", "format = 1");
  old = without(without(without(old, "program = ", "name = "), "decisions = ", "\n[source]"), "[quality]", "[lattice]");
  const OrganManifest read = parse_manifest(without(old, "[lattice]", "no end"), "x");
  EXPECT_EQ(read.name, "liver");
  EXPECT_EQ(read.program, "");
  EXPECT_TRUE(read.decisions.empty());
  EXPECT_FALSE(read.lattice);
  EXPECT_EQ(read.source.label, 5);
  EXPECT_CONTAINS(manifest_text(read), "format = 2");
}

TEST(ManifestFormats, WhatBelongsToTheNewOneIsRefusedInTheOldAndMissedInTheNew) {
  EXPECT_CONTAINS(refusal(swapped(plain_text(), "format = 2", "format = 1")), "unknown key");
  EXPECT_CONTAINS(refusal(without(plain_text(), "[quality]", "[lattice]")), "key \"quality\" is missing");
  EXPECT_CONTAINS(refusal(without(plain_text(), "program = ", "name = ")), "key \"program\" is missing");
  EXPECT_CONTAINS(refusal(swapped(plain_text(), "format = 2", "format = 3")),
                  "x.organ.toml:1:10: format must be 1 or 2");
  EXPECT_CONTAINS(refusal(swapped(plain_text(), "format = 2", "format = 0")), "format must be 1 or 2");
}

TEST(ManifestFormats, FilesBesideItMayNotLieElsewhere) {
  for (const char* file : {"../a.lattice", "/etc/passwd", "sub/a.lattice", ""})
    EXPECT_CONTAINS(refusal(swapped(plain_text(), "'a.lattice'", "'" + std::string(file) + "'")), "beside the manifest")
        << file;
  EXPECT_CONTAINS(refusal(swapped(plain_text(), "'a.ply'", "'../a.ply'")),
                  "surface must be the name of a file beside the manifest");
}

TEST(ManifestFormats, EveryKeyIsNeededOrAbsentOnPurpose) {
  const std::string text = plain_text();
  const std::set<std::string> optional{"label", "label_volume_ml", "centroid_offset_mm", "voxel_mm", "added"};
  std::size_t refused = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = text.find('\n', at), equals = text.find(" = ", at);
    const std::string line = text.substr(at, end - at);
    if (equals < end && line[0] != ' ' && line[0] != '#' && line.back() != '[') {
      const std::string less = text.substr(0, at) + text.substr(end + 1), key = line.substr(0, equals - at);
      if (optional.contains(key)) {
        EXPECT_NO_THROW(parse_manifest(less, "x")) << key;
      } else {
        EXPECT_CONTAINS(refusal(less), "key \"" + key + "\" is missing");
        ++refused;
      }
    }
    at = end + 1;
  }
  EXPECT_GT(refused, 30U);
}

TEST(ManifestFormats, EveryTruncationIsRefusedAsInput) {
  const std::string text = plain_text();
  for (std::size_t length = 0; length + 8 < text.size(); length += 7)
    EXPECT_THROW(parse_manifest(text.substr(0, length), "x"), InputError) << length;
}

TEST(TomlNumbers, ADecimalIsWhatWasRoundedAndReadsBack) {
  std::mt19937 generator(9);
  std::uniform_real_distribution<double> any(-1e4, 1e4);
  for (int n = 0; n < 200; ++n) {
    const double value = any(generator);
    const int digits = static_cast<int>(generator() % 6) + 1;
    TomlTable table = TomlTable::parse("a = " + TomlWriter::decimal(value, digits) + "\n", "f");
    EXPECT_NEAR(table.number("a"), value, 0.5000001 * std::pow(10.0, -digits)) << digits;
  }
}

TEST(TomlTexts, WhateverIsInATextComesBack) {
  std::mt19937 generator(10);
  for (int n = 0; n < 300; ++n) {
    TomlWriter out;
    std::vector<std::string> list{words(generator), words(generator), words(generator)};
    const std::string text = words(generator);
    out.add("a", text);
    out.add("b", list);
    TomlTable table = TomlTable::parse(std::move(out).text(), "f");
    EXPECT_EQ(table.text("a"), text);
    EXPECT_EQ(table.texts("b"), list);
  }
}

TEST(TomlTables, AnInnerUnknownKeyHasItsOwnPlace) {
  TomlTable root = TomlTable::parse("a = 1\n[t]\nb = 2\nc = 3\n", "f.toml");
  root.integer("a");
  TomlTable inner = root.table("t");
  inner.integer("b");
  EXPECT_NO_THROW(root.finish());
  EXPECT_CONTAINS(test::message_of<InputError>([&] { inner.finish(); }), "f.toml:4:1: unknown key \"c\"");
}

CompiledMember member(const std::string& name, const Vec3& centre) {
  CompiledMember organ;
  organ.surface = test::sphere(centre, 0.03, 2);
  organ.manifest.name = organ.manifest.material = name;
  organ.manifest.licence = "CC0-1.0", organ.manifest.credit = name + "'s credit";
  organ.manifest.source = {"map.nii.gz", "ab", "CT", "mm", 1, name, ""};
  organ.manifest.mesh.volume_ml = organ.manifest.mesh.kept_volume_ml = organ.surface.volume_m3() * 1e6;
  return organ;
}

OrganSet named_set(const std::string& subject) {
  OrganSet set;
  set.name = "all", set.subject = subject;
  return set;
}

TEST(OrganSetFiles, EveryMemberCanBeTheSubjectWithAllOthersRoundIt) {
  test::TemporaryFolder folder;
  const std::vector<std::string> names{"liver", "spleen", "colon", "aorta"};
  std::vector<CompiledMember> members;
  for (const std::string& name : names)
    members.push_back(member(name, Vec3(0.1 * static_cast<double>(members.size()), 0, 0)));
  OrganSet set = named_set("liver");
  const auto path = write_organ_set(folder / "all", set, members, {});
  std::set<std::string> hashes;
  for (std::size_t n = 0; n < names.size(); ++n) {
    const Organ organ = load_organ(path.string() + "#" + names[n]);
    EXPECT_EQ(organ.name, names[n]);
    EXPECT_NEAR(organ.surface.bounds().center().x(), 0.1 * static_cast<double>(n), 1e-6);
    std::set<std::string> others{names.begin(), names.end()};
    others.erase(names[n]);
    for (const Organ& other : organ.adjacent) EXPECT_EQ(others.erase(other.name), 1U) << other.name;
    EXPECT_TRUE(others.empty());
    EXPECT_EQ(organ.credit.find(names[n]), 0U) << "the subject's credit goes first: " << organ.credit;
    EXPECT_EQ(organ.licence, "CC0-1.0") << "one licence is said once";
    hashes.insert(organ.sha256);
  }
  EXPECT_EQ(hashes.size(), names.size()) << "records tell the subjects apart";
}

TEST(OrganSetFiles, HashesAreThoseOfTheWrittenManifests) {
  test::TemporaryFolder folder;
  std::vector<CompiledMember> members{member("liver", Vec3::Zero()), member("spleen", Vec3(0.1, 0, 0))};
  OrganSet set = named_set("spleen");
  const auto path = write_organ_set(folder / "all", set, members, {{"all.vessels.toml", "x = 1\n"}});
  const OrganSet read = parse_organ_set(read_bytes(path), "x");
  ASSERT_EQ(read.files.size(), 2U);
  for (std::size_t n = 0; n < 2; ++n) {
    EXPECT_EQ(read.sha256[n], digest::of_bytes(read_bytes(folder / read.files[n])));
    EXPECT_EQ(folder / read.files[n], member_stem(folder / "all", members[n].manifest.name).string() + ".organ.toml");
    EXPECT_EQ(members[n].manifest.surface_sha256, digest::of_bytes(read_bytes(folder / members[n].manifest.surface)));
  }
  EXPECT_EQ(read_bytes(folder / "all.vessels.toml"), "x = 1\n");
  EXPECT_EQ(without_subject(path.string() + "#spleen"), path);
  EXPECT_EQ(without_subject(path), path);
}

std::string material(const std::string& name, double stiffness, const std::string& aliases) {
  return "[[material]]\nname = '" + name + "'\naliases = [" + aliases +
         "]\nstiffness_n_per_m = " + std::to_string(stiffness) +
         "\nrange_n_per_m = [1, 1000]\nmu_static = 0.2\nmu_dynamic = 0.1\nsource = 's'\nchecked = false\n";
}

TEST(MaterialLookUp, OwnNamesGoBeforeAliasesAndStarsStandForAnyEnding) {
  const MaterialTable table = MaterialTable::parse(
      material("soft_tissue", 40, "") + material("tube", 60, "'vein', 'artery_*'") + material("vein", 20, ""),
      "m.toml");
  EXPECT_EQ(table.find("vein").stiffness_n_per_m, 20);
  for (const auto& [name, found] :
       {std::pair("artery_left", "tube"), std::pair("artery", "soft_tissue"), std::pair("", "soft_tissue"),
        std::pair("Artery Left", "tube"), std::pair("Vein", "vein"), std::pair("my_artery_left", "soft_tissue")})
    EXPECT_EQ(table.find(name).name, found) << name;
}

TEST(MaterialLookUp, BesideIsOneForTheSameMaterialAndBoundedForEveryPair) {
  const MaterialTable table =
      MaterialTable::load(std::filesystem::path(TROCAR_SOURCE_DIR) / "assets" / "materials.toml");
  const ContactMaterial subject{.stiffness_n_per_m = 150, .mu_static = 0.3, .mu_dynamic = 0.2};
  for (const TissueMaterial& mine : table.all()) {
    EXPECT_DOUBLE_EQ(table.beside(subject, mine.name, mine.name).stiffness_n_per_m, 150) << mine.name;
    EXPECT_LE(mine.low_n_per_m, mine.stiffness_n_per_m);
    EXPECT_GE(mine.high_n_per_m, mine.stiffness_n_per_m);
    for (const TissueMaterial& other : table.all()) {
      const double there = table.beside(subject, mine.name, other.name).stiffness_n_per_m / 150;
      const double ratio = other.stiffness_n_per_m / mine.stiffness_n_per_m;
      EXPECT_DOUBLE_EQ(there, std::min(2.0, std::max(0.25, ratio))) << mine.name << " " << other.name;
    }
    for (const std::string& alias : mine.aliases) {
      const std::string name = alias.ends_with('*') ? alias.substr(0, alias.size() - 1) + "x" : alias;
      EXPECT_EQ(table.find(name).name, mine.name) << alias << " is claimed twice";
    }
  }
}

TEST(LibraryVersions, EachLibraryOnceWithDigitsInItsVersion) {
  std::set<std::string> names;
  for (const auto& [name, version] : library_versions()) {
    EXPECT_TRUE(names.insert(name).second) << name;
    EXPECT_NE(version.find_first_of("0123456789"), std::string::npos) << name;
  }
  for (const char* name : {"CGAL", "ITK", "assimp", "Eigen"}) EXPECT_TRUE(names.contains(name)) << name;
}

}  // namespace
}  // namespace trocar::organ_files_more_test
