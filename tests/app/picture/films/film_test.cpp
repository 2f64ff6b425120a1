// From runs to the pictures of a film: how many, of which moments, two in one.
#include "app/picture/films/film.h"

#include <gtest/gtest.h>

#include <cmath>

#include "app/picture/films/side_by_side.h"
#include "haptics/input_error.h"
#include "scenarios/files/exercise_loader.h"
#include "tests/app/session/playback/playback_samples.h"
#include "tests/support/headless_fixture.h"
#include "tests/tissue/support/temporary_folder.h"

namespace trocar::film_test {
namespace {

class Films : public testing_support::HeadlessFixture {
 protected:
  void SetUp() override {
    HeadlessFixture::SetUp();
    context_.reset();  // films have a context of their own
  }
  FilmOptions small(double fps) const {
    FilmOptions options;
    options.fps = fps;
    options.width = 320;
    options.height = 240;
    options.name = "T-1";
    return options;
  }
  test::TemporaryFolder folder_;
};

/// Mean of a part of the picture, 0..255.
double mean(const Image& image, int x0, int x1, int y0, int y1) {
  double sum = 0;
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x) sum += image.pixel(x, y)[0] + image.pixel(x, y)[1] + image.pixel(x, y)[2];
  return sum / (3.0 * (x1 - x0) * (y1 - y0));
}

TEST_F(Films, BeginASecondBeforeRunAndEndWithIt) {
  const RecordedRun run(record_short(folder_ / "a.trec"), find_assets());
  ASSERT_GT(run.begin_s(), 1) << "there is a second before";
  std::vector<Image> pictures;
  const int made = make_film(run, find_assets(), small(0.5), [&](const Image& image) { pictures.push_back(image); });
  EXPECT_EQ(made, 1 + static_cast<int>(std::floor((1 + film_length(run)) * 0.5 + 1e-6)));
  ASSERT_EQ(pictures.size(), static_cast<std::size_t>(made));
  EXPECT_EQ(pictures[0].width, 320);
  EXPECT_NE(pictures.front().rgb, pictures.back().rgb);
  FilmOptions fast = small(0.5);
  fast.speed = 2;
  EXPECT_EQ(make_film(run, find_assets(), fast, [](const Image&) {}),
            1 + static_cast<int>(std::floor((1 + film_length(run)) * 0.25 + 1e-6)));
  fast.progress = [](int done, int of) { return 5 * done < of; };
  EXPECT_LT(make_film(run, find_assets(), fast, [](const Image&) {}), made) << "ended by whoever watches";
}

TEST_F(Films, TwoRunsStandSideBySideFromRunOn) {
  const RecordedRun expert(record_short(folder_ / "a.trec"), find_assets()),
      novice(record_short(folder_ / "b.trec", "novice"), find_assets());
  FilmOptions options = small(0.25);
  options.width = 720;
  options.height = 405;
  options.name_beside = "expert";
  std::vector<Image> pictures;
  make_film(novice, expert, find_assets(), options, [&](const Image& image) { pictures.push_back(image); });
  const double longer = std::max(film_length(novice), film_length(expert));
  EXPECT_EQ(pictures.size(), 1 + static_cast<std::size_t>(std::floor((1 + longer) * 0.25 + 1e-6)));
  const Image& later = pictures[1];
  ASSERT_EQ(later.width, 720);
  EXPECT_GT(mean(later, 100, 260, 100, 250), 25) << "the left scope sees something";
  EXPECT_GT(mean(later, 460, 620, 100, 250), 25) << "and so does the right one";
  double difference = 0;
  for (int y = 60; y < 260; ++y)
    for (int x = 0; x < 340; ++x) difference += std::abs(later.pixel(x, y)[0] - later.pixel(x + 361, y)[0]);
  EXPECT_GT(difference / (200 * 340), 0.5) << "two different hands";
  options.width = 400;
  EXPECT_CONTAINS(
      test::message_of<InputError>([&] { make_film(novice, expert, find_assets(), options, [](const Image&) {}); }),
      "720 x 400");
}

TEST_F(Films, AnExerciseWithoutForceBarsLeavesTheirRoomToThePicture) {
  AttemptSetup setup = short_setup();
  setup.exercise = find_exercise("reach-and-orient", find_assets().exercises);
  const Scene scene = build_scene(setup, find_assets(), {"simulated", 1000, 16});
  SideBySidePainter painter(find_assets(), 720, 400, Preset::kLow);
  RunMoment moment;
  moment.record.stylus.X_TI.p = scene.board.start_T;
  const Image image = painter.paint({scene, moment, "T-1"}, {scene, moment, "expert"}, 1);
  EXPECT_GT(mean(image, 120, 240, 310, 345), 20) << "the lowest quarter is no black band";
  EXPECT_GT(mean(image, 480, 600, 310, 345), 20);
}

TEST_F(Films, ThePainterOfTwoSaysWhoHasEnded) {
  const Scene scene = short_scene();
  SideBySidePainter painter(find_assets(), 720, 400);
  RunMoment moment;
  moment.record.stylus.X_TI.p = scene.board.start_T;
  const Image running = painter.paint({scene, moment, "T-1"}, {scene, moment, "expert"}, 12.5);
  const Image ended = painter.paint({scene, moment, "T-1", true}, {scene, moment, "expert"}, 12.5);
  int changed_left = 0, changed_right = 0;
  for (int y = 0; y < 30; ++y)
    for (int x = 0; x < 720; ++x)
      (x < 360 ? changed_left : changed_right) += running.pixel(x, y)[1] != ended.pixel(x, y)[1] ? 1 : 0;
  EXPECT_GT(changed_left, 20) << "its time gives way to the word";
  EXPECT_EQ(changed_right, 0);
  EXPECT_THROW(SideBySidePainter(find_assets(), 719, 400), std::invalid_argument);
}

}  // namespace
}  // namespace trocar::film_test
