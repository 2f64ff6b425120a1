#include "app/device_bench/fault_trials.h"

#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

#include "haptics/device/backends/simulated_board.h"
#include "haptics/haptic_loop.h"
#include "haptics/kinematics/hybrid_arm.h"

namespace trocar {
namespace {

constexpr double kFaultAt_s = 3.6;
constexpr double kAnswer_s = 0.5;  // for which a lost answer of the card is waited for: a busy machine may be late
constexpr int kPatchPeriod = 10;   // ticks
// N m, N: a current dies with the amplifier's time constant; where only the board's watchdog is left, amplifiers of an
// MC4000 stay on behind converters at zero, and the converters' offsets with them.
constexpr double kNoTorque = 1e-4, kOffsets = 0.02;
constexpr int kAfterwards = 500;  // ticks in which nothing may bring the torque back

enum Where : unsigned { kSimulated = 1, kCard = 2, kBoards = 4, kEverywhere = 7 };

Where where(const SimulatedBoard& board) { return board.card ? kCard : board.boards ? kBoards : kSimulated; }

/// The loop on a board; a hand that leads the stylus up and down, into a floor at the bottom; a tissue that makes a
/// patch each 10 ms.
class ArmAtWork {
 public:
  ArmAtWork(SimulatedBoard opened, const std::function<void(HapticLoopConfig&)>& change)
      : board(std::move(opened)), loop(config_of(*board.daq, change)), patch(std::make_unique<ContactPatch>()) {
    run(0.65);
    goal = sense().X_BS;
    holding = true;
    run(1.2);
    move(arm_state(working_angles()).X_WS, 1.0);
    rest = goal;
    put_floor(0.015);
  }

  void tick() {
    if (holding) board.world->set_hand_intent(goal, kJaw_m);
    if (tissue_lives && ++ticks_ % kPatchPeriod == 0) ++patch->stamp;
    const DacFrame out = loop.tick(board.daq->read(), *patch, record);
    board.daq->arm(record.amplifiers_armed);
    board.daq->write(out);
  }
  void swing() {
    const double phase = 2 * std::numbers::pi * board.world->time_s();
    goal.p = rest.p + throw_m + 0.02 * Vec3(std::sin(2 * phase), std::sin(phase), std::cos(3 * phase));
    goal.R = Eigen::AngleAxisd(0.2 * std::sin(phase), Vec3(1, 1, 1).normalized()).toRotationMatrix() * rest.R;
    tick();
  }
  /// Largest of what the motors deliver now.
  double load() const {
    const auto held = board.hold();
    return board.device->plant().motor_loads().cwiseAbs().maxCoeff();
  }
  HandSense sense() const { return board.world->sense(); }

  SimulatedBoard board;
  HapticLoop loop;
  std::unique_ptr<ContactPatch> patch;
  TickRecord record;
  Pose goal, rest;
  Vec3 throw_m = Vec3::Zero();  ///< of the hand, beside its swing
  bool holding = false, tissue_lives = true;

