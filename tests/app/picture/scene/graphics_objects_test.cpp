// Scene objects: their meshes are what they say, and the picture shows them where they are and as what they are.
#include <algorithm>
#include <cmath>

#include "app/picture/models/instrument_model.h"
#include "app/picture/models/loft.h"
#include "app/picture/models/solid_models.h"
#include "app/picture/scene/backdrop.h"
#include "app/picture/scene/scope_optics.h"
#include "tests/support/board_scene.h"
#include "tests/support/headless_fixture.h"
#include "tests/support/picture_probe.h"

namespace trocar::graphics_objects_test {
namespace {

using namespace testing_support;
using Shape = SceneObject::Shape;
using Style = SceneObject::Style;

Vec3 position(const PictureVertex& v) { return {v.position[0], v.position[1], v.position[2]}; }
Vec3 normal(const PictureVertex& v) { return {v.normal[0], v.normal[1], v.normal[2]}; }

Eigen::AlignedBox3d bounds(const PictureMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const PictureVertex& v : mesh.vertices) box.extend(position(v));
  return box;
}

/// Volume by the divergence theorem: positive when the mesh is closed and wound outwards.
double volume(const PictureMesh& mesh) {
  double six = 0;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
    six += position(mesh.vertices[mesh.indices[i]])
               .dot(position(mesh.vertices[mesh.indices[i + 1]]).cross(position(mesh.vertices[mesh.indices[i + 2]])));
  return six / 6;
}

/// Share of triangles whose winding agrees with their vertices' normals.
double agreement(const PictureMesh& mesh) {
  int good = 0, all = 0;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const PictureVertex &a = mesh.vertices[mesh.indices[i]], &b = mesh.vertices[mesh.indices[i + 1]],
                        &c = mesh.vertices[mesh.indices[i + 2]];
    const Vec3 n = (position(b) - position(a)).cross(position(c) - position(a));
    if (n.norm() < 1e-13) continue;
    ++all;
    good += n.dot(normal(a) + normal(b) + normal(c)) > 0;
  }
  return static_cast<double>(good) / all;
}

struct Wanted {
  Shape shape;
  Vec3 size, low, high;  ///< m, bounds in O
  double volume_m3;
};

TEST(SolidModels, HaveTheirSizeVolumeAndOutwardWinding) {
  const double pi = std::numbers::pi;
  const Wanted cases[] = {
      {Shape::kBox, {0.014, 0.014, 0.020}, {-0.007, -0.007, -0.010}, {0.007, 0.007, 0.010}, 0.014 * 0.014 * 0.020},
      {Shape::kCylinder, {0.010, 0, 0.030}, {-0.005, -0.005, -0.015}, {0.005, 0.005, 0.015}, pi * 25e-6 * 0.030},
      {Shape::kRing, {0.020, 0, 0.002}, {-0.010, -0.010, -0.001}, {0.010, 0.010, 0.001}, 2 * pi * pi * 0.009 * 1e-6},
      {Shape::kSphere, {0.010, 0, 0}, {-0.005, -0.005, -0.005}, {0.005, 0.005, 0.005}, 4.0 / 3 * pi * 125e-9},
      {Shape::kClip,
       {0.0012, 0.0004, 0.0085},
       {-0.0006, -0.001, -0.0085},
       {0.0006, 0.001, 0},
       0.0012 * (2 * 0.0008 * 0.0085 + 0.0004 * 0.0008)},
      {Shape::kBoard, {0.1, 0.08, 0.004}, {-0.05, -0.04, -0.004}, {0.05, 0.04, 0}, 0.1 * 0.08 * 0.004},
  };
  for (const Wanted& wanted : cases) {
    const PictureMesh mesh = build_solid(wanted.shape, wanted.size);
    const Eigen::AlignedBox3d box = bounds(mesh);
    const int name = static_cast<int>(wanted.shape);
    // 2 %: circles are polygons of 24 and more corners.
    EXPECT_LT((box.min() - wanted.low).norm(), 0.02 * wanted.size.norm()) << name;
    EXPECT_LT((box.max() - wanted.high).norm(), 0.02 * wanted.size.norm()) << name;
    EXPECT_NEAR(volume(mesh) / wanted.volume_m3, 1, 0.06) << name << ": edges are rounded, circles are polygons";
    EXPECT_GT(agreement(mesh), 0.99) << name;
  }
}

