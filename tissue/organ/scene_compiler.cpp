#include "tissue/organ/scene_compiler.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "haptics/input_error.h"
#include "tissue/mesh/complex/complex_remesh.h"
#include "tissue/mesh/complex/complex_volume.h"
#include "tissue/mesh/complex/crossing_guard.h"
#include "tissue/mesh/complex/scene_fields.h"
#include "tissue/mesh/surface/isosurface.h"
#include "tissue/mesh/surface/label_surface.h"
#include "tissue/mesh/surface/measured_facts.h"

namespace trocar {
namespace {

constexpr double kSlopePerVoxel = 0.61;              ///< of the field across a flat face, for the default width
constexpr SmoothingWidths kContactWidths{1.1, 0.6};  ///< of the broad fields that give the common outline near contacts
constexpr std::size_t kLeastSamples = 8;
constexpr std::size_t kMostFieldSamples = 120'000'000;
constexpr double kEvenShare = 0.99;  ///< of a surface's triangles without an angle below 15 degrees: even enough
constexpr int kReach = 2;            ///< voxels: organs no farther apart are meshed together

/// One organ of a group that is meshed together.
struct Member {
  std::size_t request = 0;
  LabelMask mask;
  double target_m3 = 0;
};

std::string called(const SceneRequest& request) {
  return request.name.empty() ? "label " + std::to_string(request.number) : request.name;
}

void check_scene(const LabelMap& map, const std::vector<SceneRequest>& requests) {
  if (requests.empty()) throw InputError("no organ was asked for: name at least one label");
  std::set<std::pair<std::size_t, int>> seen;
  for (const SceneRequest& request : requests) {
    if (request.layer >= map.layers.size())
      throw InputError(called(request) + ": the segmentation has no layer " + std::to_string(request.layer));
    if (request.number < 1) throw InputError(called(request) + ": label numbers start at 1");
    if (!seen.insert({request.layer, request.number}).second)
      throw InputError(called(request) + ": label " + std::to_string(request.number) + " is asked for twice");
  }
}

/// Groups of requests of one layer whose labels lie within kReach voxels of each other.
std::vector<std::vector<std::size_t>> groups_of(const LabelVolume& volume, const std::vector<SceneRequest>& requests,
                                                std::size_t layer) {
  std::map<int, std::size_t> by_number;
  std::vector<std::size_t> root(requests.size());
  for (std::size_t n = 0; n < requests.size(); ++n) {
    root[n] = n;
    if (requests[n].layer == layer) by_number[requests[n].number] = n;
  }
  std::size_t voxel = 0;
  for (int k = 0; k < volume.size[2]; ++k)
    for (int j = 0; j < volume.size[1]; ++j)
      for (int i = 0; i < volume.size[0]; ++i, ++voxel) {
        const auto here = volume.labels[voxel] == 0 ? by_number.end() : by_number.find(volume.labels[voxel]);
        if (here == by_number.end()) continue;
        for (int c = 0; c <= kReach && k + c < volume.size[2]; ++c)
          for (int b = c > 0 ? -kReach : 0; b <= kReach; ++b)
            for (int a = b > 0 || c > 0 ? -kReach : 1; a <= kReach; ++a) {
              if (i + a < 0 || j + b < 0 || i + a >= volume.size[0] || j + b >= volume.size[1]) continue;
              const auto label = volume.labels[volume.offset(i + a, j + b, k + c)];
              if (label == 0 || label == volume.labels[voxel]) continue;
              const auto there = by_number.find(label);
              if (there == by_number.end()) continue;
              const std::size_t x = root[here->second], y = root[there->second];
              if (x != y) std::replace(root.begin(), root.end(), std::max(x, y), std::min(x, y));
            }
      }
  std::map<std::size_t, std::vector<std::size_t>> members;
  for (std::size_t n = 0; n < requests.size(); ++n)
    if (requests[n].layer == layer) members[root[n]].push_back(n);
  std::vector<std::vector<std::size_t>> groups;
  for (auto& [first, group] : members) groups.push_back(std::move(group));
  return groups;
}

/// A filled cavity that holds another organ of the group is that organ's, and was not filled so far.
void give_back(Member& member, const LabelVolume& volume, const std::set<int>& numbers, int own) {
  std::size_t voxel = 0;
  std::map<int, std::size_t> given;
  for (int k = 0; k < member.mask.size[2]; ++k)
    for (int j = 0; j < member.mask.size[1]; ++j)
      for (int i = 0; i < member.mask.size[0]; ++i, ++voxel) {
        if (member.mask.inside[voxel] == 0) continue;
        const int x = i + member.mask.first[0], y = j + member.mask.first[1], z = k + member.mask.first[2];
        const int label = volume.labels[volume.offset(x, y, z)];
        if (label == own || !numbers.contains(label)) continue;
        member.mask.inside[voxel] = 0;
        --member.mask.kept_voxels;
        ++given[label];
      }
  std::vector<std::size_t>& cavities = member.mask.cavities;  // largest first
  for (const auto& [label, voxels] : given) {
    const auto holding = std::find_if(cavities.rbegin(), cavities.rend(), [&](std::size_t n) { return n >= voxels; });
    if (holding != cavities.rend()) *holding -= voxels;
  }
  std::sort(cavities.rbegin(), cavities.rend());
  cavities.erase(std::find(cavities.begin(), cavities.end(), 0U), cavities.end());
}

double area_m2(const TriangleSurface& surface, std::size_t t) {
  const auto at = [&](std::size_t n) -> const Vec3& {
    return surface.vertices[static_cast<std::size_t>(surface.triangles[t][n])];
  };
  return (at(1) - at(0)).cross(at(2) - at(0)).norm() / 2;
}

/// What organs of a complex have in common. @param sources triangle of the complex of each triangle of region 1, 2, ...
/// @param organs number in the scene of region 1, 2, ...
void add_shared(const LabelComplex& complex, const std::vector<std::vector<std::int32_t>>& sources,
                const std::vector<std::size_t>& organs, CompiledScene& scene) {
  std::vector<std::array<std::int32_t, 2>> number(complex.triangles.size(), {-1, -1});  // in the first and second organ
  for (std::size_t n = 0; n < sources.size(); ++n)
    for (std::size_t t = 0; t < sources[n].size(); ++t) {
      const auto from = static_cast<std::size_t>(sources[n][t]);
      number[from][complex.regions[from][0] == static_cast<std::int16_t>(n + 1) ? 0 : 1] = static_cast<std::int32_t>(t);
    }
  std::map<std::array<std::size_t, 2>, SharedInterface> found;
  for (std::size_t t = 0; t < complex.triangles.size(); ++t) {
    if (complex.regions[t][0] == 0) continue;
    std::array<std::size_t, 2> pair{organs[static_cast<std::size_t>(complex.regions[t][0] - 1)],
                                    organs[static_cast<std::size_t>(complex.regions[t][1] - 1)]};
    auto numbers = number[t];
    if (pair[0] > pair[1]) std::swap(pair[0], pair[1]), std::swap(numbers[0], numbers[1]);
    SharedInterface& shared = found[pair];
    shared.first = pair[0], shared.second = pair[1];
    shared.area_m2 += area_m2(scene.organs[pair[0]].surface, static_cast<std::size_t>(numbers[0]));
    shared.triangles.push_back(numbers);
  }
  for (auto& [pair, shared] : found) scene.shared.push_back(std::move(shared));
}

class GroupCompiler {
 public:
  GroupCompiler(const LabelVolume& volume, const std::vector<SceneRequest>& requests,
                const std::vector<std::size_t>& group, const SceneOptions& options)
      : volume_(volume), requests_(requests), options_(options) {
    std::set<int> numbers;
    for (const std::size_t n : group) numbers.insert(requests[n].number);
    for (const std::size_t n : group) {
      Member& member = members_.emplace_back();
      member.request = n;
      member.mask = cut_out_label(volume, requests[n].number, kSmoothingMargin, options.parts);
      give_back(member, volume, numbers, requests[n].number);
      member.target_m3 = static_cast<double>(member.mask.kept_voxels) * volume.voxel_volume_ml() * 1e-6;
    }
    place_grid();
  }

