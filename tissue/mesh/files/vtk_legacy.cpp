// VTK legacy files, versions 1 to 5.1, text or big-endian binary: POLYDATA and UNSTRUCTURED_GRID.
//
// The file is a list of sections; what comes before the cells is read or stepped over by its length, what comes after
// the last section that matters (POINT_DATA, CELL_DATA) is not looked at. The title in the second line is never shown:
// people write names there.
#include <array>
#include <utility>

#include "haptics/input_error.h"
#include "tissue/mesh/files/stored_numbers.h"
#include "tissue/mesh/files/surface_file.h"
#include "tissue/mesh/files/text_scanner.h"
#include "tissue/mesh/files/vtk_cells.h"

namespace trocar {
namespace {

constexpr std::int64_t kMost = 8 * std::int64_t{kMaxTriangles};  ///< numbers of one list of cells

NumberType type_of(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, NumberType>, 18> kTypes{{{"char", NumberType::kInt8},
                                                                            {"unsigned_char", NumberType::kUint8},
                                                                            {"short", NumberType::kInt16},
                                                                            {"unsigned_short", NumberType::kUint16},
                                                                            {"int", NumberType::kInt32},
                                                                            {"unsigned_int", NumberType::kUint32},
                                                                            {"long", NumberType::kInt64},
                                                                            {"unsigned_long", NumberType::kUint64},
                                                                            {"vtkIdType", NumberType::kInt32},
                                                                            {"vtkidtype", NumberType::kInt32},
                                                                            {"vtktypeint64", NumberType::kInt64},
                                                                            {"vtktypeuint64", NumberType::kUint64},
                                                                            {"vtktypeint32", NumberType::kInt32},
                                                                            {"vtktypeuint32", NumberType::kUint32},
                                                                            {"vtktypeint8", NumberType::kInt8},
                                                                            {"vtktypeuint8", NumberType::kUint8},
                                                                            {"float", NumberType::kFloat32},
                                                                            {"double", NumberType::kFloat64}}};
  for (const auto& [known, type] : kTypes)
    if (name == known) return type;
  return NumberType::kNone;
}

class LegacyReader {
 public:
  LegacyReader(std::string_view bytes, const std::string& file) : text_(bytes, file), file_(file) {}

  SurfaceFile read() {
    header();
    while (section()) {
    }
    finish();
    return std::move(result_);
  }

 private:
  void header() {
    const std::string_view first = text_.line();
    const std::size_t version = first.find("Version ");
    double number = 0;
    if (version == std::string_view::npos || !to_number(first.substr(version + 8, 3), number))
      text_.refuse("\"# vtk DataFile Version x.y\" expected");
    if (number < 1 || number >= 6)
      text_.refuse("version " + printable(first.substr(version + 8, 3)) + " is not read, only 1.0 to 5.1");
    modern_ = number >= 5;
    take_comment(text_.line(), "the title", result_, file_);
    const std::string_view form = text_.word();
    binary_ = form == "BINARY";
    if (!binary_ && form != "ASCII") text_.refuse("ASCII or BINARY expected");
    if (text_.word() != "DATASET") text_.refuse("DATASET expected");
    const std::string_view kind = text_.word();
    grid_ = kind == "UNSTRUCTURED_GRID";
    if (kind == "STRUCTURED_POINTS")
      text_.refuse("holds an image (STRUCTURED_POINTS), not a surface: give it as a volume");
    if (!grid_ && kind != "POLYDATA")
      text_.refuse("DATASET " + printable(kind) + " is no surface: POLYDATA or UNSTRUCTURED_GRID is read");
  }

  /// @return whether something may follow that matters
  bool section() {
    const std::string_view key = text_.word();
    if (key.empty() || key == "POINT_DATA" || key == "CELL_DATA") return false;
    if (key == "POINTS") return points(), true;
    if (key == "METADATA") return metadata(), true;
    if (key == "FIELD") return field(), true;
    if (!grid_ && (key == "POLYGONS" || key == "TRIANGLE_STRIPS" || key == "VERTICES" || key == "LINES")) {
      (key == "POLYGONS" ? polygons_ : key == "TRIANGLE_STRIPS" ? strips_ : ignored_) = cells();
      if (key == "VERTICES" || key == "LINES") result_.remarks.push_back("lines and points in the file were left out");
      return true;
    }
    if (grid_ && key == "CELLS") return polygons_ = cells(), true;
    if (grid_ && key == "CELL_TYPES") return cell_types(), true;
    text_.refuse("\"" + printable(key) + "\" is not expected here");
  }

  void points() {
    if (!points_.empty()) text_.refuse("POINTS appears twice");
    const std::int64_t count = text_.whole("number of points", 0, kMaxVertices);
    points_ = points_from(reals(3 * count, text_.word()), file_);
  }

  void cell_types() {
    const std::int64_t count = text_.whole("number of cell types", 0, kMaxTriangles * 4);
    types_ = wholes(count, "int");
  }

  /// Lines up to an empty one.
  void metadata() {
    text_.line();
    for (std::string_view line = text_.line(); !line.empty() && line != " "; line = text_.line())
      if (text_.rest().empty()) return;
  }