TEST(SolidModels, APenPointsLikeTheInstrumentAndShowsItsRoll) {
  const PictureMesh pen = build_solid(Shape::kPen, {0.005, 0, 0.060});
  const Eigen::AlignedBox3d box = bounds(pen);
  EXPECT_NEAR(box.max().z(), 0, 1e-6) << "tip at the origin";
  EXPECT_NEAR(box.min().z(), -0.060, 1e-6);
  EXPECT_NEAR(box.max().x(), 0.0025, 1e-4) << "5 mm shaft";
  EXPECT_GT(box.max().y(), 1.6 * 0.0025) << "the fin stands out to +y";
  EXPECT_NEAR(box.min().y(), -0.0025, 1e-4) << "and only there";
  double tip_accent = 0, middle_accent = 1;
  for (const PictureVertex& v : pen.vertices) {
    if (position(v).z() > -0.001) tip_accent = std::max<double>(tip_accent, v.light[1]);
    if (std::abs(position(v).z() + 0.030) < 0.012 && position(v).y() < 0.002) middle_accent = v.light[1];
  }
  EXPECT_EQ(tip_accent, 1);
  EXPECT_GT(agreement(pen), 0.98);
  EXPECT_GE(middle_accent, 0);
}

TEST(SolidModels, ASleeveIsOpenForTheInstrument) {
  const PictureMesh sleeve = build_solid(Shape::kSleeve, {0.0055, 0, 0.050});
  for (const PictureVertex& v : sleeve.vertices) EXPECT_GE(position(v).head<2>().norm(), 0.5 * 0.0055 - 1e-6);
  const Eigen::AlignedBox3d box = bounds(sleeve);
  EXPECT_LE(box.max().z(), 1e-9) << "the inner end";
  EXPECT_LT(box.min().z(), -0.050) << "the head lies outside the wall";
  EXPECT_GT(box.max().x(), 2 * 0.5 * 0.0055) << "the head is wider than the tube";
}

TEST(SolidModels, ATurnedProfileFacesOutwardsWhenItRunsUp) {
  const PictureMesh up = turned({{0, 0.01, 0}, {0.02, 0.01, 1}}, 12),
                    down = turned({{0.02, 0.01, 1}, {0, 0.01, 0}}, 12);
  for (const PictureVertex& v : up.vertices) EXPECT_GT(normal(v).dot(position(v)), 0.009);
  for (const PictureVertex& v : down.vertices) EXPECT_LT(normal(v).dot(position(v)), -0.009);
  EXPECT_EQ(up.vertices.front().light[1], 0.0F);
  EXPECT_EQ(up.vertices.back().light[1], 1.0F);
}

TEST(FoamClasses, DifferInBandsNotOnlyInColour) {
  for (std::size_t i = 0; i < foam_classes().size(); ++i) {
    EXPECT_EQ(foam_classes()[i].bands, static_cast<int>(i) + 1);
    for (std::size_t j = 0; j < i; ++j) EXPECT_GT((foam_classes()[i].colour - foam_classes()[j].colour).norm(), 0.25);
  }
}

TEST(TrainerBox, LiesUnderTheStageAndRisesRoundIt) {
  const Eigen::AlignedBox3d stage(Vec3(-0.05, -0.05, -0.004), Vec3(0.05, 0.05, 0.05));
  const PictureMesh box = build_trainer_box(stage);
  double highest = -1;
  for (const PictureVertex& v : box.vertices) {
    const Vec3 p = position(v);
    if (p.head<2>().cwiseAbs().maxCoeff() < 0.05) {
      EXPECT_LT(p.z(), stage.min().z() + 1e-4) << p.transpose();
    }
    highest = std::max(highest, p.z());
    EXPECT_GT(normal(v).dot(Vec3(0, 0, 0.4) - p), 0) << "faces the inside " << p.transpose();
  }
  EXPECT_GT(highest, 0.15);
  EXPECT_GT(agreement(box), 0.99);
}

class ObjectPicture : public HeadlessFixture {
 protected:
  static constexpr int kWidth = 640, kHeight = 400;
  void SetUp() override {
    HeadlessFixture::SetUp();
    if (!IsSkipped()) renderer_.emplace(make_renderer());
  }
  static SceneView board() {
    SceneView view = empty_board();
    view.X_TI.p += Vec3(0.3, 0, 0.3);  // out of the way
    return view;
  }
  Image draw(const SceneView& view) { return renderer_->render(view, kWidth, kHeight); }
  static Eigen::Vector2d at(const SceneView& view, const Vec3& point_T) {
    const auto pixel = ScopeOptics(view.camera, {0, 0, kWidth, kHeight}).project(point_T);
    return pixel.value_or(Eigen::Vector2d(kWidth / 2.0, kHeight / 2.0));
  }
  std::optional<Renderer> renderer_;
};