 private:
  static constexpr double kJaw_m = 0.02;
  static JointVector working_angles() {
    constexpr double kDegree = std::numbers::pi / 180;
    return (JointVector() << 45, 45, 45, -60, -75, 0).finished() * kDegree;
  }
  static HapticLoopConfig config_of(const DataAcquisition& daq, const std::function<void(HapticLoopConfig&)>& change) {
    HapticLoopConfig config;
    config.daq = daq.capabilities();
    // The instrument points down whatever way the stylus is held there; its shaft stays in the air.
    const Mat3 down = (Mat3() << 1, 0, 0, 0, -1, 0, 0, 0, -1).finished();
    config.map.X_SI.R = arm_state(working_angles()).X_WS.R.transpose() * down;
    config.safety.max_patch_age_s = 0.2;  // as of an attempt
    if (change) change(config);
    return config;
  }
  void run(double seconds) {
    for (long n = std::lround(seconds * loop.config().daq.rate_hz); n > 0; --n) tick();
  }
  void move(const Pose& to, double seconds) {
    const Pose from = goal;
    const Eigen::AngleAxisd turn(Mat3(to.R * from.R.transpose()));
    const long n = std::lround(seconds * loop.config().daq.rate_hz);
    for (long k = 1; k <= n; ++k) {
      const double s = static_cast<double>(k) / static_cast<double>(n);
      goal.p = from.p + s * (to.p - from.p);
      goal.R = Eigen::AngleAxisd(s * turn.angle(), turn.axis()) * from.R;
      tick();
    }
  }
  void put_floor(double below_m) {
    constexpr double kHalf_m = 0.06;
    const Vec3 tip = record.stylus.X_TI.p;
    const double z = tip.z() - loop.config().tool.radius_m - below_m;
    const auto at = [&](double x, double y) { return Vec3(tip.x() + kHalf_m * x, tip.y() + kHalf_m * y, z); };
    add_triangle(*patch, {at(-1, -1), at(1, -1), at(1, 1)}, 0);
    add_triangle(*patch, {at(-1, -1), at(1, 1), at(-1, 1)}, 1);
    ++patch->stamp;
  }

