// Each instrument is seen as what it is: from 10 cm no two kinds make the same picture, and jaws are seen to open.
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <optional>

#include "app/picture/gl/image.h"
#include "tests/support/headless_fixture.h"
#include "tests/support/procedural_scene.h"

namespace trocar::graphics_instruments_test {
namespace {

using namespace testing_support;

class InstrumentPicture : public HeadlessFixture {
 protected:
  static constexpr int kWidth = 640, kHeight = 400;
  void SetUp() override {
    HeadlessFixture::SetUp();
    if (!IsSkipped()) renderer_.emplace(make_renderer());
  }
  /// Over the organ, 10 cm from the lens, rolled so that hinge axis and opening are both across the view.
  Image draw(InstrumentKind kind, double opening_m) {
    SceneView view = procedural_scene();
    view.targets.clear();
    view.dimple_T.reset();
    view.hud = {};
    view.instrument = kind;
    view.jaw_opening_m = opening_m;
    view.X_TI = instrument_pose(Vec3(0, 0, 0.015), Vec3(0.9, 0.2, 0.35));
    view.X_TI.R = view.X_TI.R * Eigen::AngleAxisd(0.9, Vec3::UnitZ()).toRotationMatrix();
    view.camera.look_at_T = view.X_TI.p;
    view.camera.eye_T = view.X_TI.p + 0.1 * Vec3(-0.1, -0.75, 0.65).normalized();
    Image image = renderer_->render(view, kWidth, kHeight);
    if (const char* folder = std::getenv("TROCAR_PICTURES"))  // for the eye
      write_png(
          std::filesystem::path(folder) / (std::string(describe(kind).name) + (opening_m > 0 ? "-open" : "") + ".png"),
          image);
    return image;
  }
  static int differing(const Image& a, const Image& b) {
    int count = 0;
    for (std::size_t i = 0; i + 2 < a.rgb.size(); i += 3) {
      int most = 0;
      for (std::size_t c = 0; c < 3; ++c) most = std::max(most, std::abs(int(a.rgb[i + c]) - int(b.rgb[i + c])));
      count += most > 24;
    }
    return count;
  }

  std::optional<Renderer> renderer_;
};

TEST_F(InstrumentPicture, NoKindLooksLikeAnotherAndJawsAreSeenToOpen) {
  std::map<InstrumentKind, Image> closed;
  for (const InstrumentDescription& known : kInstruments) closed[known.kind] = draw(known.kind, 0);
  EXPECT_EQ(differing(closed[InstrumentKind::kProbe], closed[InstrumentKind::kGrasper]), 0) << "a closed one";
  for (const InstrumentDescription& a : kInstruments)
    for (const InstrumentDescription& b : kInstruments)
      if (a.kind > b.kind && b.kind != InstrumentKind::kProbe) {
        EXPECT_GT(differing(closed[a.kind], closed[b.kind]), 150) << a.name << " " << b.name;
      }
  for (const InstrumentDescription& known : kInstruments) {
    const int moved = differing(closed[known.kind], draw(known.kind, 0.008));
    EXPECT_EQ(moved > 80, known.jaw_length_m > 0 || known.kind == InstrumentKind::kProbe) << known.name << " " << moved;
  }
}

}  // namespace
}  // namespace trocar::graphics_instruments_test
