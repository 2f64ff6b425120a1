#include "app/cli/machine/bench_pictures.h"

#include <time.h>

#include <chrono>
#include <iomanip>
#include <ostream>

#include "app/picture/gl/headless_context.h"
#include "app/picture/models/show_scene.h"
#include "app/picture/scene/preset.h"
#include "app/picture/scene/renderer.h"
#include "haptics/input_error.h"

namespace trocar {
namespace {

constexpr int kWidth = 1280, kHeight = 720, kFrames = 6;

double process_cpu_ms() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

PictureCost cost_of(Renderer& renderer, const std::string& scene, SceneView view, Preset preset) {
  RenderOptions options;
  options.preset = preset;
  renderer.set_options(options);
  renderer.draw_scope(view, kWidth, kHeight);  // programs and meshes
  renderer.finish();
  const double cpu = process_cpu_ms();
  const auto start = std::chrono::steady_clock::now();
  for (int i = 0; i < kFrames; ++i) {
    view.X_TI.p.x() += 1e-4;
    renderer.draw_scope(view, kWidth, kHeight);
    renderer.finish();
  }
  const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return {scene, preset_name(preset), (process_cpu_ms() - cpu) / kFrames, kFrames / wall};
}

}  // namespace

std::vector<PictureCost> picture_costs(const std::filesystem::path& asset_root, std::ostream& err) {
  std::vector<PictureCost> out;
  try {
    HeadlessContext context;
    Renderer renderer(context, asset_root);
    for (const char* scene : {"board", "abdomen"}) {
      const SceneView view = show_scene(scene);
      for (const Preset preset : {Preset::kLow, Preset::kSoft, Preset::kFull})
        out.push_back(cost_of(renderer, scene, view, preset));
    }
  } catch (const EnvironmentError& error) {
    err << "trocar: no picture is timed: " << error.what() << '\n';
    out.clear();
  }
  return out;
}

void print_pictures(const std::vector<PictureCost>& costs, std::ostream& out) {
  if (costs.empty()) return;
  out << "\npicture of the scope, 1280 x 720   CPU ms, all threads   pictures/s by the clock\n"
      << std::fixed << std::setprecision(1);
  for (const PictureCost& cost : costs)
    out << std::left << std::setw(9) << cost.scene << std::setw(18) << cost.preset << std::right << std::setw(18)
        << cost.cpu_ms << std::setw(26) << cost.per_s << '\n';
}

}  // namespace trocar
