#include "app/cli/attempts/demo_command.h"

#include <algorithm>
#include <iostream>
#include <memory>
#include <optional>
#include <sstream>

#include <CLI/CLI.hpp>

#include "app/cli/attempts/attempt_json.h"
#include "app/cli/attempts/replay_film.h"
#include "app/cli/attempts/run_command.h"
#include "app/cli/command.h"
#include "app/desk/report_command.h"
#include "app/picture/attempt/attempt_picture.h"
#include "app/picture/films/video_writer.h"
#include "app/picture/kinds/kind_picture.h"
#include "haptics/input_error.h"
#include "scenarios/director/scoring_context.h"
#include "tissue/tissue_frame.h"
#include "trainees/files/write_file.h"

namespace trocar {
namespace {

/// What the board asks for: some kinds need two places for one.
int asked_for(const Scene& scene) {
  const ScoringContext context =
      scoring_context(scene.setup.exercise, scene.level, scene.board, {}, AttemptStatus::kAborted);
  return std::min(static_cast<int>(scene.board.targets.size()), context.objects_total);
}

/// The moment that shows most of an exercise: half way, so that done, lit and waiting are all in view.
bool telling_moment(const SessionView& view) {
  if (2 * view.director.status().targets_done < asked_for(view.scene)) return false;
  return picture_of(view.scene.setup.exercise).telling(view);
}

/// Takes the one picture of the demo as soon as the moment has come.
class Photographer {
 public:
  Photographer(const AssetRoots& assets, const std::string& trainee) : painter_(assets, trainee) {}
  void observe(const SessionView& view) {
    if (!picture_ && telling_moment(view)) picture_ = painter_.paint(view);
  }
  const std::optional<Image>& picture() const { return picture_; }

 private:
  AttemptPainter painter_;
  std::optional<Image> picture_;
};

}  // namespace

int demo_command(const DemoOptions& options, std::ostream& out, std::ostream& err) {
  const AssetRoots assets = find_assets();
  if (!options.video.empty()) check_video_file(options.video);
  std::error_code error;
  std::filesystem::create_directories(options.output, error);
  if (error) throw EnvironmentError(options.output.string() + ": cannot be made: " + error.message());

  RunOptions run;
  run.exercise = options.exercise;
  run.level = options.level;
  run.hand = "expert";
  run.organ = options.organ;
  run.trainee = "demo-expert";
  run.database = options.output / "demo.db";
  const AttemptSetup setup = attempt_setup(run, assets);
  const Scene scene = build_scene(setup, assets, {"simulated", setup.rate_hz, 16});
  Photographer photographer(assets, run.trainee);
  const AttemptResult result =
      run_attempt(run, scene, assets, err, [&](const SessionView& view) { photographer.observe(view); });

  const auto picture = options.output / "picture.png", score = options.output / "score.json",
             report = options.output / "report.html";
  if (photographer.picture()) write_png(picture, *photographer.picture());
  write_owner_file(score, attempt_json(result));
  std::ostringstream named;
  review_report({.database = run.database, .out = report, .attempt = result.uuid, .force = true}, named, err);
  if (!options.video.empty()) {
    RecordingOptions film;
    film.video = options.video;
    replay_as_film(film, find_subject(result.recording_path, {}, err), assets, err);
  }
  print_result(result, out);
  out << "picture  " << (photographer.picture() ? picture.string() : "none: the attempt did not come half way")
      << "\nscore    " << score.string() << "\nreport   " << report.string() << '\n';
  return exit_code(result);
}

namespace {
struct DemoArguments {
  DemoOptions demo;
  bool headless = false;
};
}  // namespace

void add_demo(CLI::App& parent, CommandAction& chosen) {
  const auto given = std::make_shared<DemoArguments>();
  DemoOptions& o = given->demo;
  CLI::App* demo = add_command(parent, "demo", "The whole chain once: picture, score, report", chosen,
                               [given] { return demo_command(given->demo, std::cout, std::cerr); });
  demo->add_flag("--headless", given->headless, "Without a window, as it always is; trocar practice is the window");
  demo->add_option("--out", o.output, "Folder")->capture_default_str()->check(writable_path());
  demo->add_option("--video", o.video, "Film of it too: FILE.mp4, .webm or .mkv, by ffmpeg")->check(writable_path());
  demo->add_option("--exercise", o.exercise, "Identifier of the exercise, or its TOML file")->capture_default_str();
  demo->add_option("--level", o.level, "L1, L2, L3 or exam")->capture_default_str();
  demo->add_option("--organ", o.organ, kOrganForms)->capture_default_str();
}

}  // namespace trocar
