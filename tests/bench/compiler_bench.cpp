// Budget: a liver on 512 x 512 x 80 voxels to 10 000 triangles under 5 s of CPU and 1 GB; 1.1 million raw triangles
// under 30 s and 2 GB. The label map is made in memory and not timed; reading and writing are not in these times.
#include <benchmark/benchmark.h>

#include "app/cli/machine/bench_compiler.h"
#include "tissue/mesh/surface/nearest_surface.h"
#include "tissue/organ/organ_compiler.h"

namespace {

using namespace trocar;

void compile(benchmark::State& state, std::array<int, 3> size, int triangles) {
  const LabelVolume volume = liver_like_labels(size);
  CompileOptions options;
  options.triangles = triangles;
  std::size_t made = 0;
  for (auto step : state) made = compile_label(volume, 1, options).surface.triangles.size();
  state.counters["triangles"] = static_cast<double>(made);
}

BENCHMARK_CAPTURE(compile, ct_coarse, {128, 128, 40}, 3000)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(compile, ct, {512, 512, 80}, 10000)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(compile, ct_fine, {900, 900, 230}, 20000)->Unit(benchmark::kMillisecond);

/// Points a hair off the organ, in the order of its triangles.
void nearest(benchmark::State& state, bool guessed) {
  CompileOptions options;
  options.triangles = 20000;
  const TriangleSurface surface = compile_label(liver_like_labels({256, 256, 80}), 1, options).surface;
  const NearestSurface tree(surface);
  std::size_t n = 0, last = 0;
  for (auto step : state) {
    const auto& t = surface.triangles[n = (n + 1) % surface.triangles.size()];
    const Vec3 place = surface.vertices[static_cast<std::size_t>(t[0])] + Vec3(1e-3, -1e-3, 5e-4);
    const auto hit = tree.nearest(place, guessed ? last : 0);
    benchmark::DoNotOptimize(last = hit.triangle);
  }
}
BENCHMARK_CAPTURE(nearest, without_a_guess, false);
BENCHMARK_CAPTURE(nearest, guess_of_the_last, true);

}  // namespace

BENCHMARK_MAIN();
