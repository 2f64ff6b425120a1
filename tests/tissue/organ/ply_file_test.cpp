#include "tissue/organ/ply_file.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <random>

#include "haptics/input_error.h"
#include "tests/tissue/support/shapes.h"
#include "tests/tissue/support/temporary_folder.h"

namespace trocar::ply_file_test {
namespace {

std::string refusal(const std::string& bytes) {
  return test::message_of<InputError>([&] { parse_ply(bytes, "organ.ply"); });
}

TEST(PlyFile, ReadsBackWhatItWrote) {
  const TriangleSurface surface = test::sphere(Vec3(0.25, -0.5, 1), 0.125, 3);
  const std::string bytes = ply_bytes(surface);
  const TriangleSurface back = parse_ply(bytes, "organ.ply");
  EXPECT_EQ(back.triangles, surface.triangles);
  ASSERT_EQ(back.vertices.size(), surface.vertices.size());
  for (std::size_t v = 0; v < back.vertices.size(); ++v)
    EXPECT_LT((back.vertices[v] - surface.vertices[v]).norm(), 1.1e-7);  // float32 at 1 m
  EXPECT_EQ(ply_bytes(back), bytes);
}

TEST(PlyFile, NamesTheHeaderLineAtFault) {
  std::string bytes = ply_bytes(test::box(Vec3::Zero(), Vec3::Ones()));
  EXPECT_CONTAINS(refusal("obj\n"), "organ.ply:1:1");
  std::string ascii = bytes;
  ascii.replace(ascii.find("binary_little_endian"), 20, "ascii");
  EXPECT_CONTAINS(refusal(ascii), "organ.ply:2:1");
  std::string count = bytes;
  count.replace(count.find("vertex 8"), 8, "vertex x");
  EXPECT_CONTAINS(refusal(count), "organ.ply:4:1");
  EXPECT_CONTAINS(refusal("ply\nformat binary_little_endian 1.0"), "does not end");
}

TEST(PlyFile, RefusesWrongLengths) {
  const std::string bytes = ply_bytes(test::box(Vec3::Zero(), Vec3::Ones()));
  EXPECT_CONTAINS(refusal(bytes.substr(0, bytes.size() - 1)), "cut off");
  EXPECT_CONTAINS(refusal(bytes + "x"), "follows");
}

TEST(PlyFile, RefusesBadIndicesAndNumbers) {
  const std::string bytes = ply_bytes(test::box(Vec3::Zero(), Vec3::Ones()));
  std::string index = bytes;
  index[bytes.size() - 4] = 8;
  EXPECT_CONTAINS(refusal(index), "face 11 names vertex 8 of 8");
  std::string quad = bytes;
  quad[bytes.size() - 13] = 4;
  EXPECT_CONTAINS(refusal(quad), "face 11 is no triangle");
  std::string nan = bytes;
  const float value = std::numeric_limits<float>::quiet_NaN();
  std::memcpy(nan.data() + bytes.find("end_header\n") + 11, &value, sizeof value);
  EXPECT_CONTAINS(refusal(nan), "vertex 0 is not finite");
}

TEST(PlyFile, SurvivesTruncationAndRandomDamage) {
  const std::string bytes = ply_bytes(test::box(Vec3::Zero(), Vec3::Ones()));
  for (std::size_t length = 0; length < bytes.size(); ++length) refusal(bytes.substr(0, length));
  std::mt19937_64 random(5);
  for (int round = 0; round < 3000; ++round) {
    std::string damaged = bytes;
    damaged[random() % damaged.size()] = static_cast<char>(random());
    try {
      for (const auto& triangle : parse_ply(damaged, "organ.ply").triangles)
        for (const auto vertex : triangle) EXPECT_LT(vertex, 8);
    } catch (const InputError& error) {
      EXPECT_CONTAINS(error.what(), "organ.ply");
    }
  }
}

}  // namespace
}  // namespace trocar::ply_file_test
