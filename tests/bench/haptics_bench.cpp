// Budgets of the device loop: kinematics, Jacobian and statics median within 1 us; contact step within 5 us; whole tick
// p99.9 within 50 us of thread CPU.
#include <benchmark/benchmark.h>

#include <memory>

#include "haptics/control/gravity.h"
#include "tests/haptics/contact/surfaces.h"
#include "tests/haptics/loop_rig.h"
#include "tissue/collision/patch_extraction.h"

namespace {

using namespace trocar;

void kinematics_jacobian_statics(benchmark::State& state) {
  const DeviceModel model;
  test::Random random(1);
  std::vector<JointVector> q;
  for (int i = 0; i < 256; ++i) q.push_back(test::random_joints(random));
  std::size_t k = 0;
  for (auto step : state) {
    const ArmState arm = arm_state(q[k++ % q.size()]);
    benchmark::DoNotOptimize(gravity_torque(model, arm));
    benchmark::DoNotOptimize(arm.J_WS);
  }
}
BENCHMARK(kinematics_jacobian_statics);

void inverse(benchmark::State& state) {
  const Pose X = test::working_pose();
  for (auto step : state) benchmark::DoNotOptimize(inverse_kinematics(X));
}
BENCHMARK(inverse);

/// A sphere of 8 * 4^levels triangles: 6 gives 33k, 4 gives 2k; the patch is what the tissue task would hand over.
void contact_step(benchmark::State& state) {
  const TriangleSurface ball = test::sphere(static_cast<int>(state.range(0)), 0.04);
  PatchExtraction extraction(ball);
  const auto patch = std::make_unique<ContactPatch>();
  ContactRenderer renderer(ContactLaw::kProxy);
  const auto pose = [](int k) {
    const double angle = 0.2 * std::sin(1e-3 * k);
    const Vec3 n(std::sin(angle), 0, std::cos(angle));
    return test::tip_down(n * (0.04 + ToolShape{}.radius_m - 0.002));
  };
  for (int lift = 400; lift >= 0; --lift) {
    const Pose X{pose(0).R, pose(0).p + Vec3(0, 0, lift * 1e-5)};
    extraction.extract(X, {}, *patch);
    renderer.update(X, Twist{}, *patch);
  }
  int k = 0;
  for (auto step : state) {
    if (++k % 10 == 0) {
      state.PauseTiming();
      extraction.extract(pose(k), {}, *patch);
      state.ResumeTiming();
    }
    benchmark::DoNotOptimize(renderer.update(pose(k), Twist{}, *patch));
  }
  state.counters["triangles"] = static_cast<double>(ball.triangles.size());
  state.counters["patch"] = patch->count;
}
BENCHMARK(contact_step)->Arg(4)->Arg(5)->Arg(6);

void extract_patch(benchmark::State& state) {
  const TriangleSurface ball = test::sphere(static_cast<int>(state.range(0)), 0.04);
  PatchExtraction extraction(ball);
  const auto patch = std::make_unique<ContactPatch>();
  for (auto step : state) extraction.extract(test::tip_down({0, 0, 0.0405}), {}, *patch);
}
BENCHMARK(extract_patch)->Arg(4)->Arg(6)->Unit(benchmark::kMicrosecond);

/// The tick alone, pressing and pinching, fed with the samples of a closed-loop run.
void whole_tick(benchmark::State& state) {
  test::LoopRig rig;
  rig.keep = true;
  rig.start();
  rig.move(test::working_pose(), 1.5);
  rig.run(0.4);
  const std::size_t first = rig.records.size();
  rig.put_floor(0.002, 150);
  rig.patch->grip = {0.012, 500};
  rig.squeeze(0.009, 0.2);
  Pose deep = rig.goal;
  deep.p.z() -= 0.010;
  rig.move(deep, 0.5);
  const auto free_air = std::make_unique<ContactPatch>();
  HapticLoop loop(rig.config);
  std::size_t k = 0;
  TickRecord record;
  const auto advance = [&] {
    if (k == rig.records.size()) {
      k = 0;
      loop = HapticLoop(rig.config);
    }
    loop.tick(rig.records[k].in, k < first ? *free_air : *rig.patch, record);
    ++k;
  };
  while (k < first) advance();
  for (auto step : state) {
    if (k == rig.records.size()) {
      state.PauseTiming();
      do advance();
      while (k < first);
      state.ResumeTiming();
    }
    advance();
  }
}
BENCHMARK(whole_tick);

}  // namespace

BENCHMARK_MAIN();
