#include "app/window/attempt/notch_run.h"

#include <atomic>
#include <mutex>
#include <thread>

#include "app/session/lanes/hand_task.h"
#include "app/session/lanes/haptic_task.h"
#include "app/session/lanes/lockstep_executor.h"
#include "app/session/lanes/threaded_executor.h"
#include "app/session/lanes/tissue_task.h"
#include "app/session/session.h"
#include "app/window/attempt/person_hand.h"
#include "tissue/tissue_world.h"

namespace trocar {
namespace {

constexpr double kInMiddle = 0.006;       // m: the walls come when the tip is so near to the slot's middle
constexpr double kLongest_s = 1e9;        // a run without an end of its own
constexpr std::uint64_t kPatchDelay = 5;  // ticks, as in a session
constexpr int kHapticPriority = 80, kTissuePriority = 60;

/// The walls, in place of the tissue task.
class WallsTask final : public Task {
 public:
  WallsTask(const Scene& scene, Inlet<HapticState>& state, Inlet<TickRecord>& records, Outlet<ContactPatch>& patch,
            const std::atomic<double>& stiffness)
      : state_(state),
        records_(records),
        patch_(patch),
        stiffness_(stiffness),
        world_(setup_of(scene)),
        period_(static_cast<std::uint32_t>(scene.loop.daq.rate_hz / kTissueRateHz)) {}

  std::uint32_t period() const override { return period_; }
  void run(std::uint64_t tick) override {
    const HapticState& state = state_.newest(tick);
    const StylusState& stylus = state.stylus;
    present_ = present_ || (stylus.loop == LoopState::kActive && stylus.X_TI.p.norm() < kInMiddle);
    ContactPatch& patch = patch_.begin(tick);
    world_.step(state, present_, patch);
    patch.material[0].stiffness_n_per_m = stiffness_.load(std::memory_order_relaxed);
    patch_.commit();
    moment_.record = records_.newest(tick);
    moment_.tissue = world_.frame();
    moment_.t_s = moment_.record.stylus.t_s;
    moment_.status.phase = present_ ? Phase::kRun : Phase::kReady;
    moment_.seen = true;
    if (observe) observe(moment_);
  }
  std::function<void(const RunMoment&)> observe;

 private:
  static TissueSetup setup_of(const Scene& scene) {
    TissueSetup setup;
    setup.organ_T = scene.organ_T.get();
    setup.tools = {{InstrumentKind::kProbe, scene.loop.tool}};
    return setup;
  }
  Inlet<HapticState>& state_;
  Inlet<TickRecord>& records_;
  Outlet<ContactPatch>& patch_;
  const std::atomic<double>& stiffness_;
  TissueWorld world_;
  std::uint32_t period_;
  bool present_ = false;
  RunMoment moment_;
};

/// Device, loop, hand and walls, whatever drives them.
struct NotchRig {
  NotchRig(const Scene& scene, std::unique_ptr<Hand> person, Timing timing)
      : backend(setup_backend(scene.setup)),
        state(make_channel<HapticState>(timing)),
        patch(make_channel<ContactPatch>(timing, kPatchDelay)),
        frames(make_channel<ExerciseFrame>(timing)),
        records(make_channel<TickRecord>(timing)),
        loop(scene.loop),
        haptic(*backend.daq, loop, {*patch, *state, records.get(), nullptr}, kLongest_s),
        hand(scene, haptic, *frames, std::move(person), *backend.world),
        walls(scene, *state, *records, *patch, stiffness) {}

  std::atomic<double> stiffness{kThesisWall_n_per_m};
  Backend backend;
  std::unique_ptr<Channel<HapticState>> state;
  std::unique_ptr<Channel<ContactPatch>> patch;
  std::unique_ptr<Channel<ExerciseFrame>> frames;
  std::unique_ptr<Channel<TickRecord>> records;
  HapticLoop loop;
  HapticTask haptic;
  HandTask hand;
  WallsTask walls;
};

}  // namespace

struct NotchRun::State {
  State(const AssetRoots& assets, std::int64_t seed, const Notch& given)
      : notch(given),
        scene(notch_scene(assets, seed, given)),
        rig(std::make_unique<NotchRig>(scene, std::make_unique<PersonHand>(link), Timing::kLive)) {
    rig->walls.observe = [this](const RunMoment& moment) { moments.write(moment); };
  }
  void run() noexcept;

  const Notch notch;
  const Scene scene;
  HandLink link;
  std::uint64_t intents = 0;
  std::unique_ptr<NotchRig> rig;
  Latest<RunMoment> moments;
  PauseSwitch pause;
  std::atomic<bool> stop{false}, finished{false};
  mutable std::mutex mutex;  // guards fault
  std::string fault;
  std::thread thread;
};

void NotchRun::State::run() noexcept {
  std::string why;
  try {
    ThreadedExecutor executor(scene.loop.daq.rate_hz, &pause);
    executor.add_lane("haptic", {&rig->hand, &rig->haptic}, kHapticPriority);
    executor.add_lane("walls", {&rig->walls}, kTissuePriority, 0.5);
    executor.run([this] { return stop.load(); });
    const Fault& fault_now = rig->haptic.record().stylus.fault;
    if (fault_now) why = fault_name(fault_now.code);
  } catch (const std::exception& error) {
    why = error.what();
  }
  const std::lock_guard<std::mutex> lock(mutex);
  fault = why;
  finished = true;
}

NotchRun::NotchRun(const AssetRoots& assets, std::int64_t seed, const Notch& notch)
    : state_(std::make_unique<State>(assets, seed, notch)) {
  state_->thread = std::thread([state = state_.get()] { state->run(); });
}

NotchRun::~NotchRun() {
  state_->stop = true;
  state_->thread.join();
}

const Scene& NotchRun::scene() const { return state_->scene; }
const Notch& NotchRun::notch() const { return state_->notch; }
const RunMoment& NotchRun::newest() { return state_->moments.read(); }
void NotchRun::steer(const HandIntent& intent) { state_->link.wanted.write({intent, ++state_->intents}); }
bool NotchRun::ready() const { return state_->link.ready.load(std::memory_order_acquire); }
void NotchRun::set_stiffness(double n_per_m) { state_->rig->stiffness.store(n_per_m); }
double NotchRun::stiffness() const { return state_->rig->stiffness.load(); }
void NotchRun::pause(bool paused) { state_->pause.set(paused); }
bool NotchRun::finished() const { return state_->finished.load(); }

std::string NotchRun::fault() const {
  const std::lock_guard<std::mutex> lock(state_->mutex);
  return state_->fault;
}

void run_notch(const Scene& scene, double stiffness_n_per_m, std::unique_ptr<Hand> hand, double seconds,
               const std::function<void(const RunMoment&)>& observe) {
  const auto rig = std::make_unique<NotchRig>(scene, std::move(hand), Timing::kLockstep);
  rig->stiffness = stiffness_n_per_m;
  rig->walls.observe = observe;
  LockstepExecutor executor;
  executor.add(rig->hand);
  executor.add(rig->haptic);
  executor.add(rig->walls);
  const double rate_hz = scene.loop.daq.rate_hz;
  std::uint64_t ticks = 0;
  executor.run([&] { return static_cast<double>(++ticks) >= seconds * rate_hz; });
}

}  // namespace trocar