  int ticks_ = 0;
};

constexpr int kAnyCause = -2;

/// One line of the table.
struct Row {
  const char* fault;
  unsigned where;
  FaultCode cause;  ///< kNone: the operator's right
  int channel;      ///< -1: of none, or of any; kAnyCause: whatever hard cause comes first
  int unseen_ms;    ///< at most, before anything answers
  std::optional<InjectedFault> injected = {};
  void (*act)(ArmAtWork& arm, int tick) = nullptr;  ///< before each tick from the fault on, from 0
  bool by_board = false;                            ///< its watchdog answers, not the loop
  void (*change)(HapticLoopConfig& config) = nullptr;
};

using Kind = InjectedFaultKind;
using Arm = ArmAtWork;
InjectedFault at_work(Kind kind, int channel = 0, double value = 0, double duration_s = 0) {
  return {kind, kFaultAt_s, duration_s, channel, value};
}
void card_trouble(Arm& arm, int tick, const CardTroubles& troubles) {
  if (tick == 0) arm.board.card->trouble(troubles);
}
void boards_trouble(Arm& arm, int tick, const BoardTroubles& troubles) {
  if (tick == 0) arm.board.boards->trouble(troubles);
}

const std::vector<Row>& rows() {
  constexpr int kBite_ms = 16, kStuck_ms = 15000;
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  static const std::vector<Row> table{
      {"encoder-jump", kEverywhere, FaultCode::kEncoderJump, 2, 0, at_work(Kind::kEncoderJump, 2, 500)},
      {"encoder-stuck", kEverywhere, FaultCode::kEncoderStuck, 1, kStuck_ms, at_work(Kind::kEncoderStuck, 1)},
      {"dead-channel", kEverywhere, FaultCode::kChannelInvalid, 4, 0, at_work(Kind::kChannelInvalid, 4)},
      {"quadrature-error",
       kCard,
       FaultCode::kChannelInvalid,
       2,
       0,
       {},
       [](Arm& arm, int k) { card_trouble(arm, k, {.quadrature_errors = 1 << 2}); }},
      {"quadrature-error",
       kBoards,
       FaultCode::kChannelInvalid,
       2,
       0,
       {},
       [](Arm& arm, int k) { boards_trouble(arm, k, {.quadrature_errors = 1 << 2}); }},
      // An output of the card cannot be read back: docs/device_and_safety.md, what cannot be seen.
      {"dac-stuck", kSimulated | kBoards, FaultCode::kDacMismatch, 1, 0, at_work(Kind::kDacStuck, 1)},
      {"sync-lost", kSimulated, FaultCode::kLateLoop, -1, 0, at_work(Kind::kMissedSync, 0, 25)},
      {"sync-lost",
       kBoards,
       FaultCode::kChannelInvalid,
       4,
       0,
       {},
       [](Arm& arm, int k) { boards_trouble(arm, k, {.sync_cable_out = true}); }},
      {"answers-lost",
       kCard,
       FaultCode::kSensorSilent,
       -1,
       1,
       {},
       [](Arm& arm, int k) { card_trouble(arm, k, {.loses_answers = 1}); }},
      {"card-frozen",
       kCard,
       FaultCode::kSensorSilent,
       -1,
       0,
       {},
       [](Arm& arm, int k) { card_trouble(arm, k, {.frozen = true}); }},
      {"card-lies",
       kCard,
       FaultCode::kEncoderJump,
       kAnyCause,
       0,
       {},
       [](Arm& arm, int k) { card_trouble(arm, k, {.lies = true}); }},
      {"card-without-power",
       kCard,
       FaultCode::kWatchdog,
       kAnyCause,
       0,
       {},
       [](Arm& arm, int k) {
         if (k == 0) arm.board.card->power_cycle();
       }},
      {"board-gone",
       kCard,
       FaultCode::kSensorSilent,
       -1,
       kBite_ms,
       {},
       [](Arm& arm, int k) {
         card_trouble(arm, k, {.silent = true});
         arm.board.card->miss_sync();  // its own time goes on
       },
       true},
      {"board-gone",
       kBoards,
       FaultCode::kSensorSilent,
       -1,
       kBite_ms,
       {},
       [](Arm& arm, int k) {
         boards_trouble(arm, k, {.gone = {true, true}});
         arm.board.device->miss_sync();
       },
       true},
      {"second-board-gone",
       kBoards,
       FaultCode::kChannelInvalid,
       4,
       0,
       {},
       [](Arm& arm, int k) {
         boards_trouble(arm, k, {.gone = {false, true}});
       }},
      {"sensor-silent", kEverywhere, FaultCode::kSensorSilent, -1, 1, at_work(Kind::kSensorSilence)},
      {"watchdog", kEverywhere, FaultCode::kWatchdog, -1, kBite_ms, at_work(Kind::kWatchdog)},
      {"patch-not-a-number",
       kEverywhere,
       FaultCode::kNonFinite,
       -1,
       0,
       {},
       [](Arm& arm, int k) {
         if (k == 0) arm.patch->material[0].stiffness_n_per_m = kNaN;
       }},
      {"hand-not-a-number", kEverywhere, FaultCode::kHandNonFinite, -1, 0, at_work(Kind::kHandNaN, 0, 0, 0.1)},
      {"stale-patch",
       kEverywhere,
       FaultCode::kStalePatch,
       -1,
       201,
       {},
       [](Arm& arm, int) { arm.tissue_lives = false; }},
      {"late-loop",
       kEverywhere,
       FaultCode::kLateLoop,
       -1,
       0,
       {},
       [](Arm& arm, int k) {
         for (int n = 0; k == 0 && n < 21; ++n) arm.board.world->miss_sync();
       }},
      {"overspeed",
       kEverywhere,
       FaultCode::kOverspeed,
       -1,
       400,
       {},
       [](Arm& arm, int) { arm.throw_m = Vec3(0.1, -0.6, 0.1); }},
      {"overheat",
       kEverywhere,
       FaultCode::kOverheat,
       -1,
       60000,
       {},
       [](Arm&, int) {},
       false,
       [](HapticLoopConfig& config) {
         config.heat.winding_time_s = 0.05;  // a motor so small that the weight of the arm cooks it within seconds
         config.heat.case_time_s = 3;
         config.heat.case_to_air_k_per_w = 600;
       }},
      {"emergency-stop", kEverywhere, FaultCode::kEmergencyStop, -1, 0, at_work(Kind::kEmergencyStop)},
      {"deadman-open", kEverywhere, FaultCode::kNone, -1, 0, at_work(Kind::kDeadmanOpen)},
      {"hand-lets-go", kEverywhere, FaultCode::kNone, -1, 0, at_work(Kind::kHandLetsGo)},
      {"drive-fault", kEverywhere, FaultCode::kDriveFault, 3, 0, at_work(Kind::kDriveFault, 3)},
      {"drive-hot", kEverywhere, FaultCode::kDriveHot, 0, 0, at_work(Kind::kOverTemperature)}};
  return table;
}

double no_torque(const Row& row) { return row.by_board ? kOffsets : kNoTorque; }

/// What else must be so once the torque is off. @return what is not.
std::string stays_off(ArmAtWork& arm, const Row& row) {
  const Fault first = arm.record.stylus.fault;
  if (row.channel == kAnyCause ? !first || is_soft(first.code) : first.code != row.cause)
    return std::string("the loop says ") + fault_name(first.code) + ", not " + fault_name(row.cause);
  if (row.channel >= 0 && first.channel != row.channel)
    return "the loop names channel " + std::to_string(first.channel) + ", not " + std::to_string(row.channel);
  for (int k = 0; k < kAfterwards; ++k) {
    arm.swing();
    if (arm.load() > no_torque(row)) return "the torque came back after " + std::to_string(k) + " ticks";
    if (arm.record.amplifiers_armed) return "the amplifiers were armed again";
    if (arm.record.stylus.fault.tick != first.tick) return "the first cause was not kept";
    for (const std::int32_t code : arm.record.out.codes)
      if (code != 0) return "a code is not zero";
  }
  return "";
}

FaultTrial try_fault(const Row& row, const std::string& backend, SimulatedDaqConfig device) {
  device.faults.clear();
  device.hand.tremor_m = 0;
  if (row.injected) device.faults.push_back(*row.injected);
  ArmAtWork arm(open_simulated_board(backend, device, kAnswer_s), row.change);
  const double per_ms = device.rate_hz / 1000;
  const bool soft = is_soft(row.cause);
  const int fade = soft ? static_cast<int>(std::lround(20 * per_ms)) : 0;
  FaultTrial out{.fault = row.fault,
                 .reaction = row.by_board                    ? "board"
                             : row.cause == FaultCode::kNone ? "operator"
                             : soft                          ? "soft"
                                                             : "hard",
                 .channel = -1};
  out.limit_ticks = static_cast<int>(std::lround(row.unseen_ms * per_ms)) + fade + 2;
  while (!row.change && arm.board.world->time_s() < kFaultAt_s - 1.5 / device.rate_hz) {
    arm.swing();
    if (arm.record.stylus.loop != LoopState::kActive) {
      out.failure = std::string("stopped before the fault: ") + fault_name(arm.record.stylus.fault.code);
      return out;
    }
  }
  if (arm.load() < 0.05) out.failure = "there was no torque to lose";
  do {
    if (row.act) row.act(arm, out.off_ticks);
    arm.swing();
    ++out.off_ticks;
    if (out.seen_ticks == 0 && arm.record.stylus.loop != LoopState::kActive) out.seen_ticks = out.off_ticks;
  } while (arm.load() > no_torque(row) && out.off_ticks <= out.limit_ticks);
  out.cause = fault_name(arm.record.stylus.fault.code);
  out.channel = arm.record.stylus.fault.channel;
  if (arm.load() > no_torque(row))
    out.failure = "the torque was still there";
  else if (!row.by_board && out.seen_ticks > 0 && out.off_ticks - out.seen_ticks > fade + 2)
    out.failure = "the torque outlived the fault by " + std::to_string(out.off_ticks - out.seen_ticks) + " ticks";
  if (out.failure.empty()) {
    arm.swing();  // a board that answers by itself is heard of in the tick after
    out.cause = fault_name(arm.record.stylus.fault.code);
    out.channel = arm.record.stylus.fault.channel;
    out.failure = stays_off(arm, row);
  }
  return out;
}

}  // namespace

std::vector<FaultTrial> try_faults(const std::string& backend, const SimulatedDaqConfig& device) {
  const Where here = where(open_simulated_board(backend, device));
  std::vector<FaultTrial> out;
  for (const Row& row : rows())
    if (row.where & here) out.push_back(try_fault(row, backend, device));
  return out;
}

}  // namespace trocar
