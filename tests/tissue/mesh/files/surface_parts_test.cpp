// The pieces that the readers share: polygons, names, welding, winding, tetrahedra, axes, sizes, stored numbers.
#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "haptics/input_error.h"
#include "tests/tissue/mesh/files/file_writers.h"
#include "tests/tissue/support/shapes.h"
#include "tests/tissue/support/temporary_folder.h"
#include "tissue/mesh/files/organ_sizes.h"
#include "tissue/mesh/files/patient_axes.h"
#include "tissue/mesh/files/soup_weld.h"
#include "tissue/mesh/files/stored_numbers.h"
#include "tissue/mesh/files/tetrahedra.h"
#include "tissue/mesh/files/winding.h"
#include "tissue/mesh/surface/topology.h"

namespace trocar::surface_parts_test {
namespace {

using namespace test;

TriangleSurface polygon(const std::vector<Vec3>& outline) {
  TriangleSurface surface;
  surface.vertices = outline;
  std::vector<std::int32_t> corners;
  for (std::size_t n = 0; n < outline.size(); ++n) corners.push_back(static_cast<std::int32_t>(n));
  add_polygon(surface, corners);
  return surface;
}

/// Twice the signed area along z.
double shoelace(const std::vector<Vec3>& outline) {
  double sum = 0;
  for (std::size_t n = 0; n < outline.size(); ++n) {
    const Vec3 &a = outline[n], &b = outline[(n + 1) % outline.size()];
    sum += a.x() * b.y() - b.x() * a.y();
  }
  return sum;
}

TEST(Polygon, ConvexOnesBecomeFans) {
  std::vector<Vec3> outline;
  for (int n = 0; n < 7; ++n) outline.emplace_back(std::cos(0.9 * n), std::sin(0.9 * n), 0);
  const TriangleSurface surface = polygon(outline);
  ASSERT_EQ(surface.triangles.size(), 5U);
  EXPECT_EQ(surface.triangles[0], (std::array<std::int32_t, 3>{0, 1, 2}));
  EXPECT_EQ(surface.triangles[4], (std::array<std::int32_t, 3>{0, 5, 6}));
}

TEST(Polygon, ConcaveOnesKeepTheirAreaAndSide) {
  // A U, a dart and a star: a fan round the first corner would leave the outline.
  const std::vector<Vec3> u{{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {2, 3, 0}, {2, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}};
  const std::vector<Vec3> dart{{0, 0, 0}, {2, 1, 0}, {0, 2, 0}, {0.5, 1, 0}};
  std::vector<Vec3> star;
  for (int n = 0; n < 12; ++n)
    star.push_back((n % 2 == 0 ? 2.0 : 0.6) *
                   Vec3(std::cos(n * std::numbers::pi / 6), std::sin(n * std::numbers::pi / 6), 0));
  for (const auto& outline : {u, dart, star}) {
    for (std::size_t turn = 0; turn < outline.size(); ++turn) {
      std::vector<Vec3> turned = outline;
      std::rotate(turned.begin(), turned.begin() + static_cast<std::ptrdiff_t>(turn), turned.end());
      const TriangleSurface surface = polygon(turned);
      ASSERT_EQ(surface.triangles.size(), outline.size() - 2);
      double sum = 0;
      for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
        const double part =
            (corner(surface, t, 1) - corner(surface, t, 0)).cross(corner(surface, t, 2) - corner(surface, t, 0)).z();
        EXPECT_GE(part, -1e-12);
        sum += part;
      }
      EXPECT_NEAR(sum, shoelace(outline), 1e-9);
    }
  }
}

TEST(Polygon, QuadsAreCutAlongTheShorterDiagonal) {
  const TriangleSurface tall = polygon({{0, -3, 0}, {1, 0, 0}, {0, 3, 0}, {-1, 0, 0}});
  EXPECT_EQ(tall.triangles[0], (std::array<std::int32_t, 3>{1, 2, 3}));
  const TriangleSurface wide = polygon({{0, -1, 0}, {3, 0, 0}, {0, 1, 0}, {-3, 0, 0}});
  EXPECT_EQ(wide.triangles[0], (std::array<std::int32_t, 3>{0, 1, 2}));
}

TEST(Polygon, CollapsedOutlinesEndToo) {
  EXPECT_EQ(polygon({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}}).triangles.size(), 3U);
  EXPECT_EQ(polygon({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}).triangles.size(), 2U);
  EXPECT_EQ(polygon({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}).triangles.size(), 2U);  // a bow tie
}

TEST(Names, AreSafeToPrint) {
  EXPECT_EQ(printable("VH_M liver"), "VH_M liver");
  EXPECT_EQ(printable("a\nb\x1b[31m\xff"), "a?b?[31m?");
  EXPECT_EQ(printable(std::string(500, 'x')).size(), kMaxNameBytes);
}

TEST(SlicerSpaces, AreFoundHoweverTheyAreWritten) {
  using Words = std::vector<std::string>;
  EXPECT_EQ(slicer_spaces("3D Slicer output. SPACE=LPS"), Words{"LPS"});
  EXPECT_EQ(slicer_spaces("SPACE=RAS and more"), Words{"RAS"});
  EXPECT_EQ(slicer_spaces("comment SPACE = LPS\ncomment space=ras"), (Words{"LPS", "RAS"}));
  EXPECT_EQ(slicer_spaces("SPACE=XYZ"), Words{"XYZ"}) << "refused: nobody knows it";
  EXPECT_EQ(slicer_spaces("color space=sRGB, WORKSPACE=RAS"), Words{});
  EXPECT_EQ(slicer_spaces("a solid without a word"), Words{});
}

TEST(SurfaceComment, SaysFrameAndUnitAsWholeWords) {
  for (const auto& [comment, unit_m] : {std::pair{"SPACE=RAS UNIT=mm", 1e-3}, std::pair{"UNIT=cm\nelement", 1e-2},
                                        std::pair{"UNIT=m", 1.0}, std::pair{"UNIT=um", 1e-6}}) {
    SurfaceFile file;
    take_comment(comment, "a comment", file, "f");
    EXPECT_EQ(file.unit_m, unit_m) << comment;
  }
  for (const char* other : {"UNIT=micron", "UNIT=mmHg", "UNIT=", "unit=mm"}) {
    SurfaceFile file;
    take_comment(other, "a comment", file, "f");
    EXPECT_EQ(file.unit_m, std::nullopt) << other;
  }
}

TEST(OwnWords, AreLinesOfOurExportAlone) {
  SurfaceFile file;
  take_own_words("ply\ncomment TROCAR NAME=left lobe\ncomment TROCAR MATERIAL=liver\n", file);
  EXPECT_EQ(file.name, "left lobe");
  EXPECT_EQ(file.material, "liver");
  SurfaceFile other;
  take_own_words(
      "ply\ncomment NAME=a\ncomment by TROCAR NAME=b\nTROCAR MATERIAL=c\ncomment TROCAR NAME=d\x1b\n"
      "comment TROCAR NAME=\xff\ncomment TROCAR NAME=" +
          std::string(81, 'e') + "\n",
      other);
  EXPECT_EQ(other.name + other.material, "");
}

TEST(Names, CountsAboveTheCapAreRefused) {
  EXPECT_NO_THROW(check_count(5, 5, "triangles", "f"));
  EXPECT_CONTAINS(message_of<InputError>([] { check_count(6, 5, "triangles", "f.stl"); }),
                  "f.stl: 6 triangles are more than the 5");
}

TEST(PatientAxes, KnownFrames) {
  EXPECT_TRUE(to_ras("RAS").isIdentity());
  EXPECT_EQ(to_ras("LPS") * Vec3(1, 2, 3), Vec3(-1, -2, 3));
  EXPECT_EQ(to_ras("LSA") * Vec3(1, 2, 3), Vec3(-1, 3, 2));
  EXPECT_EQ(to_ras("SRA") * Vec3(1, 2, 3), Vec3(2, 3, 1));
}

TEST(PatientAxes, AllFortyEightAreTurnsOrMirrors) {
  int turns = 0, mirrors = 0;
  const std::string letters = "RLAPSI";
  for (const char a : letters)
    for (const char b : letters)
      for (const char c : letters) {
        const std::string frame{a, b, c};
        try {
          const Mat3 m = to_ras(frame);
          EXPECT_TRUE((m * m.transpose()).isIdentity());
          (m.determinant() > 0 ? turns : mirrors)++;
        } catch (const InputError&) {
        }
      }
  EXPECT_EQ(turns, 24);
  EXPECT_EQ(mirrors, 24);
  for (const char* bad : {"", "RA", "RASI", "RRS", "ras", "XYZ"}) EXPECT_THROW(to_ras(bad), InputError) << bad;
}

TEST(PatientAxes, UpAxesAreTurns) {
  for (const std::string axis : {"x", "y", "z"}) {
    const Mat3 m = to_ras(frame_of_up_axis(axis));
    EXPECT_EQ(m.determinant(), 1) << axis;
    EXPECT_EQ(m * Vec3::Unit(axis[0] - 'x'), Vec3::UnitZ()) << axis;
  }
  EXPECT_THROW(frame_of_up_axis("w"), InputError);
}

TEST(OrganSizes, FoundInNamesOfFiles) {
  EXPECT_EQ(organ_size("VH_M_Gallbladder")->name, "gallbladder");
  EXPECT_EQ(organ_size("liver-smooth")->name, "liver");
  EXPECT_EQ(organ_size("Urinary.Bladder")->name, "urinary bladder");
  EXPECT_EQ(organ_size("hepatic_veins")->name, "hepatic vein");
  EXPECT_FALSE(organ_size("thing"));
  for (const char* name : {"liver", "spleen", "colon", "ureter"})
    EXPECT_LT(organ_size(name)->least_mm, organ_size(name)->most_mm);
}

TriangleSurface soup_of(const TriangleSurface& surface) {
  TriangleSurface soup;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const auto first = static_cast<std::int32_t>(soup.vertices.size());
    for (std::size_t n = 0; n < 3; ++n) soup.vertices.push_back(corner(surface, t, n));
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  return soup;
}

TEST(SoupWeld, MergesWhatIsNearWhereverTheGridLies) {
  const TriangleSurface whole = sphere(Vec3(0.3, -0.2, 0.1), 0.05, 3);
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> shake(-4e-7, 4e-7), move(-1, 1);
  for (int round = 0; round < 20; ++round) {
    TriangleSurface soup = soup_of(whole);
    const Vec3 shift(move(random), move(random), move(random));
    for (Vec3& p : soup.vertices) p += shift + Vec3(shake(random), shake(random), shake(random)) / 4;
    WeldFacts facts;
    const TriangleSurface welded = weld_soup(soup, 1e-6, facts);
    EXPECT_EQ(welded.vertices.size(), whole.vertices.size());
    EXPECT_EQ(welded.triangles.size(), whole.triangles.size());
    EXPECT_EQ(facts.vertices_before, 3 * whole.triangles.size());
    EXPECT_TRUE(analyse_topology(welded).closed());
  }
}

TEST(SoupWeld, LeavesApartWhatIsApart) {
  const TriangleSurface whole = sphere(Vec3::Zero(), 0.05, 2);
  WeldFacts facts;
  const TriangleSurface same = weld_soup(whole, 1e-7, facts);
  EXPECT_EQ(same.vertices.size(), whole.vertices.size());
  EXPECT_EQ(facts.collapsed + facts.repeated + facts.opposed, 0U);
}

TEST(SoupWeld, CountsWhatItDrops) {
  TriangleSurface surface = sphere(Vec3::Zero(), 0.05, 2);
  const auto first = surface.triangles[0], second = surface.triangles[1];
  surface.triangles.push_back({first[0], first[0], first[1]});
  surface.triangles.push_back({first[1], first[2], first[0]});  // the same one begun elsewhere
  surface.triangles.push_back(second);
  WeldFacts facts;
  const TriangleSurface welded = weld_soup(surface, 1e-7, facts);
  EXPECT_EQ(facts.collapsed, 1U);
  EXPECT_EQ(facts.repeated, 2U);
  EXPECT_EQ(welded.triangles.size(), 128U);
}

TEST(SoupWeld, WallsWithinTwoBoxesVanish) {
  const TriangleSurface left = box(Vec3(0, 0, 0), Vec3(1, 1, 1)), right = box(Vec3(1, 0, 0), Vec3(2, 1, 1));
  WeldFacts facts;
  const TriangleSurface both = weld_soup(joined(left, right), 1e-6, facts);
  EXPECT_EQ(facts.opposed, 4U);
  EXPECT_EQ(both.triangles.size(), 20U);
  EXPECT_NEAR(both.volume_m3(), 2, 1e-9);
  EXPECT_TRUE(analyse_topology(both).closed());
}

TEST(SoupWeld, DoubleSidedExportsKeepOneSide) {
  TriangleSurface twice = sphere(Vec3::Zero(), 0.05, 2);
  const auto once = twice.triangles;
  for (const auto& [a, b, c] : once) twice.triangles.push_back({a, c, b});
  WeldFacts facts;
  const TriangleSurface welded = weld_soup(twice, 1e-7, facts);
  EXPECT_TRUE(facts.double_sided);
  EXPECT_EQ(welded.triangles.size(), once.size());
}

TEST(SoupWeld, ManyPointsInOneCellStayQuick) {
  TriangleSurface surface;
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> near(0, 1e-6);
  for (int n = 0; n < 200000; ++n) surface.vertices.emplace_back(near(random), near(random), near(random));
  surface.vertices.emplace_back(1, 1, 1);  // one far point makes all the others neighbours
  for (std::int32_t n = 0; n + 2 < 200000; n += 3) surface.triangles.push_back({n, n + 1, n + 2});
  WeldFacts facts;
  EXPECT_LT(weld_soup(surface, 1e-6, facts).vertices.size(), 64U);
}

TEST(Winding, TurnsEveryMixtureOutwards) {
  const TriangleSurface outward = joined(sphere(Vec3::Zero(), 0.05, 2), box(Vec3(0.1, 0, 0), Vec3(0.2, 0.1, 0.1)));
  std::mt19937_64 random(7);
  for (int round = 0; round < 10; ++round) {
    TriangleSurface mixed = outward;
    std::size_t wrong = 0, turned = 0;
    for (auto& triangle : mixed.triangles)
      if (random() % 2 == 0) std::swap(triangle[1], triangle[2]), ++wrong;
    EXPECT_TRUE(wind_outward(mixed, turned));
    EXPECT_EQ(turned, wrong);
    EXPECT_NEAR(mixed.volume_m3(), outward.volume_m3(), 1e-12);
    EXPECT_EQ(analyse_topology(mixed).misoriented_edges, 0U);
  }
}

TEST(Winding, FarFromTheOriginToo) {
  TriangleSurface away = sphere(Vec3(1e4, -1e4, 1e4), 0.01, 2);
  for (auto& triangle : away.triangles) std::swap(triangle[1], triangle[2]);
  std::size_t turned = 0;
  EXPECT_TRUE(wind_outward(away, turned));
  EXPECT_EQ(turned, away.triangles.size());
}

/// A grid glued to itself with a twist: closed, without an inside.
TriangleSurface klein_bottle() {
  TriangleSurface surface;
  constexpr int n = 8;
  const auto index = [](int i, int j) {
    if (i == n) j = n - j, i = 0;
    return static_cast<std::int32_t>(i * n + (j + n) % n);
  };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) surface.vertices.emplace_back(i, j, i * j % 3);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      surface.triangles.push_back({index(i, j), index(i + 1, j), index(i + 1, j + 1)});
      surface.triangles.push_back({index(i, j), index(i + 1, j + 1), index(i, j + 1)});
    }
  return surface;
}

