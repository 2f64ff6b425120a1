// Every page of the window in every language, at every size of window and text that people have: nothing is cut, no
// number shortened, nothing lies over anything else, nobody reads an identifier, gauges stay.
//
// Checked is what was laid out, not pixels: frames are drawn into a target of a few. TROCAR_PAGE_PICTURES=folder draws
// them in full and keeps each.
#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <regex>
#include <set>
#include <thread>

#include "app/picture/attempt/attempt_picture.h"
#include "app/picture/attempt/attempt_scene.h"
#include "app/picture/display/hud_layout.h"
#include "app/window/device/device_panel.h"
#include "app/window/kinds/kind_lesson.h"
#include "app/window/practice/screen_table.h"
#include "app/window/run/hud_words.h"
#include "app/window/run/overlays.h"
#include "app/window/run/run_screen.h"
#include "scenarios/kinds/kind.h"
#include "tests/app/session/playback/playback_samples.h"
#include "tests/app/window/pages/page_bench.h"
#include "tests/app/window/pages/practice_bench.h"

namespace trocar::testing_support::every_size_test {
namespace {

constexpr const char* kLongestCode = "Krankenschwester-Muster-2026-014";  // 32 letters

struct Sight {
  int width, height;
  double scale;
  std::string name() const {
    return std::to_string(width) + "x" + std::to_string(height) + "_" + std::to_string(std::lround(100 * scale));
  }
};

const std::vector<std::pair<int, int>> kWindows{{640, 400}, {800, 600}, {1024, 768}, {1280, 720}, {1920, 1080}};

/// All of them where TROCAR_EVERY_SIZE is set; else the corners: least and most room, narrow and wide.
std::vector<Sight> sights() {
  if (std::getenv("TROCAR_EVERY_SIZE") == nullptr)
    return {{640, 400, 1}, {640, 400, 2}, {800, 600, 1.5}, {1024, 768, 2}, {1280, 720, 1}, {1920, 1080, 1.5}};
  std::vector<Sight> out;
  for (const auto& [width, height] : kWindows)
    for (const double scale : {1.0, 1.5, 2.0}) out.push_back({width, height, scale});
  return out;
}

/// What is wrong, each once, with the windows in which it is.
class Faults {
 public:
  void add(const std::string& what, const std::string& where) { found_[what].insert(where); }
  void look_at(const std::vector<DrawnText>& texts, double width, double height, const std::string& page,
               const std::string& where) {
    static const std::regex kIdentifier("[0-9a-f]{8}-[0-9a-f]{4}-");
    if (texts.empty()) add(page + ": says nothing", where);
    for (const DrawnText& t : texts) {
      if (t.shortened) add(page + ": cut: " + t.text, where);
      if (t.width > t.room + 1.5) add(page + ": wider than its room: " + t.text, where);
      if (t.x < -0.5 || t.x + t.width > width + 0.5 || t.y < -0.5 || t.y + t.height > height + 0.5)
        add(page + ": out of the window: " + t.text, where);
      if (std::regex_search(t.text, kIdentifier)) add(page + ": an identifier: " + t.text, where);
    }
    for (std::size_t i = 0; i < texts.size(); ++i)
      for (std::size_t j = i + 1; j < texts.size(); ++j)
        if (texts[i].in_front == texts[j].in_front && texts[i].ground == texts[j].ground &&
            common_side(texts[i], texts[j]) > 2)
          add(page + ": '" + texts[i].text + "' over '" + texts[j].text + "'", where);
  }
  ~Faults() {
    for (const auto& [what, windows] : found_) {
      std::string all;
      for (const std::string& window : windows) all += " " + window;
      ADD_FAILURE() << what << "\n   " << windows.size() << ":" << all;
    }
  }

 private:
  std::map<std::string, std::set<std::string>> found_;
};

class EverySize : public HeadlessFixture, public ::testing::WithParamInterface<const char*> {
 protected:
  void SetUp() override {
    HeadlessFixture::SetUp();
    if (IsSkipped()) return;
    options_ = bench_.options();
    options_.language = GetParam();
    target_ = std::make_unique<FrameTarget>(*context_, false);
    layer_ = std::make_unique<UiLayer>(*context_, 1);
    if (const char* folder = std::getenv("TROCAR_PAGE_PICTURES"); folder && *folder) pictures_ = folder;
    if (!pictures_.empty()) renderer_ = std::make_unique<Renderer>(make_renderer({.preset = Preset::kSoft}));
  }
  void TearDown() override {
    model_.reset();
    layer_.reset();
    target_.reset();
  }
  void open() { model_ = bench_.model(options_); }