TEST_F(ObjectPicture, BlocksAppearWhereTheyStandInTheirColours) {
  SceneView view = board();
  const Image empty = draw(view);
  const Vec3 places[3] = {{-0.025, 0.01, 0.010}, {0, 0.01, 0.010}, {0.025, 0.01, 0.010}};
  for (std::size_t i = 0; i < 3; ++i) view.objects.push_back(foam_block(places[i], i));
  const Image image = draw(view);
  Pixel seen[3];
  for (std::size_t i = 0; i < 3; ++i) {
    seen[i] = mean_at(image, at(view, places[i] + Vec3(0, -0.007, -0.003)), 4);
    EXPECT_GT(distance(seen[i], mean_at(empty, at(view, places[i] + Vec3(0, -0.007, -0.003)), 4)), 40) << i;
  }
  EXPECT_GT(seen[0][0], 1.5 * seen[0][2]) << "gentlest: yellow";
  EXPECT_GT(seen[1][2], 1.3 * seen[1][0]) << "middle: blue";
  EXPECT_GT(seen[2][0], 1.2 * seen[2][1]) << "firmest: purple";
}

TEST_F(ObjectPicture, ARingLeavesItsMiddleFree) {
  SceneView view = board();
  view.objects[0].accent = view.objects[0].colour;  // no lines, which shine through a ring's middle too
  const Image empty = draw(view);
  view.objects.push_back(target_ring({0, -0.005, 0}, {0.6, 0.25, 0.02}));
  const Image image = draw(view);
  EXPECT_LT(distance(mean_at(image, at(view, {0, -0.005, 0}), 3), mean_at(empty, at(view, {0, -0.005, 0}), 3)), 12);
  EXPECT_GT(changed(image, empty, 24), 150);
}

TEST_F(ObjectPicture, TheBoardCarriesAGrid) {
  SceneView view = board();
  const Image lined = draw(view);
  view.objects[0].accent = view.objects[0].colour;
  EXPECT_GT(changed(lined, draw(view), 12), 2000);
}

TEST_F(ObjectPicture, AGhostLetsTheBoardShineThroughAndASolidDoesNot) {
  SceneView view = board();
  const Image empty = draw(view);
  SceneObject pen = ghost_pen({-0.020, 0, 0.012}, {1, 0, 0.02}, Style::kGhostLit);
  view.objects.push_back(pen);
  const Vec3 middle(0.006, 0, 0.012);
  const Image ghost = draw(view);
  view.objects.back().style = Style::kSolid;
  view.objects.back().colour = Vec3(1.0, 0.84, 0.03);
  const Image solid = draw(view);
  const Pixel board_there = mean_at(empty, at(view, middle), 1), ghost_there = mean_at(ghost, at(view, middle), 1),
              solid_there = mean_at(solid, at(view, middle), 1);
  EXPECT_GT(distance(ghost_there, board_there), 20);
  EXPECT_LT(distance(ghost_there, board_there), 0.8 * distance(solid_there, board_there));
}

TEST_F(ObjectPicture, GhostStatesDifferAndOnlyTheLitOnePulses) {
  SceneView view = board();
  view.objects.push_back(ghost_pen({-0.020, 0, 0.012}, {1, 0, 0.02}, Style::kGhost));
  const auto drawn = [&](Style style, double time) {
    view.objects.back().style = style;
    view.hud.elapsed_s = time;
    return draw(view);
  };
  const Image waiting = drawn(Style::kGhost, 0.25), lit = drawn(Style::kGhostLit, 0.25),
              done = drawn(Style::kGhostDone, 0.25);
  EXPECT_GT(changed(waiting, lit, 24), 300);
  EXPECT_GT(changed(done, lit, 24), 300);
  EXPECT_GT(changed(done, waiting, 12), 200);
  EXPECT_GT(changed(lit, drawn(Style::kGhostLit, 0.75), 8), 100);
  EXPECT_EQ(changed(waiting, drawn(Style::kGhost, 0.75), 2), 0);
  EXPECT_EQ(changed(done, drawn(Style::kGhostDone, 0.75), 2), 0);
}

TEST_F(ObjectPicture, RollOfAPenIsSeen) {
  SceneView view = board();
  view.objects.push_back(ghost_pen({-0.010, 0, 0.020}, {0.3, 0, 1}, Style::kGhostLit));
  const Image one = draw(view);
  SceneObject& pen = view.objects.back();
  pen.X_TO.R = pen.X_TO.R * Eigen::AngleAxisd(0.5 * std::numbers::pi, Vec3::UnitZ()).toRotationMatrix();
  EXPECT_GT(changed(one, draw(view), 24), 80);
}

