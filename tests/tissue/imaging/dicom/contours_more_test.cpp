// Contours and planes against brute force: filling, areas, even heights, and the grids that contours are filled on.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "haptics/input_error.h"
#include "tests/tissue/support/temporary_folder.h"
#include "tissue/imaging/dicom/contour_fill.h"
#include "tissue/imaging/dicom/contour_grid.h"
#include "tissue/imaging/dicom/even_planes.h"
#include "tissue/imaging/dicom/segment_layers.h"

namespace trocar::test::contours_more_test {
namespace {

using Pixels = std::vector<int>;

Pixels filled(const std::vector<PlaneContour>& contours, int width, int height) {
  Pixels pixels(static_cast<std::size_t>(width * height), 0);
  fill_even_odd(contours, width, height, [&](int first, int end, int row) {
    EXPECT_LT(first, end);
    EXPECT_TRUE(first >= 0 && end <= width && row >= 0 && row < height);
    for (int i = first; i < end; ++i) ++pixels[static_cast<std::size_t>(row * width + i)];
  });
  return pixels;
}

/// Crossings of the half-line to the left of (x, y) with one contour, as the header words it.
int crossings_left_of(const PlaneContour& contour, double x, double y) {
  int count = 0;
  for (std::size_t n = 0; n < contour.size(); ++n) {
    const Eigen::Vector2d &a = contour[n], &b = contour[(n + 1) % contour.size()];
    if (!(std::min(a.y(), b.y()) <= y && y < std::max(a.y(), b.y()))) continue;
    if (a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x()) <= x) ++count;
  }
  return count;
}

Pixels filled_one_by_one(const std::vector<PlaneContour>& contours, int width, int height) {
  Pixels pixels;
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column) {
      int count = 0;
      for (const PlaneContour& contour : contours) count += crossings_left_of(contour, column, row);
      pixels.push_back(count % 2);
    }
  return pixels;
}

PlaneContour drawn(std::mt19937_64& random, std::size_t corners, double low, double high) {
  std::uniform_real_distribution<double> place(low, high);
  PlaneContour contour;
  for (std::size_t n = 0; n < corners; ++n) {
    const double x = place(random);
    contour.emplace_back(x, place(random));
  }
  return contour;
}

PlaneContour rectangle(double x0, double y0, double x1, double y1) { return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}; }

TEST(ContourFillMore, RandomTanglesEqualTheRulePixelByPixel) {
  std::mt19937_64 random(101);
  for (int round = 0; round < 150; ++round) {
    std::vector<PlaneContour> contours;
    for (int n = 0; n <= round % 3; ++n)
      contours.push_back(drawn(random, 3 + static_cast<std::size_t>(random() % 9), -6, 22));
    EXPECT_EQ(filled(contours, 16, 13), filled_one_by_one(contours, 16, 13)) << round;
  }
}

TEST(ContourFillMore, CornersOnPixelCentresCountOnce) {
  std::mt19937_64 random(102);
  for (int round = 0; round < 150; ++round) {
    PlaneContour contour = drawn(random, 7, -2, 14);
    for (Eigen::Vector2d& point : contour) point = point.array().round();
    EXPECT_EQ(crossing_count({contour}, 12) % 2, 0U) << "a closed line enters every row as often as it leaves it";
    const Pixels pixels = filled({contour}, 12, 12);
    EXPECT_LE(*std::max_element(pixels.begin(), pixels.end()), 1) << round;
  }
}

TEST(ContourFillMore, BeginAndSenseOfAContourDoNotMatter) {
  std::mt19937_64 random(103);
  for (int round = 0; round < 40; ++round) {
    PlaneContour contour = drawn(random, 9, 0, 20);
    const Pixels once = filled({contour}, 20, 20);
    const double area = contour_area(contour);
    std::rotate(contour.begin(), contour.begin() + 4, contour.end());
    EXPECT_EQ(filled({contour}, 20, 20), once);
    EXPECT_NEAR(contour_area(contour), area, 1e-9);
    std::reverse(contour.begin(), contour.end());
    EXPECT_EQ(filled({contour}, 20, 20), once);
    EXPECT_NEAR(contour_area(contour), area, 1e-9);
  }
}

