// The fine surface of an organ as it follows the nodes of its lattice: x_v = sum of w_vc x_c over the eight corners of
// the vertex's cell (lattice.h), whatever has moved the nodes.
//
// The nodes decide the frame: in T at run time, m. At rest the surface is the one that was embedded up to the rounding
// of the weights (LatticeFacts::worst_embedding_m). Thread: any, immutable.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "tissue/solid/lattice.h"
#include "tissue/surface_snapshot.h"
#include "tissue/tissue_shape.h"

namespace trocar {

class EmbeddedSurface {
 public:
  /// @param rest the surface that the lattice was built over: that at rest of every snapshot.
  /// @throws InputError when the lattice embeds another number of vertices.
  EmbeddedSurface(const Lattice& lattice, SurfacePtr rest);

  /// @param nodes as many as the lattice has. @param fields at nodes or vertices; those of nodes are spread by the
  /// weights. @throws InputError when a number of nodes or values is another.
  SurfacePtr at(std::span<const NodePlace> nodes, std::span<const ShapeField> fields = {}) const;

  const SurfacePtr& rest() const { return rest_; }
  std::uint64_t topology() const { return rest_->topology; }
  std::size_t nodes() const { return nodes_; }

 private:
  struct Vertex {
    std::array<std::int32_t, 8> corner{};
    std::array<float, 8> weight{};
  };
  SurfaceField spread(const ShapeField& field) const;

  std::vector<Vertex> vertices_;
  /// Vertices that a second cell bears by half, and its corners.
  std::vector<std::pair<std::int32_t, std::array<std::int32_t, 8>>> halved_;
  SurfacePtr rest_;
  std::size_t nodes_;
};

}  // namespace trocar
