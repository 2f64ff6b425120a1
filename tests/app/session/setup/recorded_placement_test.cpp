// The organ's place in a recording: replay lays it where it lay, to the last bit, and searches only for recordings that
// do not say.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "app/session/session.h"
#include "app/session/setup/recorded_scene.h"
#include "haptics/input_error.h"
#include "scenarios/files/exercise_loader.h"
#include "tests/tissue/support/temporary_folder.h"

namespace trocar::recorded_placement_test {
namespace {

using Json = nlohmann::json;

class RecordedPlacement : public ::testing::Test {
 protected:
  static AttemptSetup setup() {
    std::string text = find_exercise("surface-touch", find_assets().exercises).text;
    text.replace(text.find("count = 12"), 10, "count = 2");
    AttemptSetup out;
    out.exercise = parse_exercise(text, "short.toml");
    out.organ = "phantom-liver";
    out.hand = "expert";
    return out;
  }
  static Scene built(const AttemptSetup& setup) { return build_scene(setup, find_assets(), {"simulated", 1000, 16}); }
  static Recording of(const Scene& scene) {
    Recording recording;
    recording.session = scene_json(scene);
    return recording;
  }
  static Scene again(const Recording& recording) { return recorded_scene(recording, "a.trec", find_assets()); }
};

TEST_F(RecordedPlacement, ComesBackToTheLastBit) {
  const Scene scene = built(setup());
  const Scene replayed = again(of(scene));
  EXPECT_EQ(replayed.placement.X_TO.R, scene.placement.X_TO.R);
  EXPECT_EQ(replayed.placement.X_TO.p, scene.placement.X_TO.p);
  EXPECT_EQ(replayed.placement.free_m2, scene.placement.free_m2);
  ASSERT_EQ(replayed.organ_T->vertices.size(), scene.organ_T->vertices.size());
  EXPECT_EQ(replayed.organ_T->vertices.back(), scene.organ_T->vertices.back());
  EXPECT_EQ(scene_json(replayed), scene_json(scene)) << "a replay of a replay is the same";
}

TEST_F(RecordedPlacement, IsUsedAndNotSearchedForAgain) {
  AttemptSetup elsewhere = setup();
  elsewhere.placement = built(setup()).placement;
  elsewhere.placement->X_TO.p.x() += 1e-4;  // where no search would lay it
  elsewhere.placement->turn_rad = 0.25;
  const Scene replayed = again(of(built(elsewhere)));
  EXPECT_EQ(replayed.placement.X_TO.p, elsewhere.placement->X_TO.p);
  EXPECT_EQ(replayed.placement.turn_rad, 0.25);
}

TEST_F(RecordedPlacement, ARecordingWithoutItIsSearchedAsBefore) {
  const Scene scene = built(setup());
  Recording old = of(scene);
  Json json = Json::parse(old.session);
  ASSERT_TRUE(json.contains("placement"));
  json.erase("placement");
  old.session = json.dump();
  EXPECT_EQ(again(old).placement.X_TO.p, scene.placement.X_TO.p);
}

TEST_F(RecordedPlacement, APlaceThatIsNoPoseIsRefusedByName) {
  const Recording sound = of(built(setup()));
  for (const auto& [key, value] :
       {std::pair{"R", Json{{1, 0, 0}, {0, 1, 0}, {0, 0, 2}}}, std::pair{"R", Json{{1, 0, 0}, {0, 1, 0}, {0, 0, -1}}},
        std::pair{"p_m", Json{0, 0, 1e9}}, std::pair{"p_m", Json{0, 0}}, std::pair{"R", Json("upright")},
        std::pair{"roll_rad", Json("a lot")}}) {
    Json json = Json::parse(sound.session);
    json["placement"][key] = value;
    Recording bad;
    bad.session = json.dump();
    EXPECT_CONTAINS(test::message_of<InputError>([&] { again(bad); }), "a.trec") << key << value;
  }
}

TEST_F(RecordedPlacement, AnExerciseWithoutAnOrganHasNone) {
  AttemptSetup reach;
  reach.exercise = find_exercise("E01", find_assets().exercises);
  const Scene scene = built(reach);
  EXPECT_FALSE(Json::parse(scene_json(scene)).contains("placement"));
  EXPECT_FALSE(again(of(scene)).setup.placement.has_value());
}

}  // namespace
}  // namespace trocar::recorded_placement_test
