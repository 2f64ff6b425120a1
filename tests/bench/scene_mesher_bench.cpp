// What a scene's common surfaces cost, and how good they are: the guarded complex (compile_scene) beside the facets of
// CGAL's Mesh_3 over the same labels (docs/decisions/0032). The phantom's upper abdomen, voxels of 2.5 mm.
//
// Mesh_3 is asked for facets alone (no bound on the tetrahedra's size), on the largest of the organs' smooth fields,
// the same that the complex starts from. Counters: triangles; mean distance in mm to the label's unsmoothed border and
// back, smallest and 1 % quantile of the angles in degrees, each the mean over the organs; largest error of volume in
// per cent.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <map>

#include "tissue/imaging/labels/label_mask.h"
#include "tissue/imaging/labels/smooth_field.h"
#include "tissue/imaging/phantom/phantom.h"
#include "tissue/mesh/surface/isosurface.h"
#include "tissue/mesh/surface/label_surface.h"
#include "tissue/mesh/surface/measured_facts.h"
#include "tissue/organ/scene_compiler.h"
#include "tissue/solid/tetrahedra_border.h"
#include "tissue/solid/tetrahedra_mesher.h"

namespace {

using namespace trocar;

const std::vector<int> kOrgans{1, 2, 3, 4, 5, 6, 8, 9, 10, 56};  // of the phantom's table
constexpr int kTriangles = 3000;

const LabelVolume& labels() {
  static const LabelVolume volume = make_phantom({}).labels;
  return volume;
}

TriangleSurface sharp_border(const LabelMask& mask) {
  TriangleSurface sharp = isosurface(sharp_field(mask), Vec3::Ones(), 0.5);
  map_vertices(sharp, box_to_ras_m(labels(), mask));
  return sharp;
}

void count(benchmark::State& state, const std::vector<MeshFacts>& organs) {
  double triangles = 0, there = 0, back = 0, least = 0, low = 0, volume = 0, unsound = 0;
  for (const MeshFacts& facts : organs) {
    triangles += static_cast<double>(facts.topology.triangles);
    there += facts.distance.mean_m * 1e3, back += facts.distance_back.mean_m * 1e3;
    least += facts.quality.min_angle_deg, low += facts.quality.p01_angle_deg;
    unsound += facts.topology.closed() && facts.topology.manifold() ? 0 : 1;
    volume = std::max(volume, std::abs(facts.volume_error_pct));
  }
  const auto n = static_cast<double>(organs.size());
  state.counters["organs"] = n, state.counters["triangles"] = triangles;
  state.counters["to_label_mm"] = there / n, state.counters["back_mm"] = back / n;
  state.counters["least_deg"] = least / n, state.counters["p01_deg"] = low / n, state.counters["volume_%"] = volume;
  state.counters["not_manifold"] = unsound;
}

void guarded_complex(benchmark::State& state) {
  LabelMap map;
  map.layers.push_back(labels());
  std::vector<SceneRequest> requests;
  for (const int number : kOrgans) requests.push_back({0, number, "", kTriangles});
  CompiledScene scene;
  for (auto step : state) scene = compile_scene(map, requests, {});
  std::vector<MeshFacts> facts;
  for (const CompiledOrgan& organ : scene.organs) facts.push_back(organ.facts);
  count(state, facts);
}
BENCHMARK(guarded_complex)->Unit(benchmark::kMillisecond)->Iterations(1);

/// The organs' fields over their boxes, for a place in RAS metres.
class Fields {
 public:
  Fields() {
    for (const int number : kOrgans) {
      One& one = fields_.emplace_back();
      one.mask = cut_out_label(labels(), number, kSmoothingMargin, {});
      one.field = smooth_field(one.mask, {});
      one.to_index = box_to_ras_m(labels(), one.mask).inverse();
      for (int corner = 0; corner < 8; ++corner) {
        Vec3 index;
        for (int axis = 0; axis < 3; ++axis)
          index[axis] = (corner >> axis & 1) != 0 ? one.field.size[static_cast<std::size_t>(axis)] : 0;
        box_.extend(Vec3(one.to_index.inverse() * index));
      }
    }
  }