TEST(Winding, OneSidedSurfacesAreToldApart) {
  TriangleSurface bottle = klein_bottle();
  const SurfaceTopology facts = analyse_topology(bottle);
  ASSERT_TRUE(facts.closed() && facts.nonmanifold_edges == 0);
  std::size_t turned = 0;
  EXPECT_FALSE(wind_outward(bottle, turned));
}

TEST(Winding, SolidAnglesTellInsideFromOutside) {
  const TriangleSurface ball = sphere(Vec3(0.1, 0, 0), 0.05, 3);
  EXPECT_TRUE(encloses(ball, Vec3(0.1, 0, 0)));
  EXPECT_TRUE(encloses(ball, Vec3(0.14, 0.005, 0)));
  EXPECT_FALSE(encloses(ball, Vec3(0.16, 0, 0)));
  EXPECT_FALSE(encloses(ball, Vec3::Zero()));
}

TEST(Tetrahedra, OuterSurfaceOfAStarIsItsSurface) {
  const TriangleSurface shell = sphere(Vec3(0.2, 0, 0), 0.05, 2);
  FileTetrahedra mesh = star_of(shell);
  EXPECT_EQ(make_positive(mesh), 0U);
  const TriangleSurface outside = outer_surface(mesh);
  EXPECT_EQ(outside.triangles.size(), shell.triangles.size());
  EXPECT_NEAR(outside.volume_m3(), shell.volume_m3(), 1e-12);
  for (auto& t : mesh.tetrahedra) std::swap(t[1], t[2]);
  EXPECT_EQ(make_positive(mesh), mesh.tetrahedra.size());
  EXPECT_NEAR(outer_surface(mesh).volume_m3(), shell.volume_m3(), 1e-12);
}

