// Holes, wraps, and everything that turns triangles into one closed surface or refuses them.
#include "tissue/mesh/surface/rescue.h"

#include <gtest/gtest.h>

#include <numbers>

#include "haptics/input_error.h"
#include "tests/tissue/mesh/files/scene_writers.h"
#include "tests/tissue/support/temporary_folder.h"
#include "tissue/mesh/files/closing.h"
#include "tissue/mesh/surface/topology.h"

namespace trocar::rescue_test {
namespace {

using namespace test;

ImportedSurface closed(const TriangleSurface& soup, const SurfaceImportOptions& options = {},
                       const std::string& organ = "") {
  ImportedSurface result;
  close_surface(soup, options, organ, "a.stl", result, {});
  return result;
}

std::string refusal(const TriangleSurface& soup, const SurfaceImportOptions& options = {}) {
  return message_of<InputError>([&] { closed(soup, options); });
}

SurfaceImportOptions filling(double widest_mm) {
  SurfaceImportOptions options;
  options.fill_holes_mm = widest_mm;
  return options;
}

SurfaceImportOptions wrapping(double alpha_mm, double offset_mm) {
  SurfaceImportOptions options;
  options.wrap = WrapSettings{alpha_mm, offset_mm};
  return options;
}

std::string all(const std::vector<std::string>& sentences) {
  std::string text;
  for (const std::string& sentence : sentences) text += sentence + "\n";
  return text;
}

/// A ball without its cap above a height; the hole is a circle.
TriangleSurface open_ball(double radius, double height, int levels = 4) {
  TriangleSurface surface = sphere(Vec3(0.02, 0, 0), radius, levels);
  std::erase_if(surface.triangles, [&](const auto& t) {
    double z = 0;
    for (const std::int32_t vertex : t) z += surface.vertices[static_cast<std::size_t>(vertex)].z() / 3;
    return z > height;
  });
  return surface;
}

void expect_closed(const TriangleSurface& surface) {
  const SurfaceTopology facts = analyse_topology(surface);
  EXPECT_TRUE(facts.closed() && facts.manifold());
  EXPECT_EQ(facts.components, 1U);
}

TEST(Holes, OpenSurfacesAreRefusedUnlessAsked) {
  const std::string message = refusal(open_ball(0.05, 0.045));
  EXPECT_CONTAINS(message, "a.stl: the surface is open:");
  EXPECT_CONTAINS(message, "holes are not filled unasked");
  EXPECT_CONTAINS(message, "--wrap or --fill-holes");
}

TEST(Holes, AFilledCapIsSmoothAndReported) {
  const TriangleSurface whole = sphere(Vec3(0.02, 0, 0), 0.05, 4), open = open_ball(0.05, 0.045);
  const ImportedSurface filled = closed(open, filling(80));
  expect_closed(filled.surface);
  // A flat lid would lose 0.5 % of the ball; the cap that continues the curvature loses less.
  const double cap = std::numbers::pi * 0.005 * 0.005 * (3 * 0.05 - 0.005) / 3;
  EXPECT_GT(filled.surface.volume_m3(), whole.volume_m3() - 0.5 * cap);
  EXPECT_LT(filled.surface.volume_m3(), whole.volume_m3() * 1.001);
  EXPECT_LT(distance_from_to(filled.surface, whole).max_m, 0.0015);
  EXPECT_CONTAINS(all(filled.repairs), "filled a hole of ");
  EXPECT_CONTAINS(all(filled.repairs), "edges that spans ");
}

TEST(Holes, EachHoleIsMeasured) {
  TriangleSurface two = sphere(Vec3::Zero(), 0.05, 4);
  std::erase_if(two.triangles, [&](const auto& t) {
    const double z = two.vertices[static_cast<std::size_t>(t[0])].z();
    return z > 0.048 || z < -0.04;
  });
  std::vector<FilledHole> holes;
  const TriangleSurface filled = holes_filled(two, 0.2, holes, "f");
  ASSERT_EQ(holes.size(), 2U);
  for (const FilledHole& hole : holes) {
    EXPECT_GT(hole.edges, 8U);
    EXPECT_GT(hole.area_m2, 0.3 * hole.span_m * hole.span_m / 2);  // a disc in the square of its box has 0.79 of it
    EXPECT_LT(hole.area_m2, 1.3 * hole.span_m * hole.span_m / 2);
  }
  EXPECT_TRUE(analyse_topology(filled).closed());
}

TEST(Holes, TooWideOnesAreRefusedWithTheirSpan) {
  const std::string message = refusal(open_ball(0.05, 0), filling(10));
  EXPECT_CONTAINS(message, "1 of 1 holes are wider than the 10.0");
  EXPECT_CONTAINS(message, "the widest spans 14");  // the diagonal of a square of 0.1 m
  EXPECT_CONTAINS(message, "edges)");
}

TEST(Holes, MixedWindingRoundAHoleIsNoHindrance) {
  TriangleSurface open = open_ball(0.05, 0.045);
  for (std::size_t t = 0; t < open.triangles.size(); t += 3) std::swap(open.triangles[t][1], open.triangles[t][2]);
  const ImportedSurface filled = closed(open, filling(80));
  expect_closed(filled.surface);
  EXPECT_GT(filled.surface.volume_m3(), 0);
}

TEST(Holes, SurfacesOfTriplesAreNotFilled) {
  TriangleSurface fin = open_ball(0.05, 0.045);
  const auto& t = fin.triangles[0];
  fin.vertices.emplace_back(0.2, 0.2, 0.2);
  fin.triangles.push_back({t[0], t[1], static_cast<std::int32_t>(fin.vertices.size() - 1)});
  const std::string message = refusal(fin, filling(80));
  EXPECT_CONTAINS(message, "1 edges of more than two triangles");
  EXPECT_CONTAINS(message, "--wrap");
}

TEST(Wrap, AClosedBallKeepsItsVolume) {
  const TriangleSurface ball = sphere(Vec3(0.02, 0, 0), 0.04, 4);
  WrapFacts facts;
  const TriangleSurface wrapped = shrink_wrapped(ball, 0.004, 0.0004, facts, "f");
  expect_closed(wrapped);
  // Laid 0.4 mm outside: 3 % more volume. Taken back, what is left is the coarseness of the wrap.
  EXPECT_NEAR(facts.volume_outside_m3 / sphere_volume(0.0404), 1, 0.012);
  EXPECT_NEAR(facts.volume_m3 / ball.volume_m3(), 1, 0.006);
  EXPECT_EQ(facts.volume_m3, wrapped.volume_m3());
  EXPECT_GE(facts.pulled_back, 0.9);
  EXPECT_LT(facts.to_input.max_m, 0.0003);
  EXPECT_LT(facts.from_input.max_m, 0.0003);
  EXPECT_LT(distance_from_to(wrapped, ball).max_m, 0.0003);  // measured by the other code too
}

TEST(Wrap, TheSameSurfaceGivesTheSameWrap) {
  const TriangleSurface ball = open_ball(0.04, 0.038, 3);
  WrapFacts facts;
  const TriangleSurface first = shrink_wrapped(ball, 0.008, 0.001, facts, "f"),
                        second = shrink_wrapped(ball, 0.008, 0.001, facts, "f");
  EXPECT_EQ(first.vertices, second.vertices);
  EXPECT_EQ(first.triangles, second.triangles);
}

// CGAL asks nobody while it wraps: the wrap runs in a process of its own, and whoever waits for it may stop it.
TEST(Wrap, ProgressMayStopItWhileItRuns) {
  int asked = 0;
  const Progress stop = [&](std::string_view stage, double) {
    if (stage == "wrapping" && ++asked == 3) throw EnvironmentError("stopped");
  };
  ImportedSurface result;
  EXPECT_THROW(close_surface(sphere(Vec3::Zero(), 0.05, 5), wrapping(1, 0.1), "", "a.stl", result, stop),
               EnvironmentError);
  EXPECT_EQ(asked, 3);
}

TEST(Wrap, HolesAndFinsAreRescued) {
  TriangleSurface broken = open_ball(0.05, 0.0495);
  const auto& t = broken.triangles[40];
  broken.vertices.push_back(broken.vertices[static_cast<std::size_t>(t[0])] * 0.8);
  broken.triangles.push_back({t[0], t[1], static_cast<std::int32_t>(broken.vertices.size() - 1)});
  EXPECT_CONTAINS(refusal(broken), "--wrap");
  const ImportedSurface wrapped = closed(broken, wrapping(12, 1));
  expect_closed(wrapped.surface);
  EXPECT_EQ(wrapped.source_self_intersections, 0U);
  EXPECT_NEAR(wrapped.surface.volume_m3() / sphere_volume(0.05), 1, 0.06);
  EXPECT_CONTAINS(all(wrapped.repairs), "wrapped with alpha 12.00 mm, laid 1.00 mm outside");
  EXPECT_CONTAINS(all(wrapped.repairs), "pulled back by");
  EXPECT_CONTAINS(all(wrapped.repairs), "the source lies");
}

TEST(Wrap, SettingsThatWouldNeverEndAreRefused) {
  const TriangleSurface ball = sphere(Vec3::Zero(), 0.1, 3);
  EXPECT_CONTAINS(refusal(ball, wrapping(0.1, 0.01)),
                  "is too fine: at least 1.3856");  // its diagonal of 346.4 mm by 250
  EXPECT_CONTAINS(refusal(ball, wrapping(5, 0.001)), "between a hundredth of alpha and alpha");
  EXPECT_CONTAINS(refusal(ball, wrapping(5, 50)), "between a hundredth of alpha and alpha");
}

TEST(Closing, TangledSurfacesSayWhatIsWrong) {
  // Two boxes that share an edge, and two that share a corner.
  const TriangleSurface edge =
      joined(box(Vec3(0, 0, 0), Vec3(0.1, 0.1, 0.1)), box(Vec3(0.1, 0.1, 0), Vec3(0.2, 0.2, 0.1)));
  EXPECT_CONTAINS(refusal(edge), "1 edges of more than two triangles: repair it where it was made, or ask for --wrap");
  const TriangleSurface touch =
      joined(box(Vec3(0, 0, 0), Vec3(0.1, 0.1, 0.1)), box(Vec3(0.1, 0.1, 0.1), Vec3(0.2, 0.2, 0.2)));
  EXPECT_CONTAINS(refusal(touch), "1 vertices where parts touch");
}

TEST(Closing, SpecksGoWithTheirCountAndVolume) {
  TriangleSurface many = sphere(Vec3::Zero(), 0.05, 3);
  for (int n = 0; n < 3; ++n)
    many = joined(many, box(Vec3(0.1 + 0.01 * n, 0, 0), Vec3(0.1 + 0.01 * n, 0, 0) + Vec3::Constant(0.001 * (n + 1))));
  const ImportedSurface kept = closed(many);
  ASSERT_EQ(kept.lost_volumes_m3.size(), 3U);
  EXPECT_NEAR(kept.lost_volumes_m3[0], 27e-9, 1e-12);
  EXPECT_CONTAINS(
      kept.repairs.at(0),
      "kept the largest of 4 components (512 of 548 triangles); those left out enclose 0.036 mL, the largest "
      "of them 0.027 mL");
  EXPECT_TRUE(kept.warnings.empty());
}

TEST(Closing, PartsFromOnePerCentOnAreKeptUnlessTheLargestAloneIsWanted) {
  const TriangleSurface large = sphere(Vec3::Zero(), 0.05, 3), second = sphere(Vec3(0.12, 0, 0), 0.04, 3);
  const TriangleSurface third = sphere(Vec3(0, 0.1, 0), 0.0108, 3);   // 1.008 % of the largest
  const TriangleSurface fourth = sphere(Vec3(0, 0, 0.1), 0.0107, 3);  // 0.980 %
  const TriangleSurface soup = joined(joined(second, third), joined(large, fourth));
  const ImportedSurface kept = closed(soup);
  EXPECT_EQ(kept.surface.triangles.size(), 3 * 512U);
  EXPECT_EQ(kept.surface.vertices.front(), second.vertices.front()) << "the order is the source's";
  EXPECT_NEAR(kept.surface.volume_m3(), large.volume_m3() + second.volume_m3() + third.volume_m3(), 1e-12);
  ASSERT_EQ(kept.lost_volumes_m3.size(), 1U);
  EXPECT_NEAR(kept.lost_volumes_m3[0], fourth.volume_m3(), 1e-12);
  EXPECT_CONTAINS(kept.repairs.at(0), "kept 3 of 4 components (1536 of 2048 triangles); those left out enclose ");
  SurfaceImportOptions options;
  options.only_largest = true;
  const ImportedSurface one = closed(soup, options);
  EXPECT_NEAR(one.surface.volume_m3(), large.volume_m3(), 1e-12);
  EXPECT_EQ(one.lost_volumes_m3.size(), 3U);
  EXPECT_CONTAINS(one.warnings.at(0), "53.2 % of what was kept");
}

TriangleSurface turned_over(TriangleSurface surface) {
  for (auto& triangle : surface.triangles) std::swap(triangle[1], triangle[2]);
  return surface;
}

TEST(Closing, CavitiesAreKeptOrFilledAndSaidEitherWay) {
  const TriangleSurface ball = sphere(Vec3::Zero(), 0.05, 3), hole = sphere(Vec3(0.01, 0, 0), 0.01, 2);
  const TriangleSurface island = sphere(Vec3(0.01, 0, 0), 0.004, 1);
  const TriangleSurface soup =
      joined(joined(joined(ball, turned_over(hole)), island), sphere(Vec3(0.1, 0, 0), 0.005, 2));
  for (const TriangleSurface& stored : {soup, turned_over(soup)}) {
    ImportedSurface kept = closed(stored);
    EXPECT_NEAR(kept.surface.volume_m3(), ball.volume_m3(), 1e-12) << "filled so far";
    ASSERT_EQ(kept.cavities.size(), 1U);
    const double cavity_m3 = hole.volume_m3() - island.volume_m3();
    EXPECT_NEAR(kept.cavities[0].volume_m3(), cavity_m3, 1e-15) << "an island in it is none of it";
    EXPECT_EQ(kept.lost_volumes_m3.size(), 1U) << "the one that lies outside";
    ImportedSurface filled = kept;
    settle_cavities(filled, [](const TriangleSurface&) { return false; });
    EXPECT_NEAR(filled.surface.volume_m3(), ball.volume_m3(), 1e-12);
    EXPECT_NEAR(filled.filled_volumes_m3.at(0), cavity_m3, 1e-15);
    EXPECT_CONTAINS(all(filled.warnings), "a cavity of 3.");
    settle_cavities(kept, [](const TriangleSurface&) { return true; });
    EXPECT_NEAR(kept.surface.volume_m3(), ball.volume_m3() - cavity_m3, 1e-12);
    EXPECT_EQ(analyse_topology(kept.surface).components, 3U);
    EXPECT_CONTAINS(all(kept.repairs), "kept a cavity of 3.");
    EXPECT_TRUE(kept.warnings.empty() && kept.cavities.empty() && kept.filled_volumes_m3.empty());
  }
}

TEST(Closing, APieceWithinThatIsWoundLikeTheOuterOneIsNoCavity) {
  const ImportedSurface kept = closed(joined(sphere(Vec3::Zero(), 0.05, 3), sphere(Vec3(0.01, 0, 0), 0.02, 2)));
  EXPECT_TRUE(kept.cavities.empty() && kept.lost_volumes_m3.empty());
  EXPECT_NEAR(kept.surface.volume_m3(), sphere(Vec3::Zero(), 0.05, 3).volume_m3(), 1e-12);
  EXPECT_CONTAINS(all(kept.repairs), "left out 1 components that lie within others and enclose nothing more");
}

TEST(Closing, ThinDoubleWallsAreNamed) {
  // Half a ball's shell of two walls, 1 mm apart.
  TriangleSurface outer = open_ball(0.05, 0.0, 4), inner = open_ball(0.049, 0.0, 4);
  for (auto& t : inner.triangles) std::swap(t[1], t[2]);
  TriangleSurface shell = joined(outer, inner);
  EXPECT_CONTAINS(refusal(shell), "the surface is open");
  // Wrapped, it is a bowl as thin as its walls lie apart.
  const ImportedSurface wrapped = closed(shell, wrapping(4, 0.4));
  ASSERT_FALSE(wrapped.warnings.empty());
  EXPECT_CONTAINS(wrapped.warnings.back(), "a hollow shell or a tree of tubes");
}

TEST(Closing, SizesAreComparedWithTheOrgan) {
  const TriangleSurface ball = sphere(Vec3::Zero(), 0.02, 3);
  EXPECT_TRUE(closed(ball).warnings.empty());
  EXPECT_TRUE(closed(ball, {}, "gallbladder").warnings.empty());
  EXPECT_CONTAINS(closed(ball, {}, "VH_M_liver").warnings.at(0),
                  "measures 40.0 mm, of a liver one expects 150 to 300 mm: check the unit");
}

TEST(Closing, OneSidedSurfacesAreRefused) {
  TriangleSurface flat;
  flat.vertices = {Vec3(0, 0, 0), Vec3(0.1, 0, 0), Vec3(0, 0.1, 0), Vec3(0.1, 0.1, 0)};
  flat.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  EXPECT_CONTAINS(refusal(flat), "encloses no volume");
  TriangleSurface point;
  point.vertices = {Vec3(0, 0, 0), Vec3(1e-9, 0, 0), Vec3(0.1, 0.1, 0.1)};
  point.triangles = {{0, 1, 0}};
  EXPECT_CONTAINS(refusal(point), "no triangle is left");
}

TEST(Closing, ProgressIsToldAndMayStop) {
  std::vector<std::string> stages;
  ImportedSurface result;
  close_surface(sphere(Vec3::Zero(), 0.05, 3), {}, "", "a.stl", result,
                [&](std::string_view stage, double) { stages.emplace_back(stage); });
  EXPECT_EQ(stages.front(), "welding");
  EXPECT_EQ(stages.back(), "checking");
  struct Stopped {};
  EXPECT_THROW(close_surface(sphere(Vec3::Zero(), 0.05, 3), {}, "", "a.stl", result,
                             [](std::string_view, double) { throw Stopped(); }),
               Stopped);
}

TEST(Closing, OptionsThatMakeNoSenseAreRefused) {
  TemporaryFolder folder;
  const auto path = folder.write("a.stl", stl_binary(scaled(sphere(Vec3::Zero(), 0.05, 2), 1e3)));
  const auto words = [&](SurfaceImportOptions options) {
    options.unit = "mm";
    return message_of<InputError>([&] { import_surface(path, options); });
  };
  EXPECT_CONTAINS(words(filling(-1)), "the widest hole to fill must lie between");
  EXPECT_CONTAINS(words(filling(std::nan(""))), "the widest hole to fill must lie between");
  EXPECT_CONTAINS(words(wrapping(0, 1)), "alpha and offset of a wrap must be above 0");
  SurfaceImportOptions axis;
  axis.up_axis = "up";
  EXPECT_CONTAINS(words(axis), "x, y or z is wanted");
}

}  // namespace
}  // namespace trocar::rescue_test
