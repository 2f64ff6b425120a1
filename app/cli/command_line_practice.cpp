#include "app/cli/command_line_practice.h"

#include <iostream>

#include <CLI/CLI.hpp>

#include "app/session/setup/typed_path.h"
#include "app/window/practice_command.h"

namespace trocar {

namespace {
const CLI::Validator kPracticePath([](std::string& path) { return typed_path_fault(path); }, "PATH");
}

struct PracticeCommandLine {
  PracticeOptions options;
  double scale = 1;
  std::int64_t seed = 0;
};

std::shared_ptr<PracticeCommandLine> add_practice_command(CLI::App& app,
                                                          const std::function<void(std::function<int()>)>& choose) {
  auto c = std::make_shared<PracticeCommandLine>();
  PracticeOptions& o = c->options;
  CLI::App* practice = app.add_subcommand("practice", "The trainee's window: see, feel, be judged, try again");
  practice->add_option("exercise", o.desk.exercise, "Exercise id, number or FILE.toml: straight to its briefing");
  practice->add_option("--level", o.desk.level, "Level: L1, L2, L3 or exam")->capture_default_str();
  practice->add_option("--trainee", o.desk.trainee,
                       "Trainee code, created when new (default: a guest, until signed in)");
  practice
      ->add_option("--input", o.desk.input,
                   "What steers: auto (the first that moves), mouse, keyboard, gamepad, spacemouse or device")
      ->capture_default_str()
      ->check(CLI::IsMember({"auto", "mouse", "keyboard", "gamepad", "spacemouse", "device"}));
  practice
      ->add_option("--organ", o.desk.organ,
                   "NAME.organ.toml, NAME.scene.toml (#ORGAN behind it: another subject) or a shipped organ")
      ->capture_default_str();
  practice->add_option("--db", o.desk.database, "Database file, or :memory:, which keeps nothing")
      ->check(kPracticePath);
  CLI::Option* scale =
      practice->add_option("--scale", c->scale, "Size of text and buttons, this time (default: as in the settings)")
          ->check(CLI::Range(1.0, 2.0));
  practice->add_option("--language", o.desk.language,
                       "en, fr or de, this time (default: as in the settings, else of LANG)");
  practice
      ->add_option(
          "--scope", o.desk.scope,
          "Tip of the scope, degrees, this time: 0 or 30, turned by its light post (default: as in the settings)")
      ->check(CLI::IsMember({"0", "30"}));
  practice
      ->add_option("--settings", o.desk.settings, "Settings file (default: trocar/settings.toml in $XDG_CONFIG_HOME)")
      ->check(kPracticePath);
  practice->add_option("--hand", o.desk.hand,
                       "A scripted hand in place of a person: expert, novice, ... or SCRIPT.toml");
  CLI::Option* seed =
      practice->add_option("--seed", c->seed, "Every attempt draws its board from this (default: a fresh one each)");
  practice->add_option("--width", o.width, "Of the window, px")->capture_default_str()->check(CLI::Range(200, 16384));
  practice->add_option("--height", o.height, "Of the window, px")->capture_default_str()->check(CLI::Range(100, 16384));
  practice->add_flag("--fullscreen", o.fullscreen, "Fill the screen (F11 turns it on and off)");
  practice->add_option("--screens", o.screens, "No window: a PNG of every screen into this folder")
      ->check(kPracticePath);
  practice->add_flag("--timing", o.timing,
                     "Say how soon the first frame and the debrief stood, and how many frames there were");
  practice->callback([c = c.get(), scale, seed, choose] {
    if (scale->count() > 0) c->options.desk.scale = c->scale;
    if (seed->count() > 0) c->options.desk.seed = c->seed;
    choose([c] { return practice_command(c->options, std::cout, std::cerr); });
  });
  return c;
}

}  // namespace trocar
