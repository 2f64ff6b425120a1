// The lattice's file: "TROCLAT1", origin and cell (f64), counts (u32: nodes, cells, vertices), then nodes (3 i32),
// cells (3 i32 place, 8 i32 corners, f64 fill, i32 label) and vertices (i32 cell, 8 f32 weights). Little endian,
// nothing else.
#include <bit>
#include <cmath>
#include <cstring>

#include "haptics/input_error.h"
#include "tissue/solid/lattice.h"

namespace trocar {
namespace {

static_assert(std::endian::native == std::endian::little, "the file is written as memory holds it");

constexpr std::string_view kMagic = "TROCLAT1";
constexpr std::size_t kHeader = 8 + 4 * 8 + 3 * 4, kNode = 12, kCell = 12 + 32 + 8 + 4, kVertex = 4 + 32;
constexpr double kWeightTolerance = 1e-4;

template <typename Value>
void put_value(std::string& bytes, const Value& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

class Reader {
 public:
  Reader(const std::string& bytes, const std::string& file) : bytes_(bytes), file_(file) {}

  template <typename Value>
  Value get() {
    Value value;
    if (bytes_.size() - at_ < sizeof value) fail("the file ends too early");
    std::memcpy(&value, bytes_.data() + at_, sizeof value);
    at_ += sizeof value;
    return value;
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(file_ + ": byte " + std::to_string(at_) + ": " + what + ": make the lattice again");
  }
  std::size_t left() const { return bytes_.size() - at_; }
  void skip(std::size_t count) { at_ += count; }

 private:
  const std::string& bytes_;
  const std::string& file_;
  std::size_t at_ = 0;
};

void read_cell(Reader& in, Lattice& lattice) {
  LatticeCell cell;
  for (auto& index : cell.place) index = in.get<std::int32_t>();
  for (std::size_t n = 0; n < 8; ++n) {
    cell.corners[n] = in.get<std::int32_t>();
    if (cell.corners[n] < 0 || static_cast<std::size_t>(cell.corners[n]) >= lattice.nodes.size())
      in.fail("a corner names no node");
    const auto& node = lattice.nodes[static_cast<std::size_t>(cell.corners[n])];
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (std::int64_t{node[axis]} != std::int64_t{cell.place[axis]} + static_cast<std::int64_t>(n >> axis & 1))
        in.fail("a corner is not where its cell lies");
  }
  cell.fill = in.get<double>();
  if (!(cell.fill > 0 && cell.fill <= 1)) in.fail("a cell's fill is not in 0..1");
  cell.label = in.get<std::int32_t>();
  lattice.cells.push_back(cell);
}

void read_lattice_vertex(Reader& in, Lattice& lattice) {
  Embedding e;
  e.cell = in.get<std::int32_t>();
  if (e.cell < 0 || static_cast<std::size_t>(e.cell) >= lattice.cells.size()) in.fail("a vertex lies in no cell");
  double sum = 0;
  for (float& weight : e.weights) {
    weight = in.get<float>();
    if (!(weight >= 0 && weight <= 1)) in.fail("a weight is not in 0..1");
    sum += weight;
  }
  if (std::abs(sum - 1) > kWeightTolerance) in.fail("weights of a vertex do not sum to 1");
  lattice.embedding.push_back(e);
}

}  // namespace

std::string lattice_bytes(const Lattice& lattice) {
  std::string bytes(kMagic);
  for (Eigen::Index axis = 0; axis < 3; ++axis) put_value(bytes, lattice.origin_m[axis]);
  put_value(bytes, lattice.cell_m);
  put_value(bytes, static_cast<std::uint32_t>(lattice.nodes.size()));
  put_value(bytes, static_cast<std::uint32_t>(lattice.cells.size()));
  put_value(bytes, static_cast<std::uint32_t>(lattice.embedding.size()));
  for (const auto& node : lattice.nodes)
    for (const auto index : node) put_value(bytes, index);
  for (const LatticeCell& cell : lattice.cells) {
    for (const auto index : cell.place) put_value(bytes, index);
    for (const auto corner : cell.corners) put_value(bytes, corner);
    put_value(bytes, cell.fill);
    put_value(bytes, cell.label);
  }
  for (const Embedding& e : lattice.embedding) {
    put_value(bytes, e.cell);
    for (const float weight : e.weights) put_value(bytes, weight);
  }
  return bytes;
}

Lattice parse_lattice(const std::string& bytes, const std::string& file) {
  Reader in(bytes, file);
  if (bytes.size() < kHeader || bytes.compare(0, kMagic.size(), kMagic) != 0) in.fail("this is no lattice file");
  in.skip(kMagic.size());
  Lattice lattice;
  for (Eigen::Index axis = 0; axis < 3; ++axis) lattice.origin_m[axis] = in.get<double>();
  lattice.cell_m = in.get<double>();
  if (!lattice.origin_m.allFinite() || !(lattice.cell_m > 0 && lattice.cell_m < 1))
    in.fail("origin or cell is not a length in metres");
  const std::uint64_t nodes = in.get<std::uint32_t>(), cells = in.get<std::uint32_t>(),
                      vertices = in.get<std::uint32_t>();
  if (nodes * kNode + cells * kCell + vertices * kVertex != in.left())
    in.fail("the counts do not fit the file's length");
  for (std::uint64_t n = 0; n < nodes; ++n) {
    auto& node = lattice.nodes.emplace_back();
    for (auto& index : node) index = in.get<std::int32_t>();
  }
  for (std::uint64_t n = 0; n < cells; ++n) read_cell(in, lattice);
  for (std::uint64_t n = 0; n < vertices; ++n) read_lattice_vertex(in, lattice);
  return lattice;
}

}  // namespace trocar
