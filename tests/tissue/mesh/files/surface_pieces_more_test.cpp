// The pieces under the readers of surfaces: welding, winding, tetrahedra, cells, axes and words, by properties.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <set>

#include "haptics/input_error.h"
#include "tests/tissue/mesh/files/file_writers.h"
#include "tests/tissue/support/shapes.h"
#include "tests/tissue/support/temporary_folder.h"
#include "tissue/mesh/files/organ_sizes.h"
#include "tissue/mesh/files/patient_axes.h"
#include "tissue/mesh/files/placement.h"
#include "tissue/mesh/files/soup_weld.h"
#include "tissue/mesh/files/stored_numbers.h"
#include "tissue/mesh/files/tetrahedra.h"
#include "tissue/mesh/files/text_scanner.h"
#include "tissue/mesh/files/vtk_cells.h"
#include "tissue/mesh/files/vtk_xml_data.h"
#include "tissue/mesh/files/winding.h"
#include "tissue/mesh/surface/topology.h"

namespace trocar::test::surface_pieces_more_test {
namespace {

TriangleSurface as_soup(const TriangleSurface& surface) {
  TriangleSurface soup;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const auto first = static_cast<std::int32_t>(soup.vertices.size());
    for (std::size_t n = 0; n < 3; ++n) soup.vertices.push_back(corner(surface, t, n));
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  return soup;
}

Mat3 drawn_turn(std::mt19937_64& random) {
  std::normal_distribution<double> part;
  const double w = part(random), x = part(random), y = part(random), z = part(random);
  return Eigen::Quaterniond(w, x, y, z).normalized().toRotationMatrix();
}

TEST(SoupWeldMore, TheToleranceDividesMergedFromApart) {
  for (const double gap : {0.2e-3, 0.9e-3, 1.1e-3, 3e-3})
    for (const Vec3& place : {Vec3(0, 0, 0), Vec3(0.4995e-3, -7e-4, 1), Vec3(-1, 1e-3, 0.1)}) {
      TriangleSurface two;
      two.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {gap, 0, 0}, {-1, 0, 0}, {0, -1, 0}};
      two.triangles = {{0, 1, 2}, {3, 4, 5}};
      for (Vec3& point : two.vertices) point += place;
      WeldFacts facts;
      EXPECT_EQ(weld_soup(two, 1e-3, facts).vertices.size(), gap < 1e-3 ? 5U : 6U) << gap;
      EXPECT_EQ(facts.vertices_before, 6U);
      EXPECT_EQ(facts.vertices_after, gap < 1e-3 ? 5U : 6U);
    }
}

TEST(SoupWeldMore, WeldingTwiceChangesNothingMore) {
  std::mt19937_64 random(201);
  std::uniform_real_distribution<double> shake(-2e-4, 2e-4);
  TriangleSurface soup = as_soup(sphere(Vec3(0.1, 0.2, 0.3), 0.06, 3));
  for (Vec3& point : soup.vertices) point += Vec3(shake(random), shake(random), shake(random));
  WeldFacts first, second;
  const TriangleSurface once = weld_soup(soup, 1.2e-3, first), twice = weld_soup(once, 1e-7, second);
  EXPECT_TRUE(analyse_topology(once).closed());
  EXPECT_EQ(twice.triangles, once.triangles);
  EXPECT_EQ(twice.vertices, once.vertices);
  EXPECT_EQ(second.collapsed + second.repeated + second.opposed, 0U);
}

TEST(SoupWeldMore, TheOrderOfTrianglesDoesNotChangeTheBody) {
  std::mt19937_64 random(202);
  const TriangleSurface whole = sphere(Vec3::Zero(), 0.05, 3);
  for (int round = 0; round < 8; ++round) {
    TriangleSurface soup = as_soup(whole);
    std::shuffle(soup.triangles.begin(), soup.triangles.end(), random);
    WeldFacts facts;
    const TriangleSurface welded = weld_soup(soup, 1e-6, facts);
    EXPECT_EQ(welded.vertices.size(), whole.vertices.size());
    EXPECT_NEAR(welded.volume_m3(), whole.volume_m3(), 1e-15);
    EXPECT_EQ(analyse_topology(welded).misoriented_edges, 0U);
  }
}

TEST(WindingMore, OnlyThePieceThatStandsInsideOutIsTurnedWhereverItLies) {
  std::mt19937_64 random(203);
  std::uniform_real_distribution<double> place(-2, 2);
  for (int round = 0; round < 10; ++round) {
    const Mat3 turn = drawn_turn(random);
    TriangleSurface surface =
        joined(box(Vec3(-0.05, -0.05, -0.05), Vec3(0.05, 0.08, 0.05)), sphere(Vec3(0.3, 0, 0), 0.04, 2));
    const double volume = surface.volume_m3();
    const Vec3 shift(place(random), place(random), place(random));
    for (Vec3& point : surface.vertices) point = turn * point + shift;
    for (std::size_t t = 0; t < 12; ++t) std::swap(surface.triangles[t][0], surface.triangles[t][1]);
    std::size_t turned = 0;
    EXPECT_TRUE(wind_outward(surface, turned));
    EXPECT_EQ(turned, 12U) << "the box alone stood inside out";
    EXPECT_NEAR(surface.volume_m3(), volume, 1e-12);
  }
}

TEST(WindingMore, EnclosesEqualsTheFormulaOfABoxAtRandomPoints) {
  std::mt19937_64 random(204);
  std::uniform_real_distribution<double> place(-0.2, 0.2);
  const TriangleSurface body = box(Vec3(-0.1, -0.05, -0.12), Vec3(0.07, 0.11, 0.02));
  int inside = 0;
  for (int n = 0; n < 2000; ++n) {
    const Vec3 point(place(random), place(random), place(random));
    const bool expected = body.bounds().contains(point);
    inside += expected ? 1 : 0;
    ASSERT_EQ(encloses(body, point), expected) << point.transpose();
  }
  EXPECT_GT(inside, 50);
}

/// A row of unit cubes, each cut into the six paths along its edges from corner to corner; every cube is a region.
FileTetrahedra cubes(int count) {
  FileTetrahedra mesh;
  const auto index = [&](int i, int j, int k) { return static_cast<std::int32_t>(i + (count + 1) * (j + 2 * k)); };
  for (int k = 0; k < 2; ++k)
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i <= count; ++i) mesh.vertices.emplace_back(i, j, k);
  constexpr std::array<std::array<int, 3>, 6> kOrders{
      {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};
  for (int cube = 0; cube < count; ++cube)
    for (const auto& order : kOrders) {
      std::array<int, 3> at{cube, 0, 0};
      std::array<std::int32_t, 4> corners{index(cube, 0, 0)};
      for (std::size_t n = 0; n < 3; ++n) {
        ++at[static_cast<std::size_t>(order[n])];
        corners[n + 1] = index(at[0], at[1], at[2]);
      }
      mesh.tetrahedra.push_back(corners);
      mesh.regions.push_back(cube);
    }
  for (int cube = 0; cube < count; ++cube) mesh.region_names.push_back(std::to_string(cube));
  return mesh;
}

TEST(TetrahedraMore, HalfOfAllPathsThroughACubeMustBeTurned) {
  FileTetrahedra mesh = cubes(5);
  EXPECT_EQ(make_positive(mesh), 15U) << "odd permutations of the axes";
  EXPECT_EQ(make_positive(mesh), 0U);
  for (const auto& t : mesh.tetrahedra) {
    const auto at = [&](std::size_t n) { return mesh.vertices[static_cast<std::size_t>(t[n])]; };
    EXPECT_NEAR((at(1) - at(0)).cross(at(2) - at(0)).dot(at(3) - at(0)), 1, 1e-12);
  }
}

TEST(TetrahedraMore, ARowOfCubesHasTheSurfaceOfItsBox) {
  for (int count = 1; count < 6; ++count) {
    FileTetrahedra mesh = cubes(count);
    make_positive(mesh);
    const TriangleSurface outside = outer_surface(mesh);
    EXPECT_EQ(outside.triangles.size(), static_cast<std::size_t>(8 * count + 4));
    EXPECT_NEAR(outside.volume_m3(), count, 1e-12);
    EXPECT_NEAR(surface_area_m2(outside), 4 * count + 2, 1e-12);
    EXPECT_TRUE(analyse_topology(outside).closed() && analyse_topology(outside).manifold());
    double sum = 0;
    for (int region = 0; region < count; ++region) sum += outer_surface(mesh, region).volume_m3();
    EXPECT_NEAR(sum, count, 1e-12);
  }
}

VtkCells cells_of(const std::vector<std::vector<std::int64_t>>& lists) {
  VtkCells cells;
  for (const auto& list : lists) {
    cells.corners.insert(cells.corners.end(), list.begin(), list.end());
    cells.ends.push_back(static_cast<std::int64_t>(cells.corners.size()));
  }
  return cells;
}

TEST(VtkCellsMore, CountedListsAreTheSameCells) {
  std::mt19937_64 random(205);
  for (int round = 0; round < 50; ++round) {
    std::vector<std::vector<std::int64_t>> lists(1 + random() % 7);
    std::vector<std::int64_t> counted;
    for (auto& list : lists) {
      for (std::size_t n = random() % 6; n > 0; --n) list.push_back(static_cast<std::int64_t>(random() % 40));
      counted.push_back(static_cast<std::int64_t>(list.size()));
      counted.insert(counted.end(), list.begin(), list.end());
    }
    const VtkCells wanted = cells_of(lists);
    const VtkCells got = cells_of_counted_list(counted, static_cast<std::int64_t>(lists.size()), "f");
    EXPECT_EQ(got.corners, wanted.corners);
    EXPECT_EQ(got.ends, wanted.ends);
    const auto more = static_cast<std::int64_t>(lists.size() + 1);
    EXPECT_THROW(cells_of_counted_list(counted, more, "f"), InputError);
    counted.push_back(0);
    EXPECT_THROW(cells_of_counted_list(counted, more - 1, "f"), InputError) << "one number too many";
  }
}

TEST(VtkCellsMore, BadCellsAreNamedByTheirNumber) {
  EXPECT_NO_THROW(check_cells(cells_of({{0, 1, 2}, {2, 1, 3}}), 4, "f.vtk"));
  for (const std::int64_t bad : {std::int64_t{4}, std::int64_t{-1}, std::int64_t{1} << 40}) {
    const std::string message = message_of<InputError>([&] {
      check_cells(cells_of({{0, 1, 2}, {2, 1, bad}}), 4, "f.vtk");
    });
    EXPECT_TRUE(message.starts_with("f.vtk")) << message;
    EXPECT_CONTAINS(message, "cell 1");
  }
  VtkCells falling = cells_of({{0, 1, 2}, {2, 1, 3}});
  std::swap(falling.ends[0], falling.ends[1]);
  EXPECT_THROW(check_cells(falling, 4, "f"), InputError);
}

TEST(VtkCellsMore, AStripAroundACylinderHasOneSense) {
  TriangleSurface ring;
  std::vector<std::int64_t> strip;
  constexpr int kAround = 12;
  for (int n = 0; n < kAround; ++n)
    for (const double z : {0.0, 1.0}) {
      const double turn = 2 * std::numbers::pi * n / kAround;
      ring.vertices.emplace_back(std::cos(turn), std::sin(turn), z);
    }
  for (int n = 0; n <= 2 * kAround + 1; ++n) strip.push_back(n % (2 * kAround));
  add_strips(cells_of({strip}), ring, "f");
  EXPECT_EQ(ring.triangles.size(), static_cast<std::size_t>(2 * kAround));
  const SurfaceTopology facts = analyse_topology(ring);
  EXPECT_EQ(facts.misoriented_edges, 0U);
  EXPECT_EQ(facts.boundary_edges, static_cast<std::size_t>(2 * kAround)) << "two rims";
}

TEST(VtkCellsMore, CellsOfEveryKindCoverTheSameSquare) {
  const std::vector<Vec3> square{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}};
  const auto area = [&](std::int64_t type, const std::vector<std::vector<std::int64_t>>& lists) {
    SurfaceFile file;
    TriangleSurface surface;
    surface.vertices = square;
    add_cells(cells_of(lists), std::vector<std::int64_t>(lists.size(), type), file, surface, "f");
    double sum = 0;
    for (std::size_t t = 0; t < surface.triangles.size(); ++t)
      sum +=
          (corner(surface, t, 1) - corner(surface, t, 0)).cross(corner(surface, t, 2) - corner(surface, t, 0)).z() / 2;
    return sum;
  };
  EXPECT_DOUBLE_EQ(area(5, {{0, 1, 2}, {0, 2, 3}}), 4);
  EXPECT_DOUBLE_EQ(area(6, {{0, 1, 3, 2}}), 4) << "strip";
  EXPECT_DOUBLE_EQ(area(7, {{0, 1, 2, 3}}), 4) << "polygon";
  EXPECT_DOUBLE_EQ(area(8, {{0, 1, 3, 2}}), 4) << "pixel";
  EXPECT_DOUBLE_EQ(area(9, {{3, 2, 1, 0}}), -4) << "a quad the other way round";
  EXPECT_DOUBLE_EQ(area(3, {{0, 1}, {2, 3}}), 0) << "lines";
  EXPECT_CONTAINS(message_of<InputError>([&] { area(12, {{0, 1, 2, 3, 0, 1, 2, 3}}); }), "hexahedra are not read");
  EXPECT_CONTAINS(message_of<InputError>([&] { area(9, {{0, 1, 2}}); }), "cell 0: has 3 corners instead of 4");
}

