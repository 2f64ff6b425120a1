// A lattice of equal cubes over an organ: what the deforming tissue computes on, with the surface embedded in it.
//
// tissue.md 6.3: cells of a given edge, the fill of each from 8 x 8 x 8 samples, a label by vote, dilated until every
// surface vertex lies in a cell; a vertex follows the eight corners of its cell with trilinear weights. RAS axes,
// metres; cell (i, j, k) spans origin + edge * [i, i+1] x [j, j+1] x [k, k+1]. Cells of little fill are floored, not
// merged into neighbours: merging would leave nodes without mass on which surface vertices hang
// (docs/organ_meshing.md). Same input, same bytes. Thread: any, not the tick.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tissue/imaging/labels/label_volume.h"
#include "tissue/mesh/surface/triangle_surface.h"
#include "tissue/progress.h"

namespace trocar {

struct LatticeOptions {
  double cell_m = 0.010;  ///< edge of a cell
  double least_fill =
      0.15;  ///< cells with less are counted as this full (floored), so that none is too soft to compute
  std::optional<Vec3> grid_m = {};  ///< a corner of the grid, which another lattice lies on; none: just round the organ
  Progress progress = {};
};

struct LatticeCell {
  std::array<std::int32_t, 3> place{};    ///< index of the cell
  std::array<std::int32_t, 8> corners{};  ///< nodes; corner bits 1 = +x, 2 = +y, 4 = +z
  double fill = 0;                        ///< share of the cell inside the surface, floored at least_fill
  std::int32_t label = 0;                 ///< of most of its samples; 0 where no label map was given
  std::int32_t part = 0;                  ///< of several organs on one grid: whose; no file keeps it
};

struct Embedding {
  std::int32_t cell = 0;
  std::array<float, 8> weights{};  ///< of the cell's corners, all >= 0, sum 1
  std::int32_t other = -1;         ///< a cell in the same place that bears half of it: at the end of a cut; -1: none
};

struct Lattice {
  Vec3 origin_m = Vec3::Zero();
  double cell_m = 0;
  std::vector<std::array<std::int32_t, 3>> nodes;  ///< index of the grid point; place = origin + cell * index
  std::vector<LatticeCell> cells;                  ///< by k, then j, then i
  std::vector<Embedding> embedding;                ///< one a surface vertex

  Vec3 node_m(std::size_t node) const {
    return origin_m + cell_m * Vec3(nodes[node][0], nodes[node][1], nodes[node][2]);
  }
};

struct LatticeFacts {
  std::size_t cells = 0, nodes = 0;
  std::size_t full_cells = 0;                 ///< fill above 0.999
  std::size_t floored_cells = 0;              ///< had less than least_fill
  std::size_t empty_cells = 0;                ///< of the floored ones: added only because a surface vertex lies there
  std::size_t components = 0;                 ///< over shared faces
  std::array<std::size_t, 10> fill_tenths{};  ///< cells by fill, before flooring: [0, 0.1), ... [0.9, 1]
  double sampled_volume_ml = 0;               ///< sum of the fills before flooring
  double volume_error_pct = 0;                ///< of that against the surface
  double floored_volume_ml = 0;               ///< what flooring added
  double worst_embedding_m = 0;               ///< vertex against the weighted corners
};

struct BuiltLattice {
  Lattice lattice;
  LatticeFacts facts;
};

/// @param surface closed, outward, m
/// @param labels when given, in the same frame: votes for the label of each cell
/// @throws InputError when the cell is too small (more than 500 000 cells) or not positive
BuiltLattice build_lattice(const TriangleSurface& surface, const LatticeOptions& options,
                           const LabelVolume* labels = nullptr);

/// Both on one grid, as parts that share no node: cells, nodes and vertices of `more` behind those of the first.
/// @param more built with a corner of the first's grid. @throws InputError: another edge or another grid
Lattice beside(Lattice first, const Lattice& more);

/// The file's bytes (magic "TROCLAT1", little endian, sha256-stable).
std::string lattice_bytes(const Lattice& lattice);
/// @param file name for messages
/// @throws InputError naming file and place: wrong magic, counts against the length, indices out of range, weights that
/// are not
///         shares
Lattice parse_lattice(const std::string& bytes, const std::string& file);

}  // namespace trocar
