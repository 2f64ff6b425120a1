#include "app/studies/tissue/reference_block.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace trocar::reference_block_test {
namespace {

using Eigen::Vector3d;

TEST(ReferenceBlock, AFlatPunchOnALargeBlockComesToTheHalfSpace) {
  constexpr double kRadius = 0.01;
  const double half_space = 2 * kRadius * 5000 / (1 - 0.45 * 0.45);
  ReferenceBlock block{.size_m = {1, 1, 0.5}};
  double before = 1;
  for (block.cells = 1; block.cells <= 3; ++block.cells) {
    const double error = stiffness(block, BlockLoad::punch, kRadius).n_per_m / half_space - 1;
    RecordProperty("error_at_" + std::to_string(block.cells), std::to_string(error));
    EXPECT_LT(std::abs(error), 0.7 * before) << block.cells;
    before = std::abs(error);
  }
  EXPECT_LT(before, 0.03) << "of which 50 radii of block leave more than 1 %";
}

TEST(ReferenceBlock, ATentOnEverLargerBlocksComesToTheHalfSpace) {
  // F^2 over 4 pi / E* times the integral of the square of the pressure's Hankel transform, evaluated apart: 1.42985 R
  // E*.
  constexpr double kRadius = 0.015, kHalfSpace = 1.42985 * kRadius * 5000 / (1 - 0.45 * 0.45);
  const auto pressed = [](double side) {
    return stiffness({.size_m = {side, side, side / 2}, .cells = 2}, BlockLoad::tent, kRadius).n_per_m;
  };
  const double unbounded = 2 * pressed(0.8) - pressed(0.4);  // what the sides add falls as their distance grows
  RecordProperty("error", std::to_string(unbounded / kHalfSpace - 1));
  EXPECT_NEAR(unbounded / kHalfSpace, 1.02, 0.01) << "2 cells are 2 % too stiff, as on the block below";
}

TEST(ReferenceBlock, TheTentOfTheTissueNotes) {
  ReferenceBlock block{.cells = 1};
  const ConvergedStiffness converged = converged_stiffness(block, BlockLoad::tent, 0.015);
  RecordProperty("n_per_m", std::to_string(converged.n_per_m));
  RecordProperty("uncertainty_n_per_m", std::to_string(converged.uncertainty_n_per_m));
  EXPECT_NEAR(converged.n_per_m, 159.3, 1) << "Richardson's from 2, 4 and 8 cells: 159.28 +- 0.08";
  block.cells = 3;
  EXPECT_NEAR(stiffness(block, BlockLoad::tent, 0.015).n_per_m, 159.3, 0.01 * 159.3) << "3 cells are within 1 %";
}

TEST(ReferenceBlock, ANoduleTwiceAsStiffIsFelt) {
  ReferenceBlock block{.cells = 3};
  const double plain = stiffness(block, BlockLoad::tent, 0.015).n_per_m;
  block.young_pa = [](const Vector3d& x) { return (x - Vector3d(0, 0, -0.0175)).norm() < 0.0075 ? 10000.0 : 5000.0; };
  const double nodule = stiffness(block, BlockLoad::tent, 0.015).n_per_m;
  RecordProperty("more", std::to_string(nodule / plain - 1));
  EXPECT_GT(nodule, 1.005 * plain);
  EXPECT_LT(nodule, 1.2 * plain);
}

TEST(ReferenceBlock, WhatHoldsMoreIsStiffer) {
  ReferenceBlock block{.cells = 2};
  const double free = stiffness(block, BlockLoad::punch, 0.01).n_per_m;
  EXPECT_GT(stiffness(block, BlockLoad::bonded_punch, 0.01).n_per_m, free);
  block.sides = BlockSides::held;
  EXPECT_GT(stiffness(block, BlockLoad::punch, 0.01).n_per_m, free);
  EXPECT_THROW(stiffness(block, BlockLoad::punch, 0.06), std::invalid_argument);
}

}  // namespace
}  // namespace trocar::reference_block_test
