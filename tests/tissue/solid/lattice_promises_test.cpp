// The lattice, its file byte by byte, tetrahedra, centrelines and scenes: what their headers promise.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <numbers>
#include <random>
#include <set>
#include <sstream>

#include "haptics/input_error.h"
#include "tests/tissue/support/shapes.h"
#include "tests/tissue/support/temporary_folder.h"
#include "tissue/mesh/surface/topology.h"
#include "tissue/mesh/surface/vessel_graph.h"
#include "tissue/organ/scene_compiler.h"
#include "tissue/solid/lattice.h"
#include "tissue/solid/tetrahedra_file.h"

namespace trocar::lattice_promises_test {
namespace {

constexpr std::size_t kHeader = 52, kNode = 12, kCell = 56, kVertex = 36;

TriangleSurface moved(TriangleSurface surface, const Vec3& by) {
  for (Vec3& vertex : surface.vertices) vertex += by;
  return surface;
}

/// One cell round one vertex: the smallest whole lattice.
Lattice one_cell() {
  Lattice lattice;
  lattice.origin_m = Vec3(0.1, -0.2, 0.3);
  lattice.cell_m = 0.01;
  LatticeCell cell;
  cell.place = {4, 5, 6};
  cell.fill = 0.5;
  cell.label = 7;
  for (int n = 0; n < 8; ++n) {
    lattice.nodes.push_back({4 + (n & 1), 5 + (n >> 1 & 1), 6 + (n >> 2)});
    cell.corners[static_cast<std::size_t>(n)] = n;
  }
  lattice.cells = {cell};
  lattice.embedding.resize(1);
  lattice.embedding[0].weights.fill(0.125F);
  return lattice;
}

template <typename Value>
std::string with(std::string bytes, std::size_t at, Value value) {
  std::memcpy(bytes.data() + at, &value, sizeof value);
  return bytes;
}

template <typename Value>
Value at(const std::string& bytes, std::size_t place) {
  Value value;
  std::memcpy(&value, bytes.data() + place, sizeof value);
  return value;
}

std::string refusal(const std::string& bytes) {
  return test::message_of<InputError>([&] { parse_lattice(bytes, "some.lattice"); });
}

/// A straight tube of label 1 along an axis, of a given radius in voxels, and what it is mirrored or turned to.
LabelVolume tube(std::size_t axis, int extent, double radius) {
  LabelVolume volume = test::ball_volume(extent, 1, {0, 0, 0}, -1);
  const double middle = (extent - 1) / 2.0;
  for (int k = 0; k < extent; ++k)
    for (int j = 0; j < extent; ++j)
      for (int i = 0; i < extent; ++i) {
        Vec3 off = Vec3(i, j, k) - Vec3::Constant(middle);
        const double along = std::abs(off[static_cast<Eigen::Index>(axis)]);
        off[static_cast<Eigen::Index>(axis)] = 0;
        if (off.norm() < radius && along < middle - 3) volume.labels[volume.offset(i, j, k)] = 1;
      }
  return volume;
}

double volume_of(const TetrahedraMesh& mesh, std::size_t t) {
  const auto node = [&](std::size_t n) -> const Vec3& {
    return mesh.nodes[static_cast<std::size_t>(mesh.tetrahedra[t][n])];
  };
  return (node(1) - node(0)).cross(node(2) - node(0)).dot(node(3) - node(0)) / 6;
}

TEST(LatticeOfABody, CellsAreInOrderAndTheirCornersAreTheirOwn) {
  const Lattice lattice = build_lattice(test::sphere(Vec3(0.3, 0.1, -0.2), 0.04, 3), {.cell_m = 0.011}).lattice;
  std::set<std::array<std::int32_t, 3>> nodes(lattice.nodes.begin(), lattice.nodes.end());
  EXPECT_EQ(nodes.size(), lattice.nodes.size()) << "a node twice";
  std::set<std::int32_t> used;
  std::array<std::int32_t, 3> before{-1, -1, -1};
  for (const LatticeCell& cell : lattice.cells) {
    const std::array here{cell.place[2], cell.place[1], cell.place[0]};
    EXPECT_LT(before, here);
    before = here;
    for (std::size_t n = 0; n < 8; ++n) {
      used.insert(cell.corners[n]);
      const auto& node = lattice.nodes.at(static_cast<std::size_t>(cell.corners[n]));
      for (std::size_t axis = 0; axis < 3; ++axis)
        EXPECT_EQ(node[axis], cell.place[axis] + static_cast<std::int32_t>(n >> axis & 1));
    }
  }
  EXPECT_EQ(used.size(), lattice.nodes.size()) << "a node of no cell";
}

TEST(LatticeOfABody, MovesWithItAndFillsAgreeWithTheFacts) {
  const TriangleSurface ball = test::sphere(Vec3::Zero(), 0.035, 3);
  const BuiltLattice here = build_lattice(ball, {.cell_m = 0.01, .least_fill = 0.2});
  const Vec3 by(0.25, -0.5, 0.125);
  const BuiltLattice there = build_lattice(moved(ball, by), {.cell_m = 0.01, .least_fill = 0.2});
  ASSERT_EQ(here.lattice.cells.size(), there.lattice.cells.size());
  EXPECT_LT((there.lattice.origin_m - here.lattice.origin_m - by).norm(), 1e-12);
  double fills = 0, there_fills = 0;
  for (std::size_t c = 0; c < here.lattice.cells.size(); ++c) {
    EXPECT_EQ(here.lattice.cells[c].place, there.lattice.cells[c].place);
    fills += here.lattice.cells[c].fill, there_fills += there.lattice.cells[c].fill;
    EXPECT_EQ(here.lattice.cells[c].label, 0);
  }
  EXPECT_NEAR(fills, there_fills, 0.01 * fills);  // samples that lie on a facet may fall to either side
  EXPECT_NEAR(fills, here.facts.sampled_volume_ml + here.facts.floored_volume_ml, 1e-9);  // a cell holds 1 ml
  EXPECT_EQ(here.facts.cells, here.lattice.cells.size());
  EXPECT_EQ(here.facts.nodes, here.lattice.nodes.size());
}

TEST(LatticeOfABody, FinerCellsMeasureTheVolumeBetter) {
  const TriangleSurface ball = test::sphere(Vec3::Zero(), 0.05, 4);
  for (const double cell : {0.02, 0.01, 0.005}) {
    const LatticeFacts facts = build_lattice(ball, {.cell_m = cell}).facts;
    EXPECT_NEAR(facts.sampled_volume_ml, ball.volume_m3() * 1e6, 2 * std::pow(cell / 0.02, 1.5)) << cell;
    EXPECT_NEAR(facts.volume_error_pct, (facts.sampled_volume_ml / (ball.volume_m3() * 1e6) - 1) * 100, 1e-6);
  }
}

TEST(LatticeOfABody, TwoBodiesApartAreTwoComponents) {
  const TriangleSurface ball = test::sphere(Vec3::Zero(), 0.03, 3);
  const auto components = [&](double gap) {
    return build_lattice(test::joined(ball, moved(ball, Vec3(0.06 + gap, 0, 0))), {.cell_m = 0.01}).facts.components;
  };
  EXPECT_EQ(components(0.05), 2U);
  EXPECT_EQ(components(-0.02), 1U);
}

TEST(LatticeFileBytes, LieWhereTheFormatSays) {
  const Lattice lattice = one_cell();
  const std::string bytes = lattice_bytes(lattice);
  ASSERT_EQ(bytes.size(), 8 + 4 * 8 + 3 * 4 + 8 * kNode + kCell + kVertex);
  EXPECT_EQ(bytes.substr(0, 8), "TROCLAT1");
  EXPECT_EQ(at<double>(bytes, 16), -0.2);
  EXPECT_EQ(at<double>(bytes, 32), 0.01);
  EXPECT_EQ(at<std::uint32_t>(bytes, 40), 8U);
  EXPECT_EQ(at<std::uint32_t>(bytes, 44), 1U);
  EXPECT_EQ(at<std::uint32_t>(bytes, 48), 1U);
  EXPECT_EQ(at<std::int32_t>(bytes, kHeader + 7 * kNode + 8), 7);
  const std::size_t cell = kHeader + 8 * kNode;
  EXPECT_EQ(at<std::int32_t>(bytes, cell + 12 + 4 * 3), 3);
  EXPECT_EQ(at<double>(bytes, cell + 44), 0.5);
  EXPECT_EQ(at<std::int32_t>(bytes, cell + 52), 7);
  EXPECT_EQ(at<float>(bytes, cell + kCell + 4), 0.125F);
  EXPECT_EQ(lattice_bytes(parse_lattice(bytes, "x")), bytes);
}

TEST(LatticeFileBytes, EveryShorterOrLongerFileIsRefused) {
  const std::string bytes = lattice_bytes(one_cell());
  for (std::size_t length = 0; length < bytes.size(); ++length)
    EXPECT_THROW(parse_lattice(bytes.substr(0, length), "x"), InputError) << length;
  EXPECT_CONTAINS(refusal(bytes + '\0'), "counts do not fit");
}

TEST(LatticeFileBytes, RefusalsNameFilePlaceAndReason) {
  const std::string bytes = lattice_bytes(one_cell());
  const std::size_t cell = kHeader + 8 * kNode, vertex = cell + kCell;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto expect = [](const std::string& damaged, std::size_t place, const std::string& reason) {
    EXPECT_CONTAINS(refusal(damaged), "some.lattice: byte " + std::to_string(place) + ": " + reason);
  };
  expect(with(bytes, 7, '2'), 0, "this is no lattice file");
  expect(with(bytes, 8, nan), 40, "origin or cell is not a length");
  for (const double length : {0.0, -0.01, 1.0, nan}) expect(with(bytes, 32, length), 40, "origin or cell");
  for (const std::size_t count : {40, 44, 48})
    for (const std::uint32_t number : {0U, 2U, 0xffffffffU}) expect(with(bytes, count, number), kHeader, "the counts");
  for (const std::int32_t corner : {-1, 8}) expect(with(bytes, cell + 12, corner), cell + 16, "a corner names no node");
  expect(with(bytes, cell + 16, std::int32_t{0}), cell + 20, "a corner is not where its cell lies");
  expect(with(bytes, cell, std::int32_t{5}), cell + 16, "a corner is not where its cell lies");
  for (const double fill : {0.0, 1.01, nan}) expect(with(bytes, cell + 44, fill), cell + 52, "a cell's fill");
  for (const std::int32_t number : {-1, 1}) expect(with(bytes, vertex, number), vertex + 4, "a vertex lies in no cell");
  for (const float weight : {-0.1F, 1.1F}) expect(with(bytes, vertex + 8, weight), vertex + 12, "a weight is not");
  expect(with(bytes, vertex + 8, 0.13F), vertex + 36, "weights of a vertex do not sum to 1");
}

TEST(TetrahedraText, IsReadBackNodeByNodeAndElementByElement) {
  TetrahedraMesh mesh;
  std::mt19937 random(9);
  for (int n = 0; n < 40; ++n)
    mesh.nodes.emplace_back(static_cast<double>(random()) * 1e-10, static_cast<double>(random()) * -1e-12, n * 1e-3);
  for (int t = 0; t < 60; ++t) {
    std::array<std::int32_t, 4> corners{};
    for (auto& corner : corners) corner = static_cast<std::int32_t>(random() % 40);
    mesh.tetrahedra.push_back(corners);
    mesh.labels.push_back(static_cast<std::int32_t>(1 + random() % 3));
  }
  std::istringstream in(gmsh_text(mesh, {}));
  std::string word;
  std::size_t count = 0, number = 0;
  while (in >> word && word != "$Nodes") continue;
  in >> count;
  ASSERT_EQ(count, 40U);
  for (const Vec3& node : mesh.nodes) {
    Vec3 read;
    in >> number >> read.x() >> read.y() >> read.z();
    EXPECT_LT((read - node).norm(), 1e-8 * (1 + node.norm()));
  }
  EXPECT_EQ(number, 40U);
  in >> word >> word >> count;
  ASSERT_EQ(count, 60U);
  for (std::size_t t = 0; t < 60; ++t) {
    int kind = 0, tags = 0, physical = 0, elementary = 0;
    in >> number >> kind >> tags >> physical >> elementary;
    EXPECT_TRUE(number == t + 1 && kind == 4 && tags == 2 && physical == mesh.labels[t] && elementary == physical);
    for (const auto corner : mesh.tetrahedra[t]) EXPECT_TRUE(in >> number && number == std::size_t(corner + 1));
  }
}

TEST(DihedralAngles, OfTheCornerOfACubeAndUnderEveryRenumbering) {
  TetrahedraMesh mesh;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  std::array<std::int32_t, 4> corners{0, 1, 2, 3};
  do mesh.tetrahedra.push_back(corners);
  while (std::next_permutation(corners.begin(), corners.end()));
  const double expected = std::acos(1 / std::sqrt(3.0)) * 180 / std::numbers::pi;
  for (std::size_t t = 0; t < 24; ++t) EXPECT_NEAR(smallest_dihedral_deg(mesh, t), expected, 1e-9);
  mesh.nodes[3].z() = 1e-3;
  EXPECT_LT(smallest_dihedral_deg(mesh, 0), 0.1);
}

TEST(TetrahedraOfABall, FactsAreThoseOfTheMesh) {
  const TriangleSurface ball = test::sphere(Vec3(0.001, 0, -0.001), 0.013, 3);
  const BuiltTetrahedra built = make_tetrahedra({&ball}, {.cell_m = 0.008});
  EXPECT_EQ(built.facts.nodes, built.mesh.nodes.size());
  EXPECT_EQ(built.facts.tetrahedra, built.mesh.tetrahedra.size());
  double sum = 0, smallest = 180;
  std::map<std::array<std::int32_t, 3>, int> faces;
  for (std::size_t t = 0; t < built.mesh.tetrahedra.size(); ++t) {
    EXPECT_GT(volume_of(built.mesh, t), 0);
    sum += volume_of(built.mesh, t);
    smallest = std::min(smallest, smallest_dihedral_deg(built.mesh, t));
    for (std::size_t n = 0; n < 4; ++n) {
      const auto& corners = built.mesh.tetrahedra[t];
      std::array face{corners[(n + 1) % 4], corners[(n + 2) % 4], corners[(n + 3) % 4]};
      std::sort(face.begin(), face.end());
      ++faces[face];
    }
  }
  for (const auto& [face, count] : faces) EXPECT_LE(count, 2);
  EXPECT_NEAR(built.facts.volume_ml, sum * 1e6, 1e-6 * built.facts.volume_ml);
  EXPECT_NEAR(built.facts.min_dihedral_deg, smallest, 1e-6);
}

TEST(VesselGraphOfATube, IsTheSameAlongEveryAxis) {
  for (const std::size_t axis : {0U, 1U, 2U}) {
    const VesselGraph graph = vessel_graph(tube(axis, 34, 3.2), 1);
    EXPECT_EQ(graph.parts, 1U);
    EXPECT_EQ(graph.ends(), 2U);
    EXPECT_EQ(graph.branchings(), 0U);
    EXPECT_NEAR(graph.length_m, 0.027, 0.004) << axis;
    double length = 0;
    const auto place = [&](std::int32_t node) { return graph.nodes.at(static_cast<std::size_t>(node)).place_m; };
    for (const auto& [a, b] : graph.edges) length += (place(a) - place(b)).norm();
    EXPECT_NEAR(length, graph.length_m, 1e-12);
    for (const VesselNode& node : graph.nodes) EXPECT_LT(node.radius_m, 0.0032 + 0.0005);
  }
}

TEST(VesselGraphOfATube, PartsOfFewerThanEightVoxelsAreNoTrees) {
  LabelVolume volume = tube(0, 30, 2.5);
  for (int i = 3; i < 10; ++i) volume.labels[volume.offset(i, 3, 3)] = 1;
  EXPECT_EQ(vessel_graph(volume, 1).parts, 1U);
  volume.labels[volume.offset(10, 3, 3)] = 1;
  EXPECT_EQ(vessel_graph(volume, 1).parts, 2U);
  for (auto& label : volume.labels) label = 0;
  for (int i = 3; i < 10; ++i) volume.labels[volume.offset(i, 3, 3)] = 4;
  EXPECT_CONTAINS(test::message_of<InputError>([&] { vessel_graph(volume, 4); }), "label 4");
}

TEST(SceneOfTwo, ComesInTheOrderOfTheRequestsWithTheInterfaceTheSame) {
  LabelMap map;
  map.layers.push_back(test::ball_volume(22, 2, {0, 0, 0}, 15));
  for (int k = 0; k < 22; ++k)
    for (int j = 0; j < 22; ++j)
      for (int i = 0; i < 11; ++i)
        if (auto& label = map.layers[0].labels[map.layers[0].offset(i, j, k)]; label != 0) label = 9;
  const CompiledScene one = compile_scene(map, {{0, 1, "high", 400}, {0, 9, "low", 400}}, {});
  const CompiledScene two = compile_scene(map, {{0, 9, "low", 400}, {0, 1, "high", 400}}, {});
  EXPECT_GT(volume_centroid_m(one.organs.at(0).surface).x(), 0);
  EXPECT_LT(volume_centroid_m(two.organs.at(0).surface).x(), 0);
  ASSERT_EQ(one.shared.size(), 1U);
  ASSERT_EQ(two.shared.size(), 1U);
  EXPECT_NEAR(one.shared[0].area_m2, two.shared[0].area_m2, 0.03 * one.shared[0].area_m2);
  for (std::size_t n : {0U, 1U})
    EXPECT_NEAR(one.organs[n].facts.volume_ml, two.organs[1 - n].facts.volume_ml, 0.01 * one.organs[n].facts.volume_ml);
}

}  // namespace
}  // namespace trocar::lattice_promises_test