TEST(Tetrahedra, RegionsHaveSurfacesOfTheirOwn) {
  FileTetrahedra mesh = star_of(box(Vec3::Zero(), Vec3::Ones()));
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) mesh.regions.push_back(t < 4 ? 0 : 1);
  const double first = outer_surface(mesh, 0).volume_m3(), second = outer_surface(mesh, 1).volume_m3();
  EXPECT_NEAR(first, 4.0 / 12, 1e-12);
  EXPECT_NEAR(first + second, 1, 1e-12);
  EXPECT_TRUE(outer_surface(mesh, 2).triangles.empty());
  EXPECT_TRUE(analyse_topology(outer_surface(mesh, 0)).closed());
}

template <typename Stored>
void expect_stored(NumberType type, const std::vector<Stored>& values) {
  for (const bool big_endian : {false, true}) {
    std::string raw;
    for (const Stored value : values) put(raw, value, big_endian);
    EXPECT_EQ(bytes_of(type), sizeof(Stored));
    const auto reals = stored_reals(raw, type, big_endian);
    ASSERT_EQ(reals.size(), values.size());
    for (std::size_t n = 0; n < values.size(); ++n) EXPECT_EQ(reals[n], static_cast<double>(values[n]));
    if (!is_whole(type)) continue;
    const auto wholes = stored_wholes(raw, type, big_endian);
    for (std::size_t n = 0; n < values.size(); ++n) EXPECT_EQ(wholes[n], static_cast<std::int64_t>(values[n]));
  }
}

