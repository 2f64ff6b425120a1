#include "app/device_bench/plant_bench.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "haptics/control/gravity.h"
#include "haptics/device/plant/plant_parameters.h"
#include "haptics/device/transmission.h"
#include "scenarios/hands/minimum_jerk.h"

namespace trocar {
namespace {

constexpr double kJawOpening = 0.02;  // m, as the jig leaves it
constexpr double kInJigS = 0.65;      // self-test and homing
constexpr double kSoftStartS = 1.2;   // arming and the torque's ramp
constexpr double kWallSide = 0.08;    // m
constexpr int kWallCells = 4;

HapticLoopConfig matched(HapticLoopConfig loop, const SimulatedDaq& daq) {
  loop.daq = daq.capabilities();
  return loop;
}

}  // namespace

PlantBench::PlantBench(const SimulatedDaqConfig& device, const HapticLoopConfig& loop)
    : daq_(device),
      config_(matched(loop, daq_)),
      loop_(config_),
      patch_(std::make_unique<ContactPatch>()),
      goal_(daq_.sense().X_BS),
      jaw_(kJawOpening),
      last_q_(daq_.plant().motor_outputs().head<kArmJoints>()) {}

PlantBench::PlantBench(const PlantBench& other)
    : daq_(other.daq_),
      config_(other.config_),
      loop_(other.loop_),
      patch_(std::make_unique<ContactPatch>(*other.patch_)),
      record_(other.record_),
      goal_(other.goal_),
      jaw_(other.jaw_),
      holding_(other.holding_),
      last_q_(other.last_q_),
      asked_(other.asked_),
      absorbed_j_(other.absorbed_j_) {}

const TickRecord& PlantBench::tick() {
  if (holding_) daq_.set_hand_intent(goal_, jaw_);
  const DacFrame acting = daq_.codes_in_force();
  const DaqSample sample = daq_.read();
  account(acting);
  const DacFrame out = loop_.tick(sample, *patch_, record_);
  daq_.arm(record_.amplifiers_armed);
  daq_.write(out);
  remember(out);
  const Fault& fault = record_.stylus.fault;
  if (fault.code != FaultCode::kNone) {
    throw BenchFault("the device loop of the bench has faulted at " + std::to_string(time_s()) +
                     " s: " + fault_name(fault.code));
  }
  return record_;
}

void PlantBench::remember(const DacFrame& out) {
  JointVector torque = torques_of(config_.device, out, config_.daq.dac_bits).head<kArmJoints>();
  if (config_.carry_weight) torque -= gravity_torque(config_.device, arm_state(record_.q.head<kArmJoints>()));
  asked_.push_front({out, torque});
  if (asked_.size() > kKept) asked_.pop_back();
}

void PlantBench::account(const DacFrame& acting) {
  const JointVector q = daq_.plant().motor_outputs().head<kArmJoints>();
  // By its codes: however late they are, jitter included.
  const auto tick =
      std::find_if(asked_.begin(), asked_.end(), [&](const Asked& a) { return a.codes.codes == acting.codes; });
  if (tick != asked_.end()) absorbed_j_ -= tick->torque.dot(q - last_q_);
  last_q_ = q;
}

void PlantBench::run(double seconds) {
  for (long n = std::lround(seconds * config_.daq.rate_hz); n > 0; --n) tick();
}

void PlantBench::start() {
  run(kInJigS);
  goal_ = daq_.sense().X_BS;
  holding_ = true;
  run(kSoftStartS);
  absorbed_j_ = 0;
}

void PlantBench::move(const Pose& to, double seconds) {
  const Pose from = goal_;
  const Eigen::AngleAxisd turn(Mat3(to.R * from.R.transpose()));
  const long n = std::lround(seconds * config_.daq.rate_hz);
  for (long k = 1; k <= n; ++k) {
    const double s = minimum_jerk(static_cast<double>(k) / static_cast<double>(n));
    goal_.p = from.p + s * (to.p - from.p);
    goal_.R = Eigen::AngleAxisd(s * turn.angle(), turn.axis()) * from.R;
    tick();
  }
}

void PlantBench::put_wall(const Vec3& point_T, const Vec3& normal_T, const ContactMaterial& material) {
  const Vec3 n = normal_T.normalized();
  const Vec3 u = n.unitOrthogonal(), v = n.cross(u);
  const Vec3 corner = point_T - config_.tool.radius_m * n - 0.5 * kWallSide * (u + v);
  const auto at = [&](int i, int j) { return Vec3(corner + kWallSide / kWallCells * (i * u + j * v)); };
  std::vector<std::array<Vec3, 3>> triangles;
  for (int i = 0; i < kWallCells; ++i) {
    for (int j = 0; j < kWallCells; ++j) {
      triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  put_surface(triangles, material);
}

void PlantBench::put_surface(std::span<const std::array<Vec3, 3>> triangles_T, const ContactMaterial& material) {
  if (triangles_T.size() > kMaxPatchTriangles) throw std::invalid_argument("bench: a surface of too many triangles");
  patch_->clear();
  patch_->material[0] = material;
  for (const auto& triangle : triangles_T) add_triangle(*patch_, triangle, patch_->count);
  ++patch_->stamp;
}

}  // namespace trocar
