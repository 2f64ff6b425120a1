// Budget: a picture without GPU, 1280x720, soft preset, at least 20 /s on board scenes and 10 /s with an organ, on two
// cores with the loop running. `CPU` adds the rasteriser's threads, so that the figure also means something on a busy
// machine: 50 ms of wall time on two idle cores are 100 ms of it. LP_NUM_THREADS=1 leaves the other core to the loop.
#include <benchmark/benchmark.h>

#include <string>

#include "app/picture/gl/headless_context.h"
#include "app/picture/models/show_scene.h"
#include "app/picture/scene/renderer.h"
#include "tests/support/board_scene.h"

namespace {

using trocar::SceneView;

SceneView scene_named(const std::string& name) {
  if (name == "pens") return trocar::testing_support::pens_scene();
  if (name == "blocks") return trocar::testing_support::grasp_scene();
  if (name == "organ") return trocar::testing_support::procedural_scene();
  return trocar::show_scene(name);
}

void draw(benchmark::State& state, const std::string& name, trocar::Preset preset) {
  SceneView view = scene_named(name);
  trocar::HeadlessContext context;
  trocar::RenderOptions options;
  options.preset = preset;
  trocar::Renderer renderer(context, std::string(TROCAR_SOURCE_DIR) + "/assets", options);
  renderer.draw_scope(view, 1280, 720);  // shaders are compiled at the first one
  renderer.finish();
  for (auto step : state) {
    view.hud.elapsed_s += 0.04;
    view.X_TI.p.x() += 1e-5;
    benchmark::DoNotOptimize(renderer.draw_scope(view, 1280, 720));  // as a window does: nothing is read back
    renderer.finish();
  }
  state.counters["pictures/s"] =
      benchmark::Counter(static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}

}  // namespace

int main(int argc, char** argv) {
  for (const trocar::Preset preset : {trocar::Preset::kLow, trocar::Preset::kSoft, trocar::Preset::kFull})
    for (const std::string name : {"pens", "blocks", "organ", "abdomen", "blood", "smoke", "fog"})
      benchmark::RegisterBenchmark((name + "/" + trocar::preset_name(preset)).c_str(), draw, name, preset)
          ->Unit(benchmark::kMillisecond)
          ->MeasureProcessCPUTime()
          ->UseRealTime();
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
