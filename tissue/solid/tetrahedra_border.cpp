#include "tissue/solid/tetrahedra_border.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace trocar {
namespace {

constexpr int kSteps = 4, kTrials = 4;
constexpr double kSqueezed = 0.3;

std::size_t slot_of(std::int32_t node) { return static_cast<std::size_t>(node); }

double volume_of(const TetrahedraMesh& mesh, std::size_t tetrahedron) {
  const auto& t = mesh.tetrahedra[tetrahedron];
  const Vec3& a = mesh.nodes[slot_of(t[0])];
  return (mesh.nodes[slot_of(t[1])] - a).cross(mesh.nodes[slot_of(t[2])] - a).dot(mesh.nodes[slot_of(t[3])] - a) / 6;
}

/// Twice the area long, out of the face's inner region.
Vec3 normal_of(const TetrahedraMesh& mesh, const BorderFace& face) {
  const Vec3& a = mesh.nodes[slot_of(face.nodes[0])];
  return (mesh.nodes[slot_of(face.nodes[1])] - a).cross(mesh.nodes[slot_of(face.nodes[2])] - a);
}

/// A region with the nodes that move with it, and what they drag along.
struct Mover {
  std::int32_t label = 0;
  std::vector<BorderFace> faces;          ///< with one of its nodes, nodes outward of this region
  std::vector<std::int32_t> nodes;        ///< border nodes of which this is the smallest region
  std::vector<std::size_t> tetrahedra{};  ///< of this region; of any region with one of the nodes
  std::vector<std::size_t> touched{};
};

class VolumeCorrection {
 public:
  VolumeCorrection(TetrahedraMesh& mesh, const std::vector<BorderFace>& border, const std::vector<double>& targets)
      : mesh_(mesh), targets_(targets), owner_(mesh.nodes.size(), 0), kept_(mesh.nodes.size(), false) {
    std::vector<std::int32_t> order(targets.size());
    std::iota(order.begin(), order.end(), 1);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::int32_t a, std::int32_t b) { return targets[slot_of(a - 1)] < targets[slot_of(b - 1)]; });
    for (const std::int32_t label : order) movers_.push_back({label, {}, {}});
    for (Mover& mover : movers_) claim(mover, border);
    for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) start_.push_back(volume_of(mesh, t));
    for (Mover& mover : movers_) list_tetrahedra(mover);
  }

  void step(const std::vector<double>& reach) {
    for (const Mover& mover : movers_) move(mover, reach[slot_of(mover.label - 1)]);
  }

 private:
  void claim(Mover& mover, const std::vector<BorderFace>& border) {
    for (BorderFace face : border) {
      if (face.inner != mover.label && face.outer != mover.label) continue;
      for (const std::int32_t node : face.nodes)
        if (owner_[slot_of(node)] == 0) owner_[slot_of(node)] = mover.label, mover.nodes.push_back(node);
      if (face.inner != mover.label) std::swap(face.nodes[1], face.nodes[2]);
      mover.faces.push_back(face);
    }
  }

  void list_tetrahedra(Mover& mover) const {
    for (std::size_t t = 0; t < mesh_.tetrahedra.size(); ++t) {
      if (mesh_.labels[t] == mover.label) mover.tetrahedra.push_back(t);
      const auto& nodes = mesh_.tetrahedra[t];
      if (std::any_of(nodes.begin(), nodes.end(), [&](auto node) { return owner_[slot_of(node)] == mover.label; }))
        mover.touched.push_back(t);
    }
  }

  /// Of each node that moves with the region and is not kept, its unit normal out of it; else 0.
  std::vector<Vec3> ways(const Mover& mover) const {
    std::vector<Vec3> normals(mesh_.nodes.size(), Vec3::Zero());
    for (const BorderFace& face : mover.faces)
      for (const std::int32_t node : face.nodes)
        if (owner_[slot_of(node)] == mover.label && !kept_[slot_of(node)])
          normals[slot_of(node)] += normal_of(mesh_, face);
    for (const std::int32_t node : mover.nodes)
      if (normals[slot_of(node)] != Vec3::Zero()) normals[slot_of(node)].normalize();
    return normals;
  }

  /// Keeps the nodes of squeezed tetrahedra where they are, from now on. @return whether there were any
  bool keep_squeezed(const Mover& mover) {
    bool squeezed = false;
    for (const std::size_t t : mover.touched) {
      if (volume_of(mesh_, t) >= kSqueezed * start_[t]) continue;
      squeezed = true;
      for (const std::int32_t node : mesh_.tetrahedra[t]) kept_[slot_of(node)] = true;
    }
    return squeezed;
  }

  void move(const Mover& mover, double reach) {
    double missing = targets_[slot_of(mover.label - 1)];
    for (const std::size_t t : mover.tetrahedra) missing -= volume_of(mesh_, t);
    for (int trial = 0; trial < kTrials; ++trial) {
      const std::vector<Vec3> normals = ways(mover);
      double growth = 0;  // of the volume by a shift of one
      for (const BorderFace& face : mover.faces)
        for (const std::int32_t node : face.nodes) growth += normals[slot_of(node)].dot(normal_of(mesh_, face)) / 6;
      if (growth <= 0) return;
      const double shift = std::clamp(missing / growth, -reach, reach);
      for (const std::int32_t node : mover.nodes) mesh_.nodes[slot_of(node)] += shift * normals[slot_of(node)];
      if (!keep_squeezed(mover)) return;
      for (const std::int32_t node : mover.nodes) mesh_.nodes[slot_of(node)] -= shift * normals[slot_of(node)];
    }
  }

  TetrahedraMesh& mesh_;
  const std::vector<double>& targets_;
  std::vector<std::int32_t> owner_;  ///< label that a node moves with; 0: inside a region
  std::vector<bool> kept_;           ///< would squeeze a tetrahedron
  std::vector<double> start_;        ///< volume of each tetrahedron
  std::vector<Mover> movers_;        ///< smallest region first
};

}  // namespace

