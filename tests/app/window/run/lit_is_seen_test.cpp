// What is lit is seen: boards light nothing that the scope does not show, and its outline stands out from whatever lies
// behind it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/picture/attempt/attempt_picture.h"
#include "app/picture/attempt/attempt_scene.h"
#include "app/session/run_moment.h"
#include "app/session/setup/scene.h"
#include "app/window/run/tip_guide.h"
#include "app/window/ui/theme.h"
#include "haptics/device/backends/make_backend.h"
#include "scenarios/files/exercise_loader.h"
#include "scenarios/kinds/kind.h"
#include "scenarios/layout/height_field.h"
#include "tests/app/window/attempt/attempt_samples.h"
#include "tests/app/window/pages/practice_bench.h"
#include "tests/app/window/pages/ui_bench.h"

namespace trocar::testing_support::lit_is_seen_test {
namespace {

constexpr const char* kExercises[] = {"reach-and-orient", "surface-touch", "limited-grasp"};

Scene board_of(const std::string& exercise, const std::string& level, int board) {
  AttemptSetup setup;
  setup.exercise = shipped_exercise(exercise);
  setup.level = level;
  setup.organ = "phantom-liver";
  setup.tissue = setup.exercise.tissue;
  setup.board = board;
  return build_scene(setup, source_assets(), backend_capabilities(kPointerBackend, setup.rate_hz));
}

/// Highest that the surface stands over the line of sight to a point on it, m; its own surroundings are left out.
double stands_before(const HeightField& organ, const Vec3& eye_T, const Vec3& p_T) {
  const Vec3 way = p_T - eye_T;
  const double length = way.norm();
  double most = -1;
  for (double s = 0; s < length - 0.004; s += 0.001) {
    const Vec3 at = eye_T + s / length * way;
    if (const auto top = organ.top(at.x(), at.y())) most = std::max(most, top->position.z() - at.z());
  }
  return most;
}

TEST(LitIsSeen, OnEveryPracticeBoardAndLevelInTheFrameAndBeforeEveryEdge) {
  constexpr PixelRect kScope{0, 45, 960, 644};  // of a window of 1280 x 720
  constexpr double kRim = 10;                   // px
  for (const char* exercise : kExercises) {
    for (const ExerciseLevel& level : shipped_exercise(exercise).levels) {
      for (int board = 0; board < 20; ++board) {
        const Scene scene = board_of(exercise, level.name, board);
        const Camera camera = attempt_camera(scene);
        const ScopeOptics optics(camera, kScope);
        std::optional<HeightField> organ;
        if (kind_of(scene.setup.exercise).on_organ) organ.emplace(felt_surface(scene));
        for (std::size_t i = 0; i < scene.board.targets.size(); ++i) {
          const Target& target = scene.board.targets[i];
          const std::string where = std::string(exercise) + " " + level.name + ", board " + std::to_string(board) +
                                    ", target " + std::to_string(i);
          const auto at = optics.project(target.centre_T);
          ASSERT_TRUE(at) << where;
          EXPECT_GT(at->y(), kScope.y + kRim) << where;
          EXPECT_LT(at->y(), kScope.y + kScope.height - kRim) << where;
          if (!organ) continue;
          EXPECT_LT(stands_before(*organ, camera.eye_T, target.centre_T), 0.0005) << where << ": behind an edge";
        }
      }
    }
  }
}

TEST(StartIsSeen, InEveryExerciseWithTheInstrumentThatComesInUntilTheClockRuns) {
  constexpr PixelRect kScope{0, 45, 960, 644};
  for (const Exercise& exercise : list_exercises(source_assets().exercises)) {
    if (is_scope(exercise)) continue;  // it is looked through
    for (const char* level : {"L1", "L3"}) {
      const std::string where = exercise.number + " " + level;
      const Scene scene = board_of(exercise.id, level, 1);
      RunMoment moment;
      const auto seen = [&] { return attempt_camera(view_of(scene, moment)); };
      ASSERT_TRUE(waits_for_start(moment.status.phase));
      const Camera camera = seen();
      EXPECT_GT(camera.eye_T.z(), scene.board.start_T.z()) << where << ": who glides at its height sees that plane";
      const ScopeOptics optics(camera, kScope);
      for (const Vec3& p_T : {scene.board.start_T, entry_T(scene)}) {
        const auto at = optics.project(p_T);
        ASSERT_TRUE(at) << where;
        EXPECT_GT(at->y(), kScope.y) << where;
        EXPECT_LT(at->y(), kScope.y + kScope.height) << where;
      }
      moment.status.phase = Phase::kRun;
      EXPECT_EQ(seen().eye_T, camera.eye_T) << where << ": it goes in from there";
      moment.status.run_time_s = 2;
      EXPECT_EQ(seen().eye_T, attempt_camera(scene).eye_T) << where;
    }
  }
}

class OutlineStandsOut : public UiBench {
 protected:
  /// All targets of a board outlined at once, as each is when it is lit.
  TipGuide outlines(const Scene& scene, const Camera& camera) {
    TipGuide out;
    RunMoment moment;
    DirectorStatus& status = moment.status;
    status.phase = Phase::kRun;
    status.demand.oriented = kind_of(scene.setup.exercise).oriented;
    for (std::size_t i = 0; i < scene.board.targets.size(); ++i) {
      const Target& target = scene.board.targets[i];
      status.target_index = static_cast<int>(i);
      status.demand.centre_T = target.centre_T;
      status.demand.normal_T = target.normal_T;
      status.demand.radius_m = std::max(0.003, target.radius_m);
      if (scene.board.rigid.board) {
        const FoamBlock& block = scene.board.rigid.blocks.at(i);
        status.demand.object = {block.X_TO, block.size_m};
      }
      for (const Cue cue : scene.board.rigid.board ? std::vector{Cue::kPick, Cue::kPlace} : std::vector{Cue::kNone}) {
        status.cue = cue;
        for (auto& line : lit_outline(view_of(scene, moment), camera)) out.lit_T.push_back(std::move(line));
      }
    }
    return out;
  }

