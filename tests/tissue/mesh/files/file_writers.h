// Small files of every surface format, written byte by byte for tests and independent of the readers.
#pragma once

#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <sstream>
#include <string>
#include <vector>

#include "tests/tissue/support/shapes.h"
#include "tissue/mesh/files/surface_file.h"

namespace trocar::test {

template <typename Value>
void put(std::string& bytes, Value value, bool big_endian = false) {
  std::string raw(reinterpret_cast<const char*>(&value), sizeof value);
  if (big_endian) std::reverse(raw.begin(), raw.end());
  bytes += raw;
}

inline TriangleSurface scaled(TriangleSurface s, double factor) {
  for (Vec3& p : s.vertices) p *= factor;
  return s;
}

inline std::string number(double value) {
  std::ostringstream out;
  out.precision(9);
  out << value;
  return out.str();
}

inline std::string triple(const Vec3& p) { return number(p.x()) + " " + number(p.y()) + " " + number(p.z()); }

inline const Vec3& corner(const TriangleSurface& s, std::size_t triangle, std::size_t n) {
  return s.vertices[static_cast<std::size_t>(s.triangles[triangle][n])];
}

inline std::string stl_text(const TriangleSurface& s, const std::string& name = "shape") {
  std::string text = "solid " + name + "\n";
  for (std::size_t t = 0; t < s.triangles.size(); ++t) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (std::size_t n = 0; n < 3; ++n) text += "vertex " + triple(corner(s, t, n)) + "\n";
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid " + name + "\n";
}

inline std::string stl_binary(const TriangleSurface& s, std::string header = "binary") {
  header.resize(80, ' ');
  put(header, static_cast<std::uint32_t>(s.triangles.size()));
  for (std::size_t t = 0; t < s.triangles.size(); ++t) {
    for (int n = 0; n < 3; ++n) put(header, 0.0F);
    for (std::size_t n = 0; n < 3; ++n)
      for (int axis = 0; axis < 3; ++axis) put(header, static_cast<float>(corner(s, t, n)[axis]));
    put(header, std::uint16_t{0});
  }
  return header;
}

inline std::string obj_text(const TriangleSurface& s,
                            const std::string& before = "mtllib missing.mtl\no shape\nusemtl none\n") {
  std::string text = before;
  for (const Vec3& p : s.vertices) text += "v " + triple(p) + "\n";
  for (const auto& [a, b, c] : s.triangles)
    text += "f " + std::to_string(a + 1) + "/1/1 " + std::to_string(b + 1) + "//2 " + std::to_string(c + 1) + "\n";
  return text;
}

inline std::string off_text(const TriangleSurface& s) {
  std::string text = "OFF\n# made for a test\n" + std::to_string(s.vertices.size()) + " " +
                     std::to_string(s.triangles.size()) + " 0\n";
  for (const Vec3& p : s.vertices) text += triple(p) + "\n";
  for (const auto& [a, b, c] : s.triangles)
    text += "3 " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(c) + " 255 0 0\n";
  return text;
}

struct VtkForm {
  bool binary = false;
  bool modern = false;  ///< 5.1: OFFSETS and CONNECTIVITY
  bool strips = false;  ///< each triangle as a strip
  bool doubles = false;
  std::string title = "vtk output";
};

inline std::string vtk_numbers(const std::vector<std::int64_t>& values, bool binary, bool wide) {
  std::string text;
  for (const std::int64_t value : values) {
    if (!binary)
      text += std::to_string(value) + " ";
    else if (wide)
      put(text, value, true);
    else
      put(text, static_cast<std::int32_t>(value), true);
  }
  return text + "\n";
}

inline std::string vtk_points(const std::vector<Vec3>& points, const VtkForm& form) {
  std::string text = "POINTS " + std::to_string(points.size()) + (form.doubles ? " double\n" : " float\n");
  for (const Vec3& p : points) {
    if (!form.binary)
      text += triple(p) + "\n";
    else
      for (int axis = 0; axis < 3; ++axis)
        form.doubles ? put(text, p[axis], true) : put(text, static_cast<float>(p[axis]), true);
  }
  return text + (form.binary ? "\n" : "") +
         (form.modern ? "METADATA\nINFORMATION 1\nNAME L2_NORM_RANGE LOCATION vtkDataArray\nDATA 2 0 1\n\n" : "");
}

/// @param size corners of each cell
inline std::string vtk_cells(const std::string& key, const std::vector<std::int64_t>& corners, std::size_t size,
                             const VtkForm& form) {
  const std::size_t cells = corners.size() / size;
  std::vector<std::int64_t> list, offsets;
  for (std::size_t cell = 0; cell < cells; ++cell) {
    list.push_back(static_cast<std::int64_t>(size));
    offsets.push_back(static_cast<std::int64_t>(cell * size));
    for (std::size_t n = 0; n < size; ++n) list.push_back(corners[cell * size + n]);
  }
  offsets.push_back(static_cast<std::int64_t>(corners.size()));
  if (!form.modern)
    return key + " " + std::to_string(cells) + " " + std::to_string(list.size()) + "\n" +
           vtk_numbers(list, form.binary, false);
  return key + " " + std::to_string(cells + 1) + " " + std::to_string(corners.size()) + "\nOFFSETS vtktypeint64\n" +
         vtk_numbers(offsets, form.binary, true) + "CONNECTIVITY vtktypeint64\n" +
         vtk_numbers(corners, form.binary, true);
}

inline std::vector<std::int64_t> flat(const TriangleSurface& s) {
  std::vector<std::int64_t> corners;
  for (const auto& triangle : s.triangles) corners.insert(corners.end(), triangle.begin(), triangle.end());
  return corners;
}

inline std::string vtk_head(const VtkForm& form, const std::string& kind) {
  return "# vtk DataFile Version " + std::string(form.modern ? "5.1" : "3.0") + "\n" + form.title + "\n" +
         (form.binary ? "BINARY" : "ASCII") + "\nDATASET " + kind + "\n";
}

inline std::string vtk_surface(const TriangleSurface& s, const VtkForm& form) {
  return vtk_head(form, "POLYDATA") + vtk_points(s.vertices, form) +
         vtk_cells(form.strips ? "TRIANGLE_STRIPS" : "POLYGONS", flat(s), 3, form) + "POINT_DATA 3\nSCALARS whatever\n";
}

/// Tetrahedra from the middle of a star-shaped surface to its triangles.
inline FileTetrahedra star_of(const TriangleSurface& s) {
  FileTetrahedra mesh;
  mesh.vertices = s.vertices;
  mesh.vertices.push_back(s.bounds().center());
  const auto middle = static_cast<std::int32_t>(s.vertices.size());
  for (const auto& [a, b, c] : s.triangles) mesh.tetrahedra.push_back({middle, a, b, c});
  mesh.region_names = {"all"};
  return mesh;
}

inline std::vector<std::int64_t> flat(const FileTetrahedra& mesh) {
  std::vector<std::int64_t> corners;
  for (const auto& t : mesh.tetrahedra) corners.insert(corners.end(), t.begin(), t.end());
  return corners;
}

inline std::string vtk_grid(const FileTetrahedra& mesh, const VtkForm& form) {
  return vtk_head(form, "UNSTRUCTURED_GRID") + vtk_points(mesh.vertices, form) +
         vtk_cells("CELLS", flat(mesh), 4, form) + "CELL_TYPES " + std::to_string(mesh.tetrahedra.size()) + "\n" +
         vtk_numbers(std::vector<std::int64_t>(mesh.tetrahedra.size(), 10), form.binary, false);
}

inline std::string base64(const std::string& bytes) {
  const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t at = 0; at < bytes.size(); at += 3) {
    std::uint32_t group = 0;
    for (std::size_t n = 0; n < 3; ++n)
      group = group << 8 | (at + n < bytes.size() ? static_cast<unsigned char>(bytes[at + n]) : 0U);
    for (std::size_t n = 0; n < 4; ++n) text += at + n > bytes.size() ? '=' : letters[group >> (18 - 6 * n) & 63];
  }
  return text;
}

