#include "app/window/device/device_check.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <mutex>
#include <thread>

#include "app/device_bench/board_checks.h"
#include "app/device_bench/plant_bench.h"
#include "app/device_bench/simulated_bench.h"
#include "app/device_bench/wall_trial.h"
#include "haptics/kinematics/device_geometry.h"
#include "haptics/kinematics/hybrid_arm.h"

namespace trocar {
namespace {

constexpr double kTravel = 0.060;  // m: clear of the stretched arm (wall_trial.h)
constexpr double kStroke = 0.040;  // m, up and down
constexpr double kStroke_s = 0.8;
constexpr double kFrom = 0.55,
                 kTo = 0.95;  // share of the stroke in which forces are taken: the arm has come away, at one speed
const Vec3 kWay = Vec3(0.3, 0.25, 1).normalized();  // slanting, so that every joint turns
constexpr double kToPose_s = 1.0, kSettle_s = 0.3;
constexpr double kRoll = 10 * kDegree;  // so that every joint turns: one that never counts would be taken for stuck
constexpr double kFollowed = 0.5;       // share of the stroke that the stylus must go with the hand
constexpr double kWall_n_per_m = 150, kWallBelow = 0.004, kPast = 0.012, kPress_s = 0.25, kHold_s = 0.6;

/// Thrown by a check that nobody waits for any more.
struct GivenUp {};

}  // namespace

struct DeviceCheck::Work {
  SimulatedDaqConfig device;
  CheckLimits limits;
  std::string backend;
  std::atomic<bool> stop{false}, done{false};
  mutable std::mutex mutex;  // guards lines
  std::vector<Line> lines{{What::kBoard}, {What::kWeight}, {What::kFriction}, {What::kPassivity}};
  std::thread thread;

  Line& of(What what) { return lines[static_cast<std::size_t>(what)]; }
  void begin(What what) {
    const std::lock_guard<std::mutex> lock(mutex);
    of(what).state = State::kRunning;
  }
  void end(What what, bool passed, double value, double limit, int count = 0, const std::string& detail = "") {
    const std::lock_guard<std::mutex> lock(mutex);
    of(what) = {what, passed ? State::kPassed : State::kFailed, value, limit, count, detail};
  }
  void fail_rest(const std::string& why) {
    const std::lock_guard<std::mutex> lock(mutex);
    for (Line& line : lines)
      if (line.state == State::kWaiting || line.state == State::kRunning)
        line = {line.what, State::kFailed, 0, 0, 0, why};
  }