  void compile(CompiledScene& scene) {
    LabelComplex dense = dense_complex();
    const LabelComplex result = coarse_complex(dense);
    add_organs(result, scene);
    std::vector<std::size_t> organs;
    for (const Member& m : members_) organs.push_back(m.request);
    add_shared(result, sources_, organs, scene);
    add_attachments(result, scene);
  }

 private:
  /// The union of the boxes, no more than one sample beyond the image.
  void place_grid() {
    std::array<int, 3> high{};
    std::size_t samples = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low_[axis] = volume_.size[axis], high[axis] = -1;
      for (const Member& m : members_) {
        low_[axis] = std::min(low_[axis], m.mask.first[axis]);
        high[axis] = std::max(high[axis], m.mask.first[axis] + m.mask.size[axis] - 1);
      }
      low_[axis] = std::max(low_[axis], -1), high[axis] = std::min(high[axis], volume_.size[axis]);
      size_[axis] = high[axis] - low_[axis] + 1;
    }
    for (const Member& m : members_) samples += m.mask.inside.size();
    if (samples > kMostFieldSamples)
      throw InputError("the organs of one scene span " + std::to_string(samples) + " voxels, more than " +
                       std::to_string(kMostFieldSamples) + ": ask for fewer at once");
    spacing_m_ = volume_.index_to_ras_mm.linear().colwise().norm().transpose() * 1e-3;
    to_ras_.linear() = volume_.index_to_ras_mm.linear() * 1e-3 * spacing_m_.cwiseInverse().asDiagonal();
    to_ras_.translation() = volume_.index_to_ras_mm * Vec3(low_[0], low_[1], low_[2]) * 1e-3;
  }

