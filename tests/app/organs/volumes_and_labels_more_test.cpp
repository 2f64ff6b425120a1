// Archives, files beside a surface, chosen labels and slices: round trips, closed forms, and what must not depend on
// order.
#include <gtest/gtest.h>
#include <zip.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>
#include <random>

#include "app/organs/chosen_labels.h"
#include "app/organs/organ_pictures.h"
#include "app/organs/slice_picture.h"
#include "app/organs/volume_files.h"
#include "app/organs/zip_writer.h"
#include "haptics/digest/digest.h"
#include "haptics/input_error.h"
#include "tests/tissue/support/shapes.h"
#include "tests/tissue/support/temporary_folder.h"
#include "tissue/imaging/labels/label_table.h"
#include "tissue/organ/toml_table.h"

namespace trocar::volumes_and_labels_more_test {
namespace {

std::map<std::string, std::string> unzipped(const std::string& bytes) {
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
  zip_t* zip = zip_open_from_source(source, ZIP_RDONLY | ZIP_CHECKCONS, &error);
  EXPECT_NE(zip, nullptr) << zip_error_strerror(&error);
  std::map<std::string, std::string> files;
  for (zip_int64_t n = 0; zip != nullptr && n < zip_get_num_entries(zip, 0); ++n) {
    zip_stat_t facts{};
    zip_stat_index(zip, static_cast<zip_uint64_t>(n), 0, &facts);
    std::string content(facts.size, '\0');
    zip_file_t* entry = zip_fopen_index(zip, static_cast<zip_uint64_t>(n), 0);
    EXPECT_EQ(zip_fread(entry, content.data(), facts.size), static_cast<zip_int64_t>(facts.size));
    zip_fclose(entry);
    files[facts.name] = content;
  }
  if (zip != nullptr) zip_discard(zip);
  return files;
}

TEST(ZipBytes, HoldWhatWasPutInToTheByte) {
  std::mt19937 generator(1);
  for (int n = 0; n < 12; ++n) {
    std::map<std::string, std::string> files;
    for (int m = 1 + static_cast<int>(generator() % 8); m > 0; --m) {
      std::string content(generator() % 5000, '\0');
      for (char& byte : content) byte = static_cast<char>(generator());
      files["file-" + std::to_string(generator() % 100) + (m % 2 == 0 ? "-ä.ply" : "/deep.toml")] = content;
    }
    const std::string bytes = zip_bytes(files);
    EXPECT_EQ(unzipped(bytes), files);
    EXPECT_EQ(zip_bytes(files), bytes) << "no time stamp of now";
  }
}

TEST(ZipBytes, AnEmptyFileIsAFileToo) {
  const std::map<std::string, std::string> files{{"empty.txt", ""}, {"full.txt", std::string(100000, 'x')}};
  const std::string bytes = zip_bytes(files);
  EXPECT_EQ(unzipped(bytes), files);
  EXPECT_LT(bytes.size(), 10000U) << "it is packed";
}

LabelVolume tube(int length, double voxel_mm, double radius_mm) {
  LabelVolume volume;
  volume.size = {17, 17, length};
  volume.index_to_ras_mm.linear() *= voxel_mm;
  for (int k = 0; k < length; ++k)
    for (int j = 0; j < 17; ++j)
      for (int i = 0; i < 17; ++i) {
        const bool inside = std::hypot(voxel_mm * (i - 8), voxel_mm * (j - 8)) < radius_mm && k >= 3 && k < length - 3;
        volume.labels.push_back(inside ? 4 : 0);
      }
  return volume;
}

TEST(VesselFiles, OfAStraightTubeHaveItsLengthAxisAndRadius) {
  const LabelVolume volume = tube(40, 1.5, 6);
  const auto files = vessel_files({}, "folder/scene-aorta", {&volume, 4}, "aorta");
  ASSERT_EQ(files.size(), 1U);
  EXPECT_EQ(files[0].name, "scene-aorta.vessels.toml");
  TomlTable table = TomlTable::parse(files[0].bytes, "v");
  EXPECT_EQ(table.text("frame"), "RAS");
  EXPECT_EQ(table.text("name"), "aorta");
  EXPECT_EQ(table.count("parts"), 1U);
  EXPECT_NEAR(table.number("length_mm"), 34 * 1.5, 13) << "the ends may miss a radius each";
  const std::string nodes = files[0].bytes.substr(files[0].bytes.find("nodes = "));
  double x = 0, y = 0, z = 0, radius = 0;
  int middle = 0;
  for (std::size_t at = nodes.find("\n  ["); at < nodes.find("edges = "); at = nodes.find("\n  [", at + 1)) {
    ASSERT_EQ(std::sscanf(nodes.c_str() + at, "\n  [%lf, %lf, %lf, %lf", &x, &y, &z, &radius), 4);
    EXPECT_LE(radius, 0.0075);
    if (z < 0.018 || z > 0.042) continue;  // at the flat ends it runs into a corner
    EXPECT_NEAR(std::hypot(x - 0.012, y - 0.012), 0, 0.002);
    EXPECT_NEAR(radius, 0.006, 0.0015);
    ++middle;
  }
  EXPECT_GE(middle, 3);
  EXPECT_EQ(vessel_files({}, "folder/scene-aorta", {&volume, 4}, "aorta")[0].bytes, files[0].bytes);
}

TEST(VesselFiles, AreForTubesWithLabelsOnly) {
  const LabelVolume volume = tube(20, 1.5, 6);
  EXPECT_TRUE(vessel_files({}, "s", {&volume, 4}, "liver").empty());
  EXPECT_TRUE(vessel_files({}, "s", {nullptr, 0}, "aorta").empty());
  EXPECT_THROW(vessel_files({}, "s", {&volume, 9}, "aorta"), InputError);
  for (const char* name : {"aorta", "cystic_artery", "portal_vein_and_splenic_vein", "inferior_vena_cava",
                           "common_bile_duct", "ureter_left"})
    EXPECT_TRUE(is_tubular(name)) << name;
  for (const char* name : {"liver", "gallbladder", "spleen", "colon", "label-7", ""})
    EXPECT_FALSE(is_tubular(name)) << name;
}

TEST(VolumeMeshes, TheLatticeOfABoxFillsItAndItsFactsAreInTheManifest) {
  const TriangleSurface box = test::box(Vec3::Zero(), Vec3(0.05, 0.04, 0.03));
  OrganImportOptions options;
  options.lattice_mm = 10;
  OrganManifest manifest;
  const auto files = volume_meshes(options, "dir/box", box, {}, manifest);
  ASSERT_EQ(files.size(), 1U);
  EXPECT_EQ(files[0].name, "box.lattice");
  ASSERT_TRUE(manifest.lattice);
  EXPECT_EQ(manifest.lattice->sha256, digest::of_bytes(files[0].bytes));
  const Lattice lattice = parse_lattice(files[0].bytes, "box.lattice");
  EXPECT_EQ(lattice.cells.size(), manifest.lattice->cells);
  EXPECT_EQ(lattice.nodes.size(), manifest.lattice->nodes);
  EXPECT_EQ(lattice.embedding.size(), box.vertices.size());
  EXPECT_NEAR(manifest.lattice->volume_error_pct, 0, 5);
  for (std::size_t v = 0; v < box.vertices.size(); ++v) {
    Vec3 place = Vec3::Zero();
    for (std::size_t c = 0; c < 8; ++c)
      place += static_cast<double>(lattice.embedding[v].weights[c]) *
               lattice.node_m(static_cast<std::size_t>(
                   lattice.cells[static_cast<std::size_t>(lattice.embedding[v].cell)].corners[c]));
    EXPECT_NEAR((place - box.vertices[v]).norm(), 0, 1e-7) << v;
  }
}

TEST(VolumeMeshes, NothingIsMadeUnaskedAndTetrahedraNeedNoLabels) {
  const TriangleSurface box = test::box(Vec3::Zero(), Vec3(0.05, 0.04, 0.03));
  OrganManifest manifest;
  EXPECT_TRUE(volume_meshes({}, "box", box, {}, manifest).empty());
  EXPECT_FALSE(manifest.lattice || manifest.tetrahedra);
  OrganImportOptions options;
  options.tetrahedra_mm = 5;
  EXPECT_EQ(volume_meshes(options, "box", box, {}, manifest).size(), 1U);
  EXPECT_NEAR(manifest.tetrahedra->volume_error_pct, 0, 0.1);
  options.tetrahedra_mm = std::nan("");
  EXPECT_CONTAINS(test::message_of<InputError>([&] { volume_meshes(options, "box", box, {}, manifest); }),
                  "above 0 and up to 1000 mm");
}

TEST(VolumeMeshes, TetrahedraOfABallCarryItsNameAndVolume) {
  OrganImportOptions options;
  options.tetrahedra_mm = 6;
  OrganManifest manifest;
  manifest.name = "ball";
  const auto files = volume_meshes(options, "ball", test::sphere(Vec3::Zero(), 0.014, 3), {}, manifest);
  ASSERT_EQ(files.size(), 1U);
  EXPECT_EQ(files[0].name, "ball.msh");
  EXPECT_EQ(files[0].bytes.find("$MeshFormat\n2.2"), 0U);
  EXPECT_CONTAINS(files[0].bytes, "$Nodes\n" + std::to_string(manifest.tetrahedra->nodes) + "\n");
  EXPECT_EQ(manifest.tetrahedra->sha256, digest::of_bytes(files[0].bytes));
  EXPECT_CONTAINS(files[0].bytes, "3 1 \"ball\"");
  EXPECT_GT(manifest.tetrahedra->worst, 12) << "smallest dihedral angle";
  EXPECT_LT(std::abs(manifest.tetrahedra->volume_error_pct), 0.1);
}

/// A bare map that marks a cube of 8 voxels of each number.
LabelMap bare_map(const std::vector<int>& numbers) {
  LabelMap map;
  map.layers.emplace_back();
  LabelVolume& volume = map.layers.back();
  volume.size = {static_cast<int>(3 * numbers.size()), 4, 4};
  volume.labels.assign(static_cast<std::size_t>(48 * static_cast<int>(numbers.size())), 0);
  for (std::size_t n = 0; n < numbers.size(); ++n) {
    for (int v = 0; v < 8; ++v)
      volume.labels[volume.offset(static_cast<int>(3 * n) + (v & 1), 1 + ((v >> 1) & 1), 1 + (v >> 2))] =
          static_cast<std::uint16_t>(numbers[n]);
    map.segments.push_back({0, numbers[n], ""});
  }
  return map;
}

std::vector<ChosenLabel> chosen(const OrganImportOptions& options, const LabelMap& map,
                                std::vector<std::string>& said) {
  return choose_labels(options, map, "map.nii.gz", said);
}

TEST(ChosenLabelsByTable, EveryNumberOfANamedTableGetsItsName) {
  for (const std::string& name : label_table_names()) {
    const LabelTable& table = label_table(name);
    std::vector<int> numbers;
    for (std::size_t n = 0; n < table.labels.size(); n += 9) numbers.push_back(table.labels[n].number);
    const LabelMap map = bare_map(numbers);
    for (const int number : numbers) {
      OrganImportOptions by_number, by_name;
      by_number.label_table = by_name.label_table = name;
      by_number.label = {std::to_string(number)}, by_name.label = {std::string(*table.name_of(number))};
      std::vector<std::string> said;
      const auto a = chosen(by_number, map, said), b = chosen(by_name, map, said);
      EXPECT_EQ(a[0].segment.number, number);
      EXPECT_EQ(b[0].segment.number, number) << name;
      EXPECT_EQ(a[0].segment.name, by_name.label[0]);
      EXPECT_EQ(a[0].table, name);
      EXPECT_TRUE(said.empty()) << "a table that was named leaves nothing to assume";
    }
  }
}

TEST(ChosenLabelsByTable, CountedMapsStayNumbersAndAllTakesTheLargeOnes) {
  LabelMap map = bare_map({1, 2, 3});
  std::replace(map.layers[0].labels.begin(), map.layers[0].labels.end(), std::uint16_t{2}, std::uint16_t{0});
  map.layers[0].labels[map.layers[0].offset(4, 1, 1)] = 2;
  OrganImportOptions options;
  options.all = true;
  std::vector<std::string> said;
  const auto labels = chosen(options, map, said);
  ASSERT_EQ(labels.size(), 2U);
  EXPECT_EQ(file_name_of(labels[0].segment), "label-1");
  EXPECT_EQ(file_name_of(labels[1].segment), "label-3");
  EXPECT_EQ(
      std::count_if(said.begin(), said.end(), [](const auto& line) { return line.find("label 2 is left out") == 0; }),
      1);
}

TEST(ChosenLabelsByTable, FileNamesAreFixedPoints) {
  std::mt19937 generator(6);
  for (int n = 0; n < 300; ++n) {
    std::string name(generator() % 12, ' ');
    for (char& letter : name) letter = static_cast<char>(1 + generator() % 254);
    const std::string file = file_name_of({0, 12, name});
    EXPECT_FALSE(file.empty());
    EXPECT_EQ(file.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-_"), std::string::npos) << file;
    EXPECT_EQ(file_name_of({0, 12, file}), file);
  }
}

TEST(Slices, TheCutOfABoxHasItsPerimeterInEveryAxis) {
  const Vec3 low(0.01, -0.02, 0.03), high(0.05, 0.04, 0.12);
  const TriangleSurface box = test::box(low, high);
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 sides = 1e3 * (high - low);
    double length = 0;
    for (const auto& [a, b] : cut_by_plane(box, axis, 1e3 * (low[axis] + high[axis]) / 2)) length += (a - b).norm();
    EXPECT_NEAR(length, 2 * (sides.sum() - sides[axis]), 1e-9) << axis;
    EXPECT_TRUE(cut_by_plane(box, axis, 1e3 * high[axis] + 1).empty());
    EXPECT_TRUE(cut_by_plane(box, axis, 1e3 * low[axis] - 1).empty());
  }
}

TEST(Slices, TheCutOfAClosedSurfaceIsClosedAlsoThroughVertices) {
  const TriangleSurface ball = test::sphere(Vec3::Zero(), 0.03, 3);
  for (const double value : {0.0, 7.0, 30.0 * std::numbers::sqrt2 / 2, -12.5}) {
    std::map<std::array<long, 3>, int> ends;
    for (const auto& segment : cut_by_plane(ball, 0, value)) {
      if ((segment[0] - segment[1]).norm() < 1e-9) continue;
      for (const Vec3& end : segment)
        ++ends[{std::lround(1e6 * end.x()), std::lround(1e6 * end.y()), std::lround(1e6 * end.z())}];
    }
    EXPECT_FALSE(ends.empty());
    for (const auto& [place, count] : ends) EXPECT_EQ(count % 2, 0) << value;
  }
}

TEST(Slices, AShiftOfEverythingIsTheSamePicture) {
  LabelMap here, there;
  here.layers = {test::ball_volume(16, 4, {3, -2, 5}, 20)};
  there = here;
  const Vec3 shift(64, -32, 128);
  there.layers[0].index_to_ras_mm.translation() += shift;
  for (const SlicePlane plane : {SlicePlane::kAxial, SlicePlane::kCoronal, SlicePlane::kSagittal}) {
    const Image a = slice_picture({nullptr, &here}, {}, plane, Vec3(2, 2, 2), 80, 160);
    const Image b = slice_picture({nullptr, &there}, {}, plane, Vec3(2, 2, 2) + shift, 80, 160);
    for (int row = 40; row < 120; ++row)  // away from the words, which tell the place
      for (int column = 30; column < 130; ++column) ASSERT_EQ(a.pixel(column, row)[0], b.pixel(column, row)[0]);
  }
}

TEST(OutlineColours, TheFirstEightDifferAndAreWrittenAsTheyAre) {
  std::map<std::string, std::size_t> seen;
  for (std::size_t n = 0; n < 8; ++n) {
    const Colour colour = outline_colour(n);
    EXPECT_TRUE(seen.emplace(css_colour(colour), n).second) << n;
    unsigned r = 0, g = 0, b = 0;
    ASSERT_EQ(std::sscanf(css_colour(colour).c_str(), "#%2x%2x%2x", &r, &g, &b), 3);
    EXPECT_EQ(r, colour.r);
    EXPECT_EQ(g, colour.g);
    EXPECT_EQ(b, colour.b);
  }
  EXPECT_EQ(css_colour(Colour{0, 10, 255, 1}), "#000aff");
}

}  // namespace
}  // namespace trocar::volumes_and_labels_more_test