  void one_frame(const Sight& at, Screen* screen, const std::function<void(Ui&)>& draw,
                 const std::vector<InputEvent>& events) {
    const auto stage = screen ? screen->stage(*model_, at.width, at.height) : std::nullopt;
    if (screen) screen->second_stage(*model_, at.width, at.height);
    if (renderer_) {
      const PixelRect part = stage && stage->width > 0
                                 ? PixelRect{static_cast<int>(stage->x), static_cast<int>(stage->y),
                                             static_cast<int>(stage->width), static_cast<int>(stage->height)}
                                 : PixelRect{0, 0, at.width, at.height};
      const unsigned texture = stage ? renderer_->draw_scope(stage->view, part.width, part.height) : 0;
      target_->begin(at.width, at.height);
      if (stage) target_->place(texture, part, stage->dim);
    } else {
      target_->begin(64, 48);
    }
    layer_->set_scale(at.scale);
    layer_->begin(at.width, at.height, 0.02, events);
    Ui ui(model_->words(), at.scale, at.width, at.height);
    draw(ui);
    texts_ = ui.text_audit();
    scrolling_ = ui.scrolling();
    layer_->end();
  }
  /// Three frames, since a panel knows its content's height in the second, then a look at it.
  void look(const std::string& page, const Sight& at, const std::function<void(Ui&)>& draw, Screen* screen = nullptr) {
    for (int i = 0; i < 3; ++i) one_frame(at, screen, draw, {});
    faults_.look_at(texts_, at.width, at.height, page, at.name());
    for (const std::string& panel : scrolling_)
      if (panel.find("foot") != std::string::npos) faults_.add(page + ": buttons are hidden: " + panel, at.name());
    if (renderer_) write_png(pictures_ / (page + "_" + GetParam() + "_" + at.name() + ".png"), target_->read());
  }
  void look(const std::string& page, const Sight& at, Screen& screen) {
    look(
        page, at, [&](Ui& ui) { screen.frame(ui, *model_, 0); }, &screen);
  }
  void everywhere(const std::string& page, const std::function<void(const std::string&, const Sight&)>& at) {
    for (const Sight& sight : sights()) {
      model_->choose_scale(sight.scale);
      at(page, sight);
    }
  }
  void everywhere(ScreenName name, const std::string& after = "") {
    everywhere(screen_name(name) + after, [&](const std::string& page, const Sight& at) {
      const std::unique_ptr<Screen> screen = make_screen(name);
      look(page, at, *screen);
    });
  }
  void everywhere(Screen& screen, const std::string& page) {
    everywhere(page, [&](const std::string& called, const Sight& at) { look(called, at, screen); });
  }
  bool until(const std::function<bool()>& what) {
    for (int i = 0; i < 3000 && !what(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return what();
  }

  PracticeBench bench_;
  ModelOptions options_;
  std::unique_ptr<PracticeModel> model_;
  std::unique_ptr<FrameTarget> target_;
  std::unique_ptr<UiLayer> layer_;
  std::filesystem::path pictures_;
  std::unique_ptr<Renderer> renderer_;
  std::vector<DrawnText> texts_;
  std::vector<std::string> scrolling_;
  Faults faults_;
};

TEST_P(EverySize, PagesBeforeARun) {
  open();
  everywhere(ScreenName::kStart);
  ASSERT_EQ(model_->sign_in(kLongestCode), "");
  everywhere(ScreenName::kStart, "-signed-in");
  for (const ScreenName name :
       {ScreenName::kCurriculum, ScreenName::kSettings, ScreenName::kProgress, ScreenName::kNotch, ScreenName::kReplay})
    everywhere(name);
  for (const Exercise& exercise : model_->exercises()) {
    model_->exercise_id = exercise.id;
    for (const ExerciseLevel& level : exercise.levels) {
      model_->level = level.name;
      everywhere(*make_screen(ScreenName::kBriefing), "briefing-" + exercise.number + "-" + level.name);
    }
  }
}

TEST_P(EverySize, WhatLiesOverPages) {
  open();
  SoundPage sounds;
  for (auto [help, name] : {std::pair{HelpPage::kKeys, "help-keys"},
                            {HelpPage::kMetrics, "help-measures"},
                            {HelpPage::kSounds, "help-sounds"}})
    everywhere(name, [&](const std::string& page, const Sight& at) {
      look(page, at, [&](Ui& ui) { help_overlay(ui, *model_, help, sounds); });
    });
  for (const bool runs : {false, true})
    everywhere(runs ? "menu-in-a-run" : "menu", [&](const std::string& page, const Sight& at) {
      look(page, at, [&](Ui& ui) { menu_overlay(ui, *model_, runs); });
    });
  everywhere("notice", [&](const std::string& page, const Sight& at) {
    double age_s = 0;
    std::string shown = model_->words()("An exam has no pause: the clock runs on.");
    look(page, at, [&](Ui& ui) { notice_overlay(ui, *model_, 0.01, age_s, shown); });
  });
}

TEST_P(EverySize, AfterARun) {
  options_.trainee = "T-1";
  const Exercise touch = shipped_exercise("surface-touch");
  const std::filesystem::path recording =
      record_short(bench_.folder / "0f8d5c1e-3a77-4c1b-9f0e-6d1f6a1b2c3d.trec", "novice");
  std::string last;
  int board = 0;
  open();
  for (const double touched : {0.62, 0.8, 0.91})
    stored(bench_.options().database,
           graded(touch, "L1", {{"object_in_band_share", touched}, {"time_s", 103.7}, {"path_ratio", 1.31}}), touch,
           "T-1", ++board);
  const std::string failed = stored(bench_.options().database, heavy_run(touch), touch, "T-1", ++board, recording);
  const std::string passed = stored(bench_.options().database, good_run(touch), touch, "T-1", ++board, recording);
  for (const auto& [uuid, page] : {std::pair{failed, "debrief-not-yet"}, {passed, "debrief-passed"}}) {
    ASSERT_TRUE(model_->open_result(uuid));
    const std::unique_ptr<Screen> debrief = make_screen(ScreenName::kDebrief);
    debrief->settle(*model_, 60);
    everywhere(*debrief, page);
  }
  everywhere(ScreenName::kCurriculum, "-done");
  everywhere(ScreenName::kProgress, "-done");
  model_->replay_file = model_->recording();
  model_->replay_at_s = 8;
  const std::unique_ptr<Screen> replay = make_screen(ScreenName::kReplay);
  replay->settle(*model_, 60);
  everywhere(*replay, "replay-alone");
  model_->replay_beside = recording;
  const std::unique_ptr<Screen> two = make_screen(ScreenName::kReplay);
  two->settle(*model_, 60);
  two->settle(*model_, 60);
  everywhere(*two, "replay-beside");
}

/// A live attempt, held still meanwhile: as it stands there, with the way to the start ball said beside it, asked to
/// pause, with the device's panel. Free play has a notice at its upper edge from the beginning.
TEST_P(EverySize, InARun) {
  for (const char* exercise : {"reach-and-orient", "surface-touch", "limited-grasp", "free-play"}) {
    const bool free = std::string_view(exercise) == "free-play";
    if (!free) options_.exercise = exercise;
    open();
    ASSERT_EQ(free ? model_->begin_play(Play::kFree) : model_->begin_attempt(), "");
    RunScreen run;
    const Sight first{640, 400, 1};
    const auto frame = [&](const std::vector<InputEvent>& events = {}) {
      one_frame(
          first, &run, [&](Ui& ui) { run.frame(ui, *model_, 0.02); }, events);
    };
    ASSERT_TRUE(until([&] {
      frame();
      return model_->running()->ready() && model_->running()->newest().seen;
    }));
    frame();  // from here on the hand steers
    model_->running()->pause(true);
    const std::string name = free ? std::string("run-free") : "run-" + model_->exercise().number;
    if (free && GetParam() == std::string_view("en")) {
      look(name, {1280, 720, 1}, run);
      const auto says = [&](std::string_view part) {
        return std::any_of(texts_.begin(), texts_.end(),
                           [&](const DrawnText& t) { return t.text.find(part) != std::string::npos; });
      };
      EXPECT_TRUE(says("Grasper"));
      EXPECT_TRUE(says("mm to go")) << "there is room for both";
    }
    everywhere(run, name);
    everywhere(name + "-device", [&](const std::string& page, const Sight& at) {
      DevicePanel device;
      device.open = true;
      look(
          page, at,
          [&](Ui& ui) {
            run.frame(ui, *model_, 0);
            device.frame(ui, *model_, model_->running()->newest().record, model_->running()->scene().loop, 1,
                         device_panel_area(ui, false));
          },
          &run);
    });
    run.handle(key(model_->keys().key_of(Action::kPause)), *model_);
    everywhere(run, name + "-pause");
    model_->end_attempt();
  }
}

/// Pure layout, so in all windows at once: no number is cut, and no gauge gives way, whatever is said.
TEST(EverySizeOfDisplay, KeepsItsGaugesAndNumbers) {
  PracticeBench bench;
  const std::unique_ptr<PracticeModel> model = bench.model();
  FontSet fonts;
  Faults faults;
  for (const Exercise& exercise : model->exercises()) {
    for (const ExerciseLevel& level : exercise.levels) {
      AttemptSetup setup;
      setup.exercise = exercise;
      setup.level = level.name;
      setup.organ = "phantom-liver";
      const Scene scene = build_scene(setup, source_assets(), {"pointer", setup.rate_hz, 16});
      RunMoment moment;
      moment.record.stylus.X_TI.p = scene.board.centre_T + Vec3(0.1037, 0.02, 0.05);
      moment.status.phase = Phase::kRun;
      moment.status.target_index = 0;
      moment.status.targets_done = 3;
      moment.status.run_time_s = 103.7;
      moment.status.peak_force_n = 1.234;
      moment.status.wrong_places = 12;
      moment.status.excess_forces = 11;
      moment.status.hold_progress = 0.72;
      moment.status.position_error_m = 0.1037;
      moment.status.demand.oriented = kind_of(exercise).oriented;
      moment.status.demand.radius_m = 0.003;
      moment.status.demand.angle_tolerance_rad = 0.1745;
      moment.status.demand.band = {0.45, 0.75};
      moment.record.stylus.F_I_T.force = Vec3(0, 0, 1.037);
      std::vector<std::string> said;
      for (const char* sentence : lesson_of(exercise).display) said.emplace_back(sentence);
      said.insert(said.end(), {"Move the tip into the start ball", "A graded attempt cannot be paused: it is void."});
      for (const char* language : {"en", "fr", "de"}) {
        model->choose_language(language);
        for (const std::string& toast : said) {
          moment.status.message = toast;
          moment.status.hint = said.back();
          const Hud hud =
              in_words(attempt_view(view_of(scene, moment), kLongestCode, attempt_camera(scene)).hud, model->words());
          for (const auto& [width, height] : kWindows) {
            for (const double scale : {1.0, 1.5, 2.0}) {
              const std::string where = std::string(language) + "_" + Sight{width, height, scale}.name();
              const std::string page = exercise.number + " " + level.name;
              const HudLayout layout = layout_hud(hud, width, height, scale, fonts);
              std::vector<DrawnText> texts;
              for (const HudText& t : layout.texts)
                texts.push_back({t.text, t.box.x, t.box.y, t.box.width, t.box.height, t.box.width,
                                 t.text.ends_with("\u2026"), false, true});
              faults.look_at(texts, width, height, page, where);
              const auto shown =
                  std::count_if(hud.bars.begin(), hud.bars.end(), [](const ForceBar& bar) { return !bar.hidden; });
              if (static_cast<long>(layout.bars.size()) < shown) faults.add(page + ": a force bar is gone", where);
              const auto holds = [&](const std::string& part) {
                return std::any_of(layout.texts.begin(), layout.texts.end(),
                                   [&](const HudText& t) { return t.text.find(part) != std::string::npos; });
              };
              if (!hud.rows.empty() && hud.rows.back().unit == "%" && !holds("72 %"))
                faults.add(page + ": the hold is gone", where);
            }
          }
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Languages, EverySize, ::testing::Values("en", "fr", "de"),
                         [](const auto& one) { return std::string(one.param); });

}  // namespace
}  // namespace trocar::testing_support::every_size_test