  const Eigen::AlignedBox3d& box() const { return box_; }
  const LabelMask& mask(std::size_t organ) const { return fields_[organ].mask; }

  int region(const Vec3& place) const {
    double rest = 1, most = 0;
    int best = 0;
    for (std::size_t n = 0; n < fields_.size(); ++n) {
      const double value = sample(fields_[n], place);
      rest -= value;
      if (value > most) most = value, best = static_cast<int>(n + 1);
    }
    return most > rest ? best : 0;
  }

 private:
  struct One {
    LabelMask mask;
    ScalarField field;
    Eigen::Affine3d to_index;
  };

  static double sample(const One& one, const Vec3& place) {
    const Vec3 index = one.to_index * place;
    const Eigen::Vector3i low = index.array().floor().cast<int>();
    double sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
      double share = 1;
      std::array<int, 3> at{};
      for (int axis = 0; axis < 3; ++axis) {
        const int up = corner >> axis & 1;
        at[static_cast<std::size_t>(axis)] = low[axis] + up;
        if (low[axis] < 0 || low[axis] + 1 >= one.field.size[static_cast<std::size_t>(axis)]) return 0;
        share *= up != 0 ? index[axis] - low[axis] : 1 - (index[axis] - low[axis]);
      }
      sum += share * one.field.values[one.field.offset(at[0], at[1], at[2])];
    }
    return sum;
  }

  std::vector<One> fields_;
  Eigen::AlignedBox3d box_;
};

std::vector<TriangleSurface> borders(const TetrahedraMesh& mesh) {
  std::vector<TriangleSurface> organs(kOrgans.size());
  std::vector<std::map<std::int32_t, std::int32_t>> numbers(kOrgans.size());
  const auto add = [&](int region, std::array<std::int32_t, 3> corners) {
    if (region < 1) return;
    const auto n = static_cast<std::size_t>(region - 1);
    for (std::int32_t& corner : corners) {
      const auto [entry, fresh] = numbers[n].try_emplace(corner, static_cast<std::int32_t>(organs[n].vertices.size()));
      if (fresh) organs[n].vertices.push_back(mesh.nodes[static_cast<std::size_t>(corner)]);
      corner = entry->second;
    }
    organs[n].triangles.push_back(corners);
  };
  for (const BorderFace& face : border_faces(mesh)) {
    add(face.inner, face.nodes);
    add(face.outer, {face.nodes[0], face.nodes[2], face.nodes[1]});
  }
  return organs;
}

void mesh_3_facets(benchmark::State& state) {
  std::vector<TriangleSurface> organs;
  std::vector<double> targets;
  std::vector<TriangleSurface> sharp;
  for (auto step : state) {
    const Fields fields;
    MesherSettings settings;
    settings.box = fields.box(), settings.cell = 1, settings.perturb = false;
    settings.facet = static_cast<double>(state.range(0)) * 1e-4;
    settings.facet_distances.assign(kOrgans.size(), static_cast<double>(state.range(1)) * 1e-5);
    for (std::size_t n = 0; n < kOrgans.size(); ++n) {
      TriangleSurface& border = sharp.emplace_back(sharp_border(fields.mask(n)));
      targets.push_back(static_cast<double>(fields.mask(n).kept_voxels) * labels().voxel_volume_ml() * 1e-6);
      for (std::size_t v = 0; v < border.vertices.size(); v += 1 + border.vertices.size() / 40)
        settings.seeds.push_back({border.vertices[v], static_cast<int>(n + 1)});
    }
    organs = borders(meshed([&](const Vec3& place) { return fields.region(place); }, settings));
  }
  std::vector<MeshFacts> facts(organs.size());
  for (std::size_t n = 0; n < organs.size(); ++n)
    measure(organs[n], targets[n], sharp[n], volume_centroid_m(sharp[n]), facts[n]);
  count(state, facts);
}
BENCHMARK(mesh_3_facets)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1)
    ->ArgNames({"facet_0.1mm", "distance_0.01mm"})
    ->Args({50, 100})
    ->Args({50, 50})
    ->Args({50, 30})
    ->Args({50, 10})
    ->Args({35, 30});

}  // namespace

BENCHMARK_MAIN();
