// Marks of the view that no field makes, looked for in the pixels: crevices tinted red, vessels, barrel, haze.
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "app/picture/scene/scope_optics.h"
#include "tests/support/headless_fixture.h"
#include "tests/support/picture_probe.h"
#include "tests/support/procedural_scene.h"

namespace trocar::graphics_marks_test {
namespace {

using testing_support::mean_at;
using testing_support::Pixel;
using testing_support::top_of;

constexpr int kWidth = 960, kHeight = 540;

double brightness(const Pixel& p) { return (p[0] + p[1] + p[2]) / 3; }
double redness(const Pixel& p) { return p[0] / p[1]; }

class MarksOfTheView : public testing_support::HeadlessFixture {
 protected:
  void SetUp() override {
    HeadlessFixture::SetUp();
    if (IsSkipped()) return;
    renderer_.emplace(make_renderer());
    look_at("liver");
  }
  void look_at(const std::string& material) {
    view_ = testing_support::procedural_scene();
    view_.material = material;
    view_.hud = Hud{};
    view_.dimple_T.reset();
    view_.targets.clear();
    view_.X_TI.p += Vec3(0.3, 0, 0.3);  // out of the way
  }
  void preset(Preset preset) {
    renderer_->set_options({.text_scale = 1, .scene_scale = 1, .grain = false, .preset = preset});
  }
  Image draw() { return renderer_->render(view_, kWidth, kHeight); }
  ScopeOptics optics() const { return ScopeOptics(view_.camera, {0, 0, kWidth, kHeight}); }
  Eigen::Vector2d pixel(const Vec3& at) const { return *optics().project(at); }

  SceneView view_;
  std::optional<Renderer> renderer_;
};

// ---- barrel

/// Middle of the pixels in which two pictures differ.
Eigen::Vector2d middle_of_change(const Image& a, const Image& b) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  int n = 0;
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x) {
      if (std::abs(a.pixel(x, y)[0] - b.pixel(x, y)[0]) <= 24) continue;
      sum += Eigen::Vector2d(x + 0.5, y + 0.5);
      ++n;
    }
  EXPECT_GT(n, 30);
  return sum / std::max(n, 1);
}

TEST_F(MarksOfTheView, BarrelMovesWhatIsDrawnOutwardsAsTheOpticsSay) {
  const Image plain = draw();
  const Camera& camera = view_.camera;
  for (const auto& [x, y] :
       {std::pair{0.045, -0.010}, std::pair{-0.055, -0.005}, std::pair{0.030, 0.020}, std::pair{-0.040, 0.015}}) {
    const auto [at, normal] = top_of(*view_.organ, x, y);
    view_.targets = {{at, normal, 0.0022, TargetMark::State::kDone}};
    const Eigen::Vector2d seen = middle_of_change(plain, draw());
    const Eigen::Vector2d centre(optics().circle_x(), optics().circle_y());
    // The same point through a lens without barrel, whose rim is the same.
    const Vec3 way = at - optics().eye();
    const double scale =
        optics().circle_radius() / (way.dot(optics().forward()) * std::tan(camera.diagonal_fov_deg * M_PI / 360));
    const Eigen::Vector2d straight =
        centre + scale * Eigen::Vector2d(way.dot(optics().right()), -way.dot(optics().up()));
    EXPECT_LT((seen - pixel(at)).norm(), 2.0) << x << " " << y;
    EXPECT_GT((seen - centre).norm(), (straight - centre).norm() + 5) << x << " " << y;
  }
}

// ---- crevices

/// A ball of 20 mm with another one beside it; away: the other stands where it takes no light.
SceneView two_balls(bool away) {
  SceneView view;
  const auto ball = [](const Vec3& centre) {
    TriangleSurface s = testing_support::icosphere(4);
    for (Vec3& v : s.vertices) v = centre + 0.02 * v;
    return still_surface(s);
  };
  view.organ = ball({0.02, 0, 0});
  view.material = "liver";
  view.adjacent = {{ball({away ? -0.2 : -0.0205, 0, 0}), "liver"}};
  view.X_TI = testing_support::instrument_pose({0.3, 0, 0.3}, Vec3(0.62, -0.28, 0.75));
  view.camera.eye_T = Vec3(-0.012, 0, 0.085);
  view.camera.look_at_T = Vec3(0.004, 0, 0);
  view.camera.up_T = Vec3::UnitY();
  return view;
}

TEST_F(MarksOfTheView, ACreviceIsTintedRedWhereAPlainShadeWouldBeGrey) {
  struct Seen {
    double dimmer, redder;
  };
  const auto seen = [&](Preset with) {
    preset(with);
    view_ = two_balls(true);
    const Image open = draw();
    view_ = two_balls(false);
    const Image beside = draw();
    Pixel free{}, crevice{};
    for (double y = -0.006; y <= 0.0061; y += 0.001) {  // along the cleft, on the flank that faces the other ball
      const Vec3 way = Vec3(-0.90, y / 0.02, 0.40).normalized();
      const Eigen::Vector2d at = pixel(Vec3(0.02, 0, 0) + 0.02 * way);
      const Pixel a = mean_at(open, at, 2), b = mean_at(beside, at, 2);
      for (std::size_t c = 0; c < 3; ++c) free[c] += a[c], crevice[c] += b[c];
    }
    return Seen{brightness(crevice) / brightness(free), redness(crevice) / redness(free)};
  };
  const Seen full = seen(Preset::kFull), soft = seen(Preset::kSoft), low = seen(Preset::kLow);
  for (const Seen& one : {full, soft, low}) EXPECT_LT(one.dimmer, 0.88);
  EXPECT_GT(full.redder, low.redder + 0.05);  // the least preset shades in grey
  EXPECT_GT(soft.redder, low.redder + 0.05);
}

