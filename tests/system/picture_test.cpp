// What needs a picture: rendering never reaches the result, the demo leaves its files. Skipped, loudly, without EGL.
#include <iostream>

#include "tests/system/system_fixture.h"

namespace trocar::test::picture_test {
namespace {

namespace fs = std::filesystem;

class Pictures : public SystemTest {
 protected:
  void SetUp() override {
    const Outcome probe =
        trocar({"organ", "render", "phantom-gallbladder", "-o", "probe.png", "--width", "320", "--height", "240"});
    if (probe.exit_code == 3 && probe.err.find("EGL") != std::string::npos) {
      std::cerr << "SKIPPED: this machine draws no pictures: " << probe.err;
      GTEST_SKIP() << probe.err;
    }
    ASSERT_EQ(probe.exit_code, 0) << probe.err;
    expect_png("probe.png");
  }

  void expect_png(const std::string& name) const {
    const std::string bytes = file_bytes(folder_ / name);
    EXPECT_EQ(bytes.substr(0, 8), std::string("\x89PNG\r\n\x1a\n")) << name;
    EXPECT_GT(bytes.size(), 500u) << name;
  }
};

TEST_F(Pictures, RenderingDoesNotReachTheResult) {
  Json plain = json_of(short_run({"--db", ":memory:", "--record", "plain.trec"}), 1);
  Json drawn =
      json_of(short_run({"--db", ":memory:", "--record", "drawn.trec", "--frames", "frames", "--fps", "0.5"}), 1);
  EXPECT_EQ(plain["state_hash"], drawn["state_hash"]);
  EXPECT_EQ(plain["recording_sha256"], drawn["recording_sha256"]);
  plain.erase("attempt");
  drawn.erase("attempt");
  EXPECT_EQ(plain.dump(), drawn.dump());
  expect_png("frames/frame_00001.png");
  expect_png("frames/frame_00002.png");
}

TEST_F(Pictures, AReplayDrawsTheSamePicturesAndVerifies) {
  json_of(short_run({"--db", ":memory:", "--record", "a.trec", "--frames", "live", "--fps", "0.4"}), 1);
  const Outcome replay = trocar({"replay", "a.trec", "--verify", "--frames", "again", "--fps", "0.4"});
  EXPECT_EQ(replay.exit_code, 0) << replay.out << replay.err;
  std::size_t compared = 0;
  for (const auto& entry : fs::directory_iterator(folder_ / "live")) {
    const fs::path other = folder_ / "again" / entry.path().filename().string();
    EXPECT_TRUE(fs::exists(other)) << other;
    ++compared;
  }
  EXPECT_GE(compared, 2u);
}

TEST_F(Pictures, FramesThatCannotBeWrittenAreTheMachinesFault) {
  folder_.write("file", "not a folder");
  expect_refusal(short_run({"--db", ":memory:", "--frames", "file"}), 3, "file");
}

TEST_F(Pictures, TheDemoLeavesPictureScoreAndReport) {
  const Outcome demo = trocar({"demo", "--headless", "--out", "demo"});
  EXPECT_EQ(demo.exit_code, 0) << demo.err;
  expect_png("demo/picture.png");
  const Json score = Json::parse(file_bytes(folder_ / "demo/score.json"));
  EXPECT_EQ(score["status"], "completed");
  EXPECT_TRUE(score["passed"].get<bool>());
  const std::string report = file_bytes(folder_ / "demo/report.html");
  EXPECT_EQ(report.substr(0, 15), "<!DOCTYPE html>");
  EXPECT_NE(report.find("Surface touch"), std::string::npos);
  EXPECT_NE(report.find("synthetic"), std::string::npos) << "a synthetic organ is called one";
  for (const char* file : {"picture.png", "score.json", "report.html"})
    EXPECT_NE(demo.out.find(file), std::string::npos) << file;
  EXPECT_EQ(trocar({"replay", "latest", "--db", "demo/demo.db", "--verify"}).exit_code, 0);
  EXPECT_EQ(trocar({"demo", "--headless", "--out", "demo"}).exit_code, 0) << "twice in a row";
  EXPECT_FALSE(fs::exists(folder_ / "data")) << "the demo keeps to its folder";
}

TEST_F(Pictures, ADemoThatCannotBeWrittenIsTheMachinesFault) {
  folder_.write("file", "not a folder");
  expect_refusal({"demo", "--headless", "--out", "file/demo"}, 3, "file/demo");
}

}  // namespace
}  // namespace trocar::test::picture_test
