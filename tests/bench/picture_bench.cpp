// Budget: a picture without GPU, 1280x720, soft preset, at least 20 /s on board scenes and 10 /s with an organ, on two
// cores with the loop running. `CPU` adds the rasteriser's threads, so that the figure also means something on a busy
// machine: 50 ms of wall time on two idle cores are 100 ms of it. LP_NUM_THREADS=1 leaves the other core to the loop.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/picture/gl/headless_context.h"
#include "app/picture/models/curved_subdivision.h"
#include "app/picture/models/organ_scene.h"
#include "app/picture/models/picture_mesh.h"
#include "app/picture/models/show_scene.h"
#include "app/picture/scene/renderer.h"
#include "tests/support/board_scene.h"
#include "tissue/mesh/surface/cut_tracing.h"
#include "tissue/mesh/surface/groove.h"
#include "tissue/organ/organ.h"

namespace {

using trocar::SceneView;

const std::string kAssets = std::string(TROCAR_SOURCE_DIR) + "/assets";

SceneView portrait(const std::string& organ) {
  return trocar::organ_scene(trocar::load_organ(trocar::find_organ(organ, kAssets)));
}

SceneView scene_named(const std::string& name) {
  if (name == "pens") return trocar::testing_support::pens_scene();
  if (name == "blocks") return trocar::testing_support::grasp_scene();
  if (name.starts_with("phantom")) return portrait(name);
  if (name == "organ") return trocar::testing_support::procedural_scene();
  return trocar::show_scene(name);
}

/// A scene, and its organ in some shapes that follow each other: one for an organ that stands still.
struct Moments {
  SceneView view;
  std::vector<trocar::SurfacePtr> organ;
};

/// An organ that swings up and down as a whole, and bleeds.
Moments deforming(const std::string& organ) {
  Moments out{portrait(organ), {}};
  const trocar::SurfacePtr rest = out.view.organ;
  for (int i = 0; i < 16; ++i) {
    std::vector<trocar::Vec3> vertices = rest->vertices;
    std::vector<float> blood;
    for (trocar::Vec3& v : vertices) {
      blood.push_back(v.x() > 0 ? 0.05F * static_cast<float>(i) : 0.0F);
      v.z() += 0.015 * std::sin(30 * v.x() + 0.4 * i);
    }
    out.organ.push_back(trocar::moved_surface(rest, std::move(vertices), {{"blood", std::move(blood)}}));
  }
  return out;
}

/// With a cut of 20 mm at its highest place, 5 mm deep.
trocar::SurfaceSnapshot with_groove(const trocar::TriangleSurface& organ) {
  using trocar::Vec3;
  const Vec3 top = *std::max_element(organ.vertices.begin(), organ.vertices.end(),
                                     [](const Vec3& a, const Vec3& b) { return a.z() < b.z(); });
  const Vec3 half(0.010, 0, 0);
  trocar::SurfaceSnapshot out;
  const trocar::TracedCut traced =
      trocar::trace_cut(organ, trocar::track_blade(top - half, top + half, -Vec3::UnitZ(), 0.005, 0.01));
  if (traced.refusal != trocar::CutRefusal::kNone) throw std::runtime_error("the benchmark's cut is refused");
  const trocar::Groove groove = trocar::cut_groove(organ, traced.cut);
  static_cast<trocar::TriangleSurface&>(out) = groove.surface;
  out.inside.assign(out.triangles.size(), false);
  for (const std::int32_t wall : groove.walls) out.inside[static_cast<std::size_t>(wall)] = true;
  return out;
}

/// An organ whose triangles are others in every picture.
Moments cut(const std::string& organ) {
  Moments out{portrait(organ), {}};
  const trocar::SurfaceSnapshot grooved = with_groove(*out.view.organ);
  for (int i = 0; i < 16; ++i) out.organ.push_back(std::make_shared<const trocar::SurfaceSnapshot>(grooved));
  return out;
}

Moments moments(const std::string& name) {
  if (name == "cut") return cut("phantom-liver");
  if (name == "cut-abdomen") return cut("phantom-abdomen");
  if (name == "deforming") return deforming("phantom-liver");
  if (name == "deforming-abdomen") return deforming("phantom-abdomen");
  Moments out{scene_named(name), {}};
  out.organ = {out.view.organ};
  return out;
}

void draw(benchmark::State& state, const std::string& name, trocar::Preset preset) {
  const Moments shown = moments(name);
  SceneView view = shown.view;
  trocar::HeadlessContext context;
  trocar::RenderOptions options;
  options.preset = preset;
  trocar::Renderer renderer(context, kAssets, options);
  view.organ = shown.organ.back();
  renderer.draw_scope(view, 1280, 720);  // shaders are compiled at the first one
  renderer.finish();
  std::size_t moment = 0;
  for (auto step : state) {
    view.organ = shown.organ[moment++ % shown.organ.size()];
    view.hud.elapsed_s += 0.04;
    view.X_TI.p.x() += 1e-5;
    benchmark::DoNotOptimize(renderer.draw_scope(view, 1280, 720));  // as a window does: nothing is read back
    renderer.finish();
  }
  state.counters["pictures/s"] =
      benchmark::Counter(static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}

/// A moved mesh in its own light, without what sends it to the GPU.
void move(benchmark::State& state, trocar::Preset preset) {
  const Moments shown = deforming("phantom-liver");
  trocar::CurvedSubdivision subdivision(*shown.view.organ, trocar::traits_of(preset).organ_triangles);
  const trocar::SolidGrid rest(subdivision.fine());
  std::size_t moment = 0;
  for (auto step : state) {
    const trocar::SurfacePtr& now = shown.organ[moment++ % shown.organ.size()];
    const trocar::TriangleSurface& fine = subdivision.move(now->vertices);
    benchmark::DoNotOptimize(trocar::bake_vertices(fine, trocar::SolidGrid(fine, rest)));
  }
  state.counters["triangles"] = static_cast<double>(subdivision.fine().triangles.size());
}

}  // namespace

int main(int argc, char** argv) {
  for (const trocar::Preset preset : {trocar::Preset::kLow, trocar::Preset::kSoft, trocar::Preset::kFull}) {
    benchmark::RegisterBenchmark(("move/" + trocar::preset_name(preset)).c_str(), move, preset)
        ->Unit(benchmark::kMillisecond);
    for (const std::string name : {"pens", "blocks", "organ", "phantom-liver", "phantom-abdomen", "deforming",
                                   "deforming-abdomen", "cut", "cut-abdomen", "abdomen", "blood", "smoke", "fog"})
      benchmark::RegisterBenchmark((name + "/" + trocar::preset_name(preset)).c_str(), draw, name, preset)
          ->Unit(benchmark::kMillisecond)
          ->MeasureProcessCPUTime()
          ->UseRealTime();
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
