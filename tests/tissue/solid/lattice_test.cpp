#include "tissue/solid/lattice.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <random>

#include "haptics/input_error.h"
#include "tests/tissue/support/shapes.h"
#include "tests/tissue/support/temporary_folder.h"

namespace trocar::lattice_test {
namespace {

TEST(Lattice, ABoxOfWholeCellsIsFullyFilled) {
  const BuiltLattice built = build_lattice(test::box(Vec3(0.1, 0.2, 0.3), Vec3(0.14, 0.23, 0.32)), {.cell_m = 0.01});
  EXPECT_NEAR(built.facts.sampled_volume_ml, 24, 0.01 * 24);
  std::size_t full = 0;
  for (const LatticeCell& cell : built.lattice.cells) full += cell.fill > 0.85 ? 1 : 0;
  EXPECT_GE(full, 6U);
  EXPECT_EQ(built.facts.components, 1U);
}

TEST(Lattice, BallKeepsItsVolumeAndHoldsEveryVertex) {
  const TriangleSurface ball = test::sphere(Vec3(0.01, -0.02, 0.03), 0.04, 4);
  const BuiltLattice built = build_lattice(ball, {.cell_m = 0.008});
  EXPECT_NEAR(built.facts.volume_error_pct, 0, 0.3);
  ASSERT_EQ(built.lattice.embedding.size(), ball.vertices.size());
  EXPECT_LT(built.facts.worst_embedding_m, 1e-8);
  for (std::size_t v = 0; v < ball.vertices.size(); ++v) {
    const Embedding& e = built.lattice.embedding[v];
    Vec3 back = Vec3::Zero();
    double sum = 0;
    for (std::size_t n = 0; n < 8; ++n) {
      EXPECT_GE(e.weights[n], 0);
      sum += e.weights[n];
      back += e.weights[n] * built.lattice.node_m(static_cast<std::size_t>(
                                 built.lattice.cells[static_cast<std::size_t>(e.cell)].corners[n]));
    }
    EXPECT_NEAR(sum, 1, 1e-6);
    EXPECT_LT((back - ball.vertices[v]).norm(), 1e-8);
  }
}

TEST(Lattice, ThinCellsAreFlooredAndCounted) {
  const BuiltLattice built = build_lattice(test::sphere(Vec3::Zero(), 0.03, 4), {.cell_m = 0.01, .least_fill = 0.15});
  std::size_t floored = 0, tenths = 0;
  for (const LatticeCell& cell : built.lattice.cells) {
    EXPECT_GE(cell.fill, 0.15);
    floored += cell.fill == 0.15 ? 1 : 0;
  }
  for (const std::size_t count : built.facts.fill_tenths) tenths += count;
  EXPECT_EQ(tenths, built.facts.cells);
  EXPECT_EQ(floored, built.facts.floored_cells);
  EXPECT_GT(built.facts.floored_volume_ml, 0);
  EXPECT_LE(built.facts.empty_cells, built.facts.floored_cells);
}

TEST(Lattice, ACavityIsNotFilled) {
  TriangleSurface inner = test::sphere(Vec3::Zero(), 0.02, 4);
  for (auto& t : inner.triangles) std::swap(t[1], t[2]);
  const BuiltLattice built = build_lattice(test::joined(test::sphere(Vec3::Zero(), 0.04, 4), inner), {.cell_m = 0.005});
  EXPECT_NEAR(built.facts.sampled_volume_ml, (test::sphere_volume(0.04) - test::sphere_volume(0.02)) * 1e6, 2.5);
}

TEST(Lattice, LabelsAreVotedByTheSamplesWithin) {
  LabelVolume labels = test::ball_volume(40, 2, {0, 0, 0}, 30);
  for (int k = 0; k < 40; ++k)
    for (int j = 0; j < 40; ++j)
      for (int i = 20; i < 40; ++i) {
        auto& label = labels.labels[labels.offset(i, j, k)];
        label = label != 0 ? 7 : 0;
      }
  const BuiltLattice built = build_lattice(test::sphere(Vec3::Zero(), 0.029, 4), {.cell_m = 0.01}, &labels);
  for (const LatticeCell& cell : built.lattice.cells) {
    const double middle = built.lattice.origin_m.x() + 0.01 * (cell.place[0] + 0.5);
    if (cell.fill > 0.3 && std::abs(middle) > 0.0011) {
      EXPECT_EQ(cell.label, middle > 0 ? 7 : 1);
    }
  }
}

TEST(Lattice, RefusesSillyCells) {
  const TriangleSurface ball = test::sphere(Vec3::Zero(), 0.05, 2);
  EXPECT_THROW(build_lattice(ball, {.cell_m = 0}), InputError);
  EXPECT_CONTAINS(test::message_of<InputError>([&] { build_lattice(ball, {.cell_m = 1e-5}); }), "longer edge");
  EXPECT_THROW(build_lattice({}, {}), InputError);
}

TEST(LatticeFile, WhatIsWrittenIsRead) {
  const Lattice lattice = build_lattice(test::sphere(Vec3(0.2, 0, 0), 0.03, 3), {.cell_m = 0.012}).lattice;
  const std::string bytes = lattice_bytes(lattice);
  const Lattice read = parse_lattice(bytes, "x.lattice");
  EXPECT_EQ(read.nodes, lattice.nodes);
  EXPECT_EQ(read.cells.size(), lattice.cells.size());
  EXPECT_EQ(read.embedding.size(), lattice.embedding.size());
  EXPECT_EQ(lattice_bytes(read), bytes);
  EXPECT_EQ(lattice_bytes(build_lattice(test::sphere(Vec3(0.2, 0, 0), 0.03, 3), {.cell_m = 0.012}).lattice), bytes);
}

TEST(LatticeFile, DamageIsRefusedWithItsPlace) {
  const std::string bytes = lattice_bytes(build_lattice(test::sphere(Vec3::Zero(), 0.03, 2), {.cell_m = 0.02}).lattice);
  const auto says = [](const std::string& damaged) {
    return test::message_of<InputError>([&] { parse_lattice(damaged, "x.lattice"); });
  };
  EXPECT_CONTAINS(says("TROCLAT0"), "no lattice file");
  EXPECT_CONTAINS(says(bytes.substr(0, bytes.size() - 1)), "counts do not fit");
  std::string weight = bytes;
  weight[bytes.size() - 1] = '\x7f';
  EXPECT_CONTAINS(says(weight), "x.lattice: byte");
}

TEST(LatticeFile, AnyMutationIsReadOrRefused) {
  const std::string bytes =
      lattice_bytes(build_lattice(test::sphere(Vec3::Zero(), 0.03, 2), {.cell_m = 0.015}).lattice);
  const char* asked = std::getenv("TROCAR_FUZZ_SECONDS");
  const auto until =
      std::chrono::steady_clock::now() + std::chrono::duration<double>(asked != nullptr ? std::atof(asked) : 3);
  std::mt19937 random(11);
  std::size_t refused = 0, rounds = 0;
  for (; std::chrono::steady_clock::now() < until; ++rounds) {
    std::string mutated = bytes;
    for (unsigned n = 0; n <= random() % 4; ++n)
      mutated[random() % (random() % 2 == 0 ? 60 : mutated.size())] = static_cast<char>(random());
    if (random() % 5 == 0) mutated.resize(random() % mutated.size());
    try {
      parse_lattice(mutated, "x");
    } catch (const InputError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, rounds / 2);
}

}  // namespace
}  // namespace trocar::lattice_test
