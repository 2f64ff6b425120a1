#include "app/window/attempt/attempt_runner.h"

#include <atomic>
#include <chrono>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <thread>

#include "app/session/grading/recorded_result.h"
#include "app/session/keeping/attempt_keeping.h"
#include "app/window/attempt/disk_room.h"
#include "app/window/attempt/motor_memory.h"
#include "app/window/attempt/person_hand.h"
#include "app/window/attempt/step_gate.h"
#include "haptics/device/backends/make_backend.h"
#include "haptics/input_error.h"
#include "scenarios/hands/make_hand.h"
#include "trainees/files/free_room.h"

namespace trocar {
namespace {

constexpr int kBusy_ms = 1000;           // the window waits for the database no longer than this
constexpr double kBeyondLimits_s = 120;  // homing and reading, beyond the run's time and as much of waiting for it
constexpr std::chrono::milliseconds kAskAgain{200};

/// Where what nobody grades is recorded to.
class Nowhere final : public RecordingSink {
 public:
  void append(std::string_view) override {}
  void sync() override {}
};

AttemptSetup paced(AttemptSetup setup, bool by_clock) {
  setup.realtime = by_clock;
  if (setup.pace == PaceLimits{} && !is_real_device(setup.backend)) setup.pace = kSimulatedLivePace;
  return setup;
}

std::shared_ptr<const Scene> paced_scene(Scene scene, bool by_clock) {
  scene.setup = paced(std::move(scene.setup), by_clock);
  return std::make_shared<const Scene>(std::move(scene));
}

/// A real device's motors are as warm as they were left. @throws EnvironmentError: too hot to begin.
std::shared_ptr<const Scene> warm_scene(std::shared_ptr<const Scene> scene) {
  if (!is_real_device(scene->setup.backend)) return scene;
  const MotorMemory memory(motor_folder(), scene->setup.backend, scene->setup.card);
  const MotorStates motors = memory.now();
  if (const std::string hot = too_hot_to_begin(motors); !hot.empty()) throw EnvironmentError(hot);
  auto warm = std::make_shared<Scene>(*scene);
  warm->setup.motors = warm->loop.motors = motors;
  return warm;
}

/// @throws EnvironmentError: no room. InputError: no such hand.
Database checked_database(const AttemptRequest& request, const Scene& scene, const AssetRoots& assets) {
  if (!request.steered)
    make_hand(scene.setup.hand, 0, assets.hands);  // a wrong one is refused before anything is stored
  const std::filesystem::path file = !request.graded            ? ":memory:"
                                     : request.database.empty() ? default_database_path()
                                                                : request.database;
  if (file != ":memory:") {
    const double rate_hz = scene.loop.daq.rate_hz;
    require_room(file.parent_path(), room_needed(2 * scene.level.time_limit_s + kBeyondLimits_s, rate_hz),
                 room_free(file.parent_path()));
  }
  return Database(file, OpenMode::kCreate, kBusy_ms);
}

}  // namespace

struct AttemptRunner::State {
  State(const AttemptRequest& request, const AssetRoots& assets_in, std::shared_ptr<const Scene> scene_in)
      : steered(request.steered),
        steps(request.steps),
        graded(request.graded),
        assets(assets_in),
        scene(warm_scene(std::move(scene_in))),
        database(checked_database(request, *scene, assets)),
        store(database),
        start(attempt_start(*scene, request.trainee, request.session)),
        id(store.begin_attempt(start)) {
    for (const RecoveredAttempt& attempt : database.recovered())
      note("attempt " + attempt.uuid + " of " + attempt.trainee + " was cut off and is now kept as aborted");
  }

  void note(const std::string& line) {
    const std::lock_guard<std::mutex> lock(mutex);
    if (notes.empty() || notes.back() != line) notes.push_back(line);
  }
  void keep_warmth(const MotorStates& motors) noexcept;
  void show(const SessionView& view);
  void run() noexcept;
  void record_and_grade();
  void keep();
  void end_without_grade(const std::string& why) noexcept;

  const bool steered;
  StepGate* const steps;
  const bool graded;
  const AssetRoots assets;
  const std::shared_ptr<const Scene> scene;
  Database database;  // the caller's thread until the attempt's begins, then that one's
  AttemptStore store;
  const AttemptStart start;
  const AttemptId id;

  Latest<RunMoment> moments;
  HandLink link;
  std::uint64_t intents = 0;  // window's
  PauseSwitch pause;
  MarkCount marks{0}, messages{0};
  std::atomic<bool> plugged{true};
  std::atomic<bool> abort{false}, give_up{false}, finished{false}, stored{false};

