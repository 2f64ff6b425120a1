// VTK XML polydata (.vtp) and unstructured grids (.vtu), through expat: inline or appended data, all packings but LZ4
// and LZMA.
//
// Raw appended data are no XML: the parser sees the file up to them only. Document types are refused, so no entity is
// ever expanded.
#include <expat.h>

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <sstream>

#include "haptics/input_error.h"
#include "tissue/mesh/files/surface_file.h"
#include "tissue/mesh/files/text_scanner.h"
#include "tissue/mesh/files/vtk_cells.h"
#include "tissue/mesh/files/vtk_xml_data.h"

namespace trocar {
namespace {

constexpr const char* kRegions = "CellData/region";

struct XmlArray {
  NumberType type = NumberType::kNone;
  std::string format;
  std::int64_t offset = -1;
  std::string text;
};

/// Arrays by "Points", "Polys/connectivity" ...
struct XmlPiece {
  std::map<std::string, std::string> counts;  ///< attributes of the element
  std::map<std::string, XmlArray> arrays;
};

using Attributes = std::map<std::string, std::string>;

Attributes attributes_of(const XML_Char** pairs) {
  Attributes result;
  for (; pairs[0] != nullptr; pairs += 2) result[pairs[0]] = pairs[1];
  return result;
}

bool is_section(const std::string& name) {
  return name == "Points" || name == "Polys" || name == "Strips" || name == "Cells" || name == "CellData";
}

/// What the parser gathers; a failure is kept and stops it, for no exception may cross the C library.
class XmlGatherer {
 public:
  bool grid = false;
  VtkXmlPacking packing;
  std::vector<XmlPiece> pieces;
  std::map<std::string, XmlArray> fields;  ///< SPACE of 3D Slicer, UNIT and REGIONS of ours: letters as numbers
  std::string failure;

  void start(const std::string& name, const Attributes& attributes) {
    if (name == "VTKFile") return file(attributes);
    if (name == "Piece") {
      pieces.push_back({attributes, {}});
      if (pieces.size() > kMaxParts) failure = "more than " + std::to_string(kMaxParts) + " pieces";
    }
    if (is_section(name) || name == "FieldData") section_ = name;
    if (section_ == "FieldData") {
      const std::string field = value(attributes, "Name");
      if ((name == "Array" || name == "DataArray") && (field == "SPACE" || field == "UNIT" || field == "REGIONS"))
        fill(fields[field], attributes);
      return;
    }
    if (name == "DataArray" && !section_.empty() && !pieces.empty()) array(attributes);
  }

  void end(const std::string& name) {
    if (name == section_) section_.clear();
    if (name == "DataArray" || name == "Array") open_ = nullptr;
  }

  void text(std::string_view letters) {
    if (open_ != nullptr) open_->text += letters;
  }

 private:
  static std::string value(const Attributes& attributes, const char* key) {
    const auto found = attributes.find(key);
    return found == attributes.end() ? "" : found->second;
  }

  void file(const Attributes& attributes) {
    grid = value(attributes, "type") == "UnstructuredGrid";
    packing.big_endian = value(attributes, "byte_order") == "BigEndian";
    packing.header_bytes = value(attributes, "header_type") == "UInt64" ? 8 : 4;
    const std::string compressor = value(attributes, "compressor");
    packing.compressed = compressor == "vtkZLibDataCompressor";
    if (!compressor.empty() && !packing.compressed)
      failure = "compressed by " + printable(compressor) +
                ", only vtkZLibDataCompressor is read: write it with zlib or uncompressed";
  }

  void array(const Attributes& attributes) {
    const std::string name = section_ == "Points" ? section_ : section_ + "/" + value(attributes, "Name");
    if (section_ == "CellData" && name != kRegions) return;
    fill(pieces.back().arrays[name], attributes);
  }

  void fill(XmlArray& array, const Attributes& attributes) {
    open_ = &array;
    open_->type = vtk_xml_type(value(attributes, "type"));
    open_->format = value(attributes, "format");
    if (!to_whole(value(attributes, "offset"), open_->offset)) open_->offset = -1;
    open_->text.clear();
  }

