// Gmsh meshes: 1.0 in text, 2.0 to 2.2 and 4.1 in text or binary. Tetrahedra by region, triangles and quads by region.
//
// Gmsh MSH file format, Gmsh reference manual chapter 9. Curved elements are taken by their corners.
#include <algorithm>
#include <cstring>
#include <map>

#include "haptics/input_error.h"
#include "tissue/mesh/files/stored_numbers.h"
#include "tissue/mesh/files/surface_file.h"
#include "tissue/mesh/files/text_scanner.h"

namespace trocar {
namespace {

constexpr std::int64_t kMostElements = 4 * std::int64_t{kMaxTriangles};
constexpr std::int64_t kAnyTag = std::int64_t{1} << 53;

enum class Shape { kUnknown, kIgnored, kTriangle, kQuad, kTetrahedron, kOtherSolid };

struct ElementType {
  Shape shape = Shape::kUnknown;
  int nodes = 0;
};

/// Numbers of the manual, 1 to 31.
ElementType element_type(std::int64_t number) {
  constexpr auto kLine = Shape::kIgnored;
  constexpr auto kTri = Shape::kTriangle;
  constexpr auto kQuad = Shape::kQuad;
  constexpr auto kTet = Shape::kTetrahedron;
  constexpr auto kSolid = Shape::kOtherSolid;
  constexpr std::array<ElementType, 32> kTypes{
      {{},         {kLine, 2},   {kTri, 3},    {kQuad, 4},   {kTet, 4},    {kSolid, 8},  {kSolid, 6},  {kSolid, 5},
       {kLine, 3}, {kTri, 6},    {kQuad, 9},   {kTet, 10},   {kSolid, 27}, {kSolid, 18}, {kSolid, 14}, {kLine, 1},
       {kQuad, 8}, {kSolid, 20}, {kSolid, 15}, {kSolid, 13}, {kTri, 9},    {kTri, 10},   {kTri, 12},   {kTri, 15},
       {kTri, 15}, {kTri, 21},   {kLine, 4},   {kLine, 5},   {kLine, 6},   {kTet, 20},   {kTet, 35},   {kTet, 56}}};
  return number >= 1 && number < 32 ? kTypes[static_cast<std::size_t>(number)] : ElementType{};
}

class GmshReader {
 public:
  GmshReader(std::string_view bytes, const std::string& file) : text_(bytes, file), file_(file) {}

  SurfaceFile read() {
    while (!text_.at_end()) section(text_.word());
    finish();
    return std::move(result_);
  }

 private:
  void section(std::string_view name) {
    if (!name.starts_with('$')) text_.refuse("a section \"$...\" expected, not \"" + printable(name) + "\"");
    const std::string end = name == "$NOD"   ? "$ENDNOD"
                            : name == "$ELM" ? "$ENDELM"
                                             : "$End" + std::string(name.substr(1));
    if (name == "$MeshFormat")
      format();
    else if (name == "$PhysicalNames")
      physical_names();
    else if (name == "$NOD" || (name == "$Nodes" && version_ < 4))
      nodes();
    else if (name == "$ELM")
      elements_1();
    else if (name == "$Elements" && version_ < 4)
      binary_ ? elements_2_binary() : elements_2();
    else if (name == "$Nodes")
      node_blocks();
    else if (name == "$Elements")
      element_blocks();
    else
      return skip_to(end);
    if (text_.word() != end) text_.refuse(end + " expected: the file is cut off or damaged");
  }

  void skip_to(const std::string& end) {
    const std::size_t at = text_.rest().find(end);
    if (at == std::string_view::npos) text_.refuse(printable(end) + " is missing: the file is cut off or damaged");
    text_.skip(at + end.size());
  }