  AttemptResult result;  // before `finished` the attempt's thread's, then anybody's to read
  std::exception_ptr thrown;
  mutable std::mutex mutex;  // guards notes
  std::vector<std::string> notes;
  std::thread thread;
};

/// In the recorder's thread, or at the end in the attempt's.
void AttemptRunner::State::keep_warmth(const MotorStates& motors) noexcept {
  try {
    MotorMemory(motor_folder(), scene->setup.backend, scene->setup.card).keep(motors);
  } catch (const std::exception& error) {
    note("how warm the motors are is not kept: " + std::string(error.what()));
  }
}

/// In the tissue task's thread: copies, and waits for nobody.
void AttemptRunner::State::show(const SessionView& view) {
  RunMoment& moment = moments.back();
  moment.steered = link.felt.load(std::memory_order_acquire);
  moment.record = view.record;
  moment.status = view.director.status();
  if (view.tissue) moment.tissue = *view.tissue;
  moment.organ_T = view.organ_T;
  moment.thin_T = view.thin_T;
  moment.t_s = view.t_s;
  moment.seen = true;
  moments.publish();
  if (steps) steps->reach(view.t_s);
}

void AttemptRunner::State::record_and_grade() {
  SessionHooks hooks;
  hooks.observe = [this](const SessionView& view) { show(view); };
  hooks.observe_each_step = true;
  hooks.interrupted = [this] { return abort.load(); };
  if (steered)
    hooks.hand = [this] {
      return std::make_unique<PersonHand>(link, scene->loop.daq.motors ? std::nullopt : std::optional(entry_T(*scene)),
                                          &pause);
    };
  if (!steps) hooks.pause = &pause;
  hooks.marks = &marks;
  hooks.messages = &messages;
  if (is_real_device(scene->setup.backend)) hooks.motors = [this](const MotorStates& motors) { keep_warmth(motors); };
  if (scene->level.name != kExamLevel) hooks.board_answers = [this] { return plugged.load(std::memory_order_relaxed); };
  if (!graded) {
    Nowhere nowhere;
    RecordingWriter writer(nowhere, scene_json(*scene), scene->loop.daq.rate_hz);
    result.grade.status = run_session(*scene, assets, hooks, writer).status;
    return;
  }
  const auto [outcome, recording] = record_or_abort(store, id, *scene, assets, hooks);
  for (const std::string& line : outcome.notes) note(line);
  result = kept_result(start, id, outcome, recording);
}

/// A busy database is asked again until it takes the result or nobody waits for it any more.
void AttemptRunner::State::keep() {
  for (;;) {
    const bool last = give_up.load();
    try {
      store_or_say(store, id, result);
      stored.store(true);
      return;
    } catch (const EnvironmentError& error) {
      note(error.what());
    }
    if (last) return;
    std::this_thread::sleep_for(kAskAgain);
  }
}

void AttemptRunner::State::run() noexcept {
  try {
    record_and_grade();
    if (steps) steps->close();
    finished.store(true);
    if (graded) keep();
  } catch (const std::exception& error) {
    if (steps) steps->close();
    note(error.what());
    if (!finished.load()) {
      thrown = std::current_exception();
      end_without_grade(error.what());
    }  // else graded, but the store refuses it: the result is shown all the same
    finished.store(true);
  }
}

/// No attempt stays "running" in the database while the program lives on.
void AttemptRunner::State::end_without_grade(const std::string& why) noexcept {
  try {
    AttemptResult none;
    none.grade.grade = "not graded";
    none.integrity = why;
    store.finish_attempt(id, none);
  } catch (const std::exception&) {
    // It has ended already (a full disk), or the database is ill too: it is then ended when it is next opened.
  }
}

AttemptRunner::AttemptRunner(const AttemptRequest& request, const AssetRoots& assets)
    : AttemptRunner(request, assets,
                    std::make_shared<const Scene>(
                        build_scene(paced(request.setup, request.steps == nullptr), assets,
                                    backend_capabilities(request.setup.backend, request.setup.rate_hz)))) {}

AttemptRunner::AttemptRunner(const AttemptRequest& request, const AssetRoots& assets,
                             std::shared_ptr<const Scene> scene)
    : state_(std::make_unique<State>(request, assets,
                                     scene->setup.realtime != (request.steps == nullptr)
                                         ? paced_scene(*scene, request.steps == nullptr)
                                         : std::move(scene))) {
  if (request.steps) request.steps->open();
  state_->thread = std::thread([state = state_.get()] { state->run(); });
}

AttemptRunner::~AttemptRunner() {
  state_->abort.store(true);
  state_->give_up.store(true);
  if (state_->steps) state_->steps->close();
  state_->thread.join();
}

const Scene& AttemptRunner::scene() const { return *state_->scene; }
std::shared_ptr<const Scene> AttemptRunner::shared_scene() const { return state_->scene; }
const RunMoment& AttemptRunner::newest() { return state_->moments.read(); }

std::uint64_t AttemptRunner::steer(const HandIntent& intent) {
  state_->link.wanted.write({intent, ++state_->intents});
  return state_->intents;
}

bool AttemptRunner::ready() const { return state_->link.ready.load(std::memory_order_acquire); }
const HandIntent& AttemptRunner::target() { return state_->link.target.read(); }

bool AttemptRunner::pause(bool paused) {
  if (paused && state_->scene->level.name == kExamLevel) return false;
  if (paused && !backend_abilities(state_->scene->setup.backend).pause) return false;  // an arm cannot hang in the air
  state_->pause.set(paused);
  return true;
}

bool AttemptRunner::paused() const { return state_->pause.paused(); }
bool AttemptRunner::plug(bool in) {
  if (!in && state_->scene->level.name == kExamLevel) return false;
  state_->plugged.store(in);
  return true;
}
bool AttemptRunner::board_answers() const { return !state_->pause.asked_by(PauseSwitch::Cause::kBoard); }
void AttemptRunner::mark() { state_->marks.fetch_add(1); }
void AttemptRunner::mark_message() { state_->messages.fetch_add(1); }
const std::string& AttemptRunner::attempt() const { return state_->id.uuid; }
void AttemptRunner::abort() { state_->abort.store(true); }
bool AttemptRunner::finished() const { return state_->finished.load(); }
bool AttemptRunner::stored() const { return state_->stored.load(); }

const AttemptResult& AttemptRunner::result() const {
  while (state_->abort.load() && !finished()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  if (!finished()) throw std::logic_error("AttemptRunner: no result before the end");
  if (state_->thrown) std::rethrow_exception(state_->thrown);
  return state_->result;
}

std::vector<std::string> AttemptRunner::notes() const {
  const std::lock_guard<std::mutex> lock(state_->mutex);
  return state_->notes;
}

}  // namespace trocar
