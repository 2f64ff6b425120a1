// Films by ffmpeg: what ffprobe says of them, and what happens when it cannot be.
#include "app/picture/films/video_writer.h"

#include <gtest/gtest.h>

#include <sys/stat.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <stdexcept>

#include "haptics/input_error.h"
#include "tests/tissue/support/temporary_folder.h"

namespace trocar::video_writer_test {
namespace {

using test::message_of;

/// A grey ground that brightens, with a white square that moves.
Image picture(int width, int height, int number) {
  Image image(width, height);
  std::fill(image.rgb.begin(), image.rgb.end(), static_cast<std::uint8_t>(20 + 4 * number));
  for (int y = 4; y < 12; ++y)
    for (int x = number; x < number + 8 && x < width; ++x) std::fill_n(image.pixel(x, y), 3, std::uint8_t{255});
  return image;
}

std::string output_of(const std::string& command) {
  std::string out;
  FILE* pipe = ::popen(command.c_str(), "r");
  std::array<char, 256> buffer;
  while (pipe && std::fgets(buffer.data(), buffer.size(), pipe)) out += buffer.data();
  if (pipe) ::pclose(pipe);
  return out;
}

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

class Videos : public ::testing::Test {
 protected:
  void SetUp() override {
    if (find_ffmpeg().empty() || output_of("command -v ffprobe").empty())
      GTEST_SKIP() << "NO FILM IS TESTED HERE: ffmpeg is not installed";
  }
  /// codec, width, height, frames, duration
  static std::string probe(const std::filesystem::path& file) {
    return output_of(
        "ffprobe -v error -count_frames -select_streams v -show_entries "
        "stream=codec_name,width,height,nb_read_frames,r_frame_rate"
        " -of csv=p=0 '" +
        file.string() + "'");
  }
  static double seconds(const std::filesystem::path& file) {
    return std::atof(
        output_of("ffprobe -v error -show_entries format=duration -of csv=p=0 '" + file.string() + "'").c_str());
  }
  void write(const std::filesystem::path& file, int width, int height, int count, double fps = 25) {
    VideoWriter film(file, width, height, fps);
    for (int i = 0; i < count; ++i) film.add(picture(width, height, i));
    EXPECT_EQ(film.frames(), count);
    film.close();
  }
  test::TemporaryFolder folder_;
};

TEST_F(Videos, HoldThePicturesAtTheirSizeAndRate) {
  write(folder_ / "a.mp4", 64, 48, 30);
  EXPECT_EQ(probe(folder_ / "a.mp4"), "h264,64,48,25/1,30\n");
  EXPECT_NEAR(seconds(folder_ / "a.mp4"), 1.2, 0.01);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "a.mp4.part"));
}

TEST_F(Videos, TheNameSaysTheKind) {
  write(folder_ / "a.mkv", 64, 48, 10, 12.5);
  EXPECT_EQ(probe(folder_ / "a.mkv"), "h264,64,48,25/2,10\n");
  write(folder_ / "a.webm", 64, 48, 10);
  EXPECT_EQ(probe(folder_ / "a.webm"), "vp9,64,48,25/1,10\n");
}

TEST_F(Videos, OddSizesGetABlackLineMore) {
  write(folder_ / "odd.mp4", 65, 47, 3);
  EXPECT_EQ(probe(folder_ / "odd.mp4"), "h264,66,48,25/1,3\n");
}

TEST_F(Videos, ThePictureIsTheOneThatWasGiven) {
  write(folder_ / "a.mp4", 64, 48, 20);
  const std::string raw = output_of(find_ffmpeg() + " -v error -ss 0.4 -i '" + (folder_ / "a.mp4").string() +
                                    "' -frames:v 1 -f rawvideo -pix_fmt gray - | od -An -v -tu1 -w1 -j" +
                                    std::to_string(40 * 64 + 5) + " -N1");
  EXPECT_NEAR(std::atoi(raw.c_str()), 20 + 4 * 10, 6) << "the ground of picture 10";
}

TEST_F(Videos, TheSamePicturesGiveTheSameBytes) {
  write(folder_ / "a.mp4", 64, 48, 12);
  write(folder_ / "b.mp4", 64, 48, 12);
  EXPECT_GT(bytes_of(folder_ / "a.mp4").size(), 500u);
  EXPECT_TRUE(bytes_of(folder_ / "a.mp4") == bytes_of(folder_ / "b.mp4"));
}

TEST_F(Videos, NamesAreTakenAsTheyAre) {
  const auto folder = folder_ / "-i; rm *";
  std::filesystem::create_directories(folder);
  write(folder / "a:b %d 'c'.mkv", 64, 48, 2);
  EXPECT_GT(std::filesystem::file_size(folder / "a:b %d 'c'.mkv"), 100u);
}

TEST_F(Videos, AnExistingFileIsNeverOverwritten) {
  const auto file = folder_.write("a.mp4", "precious");
  EXPECT_CONTAINS(message_of<InputError>([&] { VideoWriter(file, 64, 48, 25); }), "never overwritten");
  VideoWriter film(folder_ / "b.mp4", 64, 48, 25);
  film.add(picture(64, 48, 0));
  folder_.write("b.mp4", "came meanwhile");
  EXPECT_CONTAINS(message_of<EnvironmentError>([&] { film.close(); }), "exists by now");
  EXPECT_EQ(bytes_of(folder_ / "b.mp4"), "came meanwhile");
  EXPECT_EQ(bytes_of(file), "precious");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "b.mp4.part"));
}

