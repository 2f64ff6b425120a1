// A lattice that can be cut: cells and nodes are doubled where the tissue is severed (virtual nodes: Molino 2004, Wang
// 2014), so that no cell ever changes its shape.
//
// Each cell holds 4 x 4 x 4 small cubes, linked with their neighbours across its faces too. A cut's sheet breaks the
// links that it crosses. Where those of a cell fall apart, it becomes one cell for each part, with that share of its
// fill; round a node the cells that still hang together share it, each other group gets a node of its own. A sheet that
// has broken half of a cell's section breaks the rest of it: a cut is known to half a cell. Parts of less than a
// sixteenth stay with what is next to them. The surface is grooved (groove.h), and its vertices follow the cell on
// their side. A cut that would take a piece off is refused, whole. Undeformed, m, T or any other frame of lattice and
// surface. Same cuts, same bytes: playback makes them again. Thread: any.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "tissue/mesh/surface/groove.h"
#include "tissue/solid/lattice.h"
#include "tissue/surface_snapshot.h"

namespace trocar {

/// What a cut did to the cells. Those that were there keep their numbers, and so do the nodes.
struct LatticeChange {
  std::vector<std::int32_t> node_parent;  ///< of each new node
  struct Cell {
    std::int32_t number = 0, parent = 0;  ///< the same where it was there before
  };
  std::vector<Cell> cells;          ///< that have other corners or another fill, new ones at the end
  std::vector<VertexOrigin> added;  ///< vertices of the surface
};

class CutLattice {
 public:
  /// @param rest the surface that the lattice was built over.
  CutLattice(Lattice lattice, SurfacePtr rest);

  const Lattice& lattice() const { return lattice_; }
  const SurfacePtr& rest() const { return rest_; }  ///< with another topology after every cut
  /// As it was some cuts ago, for places that are still told in its triangles; nullptr: too long ago, or never.
  SurfacePtr rest_of(std::uint64_t topology) const;

  /// Of several organs on one grid: whose vertex it is.
  std::int32_t part_of(std::int32_t vertex) const;
  /// Whether a place at rest lies in the tissue of a part, to a quarter of a cell.
  bool holds(const Vec3& place, std::int32_t part = 0) const;
  /// How a place at rest hangs on the cell of a part that is nearest to a vertex of it: weights of a place outside the
  /// cell go beyond 0 and 1.
  Embedding hang(const Vec3& place, std::int32_t vertex) const;
  /// Of a place at rest, or of one just outside: the cell of a part on its own side of every cut. -1: none is near.
  std::int32_t cell_for(const Vec3& place, std::int32_t part = 0) const;
  /// @param cut depths at rest. @return false: it would take a piece off, and nothing is done.
  /// @throws InputError as cut_groove().
  bool cut(const SurfaceCut& cut, LatticeChange& change);

 private:
  struct Place : std::array<std::int32_t, 3> {
    std::int32_t part = 0;  ///< places of different parts are never neighbours
    auto operator<=>(const Place&) const = default;
  };
  using Sheet = std::array<Vec3, 3>;  ///< a triangle
  /// The small cubes of a cell of the lattice as it was built; bit i + 4 j + 16 k.
  struct Block {
    std::uint64_t inside = 0;               ///< tissue, or beside it
    std::array<std::uint64_t, 3> broken{};  ///< links to the next one along each axis
    std::vector<std::int32_t> cells;        ///< numbers of the cells that it is now
    std::vector<std::uint64_t> parts;       ///< their cubes
    std::vector<Sheet> sheets;              ///< that have cut it
  };

  const Block* block_at(const Place& place) const;
  void fill_blocks();
  Vec3 cube_centre(const Place& place, int cube) const;
  /// Breaks what the sheets cross of a part. @return numbers of the blocks with newly broken links
  std::vector<std::int32_t> sever(std::span<const Sheet> sheets, std::int32_t part);
  /// Where half of a block's section is broken: the rest.
  void sever_rest(std::int32_t block, std::vector<std::int32_t>& touched);
  void split(std::int32_t block, LatticeChange& change);
  /// What is too little for a cell of its own, severed on one side, no longer holds that side's neighbours either.
  void cut_off(std::int32_t block, std::uint64_t crumb);
  /// Whether two cells hang together across the face from one block to the next along an axis.
  bool linked(const Block& a, std::size_t part_a, const Block& b, std::size_t part_b, std::size_t axis) const;
  void share_nodes(const std::vector<std::int32_t>& touched, LatticeChange& change);
  std::size_t components() const;  ///< that hang together over whole faces
  void embed(std::size_t first_new, const std::vector<std::int32_t>& touched, std::int32_t part);
  Place place_of(const Vec3& at_rest, std::int32_t part) const;
  TriangleSurface surface_of(std::int32_t part) const;

  Lattice lattice_;
  SurfacePtr rest_;
  std::vector<SurfacePtr> before_;  ///< the last few, oldest first
  std::map<Place, std::int32_t> block_of_;
  std::vector<Block> blocks_;
  std::vector<Place> place_;
  std::vector<double> fill_;  ///< of each block
  /// Of each vertex of the surface: from where its side is looked for; the second of those at a cut's end, else as the
  /// first.
  std::vector<std::array<Vec3, 2>> probe_;
  std::size_t pieces_ = 0;
};

/// The bytes in which a recording keeps a cut. @throws InputError when they are none.
std::string cut_bytes(const SurfaceCut& cut);
SurfaceCut parse_cut(std::string_view bytes);

}  // namespace trocar