TEST(TakeVerticesMore, KeepsEveryCornersPlaceInOrderOfFirstUse) {
  std::mt19937_64 random(206);
  std::vector<Vec3> all;
  for (int n = 0; n < 50; ++n) all.emplace_back(n, 2 * n, -n);
  std::vector<std::int32_t> scratch(all.size(), -1);
  for (int round = 0; round < 20; ++round) {
    TriangleSurface surface;
    std::vector<Vec3> corners;
    std::set<std::int32_t> used;
    for (int t = 0; t < 12; ++t) {
      std::array<std::int32_t, 3> triangle{};
      for (auto& index : triangle) {
        index = static_cast<std::int32_t>(random() % all.size());
        corners.push_back(all[static_cast<std::size_t>(index)]), used.insert(index);
      }
      surface.triangles.push_back(triangle);
    }
    take_vertices(surface, all, scratch);
    EXPECT_EQ(surface.vertices.size(), used.size());
    std::int32_t next = 0;
    for (std::size_t n = 0; n < corners.size(); ++n) {
      const std::int32_t index = surface.triangles[n / 3][n % 3];
      ASSERT_LE(index, next);
      next = std::max(next, index + 1);
      EXPECT_EQ(surface.vertices[static_cast<std::size_t>(index)], corners[n]);
    }
    EXPECT_EQ(scratch, std::vector<std::int32_t>(all.size(), -1));
  }
}