  void map_to_ras(LabelComplex& complex) const {
    for (Vec3& vertex : complex.vertices) vertex = to_ras_ * vertex;
    if (to_ras_.linear().determinant() < 0)
      for (auto& triangle : complex.triangles) std::swap(triangle[1], triangle[2]);
  }

  /// Offsets of the fields are found by a few Newton steps on the enclosed volumes.
  LabelComplex dense_complex() {
    std::vector<RegionField> fields;
    for (const Member& m : members_) {
      report(options_.progress, "smoothing together",
             static_cast<double>(fields.size()) / static_cast<double>(members_.size()));
      RegionField& f = fields.emplace_back();
      for (std::size_t axis = 0; axis < 3; ++axis) f.first[axis] = m.mask.first[axis] - low_[axis];
      f.field = smooth_field(m.mask, {});
      f.offset = 0.03F;
    }
    std::vector<ScalarField> broad;
    for (const Member& m : members_) broad.push_back(smooth_field(m.mask, kContactWidths));
    close_slits(fields, broad, size_);
    LabelComplex complex;
    constexpr int kRounds = 5;
    for (int round = 0; round < kRounds; ++round) {
      report(options_.progress, "finding the interfaces", static_cast<double>(round) / kRounds);
      complex = label_complex(fields, size_, spacing_m_, kLeastSamples);
      map_to_ras(complex);
      for (Vec3& vertex : complex.vertices) vertex = as_float(vertex);
      for (std::size_t n = 0; n < members_.size(); ++n) {
        const TriangleSurface border = complex.border(static_cast<int>(n + 1));
        if (border.triangles.empty())
          throw InputError(called(requests_[members_[n].request]) + " is too thin to give a surface");
        const double missing_voxels =
            (members_[n].target_m3 - border.volume_m3()) / surface_area_m2(border) / spacing_m_.mean();
        fields[n].offset =
            std::clamp(fields[n].offset + static_cast<float>(1.6 * kSlopePerVoxel * missing_voxels), -0.5F, 0.9F);
      }
    }
    return complex;
  }

  /// Nothing crosses in the dense complex, and no step is made after which something would.
  LabelComplex coarse_complex(const LabelComplex& dense) const {
    ComplexRemeshOptions remesh;
    for (const Member& m : members_) remesh.triangles.push_back(requests_[m.request].triangles);
    remesh.smoothing_m = 2 * spacing_m_.maxCoeff(), remesh.progress = options_.progress;
    LabelComplex result = remeshed(dense, remesh);
    LabelComplex full = result;
    correct_volumes(full);
    move_without_crossing(result, full.vertices);
    return result;
  }

  /// Moves the free faces of each organ along their normals; what two organs share stays.
  void correct_volumes(LabelComplex& complex) const {
    std::vector<CapPlane> planes;
    for (const Member& m : members_)
      for (const CapPlane& plane : cap_planes(m.mask, box_to_ras_m(volume_, m.mask)))
        if (std::none_of(planes.begin(), planes.end(),
                         [&](const CapPlane& p) { return (p.normal - plane.normal).norm() < 1e-9; }))
          planes.push_back(plane);
    std::vector<double> targets;
    for (const Member& m : members_) targets.push_back(m.target_m3);
    trocar::correct_volumes(complex, targets, 0.1 * spacing_m_.minCoeff(), CapKeeper(planes, complex.vertices));
  }