  std::string section_;
  XmlArray* open_ = nullptr;
};

void XMLCALL on_start(void* user, const XML_Char* name, const XML_Char** pairs) {
  static_cast<XmlGatherer*>(user)->start(name, attributes_of(pairs));
}
void XMLCALL on_end(void* user, const XML_Char* name) { static_cast<XmlGatherer*>(user)->end(name); }
void XMLCALL on_text(void* user, const XML_Char* letters, int count) {
  static_cast<XmlGatherer*>(user)->text({letters, static_cast<std::size_t>(count)});
}
void XMLCALL on_doctype(void* user, const XML_Char*, const XML_Char*, const XML_Char*, int) {
  static_cast<XmlGatherer*>(user)->failure = "document types are not allowed";
}

/// Where the appended data begin, and how they are packed.
struct Appended {
  std::size_t xml_end = std::string_view::npos;  ///< end of what the parser may see
  std::string_view data;
  bool base64 = false;
};

Appended find_appended(std::string_view bytes, const std::string& file) {
  Appended result;
  result.xml_end = bytes.find("<AppendedData");
  if (result.xml_end == std::string_view::npos) return result;
  const std::size_t close = bytes.find('>', result.xml_end);
  const std::size_t mark = bytes.find('_', close == std::string_view::npos ? bytes.size() : close);
  if (mark == std::string_view::npos) throw InputError(file + ": the appended data do not begin: the file is cut off");
  result.base64 = bytes.substr(result.xml_end, close - result.xml_end).find("base64") != std::string_view::npos;
  result.data = bytes.substr(mark + 1);
  return result;
}

void parse_xml(std::string_view xml, bool whole, XmlGatherer& gatherer, const std::string& file) {
  const std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> parser(XML_ParserCreate(nullptr), &XML_ParserFree);
  XML_SetUserData(parser.get(), &gatherer);
  XML_SetElementHandler(parser.get(), on_start, on_end);
  XML_SetCharacterDataHandler(parser.get(), on_text);
  XML_SetStartDoctypeDeclHandler(parser.get(), on_doctype);
  constexpr std::size_t kChunk = 1 << 16;
  for (std::size_t at = 0; at < xml.size(); at += kChunk) {
    const std::string_view chunk = xml.substr(at, kChunk);
    const bool last = whole && at + kChunk >= xml.size();
    const auto status = XML_Parse(parser.get(), chunk.data(), static_cast<int>(chunk.size()), last ? 1 : 0);
    if (!gatherer.failure.empty()) throw InputError(file + ": " + gatherer.failure);
    if (status != XML_STATUS_OK)
      throw InputError(file, static_cast<int>(XML_GetCurrentLineNumber(parser.get())), 1,
                       std::string("damaged XML: ") + XML_ErrorString(XML_GetErrorCode(parser.get())));
  }
}

class PieceReader {
 public:
  PieceReader(const XmlGatherer& gatherer, const Appended& appended, const std::string& file)
      : packing_(gatherer.packing), appended_(appended), file_(file) {}

  void read(const XmlPiece& piece, bool grid, SurfaceFile& result, TriangleSurface& surface) const {
    const auto points = piece.arrays.find("Points");
    if (points == piece.arrays.end()) throw InputError(file_ + ": a piece has no points");
    surface.vertices = points_from(reals(points->second), file_);
    check_stated(piece, "NumberOfPoints", surface.vertices.size());
    check_count(surface.vertices.size(), kMaxVertices, "vertices", file_);
    if (grid) {
      const VtkCells cells = checked_cells(piece, "Cells", surface.vertices.size());
      check_stated(piece, "NumberOfCells", cells.ends.size());
      return add_cells(cells, wholes(piece, "Cells/types"), result, surface, file_);
    }
    const VtkCells polygons = checked_cells(piece, "Polys", surface.vertices.size());
    check_stated(piece, "NumberOfPolys", polygons.ends.size());
    add_polygons(polygons, surface, file_);
    add_strips(checked_cells(piece, "Strips", surface.vertices.size()), surface, file_);
  }