enum class XmlData { kAscii, kInline, kAppendedRaw, kAppendedBase64 };

struct XmlForm {
  XmlData data = XmlData::kAscii;
  bool compressed = false;
  bool wide_header = false;  ///< UInt64 lengths
  bool big_endian = false;
};

/// Data arrays of one file as they are asked for.
class XmlArrays {
 public:
  explicit XmlArrays(const XmlForm& form) : form_(form) {}

  std::string reals(const std::string& attributes, const std::vector<double>& values) {
    std::string raw, text;
    for (const double value : values)
      put(raw, static_cast<float>(value), form_.big_endian), text += number(value) + " ";
    return array("type=\"Float32\" " + attributes, raw, text);
  }
  std::string wholes(const std::string& name, const std::vector<std::int64_t>& values) {
    std::string raw, text;
    for (const std::int64_t value : values) put(raw, value, form_.big_endian), text += std::to_string(value) + " ";
    return array("type=\"Int64\" Name=\"" + name + "\"", raw, text);
  }
  std::string appended;

 private:
  std::string array(const std::string& attributes, const std::string& raw, const std::string& text) {
    const std::string open = "<DataArray " + attributes + " format=\"";
    if (form_.data == XmlData::kAscii) return open + "ascii\">\n" + text + "\n</DataArray>\n";
    const std::string data = packed(raw);
    if (form_.data == XmlData::kInline) return open + "binary\">\n  " + data + "\n</DataArray>\n";
    const std::string place = std::to_string(appended.size());
    appended += data;
    return open + "appended\" offset=\"" + place + "\"/>\n";
  }