  void format() {
    const double version = text_.number("version");
    version_ = version;
    if (!(version >= 2 && version < 2.3) && version != 4.1)
      text_.refuse("version " + std::to_string(version).substr(0, 3) +
                   " is not read, only 1.0, 2.x and 4.1: save it as 2.2 or 4.1");
    binary_ = text_.whole("file type", 0, 1) == 1;
    if (text_.whole("size of a number", 4, 16) != 8) text_.refuse("numbers of a size other than 8 bytes are not read");
    if (!binary_) return;
    text_.line();
    const std::string_view mark = taken(4);
    big_endian_ = mark[0] == 0;
    if (stored_wholes(mark, NumberType::kInt32, big_endian_)[0] != 1)
      text_.refuse("the mark of the byte order is damaged");
  }

  void physical_names() {
    const std::int64_t count = text_.whole("number of names", 0, kMaxParts);
    for (std::int64_t n = 0; n < count; ++n) {
      const auto dimension = text_.whole("dimension", 0, 3), tag = text_.whole("physical tag", -kAnyTag, kAnyTag);
      std::string_view name = text_.line();
      const std::size_t first = name.find('"'), last = name.rfind('"');
      if (first < last && last != std::string_view::npos)
        names_[{dimension, tag}] = printable(name.substr(first + 1, last - first - 1));
    }
  }

  std::string_view taken(std::uint64_t bytes) {
    const std::string_view data = text_.rest().substr(0, static_cast<std::size_t>(bytes));
    if (data.size() < bytes) throw InputError(file_ + ": the file ends within binary data: it is cut off");
    text_.skip(data.size());
    return data;
  }
  std::vector<std::int64_t> ints(std::uint64_t count) {
    return stored_wholes(taken(4 * count), NumberType::kInt32, big_endian_);
  }
  std::vector<std::int64_t> sizes(std::uint64_t count) {
    return stored_wholes(taken(8 * count), NumberType::kInt64, big_endian_);
  }
  std::vector<double> reals(std::uint64_t count) {
    return stored_reals(taken(8 * count), NumberType::kFloat64, big_endian_);
  }

  void check_room(std::int64_t count) const {
    if (count < 0 || static_cast<std::uint64_t>(count) > text_.rest().size())
      text_.refuse("a count of " + std::to_string(count) + " is more than the file can hold: it is cut off or damaged");
  }

  void node(std::int64_t tag, const Vec3& point) {
    points_from({point.x(), point.y(), point.z()}, file_);
    check_count(points_.size() + 1, kMaxVertices, "nodes", file_);
    tags_.emplace_back(tag, static_cast<std::int32_t>(points_.size()));
    points_.push_back(point);
  }

  Vec3 text_point() {
    Vec3 point;
    for (int axis = 0; axis < 3; ++axis) point[axis] = text_.number("coordinate of a node");
    return point;
  }

  void nodes() {
    const std::int64_t count = text_.whole("number of nodes", 0, kMaxVertices);
    if (binary_) text_.line();
    check_room(count);
    for (std::int64_t n = 0; n < count; ++n) {
      const std::int64_t tag = binary_ ? ints(1)[0] : text_.whole("number of a node", -kAnyTag, kAnyTag);
      if (binary_) {
        const auto p = reals(3);
        node(tag, Vec3(p[0], p[1], p[2]));
      } else {
        node(tag, text_point());
      }
    }
  }

  /// Version 4.1: numbers of a block, its nodes' tags, then their coordinates.
  void node_blocks() {
    if (binary_) text_.line();
    const auto head = numbers(4);
    check_room(head[0]);
    for (std::int64_t block = 0; block < head[0]; ++block) {
      const auto [dimension, parametric, count] = block_head();
      check_room(count);
      const auto tags = numbers(count);
      const int extra = parametric != 0 ? static_cast<int>(dimension) : 0;
      for (const std::int64_t tag : tags) {
        if (binary_) {
          const auto p = reals(static_cast<std::uint64_t>(3 + extra));
          node(tag, Vec3(p[0], p[1], p[2]));
          continue;
        }
        const Vec3 point = text_point();
        for (int n = 0; n < extra; ++n) text_.number("parameter of a node");
        node(tag, point);
      }
    }
  }

  struct BlockHead {
    std::int64_t dimension, third, count;
  };

