// Which surface holds a place, also on the lines where triangles meet.
#include "tissue/solid/organ_regions.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/tissue/support/shapes.h"

namespace trocar::organ_regions_test {
namespace {

TEST(OrganRegions, LinesThroughVerticesAndEdgesCountOnce) {
  const TriangleSurface box = test::box(Vec3::Zero(), Vec3(4, 4, 4));  // diagonals run through whole numbers
  const OrganRegions regions({&box});
  for (int i = -1; i <= 5; ++i)
    for (int j = -1; j <= 5; ++j)
      for (int k = -1; k <= 5; ++k) {
        const bool inside = std::min({i, j, k}) > 0 && std::max({i, j, k}) < 4;
        const bool outside = std::min({i, j, k}) < 0 || std::max({i, j, k}) > 4;
        if (!inside && !outside) continue;  // on the surface
        EXPECT_EQ(regions.at(Vec3(i, j, k)), inside ? 1 : 0) << i << ' ' << j << ' ' << k;
      }
}

TEST(OrganRegions, ABallInABallIsTheInnerOnesAndVolumesSaySo) {
  const TriangleSurface large = test::sphere(Vec3::Zero(), 0.03, 4), small = test::sphere(Vec3(0.01, 0, 0), 0.01, 4);
  const OrganRegions regions({&large, &small});
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> along(-0.035, 0.035);
  for (int n = 0; n < 20000; ++n) {
    const Vec3 place(along(generator), along(generator), along(generator));
    const double inner = (place - Vec3(0.01, 0, 0)).norm() / 0.01, outer = place.norm() / 0.03;
    if (std::abs(inner - 1) < 0.01 || std::abs(outer - 1) < 0.01) continue;  // chords
    EXPECT_EQ(regions.at(place), inner < 1 ? 2 : outer < 1 ? 1 : 0) << place.transpose();
  }
  const std::vector<double> volumes = regions.volumes();
  EXPECT_NEAR(volumes[1], small.volume_m3(), 1e-15);
  EXPECT_NEAR(volumes[0], large.volume_m3() - small.volume_m3(), 0.02 * small.volume_m3());
}

}  // namespace
}  // namespace trocar::organ_regions_test