  void add_organs(const LabelComplex& complex, CompiledScene& scene) {
    for (std::size_t n = 0; n < members_.size(); ++n) {
      report(options_.progress, "measuring", static_cast<double>(n) / static_cast<double>(members_.size()));
      const Member& m = members_[n];
      CompiledOrgan& organ = scene.organs[m.request];
      std::vector<std::int32_t>& source = sources_.emplace_back();
      organ.surface = complex.border(static_cast<int>(n + 1), &source);
      organ.facts.repairs = volume_.notes;
      note_mask(m.mask, volume_.voxel_volume_ml(), organ.facts);
      organ.facts.voxel_m = std::cbrt(volume_.voxel_volume_ml() * 1e-6);
      organ.facts.repairs.push_back("smoothed and remeshed together with its neighbours to " +
                                    std::to_string(organ.surface.triangles.size()) +
                                    " triangles, its free faces moved to keep the volume");
      TriangleSurface sharp = isosurface(sharp_field(m.mask), Vec3::Ones(), 0.5);
      map_vertices(sharp, box_to_ras_m(volume_, m.mask));
      organ.facts.self_intersections = count_self_intersections(organ.surface);
      measure(organ.surface, m.target_m3, sharp, volume_centroid_m(sharp), organ.facts);
    }
  }

  void add_attachments(const LabelComplex& complex, CompiledScene& scene) const {
    for (std::size_t n = 0; n < members_.size(); ++n) {
      std::vector<bool> free(sources_[n].size(), false);
      for (std::size_t t = 0; t < free.size(); ++t)
        free[t] = complex.regions[static_cast<std::size_t>(sources_[n][t])][0] == 0;
      attach(volume_, requests_, members_[n].request, free, scene);
    }
  }

 public:
  /// Looks one voxel out of every free triangle for a label that was not asked for.
  static void attach(const LabelVolume& volume, const std::vector<SceneRequest>& requests, std::size_t organ,
                     const std::vector<bool>& free, CompiledScene& scene) {
    const TriangleSurface& surface = scene.organs[organ].surface;
    const Eigen::Affine3d to_index = volume.index_to_ras_mm.inverse();
    const double reach_mm = volume.index_to_ras_mm.linear().colwise().norm().mean();
    std::set<int> asked;
    for (const SceneRequest& r : requests)
      if (r.layer == requests[organ].layer) asked.insert(r.number);
    std::map<int, Attachment> found;
    for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
      if (!free[t]) continue;
      const auto at = [&](std::size_t n) -> const Vec3& {
        return surface.vertices[static_cast<std::size_t>(surface.triangles[t][n])];
      };
      const Vec3 middle = (at(0) + at(1) + at(2)) / 3, normal = (at(1) - at(0)).cross(at(2) - at(0)).normalized();
      const Vec3 index = to_index * Vec3(middle * 1e3 + normal * reach_mm);
      const Eigen::Vector3i voxel = index.array().round().cast<int>();
      if ((voxel.array() < 0).any() || voxel[0] >= volume.size[0] || voxel[1] >= volume.size[1] ||
          voxel[2] >= volume.size[2])
        continue;
      const int label = volume.labels[volume.offset(voxel[0], voxel[1], voxel[2])];
      if (label == 0 || asked.contains(label)) continue;
      Attachment& attachment = found[label];
      attachment.organ = organ, attachment.layer = requests[organ].layer, attachment.number = label;
      attachment.area_m2 += area_m2(surface, t);
      attachment.triangles.push_back(static_cast<std::int32_t>(t));
    }
    for (auto& [label, attachment] : found) scene.attachments.push_back(std::move(attachment));
  }

 private:
  const LabelVolume& volume_;
  const std::vector<SceneRequest>& requests_;
  const SceneOptions& options_;
  std::vector<Member> members_;
  std::vector<std::vector<std::int32_t>> sources_;  ///< triangle of the complex of each organ's triangle
  std::array<int, 3> low_{}, size_{};
  Vec3 spacing_m_ = Vec3::Ones();
  Eigen::Affine3d to_ras_ = Eigen::Affine3d::Identity();
};

void compile_alone(const LabelVolume& volume, const std::vector<SceneRequest>& requests, std::size_t n,
                   const SceneOptions& options, CompiledScene& scene) {
  scene.organs[n] = compile_label(volume, requests[n].number, {requests[n].triangles, options.parts, options.progress});
  GroupCompiler::attach(volume, requests, n, std::vector<bool>(scene.organs[n].surface.triangles.size(), true), scene);
}

/// Closed surfaces of one scene, and which of them have triangles in common: the same places to the bit, wound the
/// other way round.
class SurfaceGroups {
 public:
  explicit SurfaceGroups(const std::vector<TriangleSurface>& surfaces) : surfaces_(surfaces) {
    number_places();
    find_common();
  }

