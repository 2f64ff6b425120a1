// The clutch through the whole session: a script that presses it, in both mappings, and what is counted and recorded.
#include <gtest/gtest.h>

#include <fstream>

#include "app/session/session.h"
#include "scenarios/files/exercise_loader.h"
#include "tests/tissue/support/temporary_folder.h"

namespace trocar::clutch_session_test {
namespace {

/// To the start sphere, into the run, then 20 mm aside with the clutch held, then on from there.
constexpr const char* kScript = R"(name = "clutcher"
kind = "waypoints"
[[move]]
to_mm = [0, 0, 45]
seconds = 1.5
hold_s = 1.6
[[move]]
to_mm = [0, 20, 45]
seconds = 0.8
hold_s = 0.3
clutch = true
[[move]]
to_mm = [0, 10, 45]
seconds = 0.5
hold_s = 0.4
)";

struct ClutchRun {
  Recording recording;
  std::vector<StylusState> states;
};

ClutchRun run(const std::string& mapping) {
  const test::TemporaryFolder folder;
  const auto script = folder / "clutcher.toml";
  std::ofstream(script) << kScript;
  const AssetRoots assets = find_assets();
  std::string text = find_exercise("surface-touch", assets.exercises).text;
  const std::string from = "mapping = \"direct\"";
  text.replace(text.find(from), from.size(), mapping);
  text.replace(text.find("time_limit_s = 120"), 18, "time_limit_s = 6");
  const std::string expert = "expert_time_s = ";
  for (auto at = text.find(expert); at != std::string::npos; at = text.find(expert, at + 1)) {
    const auto end = text.find_first_of(" \n", at + expert.size());
    text.replace(at, end - at, expert + "5");
  }
  AttemptSetup setup;
  setup.exercise = parse_exercise(text, "clutch.toml");
  setup.organ = "phantom-liver";
  setup.hand = script.string();
  const Scene scene = build_scene(setup, assets, {"simulated", 1000, 16});
  MemorySink memory;
  RecordingWriter writer(memory, scene_json(scene), 1000);
  ClutchRun out;
  run_session(scene, assets, writer, [&](const SessionView& view) { out.states.push_back(view.record.stylus); });
  out.recording = parse_recording(memory.bytes(), "memory");
  return out;
}

class ClutchSession : public testing::TestWithParam<const char*> {};

TEST_P(ClutchSession, IsCountedAndLeavesTheInstrumentWhereItWas) {
  const ClutchRun r = run(GetParam());
  int clutches = 0;
  for (const Event& event : r.recording.events) clutches += event.type == "CLUTCH";
  EXPECT_EQ(clutches, 1);
  const auto first = std::find_if(r.states.begin(), r.states.end(), [](const auto& s) { return s.clutched; });
  ASSERT_NE(first, r.states.end());
  const auto after = std::find_if(first, r.states.end(), [](const auto& s) { return !s.clutched; });
  ASSERT_NE(after, r.states.end());
  // Observed every 10 ms; the hand begins its next move in that time.
  EXPECT_LT((after->X_TI.p - first->X_TI.p).norm(), 0.5e-3) << "nothing jumped";
  EXPECT_GT(after->registration.shift_T.norm(), 0.010) << "the stylus had been moved by about 20 mm";
  // The script's last goal lies 10 mm further on in T. The hand stands behind it by what the plant's weight pulls.
  EXPECT_NEAR((r.states.back().X_TI.p - after->X_TI.p).y(), 0.010, 4e-3);
}

TEST_P(ClutchSession, TheSwitchStandsInTheRecordedInput) {
  const ClutchRun r = run(GetParam());
  int pressed = 0;
  for (const RecordedTick& tick : r.recording.ticks) pressed += (tick.digital_in & kClutch) != 0;
  EXPECT_NEAR(pressed, 1100, 5) << "0.8 s and 0.3 s";
}

INSTANTIATE_TEST_SUITE_P(BothMappings, ClutchSession,
                         testing::Values("mapping = \"direct\"", "mapping = \"fulcrum\"\nport_mm = [30, -60, 120]"),
                         [](const auto& mapping) { return mapping.index == 0 ? "Direct" : "Fulcrum"; });

}  // namespace
}  // namespace trocar::clutch_session_test