  /// An array of strings, each up to its 0.
  std::vector<std::string> strings_of(const XmlArray& array) const {
    std::string letters;
    if (array.format != "ascii") letters = bytes(array);
    if (array.format == "ascii")
      for (TextScanner text(array.text, file_); !text.at_end() && letters.size() < kMaxParts * kMaxNameBytes;)
        letters += static_cast<char>(text.whole("letter of a field", 0, 255));
    std::vector<std::string> strings;
    std::istringstream lines(letters);
    for (std::string one; strings.size() < kMaxParts && std::getline(lines, one, '\0');) strings.push_back(one);
    return strings;
  }

  /// Of each cell, as its array "region" counts the names. @throws InputError: a number without a name
  std::vector<std::int32_t> regions_of(const XmlPiece& piece, std::size_t names) const {
    std::vector<std::int32_t> regions;
    for (const std::int64_t region : wholes(piece, kRegions)) {
      if (region < 1 || static_cast<std::size_t>(region) > names)
        throw InputError(file_ + ": a cell is of region " + std::to_string(region) + ", but there are " +
                         std::to_string(names) + " names");
      regions.push_back(static_cast<std::int32_t>(region - 1));
    }
    return regions;
  }

 private:
  std::string bytes(const XmlArray& array) const {
    if (array.format == "appended") {
      if (array.offset < 0 || static_cast<std::uint64_t>(array.offset) >= appended_.data.size())
        throw InputError(file_ + ": an array begins behind the end of the appended data: the file is cut off");
      return unpacked_array(appended_.data.substr(static_cast<std::size_t>(array.offset)), appended_.base64, packing_,
                            file_);
    }
    if (array.format != "binary")
      throw InputError(file_ + ": arrays of format " + printable(array.format) + " are not read");
    std::string letters = array.text;
    std::erase_if(letters,
                  [](char letter) { return letter == ' ' || letter == '\n' || letter == '\r' || letter == '\t'; });
    return unpacked_array(letters, true, packing_, file_);
  }

  void check_type(const XmlArray& array, bool whole) const {
    if (array.type == NumberType::kNone || (whole && !is_whole(array.type)))
      throw InputError(file_ + ": an array has numbers of a type that is not read");
  }

  /// Small numbers grow when they are read: their count is checked before.
  std::string checked_bytes(const XmlArray& array) const {
    std::string raw = bytes(array);
    check_count(raw.size() / bytes_of(array.type), 3 * kMaxVertices, "numbers of an array", file_);
    return raw;
  }

  std::vector<double> reals(const XmlArray& array) const {
    check_type(array, false);
    if (array.format != "ascii") return stored_reals(checked_bytes(array), array.type, packing_.big_endian);
    std::vector<double> values;
    for (TextScanner text(array.text, file_); !text.at_end();) {
      values.push_back(text.number("number of an array"));
      check_count(values.size(), 3 * kMaxVertices, "numbers of an array", file_);
    }
    return values;
  }

  /// Empty when there is no such array.
  std::vector<std::int64_t> wholes(const XmlPiece& piece, const std::string& name) const {
    const auto array = piece.arrays.find(name);
    if (array == piece.arrays.end()) return {};
    check_type(array->second, true);
    const bool bare =
        array->second.format == "binary" && array->second.text.find_first_not_of(" \t\r\n") == std::string::npos;
    if (bare) return {};
    if (array->second.format != "ascii")
      return stored_wholes(checked_bytes(array->second), array->second.type, packing_.big_endian);
    std::vector<std::int64_t> values;
    for (TextScanner text(array->second.text, file_); !text.at_end();) {
      values.push_back(text.whole("corner or offset of a cell", 0, std::int64_t{1} << 40));
      check_count(values.size(), 3 * kMaxVertices, "numbers of an array", file_);
    }
    return values;
  }