TEST(ContourFillMore, AContourTwiceIsNothingAndThriceIsItself) {
  std::mt19937_64 random(104);
  const PlaneContour contour = drawn(random, 8, 0, 20);
  const Pixels once = filled({contour}, 20, 20), twice = filled({contour, contour}, 20, 20);
  EXPECT_GT(std::count(once.begin(), once.end(), 1), 0);
  EXPECT_EQ(std::count(twice.begin(), twice.end(), 0), 400);
  EXPECT_EQ(filled({contour, contour, contour}, 20, 20), once);
}

TEST(ContourFillMore, TwoContoursGiveTheirExclusiveOr) {
  std::mt19937_64 random(105);
  for (int round = 0; round < 40; ++round) {
    const PlaneContour a = drawn(random, 6, -1, 21), b = drawn(random, 5, -1, 21);
    const Pixels alone = filled({a}, 20, 20), other = filled({b}, 20, 20), both = filled({a, b}, 20, 20);
    for (std::size_t n = 0; n < both.size(); ++n) ASSERT_EQ(both[n], alone[n] ^ other[n]) << n;
    EXPECT_EQ(filled({b, a}, 20, 20), both);
  }
}

TEST(ContourFillMore, AKeyholeIsTheRingOfTwoContours) {
  const PlaneContour outer = rectangle(1.5, 1.5, 16.5, 14.5), inner = rectangle(5.5, 4.5, 10.5, 9.5);
  PlaneContour keyhole = outer;
  keyhole.push_back(outer[0]);
  for (const std::size_t n : {0U, 3U, 2U, 1U, 0U}) keyhole.push_back(inner[n]);
  const Pixels ring = filled({outer, inner}, 18, 16);
  EXPECT_EQ(filled({keyhole}, 18, 16), ring);
  EXPECT_EQ(std::count(ring.begin(), ring.end(), 1), 15 * 13 - 5 * 5);
}

TEST(ContourFillMore, RectanglesBetweenCentresHaveTheirPixels) {
  for (int x = 0; x < 5; ++x)
    for (int y = 0; y < 5; ++y) {
      const Pixels pixels = filled({rectangle(x - 0.5, y - 0.5, 7.5, 8.5)}, 12, 12);
      EXPECT_EQ(std::count(pixels.begin(), pixels.end(), 1), (8 - x) * (9 - y));
      EXPECT_EQ(static_cast<double>((8 - x) * (9 - y)), contour_area(rectangle(x - 0.5, y - 0.5, 7.5, 8.5)));
    }
}

TEST(ContourFillMore, TilesOfOneBorderNeitherOverlapNorGap) {
  for (const double border : {4.0, 4.25, 4.5, 5.0}) {
    const Pixels left = filled({rectangle(-1, -1, border, 11)}, 10, 10);
    const Pixels right = filled({rectangle(border, -1, 11, 11)}, 10, 10);
    for (std::size_t n = 0; n < left.size(); ++n) EXPECT_EQ(left[n] + right[n], 1) << border << " " << n;
    const Pixels below = filled({rectangle(-1, -1, 11, border)}, 10, 10);
    const Pixels above = filled({rectangle(-1, border, 11, 11)}, 10, 10);
    for (std::size_t n = 0; n < below.size(); ++n) EXPECT_EQ(below[n] + above[n], 1) << border << " " << n;
  }
}

TEST(ContourFillMore, WholePixelMovesCarryThePixelsAlong) {
  std::mt19937_64 random(106);
  PlaneContour contour = drawn(random, 9, 2, 12);
  for (Eigen::Vector2d& point : contour) point = (64 * point).array().round() / 64;  // moves are then exact
  const Pixels before = filled({contour}, 24, 24);
  for (Eigen::Vector2d& point : contour) point += Eigen::Vector2d(7, 9);
  const Pixels after = filled({contour}, 24, 24);
  for (int row = 0; row < 15; ++row)
    for (int column = 0; column < 17; ++column)
      EXPECT_EQ(before[static_cast<std::size_t>(row * 24 + column)],
                after[static_cast<std::size_t>((row + 9) * 24 + column + 7)]);
}