TEST(StoredNumbers, TenTypesInTwoOrders) {
  expect_stored<std::int8_t>(NumberType::kInt8, {-128, -1, 0, 127});
  expect_stored<std::uint8_t>(NumberType::kUint8, {0, 200, 255});
  expect_stored<std::int16_t>(NumberType::kInt16, {-30000, 513});
  expect_stored<std::uint16_t>(NumberType::kUint16, {1, 65535});
  expect_stored<std::int32_t>(NumberType::kInt32, {-2000000000, 66051});
  expect_stored<std::uint32_t>(NumberType::kUint32, {4000000000U, 1});
  expect_stored<std::int64_t>(NumberType::kInt64, {-5, 1LL << 50});
  expect_stored<std::uint64_t>(NumberType::kUint64, {7, 1ULL << 52});
  expect_stored<float>(NumberType::kFloat32, {1.5F, -2e30F});
  expect_stored<double>(NumberType::kFloat64, {0.1, -1e300});
}

TEST(StoredNumbers, PointsMustBeFinite) {
  EXPECT_EQ(points_from({1, 2, 3, 4, 5, 6}, "f").at(1), Vec3(4, 5, 6));
  EXPECT_CONTAINS(message_of<InputError>([] {
                    points_from({1, 2, 3, 4, std::nan(""), 6}, "f");
                  }),
                  "vertex 1 is not finite");
  EXPECT_THROW(points_from({1, 2, 1e30}, "f"), InputError);
}

}  // namespace
}  // namespace trocar::surface_parts_test
