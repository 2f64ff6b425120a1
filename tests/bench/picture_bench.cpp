// Budget: a picture without GPU, 1280x720, soft preset, at least 20 /s on board scenes on two cores. `cpu` adds the
// rasteriser's threads, so that the figure also means something on a busy machine: 50 ms of wall time are 100 ms of it.
#include <benchmark/benchmark.h>

#include "app/graphics/headless_context.h"
#include "app/graphics/renderer.h"
#include "tests/support/board_scene.h"

namespace {

using trocar::SceneView;

void draw(benchmark::State& state, SceneView view, double scene_scale) {
  trocar::HeadlessContext context;
  trocar::RenderOptions options;
  options.scene_scale = scene_scale;
  trocar::Renderer renderer(context, std::string(TROCAR_SOURCE_DIR) + "/assets", options);
  renderer.render(view, 1280, 720);  // shaders are compiled at the first one
  for (auto step : state) {
    view.hud.elapsed_s += 0.04;
    view.X_TI.p.x() += 1e-5;
    benchmark::DoNotOptimize(renderer.render(view, 1280, 720).rgb.data());
  }
  state.counters["pictures/s"] =
      benchmark::Counter(static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}

constexpr double kSoft = 0.5, kFull = 1;
BENCHMARK_CAPTURE(draw, pens_soft, trocar::testing_support::pens_scene(), kSoft)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK_CAPTURE(draw, blocks_soft, trocar::testing_support::grasp_scene(), kSoft)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK_CAPTURE(draw, organ_soft, trocar::testing_support::procedural_scene(), kSoft)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK_CAPTURE(draw, pens_full, trocar::testing_support::pens_scene(), kFull)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK_CAPTURE(draw, blocks_full, trocar::testing_support::grasp_scene(), kFull)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK_CAPTURE(draw, organ_full, trocar::testing_support::procedural_scene(), kFull)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

}  // namespace

BENCHMARK_MAIN();
