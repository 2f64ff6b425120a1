// Forms of glTF that exporters choose between: kinds of indices, strips and fans, interleaved data, several primitives,
// instances.
#include <gtest/gtest.h>

#include "haptics/input_error.h"
#include "tests/tissue/mesh/files/scene_writers.h"
#include "tests/tissue/support/temporary_folder.h"
#include "tissue/mesh/files/read_surface_file.h"

namespace trocar::gltf_forms_test {
namespace {

using namespace test;

/// A document put together piece by piece.
class GltfWriter {
 public:
  /// @param stride 0 for packed data @return number of the accessor
  int accessor(const std::string& bytes, int component, std::size_t count, const std::string& type,
               std::size_t stride = 0) {
    while (binary_.size() % 4 != 0) binary_ += '\0';
    append(views_, "{\"buffer\":0,\"byteOffset\":" + std::to_string(binary_.size()) +
                       ",\"byteLength\":" + std::to_string(bytes.size()) +
                       (stride > 0 ? ",\"byteStride\":" + std::to_string(stride) : "") + "}");
    binary_ += bytes;
    append(accessors_, "{\"bufferView\":" + std::to_string(count_) + ",\"componentType\":" + std::to_string(component) +
                           ",\"count\":" + std::to_string(count) + ",\"type\":\"" + type + "\"}");
    return count_++;
  }

  int points(const std::vector<Vec3>& points, std::size_t padding = 0) {
    std::string bytes;
    for (const Vec3& p : points) {
      for (int axis = 0; axis < 3; ++axis) put(bytes, static_cast<float>(p[axis]));
      bytes += std::string(padding, '\x7f');
    }
    return accessor(bytes, 5126, points.size(), "VEC3", padding > 0 ? 12 + padding : 0);
  }

  template <typename Index>
  int indices(const std::vector<int>& corners, int component) {
    std::string bytes;
    for (const int corner : corners) put(bytes, static_cast<Index>(corner));
    return accessor(bytes, component, corners.size(), "SCALAR");
  }

  void primitive(int points, int indices, int mode = 4) {
    append(primitives_, "{\"attributes\":{\"POSITION\":" + std::to_string(points) + "}" +
                            (indices >= 0 ? ",\"indices\":" + std::to_string(indices) : "") +
                            ",\"mode\":" + std::to_string(mode) + "}");
  }

  std::string bytes(const std::string& nodes = "{\"name\":\"a\",\"mesh\":0}", const std::string& roots = "0") const {
    return glb({"{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[" + roots + "]}],\"nodes\":[" +
                    nodes + "],\"meshes\":[{\"primitives\":[" + primitives_ + "]}],\"accessors\":[" + accessors_ +
                    "],\"bufferViews\":[" + views_ +
                    "],\"buffers\":[{\"byteLength\":" + std::to_string(binary_.size()) + "}]}",
                binary_});
  }