  /// Dimension, entity, a third whole number; then the count.
  BlockHead block_head() {
    std::vector<std::int64_t> head;
    if (binary_)
      head = ints(3);
    else
      for (int n = 0; n < 3; ++n) head.push_back(text_.whole("number of a block", -kAnyTag, kAnyTag));
    if (head[0] < 0 || head[0] > 3) text_.refuse("a block of dimension " + std::to_string(head[0]));
    entity_ = head[1];
    return {head[0], head[2], numbers(1)[0]};
  }

  /// Version 4.1: whole numbers as text, or of 8 bytes each.
  std::vector<std::int64_t> numbers(std::int64_t count) {
    if (binary_) {
      return sizes(static_cast<std::uint64_t>(count));
    }
    std::vector<std::int64_t> result;
    for (std::int64_t n = 0; n < count; ++n) result.push_back(text_.whole("whole number", -kAnyTag, kAnyTag));
    return result;
  }

  ElementType checked_type(std::int64_t number) const {
    const ElementType type = element_type(number);
    if (type.shape == Shape::kUnknown) text_.refuse("elements of type " + std::to_string(number) + " are not read");
    if (type.shape == Shape::kOtherSolid)
      text_.refuse(
          "hexahedra, prisms and pyramids are not read, only tetrahedra and triangles: split them, or save the "
          "surface");
    return type;
  }

  void element(ElementType type, std::int64_t region, const std::vector<std::int64_t>& nodes) {
    if (type.shape == Shape::kIgnored) return;
    const bool solid = type.shape == Shape::kTetrahedron;
    const std::size_t corners = type.shape == Shape::kTriangle ? 3 : 4;
    check_count(++elements_, kMaxTriangles, "elements", file_);
    auto& list = lists_[{solid ? 3 : 2, region}];
    check_count(lists_.size(), kMaxParts, "regions", file_);
    std::array<std::int64_t, 4> entry{-1, -1, -1, -1};
    for (std::size_t n = 0; n < corners; ++n) entry[n] = nodes[n];
    if (corners == 3) entry[3] = kAnyTag + 1;
    list.push_back(entry);
  }

  std::vector<std::int64_t> text_nodes(int count) {
    std::vector<std::int64_t> nodes;
    for (int n = 0; n < count; ++n) nodes.push_back(text_.whole("node of an element", -kAnyTag, kAnyTag));
    return nodes;
  }

  void elements_1() {
    const std::int64_t count = text_.whole("number of elements", 0, kMostElements);
    for (std::int64_t n = 0; n < count; ++n) {
      text_.whole("number of an element", -kAnyTag, kAnyTag);
      const ElementType type = checked_type(text_.whole("type of an element", 0, 1000));
      const std::int64_t region = text_.whole("region of an element", -kAnyTag, kAnyTag);
      text_.whole("entity of an element", -kAnyTag, kAnyTag);
      if (text_.whole("nodes of an element", 0, 1000) != type.nodes)
        text_.refuse("an element has a false number of nodes");
      element(type, region, text_nodes(type.nodes));
    }
  }

  void elements_2() {
    const std::int64_t count = text_.whole("number of elements", 0, kMostElements);
    for (std::int64_t n = 0; n < count; ++n) {
      text_.whole("number of an element", -kAnyTag, kAnyTag);
      const ElementType type = checked_type(text_.whole("type of an element", 0, 1000));
      const std::int64_t tags = text_.whole("number of tags", 0, 1000);
      std::int64_t region = 0;
      for (std::int64_t tag = 0; tag < tags; ++tag) {
        const std::int64_t value = text_.whole("tag of an element", -kAnyTag, kAnyTag);
        if (tag == 0) region = value;
      }
      element(type, region, text_nodes(type.nodes));
    }
  }

  void elements_2_binary() {
    const std::int64_t count = text_.whole("number of elements", 0, kMostElements);
    text_.line();
    for (std::int64_t done = 0; done < count;) {
      const auto head = ints(3);  // type, elements that follow, tags of each
      const ElementType type = checked_type(head[0]);
      check_room(head[1]);
      if (head[1] < 1 || head[2] < 0 || head[2] > 1000) text_.refuse("a damaged block of elements");
      for (std::int64_t n = 0; n < head[1]; ++n) {
        const auto row = ints(static_cast<std::uint64_t>(1 + head[2] + type.nodes));
        element(type, head[2] > 0 ? row[1] : 0, {row.end() - type.nodes, row.end()});
      }
      done += head[1];
    }
  }