TEST_F(ObjectPicture, ALiftedBlockDimsTheBoardLessThanARestingOne) {
  SceneView view = board();
  view.objects[0].accent = view.objects[0].colour;
  const Image empty = draw(view);
  const Vec3 beside(0.011, -0.004, 0);  // bare board to the right of the block
  const auto dimmed = [&](double height) {
    view.objects.resize(1);
    view.objects.push_back(foam_block({0, 0, height}, 1));
    return mean_at(empty, at(view, beside), 2)[1] - mean_at(draw(view), at(view, beside), 2)[1];
  };
  const double resting = dimmed(0.010), lifted = dimmed(0.040);
  EXPECT_GT(resting, 3.5);  // of 255; without grain the picture is exact
  EXPECT_GT(resting, lifted);
}

TEST_F(ObjectPicture, APinchedBlockIsNarrowerBetweenTheJaws) {
  SceneView view = board();
  view.objects.push_back(foam_block({0, 0, 0.010}, 0));
  view.objects.back().pinch_O = Vec3::UnitX();
  const auto width = [&](double depth) {
    view.objects.back().pinch_depth_m = depth;
    const Image image = draw(view);
    const Eigen::Vector2d middle = at(view, {0, -0.007, 0.010});
    int n = 0;
    for (int x = static_cast<int>(middle.x()) - 60; x < static_cast<int>(middle.x()) + 60; ++x) {
      const std::uint8_t* p = image.pixel(x, static_cast<int>(middle.y()));
      n += p[0] > 1.4 * p[2] && p[0] > 40;
    }
    return n;
  };
  const int whole = width(0), pinched = width(0.006);
  EXPECT_GT(whole, 20);
  EXPECT_LT(pinched, whole - 3);
}

TEST_F(ObjectPicture, ACrushedBlockLooksSpent) {
  SceneView view = board();
  view.objects.push_back(foam_block({0, 0, 0.010}, 0));
  const Image fresh = draw(view);
  view.objects.back().wear = 1;
  const Image crushed = draw(view);
  const Eigen::Vector2d face = at(view, {0, -0.007, 0.007});
  EXPECT_LT(mean_at(crushed, face, 6)[0], 0.85 * mean_at(fresh, face, 6)[0]);
}

TEST_F(ObjectPicture, ALitBlockStandsOutAndPulses) {
  SceneView view = board();
  view.objects.push_back(foam_block({0, 0, 0.010}, 1));
  const Image plain = draw(view);
  view.objects.back().style = Style::kLit;
  view.hud.elapsed_s = 0.25;
  const Image lit = draw(view);
  EXPECT_GT(changed(plain, lit, 16), 150);
  view.hud.elapsed_s = 0.75;
  EXPECT_GT(changed(lit, draw(view), 6), 60);
}

TEST_F(ObjectPicture, TheRollStripeShowsWhichWayTheJawsOpen) {
  SceneView view = empty_board();
  const Image plain = draw(view);
  view.roll_stripe = true;
  view.X_TI.R = view.X_TI.R * Eigen::AngleAxisd(std::numbers::pi, Vec3::UnitZ()).toRotationMatrix();
  const Image away = draw(view);
  view.X_TI.R = view.X_TI.R * Eigen::AngleAxisd(std::numbers::pi, Vec3::UnitZ()).toRotationMatrix();
  EXPECT_GT(changed(plain, draw(view), 20) + changed(plain, away, 20), 100);
}

TEST_F(ObjectPicture, WithoutAnOrganTheTrainerFillsTheField) {
  SceneView view = board();
  const Image inside = draw(view);
  const ScopeOptics optics(view.camera, {0, 0, kWidth, kHeight});
  for (const double angle : {0.2, 1.2, 2.9, 4.0, 5.5}) {
    const Eigen::Vector2d p = Eigen::Vector2d(optics.circle_x(), optics.circle_y()) +
                              0.7 * optics.circle_radius() * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    if (p.y() < 4 || p.y() > kHeight - 4) continue;
    const Pixel seen = mean_at(inside, p, 2);
    EXPECT_GT(seen[0] + seen[1] + seen[2], 25) << angle;
  }
}

TEST_F(ObjectPicture, EarlierBoardsLeaveNoTrace) {
  const Image first = draw(pens_scene());
  draw(grasp_scene());
  draw(procedural_scene());
  EXPECT_EQ(draw(pens_scene()).rgb, first.rgb);
}

TEST_F(ObjectPicture, ManySizesDoNotConfuseTheMeshes) {
  SceneView view = board();
  view.objects.push_back(foam_block({0, 0, 0.010}, 0));
  const Image wanted = draw(view);
  SceneView crowd = board();
  for (int i = 0; i < 120; ++i) {
    crowd.objects.push_back(foam_block({0, 0, 0.010}, 1));
    crowd.objects.back().size_m *= 0.5 + 0.01 * i;
  }
  draw(crowd);
  EXPECT_EQ(draw(view).rgb, wanted.rgb);
}

}  // namespace
}  // namespace trocar::graphics_objects_test