std::vector<BorderFace> border_faces(const TetrahedraMesh& mesh) {
  constexpr std::array<std::array<std::size_t, 3>, 4> kFaces{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
  struct Face {
    std::array<std::int32_t, 3> key, nodes;
    std::int32_t label;
    bool operator<(const Face& other) const { return std::tie(key, label) < std::tie(other.key, other.label); }
  };
  std::vector<Face> faces;
  faces.reserve(4 * mesh.tetrahedra.size());
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
    for (const auto& f : kFaces) {
      const auto& corners = mesh.tetrahedra[t];
      const std::array<std::int32_t, 3> nodes{corners[f[0]], corners[f[1]], corners[f[2]]};
      faces.push_back({nodes, nodes, mesh.labels[t]});
      std::sort(faces.back().key.begin(), faces.back().key.end());
    }
  std::sort(faces.begin(), faces.end());
  std::vector<BorderFace> border;
  for (std::size_t n = 0; n < faces.size(); ++n) {
    const bool pair = n + 1 < faces.size() && faces[n].key == faces[n + 1].key;
    if (!pair)
      border.push_back({faces[n].nodes, faces[n].label, 0});
    else if (faces[n].label != faces[n + 1].label)
      border.push_back({faces[n].nodes, faces[n].label, faces[n + 1].label});
    n += pair ? 1 : 0;
  }
  return border;
}

std::vector<double> region_volumes(const TetrahedraMesh& mesh, std::size_t regions) {
  std::vector<double> volumes(regions, 0);
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) volumes[slot_of(mesh.labels[t] - 1)] += volume_of(mesh, t);
  return volumes;
}

void correct_volumes(TetrahedraMesh& mesh, const std::vector<BorderFace>& border, const std::vector<double>& targets,
                     const std::vector<double>& reach) {
  VolumeCorrection correction(mesh, border, targets);
  for (int step = 0; step < kSteps; ++step) correction.step(reach);
}

}  // namespace trocar