  void field() {
    text_.word();
    const std::int64_t arrays = text_.whole("number of arrays", 0, 1000);
    for (std::int64_t n = 0; n < arrays; ++n) {
      if (text_.peek() == "METADATA") metadata();
      const std::string name(text_.word());
      const std::int64_t components = text_.whole("components of an array", 0, 10000);
      const std::int64_t tuples = text_.whole("length of an array", 0, kMost / 10000);
      const std::string_view type = text_.word();
      if (type == "string")
        strings(components * tuples, name == "SPACE");
      else
        reals(components * tuples, type);
    }
  }

  /// A line each; in a binary file a length before each, whose first two bits say how many bytes it has (1 to 8).
  void strings(std::int64_t count, bool is_space) {
    text_.line();
    for (std::int64_t n = 0; n < count; ++n) {
      if (text_.rest().empty()) text_.refuse("the file ends within an array of texts: it is cut off");
      const std::string_view text = binary_ ? counted_text() : text_.line();
      if (is_space && n == 0) take_space(std::string(text), result_, file_);
    }
  }

  std::string_view counted_text() {
    const auto byte = [&](std::size_t n) { return static_cast<unsigned char>(text_.rest()[n]); };
    const std::size_t bytes = std::size_t{1} << (3 - (byte(0) >> 6U));
    std::uint64_t length = byte(0) & 0x3fU;
    for (std::size_t n = 1; n < bytes; ++n) {
      if (n >= text_.rest().size()) text_.refuse("the file ends within a text: it is cut off");
      length = length << 8U | byte(n);
    }
    text_.skip(bytes);
    if (length > text_.rest().size()) text_.refuse("the file ends within a text: it is cut off");
    const std::string_view text = text_.rest().substr(0, static_cast<std::size_t>(length));
    text_.skip(static_cast<std::size_t>(length));
    return text;
  }

  VtkCells cells() {
    const std::int64_t count = text_.whole("number of cells", 0, kMaxTriangles * 4);
    const std::int64_t size = text_.whole("length of the list of cells", 0, kMost);
    if (!modern_) return cells_of_counted_list(wholes(size, "int"), count, file_);
    VtkCells result;
    if (count == 0) return result;
    if (text_.word() != "OFFSETS") text_.refuse("OFFSETS expected");
    result.ends = wholes(count, text_.word());
    if (result.ends[0] != 0) text_.refuse("the first offset is not 0");
    result.ends.erase(result.ends.begin());
    if (text_.word() != "CONNECTIVITY") text_.refuse("CONNECTIVITY expected");
    result.corners = wholes(size, text_.word());
    return result;
  }

  /// Steps to the data of an array and says where it is.
  std::string_view raw(std::int64_t count, NumberType type) {
    text_.line();
    const std::size_t bytes = static_cast<std::size_t>(count) * bytes_of(type);
    const std::string_view data = text_.rest().substr(0, bytes);
    if (data.size() < bytes)
      throw InputError(file_ + ": the file ends within an array of " + std::to_string(count) +
                       " numbers: it is cut off");
    text_.skip(bytes);
    return data;
  }

  /// Text has at least a digit and a blank for each number: no room is made for more than there can be.
  void check_text_length(std::int64_t count) {
    if (static_cast<std::uint64_t>(count) > text_.rest().size() / 2 + 1)
      throw InputError(file_ + ": an array of " + std::to_string(count) +
                       " numbers is longer than the file: it is cut off");
  }

  NumberType checked(std::string_view name) {
    const NumberType type = type_of(name);
    if (type == NumberType::kNone) text_.refuse("numbers of type " + printable(name) + " are not read");
    return type;
  }

  std::vector<double> reals(std::int64_t count, std::string_view name) {
    const NumberType type = checked(name);
    if (binary_) return stored_reals(raw(count, type), type, true);
    check_text_length(count);
    std::vector<double> values;
    values.reserve(static_cast<std::size_t>(count));
    for (std::int64_t n = 0; n < count; ++n) values.push_back(text_.number("number of an array"));
    return values;
  }

  std::vector<std::int64_t> wholes(std::int64_t count, std::string_view name) {
    const NumberType type = checked(name);
    if (!is_whole(type)) text_.refuse("cells are listed by numbers that are not whole");
    if (binary_) return stored_wholes(raw(count, type), type, true);
    check_text_length(count);
    std::vector<std::int64_t> values;
    values.reserve(static_cast<std::size_t>(count));
    for (std::int64_t n = 0; n < count; ++n) values.push_back(text_.whole("corner or count of a cell", 0, kMost));
    return values;
  }

  void finish() {
    TriangleSurface& surface = result_.parts.emplace_back().surface;
    surface.vertices = std::move(points_);
    check_cells(polygons_, surface.vertices.size(), file_);
    check_cells(strips_, surface.vertices.size(), file_);
    if (!grid_) {
      add_polygons(polygons_, surface, file_);
      add_strips(strips_, surface, file_);
      return;
    }
    add_cells(polygons_, types_, result_, surface, file_);
    if (result_.tetrahedra.tetrahedra.empty()) return;
    result_.tetrahedra.vertices = surface.vertices;
    result_.tetrahedra.region_names = {"tetrahedra"};
  }

  TextScanner text_;
  std::string file_;
  bool binary_ = false, modern_ = false, grid_ = false;
  std::vector<Vec3> points_;
  std::vector<std::int64_t> types_;
  VtkCells polygons_, strips_, ignored_;
  SurfaceFile result_;
};

}  // namespace

SurfaceFile read_vtk_legacy(std::string_view bytes, const std::string& file) {
  return LegacyReader(bytes, file).read();
}

}  // namespace trocar