  VtkCells checked_cells(const XmlPiece& piece, const std::string& section, std::size_t points) const {
    VtkCells cells{wholes(piece, section + "/connectivity"), wholes(piece, section + "/offsets")};
    check_cells(cells, points, file_);
    return cells;
  }

  void check_stated(const XmlPiece& piece, const char* key, std::size_t found) const {
    const auto stated = piece.counts.find(key);
    if (stated != piece.counts.end() && stated->second != std::to_string(found))
      throw InputError(file_ + ": " + key + "=\"" + printable(stated->second) + "\", but there are " +
                       std::to_string(found));
  }

  const VtkXmlPacking& packing_;
  const Appended& appended_;
  const std::string& file_;
};

/// The vertices of this piece's tetrahedra come behind those of the pieces before.
void shift_tetrahedra(FileTetrahedra& mesh, std::size_t first, const TriangleSurface& piece, std::int32_t region) {
  if (mesh.tetrahedra.size() == first) return;
  const auto shift = static_cast<std::int32_t>(mesh.vertices.size());
  for (std::size_t t = first; t < mesh.tetrahedra.size(); ++t)
    for (std::int32_t& corner : mesh.tetrahedra[t]) corner += shift;
  mesh.regions.resize(mesh.tetrahedra.size(), region);
  mesh.vertices.insert(mesh.vertices.end(), piece.vertices.begin(), piece.vertices.end());
}

}  // namespace

SurfaceFile read_vtk_xml(std::string_view bytes, const std::string& file) {
  const Appended appended = find_appended(bytes, file);
  XmlGatherer gatherer;
  parse_xml(bytes.substr(0, appended.xml_end), appended.xml_end == std::string_view::npos, gatherer, file);
  if (gatherer.pieces.empty()) throw InputError(file + ": holds no piece");
  const PieceReader reader(gatherer, appended, file);
  SurfaceFile result;
  const auto field = [&](const char* name) {
    const auto found = gatherer.fields.find(name);
    return found == gatherer.fields.end() ? std::vector<std::string>{} : reader.strings_of(found->second);
  };
  if (gatherer.fields.contains("SPACE")) {
    const auto space = field("SPACE");
    take_space(space.empty() ? "" : space.front(), result, file);
  }
  if (const auto unit = field("UNIT"); !unit.empty())
    take_comment("UNIT=" + unit.front(), "the field UNIT", result, file);
  const std::vector<std::string> regions = field("REGIONS");
  std::size_t vertices = 0, triangles = 0;
  for (std::size_t n = 0; n < gatherer.pieces.size(); ++n) {
    const std::string name = gatherer.pieces.size() == 1 ? "" : "piece " + std::to_string(n);
    const std::size_t first = result.tetrahedra.tetrahedra.size();
    FilePart part{name, {}, {}};
    reader.read(gatherer.pieces[n], gatherer.grid, result, part.surface);
    check_count(vertices += part.surface.vertices.size(), kMaxVertices, "vertices", file);
    check_count(triangles += part.surface.triangles.size(), kMaxTriangles, "triangles", file);
    result.tetrahedra.region_names.push_back(name.empty() ? "tetrahedra" : name);
    shift_tetrahedra(result.tetrahedra, first, part.surface, static_cast<std::int32_t>(n));
    result.parts.push_back(std::move(part));
  }
  if (!regions.empty() && gatherer.pieces.size() == 1) {
    FileTetrahedra& mesh = result.tetrahedra;
    auto of_cells = reader.regions_of(gatherer.pieces.front(), regions.size());
    if (of_cells.size() == mesh.tetrahedra.size() && !of_cells.empty()) {  // else some cells are no tetrahedra
      mesh.regions = std::move(of_cells);
      mesh.region_names.clear();
      for (const std::string& name : regions) mesh.region_names.push_back(printable(name));
    }
  }
  return result;
}

}  // namespace trocar
