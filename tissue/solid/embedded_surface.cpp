#include "tissue/solid/embedded_surface.h"

#include <utility>

#include "haptics/input_error.h"

namespace trocar {

EmbeddedSurface::EmbeddedSurface(const Lattice& lattice, SurfacePtr rest)
    : rest_(std::move(rest)), nodes_(lattice.nodes.size()) {
  if (lattice.embedding.size() != rest_->vertices.size()) {
    throw InputError("a lattice that embeds " + std::to_string(lattice.embedding.size()) +
                     " vertices is not that of a surface of " + std::to_string(rest_->vertices.size()));
  }
  vertices_.reserve(lattice.embedding.size());
  for (const Embedding& e : lattice.embedding) {
    vertices_.push_back({lattice.cells[static_cast<std::size_t>(e.cell)].corners, e.weights});
    if (e.other < 0) continue;
    halved_.push_back(
        {static_cast<std::int32_t>(vertices_.size()) - 1, lattice.cells[static_cast<std::size_t>(e.other)].corners});
  }
}

SurfacePtr EmbeddedSurface::at(std::span<const NodePlace> nodes, std::span<const ShapeField> fields) const {
  if (nodes.size() != nodes_) {
    throw InputError(std::to_string(nodes.size()) + " nodes are not those of a lattice of " + std::to_string(nodes_));
  }
  std::vector<Vec3> vertices;
  vertices.reserve(vertices_.size());
  for (const Vertex& vertex : vertices_) {
    Vec3 place = Vec3::Zero();
    for (std::size_t c = 0; c < 8; ++c)
      place += double{vertex.weight[c]} * nodes[static_cast<std::size_t>(vertex.corner[c])].cast<double>();
    vertices.push_back(place);
  }
  for (const auto& [v, corner] : halved_) {
    Vec3 place = Vec3::Zero();
    for (std::size_t c = 0; c < 8; ++c)
      place += double{vertices_[static_cast<std::size_t>(v)].weight[c]} *
               nodes[static_cast<std::size_t>(corner[c])].cast<double>();
    vertices[static_cast<std::size_t>(v)] = (vertices[static_cast<std::size_t>(v)] + place) / 2;
  }
  std::vector<SurfaceField> spread_fields;
  for (const ShapeField& field : fields) spread_fields.push_back(spread(field));
  return moved_surface(rest_, std::move(vertices), std::move(spread_fields));
}

SurfaceField EmbeddedSurface::spread(const ShapeField& field) const {
  const bool at_nodes = field.place == FieldPlace::kNodes;
  if (field.value.size() != (at_nodes ? nodes_ : vertices_.size()))
    throw InputError("the field '" + field.name + "' has " + std::to_string(field.value.size()) + " values");
  if (!at_nodes) return {field.name, field.value};
  SurfaceField out{field.name, std::vector<float>(vertices_.size())};
  for (std::size_t v = 0; v < vertices_.size(); ++v)
    for (std::size_t c = 0; c < 8; ++c)
      out.value[v] += vertices_[v].weight[c] * field.value[static_cast<std::size_t>(vertices_[v].corner[c])];
  return out;
}

}  // namespace trocar
