#include "tests/app/session/playback/playback_samples.h"

#include "scenarios/files/exercise_loader.h"

namespace trocar {

AttemptSetup short_setup(const std::string& hand) {
  std::string text = find_exercise("surface-touch", find_assets().exercises).text;
  text.replace(text.find("count = 12"), 10, "count = 2");
  text.replace(text.find("time_limit_s = 120"), 18, "time_limit_s = 30");
  AttemptSetup setup;
  setup.exercise = parse_exercise(text, "short.toml");
  setup.organ = "phantom-liver";
  setup.hand = hand;
  setup.seed = 5;
  setup.board = 1;
  return setup;
}

Scene short_scene(const std::string& hand) {
  return build_scene(short_setup(hand), find_assets(), {"simulated", 1000, 16});
}

std::filesystem::path record_short(const std::filesystem::path& file, const std::string& hand,
                                   const SessionObserver& observe) {
  SessionHooks hooks;
  hooks.observe = observe;
  record_session(short_scene(hand), find_assets(), hooks, file);
  return file;
}

}  // namespace trocar