  const std::vector<std::vector<std::size_t>>& groups() const { return groups_; }

  /// The surfaces of a group as regions 1, 2, ...
  LabelComplex complex(const std::vector<std::size_t>& group) const {
    LabelComplex result;
    std::map<std::int32_t, std::int32_t> numbers;
    std::map<std::size_t, std::int16_t> region;
    for (const std::size_t s : group) region.emplace(s, static_cast<std::int16_t>(region.size() + 1));
    for (const std::size_t s : group)
      for (std::size_t t = 0; t < surfaces_[s].triangles.size(); ++t) {
        const auto other = beyond_.find({s, t});
        if (other != beyond_.end() && other->second < s) continue;
        std::array<std::int32_t, 3> triangle;
        for (std::size_t n = 0; n < 3; ++n) {
          const auto vertex = static_cast<std::size_t>(surfaces_[s].triangles[t][n]);
          const auto [at, fresh] =
              numbers.emplace(place_[s][vertex], static_cast<std::int32_t>(result.vertices.size()));
          if (fresh) result.vertices.push_back(surfaces_[s].vertices[vertex]);
          triangle[n] = at->second;
        }
        const bool free = other == beyond_.end();
        if (free) std::swap(triangle[1], triangle[2]);
        result.triangles.push_back(triangle);
        result.regions.push_back(free ? std::array<std::int16_t, 2>{0, region.at(s)}
                                      : std::array<std::int16_t, 2>{region.at(s), region.at(other->second)});
      }
    return result;
  }

 private:
  /// Equal places of all surfaces get one number, from 0. A surface that comes back to a place shares nothing.
  void number_places() {
    std::vector<std::pair<std::size_t, std::size_t>> order;
    for (std::size_t s = 0; s < surfaces_.size(); ++s) {
      place_.emplace_back(surfaces_[s].vertices.size());
      for (std::size_t v = 0; v < place_[s].size(); ++v) order.emplace_back(s, v);
    }
    const auto at = [&](const auto& one) -> const Vec3& { return surfaces_[one.first].vertices[one.second]; };
    std::sort(order.begin(), order.end(), [&](const auto& a, const auto& b) {
      const Vec3 &p = at(a), &q = at(b);
      return std::tuple(p.x(), p.y(), p.z(), a) < std::tuple(q.x(), q.y(), q.z(), b);
    });
    alone_.assign(surfaces_.size(), false);
    for (std::size_t n = 0; n < order.size(); ++n) {
      const bool same = n > 0 && at(order[n]) == at(order[n - 1]);
      if (same && order[n].first == order[n - 1].first) alone_[order[n].first] = true;
      if (same) met_.back() = true;
      if (!same) met_.push_back(false);
      place_[order[n].first][order[n].second] = static_cast<std::int32_t>(met_.size()) - 1;
    }
  }

  /// A triangle has one other side: of an organ that is there twice, the second shares nothing.
  void find_common() {
    using Side = std::pair<std::size_t, std::size_t>;  // surface, triangle
    std::map<std::array<std::int32_t, 3>, Side> seen;
    std::vector<std::size_t> root(surfaces_.size());
    for (std::size_t s = 0; s < surfaces_.size(); ++s) {
      root[s] = s;
      for (std::size_t t = 0; t < surfaces_[s].triangles.size() && !alone_[s]; ++t) {
        std::array<std::int32_t, 3> places;
        for (std::size_t n = 0; n < 3; ++n)
          places[n] = place_[s][static_cast<std::size_t>(surfaces_[s].triangles[t][n])];
        if (!std::all_of(places.begin(), places.end(),
                         [&](std::int32_t p) { return met_[static_cast<std::size_t>(p)]; }))
          continue;
        std::rotate(places.begin(), std::min_element(places.begin(), places.end()), places.end());
        seen.emplace(places, Side(s, t));
        const auto other = seen.find({places[0], places[2], places[1]});
        if (other == seen.end() || other->second.first == s || beyond_.contains(other->second)) continue;
        beyond_[{s, t}] = other->second.first;
        beyond_[other->second] = s;
        std::replace(root.begin(), root.end(), std::max(root[s], root[other->second.first]),
                     std::min(root[s], root[other->second.first]));
      }
    }
    std::map<std::size_t, std::vector<std::size_t>> members;
    for (std::size_t s = 0; s < surfaces_.size(); ++s) members[root[s]].push_back(s);
    for (auto& [first, group] : members) groups_.push_back(std::move(group));
  }

