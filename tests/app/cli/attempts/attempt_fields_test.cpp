// Fields of a TissueFrame: into the state hash only when there are any, into the picture as they are.
#include <gtest/gtest.h>

#include "app/picture/attempt/attempt_scene.h"
#include "app/session/lanes/state_hash.h"
#include "app/session/setup/scene.h"

namespace trocar::attempt_fields_test {
namespace {

/// The frame whose hash was taken before tissue could bear marks.
TissueFrame plain_frame() {
  TissueFrame f;
  f.stamp = 7;
  f.t_s = 0.25;
  f.object_count = 1;
  f.object[0].size_m = Vec3(0.014, 0.014, 0.02);
  f.object[0].X_TO.p = Vec3(0.01, 0.02, 0.03);
  f.grip = GripState::kHolding;
  f.grip_object = 0;
  f.slipped_m = 0.001;
  f.pair_count = 1;
  f.pair[0].a = 0;
  f.pair[0].b = kPartyBoard;
  f.pair[0].force_n = 0.5;
  return f;
}

std::string hash_of(const TissueFrame& frame) {
  StateHash hash;
  hash.add(frame);
  return hash.hex();
}

TEST(StateHashOfFields, UnmarkedTissueKeepsTheHashOfOldRecordings) {
  EXPECT_EQ(hash_of(plain_frame()), "cc44571c492d6914");
  EXPECT_EQ(hash_of(TissueFrame{}), "0e8493cadbb4da8e");
  TissueFrame unused = plain_frame();
  unused.mark[3].radius_m = 1;  // beyond mark_count
  EXPECT_EQ(hash_of(unused), hash_of(plain_frame()));
}

TEST(StateHashOfFields, EveryFieldCounts) {
  const std::string plain = hash_of(plain_frame());
  TissueFrame marked = plain_frame();
  marked.mark_count = 1;
  marked.mark[0] = {TissueMarkKind::kBlood, Vec3(1, 2, 3), 0.004, 1};
  EXPECT_NE(hash_of(marked), plain);
  TissueFrame other = marked;
  other.mark[0].kind = TissueMarkKind::kChar;
  EXPECT_NE(hash_of(other), hash_of(marked));
  other = marked;
  other.mark[0].centre_T.x() += 1e-12;
  EXPECT_NE(hash_of(other), hash_of(marked));
  other = marked;
  other.mark[0].strength = 0.5;
  EXPECT_NE(hash_of(other), hash_of(marked));
  for (double TissueFrame::*field : {&TissueFrame::smoke_per_m, &TissueFrame::lens_fog, &TissueFrame::lens_blood}) {
    TissueFrame hazy = plain_frame();
    hazy.*field = 0.3;
    EXPECT_NE(hash_of(hazy), plain);
  }
}

TEST(AttemptSceneOfFields, ShowsWhatTheFrameHolds) {
  Scene scene;
  DirectorStatus status;
  TickRecord record;
  TissueFrame frame;
  frame.mark_count = 2;
  frame.mark[0] = {TissueMarkKind::kBlood, Vec3(0.01, 0, 0), 0.004, 1};
  frame.mark[1] = {TissueMarkKind::kWet, Vec3(0, 0.01, 0), 0.003, 0.5};
  frame.smoke_per_m = 3;
  frame.lens_fog = 0.2;
  frame.lens_blood = 0.1;
  const SceneView view = attempt_scene({scene, record, {status, scene.board}, 0, &frame});
  ASSERT_EQ(view.marks.size(), 2U);
  EXPECT_EQ(view.marks[1], frame.mark[1]);
  EXPECT_EQ(view.smoke_per_m, 3);
  EXPECT_EQ(view.lens.fog, 0.2);
  EXPECT_EQ(view.lens.blood, 0.1);
  EXPECT_EQ(view.lens.wipe, 0);
  const SceneView without = attempt_scene({scene, record, {status, scene.board}, 0, nullptr});
  EXPECT_TRUE(without.marks.empty());
  EXPECT_EQ(without.smoke_per_m, 0);
}

}  // namespace
}  // namespace trocar::attempt_fields_test