  Image picture(Renderer& renderer, const SceneView& view, const TipGuide& guide) {
    const unsigned scope = renderer.draw_scope(view, width_, height_);
    target_->begin(width_, height_);
    target_->place(scope, {0, 0, width_, height_}, 0);
    layer_->begin(width_, height_, 0.02, {});
    Ui ui(words_, 1, width_, height_);
    paint_tip_guide(ui, ScopeOptics(view.camera, {0, 0, width_, height_}), guide);
    layer_->end();
    return target_->read();
  }
};

/// The line against the darkest beside it. 3 : 1 is what WCAG 2.1 (1.4.11) asks of what is not text.
TEST_F(OutlineStandsOut, FromEveryBackgroundInEveryPreset) {
  constexpr double kLeast = 3;
  constexpr int kBeside = 4;  // px
  const Rgb accent = shape_colour(Ink::kAccent);
  for (const Preset preset : {Preset::kLow, Preset::kSoft, Preset::kFull}) {
    Renderer renderer = make_renderer({.preset = preset});
    for (const char* exercise : kExercises) {
      const Scene scene = board_of(exercise, "L1", 0);
      RunMoment moment;
      moment.status.phase = Phase::kRun;
      moment.record.stylus.X_TI.p = scene.board.centre_T + Vec3(0, 0, 0.5);  // out of the picture
      const SceneView view = attempt_view(view_of(scene, moment), "");
      const Image drawn = picture(renderer, view, outlines(scene, view.camera));
      const auto colour = [&](int x, int y) {
        const std::uint8_t* p = drawn.pixel(x, y);
        return Rgb{p[0], p[1], p[2]};
      };
      std::vector<double> contrasts;
      for (int y = kBeside; y < height_ - kBeside; ++y)
        for (int x = kBeside; x < width_ - kBeside; ++x) {
          if (colour(x, y) != accent) continue;
          double most = 1;
          for (int d = 1; d <= kBeside; ++d)
            for (const auto& [i, j] : {std::pair(d, 0), {-d, 0}, {0, d}, {0, -d}})
              most = std::max(most, contrast(accent, colour(x + i, y + j)));
          contrasts.push_back(most);
        }
      const std::string where = std::string(exercise) + ", preset " + std::to_string(static_cast<int>(preset));
      ASSERT_GT(contrasts.size(), 500U) << where;
      const auto twentieth = contrasts.begin() + static_cast<std::ptrdiff_t>(contrasts.size() / 20);
      std::nth_element(contrasts.begin(), twentieth, contrasts.end());
      EXPECT_GT(*twentieth, kLeast) << where << ": a twentieth of the line is paler";
    }
  }
}

}  // namespace
}  // namespace trocar::testing_support::lit_is_seen_test
