// Segments that overlap, laid into one layer: who keeps a voxel, what is told, and what is refused.
#include "tissue/imaging/labels/one_layer.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "haptics/input_error.h"

namespace trocar::one_layer_test {
namespace {

/// A row of ten voxels.
LabelVolume row(const std::vector<std::uint16_t>& labels) {
  return {.size = {10, 1, 1}, .labels = labels, .index_to_ras_mm = Eigen::Affine3d::Identity(), .notes = {}};
}

/// A body of ten voxels, in it a liver of six, in that a tumour of two; a bone of one that nobody asks for.
LabelMap nested() {
  LabelMap map;
  map.layers = {row({1, 1, 1, 1, 1, 1, 1, 1, 1, 1}), row({0, 2, 2, 2, 2, 2, 2, 0, 0, 4}),
                row({0, 0, 0, 3, 3, 0, 0, 0, 0, 0})};
  map.segments = {{0, 1, "body"}, {1, 2, "liver"}, {2, 3, "tumour"}, {1, 4, "bone"}};
  return map;
}

std::vector<Segment> first(const LabelMap& map, std::ptrdiff_t count) {
  return {map.segments.begin(), map.segments.begin() + count};
}

bool told(const LabelMap& map, const std::string& text) {
  return std::any_of(map.notes.begin(), map.notes.end(),
                     [&](const std::string& note) { return note.find(text) != std::string::npos; });
}

TEST(OneLayer, TheOneWithFewerVoxelsKeepsThePlaceInAnyOrder) {
  const LabelMap map = nested();
  std::vector<Segment> wanted = first(map, 3);
  do {
    const auto flat = in_one_layer(map, wanted);
    ASSERT_TRUE(flat);
    ASSERT_EQ(flat->layers.size(), 1u);
    EXPECT_EQ(flat->layers[0].labels, (std::vector<std::uint16_t>{1, 2, 2, 3, 3, 2, 2, 1, 1, 1}));
    EXPECT_TRUE(told(*flat, "\"body\": 60 % of it lies in \"liver\" too"));
    EXPECT_TRUE(told(*flat, "\"liver\": 33 % of it lies in \"tumour\" too"));
    EXPECT_FALSE(told(*flat, "\"tumour\":"));
    EXPECT_EQ(flat->segments.size(), 3u) << "the bone has no voxel left";
  } while (std::next_permutation(wanted.begin(), wanted.end(),
                                 [](const Segment& a, const Segment& b) { return a.number < b.number; }));
}

TEST(OneLayer, WhatNobodyAskedForFillsWhatIsLeftOver) {
  LabelMap map = nested();
  const std::vector<Segment> wanted{map.segments[1], map.segments[2]};
  const auto flat = in_one_layer(map, wanted);
  ASSERT_TRUE(flat);
  EXPECT_EQ(flat->layers[0].labels, (std::vector<std::uint16_t>{1, 2, 2, 3, 3, 2, 2, 1, 1, 1}));
  EXPECT_FALSE(told(*flat, "body"));
}

TEST(OneLayer, OfOneLayerOrTwoOfOneNumberNothingIsMade) {
  LabelMap map = nested();
  EXPECT_FALSE(in_one_layer(map, {map.segments[1], map.segments[3]})) << "they lie in one layer";
  map.segments[2].number = 2;
  std::replace(map.layers[2].labels.begin(), map.layers[2].labels.end(), std::uint16_t{3}, std::uint16_t{2});
  EXPECT_FALSE(in_one_layer(map, {map.segments[1], map.segments[2]})) << "2 in two layers is no one label";
  map = nested();
  map.layers[2].index_to_ras_mm.translation().x() = 0.5;
  EXPECT_FALSE(in_one_layer(map, {map.segments[1], map.segments[2]})) << "their grids differ";
}

TEST(OneLayer, OneThatIsAllInOthersIsRefusedWithTheirNames) {
  LabelMap map = nested();
  map.layers.push_back(map.layers[1]);
  std::replace(map.layers[3].labels.begin(), map.layers[3].labels.end(), std::uint16_t{2}, std::uint16_t{5});
  map.segments.push_back({3, 5, "Liver again"});
  try {
    in_one_layer(map, {map.segments[1], map.segments[4]});
    FAIL() << "one of two that are the same has nothing left";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("\"liver\": 100 % of it is \"Liver again\" too"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace trocar::one_layer_test