  void run();
  void board();
  void bench();
  void stroke(PlantBench& bench, const Pose& to, std::vector<Vec3>& forces) const;
  void weigh(PlantBench& bench, const Pose& middle);
  void press(PlantBench& bench, const Pose& above);
};

/// The hand's goal on a straight line at one speed; force on the hand in the later part of the way.
void DeviceCheck::Work::stroke(PlantBench& bench, const Pose& to, std::vector<Vec3>& forces) const {
  const Pose from = bench.goal();
  const int n = static_cast<int>(std::lround(kStroke_s / bench.period_s()));
  for (int k = 1; k <= n; ++k) {
    const double u = static_cast<double>(k) / n;
    bench.goal().p = from.p + u * (to.p - from.p);
    bench.tick();
    if (u > kFrom && u <= kTo) forces.push_back(bench.daq().sense().force_on_hand);
    if (stop) throw GivenUp{};
  }
}

void DeviceCheck::Work::weigh(PlantBench& bench, const Pose& middle) {
  begin(What::kWeight);
  begin(What::kFriction);
  Pose low = middle;
  low.p -= kStroke / 2 * kWay;
  low.R = middle.R * Eigen::AngleAxisd(kRoll, Vec3::UnitZ());
  Pose high = low;
  high.p += kStroke * kWay;
  bench.move(low, kSettle_s);
  bench.run(kSettle_s);
  std::vector<Vec3> up, down;
  const Vec3 below = bench.record().stylus.X_TI.p;
  stroke(bench, high, up);
  bench.run(kSettle_s);
  const bool followed = (bench.record().stylus.X_TI.p - below).dot(kWay) > kFollowed * kStroke;
  stroke(bench, low, down);
  const auto mean = [](const std::vector<Vec3>& all) {
    Vec3 sum = Vec3::Zero();
    for (const Vec3& f : all) sum += f;
    return Vec3(sum / static_cast<double>(std::max<std::size_t>(1, all.size())));
  };
  const double weight = (0.5 * (mean(up) + mean(down))).norm(),
               friction = std::abs(0.5 * (mean(up) - mean(down)).dot(kWay));
  end(What::kWeight, weight <= limits.weight_n, weight, limits.weight_n);
  if (followed)
    end(What::kFriction, friction <= limits.friction_n, friction, limits.friction_n);
  else
    end(What::kFriction, false, friction, limits.friction_n, 0, "the arm does not follow the hand");
}

void DeviceCheck::Work::press(PlantBench& bench, const Pose& above) {
  begin(What::kPassivity);
  bench.move(above, kSettle_s);
  bench.run(kSettle_s);
  bench.put_wall(bench.record().stylus.X_TI.p - Vec3(0, 0, kWallBelow), Vec3::UnitZ(),
                 {.stiffness_n_per_m = kWall_n_per_m});
  Pose into = above;
  into.p.z() -= kWallBelow + kPast;
  const double before = bench.net_absorbed_j();
  double least = 0;
  std::vector<Vec3> ignored;
  const auto watch = [&](double seconds) {
    for (long n = std::lround(seconds / bench.period_s()); n > 0; --n) {
      bench.tick();
      least = std::min(least, bench.net_absorbed_j() - before);
      if (stop) throw GivenUp{};
    }
  };
  for (const Pose& goal : {into, above}) {
    const Vec3 from = bench.goal().p;
    for (int k = 1; k <= 25; ++k) {
      bench.goal().p = from + k / 25.0 * (goal.p - from);
      watch(kPress_s / 25);
    }
    watch(kHold_s);
  }
  end(What::kPassivity, -least <= limits.energy_j, std::max(0.0, -least), limits.energy_j);
}

void DeviceCheck::Work::bench() {
  HapticLoopConfig loop;
  loop.tool.shaft_length_m = 1e-3;  // a ball at the stylus: forces without moments
  PlantBench bench(device, loop);
  bench.start();
  if (stop) throw GivenUp{};
  const Pose middle = arm_state(near_home(kTravel)).X_WS;
  bench.move(middle, kToPose_s);
  bench.run(kSettle_s);
  weigh(bench, middle);
  press(bench, middle);
}

void DeviceCheck::Work::board() {
  begin(What::kBoard);
  SimulatedBench bench(device, backend);
  const std::vector<BoardCheck> checks = check_board(bench);
  int failed = 0;
  std::string detail;
  for (const BoardCheck& check : checks) {
    if (check.outcome != BoardCheck::Outcome::kFailed) continue;
    ++failed;
    detail += (detail.empty() ? "" : "; ") + check.name + ": " + check.detail;
  }
  end(What::kBoard, failed == 0, failed, 0, static_cast<int>(checks.size()), detail);
}

void DeviceCheck::Work::run() {
  try {
    bench();
    if (stop) throw GivenUp{};
    board();
  } catch (const GivenUp&) {
  } catch (const std::exception& error) {
    fail_rest(error.what());
  }
  done = true;
}

DeviceCheck::DeviceCheck(const SimulatedDaqConfig& device, const CheckLimits& limits, const std::string& backend)
    : work_(std::make_unique<Work>()) {
  work_->device = device;
  work_->limits = limits;
  work_->backend = backend;
  work_->thread = std::thread([work = work_.get()] { work->run(); });
}

DeviceCheck::~DeviceCheck() {
  work_->stop = true;
  work_->thread.join();
}

std::vector<DeviceCheck::Line> DeviceCheck::lines() const {
  const std::lock_guard<std::mutex> lock(work_->mutex);
  return work_->lines;
}

bool DeviceCheck::finished() const { return work_->done; }

bool DeviceCheck::sound() const {
  const std::vector<Line> all = lines();
  return std::all_of(all.begin(), all.end(), [](const Line& line) { return line.state == State::kPassed; });
}

bool DeviceCheck::wait(double most_s) const {
  const auto until = std::chrono::steady_clock::now() + std::chrono::duration<double>(most_s);
  while (!finished() && std::chrono::steady_clock::now() < until)
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  return finished();
}

}  // namespace trocar
