// Coarser levels as a preconditioner: symmetric, positive, cut where the tissue is, and worth it.
#include "tissue/solid/node_levels.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/tissue/solid/soft_blocks.h"

namespace trocar::node_levels_test {
namespace {

using test::SoftBlock;

std::vector<PlacedCell> placed(const SoftBlock& block) {
  std::vector<PlacedCell> out;
  for (const SoftCell& cell : block.cells) {
    const Vec3 at = block.nodes[std::size_t(cell.node[0])] / block.edge_m + Vec3::Constant(0.5);
    out.push_back({{int(at.x()), int(at.y()), int(at.z())}, cell.node});
  }
  return out;
}

/// All of the preconditioner, as a solve calls it.
class Preconditioner {
 public:
  Preconditioner(std::span<const PlacedCell> cells, std::size_t count) : levels_(cells, count), ones_(count, 1.0F) {
    std::vector<float> stiffness(count);
    for (std::size_t n = 0; n < count; ++n) stiffness[n] = 1 + float(n % 5);
    levels_.set_diagonals(stiffness, ones_);
  }
  NodeLevels& levels() { return levels_; }
  std::vector<NodeRow> operator()(const std::vector<NodeRow>& r) {
    std::vector<NodeRow> z(r.size()), product(r.size());
    gained_ = levels_.coarsen(r);
    levels_.advance(ones_, r, 0, ones_, z, product);
    return z;
  }
  double gained() const { return gained_; }

 private:
  NodeLevels levels_;
  std::vector<float> ones_;
  double gained_ = 0;
};

std::vector<NodeRow> random_rows(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<NodeRow> out(count);
  for (NodeRow& row : out)
    for (int c = 0; c < 3; ++c) row.at[c] = float(random()) / 2147483648.0F - 1;
  return out;
}

double dot(const std::vector<NodeRow>& a, const std::vector<NodeRow>& b) {
  double sum = 0;
  for (std::size_t n = 0; n < a.size(); ++n)
    for (int c = 0; c < 3; ++c) sum += double(a[n].at[c]) * double(b[n].at[c]);
  return sum;
}

TEST(NodeLevels, ArePositiveAndSymmetric) {
  const SoftBlock block(7, 6, 5, 0.01);
  const std::size_t count = block.nodes.size();
  Preconditioner apply(placed(block), count);
  for (unsigned seed = 0; seed < 20; ++seed) {
    if (seed == 10) {
      const std::vector<std::int32_t> node{3, 50};
      const std::vector<float> share{0.25F, 0.75F};
      apply.levels().add_spring(node, share, 30);
    }
    const std::vector<NodeRow> r = random_rows(count, 2 * seed), s = random_rows(count, 2 * seed + 1);
    const std::vector<NodeRow> of_r = apply(r);
    // What it says that the levels add, added to the nodes' own part.
    EXPECT_NEAR(dot(r, r) + apply.gained(), dot(r, of_r), 1e-5 * dot(r, of_r));
    EXPECT_GT(apply.gained(), 0);
    const double scale = std::sqrt(dot(r, of_r) * dot(s, apply(s)));
    EXPECT_NEAR(dot(s, of_r), dot(r, apply(s)), 1e-5 * scale);
  }
}

TEST(NodeLevels, DoNotReachAcrossACut) {
  // Two halves of a block whose middle nodes are doubled; then the same with one node that they still share.
  const SoftBlock block(6, 4, 4, 0.01);
  for (const bool joined : {false, true}) {
    std::vector<PlacedCell> cells = placed(block);
    std::size_t count = block.nodes.size();
    std::vector<std::int32_t> copy(count, -1);
    for (PlacedCell& cell : cells)
      for (std::int32_t& node : cell.node) {
        const bool in_cut = cell.place[0] >= 3 && std::abs(block.nodes[std::size_t(node)].x() - 0.03) < 1e-6;
        if (!in_cut || (joined && node == block.id(3, 2, 2))) continue;
        std::int32_t& second = copy[std::size_t(node)];
        if (second < 0) second = std::int32_t(count++);
        node = second;
      }
    std::vector<NodeRow> r(count);
    r[std::size_t(block.id(2, 2, 2))].at[0] = 1;
    const std::vector<NodeRow> z = Preconditioner(cells, count)(r);
    EXPECT_GT(z[std::size_t(block.id(3, 1, 2))].at[0], 0) << "this lip";
    EXPECT_EQ(z[std::size_t(copy[std::size_t(block.id(3, 1, 2))])].at[0] > 0, joined) << "the other";
  }
}

TEST(NodeLevels, KeepTheIterationsFromGrowingWithTheCells) {
  // Cells of half the edge need 1.7 times the iterations of a diagonal preconditioner.
  const auto iterations = [](int cells) {
    const SoftBlock block(2 * cells, 2 * cells, cells, 0.08 / cells);
    SoftSolidOptions options;
    options.edge_m = block.edge_m;
    SoftSolid solid = test::solid_of(block, test::elastic(5000, 0.45), options);
    for (const std::int32_t node : block.face(2, false)) solid.hold(node, 1000 * block.edge_m);
    int sum = 0;
    for (int i = 0; i < 20; ++i) {
      SoftSpring tool{{{block.id(cells, cells, cells)}, {1.0F}}, Vec3::UnitZ(), 100, 1e-3 * (i % 4)};
      solid.step({&tool, 1});
      sum += solid.iterations();
    }
    return sum;
  };
  const int coarse = iterations(8), fine = iterations(16);
  RecordProperty("coarse", coarse);
  RecordProperty("fine", fine);
  EXPECT_LT(fine, 1.4 * coarse);
}

}  // namespace
}  // namespace trocar::node_levels_test
