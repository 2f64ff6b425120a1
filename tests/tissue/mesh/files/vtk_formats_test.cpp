// VTK legacy and XML: forms that programs write beside the plain ones, and damage that must be named.
#include <gtest/gtest.h>

#include "haptics/input_error.h"
#include "tests/tissue/mesh/files/file_writers.h"
#include "tests/tissue/support/temporary_folder.h"
#include "tissue/mesh/files/vtk_cells.h"
#include "tissue/mesh/files/vtk_xml_data.h"

namespace trocar::vtk_formats_test {
namespace {

using namespace test;

const TriangleSurface kBox = box(Vec3::Zero(), Vec3(1, 2, 3));
const std::string kHead = "# vtk DataFile Version 3.0\nMr Somebody, born 1950\nASCII\n";
const std::string kTetPoints = "POINTS 4 float\n0 0 0 1 0 0 0 1 0 0 0 1\n";

std::string refusal(const std::string& bytes) {
  return message_of<InputError>([&] { read_vtk_legacy(bytes, "a.vtk"); });
}
std::string xml_refusal(const std::string& bytes) {
  return message_of<InputError>([&] { read_vtk_xml(bytes, "a.vtp"); });
}

TEST(VtkLegacy, StripsWindEverySecondTriangleTheOtherWay) {
  const SurfaceFile file = read_vtk_legacy(
      kHead + "DATASET POLYDATA\nPOINTS 4 double\n0 0 0 1 0 0 0 1 0 1 1 0\nTRIANGLE_STRIPS 1 5\n4 0 1 2 3\n", "a.vtk");
  const TriangleSurface& surface = file.parts.at(0).surface;
  ASSERT_EQ(surface.triangles.size(), 2U);
  for (std::size_t t = 0; t < 2; ++t)
    EXPECT_GT((corner(surface, t, 1) - corner(surface, t, 0)).cross(corner(surface, t, 2) - corner(surface, t, 0)).z(),
              0);
}

TEST(VtkLegacy, LinesVerticesFieldsAndMetadataAreSteppedOver) {
  const std::string text =
      kHead + "DATASET POLYDATA\nFIELD FieldData 2\nTimeValue 1 1 double\n0.5\nPair 2 2 int\n1 2 3 4\n" + kTetPoints +
      "METADATA\nINFORMATION 1\nNAME L2 LOCATION x\nDATA 2 0 1\n\nVERTICES 1 2\n1 0\nLINES 1 3\n2 0 1\n"
      "POLYGONS 4 16\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\nCELL_DATA 4\nSCALARS x int 1\nanything goes here\n";
  const SurfaceFile file = read_vtk_legacy(text, "a.vtk");
  EXPECT_NEAR(file.parts.at(0).surface.volume_m3(), 1.0 / 6, 1e-12);
  EXPECT_CONTAINS(file.remarks.at(0), "lines and points");
}

TEST(VtkLegacy, FieldsOfTextAreReadAndSpaceIsTaken) {
  const std::string solid = kTetPoints + "POLYGONS 4 16\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";
  const auto with_field = [&](const std::string& field) {
    return kHead + "DATASET POLYDATA\nFIELD FieldData 2\nSPACE 1 1 string\n" + field + "T 1 1 int\n5\n" + solid;
  };
  EXPECT_EQ(read_vtk_legacy(with_field("LPS\n"), "a.vtk").frame, "LPS");
  EXPECT_CONTAINS(refusal(with_field("up\n")), "its SPACE is \"up\"");
  EXPECT_CONTAINS(refusal(kHead + "DATASET POLYDATA\nFIELD FieldData 1\nSPACE 1 9 string\nLPS\n"), "cut off");
}

TEST(VtkLegacy, GridsOfManyKindsOfCells) {
  // A tetrahedron, a quadratic triangle, a pixel, a quad, a line and a vertex.
  const std::string text =
      kHead +
      "DATASET UNSTRUCTURED_GRID\nPOINTS 8 float\n0 0 0 1 0 0 0 1 0 1 1 0 0 0 1 1 0 1 0 1 1 1 1 1\nCELLS 6 27\n"
      "4 0 1 2 4\n6 0 1 2 3 4 5\n4 0 1 2 3\n4 0 1 3 2\n2 0 1\n1 0\nCELL_TYPES 6\n10\n22\n8\n9\n3\n1\n";
  const SurfaceFile file = read_vtk_legacy(text, "a.vtk");
  EXPECT_EQ(file.tetrahedra.tetrahedra.size(), 1U);
  EXPECT_EQ(file.parts.at(0).surface.triangles.size(), 1U + 2U + 2U);
  double area = 0;
  const TriangleSurface& surface = file.parts[0].surface;
  for (std::size_t t = 1; t < 5; ++t)
    area +=
        (corner(surface, t, 1) - corner(surface, t, 0)).cross(corner(surface, t, 2) - corner(surface, t, 0)).z() / 2;
  EXPECT_NEAR(area, 2, 1e-12);  // pixel and quad are the same square, wound alike
}

TEST(VtkLegacy, SolidsThatAreNotReadAreNamed) {
  const std::string grid = kHead + "DATASET UNSTRUCTURED_GRID\n" + kTetPoints + "CELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n";
  EXPECT_CONTAINS(refusal(grid + "12\n"), "cell 0: hexahedra are not read");
  EXPECT_CONTAINS(refusal(grid + "14\n"), "pyramids");
  EXPECT_CONTAINS(refusal(grid + "99\n"), "VTK's type 99");
  EXPECT_CONTAINS(refusal(grid + "5\n"), "has 4 corners instead of 3");
  EXPECT_CONTAINS(refusal(grid.substr(0, grid.find("CELL_TYPES"))), "1 cells have 0 types");
}

TEST(VtkLegacy, ImagesAndOtherDataSetsAreNamed) {
  EXPECT_CONTAINS(refusal(kHead + "DATASET STRUCTURED_POINTS\n"), "holds an image");
  EXPECT_CONTAINS(refusal(kHead + "DATASET RECTILINEAR_GRID\n"), "RECTILINEAR_GRID is no surface");
  EXPECT_CONTAINS(refusal("# vtk DataFile Version 6.0\nt\nASCII\n"), "version 6.0 is not read");
  EXPECT_CONTAINS(refusal("# vtk DataFile Version 3.0\nt\nTEXT\n"), "ASCII or BINARY expected");
}

TEST(VtkLegacy, TitlesAreNeverShown) {
  for (const char* rest : {"DATASET NOTHING\n", "DATASET POLYDATA\nPOINTS x\n", "DATASET POLYDATA\nJUNK\n"}) {
    const std::string message = refusal(kHead + rest);
    EXPECT_EQ(message.find("Somebody"), std::string::npos) << message;
    EXPECT_EQ(message.find("1950"), std::string::npos) << message;
  }
}

TEST(VtkLegacy, DamageIsNamedWithItsPlace) {
  const std::string poly = kHead + "DATASET POLYDATA\n" + kTetPoints;
  EXPECT_CONTAINS(refusal(poly + "POLYGONS 1 4\n3 0 1 4\n"), "cell 0: names vertex 4 of 4");
  EXPECT_CONTAINS(refusal(poly + "POLYGONS 1 4\n3 0 1 -1\n"), "is no whole number");
  EXPECT_CONTAINS(refusal(poly + "POLYGONS 2 4\n3 0 1 2\n"), "cell 1 of 2: the list of cells ends before it");
  EXPECT_CONTAINS(refusal(poly + "POLYGONS 1 5\n3 0 1 2 3\n"), "longer than its cells");
  EXPECT_CONTAINS(refusal(poly + "POLYGONS 1 3\n2 0 1\n"), "a polygon of 2 corners");
  EXPECT_CONTAINS(refusal(poly + "POLYGONS 1 4\n9 0 1 2\n"), "counts 9 corners");
  EXPECT_CONTAINS(refusal(poly + "POINTS 1 float\n0 0 0\n"), "POINTS appears twice");
  EXPECT_CONTAINS(refusal(kHead + "DATASET POLYDATA\nPOINTS 4000000 float\n0 0 0\n"), "longer than the file");
  EXPECT_CONTAINS(refusal(kHead + "DATASET POLYDATA\nPOINTS 4 complex\n"), "numbers of type complex");
  EXPECT_CONTAINS(refusal(kHead + "DATASET POLYDATA\nPOINTS 4 float\n0 0 0 1 0 0 0 1 0 0 0 nan\n"),
                  "is no finite number");
}

TEST(VtkLegacy, EveryCutOfABinaryFileIsRefusedOrEmpty) {
  const std::string whole = vtk_surface(kBox, {true, false, false, false, "t"});
  const std::size_t polygons = whole.find("POLYGONS");
  for (std::size_t length = 0; length < polygons; ++length) {
    try {
      for (const FilePart& part : read_vtk_legacy(whole.substr(0, length), "a.vtk").parts)
        EXPECT_TRUE(part.surface.triangles.empty());
    } catch (const InputError& error) {
      EXPECT_CONTAINS(error.what(), "a.vtk");
    }
  }
  for (std::size_t length = polygons + 4; length < whole.find("POINT_DATA") - 1; ++length)
    EXPECT_CONTAINS(refusal(whole.substr(0, length)), "a.vtk");
}

TEST(VtkLegacy, OffsetsMustRise) {
  const VtkCells good{{0, 1, 2, 2, 1, 0}, {3, 6}};
  EXPECT_NO_THROW(check_cells(good, 3, "f"));
  EXPECT_THROW(check_cells({{0, 1, 2}, {3, 2}}, 3, "f"), InputError);
  EXPECT_THROW(check_cells({{0, 1, 2}, {4}}, 3, "f"), InputError);
  EXPECT_THROW(check_cells({{0, 1, 2}, {-1}}, 3, "f"), InputError);
  EXPECT_THROW(check_cells({{0, 1, -2}, {3}}, 3, "f"), InputError);
}

TEST(VtkXml, PiecesAreParts) {
  std::string text = vtp(kBox, {});
  const std::size_t first = text.find("<Piece"), last = text.find("</PolyData>");
  text.insert(last, text.substr(first, last - first));
  const SurfaceFile file = read_vtk_xml(text, "a.vtp");
  ASSERT_EQ(file.parts.size(), 2U);
  EXPECT_EQ(file.parts[1].name, "piece 1");
  EXPECT_NEAR(file.parts[1].surface.volume_m3(), 6, 1e-6);
}

TEST(VtkXml, PiecesOfTetrahedraKeepTheirVertices) {
  std::string text = vtu(star_of(kBox), {});
  const std::size_t first = text.find("<Piece"), last = text.find("</UnstructuredGrid>");
  text.insert(last, text.substr(first, last - first));
  const SurfaceFile file = read_vtk_xml(text, "a.vtu");
  EXPECT_EQ(file.tetrahedra.tetrahedra.size(), 24U);
  EXPECT_EQ(file.tetrahedra.vertices.size(), 18U);
  EXPECT_EQ(file.tetrahedra.tetrahedra[12][0], file.tetrahedra.tetrahedra[0][0] + 9);
  EXPECT_EQ(file.tetrahedra.regions.at(12), 1);
}

TEST(VtkXml, DocumentTypesAndEntitiesAreRefused) {
  std::string text = vtp(kBox, {});
  text.insert(text.find("<VTKFile"), "<!DOCTYPE x [<!ENTITY a \"aaaa\"><!ENTITY b SYSTEM \"file:///etc/passwd\">]>\n");
  EXPECT_CONTAINS(xml_refusal(text), "document types are not allowed");
}

TEST(VtkXml, OtherCompressorsAreNamed) {
  std::string text = vtp(kBox, {XmlData::kInline, true, false, false});
  text.replace(text.find("vtkZLibDataCompressor"), 21, "vtkLZ4DataCompressor");
  EXPECT_CONTAINS(xml_refusal(text), "compressed by vtkLZ4DataCompressor");
}

TEST(VtkXml, CountsMustAgree) {
  std::string text = vtp(kBox, {});
  text.replace(text.find("NumberOfPoints=\"8\""), 18, "NumberOfPoints=\"9\"");
  EXPECT_CONTAINS(xml_refusal(text), "NumberOfPoints=\"9\", but there are 8");
  EXPECT_CONTAINS(xml_refusal("<VTKFile type=\"PolyData\"></VTKFile>"), "holds no piece");
  EXPECT_CONTAINS(xml_refusal("<VTKFile type=\"PolyData\"><PolyData><Piece/></PolyData></VTKFile>"),
                  "a piece has no points");
  EXPECT_CONTAINS(xml_refusal("<VTKFile type=\"PolyData\"><PolyData>\n<Piece></PolyData>"),
                  "a.vtp:2:1: damaged XML: mismatched tag");
}

TEST(VtkXml, EveryCutIsRefused) {
  for (const XmlData data : {XmlData::kInline, XmlData::kAppendedRaw, XmlData::kAppendedBase64})
    for (const bool compressed : {false, true}) {
      const std::string whole = vtp(kBox, {data, compressed, false, false});
      const std::size_t end = data == XmlData::kInline ? whole.size() - 2 : whole.find("\n</AppendedData") - 4;
      for (std::size_t length = 0; length < end; length += 5)
        EXPECT_CONTAINS(xml_refusal(whole.substr(0, length)), "a.vtp");
    }
}

std::string unpack_refusal(const std::string& packed, bool base64, const VtkXmlPacking& packing) {
  return message_of<InputError>([&] { unpacked_array(packed, base64, packing, "f"); });
}

TEST(VtkXmlArrays, LengthsPackedApartOrTogether) {
  std::string header;
  put(header, std::uint32_t{5});
  const VtkXmlPacking packing;
  EXPECT_EQ(unpacked_array(base64(header + "hello"), true, packing, "f"), "hello");
  EXPECT_EQ(unpacked_array(base64(header) + base64("hello"), true, packing, "f"), "hello");
  EXPECT_EQ(unpacked_array(header + "hello and more", false, packing, "f"), "hello");
  for (std::size_t size = 0; size < 9; ++size) {  // every padding
    std::string raw;
    put(raw, static_cast<std::uint32_t>(size));
    EXPECT_EQ(unpacked_array(base64(raw + std::string(size, 'x')), true, packing, "f"), std::string(size, 'x'));
    std::string wide;
    put(wide, std::uint64_t{size});
    EXPECT_EQ(unpacked_array(base64(wide + std::string(size, 'x')), true, {false, 8, false}, "f"),
              std::string(size, 'x'));
  }
}

TEST(VtkXmlArrays, LengthsAreNotBelieved) {
  std::string header;
  put(header, std::uint32_t{4000000000U});
  EXPECT_CONTAINS(unpack_refusal(base64(header + "hello"), true, {}), "more than the file can hold");
  EXPECT_CONTAINS(unpack_refusal("ab", false, {}), "the data end within an array");
  EXPECT_CONTAINS(unpack_refusal("A*AA", true, {}), "f:");
  std::string bomb;
  for (const std::uint32_t value : {60000U, 16384U, 0U, 40U}) put(bomb, value);
  EXPECT_CONTAINS(unpack_refusal(bomb + std::string(200, 'x'), false, {false, 4, true}), "more than the file can hold");
  std::string damaged;
  for (const std::uint32_t value : {1U, 100U, 0U, 40U}) put(damaged, value);
  EXPECT_CONTAINS(unpack_refusal(damaged + std::string(40, 'x'), false, {false, 4, true}), "damaged zlib data");
}

}  // namespace
}  // namespace trocar::vtk_formats_test