// ---- vessels

constexpr int kAcross = 72, kBeside = 4;
constexpr double kLine = 1.14;  // so much redder than the tissue on both sides

/// Points of tissue on a grid about a place, the same whatever the camera.
std::vector<Vec3> grid_of(const TriangleSurface& organ, double step_m, double y_m = -0.008) {
  std::vector<Vec3> out;
  for (int j = 0; j < kAcross; ++j)
    for (int i = 0; i < kAcross; ++i)
      out.push_back(top_of(organ, step_m * (i - kAcross / 2), step_m * (j - kAcross / 2) + y_m).first);
  return out;
}

/// At each point of the grid how much redder it is than the tissue four steps to both sides, across or along.
std::vector<double> lines_of(const std::vector<double>& red) {
  std::vector<double> out(red.size(), 0);
  for (int j = kBeside; j + kBeside < kAcross; ++j)
    for (int i = kBeside; i + kBeside < kAcross; ++i) {
      const auto at = [&](int x, int y) { return red[static_cast<std::size_t>(x + kAcross * y)]; };
      const double across = std::max(at(i - kBeside, j), at(i + kBeside, j)),
                   along = std::max(at(i, j - kBeside), at(i, j + kBeside));
      out[static_cast<std::size_t>(i + kAcross * j)] = at(i, j) / std::min(across, along);
    }
  return out;
}

class VesselsOfTheView : public MarksOfTheView {
 protected:
  std::vector<double> lines(const std::vector<Vec3>& grid) {
    const Image image = draw();
    std::vector<double> red;
    for (const Vec3& at : grid) red.push_back(redness(mean_at(image, pixel(at), 1)));
    return lines_of(red);
  }
  static long clear(const std::vector<double>& lines, double least = kLine) {
    return std::count_if(lines.begin(), lines.end(), [least](double l) { return l > least; });
  }
};

TEST_F(VesselsOfTheView, TrunksRunOverStomachAndGallbladderButNotOverBone) {
  const std::vector<Vec3> grid = grid_of(*view_.organ, 0.00075);
  const auto lines_on = [&](const std::string& material, Preset with) {
    preset(with);
    look_at(material);
    return clear(lines(grid));
  };
  for (const Preset one : {Preset::kFull, Preset::kSoft, Preset::kLow}) {
    EXPECT_GT(lines_on("stomach", one), 40) << preset_name(one);
    EXPECT_GT(lines_on("gallbladder", one), 15) << preset_name(one);
    EXPECT_LT(lines_on("bone", one), 5) << preset_name(one);
  }
}

TEST_F(VesselsOfTheView, TwigsComeWithTheFullPresetAlone) {
  look_at("stomach");
  view_.camera.eye_T = Vec3(0, -0.035, 0.05);
  view_.camera.look_at_T = Vec3(0, 0.015, 0);
  const std::vector<Vec3> grid = grid_of(*view_.organ, 0.0002, 0.015);  // lines of less than 1 mm
  const long full = clear(lines(grid), 1.08);
  preset(Preset::kSoft);
  const long soft = clear(lines(grid), 1.08);
  EXPECT_GT(static_cast<double>(full), 1.7 * static_cast<double>(soft)) << soft;
}

TEST_F(VesselsOfTheView, StickToTheTissueWhenTheScopeMoves) {
  look_at("stomach");
  const std::vector<Vec3> grid = grid_of(*view_.organ, 0.00075);
  const std::vector<double> before = lines(grid);
  view_.camera.eye_T += Vec3(0.015, 0.004, 0.006);
  const std::vector<double> after = lines(grid);
  int there = 0, still = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    there += before[i] > kLine;
    still += before[i] > kLine && after[i] > 1.08;
  }
  EXPECT_GT(there, 60);
  EXPECT_GT(still, 0.75 * there) << there;
}

// ---- haze

TEST_F(MarksOfTheView, HazePalesAndFlattensWhatIsFar) {
  const auto [spot, normal] = top_of(*view_.organ, 0.0, 0.0);
  const Vec3 beside = top_of(*view_.organ, 0.030, 0.0).first;
  view_.marks = {{TissueMarkKind::kChar, spot, 0.012, 1}};
  view_.camera.look_at_T = spot;
  struct Seen {
    double red, dark;
  };
  const auto from = [&](double distance_m) {
    view_.camera.eye_T = spot + distance_m * Vec3(0, -0.62, 0.78).normalized();
    const Image image = draw();
    const int half = std::max(1, static_cast<int>(0.16 / distance_m));  // the same tissue from everywhere
    const Pixel core = mean_at(image, pixel(spot), half), tissue = mean_at(image, pixel(beside), 2 * half);
    return Seen{redness(tissue), brightness(core) / brightness(tissue)};
  };
  const Seen near = from(0.07), far = from(0.30), farthest = from(0.60);
  EXPECT_LT(far.red, 0.9 * near.red);
  EXPECT_LT(farthest.red, 0.9 * far.red);
  EXPECT_GT(far.dark, near.dark + 0.10);  // black is no longer black
  EXPECT_GT(farthest.dark, far.dark + 0.10);
}

}  // namespace
}  // namespace trocar::graphics_marks_test
