// Pieces of a mask drawn by hand: ties, corners, edges of the block, cavities in each other.
#include "tissue/imaging/labels/mask_pieces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "haptics/input_error.h"

namespace trocar::mask_pieces_more_test {
namespace {

using Mask = std::vector<std::uint8_t>;
using Sizes = std::vector<std::size_t>;

/// '#' inside, anything else outside; rows of i, then j, then k.
Mask drawn(const std::string& rows) {
  Mask mask;
  for (const char c : rows)
    if (c == '#' || c == '.') mask.push_back(c == '#' ? 1 : 0);
  return mask;
}

TEST(LargestPiece, OfTwoEqualOnesTheFirstIsKept) {
  const RegionShape shape{{5, 3, 1}, {1, 1, 1}};
  Mask mask = drawn("##.## ..... #....");
  EXPECT_EQ(keep_largest(mask, shape), (Sizes{2, 2, 1}));
  EXPECT_EQ(mask, drawn("##... ..... ....."));
}

TEST(LargestPiece, ALaterOneOfMoreVoxelsWins) {
  const RegionShape shape{{5, 3, 1}, {1, 1, 1}};
  Mask mask = drawn("##.## ....# .....");
  EXPECT_EQ(keep_largest(mask, shape), (Sizes{3, 2}));
  EXPECT_EQ(mask, drawn("...## ....# ....."));
}

TEST(LargestPiece, CornersAndEdgesDoNotJoin) {
  const RegionShape shape{{2, 2, 2}, {1, 1, 1}};
  Mask mask = drawn("#. .# .# #.");
  EXPECT_EQ(keep_largest(mask, shape), (Sizes{1, 1, 1, 1}));
  EXPECT_EQ(mask, drawn("#. .. .. .."));
}

TEST(LargestPiece, TheEndOfARowIsNoNeighbourOfTheNext) {
  const RegionShape rows{{3, 3, 1}, {1, 1, 1}}, slices{{3, 1, 3}, {1, 1, 1}};
  for (const RegionShape& shape : {rows, slices}) {
    Mask mask = drawn("..# #.. ...");
    EXPECT_EQ(keep_largest(mask, shape), (Sizes{1, 1}));
  }
}

TEST(LargestPiece, AWholeBlockIsOnePieceAndALineToo) {
  Mask block(4 * 3 * 2, 1);
  EXPECT_EQ(keep_largest(block, {{4, 3, 2}, {1, 1, 1}}), Sizes{24});
  EXPECT_EQ(block, Mask(24, 1));
  Mask line = drawn("###.####");
  EXPECT_EQ(keep_largest(line, {{1, 1, 8}, {1, 1, 1}}), (Sizes{4, 3}));
  EXPECT_EQ(line, drawn("....####"));
}

/// A cube shell in a block of 9, from `from` to `to` on each axis.
void add_shell(Mask& mask, int from, int to) {
  for (int k = from; k <= to; ++k)
    for (int j = from; j <= to; ++j)
      for (int i = from; i <= to; ++i)
        if (i == from || i == to || j == from || j == to || k == from || k == to)
          mask[static_cast<std::size_t>(i + 9 * (j + 9 * k))] = 1;
}

const RegionShape kNine{{9, 9, 9}, {1, 1, 1}};

TEST(Holes, AShellWithinAShellBecomesOneSolid) {
  Mask mask(9 * 9 * 9, 0);
  add_shell(mask, 1, 7);
  add_shell(mask, 3, 5);
  const auto shells = static_cast<std::size_t>(std::count(mask.begin(), mask.end(), 1));
  EXPECT_EQ(fill_holes(mask, kNine), 7U * 7 * 7 - shells);
  EXPECT_EQ(std::count(mask.begin(), mask.end(), 1), 7 * 7 * 7);
  EXPECT_EQ(fill_holes(mask, kNine), 0U) << "nothing is left to fill";
}

TEST(Holes, OneOpenFaceLetsTheBackgroundInAndAnOpenCornerDoesNot) {
  Mask opened(9 * 9 * 9, 0);
  add_shell(opened, 2, 6);
  Mask cornered = opened;
  opened[4 + 9 * (4 + 9 * 6)] = 0;
  const Mask before = opened;
  EXPECT_EQ(fill_holes(opened, kNine), 0U);
  EXPECT_EQ(opened, before);
  cornered[6 + 9 * (6 + 9 * 6)] = 0;  // its inside meets it over a corner only
  EXPECT_EQ(fill_holes(cornered, kNine), 27U);
  EXPECT_EQ(cornered[6 + 9 * (6 + 9 * 6)], 0) << "open to the outside";
}

TEST(Holes, AShellThatIsTheBlocksOwnBorderIsFilledAndAFlatRingIsNot) {
  Mask border(9 * 9 * 9, 0);
  add_shell(border, 0, 8);
  EXPECT_EQ(fill_holes(border, kNine), 7U * 7 * 7);
  Mask ring = drawn("### #.# ###");
  EXPECT_EQ(fill_holes(ring, {{3, 3, 1}, {1, 1, 1}}), 0U) << "one slice: every voxel is at the border";
  Mask empty(27, 0), full(27, 1);
  EXPECT_EQ(fill_holes(empty, {{3, 3, 3}, {1, 1, 1}}), 0U);
  EXPECT_EQ(fill_holes(full, {{3, 3, 3}, {1, 1, 1}}), 0U);
  EXPECT_EQ(empty, Mask(27, 0));
  EXPECT_EQ(full, Mask(27, 1));
}

TEST(Holes, FillingMayBeStopped) {
  Mask mask(128 * 128 * 80, 0);
  const Progress stop = [](std::string_view stage, double) {
    EXPECT_EQ(stage, "filling holes");
    throw EnvironmentError("stopped");
  };
  EXPECT_THROW(fill_holes(mask, {{128, 128, 80}, {1, 1, 1}}, stop), EnvironmentError);
}

TEST(TunnelsMore, AreCountedWhateverTheAxisAndWhereverTheyEnd) {
  EXPECT_EQ(tunnels_of(drawn("#"), {{1, 1, 1}, {1, 1, 1}}), 0);
  EXPECT_EQ(tunnels_of(drawn("### #.# ###"), {{3, 3, 1}, {1, 1, 1}}), 1);
  EXPECT_EQ(tunnels_of(drawn("### #.# ###"), {{1, 3, 3}, {1, 1, 1}}), 1);
  EXPECT_EQ(tunnels_of(drawn("### #.# ###"), {{3, 1, 3}, {1, 1, 1}}), 1);
  EXPECT_EQ(tunnels_of(drawn("### #.. ###"), {{3, 3, 1}, {1, 1, 1}}), 0) << "an open ring";
  EXPECT_EQ(tunnels_of(drawn("##### #.#.# #####"), {{5, 3, 1}, {1, 1, 1}}), 2);
}

}  // namespace
}  // namespace trocar::mask_pieces_more_test