  void element_blocks() {
    if (binary_) text_.line();
    const auto head = numbers(4);
    check_room(head[0]);
    for (std::int64_t block = 0; block < head[0]; ++block) {
      const auto [dimension, number, count] = block_head();
      const ElementType type = checked_type(number);
      check_room(count);
      for (std::int64_t n = 0; n < count; ++n) {
        const auto row = numbers(1 + type.nodes);
        element(type, entity_, {row.begin() + 1, row.end()});
      }
    }
  }

  std::int32_t index_of(std::int64_t tag) const {
    const auto direct = static_cast<std::size_t>(tag - 1);
    if (tag >= 1 && direct < tags_.size() && tags_[direct].first == tag) return tags_[direct].second;
    const auto found = std::lower_bound(tags_.begin(), tags_.end(), std::pair(tag, std::int32_t{-1}));
    if (found == tags_.end() || found->first != tag)
      throw InputError(file_ + ": an element names node " + std::to_string(tag) + ", which the file does not have");
    return found->second;
  }

  void finish() {
    std::sort(tags_.begin(), tags_.end());
    for (std::size_t n = 1; n < tags_.size(); ++n)
      if (tags_[n].first == tags_[n - 1].first)
        throw InputError(file_ + ": two nodes carry the number " + std::to_string(tags_[n].first));
    std::vector<std::int32_t> scratch(points_.size(), -1);
    for (const auto& [key, list] : lists_)
      key.first == 3 ? add_solid(key.second, list) : add_surface(key.second, list, scratch);
    result_.tetrahedra.vertices = std::move(points_);
  }

  std::string region_name(int dimension, std::int64_t region) const {
    const auto found = names_.find({dimension, region});
    return found != names_.end() ? found->second : (dimension == 3 ? "volume " : "surface ") + std::to_string(region);
  }

  using List = std::vector<std::array<std::int64_t, 4>>;

  void add_solid(std::int64_t region, const List& list) {
    FileTetrahedra& mesh = result_.tetrahedra;
    const auto number = static_cast<std::int32_t>(mesh.region_names.size());
    mesh.region_names.push_back(region_name(3, region));
    for (const auto& nodes : list) {
      mesh.tetrahedra.push_back({index_of(nodes[0]), index_of(nodes[1]), index_of(nodes[2]), index_of(nodes[3])});
      mesh.regions.push_back(number);
    }
  }

  void add_surface(std::int64_t region, const List& list, std::vector<std::int32_t>& scratch) {
    FilePart part{region_name(2, region), {}, {}};
    for (const auto& nodes : list) {
      const std::int32_t a = index_of(nodes[0]), b = index_of(nodes[1]), c = index_of(nodes[2]);
      part.surface.triangles.push_back({a, b, c});
      if (nodes[3] <= kAnyTag) part.surface.triangles.push_back({a, c, index_of(nodes[3])});
    }
    take_vertices(part.surface, points_, scratch);
    result_.parts.push_back(std::move(part));
  }

  TextScanner text_;
  std::string file_;
  double version_ = 1;
  bool binary_ = false, big_endian_ = false;
  std::size_t elements_ = 0;
  std::int64_t entity_ = 0;  ///< of the block being read
  std::vector<Vec3> points_;
  std::vector<std::pair<std::int64_t, std::int32_t>> tags_;  ///< number in the file, index here
  std::map<std::pair<int, std::int64_t>, List> lists_;       ///< corners by dimension and region
  std::map<std::pair<std::int64_t, std::int64_t>, std::string> names_;
  SurfaceFile result_;
};

}  // namespace

SurfaceFile read_gmsh(std::string_view bytes, const std::string& file) { return GmshReader(bytes, file).read(); }

}  // namespace trocar
