// What a change of topology did to a surface: vertices and triangles that were there keep their numbers, new ones
// follow. What lives at vertices (blood, heat) carries its values over by it.
#pragma once

#include <cstdint>
#include <vector>

namespace trocar {

/// A new vertex lies, at rest, on the way from one older vertex to another.
struct VertexOrigin {
  std::int32_t from = 0, to = 0;  ///< may themselves be new ones that stand before it
  double share = 0;               ///< 0 at `from` .. 1 at `to`

  bool operator==(const VertexOrigin&) const = default;
};

/// Values at the vertices of a surface, carried over to its new ones.
template <typename Value>
void grow_values(std::vector<Value>& values, const std::vector<VertexOrigin>& added) {
  values.reserve(values.size() + added.size());
  for (const VertexOrigin& origin : added) {
    const Value& from = values[static_cast<std::size_t>(origin.from)];
    const Value& to = values[static_cast<std::size_t>(origin.to)];
    values.push_back(static_cast<Value>(from + static_cast<Value>(origin.share) * (to - from)));
  }
}

}  // namespace trocar