 private:
  static void append(std::string& list, const std::string& entry) { list += (list.empty() ? "" : ",") + entry; }
  std::string binary_, views_, accessors_, primitives_;
  int count_ = 0;
};

const TriangleSurface kBox = box(Vec3::Zero(), Vec3(1, 2, 3));

std::vector<int> corners_of(const TriangleSurface& surface) {
  std::vector<int> corners;
  for (const auto& triangle : surface.triangles) corners.insert(corners.end(), triangle.begin(), triangle.end());
  return corners;
}

SurfaceFile read(const std::string& bytes) {
  TemporaryFolder folder;
  return read_surface_file(folder.write("a.glb", bytes), {});
}

TEST(GltfForms, IndicesOfThreeWidths) {
  for (int width = 0; width < 3; ++width) {
    GltfWriter writer;
    const int points = writer.points(kBox.vertices);
    const int indices = width == 0   ? writer.indices<std::uint8_t>(corners_of(kBox), 5121)
                        : width == 1 ? writer.indices<std::uint16_t>(corners_of(kBox), 5123)
                                     : writer.indices<std::uint32_t>(corners_of(kBox), 5125);
    writer.primitive(points, indices);
    EXPECT_NEAR(read(writer.bytes()).parts.at(0).surface.volume_m3(), 6, 1e-6) << width;
  }
}

TEST(GltfForms, WithoutIndicesTheVerticesFollowEachOther) {
  std::vector<Vec3> soup;
  for (std::size_t t = 0; t < kBox.triangles.size(); ++t)
    for (std::size_t n = 0; n < 3; ++n) soup.push_back(corner(kBox, t, n));
  GltfWriter writer;
  writer.primitive(writer.points(soup), -1);
  EXPECT_NEAR(read(writer.bytes()).parts.at(0).surface.volume_m3(), 6, 1e-6);
}

TEST(GltfForms, InterleavedPositions) {
  GltfWriter writer;
  const int points = writer.points(kBox.vertices, 12);
  writer.primitive(points, writer.indices<std::uint16_t>(corners_of(kBox), 5123));
  EXPECT_NEAR(read(writer.bytes()).parts.at(0).surface.volume_m3(), 6, 1e-6);
}

TEST(GltfForms, StripsAndFansKeepTheirWinding) {
  const std::vector<Vec3> square{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  for (const auto& [mode, order] : {std::pair(5, std::vector<int>{0, 1, 2, 3}), {6, std::vector<int>{0, 1, 3, 2}}}) {
    GltfWriter writer;
    const int points = writer.points(square);
    writer.primitive(points, writer.indices<std::uint16_t>(order, 5123), mode);
    const TriangleSurface surface = read(writer.bytes()).parts.at(0).surface;
    ASSERT_EQ(surface.triangles.size(), 2U) << mode;
    for (std::size_t t = 0; t < 2; ++t)
      EXPECT_NEAR(
          (corner(surface, t, 1) - corner(surface, t, 0)).cross(corner(surface, t, 2) - corner(surface, t, 0)).z(), 1,
          1e-6)
          << mode;
  }
}

TEST(GltfForms, PrimitivesOfOneNodeAreOnePart) {
  GltfWriter writer;
  TriangleSurface first = kBox, second = kBox;
  first.triangles.resize(5);
  second.triangles.erase(second.triangles.begin(), second.triangles.begin() + 5);
  for (const TriangleSurface& half : {first, second}) {
    const int points = writer.points(half.vertices);
    writer.primitive(points, writer.indices<std::uint16_t>(corners_of(half), 5123));
  }
  const SurfaceFile file = read(writer.bytes());
  ASSERT_EQ(file.parts.size(), 1U);  // two materials of one organ
  EXPECT_NEAR(file.parts[0].surface.volume_m3(), 6, 1e-6);
}

TEST(GltfForms, OneMeshInTwoPlacesIsTwoParts) {
  GltfWriter writer;
  const int points = writer.points(kBox.vertices);
  writer.primitive(points, writer.indices<std::uint16_t>(corners_of(kBox), 5123));
  const SurfaceFile file = read(writer.bytes(
      "{\"name\":\"left\",\"mesh\":0},{\"name\":\"right\",\"mesh\":0,\"scale\":[-1,1,1],\"translation\":[9,0,0]}",
      "0,1"));
  ASSERT_EQ(file.parts.size(), 2U);
  EXPECT_EQ(file.parts[1].name, "right");
  EXPECT_NEAR(file.parts[1].surface.volume_m3(), 6, 1e-6);  // mirrored, and turned over
  EXPECT_NEAR(file.parts[1].surface.bounds().max().x(), 9, 1e-6);
  EXPECT_CONTAINS(file.remarks.at(0), "mirrors its mesh");
}

TEST(GltfForms, RotationsAndMatricesAreBakedInOrder) {
  GltfWriter writer;
  const int points = writer.points(kBox.vertices);
  writer.primitive(points, writer.indices<std::uint16_t>(corners_of(kBox), 5123));
  // A quarter turn about z in the child, a shift by a matrix above it.
  const SurfaceFile file =
      read(writer.bytes("{\"name\":\"above\",\"children\":[1],\"matrix\":[1,0,0,0,0,1,0,0,0,0,1,0,5,6,7,1]},"
                        "{\"name\":\"below\",\"mesh\":0,\"rotation\":[0,0,0.70710678,0.70710678]}"));
  ASSERT_EQ(file.parts.size(), 1U);
  EXPECT_EQ(file.parts[0].groups.at(0), "above");
  const Eigen::AlignedBox3d bounds = file.parts[0].surface.bounds();
  EXPECT_LT((bounds.min() - Vec3(3, 6, 7)).norm(), 1e-5);  // x to y, y to -x, then the shift
  EXPECT_LT((bounds.max() - Vec3(5, 7, 10)).norm(), 1e-5);
}

TEST(GltfForms, PointsAndLinesAreLeftOutWithAWord) {
  GltfWriter writer;
  const int points = writer.points(kBox.vertices);
  writer.primitive(points, writer.indices<std::uint16_t>(corners_of(kBox), 5123));
  writer.primitive(points, writer.indices<std::uint16_t>({0, 1, 2, 3}, 5123), 1);
  const SurfaceFile file = read(writer.bytes());
  EXPECT_EQ(file.parts.at(0).surface.triangles.size(), 12U);
  EXPECT_CONTAINS(file.remarks.at(0), "points and lines in the file were left out");
}

TEST(GltfForms, IndicesBeyondTheVerticesAreRefused) {
  GltfWriter writer;
  const int points = writer.points(kBox.vertices);
  writer.primitive(points, writer.indices<std::uint16_t>({0, 1, 8}, 5123));
  EXPECT_CONTAINS(message_of<InputError>([&] { read(writer.bytes()); }), "a.glb");
}

TEST(GltfForms, InstancesAreCountedBeforeTheyAreMade) {
  GltfWriter writer;
  TriangleSurface ball = sphere(Vec3::Zero(), 0.1, 5);
  const int points = writer.points(ball.vertices);
  writer.primitive(points, writer.indices<std::uint16_t>(corners_of(ball), 5123));
  std::string nodes, roots;
  for (int n = 0; n < 700; ++n)
    nodes += (n > 0 ? "," : "") + std::string("{\"mesh\":0}"), roots += (n > 0 ? "," : "") + std::to_string(n);
  EXPECT_CONTAINS(message_of<InputError>([&] { read(writer.bytes(nodes, roots)); }),
                  "corners of triangles are more than");
}

}  // namespace
}  // namespace trocar::gltf_forms_test
