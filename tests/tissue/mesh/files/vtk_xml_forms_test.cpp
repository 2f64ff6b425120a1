// VTK XML as different programs write it: types of numbers, strips, empty sections, blanks in base64, comments and
// foreign arrays.
#include <gtest/gtest.h>

#include "haptics/input_error.h"
#include "tests/tissue/mesh/files/file_writers.h"
#include "tests/tissue/support/temporary_folder.h"

namespace trocar::vtk_xml_forms_test {
namespace {

using namespace test;

std::string piece(const std::string& inside, const std::string& attributes = "NumberOfPoints=\"4\"") {
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"0.1\" "
         "byte_order=\"LittleEndian\">\n<PolyData>\n<Piece " +
         attributes + ">\n" + inside + "</Piece>\n</PolyData>\n</VTKFile>\n";
}

std::string ascii(const std::string& type, const std::string& name, const std::string& values) {
  return "<DataArray type=\"" + type + "\" Name=\"" + name + "\" format=\"ascii\">" + values + "</DataArray>\n";
}

std::string points(const std::string& type = "Float32") {
  return "<Points>" + ascii(type, "Points", "0 0 0 1 0 0 0 1 0 0 0 1") + "</Points>\n";
}

const std::string kFaces = "0 2 1 0 1 3 1 2 3 0 3 2";

std::string polygons(const std::string& type = "Int32") {
  return "<Polys>" + ascii(type, "connectivity", kFaces) + ascii(type, "offsets", "3 6 9 12") + "</Polys>\n";
}

double volume(const std::string& text) { return read_vtk_xml(text, "a.vtp").parts.at(0).surface.volume_m3(); }
std::string refusal(const std::string& text) {
  return message_of<InputError>([&] { read_vtk_xml(text, "a.vtp"); });
}

TEST(VtkXmlForms, EveryTypeOfNumber) {
  for (const std::string type : {"Float32", "Float64", "Int16", "UInt8"})
    EXPECT_NEAR(volume(piece(points(type) + polygons())), 1.0 / 6, 1e-12) << type;
  for (const std::string type : {"Int8", "UInt8", "Int16", "UInt16", "Int32", "UInt32", "Int64", "UInt64"})
    EXPECT_NEAR(volume(piece(points() + polygons(type))), 1.0 / 6, 1e-12) << type;
  EXPECT_CONTAINS(refusal(piece(points("String") + polygons())), "numbers of a type that is not read");
  EXPECT_CONTAINS(refusal(piece(points() + polygons("Float32"))), "numbers of a type that is not read");
}

TEST(VtkXmlForms, TheFieldSpaceSaysTheAxes) {
  const auto with_field = [](const std::string& array) {
    std::string text = piece(points() + polygons());
    return text.insert(text.find("<Piece"), "<FieldData>" + array + "</FieldData>\n");
  };
  const auto space = [](const std::string& letters) {
    return "<Array type=\"String\" Name=\"SPACE\" NumberOfTuples=\"1\" format=\"ascii\">" + letters + "</Array>";
  };
  EXPECT_EQ(read_vtk_xml(piece(points() + polygons()), "a.vtp").frame, "");
  EXPECT_EQ(read_vtk_xml(with_field(space("76 80 83 0")), "a.vtp").frame, "LPS");
  EXPECT_EQ(read_vtk_xml(with_field(space("82 65 83 0")), "a.vtp").frame, "RAS");
  EXPECT_EQ(read_vtk_xml(with_field("<Array type=\"String\" Name=\"SPACE\" NumberOfTuples=\"1\" format=\"binary\">"
                                    "BAAAAExQUwA=</Array>"),
                         "a.vtp")
                .frame,
            "LPS");
  EXPECT_EQ(
      read_vtk_xml(with_field("<Array type=\"String\" Name=\"Note\" format=\"ascii\">76 80 83 0</Array>"), "a.vtp")
          .frame,
      "");
  EXPECT_CONTAINS(refusal(with_field(space("88 0"))), "its SPACE is \"X\"");
}

TEST(VtkXmlForms, StripsBesidePolygons) {
  const std::string strips =
      "<Strips>" + ascii("Int32", "connectivity", "0 1 2 3") + ascii("Int32", "offsets", "4") + "</Strips>\n";
  const SurfaceFile file = read_vtk_xml(piece(points() + polygons() + strips), "a.vtp");
  EXPECT_EQ(file.parts.at(0).surface.triangles.size(), 6U);
}

TEST(VtkXmlForms, EmptySectionsAndForeignArrays) {
  const std::string text = piece(
      "<PointData>" + ascii("Float64", "connectivity", "9 9 9") + "</PointData>\n" + points() + "<Verts>" +
          ascii("Int32", "connectivity", "0 77") + "</Verts>\n<Lines/>\n<Strips>" +
          "<DataArray type=\"Int64\" Name=\"connectivity\" format=\"binary\">\n</DataArray></Strips>\n" + polygons() +
          "<CellData><DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">5</DataArray></CellData>\n",
      "NumberOfPoints=\"4\" NumberOfPolys=\"4\" NumberOfVerts=\"1\"");
  EXPECT_NEAR(volume(text), 1.0 / 6, 1e-12);
}

TEST(VtkXmlForms, BlanksInBase64AndCommentsBetween) {
  std::string raw, header;
  for (const double value : {0., 0., 0., 1., 0., 0., 0., 1., 0., 0., 0., 1.}) put(raw, value);
  put(header, static_cast<std::uint32_t>(raw.size()));
  std::string letters = base64(header + raw);
  for (std::size_t at = 20; at < letters.size(); at += 27) letters.insert(at, "\n   \t");
  const std::string packed = "<Points><!-- a comment --><DataArray type=\"Float64\" Name=\"p\" format=\"binary\">" +
                             letters + "</DataArray></Points>\n";
  EXPECT_NEAR(volume(piece(packed + polygons())), 1.0 / 6, 1e-12);
}

TEST(VtkXmlForms, AppendedOffsetsBeyondTheEndAreRefused) {
  std::string text = vtp(box(Vec3::Zero(), Vec3::Ones()), {XmlData::kAppendedRaw, false, false, false});
  const std::size_t at = text.find("offset=\"0\"", text.find("<Points>") - 200);
  ASSERT_NE(at, std::string::npos);
  text.replace(text.rfind("offset=\""), 8, "offset=\"9999");
  EXPECT_CONTAINS(refusal(text), "begins behind the end of the appended data");
}

TEST(VtkXmlForms, DamageIsNamed) {
  EXPECT_CONTAINS(refusal(piece(points() + "<Polys>" + ascii("Int32", "connectivity", "0 1 9") +
                                ascii("Int32", "offsets", "3") + "</Polys>")),
                  "cell 0: names vertex 9 of 4");
  EXPECT_CONTAINS(refusal(piece(points() + "<Polys>" + ascii("Int32", "connectivity", "0 1 2") +
                                ascii("Int32", "offsets", "7") + "</Polys>")),
                  "cell 0: its offset 7 is out of order");
  EXPECT_CONTAINS(refusal(piece(points() + "<Polys>" + ascii("Int32", "connectivity", "0 1") +
                                ascii("Int32", "offsets", "2") + "</Polys>")),
                  "a polygon of 2 corners");
  EXPECT_CONTAINS(refusal(piece("<Points>" + ascii("Float32", "p", "0 0 nan") + "</Points>" + polygons())),
                  "is no finite number");
  EXPECT_CONTAINS(
      refusal(piece("<Points><DataArray type=\"Float32\" Name=\"p\" format=\"other\">0</DataArray></Points>")),
      "arrays of format other");
  EXPECT_CONTAINS(refusal("<VTKFile type=\"PolyData\">\n<PolyData>\n<Piece>&unknown;"),
                  "a.vtp:3:1: damaged XML: undefined entity");
  EXPECT_CONTAINS(refusal("<AppendedData encoding=\"raw\">"), "the appended data do not begin");
}

TEST(VtkXmlForms, DeepNestingIsNoTrouble) {
  std::string open, close;
  for (int n = 0; n < 20000; ++n) open += "<a>", close += "</a>";
  EXPECT_NEAR(volume(piece(open + close + points() + polygons())), 1.0 / 6, 1e-12);
}

}  // namespace
}  // namespace trocar::vtk_xml_forms_test
