// STL, OBJ and OFF: what real exporters write, and what must be refused with its place.
#include <gtest/gtest.h>

#include "haptics/input_error.h"
#include "tests/tissue/mesh/files/file_writers.h"
#include "tests/tissue/support/temporary_folder.h"

namespace trocar::text_formats_test {
namespace {

using namespace test;

const TriangleSurface kBox = box(Vec3::Zero(), Vec3(1, 2, 3));

std::string stl_refusal(const std::string& bytes) {
  return message_of<InputError>([&] { read_stl(bytes, "a.stl"); });
}
std::string obj_refusal(const std::string& bytes) {
  return message_of<InputError>([&] { read_obj(bytes, "a.obj"); });
}
std::string off_refusal(const std::string& bytes) {
  return message_of<InputError>([&] { read_off(bytes, "a.off"); });
}

double volume(const SurfaceFile& file) {
  double sum = 0;
  for (const FilePart& part : file.parts) sum += part.surface.volume_m3();
  return sum;
}

TEST(StlFile, SeveralSolidsAreParts) {
  const SurfaceFile file =
      read_stl(stl_text(kBox, "liver") + stl_text(box(Vec3(5, 5, 5), Vec3(6, 6, 6)), "spleen"), "a.stl");
  ASSERT_EQ(file.parts.size(), 2U);
  EXPECT_EQ(file.parts[0].name, "liver");
  EXPECT_EQ(file.parts[1].name, "spleen");
  EXPECT_NEAR(volume(file), 7, 1e-12);
  EXPECT_FALSE(file.unit_m);
  EXPECT_EQ(file.frame, "");
}

TEST(StlFile, NormalsThatAreNoNumbersHarmNobody) {
  std::string text = stl_text(kBox);
  for (std::size_t at = 0; (at = text.find("normal 0 0 0", at)) != std::string::npos;)
    text.replace(at, 12, "normal nan -nan inf");
  EXPECT_NEAR(volume(read_stl(text, "a.stl")), 6, 1e-12);
}

TEST(StlFile, TextKeepsDoublePrecision) {
  TriangleSurface far = kBox;
  for (Vec3& p : far.vertices) p.x() += 123456.0625;
  const SurfaceFile file = read_stl(stl_text(far), "a.stl");
  EXPECT_EQ(corner(file.parts[0].surface, 0, 0).x(), std::stod(number(123456.0625)));
}

TEST(StlFile, BinaryHeadersThatBeginWithSolid) {
  EXPECT_NEAR(volume(read_stl(stl_binary(kBox, "solid Exported by a CAD program"), "a.stl")), 6, 1e-6);
}

TEST(StlFile, BytesBehindTheLastTriangleAreLeftOutWithAWord) {
  const SurfaceFile file = read_stl(stl_binary(kBox) + "padding", "a.stl");
  EXPECT_NEAR(volume(file), 6, 1e-6);
  EXPECT_CONTAINS(file.remarks.at(0), "7 bytes behind the last triangle");
}

TEST(StlFile, CutOffFilesSayHowMuchIsMissing) {
  const std::string whole = stl_binary(kBox);
  EXPECT_CONTAINS(stl_refusal(whole.substr(0, whole.size() - 1)),
                  "the header counts 12 triangles (684 bytes), the file has 683 bytes");
  EXPECT_CONTAINS(stl_refusal(whole.substr(0, 50)), "too few for an STL");
  EXPECT_CONTAINS(stl_refusal(stl_text(kBox).substr(0, 300)), "a.stl:");
  for (std::size_t length = 0; length < whole.size(); length += 3)
    EXPECT_CONTAINS(stl_refusal(whole.substr(0, length)), "a.stl");
}

TEST(StlFile, CountsAreBelievedOnlyWithTheBytes) {
  std::string bytes = stl_binary(kBox);
  bytes[83] = '\x7f';
  EXPECT_CONTAINS(stl_refusal(bytes), "it is cut off, or no STL");
}

TEST(StlFile, BadCornersAreNamed) {
  std::string nan = stl_binary(kBox);
  const float bad = std::nanf("");
  std::memcpy(nan.data() + 84 + 50 * 3 + 12, &bad, sizeof bad);
  EXPECT_CONTAINS(stl_refusal(nan), "triangle 3 has a corner that is not finite");
  std::string text = stl_text(kBox);
  text.replace(text.find("vertex 0 0 0"), 12, "vertex 0 x 0");
  EXPECT_CONTAINS(stl_refusal(text), "a.stl:4:1: coordinate: \"x\" is no finite number");
  std::string quad = stl_text(kBox);
  quad.replace(quad.find("endloop"), 7, "vertex 1 1 1\nendloop");
  EXPECT_CONTAINS(stl_refusal(quad), "\"endloop\" expected, not \"vertex\"");
}

TEST(ObjFile, QuadsPolygonsAndNegativeIndices) {
  const std::string text =
      "mtllib ../../elsewhere.mtl\n# a cube\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
      "f 4 3 2 1\nf 5 6 7 8\nf 1/1 2/2 6/3 5/4\nf 2//1 3//1 7//1 6//1\nf -6 -5 -1 -2\nf 1 5 8 4\n";
  const SurfaceFile file = read_obj(text, "a.obj");
  ASSERT_EQ(file.parts.size(), 1U);
  EXPECT_EQ(file.parts[0].surface.triangles.size(), 12U);
  EXPECT_NEAR(volume(file), 1, 1e-12);
}

TEST(ObjFile, GroupsAreParts) {
  const SurfaceFile file = read_obj(
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\ng lobe left\nf 1 2 4\no tail\nf 1 3 4\ng lobe left\nf 2 3 4\n",
      "a.obj");
  ASSERT_EQ(file.parts.size(), 3U);
  EXPECT_EQ(file.parts[0].name, "");
  EXPECT_EQ(file.parts[1].name, "lobe left");
  EXPECT_EQ(file.parts[1].surface.triangles.size(), 2U);
  EXPECT_EQ(file.parts[1].surface.vertices.size(), 4U);
  EXPECT_EQ(file.parts[2].surface.vertices.size(), 3U);
}

TEST(ObjFile, WindowsLinesContinuedLinesColoursAndTrailingZeros) {
  const std::string text = "v 0 0 0 0.5 0.5 0.5\r\nv 1 0 0\r\nv 0 \\\r\n 1 0\r\nf 1 2 3 # a comment\r\nl 1 2\r\n";
  const SurfaceFile file = read_obj(text + std::string("\n\0\0\n", 4), "a.obj");
  EXPECT_EQ(file.parts.at(0).surface.triangles.size(), 1U);
  EXPECT_EQ(file.parts[0].surface.vertices.at(2), Vec3(0, 1, 0));
  EXPECT_CONTAINS(file.remarks.at(0), "lines and points in the file were left out");
}

TEST(ObjFile, PlacesOfMistakes) {
  EXPECT_CONTAINS(obj_refusal("v 0 0 0\nv 1 0 0\nf 1 2 3\n"), "a.obj:3:1: a face names vertex 3 of the 2 so far");
  EXPECT_CONTAINS(obj_refusal("v 0 0 0\nf 0 1 1\n"), "a face names vertex 0");
  EXPECT_CONTAINS(obj_refusal("v 0 0 0\nf -2 1 1\n"), "a face names vertex -2");
  EXPECT_CONTAINS(obj_refusal("v 0 0 0\nf 1 1\n"), "fewer than three corners");
  EXPECT_CONTAINS(obj_refusal("v 0 nan 0\n"), "a.obj:1:1: coordinate \"nan\" is no finite number");
  EXPECT_CONTAINS(obj_refusal("v 0 0\n"), "coordinate \"\"");
  EXPECT_CONTAINS(obj_refusal("v 0 0 0\nf a b c\n"), "names no vertex");
  EXPECT_CONTAINS(obj_refusal(std::string("v 0 0 0\n\0\0\nv 1 1 1\n", 20)), "holds binary data");
  std::string many = "v 0 0 0\nf";
  for (int n = 0; n < 100; ++n) many += " 1";
  EXPECT_CONTAINS(obj_refusal(many), "a face of 100 corners");
}

TEST(ObjFile, ManyGroupsStayQuick) {
  std::string text;
  for (int n = 0; n < 30000; ++n) text += "v " + std::to_string(n) + " 0 0\n";
  for (int n = 0; n < 4000; ++n) text += "g g" + std::to_string(n) + "\nf 1 2 3\n";
  EXPECT_EQ(read_obj(text, "a.obj").parts.size(), 4000U);
  for (int n = 4000; n < 5000; ++n) text += "g g" + std::to_string(n) + "\nf 1 2 3\n";
  EXPECT_CONTAINS(obj_refusal(text), "groups are more than");
}

TEST(OffFile, CountsOnTheFirstLineCommentsAndColours) {
  const std::string body = "0 0 0\n1 0 0 # corner\n\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3 0.5 0.5 0.5\n3 1 2 3 7\n3 0 3 2\n";
  for (const std::string head :
       {"OFF 4 4 6\n", "OFF\n4 4 6\n", "# made by hand\nOFF\n# more\n4 4\n", "COFF\n4 4 0\n"}) {
    const SurfaceFile file = read_off(head + body, "a.off");
    EXPECT_NEAR(volume(file), 1.0 / 6, 1e-12) << head;
  }
}

TEST(OffFile, VertexNormalsAndColoursAreSteppedOver) {
  const SurfaceFile file = read_off(
      "CNOFF\n3 1 0\n0 0 0 0 0 1 255 0 0 255\n1 0 0 0 0 1 255 0 0 255\n0 1 0 0 0 1 0 0 0 255\n3 0 1 2\n", "a.off");
  EXPECT_EQ(file.parts.at(0).surface.vertices.at(1), Vec3(1, 0, 0));
}

TEST(OffFile, PlacesOfMistakes) {
  EXPECT_CONTAINS(off_refusal("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n"), "a.off:6:1: a face names vertex 3 of 3");
  EXPECT_CONTAINS(off_refusal("OFF\n3 1 0\n0 0 0\n1 0 0\n"), "the file ends before all its vertices");
  EXPECT_CONTAINS(off_refusal("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n"), "the file ends before all its faces");
  EXPECT_CONTAINS(off_refusal("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n2 0 1\n"), "a face of 2 corners");
  EXPECT_CONTAINS(off_refusal("OFF\n999999999 1 0\n"), "are more than the");
  EXPECT_CONTAINS(off_refusal("OFF\n-3 1 0\n"), "is no count");
  EXPECT_CONTAINS(off_refusal("OFF BINARY\n3 1 0\n"), "binary OFF is not read");
  EXPECT_CONTAINS(off_refusal("4OFF\n3 1 0\n"), "four or n dimensions");
  EXPECT_CONTAINS(off_refusal("OFF\n3 1 0\n0 inf 0\n"), "a.off:3:1: coordinate \"inf\"");
}

}  // namespace
}  // namespace trocar::text_formats_test
