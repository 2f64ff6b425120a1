// Cutting an organ that gives way: surface, cells and what holds them.
#include <cmath>
#include <map>
#include <random>

#include <gtest/gtest.h>

#include "haptics/input_error.h"
#include "tests/support/repeats.h"
#include "tests/tissue/solid/soft_organ_rig.h"
#include "tests/tissue/support/manifold.h"

namespace trocar {
namespace {

using test::ellipsoid;
using test::expect_manifold;
using test::from_above;

struct Block {
  SurfacePtr rest;
  TissueSolid material;
  SoftOrganOptions options;

  Block() {
    rest = ellipsoid({0.06, 0.05, 0.035}, 48);
    material.residual_strain = 0.06;
  }
  SoftOrgan organ() const {
    return SoftOrgan(build_lattice(*rest, {.cell_m = options.solid.edge_m}).lattice, rest, material, options);
  }
};

/// A straight cut on top, along x.
Blade top_cut(double length, double depth, double x = 0, double y = 0) {
  const double top = 0.035 * std::sqrt(1 - std::pow(x / 0.06, 2) - std::pow(y / 0.05, 2));
  return track_blade({x - length / 2, y, top}, {x + length / 2, y, top}, -Vec3::UnitZ(), depth, 0.01);
}

/// How far the lips of the last cut have gone apart at most, across, beyond what they stood apart at first.
double opened(const SoftOrgan& organ, const OrganCut& cut, const SurfacePtr& at_first) {
  double most = 0;
  for (std::size_t v = std::size_t(cut.first_vertex) + 1; v + 3 < at_first->vertices.size(); v += 3) {
    const auto apart = [&](const SurfacePtr& s) { return (s->vertices[v] - s->vertices[v + 1]).norm(); };
    most = std::max(most, apart(organ.surface()) - apart(at_first));
  }
  return most;
}

TEST(OrganCut, OpensTheSurfaceAndKeepsItClosed) {
  SoftOrgan organ = Block().organ();
  const double volume = organ.surface()->volume_m3();
  const OrganCut cut = organ.cut(top_cut(0.020, 0.008));
  ASSERT_EQ(cut.refusal, CutRefusal::kNone);
  EXPECT_NEAR(cut.length_m, 0.020, 0.003);
  EXPECT_NEAR(cut.depth_m, 0.0088, 0.001);
  EXPECT_EQ(organ.topology(), 1U);
  expect_manifold(*organ.surface());
  // The groove takes away no more than its own wedge.
  EXPECT_LT(organ.surface()->volume_m3(), volume);
  EXPECT_GT(organ.surface()->volume_m3(), volume - cut.area_m2 * 0.002);
}

TEST(OrganCut, KeepsTheMassAndSharesTheCells) {
  SoftOrgan organ = Block().organ();
  const double mass = organ.solid().mass_kg();
  const std::size_t cells = organ.solid().cell_count(), nodes = organ.solid().node_count();
  ASSERT_EQ(organ.cut(top_cut(0.040, 0.020)).refusal, CutRefusal::kNone);
  EXPECT_NEAR(organ.solid().mass_kg(), mass, 1e-6 * mass);
  EXPECT_GT(organ.solid().cell_count(), cells);
  EXPECT_GT(organ.solid().node_count(), nodes);
}

TEST(OrganCut, OpensByTheTensionAtRest) {
  Block block;
  std::vector<double> gapes;
  for (const double strain : {0.0, 0.03, 0.06, 0.12}) {
    block.material.residual_strain = strain;
    SoftOrgan organ = block.organ();
    const OrganCut cut = organ.cut(top_cut(0.020, 0.012));
    ASSERT_EQ(cut.refusal, CutRefusal::kNone);
    const SurfacePtr before = organ.surface();
    const double energy = organ.solid().energy_j();
    for (int i = 0; i < 150; ++i) organ.step({}, nullptr);
    gapes.push_back(opened(organ, cut, before));
    if (strain > 0) {
      EXPECT_LT(organ.solid().energy_j(), energy);
    }
  }
  EXPECT_NEAR(gapes[0], 0, 1e-5);
  // A half-elliptic crack of half-length a and depth b in a half-space opens by some 4 s b / E' at most, and linearly.
  EXPECT_NEAR(gapes[2] / gapes[1], 2, 0.2);
  EXPECT_NEAR(gapes[3] / gapes[2], 2, 0.3);
  EXPECT_GT(gapes[2], 0.5e-3);
  EXPECT_LT(gapes[2], 4e-3);
  std::printf("opening of a cut of 20 mm, 12 mm deep, by tension at rest: %.2f %.2f %.2f mm\n", 1e3 * gapes[1],
              1e3 * gapes[2], 1e3 * gapes[3]);
}

TEST(OrganCut, OpensAlikeOnFinerCells) {
  const auto opening = [](double edge_m, double x) {
    Block block;
    block.options.solid.edge_m = edge_m;
    SoftOrgan organ = block.organ();
    const OrganCut cut = organ.cut(top_cut(0.020, 0.012, x, x / 2));
    EXPECT_EQ(cut.refusal, CutRefusal::kNone);
    const SurfacePtr before = organ.surface();
    for (int i = 0; i < 100; ++i) organ.step({}, nullptr);
    return opened(organ, cut, before);
  };
  // Wherever the cut lies to the cells. What is known of it is a quarter of a cell at each end and below.
  for (const double x : {0.0, 0.0025, 0.005}) {
    const double coarse = opening(0.010, x), fine = opening(0.005, x);
    std::printf("opening by cells of 10 and 5 mm: %.2f %.2f mm\n", 1e3 * coarse, 1e3 * fine);
    EXPECT_GT(coarse, 0.5 * fine);
    EXPECT_LT(coarse, 1.5 * fine);
  }
}

TEST(OrganCut, IsSofterToPullApartThanWhatIsWhole) {
  // Two places 8 mm to both sides of a line are pulled apart: with the cut between them they give way further.
  const auto apart = [](bool cut) {
    SoftOrgan organ = Block().organ();
    if (cut) {
      EXPECT_EQ(organ.cut(top_cut(0.030, 0.020)).refusal, CutRefusal::kNone);
    }
    for (int i = 0; i < 200; ++i) organ.step({}, nullptr);
    std::array<NodeShares, 2> place;
    std::array<Vec3, 2> from;
    for (int side = 0; side < 2; ++side) {
      double least = 1;
      for (std::size_t t = 0; t < organ.rest()->triangles.size(); ++t) {
        const auto& v = organ.rest()->vertices[std::size_t(organ.rest()->triangles[t][0])];
        const double d = (v - Vec3(0, side == 0 ? -0.008 : 0.008, 0.034)).norm();
        if (d < least) least = d, place[std::size_t(side)] = organ.shares_of({std::int32_t(t), {1, 0, 0}});
      }
    }
    const auto at = [&](int side) {
      Vec3 sum = Vec3::Zero();
      const NodeShares& p = place[std::size_t(side)];
      for (std::size_t i = 0; i < p.node.size(); ++i)
        sum += double(p.share[i]) * organ.solid().position()[std::size_t(p.node[i])].cast<double>();
      return sum;
    };
    const double before = (at(1) - at(0)).norm();
    for (int i = 0; i < 200; ++i) {
      std::vector<SoftSpring> pulls;
      for (int side = 0; side < 2; ++side)
        pulls.push_back({place[std::size_t(side)], Vec3::UnitY() * (side == 0 ? 1 : -1), 1, 0.05, false, 0});
      organ.step({}, nullptr, pulls);
    }
    return (at(1) - at(0)).norm() - before;
  };
  EXPECT_GT(apart(true), 1.5 * apart(false));
}

TEST(OrganCut, RefusesWhatItCannotCut) {
  SoftOrgan organ = Block().organ();
  const auto bytes = organ.surface()->vertices;
  EXPECT_EQ(organ.cut(track_blade({0.2, 0, 0}, {0.22, 0, 0}, -Vec3::UnitZ(), 0.01, 0.01)).refusal,
            CutRefusal::kNothingThere);
  CutTracingOptions blunt;
  blunt.bite_m = 0;
  EXPECT_EQ(organ.cut(top_cut(0.020, 0.0004), blunt).refusal, CutRefusal::kTooShallow);
  EXPECT_EQ(organ.topology(), 0U);
  EXPECT_TRUE(organ.surface()->vertices == bytes);
  for (const auto r : {CutRefusal::kNone, CutRefusal::kPieceOff, CutRefusal::kBesideCut})
    EXPECT_NE(refusal_words(r), "?");
}

TEST(OrganCut, AMadeUpCutIsBadInput) {
  const SurfacePtr rest = ellipsoid({0.06, 0.05, 0.035}, 12);
  SurfaceCut cut;
  EXPECT_THROW(cut_groove(*rest, cut), InputError);
  cut.begin.triangle = 0;
  cut.crossings.push_back({rest->triangles[0][2], rest->triangles[0][1], 0.5, 1, Vec3::Zero(), 0});
  EXPECT_THROW(cut_groove(*rest, cut), InputError);  // the second triangle is not there
  EXPECT_THROW(parse_cut(std::string("abc")), InputError);
}

TEST(OrganCut, TheSameBytesAgainFromItsOwn) {
  SoftOrgan organ = Block().organ();
  for (int i = 0; i < 4; ++i) {
    organ.cut(top_cut(0.020, 0.009, 0.006 * i, 0.004 * i));
    for (int k = 0; k < 10; ++k) organ.step({}, nullptr);
  }
  ASSERT_EQ(organ.cuts().size(), 4U);
  const Block block;
  CutLattice lattice(build_lattice(*block.rest, {.cell_m = 0.010}).lattice, block.rest);
  for (const std::string& bytes : organ.cuts()) {
    LatticeChange change;
    ASSERT_TRUE(lattice.cut(parse_cut(bytes), change));
  }
  EXPECT_EQ(lattice.rest()->vertices, organ.rest()->vertices);
  EXPECT_EQ(lattice.rest()->triangles, organ.rest()->triangles);
  const SurfacePtr again = EmbeddedSurface(lattice.lattice(), lattice.rest()).at(organ.solid().position());
  EXPECT_EQ(again->vertices, organ.surface()->vertices);
}

/// Cuts anywhere from anywhere, while the organ moves.
void cut_at_random(int cuts, unsigned seed) {
  SoftOrgan organ = Block().organ();
  std::mt19937 random(seed);
  const auto share = [&] { return double(random()) / double(std::mt19937::max()); };
  const double mass = organ.solid().mass_kg();
  std::map<CutRefusal, int> count;
  for (int i = 0; i < cuts; ++i) {
    const SurfacePtr now = organ.surface();
    const TriangleSurface& surface = *now;
    const auto& t = surface.triangles[std::size_t(share() * double(surface.triangles.size() - 1))];
    const Vec3 at = surface.vertices[std::size_t(t[0])];
    const Vec3 inward = -(surface.vertices[std::size_t(t[1])] - at).cross(surface.vertices[std::size_t(t[2])] - at);
    if (!(inward.norm() > 0)) continue;
    const Vec3 n = inward.normalized();
    const Vec3 along = (n.unitOrthogonal() + 0.5 * Vec3(share(), share(), share())).normalized();
    const double length = 0.004 + 0.025 * share();
    ++count[organ.cut(track_blade(at - length / 2 * along, at + length / 2 * along, n, 0.012 * share(), 0.01)).refusal];
    organ.step({}, nullptr);
    for (const Vec3f& x : organ.solid().position()) ASSERT_TRUE(x.allFinite()) << "cut " << i;
    if (i % 25 == 24) expect_manifold(*organ.surface());
  }
  expect_manifold(*organ.surface());
  EXPECT_NEAR(organ.solid().mass_kg(), mass, 1e-6 * mass);
  EXPECT_GT(count[CutRefusal::kNone], cuts / 3);
  std::printf("%d cuts made of %d, %d cells, %d triangles\n", count[CutRefusal::kNone], cuts,
              int(organ.solid().cell_count()), int(organ.surface()->triangles.size()));
  for (int i = 0; i < 300; ++i) organ.step({}, nullptr);
  // At rest again, and nowhere far from where it was.
  double fastest = 0, farthest = 0;
  for (std::size_t n = 0; n < organ.solid().node_count(); ++n) {
    fastest = std::max(fastest, double(organ.solid().velocity()[n].norm()));
    farthest = std::max(farthest, double((organ.solid().position()[n] - organ.solid().rest()[n]).norm()));
  }
  EXPECT_LT(fastest, 5e-3);
  EXPECT_LT(farthest, 0.05);
}
TEST(OrganCut, AtRandomStaysSound) { cut_at_random(test::repeats("ORGAN_CUTS", 60), 1); }

}  // namespace
}  // namespace trocar