TEST(ContourFillMore, WhatLiesOutsideTheGridIsCutOff) {
  EXPECT_EQ(filled({rectangle(-1e6, -1e6, 1e6, 1e6)}, 6, 4), Pixels(24, 1));
  EXPECT_EQ(filled({rectangle(6.5, 0, 20, 4)}, 6, 4), Pixels(24, 0));
  EXPECT_EQ(filled({rectangle(0, -9, 6, -1)}, 6, 4), Pixels(24, 0));
  EXPECT_EQ(filled({}, 6, 4), Pixels(24, 0));
  EXPECT_EQ(crossing_count({rectangle(0, -9, 6, -1)}, 4), 0U);
  EXPECT_EQ(crossing_count({rectangle(-1e6, -1e6, 1e6, 1e6)}, 4), 8U) << "two upright edges through four rows";
}

TEST(ContourFillMore, CrossingsCountAllEdgesInEveryRow) {
  std::mt19937_64 random(107);
  for (int round = 0; round < 30; ++round) {
    const PlaneContour contour = drawn(random, 10, -5, 25);
    std::uint64_t expected = 0;
    for (int row = 0; row < 20; ++row) expected += static_cast<std::uint64_t>(crossings_left_of(contour, 1e9, row));
    EXPECT_EQ(crossing_count({contour}, 20), expected);
  }
}

TEST(ContourFillMore, AreasOfRegularPolygonsFollowTheFormula) {
  for (int corners = 3; corners < 40; ++corners) {
    PlaneContour contour;
    for (int n = 0; n < corners; ++n) {
      const double turn = 2 * std::numbers::pi * n / corners;
      contour.emplace_back(100 + 3 * std::cos(turn), -50 + 3 * std::sin(turn));
    }
    EXPECT_NEAR(contour_area(contour), 4.5 * corners * std::sin(2 * std::numbers::pi / corners), 1e-9);
  }
  EXPECT_EQ(contour_area({{0, 0}, {4, 4}, {9, 9}}), 0);
}

TEST(EvenPlanesMore, EverySubsetOfAnEvenPileIsFoundAgain) {
  std::mt19937_64 random(108);
  for (int round = 0; round < 60; ++round) {
    const double first = static_cast<double>(random() % 1000) - 500.5,
                 step = 0.5 + static_cast<double>(random() % 9) / 3;
    std::vector<int> places{0, 1, 2, 30};
    for (int n = 3; n < 30; ++n)
      if (random() % 2 == 0) places.push_back(n);
    std::shuffle(places.begin(), places.end(), random);
    std::vector<double> heights;
    for (const int place : places) heights.push_back(first + step * place);
    const EvenPlanes planes = even_planes(heights, "frames", "f");
    EXPECT_EQ(planes.slice, places);
    EXPECT_EQ(planes.count, 31);
    EXPECT_NEAR(planes.step, step, 1e-9);
    EXPECT_NEAR(planes.first, first, 1e-9);
  }
}

TEST(EvenPlanesMore, RefusalsNameTheFileAndWhatIsUneven) {
  const auto refusal = [](const std::vector<double>& heights, const char* what) {
    return message_of<InputError>([&] { even_planes(heights, what, "rt.dcm"); });
  };
  const std::string uneven = refusal({0, 3, 6, 10}, "contours");
  EXPECT_CONTAINS(uneven, "rt.dcm: its contours are not evenly spaced");
  EXPECT_CONTAINS(uneven, "mm from the first where slices are");
  EXPECT_CONTAINS(refusal({0, 1, 50000}, "frames"), "rt.dcm: its frames span more than 20000 slices");
}

Structure ring_of(const Eigen::Matrix3d& turn, const std::vector<double>& heights, double radius) {
  Structure structure{1, "ring", {}, 0};
  for (const double height : heights) {
    Contour contour;
    for (int n = 0; n < 24; ++n) {
      const double angle = 2 * std::numbers::pi * n / 24;
      contour.push_back(turn * Eigen::Vector3d(radius * std::cos(angle), radius * std::sin(angle), height));
    }
    structure.closed.push_back(contour);
  }
  return structure;
}