TEST(PatientAxesMore, EveryAxisPointsWhereItsLetterSays) {
  const std::map<char, Vec3> ways{{'R', {1, 0, 0}},  {'L', {-1, 0, 0}}, {'A', {0, 1, 0}},
                                  {'P', {0, -1, 0}}, {'S', {0, 0, 1}},  {'I', {0, 0, -1}}};
  int frames = 0;
  for (const auto& [a, to_a] : ways)
    for (const auto& [b, to_b] : ways)
      for (const auto& [c, to_c] : ways) {
        if (std::abs(to_a.dot(to_b.cross(to_c))) < 0.5) continue;
        Mat3 wanted;
        wanted << to_a, to_b, to_c;
        EXPECT_EQ(to_ras({a, b, c}), wanted) << a << b << c;
        ++frames;
      }
  EXPECT_EQ(frames, 48);
}

TEST(PlacementMore, PointsAreScaledTurnsInEveryUnitAndFrame) {
  std::mt19937_64 random(207);
  std::uniform_real_distribution<double> place(-100, 100);
  for (const auto& [unit, metres] : std::map<std::string, double>{{"mm", 1e-3}, {"cm", 1e-2}, {"m", 1}})
    for (const std::string frame : {"RAS", "LPS", "LSA", "SRA", "LAS", "IPR"}) {
      SurfaceImportOptions options;
      options.unit = unit, options.frame = frame;
      const Eigen::AlignedBox3d bounds(Vec3::Constant(-0.1 / metres), Vec3::Constant(0.1 / metres));
      const Placement placement = placement_of(SurfaceFile{}, options, bounds, "", "f.stl");
      const Vec3 a(place(random), place(random), place(random)), b(place(random), place(random), place(random));
      EXPECT_LT((placement.placed(a) - metres * (to_ras(frame) * a)).norm(), 1e-12);
      EXPECT_NEAR((placement.placed(a) - placement.placed(b)).norm(), metres * (a - b).norm(), 1e-9);
      EXPECT_EQ(placement.mirrors(), to_ras(frame).determinant() < 0) << frame;
      EXPECT_EQ(placement.frame, frame);
      EXPECT_EQ(metres_per(unit), metres);
    }
  EXPECT_THROW(metres_per("inch"), InputError);
}

