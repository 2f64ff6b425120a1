// What the picture adds to the collision surface: smoothing, occlusion, scenery, instrument, solid noise.
#include <gtest/gtest.h>

#include <cmath>

#include "app/picture/models/curved_subdivision.h"
#include "app/picture/models/instrument_model.h"
#include "app/picture/models/organ_scene.h"
#include "app/picture/models/picture_mesh.h"
#include "app/picture/models/solid_noise.h"
#include "app/picture/scene/backdrop.h"
#include "app/picture/scene/scope_optics.h"
#include "tests/support/procedural_scene.h"

namespace trocar::graphics_mesh_test {
namespace {

using testing_support::icosphere;

Vec3 position(const PictureVertex& v) { return {v.position[0], v.position[1], v.position[2]}; }
Vec3 normal(const PictureVertex& v) { return {v.normal[0], v.normal[1], v.normal[2]}; }

/// Share of triangles whose winding agrees with their vertices' normals.
double agreement(const PictureMesh& mesh) {
  int good = 0, all = 0;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const PictureVertex &a = mesh.vertices[mesh.indices[i]], &b = mesh.vertices[mesh.indices[i + 1]],
                        &c = mesh.vertices[mesh.indices[i + 2]];
    const Vec3 n = (position(b) - position(a)).cross(position(c) - position(a));
    if (n.norm() < 1e-14) continue;
    ++all;
    good += n.dot(normal(a) + normal(b) + normal(c)) > 0;
  }
  return static_cast<double>(good) / all;
}

TriangleSurface once_finer(const TriangleSurface& coarse) {
  return CurvedSubdivision(coarse, 4 * coarse.triangles.size()).fine();
}

TEST(CurvedSubdivision, BringsACoarseSphereNearerToTheSphere) {
  const TriangleSurface coarse = icosphere(1), fine = once_finer(coarse);
  EXPECT_EQ(fine.triangles.size(), 4 * coarse.triangles.size());
  const double exact = 4.0 / 3.0 * std::numbers::pi;
  EXPECT_LT(std::abs(fine.volume_m3() - exact), 0.55 * std::abs(coarse.volume_m3() - exact));
}

TEST(CurvedSubdivision, KeepsCornersAndAClosedSurface) {
  const TriangleSurface coarse = icosphere(2), fine = once_finer(coarse);
  for (std::size_t i = 0; i < coarse.vertices.size(); ++i) EXPECT_EQ(fine.vertices[i], coarse.vertices[i]);
  std::map<std::pair<int, int>, int> edges;
  for (const auto& t : fine.triangles)
    for (std::size_t k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
  for (const auto& [edge, count] : edges) {
    ASSERT_EQ(count, 1);
    ASSERT_EQ(edges.count({edge.second, edge.first}), 1U);
  }
}

TEST(CurvedSubdivision, AMovedOneIsWhatTheMovedSurfaceIsRefinedTo) {
  const TriangleSurface coarse = icosphere(2);
  TriangleSurface bent = coarse;
  for (Vec3& v : bent.vertices) v.z() += 0.4 * v.x() * v.x() + 0.1;
  CurvedSubdivision twice(coarse, 16 * coarse.triangles.size());
  const TriangleSurface& moved = twice.move(bent.vertices);
  EXPECT_EQ(moved.vertices, CurvedSubdivision(bent, 16 * bent.triangles.size()).fine().vertices);
  EXPECT_EQ(twice.move(coarse.vertices).vertices,
            CurvedSubdivision(coarse, 16 * coarse.triangles.size()).fine().vertices);
  EXPECT_THROW(twice.move({Vec3::Zero()}), std::invalid_argument);
}

TEST(CurvedSubdivision, NumbersAtTheVerticesAreMeansBetweenThem) {
  const TriangleSurface triangle{{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}, {{{0, 1, 2}}}};
  const std::vector<float> fine = CurvedSubdivision(triangle, 4).spread({0, 1, 0.5F});
  EXPECT_EQ(fine, (std::vector<float>{0, 1, 0.5F, 0.5F, 0.75F, 0.25F}));
}

/// Openness of a surface by itself.
std::vector<float> openness_of(const TriangleSurface& surface) {
  return bake_openness(surface, surface.vertex_normals(), SolidGrid(surface));
}

TEST(Openness, IsFullOnASphereAndLowInAPit) {
  for (const float open : openness_of(icosphere(4))) EXPECT_GT(open, 0.8F);
  TriangleSurface pitted = icosphere(5);
  std::size_t deepest = 0;
  for (std::size_t i = 0; i < pitted.vertices.size(); ++i) {
    Vec3& v = pitted.vertices[i];
    const double r = std::hypot(v.x(), v.y());
    if (v.z() > 0) v *= 1 - 0.55 * std::exp(-r * r / 0.02);
    if (v.z() > 0 && r < std::hypot(pitted.vertices[deepest].x(), pitted.vertices[deepest].y())) deepest = i;
  }
  EXPECT_LT(openness_of(pitted)[deepest], 0.5F);
}

PictureMesh built(const TriangleSurface& surface, std::size_t max_triangles) {
  const TriangleSurface fine = CurvedSubdivision(surface, max_triangles).fine();
  return bake_picture_mesh(fine, SolidGrid(fine));
}

TEST(PictureMeshBuild, StaysWithinItsTriangleBudget) {
  const PictureMesh mesh = built(testing_support::lumpy_ellipsoid({0.09, 0.07, 0.04}), 36000);
  EXPECT_LE(mesh.indices.size() / 3, 36000U);
  EXPECT_GE(mesh.indices.size() / 3, 9000U);
  EXPECT_DOUBLE_EQ(agreement(mesh), 1.0);
}

TEST(PictureMeshBuild, TurnsAnInsideOutSurfaceRight) {
  TriangleSurface inverted = icosphere(3);
  for (auto& t : inverted.triangles) std::swap(t[1], t[2]);
  for (const PictureVertex& v : built(inverted, 1280).vertices) EXPECT_GT(position(v).dot(normal(v)), 0.9);
}

TEST(PictureMeshBuild, FindsTheTrianglesNearATarget) {
  const PictureMesh mesh = built(icosphere(4), 5120);
  const Vec3 pole = Vec3::UnitZ();
  const auto near = triangles_near(mesh, pole, 0.2);
  ASSERT_GT(near.size(), 30U);
  EXPECT_LT(near.size(), mesh.indices.size() / 20);
  for (const auto index : near) EXPECT_LT((position(mesh.vertices[index]) - pole).norm(), 0.4);
}

TEST(SolidNoise, TilesWithoutASeam) {
  for (double t = 0; t < 8; t += 0.37) {
    EXPECT_NEAR(gradient_noise(t, 1.3, 2.7, 8), gradient_noise(t + 8, 1.3, 2.7 - 8, 8), 1e-5);
    EXPECT_LE(std::abs(gradient_noise(t, 3 * t, 1.7, 8)), 1.05);
  }
}

TEST(SolidNoise, UsesTheRangeOfItsTexelsAndIsReproducible) {
  const auto texels = solid_noise_texture(32);
  ASSERT_EQ(texels.size(), 32U * 32 * 32 * 4);
  EXPECT_EQ(texels, solid_noise_texture(32));
  double sum = 0, squares = 0;
  for (std::size_t i = 3; i < texels.size(); i += 4) {
    sum += texels[i];
    squares += texels[i] * static_cast<double>(texels[i]);
  }
  const double n = static_cast<double>(texels.size()) / 4, mean = sum / n;
  EXPECT_NEAR(mean, 127.5, 12);
  EXPECT_GT(std::sqrt(squares / n - mean * mean), 18);
}

TEST(Instrument, JawsMeetAtTheTipWhenClosedAndOpenAsAsked) {
  const Vec3 tip(0, 0, kJawLength_m);
  for (const int side : {1, -1}) EXPECT_LT((jaw_pose(side, 0) * tip).norm(), 1e-12);
  for (const double opening : {0.002, 0.006, 0.012}) {
    const Vec3 upper = jaw_pose(1, opening) * tip, lower = jaw_pose(-1, opening) * tip;
    EXPECT_NEAR((upper - lower).norm(), opening, 1e-12);
    EXPECT_GT(upper.y(), lower.y());
    EXPECT_NEAR(upper.z(), lower.z(), 1e-12);
  }
}

TEST(Instrument, PartsFaceOutwardsAndKeepTheShaftsRadius) {
  const PictureMesh shaft = build_shaft(0.0025, 0.3), jaw = build_jaw(InstrumentKind::kGrasper, 0.0025);
  EXPECT_GT(agreement(shaft), 0.99);
  EXPECT_GT(agreement(jaw), 0.97);
  for (const PictureVertex& v : shaft.vertices) EXPECT_LE(position(v).head<2>().norm(), 0.0025 + 1e-8);
  for (const PictureVertex& v : jaw.vertices)
    EXPECT_GE(v.position[1], -1e-9F);  // the lower half belongs to the other jaw
}

TEST(Instrument, EachKindIsAModelOfItsOwnThatEndsAtTheTip) {
  for (const InstrumentDescription& known : kInstruments) {
    SCOPED_TRACE(known.name);
    const PictureMesh body = build_body(known.kind, 0.0025, 0.3), jaw = build_jaw(known.kind, 0.0025);
    EXPECT_GT(agreement(body), 0.97);
    const double as_felt_m = known.kind == InstrumentKind::kProbe ? describe(InstrumentKind::kGrasper).jaw_length_m
                                                                  : known.jaw_length_m;  // it looks like a grasper
    EXPECT_EQ(jaw.vertices.empty(), as_felt_m == 0);
    EXPECT_NEAR(drawn_jaw_length_m(known.kind), as_felt_m, 1.1e-3);
    EXPECT_TRUE(jaw.vertices.empty() || agreement(jaw) > 0.95);
    double front = -1;
    for (const PictureVertex& v : body.vertices) front = std::max(front, position(v).z());
    for (const PictureVertex& v : jaw.vertices)
      front = std::max(front, position(v).z() - drawn_jaw_length_m(known.kind));
    EXPECT_GE(front, -1e-6);
    EXPECT_LE(front, 0.0025) << "no further than the sphere that touches";
  }
}

TEST(Backdrop, CavityFacesInwardsAndHoldsTheOrgan) {
  const Eigen::AlignedBox3d organ(Vec3(-0.1, -0.07, -0.09), Vec3(0.1, 0.07, 0.0));
  const PictureMesh cavity = build_cavity(organ);
  for (const PictureVertex& v : cavity.vertices) EXPECT_FALSE(organ.contains(position(v)));
  EXPECT_GT(agreement(cavity), 0.97);
  int inwards = 0;
  for (const PictureVertex& v : cavity.vertices) inwards += normal(v).dot(organ.center() - position(v)) > 0;
  EXPECT_GT(inwards, static_cast<int>(0.97 * static_cast<double>(cavity.vertices.size())));
}

TEST(Backdrop, FatLiesLowAndFacesUp) {
  const Eigen::AlignedBox3d organ(Vec3(-0.1, -0.07, -0.09), Vec3(0.1, 0.07, 0.0));
  for (const PictureVertex& v : build_fat_bed(organ).vertices) {
    if (organ.contains(Vec3(v.position[0], v.position[1], organ.center().z()))) {
      EXPECT_LT(v.position[2], organ.center().z());
    }
    EXPECT_GT(v.normal[2], -0.2F);
  }
}

TEST(OrganPortrait, ShowsTheWholeOrganAndSaysWhenItIsSynthetic) {
  Organ organ;
  organ.name = "liver";
  organ.material = "liver";
  organ.synthetic = true;
  organ.licence = "CC0-1.0";
  organ.surface = testing_support::lumpy_ellipsoid({0.09, 0.05, 0.07});
  const SceneView view = organ_scene(organ);
  EXPECT_LT(view.organ->bounds().center().norm(), 1e-9);
  EXPECT_NEAR(view.organ->bounds().sizes().z(), organ.surface.bounds().sizes().y(), 1e-9);  // anterior is up
  EXPECT_NE(view.hud.credit.find("synthetic"), std::string::npos);
  EXPECT_NE(view.hud.credit.find("CC0-1.0"), std::string::npos);
  EXPECT_FALSE(view.organ->bounds().contains(view.camera.eye_T));
  const ScopeOptics optics(view.camera, {0, 0, 1280, 720});
  std::size_t seen = 0;
  for (const Vec3& v : view.organ->vertices) seen += optics.project(v).has_value();
  EXPECT_GT(seen, view.organ->vertices.size() * 95 / 100);
}

}  // namespace
}  // namespace trocar::graphics_mesh_test
