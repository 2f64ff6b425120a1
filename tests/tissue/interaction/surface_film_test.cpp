// A film of blood and water on a surface: where it runs, and that nothing of it is lost.
#include "tissue/interaction/surface_film.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "tests/tissue/support/shapes.h"

namespace trocar::surface_film_test {
namespace {

constexpr double kStep = 0.01;         // s
constexpr double kDrop = 0.05e-6;      // m3
constexpr std::int32_t kColumns = 21;  // of a sheet, along y
constexpr double kSpacing = 0.003;     // m

/// Rows along x, columns along y, z by the function of both; diagonals mirrored about the middle column.
template <typename Height>
TriangleSurface sheet(std::int32_t rows, const Height& height) {
  TriangleSurface out;
  for (std::int32_t r = 0; r < rows; ++r)
    for (std::int32_t c = 0; c < kColumns; ++c) {
      const double x = r * kSpacing, y = (c - kColumns / 2) * kSpacing;
      out.vertices.emplace_back(x, y, height(x, y));
    }
  for (std::int32_t r = 0; r + 1 < rows; ++r)
    for (std::int32_t c = 0; c + 1 < kColumns; ++c) {
      const std::int32_t a = r * kColumns + c, b = a + 1, d = a + kColumns, e = d + 1;
      if (c < kColumns / 2) {
        out.triangles.push_back({a, d, e});
        out.triangles.push_back({a, e, b});
      } else {
        out.triangles.push_back({a, d, b});
        out.triangles.push_back({b, d, e});
      }
    }
  return out;
}

std::int32_t vertex(std::int32_t row, std::int32_t column) { return row * kColumns + column; }

void run(SurfaceFilm& film, const TriangleSurface& surface, double seconds) {
  for (int i = 0; i < std::lround(seconds / kStep); ++i) film.step(surface.vertices, kStep);
}

double middle_x(const SurfaceFilm& film, const TriangleSurface& surface) {
  double moment = 0, sum = 0;
  for (std::size_t v = 0; v < surface.vertices.size(); ++v) {
    const double volume = film.at(static_cast<std::int32_t>(v)).sum();
    moment += volume * surface.vertices[v].x();
    sum += volume;
  }
  return moment / sum;
}

void expect_closed(const FilmAccount& account) {
  EXPECT_NEAR(account.blood_missing(), 0, 1e-9 * (account.given.blood + 1e-12));
  EXPECT_NEAR(account.water_missing(), 0, 1e-9 * (account.given.water + 1e-12));
}

TEST(SurfaceFilm, RunsDownAnInclinedPlaneAndDripsOffItsRimIntoThePool) {
  const TriangleSurface plane = sheet(31, [](double x, double) { return -x; });
  SurfaceFilm film(plane);
  for (int i = 0; i < 40; ++i) film.add_blood(vertex(3, kColumns / 2), kDrop / 4);
  const double start = middle_x(film, plane);
  run(film, plane, 0.5);
  EXPECT_GT(middle_x(film, plane), start + 0.005);
  EXPECT_EQ(film.at(vertex(0, kColumns / 2)).sum(), 0) << "nothing runs uphill";
  for (int i = 0; i < 300; ++i) {
    film.add_blood(vertex(3, kColumns / 2), kDrop / 10);
    film.step(plane.vertices, kStep);
  }
  run(film, plane, 20);
  const FilmAccount account = film.account();
  EXPECT_GT(account.pool.blood, 0.3 * account.given.blood);
  EXPECT_GT(account.film.blood + account.dried, 0.01 * account.given.blood) << "a thin layer stays";
  EXPECT_GT(film.pool_level_m(), plane.vertices.back().z());
  expect_closed(account);
}

TEST(SurfaceFilm, AFrontMovesAsLubricationHasIt) {
  // A film of even height h on a wall of slope 1 loses rho g sin h^3 / (3 mu) a width over its lower rim; no clinging.
  const TriangleSurface plane = sheet(41, [](double x, double) { return -x; });
  const SurfaceFilmOptions options = {.cling_m = 0, .dry_s = 1e9};
  SurfaceFilm film(plane, options);
  constexpr double kHeight = 0.1e-3;
  for (std::int32_t v = 0; v < 41 * kColumns; ++v) film.add_blood(v, kHeight * film.area_m2(v));
  const auto above = [&](std::int32_t row) {
    double sum = 0;
    for (std::int32_t v = 0; v < row * kColumns; ++v) sum += film.at(v).blood;
    return sum;
  };
  const double before = above(30);
  run(film, plane, 0.2);
  const double flux =
      options.density_kg_per_m3 * kGravity * std::sqrt(0.5) * std::pow(kHeight, 3) / (3 * options.blood_pa_s);
  EXPECT_NEAR((before - above(30)) / (flux * 0.2 * kSpacing * (kColumns - 1)), 1, 0.005);
}

TEST(SurfaceFilm, RunsToBothSidesOfARidgeAlike) {
  const TriangleSurface ridge = sheet(21, [](double x, double y) { return -std::abs(y) - 0.1 * x; });
  SurfaceFilm film(ridge);
  for (int i = 0; i < 200; ++i) {
    film.add_blood(vertex(5, kColumns / 2), kDrop / 20);
    film.step(ridge.vertices, kStep);
  }
  double left = 0, right = 0;
  for (std::int32_t r = 0; r < 21; ++r)
    for (std::int32_t c = 0; c < kColumns / 2; ++c) {
      left += film.at(vertex(r, c)).blood;
      right += film.at(vertex(r, kColumns - 1 - c)).blood;
    }
  EXPECT_GT(left, 0.1 * film.account().given.blood);
  EXPECT_NEAR(left / right, 1, 1e-4) << "vertices are looked at for drying in turns";
}

TEST(SurfaceFilm, AHollowFillsToALevelAndThenOverflows) {
  const auto bowl = [](double x, double y) {
    const double r = std::hypot(x - 0.03, y);
    return r < 0.015 ? -0.004 * (1 - r / 0.015) : -(r - 0.015) * 0.2;
  };
  const TriangleSurface hollow = sheet(21, bowl);
  SurfaceFilm film(hollow);
  for (int i = 0; i < 500; ++i) {
    film.add_water(vertex(10, kColumns / 2), 1e-9);
    film.step(hollow.vertices, kStep);
  }
  run(film, hollow, 3);
  EXPECT_EQ(film.account().pool.water, 0) << "0.5 mL: less than it holds";
  const auto level = [&](std::int32_t v) {
    return hollow.vertices[static_cast<std::size_t>(v)].z() + film.height_m(v);
  };
  EXPECT_NEAR(level(vertex(10, kColumns / 2)), level(vertex(11, kColumns / 2)), 0.4e-3);
  for (int i = 0; i < 1000; ++i) {
    film.add_water(vertex(10, kColumns / 2), 5e-9);
    film.step(hollow.vertices, kStep);
  }
  EXPECT_GT(film.account().pool.water, 1e-6);
  expect_closed(film.account());
}

TEST(SurfaceFilm, GathersUnderASphereAndDripsThere) {
  const TriangleSurface ball = test::sphere({0, 0, 0.1}, 0.03, 4);
  SurfaceFilm film(ball, {.floor_m = 0});
  const auto lowest = static_cast<std::int32_t>(
      std::ranges::min_element(ball.vertices, {}, [](const Vec3& p) { return p.z(); }) - ball.vertices.begin());
  for (int i = 0; i < 3000; ++i) {
    film.add_blood(4, 10e-9);  // the top
    film.step(ball.vertices, kStep);
  }
  EXPECT_GT(film.at(lowest).blood, 0);
  EXPECT_GT(film.account().pool.blood, 0.5 * film.account().given.blood);
  EXPECT_GT(film.pool_level_m(), 0);
  expect_closed(film.account());
}

TEST(SurfaceFilm, FollowsTheSurfaceAsItIsNow) {
  const TriangleSurface rest = sheet(21, [](double, double) { return 0.0; });
  TriangleSurface tilted = rest;
  for (Vec3& p : tilted.vertices) p.z() = p.x();
  SurfaceFilm film(rest);
  film.add_blood(vertex(10, kColumns / 2), kDrop);
  const double start = middle_x(film, rest);
  run(film, tilted, 1);
  EXPECT_LT(middle_x(film, rest), start - 0.005);
}

TEST(SurfaceFilm, ShowsBloodAsItAbsorbsAndWetness) {
  const TriangleSurface plane = sheet(5, [](double, double) { return 0.0; });
  const SurfaceFilmOptions options = {.dry_s = 1e12, .evaporate_s = 1e12};
  SurfaceFilm film(plane, options);
  const std::int32_t v = vertex(2, 5), w = vertex(2, 15);
  film.add_blood(v, 10e-6 * film.area_m2(v));  // clings
  film.add_water(w, 10e-6 * film.area_m2(w));
  run(film, plane, 0.5);
  EXPECT_NEAR(film.blood()[static_cast<std::size_t>(v)], 1 - std::exp(-10e-6 / options.blood_shown_m), 1e-6);
  EXPECT_NEAR(film.wet()[static_cast<std::size_t>(v)], 1 - std::exp(-10e-6 / options.wet_shown_m), 1e-6);
  EXPECT_EQ(film.blood()[static_cast<std::size_t>(w)], 0.0F);
  EXPECT_NEAR(film.wet()[static_cast<std::size_t>(w)], 1 - std::exp(-10e-6 / options.wet_shown_m), 1e-6);
  EXPECT_EQ(film.wet()[0], 0.0F);
}

TEST(SurfaceFilm, BloodDriesToAStainThatWaterTakesUpAgain) {
  const TriangleSurface plane = sheet(21, [](double x, double) { return -x; });
  SurfaceFilm film(plane, {.dry_s = 1});
  const std::int32_t v = vertex(5, kColumns / 2);
  film.add_blood(v, 15e-6 * film.area_m2(v));
  run(film, plane, 20);
  EXPECT_NEAR(film.stain_m3(v), 15e-6 * film.area_m2(v), 0.05 * film.stain_m3(v));
  EXPECT_EQ(film.wet_vertices(), 0U) << "a stain costs nothing";
  EXPECT_GT(film.blood()[static_cast<std::size_t>(v)], 0.2F);
  EXPECT_LT(film.wet()[static_cast<std::size_t>(v)], 0.05F);
  for (int i = 0; i < 6000; ++i) {
    film.add_water(v, 2e-9);
    film.step(plane.vertices, kStep);
  }
  EXPECT_LT(film.blood()[static_cast<std::size_t>(v)], 0.02F) << "rinsed off";
  expect_closed(film.account());
}

TEST(SurfaceFilm, WaterOfAJetMeetsWhatFacesItAndWashesBloodAway) {
  const TriangleSurface ball = test::sphere({0, 0, 0.1}, 0.03, 4);
  SurfaceFilm film(ball, {.dry_s = 1e9});
  const std::int32_t top = 4;
  for (int i = 0; i < 100; ++i) {
    film.add_blood(top, 1e-9);
    film.step(ball.vertices, kStep);
  }
  const float before = film.blood()[top];
  Irrigation jet{.tip_T = {0, 0, 0.16}, .direction_T = {0, 0, -1}, .flow_m3_per_s = 10e-6, .half_angle_rad = 0.2};
  film.irrigate(jet, ball.vertices, kStep);
  EXPECT_NEAR(film.account().film.water, 10e-6 * kStep, 1e-16);
  for (std::size_t v = 0; v < ball.vertices.size(); ++v)
    if (ball.vertices[v].z() < 0.1) {
      EXPECT_EQ(film.at(static_cast<std::int32_t>(v)).water, 0) << "not through the ball";
    } else {
      const Vec3 way = ball.vertices[v] - jet.tip_T;
      EXPECT_EQ(film.at(static_cast<std::int32_t>(v)).water > 0,
                std::hypot(way.x(), way.y()) < -std::tan(0.2) * way.z())
          << "in the cone";
    }
  for (int i = 0; i < 300; ++i) {
    film.irrigate(jet, ball.vertices, kStep);
    film.step(ball.vertices, kStep);
  }
  EXPECT_GT(before, 0.5F);
  EXPECT_LT(film.blood()[top], 0.1F * before);
  jet.direction_T = {0, 0, 1};
  const double pool = film.account().pool.water;
  film.irrigate(jet, ball.vertices, kStep);
  EXPECT_NEAR(film.account().pool.water - pool, 10e-6 * kStep, 1e-16) << "beside everything";
  expect_closed(film.account());
}

TEST(SurfaceFilm, SuctionTakesWhatIsNearAtMostAsFastAsItCanAndThenThePool) {
  const TriangleSurface plane = sheet(21, [](double, double) { return 0.0; });
  SurfaceFilm film(plane, {.floor_m = -0.1});
  const std::int32_t near = vertex(10, 10), far = vertex(10, 18);
  film.add_blood(near, 3e-7);
  film.add_water(near, 1e-7);
  film.add_blood(far, 3e-7);
  const Suction tube{
      .tip_T = plane.vertices[static_cast<std::size_t>(near)], .radius_m = 0.004, .most_m3_per_s = 20e-6};
  const Liquids first = film.suck(tube, plane.vertices, kStep);
  EXPECT_NEAR(first.sum(), 20e-6 * kStep, 1e-18);
  EXPECT_NEAR(first.blood / first.water, 3, 1e-9) << "mixed as it is there";
  for (int i = 0; i < 10; ++i) film.suck(tube, plane.vertices, kStep);
  EXPECT_EQ(film.at(near).sum(), 0);
  EXPECT_NEAR(film.at(far).blood, 3e-7, 1e-15);
  film.add_to_pool({2e-6, 1e-6});
  EXPECT_EQ(film.suck(tube, plane.vertices, kStep).sum(), 0) << "the pool is 100 mm below the tip";
  const Suction deep{.tip_T = {0.03, 0, -0.1}, .radius_m = 0.004, .most_m3_per_s = 20e-6};
  EXPECT_NEAR(film.suck(deep, plane.vertices, kStep).sum(), 20e-6 * kStep, 1e-18);
  for (int i = 0; i < 20; ++i) film.suck(deep, plane.vertices, kStep);
  EXPECT_NEAR(film.account().pool.sum(), 0, 1e-18);
  EXPECT_NEAR(film.account().sucked.sum(), 7e-7 + 3e-6 - 3e-7, 1e-15);
  expect_closed(film.account());
}

TEST(SurfaceFilm, CostsNothingOnceItIsDry) {
  const TriangleSurface plane = sheet(21, [](double x, double) { return -x; });
  SurfaceFilm film(plane, {.dry_s = 1, .evaporate_s = 1});
  film.add_blood(vertex(10, 10), 1e-9);
  film.add_water(vertex(10, 12), 1e-9);
  run(film, plane, 60);
  EXPECT_EQ(film.wet_vertices(), 0U);
  expect_closed(film.account());
}

TEST(SurfaceFilm, NewVerticesTakeOverAShareAndNothingIsLost) {
  TriangleSurface plane = sheet(11, [](double, double) { return 0.0; });
  SurfaceFilm film(plane, {.cling_m = 1e-3});  // does not run
  for (std::int32_t v = 0; v < 11 * kColumns; ++v) {
    film.add_blood(v, 50e-6 * film.area_m2(v));
    film.add_water(v, 20e-6 * film.area_m2(v));
  }
  // The edge of the first triangle is split: two triangles become four.
  const std::int32_t a = vertex(0, 0), d = vertex(1, 0), e = vertex(1, 1), b = vertex(0, 1);
  const auto fresh = static_cast<std::int32_t>(plane.vertices.size());
  plane.vertices.push_back((plane.vertices[0] + plane.vertices[static_cast<std::size_t>(e)]) / 2);
  ASSERT_EQ(plane.triangles[0], (std::array<std::int32_t, 3>{a, d, e}));
  plane.triangles[0] = {a, d, fresh};
  plane.triangles[1] = {a, fresh, b};
  plane.triangles.push_back({fresh, d, e});
  plane.triangles.push_back({fresh, e, b});
  const Liquids before = film.account().film;
  film.grow(plane, {{a, e, 0.5}});
  EXPECT_EQ(film.vertices(), plane.vertices.size());
  EXPECT_NEAR(film.account().film.blood / before.blood, 1, 1e-12);
  EXPECT_NEAR(film.account().film.water / before.water, 1, 1e-12);
  EXPECT_NEAR(film.at(fresh).blood / film.area_m2(fresh), 50e-6, 25e-6);
  EXPECT_GT(film.blood()[static_cast<std::size_t>(fresh)], 0.2F);
  film.grow(plane, {});
  run(film, plane, 1);
  expect_closed(film.account());
}

TEST(SurfaceFilm, AGrownSurfaceRunsAsOneMadeAnew) {
  TriangleSurface plane = sheet(21, [](double x, double) { return -x; });
  SurfaceFilm grown(plane);
  for (std::size_t t = 100; t < 400; t += 30) {
    const auto [a, b, c] = plane.triangles[t];
    const auto fresh = static_cast<std::int32_t>(plane.vertices.size());
    Vec3 middle = Vec3::Zero();
    for (const std::int32_t v : {a, b, c}) middle += plane.vertices[static_cast<std::size_t>(v)] / 3;
    plane.vertices.push_back(middle);
    plane.triangles[t] = {a, b, fresh};
    plane.triangles.push_back({b, c, fresh});
    plane.triangles.push_back({c, a, fresh});
    grown.grow(plane, {{a, b, 0.5}});
  }
  SurfaceFilm anew(plane);
  for (SurfaceFilm* film : {&grown, &anew}) {
    for (int i = 0; i < 100; ++i) {
      film->add_blood(vertex(3, 10), kDrop / 10);
      film->step(plane.vertices, kStep);
    }
  }
  EXPECT_EQ(grown.blood(), anew.blood());
  EXPECT_EQ(grown.account().pool.blood, anew.account().pool.blood);
}

TEST(SurfaceFilm, NothingDripsOutOfACutThatFills) {
  // What lies in the wall of a cut falls onto the other wall, however it faces.
  const TriangleSurface ball = test::sphere({0, 0, 0.1}, 0.03, 3);
  const auto facing = [&](double n_z) {
    return static_cast<std::int32_t>(
        std::ranges::min_element(ball.vertices, {},
                                 [&](const Vec3& p) { return std::abs((p.z() - 0.1) / 0.03 - n_z); }) -
        ball.vertices.begin());
  };
  const std::int32_t cut = facing(-0.6);
  std::vector<bool> inside;
  for (const auto& triangle : ball.triangles) inside.push_back(std::ranges::find(triangle, cut) != triangle.end());
  SurfaceFilm whole(ball), opened(ball);
  opened.grow(ball, {}, inside);
  for (SurfaceFilm* film : {&whole, &opened}) {
    film->add_blood(cut, 0.7e-3 * film->area_m2(cut));  // more than hangs, less than runs off at once
    run(*film, ball, 0.05);
    expect_closed(film->account());
  }
  EXPECT_GT(whole.account().pool.blood, 0);
  EXPECT_EQ(opened.account().pool.blood, 0);
}

TEST(SurfaceFilm, NeverNegativeAndClosedUnderAnything) {
  const TriangleSurface ball = test::sphere({0, 0, 0.1}, 0.03, 3);
  SurfaceFilm film(ball);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(-1, 1);
  TriangleSurface now = ball;
  for (int i = 0; i < 3000; ++i) {
    const auto v = static_cast<std::int32_t>(random() % ball.vertices.size());
    switch (random() % 4) {
      case 0:
        film.add_blood(v, 1e-7 * unit(random));
        break;
      case 1:
        film.add_water(v, 1e-7 * unit(random));
        break;
      case 2:
        film.suck({.tip_T = now.vertices[static_cast<std::size_t>(v)]}, now.vertices, kStep);
        break;
      default:
        for (Vec3& p : now.vertices) p += 1e-3 * Vec3(unit(random), unit(random), unit(random));
    }
    film.step(now.vertices, kStep);
  }
  for (std::int32_t v = 0; v < static_cast<std::int32_t>(ball.vertices.size()); ++v) {
    EXPECT_GE(film.at(v).blood, 0);
    EXPECT_GE(film.at(v).water, 0);
    EXPECT_GE(film.stain_m3(v), 0);
  }
  expect_closed(film.account());
}

TEST(SurfaceFilm, ToleratesDegenerateTrianglesAndNumbersThatAreNone) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  TriangleSurface odd = sheet(11, [](double x, double) { return -x; });
  odd.triangles.push_back({3, 3, 3});
  odd.triangles.push_back({3, 4, 9999});
  odd.vertices.emplace_back(none, none, none);
  odd.triangles.push_back({5, 6, static_cast<std::int32_t>(odd.vertices.size()) - 1});
  odd.vertices[vertex(3, 3)] = odd.vertices[vertex(3, 4)];  // triangles without area
  SurfaceFilm film(odd);
  for (std::int32_t v = -1; v < static_cast<std::int32_t>(odd.vertices.size()) + 1; ++v) film.add_blood(v, kDrop / 10);
  EXPECT_EQ(film.add_blood(3, none), 0);
  EXPECT_EQ(film.add_water(3, -1), 0);
  std::vector<Vec3> now = odd.vertices;
  now[vertex(6, 6)] = Vec3::Constant(none);
  for (int i = 0; i < 200; ++i) film.step(now, kStep);
  film.suck({.tip_T = {none, 0, 0}}, now, kStep);
  film.irrigate({.tip_T = {0, 0, none}}, now, kStep);
  const FilmAccount account = film.account();
  EXPECT_TRUE(std::isfinite(account.film.blood));
  expect_closed(account);
  for (const float value : film.blood()) EXPECT_TRUE(value >= 0 && value <= 1);
}

}  // namespace
}  // namespace trocar::surface_film_test