  void length(std::string& bytes, std::size_t value) const {
    form_.wide_header ? put(bytes, std::uint64_t{value}, form_.big_endian)
                      : put(bytes, static_cast<std::uint32_t>(value), form_.big_endian);
  }

  std::string packed(const std::string& raw) const {
    const bool letters = form_.data != XmlData::kAppendedRaw;
    std::string header, body;
    if (!form_.compressed) {
      length(header, raw.size());
      return letters ? base64(header + raw) : header + raw;
    }
    constexpr std::size_t kBlock = 1000;
    std::vector<std::string> blocks;
    for (std::size_t at = 0; at < raw.size(); at += kBlock) blocks.push_back(deflated(raw.substr(at, kBlock)));
    for (const std::size_t value : {blocks.size(), kBlock, raw.size() % kBlock}) length(header, value);
    for (const std::string& block : blocks) length(header, block.size()), body += block;
    return letters ? base64(header) + base64(body) : header + body;
  }

  static std::string deflated(const std::string& raw) {
    uLongf size = compressBound(static_cast<uLong>(raw.size()));
    std::string result(size, '\0');
    compress(reinterpret_cast<Bytef*>(result.data()), &size, reinterpret_cast<const Bytef*>(raw.data()),
             static_cast<uLong>(raw.size()));
    result.resize(size);
    return result;
  }

  XmlForm form_;
};

inline std::string xml_head(const std::string& type, const XmlForm& form) {
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"" + type + "\" version=\"1.0\" byte_order=\"" +
         (form.big_endian ? "BigEndian" : "LittleEndian") + "\" header_type=\"" +
         (form.wide_header ? "UInt64" : "UInt32") + "\"" +
         (form.compressed ? " compressor=\"vtkZLibDataCompressor\"" : "") + ">\n";
}

inline std::string xml_tail(const XmlForm& form, const std::string& appended) {
  if (form.data == XmlData::kAscii || form.data == XmlData::kInline) return "</VTKFile>\n";
  return "<AppendedData encoding=\"" + std::string(form.data == XmlData::kAppendedRaw ? "raw" : "base64") + "\">\n_" +
         appended + "\n</AppendedData>\n</VTKFile>\n";
}

inline std::string xml_points(XmlArrays& arrays, const std::vector<Vec3>& points) {
  std::vector<double> values;
  for (const Vec3& p : points) values.insert(values.end(), {p.x(), p.y(), p.z()});
  return "<Points>\n" + arrays.reals("Name=\"Points\" NumberOfComponents=\"3\"", values) + "</Points>\n";
}

inline std::vector<std::int64_t> ends_of(std::size_t cells, std::int64_t size) {
  std::vector<std::int64_t> ends;
  for (std::size_t cell = 1; cell <= cells; ++cell) ends.push_back(static_cast<std::int64_t>(cell) * size);
  return ends;
}

inline std::string vtp(const TriangleSurface& s, const XmlForm& form) {
  XmlArrays arrays(form);
  std::string text = xml_head("PolyData", form) + "<PolyData>\n<Piece NumberOfPoints=\"" +
                     std::to_string(s.vertices.size()) + "\" NumberOfPolys=\"" + std::to_string(s.triangles.size()) +
                     "\" NumberOfStrips=\"0\">\n<PointData>\n" + arrays.reals("Name=\"Points\"", {1, 2, 3}) +
                     "</PointData>\n";
  text += xml_points(arrays, s.vertices) + "<Polys>\n" + arrays.wholes("connectivity", flat(s));
  text += arrays.wholes("offsets", ends_of(s.triangles.size(), 3)) + "</Polys>\n</Piece>\n</PolyData>\n";
  return text + xml_tail(form, arrays.appended);
}

inline std::string vtu(const FileTetrahedra& mesh, const XmlForm& form) {
  XmlArrays arrays(form);
  std::string text = xml_head("UnstructuredGrid", form) + "<UnstructuredGrid>\n<Piece NumberOfPoints=\"" +
                     std::to_string(mesh.vertices.size()) + "\" NumberOfCells=\"" +
                     std::to_string(mesh.tetrahedra.size()) + "\">\n";
  text += xml_points(arrays, mesh.vertices) + "<Cells>\n" + arrays.wholes("connectivity", flat(mesh));
  text += arrays.wholes("offsets", ends_of(mesh.tetrahedra.size(), 4));
  text += arrays.wholes("types", std::vector<std::int64_t>(mesh.tetrahedra.size(), 10)) +
          "</Cells>\n</Piece>\n</UnstructuredGrid>\n";
  return text + xml_tail(form, arrays.appended);
}

}  // namespace trocar::test