TEST(ContourGridMore, OwnGridsOfTurnedContoursHoldThemInWholeSlices) {
  std::mt19937_64 random(109);
  std::normal_distribution<double> drawn_part;
  for (int round = 0; round < 20; ++round) {
    Eigen::Vector4d parts;
    for (double& part : parts) part = drawn_part(random);
    const Eigen::Matrix3d turn = Eigen::Quaterniond(parts).normalized().toRotationMatrix();
    const Structure structure = ring_of(turn, {-6, -3, 0, 3, 9}, 40);
    const ContourGrid grid = own_contour_grid({structure}, "f");
    EXPECT_EQ(grid.size[2], 8) << "one empty slice at either end";
    EXPECT_NEAR(grid.step_mm(2), 3, 1e-6);
    EXPECT_NEAR(grid.step_mm(0), grid.step_mm(1), 1e-12) << "square pixels";
    EXPECT_LE(grid.step_mm(0), 1 + 1e-12);
    for (const Contour& contour : structure.closed)
      for (const Eigen::Vector3d& point : contour) {
        const Eigen::Vector3d at = grid.index_of(point);
        EXPECT_NEAR(at.z(), std::round(at.z()), kSamePlaneSlices);
        for (int axis = 0; axis < 3; ++axis)
          EXPECT_TRUE(at[axis] > -0.01 && at[axis] < grid.size[static_cast<std::size_t>(axis)] - 0.99);
      }
  }
}

TEST(ContourGridMore, FilledCirclesHaveTheirArea) {
  const Structure rings = ring_of(Eigen::Matrix3d::Identity(), {0, 2}, 30);
  const ContourGrid grid = own_contour_grid({rings}, "f");
  PlaneContour contour;
  for (const Eigen::Vector3d& point : rings.closed[0]) contour.push_back(grid.index_of(point).head<2>());
  const Pixels pixels = filled({contour}, grid.size[0], grid.size[1]);
  const double counted =
      static_cast<double>(std::count(pixels.begin(), pixels.end(), 1)) * grid.step_mm(0) * grid.step_mm(1);
  EXPECT_NEAR(counted, 12 * 900 * std::sin(std::numbers::pi / 12), 40);
}

TEST(ContourGridMore, IndexAndPlaceAreInversesWithLpsTurnedToRas) {
  ContourGrid grid;
  grid.size = {4, 5, 6};
  grid.index_to_ras_mm = Eigen::Translation3d(7, -8, 9) *
                         Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()) * Eigen::Scaling(2.0, 3.0, 0.5);
  std::size_t next = 0;
  for (int k = 0; k < 6; ++k)
    for (int j = 0; j < 5; ++j)
      for (int i = 0; i < 4; ++i) {
        const Eigen::Vector3d ras = grid.index_to_ras_mm * Eigen::Vector3d(i, j, k);
        EXPECT_LT((grid.index_of({-ras.x(), -ras.y(), ras.z()}) - Eigen::Vector3d(i, j, k)).norm(), 1e-12);
        EXPECT_EQ(grid.offset(i, j, k), next++);
      }
  EXPECT_NEAR(grid.step_mm(0), 2, 1e-12);
  EXPECT_NEAR(grid.step_mm(2), 0.5, 1e-12);
}

/// Whatever overlaps, every segment's voxels come back from its layer, and nothing else does.
TEST(SegmentLayersMore, RandomSegmentsComeBackVoxelByVoxel) {
  std::mt19937_64 random(110);
  const std::array<int, 3> size{4, 3, 5};
  for (int round = 0; round < 30; ++round) {
    SegmentLayers layers(size, Eigen::Affine3d::Identity(), "f");
    std::vector<SegmentMask> masks;
    for (int number = 1; number <= 6; ++number) {
      SegmentMask mask(size);
      for (std::size_t n = 0; n < 60; ++n)
        if (random() % 6 == 0) mask.voxels[n] = true, mask.mark_slice(static_cast<int>(n / 12));
      mask.voxels[static_cast<std::size_t>(number)] = true, mask.mark_slice(0);
      layers.add({0, number, "s" + std::to_string(number)}, mask);
      masks.push_back(mask);
    }
    const LabelMap map = layers.take();
    ASSERT_EQ(map.segments.size(), 6U);
    EXPECT_LE(map.layers.size(), 6U);
    for (const Segment& segment : map.segments) {
      EXPECT_EQ(segment.name, "s" + std::to_string(segment.number));
      for (std::size_t n = 0; n < 60; ++n)
        ASSERT_EQ(map.layers[segment.layer].labels[n] == segment.number,
                  masks[static_cast<std::size_t>(segment.number - 1)].voxels[n]);
    }
  }
}

}  // namespace
}  // namespace trocar::test::contours_more_test