TEST_F(Videos, WithoutCloseNothingStays) {
  {
    VideoWriter film(folder_ / "a.mp4", 64, 48, 25);
    for (int i = 0; i < 5; ++i) film.add(picture(64, 48, i));
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
}

TEST_F(Videos, OtherEndingsSizesAndFoldersAreRefused) {
  EXPECT_CONTAINS(message_of<InputError>([&] { VideoWriter(folder_ / "a.avi", 64, 48, 25); }), ".mp4, .webm or .mkv");
  EXPECT_CONTAINS(message_of<EnvironmentError>([&] { VideoWriter(folder_ / "none" / "a.mp4", 64, 48, 25); }),
                  "cannot be written");
  EXPECT_THROW(VideoWriter(folder_ / "a.mp4", 8, 48, 25), std::invalid_argument);
  EXPECT_THROW(VideoWriter(folder_ / "a.mp4", 64, 48, 0), std::invalid_argument);
  VideoWriter film(folder_ / "a.mp4", 64, 48, 25);
  EXPECT_THROW(film.add(picture(64, 50, 0)), std::invalid_argument);
  EXPECT_CONTAINS(message_of<EnvironmentError>([&] { film.close(); }), "a.mp4");
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path())) << "a film without pictures is none";
}

TEST_F(Videos, AFullDiskIsSaidAndLeavesNothing) {
  std::filesystem::create_symlink("/dev/full", folder_ / "a.mkv.part");
  VideoWriter film(folder_ / "a.mkv", 320, 240, 25);
  const std::string said = message_of<EnvironmentError>([&] {
    for (int i = 0; i < 50; ++i) film.add(picture(320, 240, i));
    film.close();
  });
  EXPECT_CONTAINS(said, "a.mkv");
  EXPECT_CONTAINS(said, "No space left");
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
}

/// ffmpeg is a script in a folder of its own.
class FakeFfmpeg : public ::testing::Test {
 protected:
  void TearDown() override { ::setenv("PATH", path_.c_str(), 1); }
  void use(const std::string& script) {
    folder_.write("ffmpeg", "#!/bin/sh\n" + script);
    ::chmod((folder_ / "ffmpeg").c_str(), 0755);
    ::setenv("PATH", (folder_.path().string() + ":/usr/bin:/bin").c_str(), 1);
    ASSERT_EQ(find_ffmpeg(), (folder_ / "ffmpeg").string());
  }
  test::TemporaryFolder folder_;
  const std::string path_ = std::getenv("PATH");
};

TEST_F(FakeFfmpeg, ThatDiesIsHeardToItsLastWords) {
  use("echo 'Unknown encoder libx264' >&2\nexit 1\n");
  VideoWriter film(folder_ / "a.mp4", 640, 480, 25);
  const std::string said = message_of<EnvironmentError>([&] {
    for (int i = 0; i < 20; ++i) film.add(picture(640, 480, i));
  });
  EXPECT_CONTAINS(said, "Unknown encoder libx264");
  EXPECT_THROW(film.add(picture(640, 480, 0)), std::logic_error) << "it is over";
  EXPECT_FALSE(std::filesystem::exists(folder_ / "a.mp4.part"));
}

TEST_F(FakeFfmpeg, ThatFailsAtTheEndIsHeardThen) {
  use("cat > /dev/null\necho 'trailer: No space left on device' >&2\nexit 1\n");
  VideoWriter film(folder_ / "a.mp4", 64, 48, 25);
  film.add(picture(64, 48, 0));
  EXPECT_CONTAINS(message_of<EnvironmentError>([&] { film.close(); }), "No space left on device");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "a.mp4"));
}

TEST_F(FakeFfmpeg, ThatTalksALotDoesNotBlock) {
  use("i=0; while [ $i -lt 20000 ]; do echo 'warning, a long line that says nothing of any use' >&2; i=$((i+1)); "
      "done\ncat > /dev/null\nexit 3\n");
  VideoWriter film(folder_ / "a.mp4", 640, 480, 25);
  const std::string said = message_of<EnvironmentError>([&] {
    for (int i = 0; i < 5; ++i) film.add(picture(640, 480, i));
    film.close();
  });
  EXPECT_LT(said.size(), 1000u) << "only the last of it";
}

TEST_F(FakeFfmpeg, ThatIsNotThereIsSaidWithTheWayOut) {
  ::setenv("PATH", folder_.path().c_str(), 1);
  EXPECT_EQ(find_ffmpeg(), "");
  const std::string said = message_of<EnvironmentError>([&] { VideoWriter(folder_ / "a.mp4", 64, 48, 25); });
  EXPECT_CONTAINS(said, "ffmpeg");
  EXPECT_CONTAINS(said, "--frames");
  folder_.write("ffmpeg", "not executable");
  EXPECT_EQ(find_ffmpeg(), "");
}

}  // namespace
}  // namespace trocar::video_writer_test