  const std::vector<TriangleSurface>& surfaces_;
  std::vector<std::vector<std::int32_t>> place_;  ///< of each vertex of each surface
  std::vector<bool> alone_;
  std::vector<bool> met_;                                              ///< places at which several surfaces are
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> beyond_;  ///< surface on the other side of a triangle
  std::vector<std::vector<std::size_t>> groups_;
};

/// Whether a surface is already as remeshing would leave it.
bool even_and_coarse(const TriangleSurface& surface, int triangles) {
  return surface.triangles.size() <= static_cast<std::size_t>(triangles) &&
         mesh_quality(surface).share_above_15 >= kEvenShare;
}

void compile_together(const std::vector<TriangleSurface>& surfaces, const SurfaceGroups& groups,
                      const std::vector<std::size_t>& group, const CompileOptions& options, CompiledScene& scene) {
  LabelComplex complex = groups.complex(group);
  const bool kept = std::all_of(group.begin(), group.end(),
                                [&](std::size_t s) { return even_and_coarse(surfaces[s], options.triangles); });
  if (!kept) {
    ComplexRemeshOptions remesh;
    std::vector<double> volumes_m3;
    double area = 0;
    for (const std::size_t s : group) {
      remesh.triangles.push_back(std::min(options.triangles, static_cast<int>(surfaces[s].triangles.size())));
      volumes_m3.push_back(surfaces[s].volume_m3());
      area += surface_area_m2(surfaces[s]);
    }
    const double edge_m = std::sqrt(area / static_cast<double>(complex.triangles.size()));
    remesh.smoothing_m = edge_m, remesh.progress = options.progress;
    complex = remeshed(complex, remesh);
    LabelComplex full = complex;
    trocar::correct_volumes(full, volumes_m3, 0.1 * edge_m, CapKeeper({}, full.vertices));
    move_without_crossing(complex, full.vertices);
  }
  std::vector<std::vector<std::int32_t>> sources;
  for (std::size_t n = 0; n < group.size(); ++n) {
    report(options.progress, "measuring", static_cast<double>(n) / static_cast<double>(group.size()));
    const TriangleSurface& source = surfaces[group[n]];
    CompiledOrgan& organ = scene.organs[group[n]];
    organ.surface = complex.border(static_cast<int>(n + 1), &sources.emplace_back());
    organ.facts.repairs.push_back(kept ? "kept as it came: even already, and it shares triangles with its neighbours"
                                       : "remeshed together with the neighbours that it shares triangles with, to " +
                                             std::to_string(organ.surface.triangles.size()));
    organ.facts.self_intersections = count_self_intersections(organ.surface);
    measure(organ.surface, source.volume_m3(), source, volume_centroid_m(source), organ.facts);
  }
  add_shared(complex, sources, group, scene);
}

}  // namespace

CompiledScene compile_surfaces(const std::vector<TriangleSurface>& surfaces, const CompileOptions& options) {
  CompiledScene scene;
  scene.organs.resize(surfaces.size());
  const SurfaceGroups groups(surfaces);
  for (const auto& group : groups.groups()) {
    if (group.size() == 1) scene.organs[group[0]] = compile_surface(surfaces[group[0]], options);
    if (group.size() > 1) compile_together(surfaces, groups, group, options, scene);
  }
  return scene;
}

CompiledScene compile_scene(const LabelMap& map, const std::vector<SceneRequest>& requests,
                            const SceneOptions& options) {
  check_scene(map, requests);
  CompiledScene scene;
  scene.organs.resize(requests.size());
  scene.notes = map.notes;
  std::size_t layers = 0;
  for (std::size_t layer = 0; layer < map.layers.size(); ++layer) {
    const auto groups = groups_of(map.layers[layer], requests, layer);
    layers += groups.empty() ? 0 : 1;
    for (const auto& group : groups) {
      if (group.size() == 1) compile_alone(map.layers[layer], requests, group[0], options, scene);
      if (group.size() > 1) GroupCompiler(map.layers[layer], requests, group, options).compile(scene);
    }
  }
  if (layers > 1) scene.notes.push_back("organs of different layers may overlap: they share no faces");
  std::stable_sort(scene.attachments.begin(), scene.attachments.end(), [](const Attachment& a, const Attachment& b) {
    return std::pair(a.organ, a.number) < std::pair(b.organ, b.number);
  });
  return scene;
}

}  // namespace trocar