TEST(TextScannerMore, PeekLooksAndTakesNothing) {
  std::mt19937_64 random(208);
  std::string text;
  std::vector<std::string> words;
  for (int n = 0; n < 200; ++n) {
    words.push_back("w" + std::to_string(random() % 1000));
    text += words.back() + std::array<const char*, 5>{" ", "\n", "\r\n", "\t ", " \n\n"}[random() % 5];
  }
  TextScanner scanner(text, "f");
  for (const std::string& word : words) {
    EXPECT_EQ(scanner.peek(), word);
    EXPECT_EQ(scanner.word(), word);
  }
  EXPECT_TRUE(scanner.at_end());
}

TEST(TextScannerMore, WholeNumbersComeBackOverTheWholeRange) {
  std::mt19937_64 random(209);
  for (int n = 0; n < 500; ++n) {
    const auto wanted = static_cast<std::int64_t>(random()) >> (random() % 63);
    std::int64_t value = 0;
    ASSERT_TRUE(to_whole(std::to_string(wanted), value));
    EXPECT_EQ(value, wanted);
  }
  std::int64_t value = 5;
  for (const char* bad : {"", "-", "1.0", "1e3", "0x1", "12a", "9223372036854775808", "- 1"})
    EXPECT_FALSE(to_whole(bad, value)) << bad;
}

}  // namespace
}  // namespace trocar::test::surface_pieces_more_test
