#include "app/cli/attempts/run_command.h"

#include <charconv>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <map>
#include <memory>

#include <CLI/CLI.hpp>

#include "app/cli/attempts/attempt_json.h"
#include "app/cli/attempts/replay_film.h"
#include "app/cli/command.h"
#include "app/cli/records/open_database.h"
#include "app/picture/attempt/attempt_picture.h"
#include "app/picture/films/video_writer.h"
#include "app/session/interrupt.h"
#include "app/session/keeping/attempt_keeping.h"
#include "app/session/keeping/live_attempt.h"
#include "app/session/setup/device_files.h"
#include "app/session/setup/patch_fit.h"
#include "app/session/setup/true_plant.h"
#include "haptics/device/backends/make_backend.h"
#include "haptics/input_error.h"
#include "scenarios/files/exercise_loader.h"
#include "scenarios/hands/make_hand.h"
#include "scenarios/layout/board_numbers.h"
#include "trainees/markup/pacing.h"
#include "trainees/records/attempt_store.h"

namespace trocar {
namespace {

constexpr const char* kGuestCode = "guest";  // runs that belong to no trainee

const std::map<std::string, InjectedFaultKind>& injection_kinds() {
  using Kind = InjectedFaultKind;
  static const std::map<std::string, Kind> kinds{{"encoder-jump", Kind::kEncoderJump},
                                                 {"encoder-stuck", Kind::kEncoderStuck},
                                                 {"channel-invalid", Kind::kChannelInvalid},
                                                 {"dac-stuck", Kind::kDacStuck},
                                                 {"missed-sync", Kind::kMissedSync},
                                                 {"hand-nan", Kind::kHandNaN},
                                                 {"hand-lets-go", Kind::kHandLetsGo},
                                                 {"delay", Kind::kDelay},
                                                 {"e-stop", Kind::kEmergencyStop},
                                                 {"deadman-open", Kind::kDeadmanOpen},
                                                 {"drive-fault", Kind::kDriveFault},
                                                 {"watchdog", Kind::kWatchdog},
                                                 {"beam-dark", Kind::kBeamDark},
                                                 {"beam-lit", Kind::kBeamLit},
                                                 {"over-temperature", Kind::kOverTemperature},
                                                 {"sensor-silence", Kind::kSensorSilence}};
  return kinds;
}

double number_in(const std::string& text, const std::string& whole) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) {
    throw InputError("--inject " + whole + ": '" + text + "' is not a number");
  }
  return value;
}

template <typename T>
T one_of(const std::string& option, const std::string& name, const std::map<std::string, T>& choices) {
  if (const auto found = choices.find(name); found != choices.end()) return found->second;
  std::string known;
  for (const auto& [choice, unused] : choices) known += (known.empty() ? "" : ", ") + choice;
  throw InputError(option + " " + name + ": unknown; known are " + known);
}

/// The board that was asked for, or one that no practice shows. @throws InputError: none of practice, or an exam's.
int board_of(const RunOptions& options) {
  const bool exam = options.level == kExamLevel;
  if (!options.board) return drawn_board(options.seed, exam);
  const std::string given = "--board " + std::to_string(*options.board);
  if (*options.board < 0 || *options.board >= kPracticeBoards) {
    throw InputError(given + ": practice boards are 0 to " + std::to_string(kPracticeBoards - 1));
  }
  if (exam) throw InputError(given + ": is for practice; an exam's board is unseen, and drawn by --seed");
  return *options.board;
}

void say_beginning(const Scene& scene, std::ostream& err) {
  err << "trocar: " << scene.setup.exercise.number << ' ' << scene.setup.exercise.title << ", " << scene.level.name
      << ", board " << scene.setup.board << ", hand " << scene.setup.hand << ", organ " << scene.organ.name
      << (scene.organ.synthetic ? " (synthetic)" : "") << ", on the simulated plant"
      << (scene.setup.plant ? " of " + plant_words(*scene.setup.plant) : "")
      << (scene.setup.backend == kSimulatedBackend ? "" : " behind " + scene.setup.backend) << '\n';
  const std::string plant = scene.setup.plant ? simulated_plant_words(plant_words(*scene.setup.plant))
                                              : simulated_plant_words(static_cast<std::uint64_t>(scene.setup.seed));
  const double spacing_m = scene.setup.exercise.layout.min_spacing_m;
  if (scene.board.spacing_m > 0 && scene.board.spacing_m < spacing_m)
    err << "trocar: the organ is small: targets lie from " << scene.board.spacing_m * 1e3 << " mm apart instead of "
        << spacing_m * 1e3 << " mm\n";
  const std::string turned = turned_words(scene.placement);
  if (!turned.empty()) err << "trocar: " << turned << '\n';
  for (const std::string& name : scene.adjacent.set_aside)
    err << "trocar: " << name << " lies over the region and is set aside: neither seen nor felt\n";
  for (const std::string& name : scene.thin_left_out)
    err << "trocar: " << name << " finds no place on this organ and is left out\n";
  for (const std::string& doubt : device_doubts(scene.setup.device, plant)) err << "trocar: " << doubt << '\n';
}

/// How the contacts stood to what the device can display; nothing when nothing was touched or nothing is known.
void print_stiffness(const StiffnessReport& s, std::ostream& out) {
  if (s.contact_ticks == 0) return;
  out << std::setprecision(0) << "contact  up to " << s.asked_max_n_per_m << " N/m asked of the device, K_max "
      << s.k_max_min_n_per_m << " to " << s.k_max_max_n_per_m << " N/m, above it for " << 100 * s.above_share
      << " % of the contact time, clamp " << (s.clamped ? "on" : "off") << std::setprecision(1) << '\n';
}

/// The receipt of a live run's loop.
void print_pace(const Pacing& pacing, std::ostream& out) {
  const char* head = "pace     ";
  for (const auto& [name, value] : pacing_facts(pacing)) {
    out << head << std::left << std::setw(26) << name << std::right << value << '\n';
    head = "         ";
  }
  out << head << std::left << std::setw(26) << "Ticks missed" << std::right << pacing.missed << '\n';
}

}  // namespace

InjectedFault parse_injection(const std::string& text) {
  const auto at = text.find('@');
  if (at == std::string::npos) throw InputError("--inject " + text + ": KIND[:CHANNEL[:VALUE]]@SECONDS[+DURATION]");
  std::string head = text.substr(0, at), when = text.substr(at + 1);
  InjectedFault fault;
  if (const auto plus = when.find('+'); plus != std::string::npos) {
    fault.duration_s = number_in(when.substr(plus + 1), text);
    when.resize(plus);
  }
  fault.at_s = number_in(when, text);
  std::optional<double> value;
  if (const auto colon = head.find(':'); colon != std::string::npos) {
    std::string channel = head.substr(colon + 1);
    head.resize(colon);
    if (const auto second = channel.find(':'); second != std::string::npos) {
      value = number_in(channel.substr(second + 1), text);
      channel.resize(second);
    }
    const double number = number_in(channel, text);
    if (number != std::floor(number) || number < 0 || number >= kChannels) {
      throw InputError("--inject " + text + ": channels are 0 to 6");
    }
    fault.channel = static_cast<int>(number);
  }
  fault.kind = one_of("--inject", head, injection_kinds());
  // Counts of a jump, SYNCs missed: enough to be a fault. Periods of delay: amid what a sick bus makes.
  fault.value = value.value_or(fault.kind == InjectedFaultKind::kDelay ? 5 : 1000);
  const std::string refused = injection_refusal(fault);
  if (!refused.empty()) throw InputError("--inject " + text + ": " + refused);
  return fault;
}

AttemptSetup attempt_setup(const RunOptions& options, const AssetRoots& assets) {
  AttemptSetup setup;
  setup.exercise = find_exercise(options.exercise, assets.exercises);
  setup.level = options.level;
  setup.organ = options.organ;
  setup.tissue = options.tissue.empty() ? setup.exercise.tissue : options.tissue;
  setup.hand = options.hand;
  setup.attempt = std::max(1, options.attempt);
  setup.seed = options.seed;
  setup.board = board_of(options);
  setup.backend = options.backend;
  setup.card = options.card;
  setup.force_sensor = options.force_sensor;
  setup.rate_hz = options.rate_hz;
  require_scripted(setup);
  setup.contact_law = one_of<ContactLaw>("--contact", options.contact_law,
                                         {{"proxy", ContactLaw::kProxy}, {"thesis", ContactLaw::kThesis}});
  std::map<std::string, PassivityLaw> laws;
  for (const PassivityLawName& known : kPassivityLaws) laws.emplace(known.name, known.law);
  setup.passivity_law = one_of<PassivityLaw>("--passivity", options.passivity_law, laws);
  setup.clamp_stiffness = options.clamp;
  setup.device = read_device_files(options.calibration, options.device);
  if (!options.plant.empty()) setup.plant = std::make_shared<const PlantFile>(load_plant(options.plant));
  setup.realtime = options.realtime;
  if (options.realtime) setup.pace = kSimulatedLivePace;
  for (const std::string& text : options.injections) setup.faults.push_back(parse_injection(text));
  return setup;
}

AttemptResult run_attempt(const RunOptions& options, const Scene& scene, const AssetRoots& assets, std::ostream& err,
                          const SessionObserver& observe) {
  make_hand(options.hand, 0, assets.hands);  // a wrong hand is refused before anything is stored
  if (std::filesystem::is_regular_file(options.record)) {
    throw InputError(options.record.string() + ": exists; a recording is never overwritten");
  }
  Database database = open_database(options.database, OpenMode::kCreate, err);
  AttemptStore store(database);
  AttemptStart start = attempt_start(scene, options.trainee);
  if (!options.record.empty()) start.recording = options.record;
  Scene taught = scene;
  if (options.attempt == 0)
    taught.setup.attempt = 1 + static_cast<int>(store.list({start.trainee, start.exercise_id}).size());
  const AttemptId id = store.begin_attempt(start);
  say_beginning(scene, err);
  SessionHooks hooks;
  LivePublisher live(database.file());
  LiveAttempt told(live_beginning(taught, "trocar run", start.trainee == kGuestCode ? "" : start.trainee, id.uuid));
  hooks.observe = told_live(live, told, observe);
  hooks.interrupted = options.interrupted;
  const auto [outcome, recording] = record_or_abort(store, id, taught, assets, hooks);
  for (const std::string& note : outcome.notes) err << "trocar: " << note << '\n';
  const AttemptResult result = kept_result(start, id, outcome, recording);
  store_or_say(store, id, result);
  if (!result.device.reason.empty()) err << "trocar: " << result.device.reason << '\n';
  if (outcome.patch_triangles_dropped > 0 && !patch_fit(scene).whole()) {
    err << "trocar: the surface is finer than need be: " << patch_fit(scene).words() << '\n';
  }
  return result;
}

int exit_code(const AttemptResult& result) {
  if (result.grade.status == AttemptStatus::kFault) return 4;
  return result.grade.passed ? 0 : 1;
}

void print_result(const AttemptResult& result, std::ostream& out) {
  const Grade& grade = result.grade;
  out << std::fixed << std::setprecision(1);
  out << "status   " << status_name(grade.status) << '\n';
  out << "score    ";
  if (grade.score)
    out << *grade.score << "  (" << grade.grade << ")\n";
  else
    out << "none  (" << grade.grade << ")\n";
  if (const std::string soft = soft_real_time(result.device); !soft.empty()) out << "mark     " << soft << '\n';
  for (const Subscore& s : grade.subscores) {
    out << "  " << std::left << std::setw(16) << s.name << std::right << std::setw(5) << 100 * s.value << " %  weight "
        << std::setw(4) << 100 * s.weight << " %" << (s.gate ? "  safety gate" : "") << '\n';
  }
  for (const Cap& cap : grade.caps) out << "cap      " << cap_sentence(cap) << '\n';
  print_stiffness(result.device.stiffness, out);
  if (const std::optional<Pacing> pacing = parse_pacing(result.device.realtime)) print_pace(*pacing, out);
  if (!result.device.fault.empty()) out << "fault    " << result.device.fault << '\n';
  if (!result.integrity.empty()) out << "reason   " << result.integrity << '\n';
  for (const DeviceWarning& w : result.device.warnings) {
    out << "warning  " << w.name << ", first at " << w.first_s << " s, " << w.ticks << " ticks\n";
  }
  out << "hash     " << result.state_hash << '\n';
  out << "attempt  " << result.uuid << '\n';
}

/// Pictures and film are taken while it runs; neither changes the result.
AttemptResult run_with_pictures(const RunOptions& options, const Scene& scene, const AssetRoots& assets,
                                std::ostream& err) {
  if (!options.video.empty() && !options.frames.empty()) throw InputError("--video and --frames: one of the two");
  if (options.video.empty() && options.frames.empty()) return run_attempt(options, scene, assets, err, {});
  const Preset preset = options.video.empty() ? Preset::kFull : film_preset("auto", err);
  AttemptPainter painter(assets, options.trainee, 1280, 720, preset);
  std::optional<VideoWriter> video;
  const double fps = options.fps.value_or(options.video.empty() ? 10 : 25);
  if (!options.video.empty()) video.emplace(options.video, 1280, 720, fps);
  const PictureSink sink =
      video ? PictureSink([&video](const Image& image) { video->add(image); }) : numbered_pictures(options.frames);
  FrameWriter frames(painter, sink, fps);
  const AttemptResult result =
      run_attempt(options, scene, assets, err, [&](const SessionView& view) { frames.observe(view); });
  if (video) video->close();
  err << "trocar: " << frames.written() << " frames in " << (video ? options.video : options.frames).string() << '\n';
  return result;
}

int run_command(const RunOptions& given, std::ostream& out, std::ostream& err) {
  InterruptWatch interrupt;  // before any library starts threads: they must inherit what it blocks
  RunOptions options = given;
  if (!options.interrupted) options.interrupted = [&] { return interrupt.seen(); };
  const AssetRoots assets = find_assets();
  const AttemptSetup setup = attempt_setup(options, assets);
  const Scene scene = build_scene(setup, assets, backend_capabilities(setup.backend, setup.rate_hz));
  const AttemptResult result = run_with_pictures(options, scene, assets, err);
  if (options.json)
    out << attempt_json(result);
  else
    print_result(result, out);
  return exit_code(result);
}

void add_run(CLI::App& parent, CommandAction& chosen) {
  const auto given = std::make_shared<RunOptions>();
  RunOptions& o = *given;
  CLI::App* run = add_command(parent, "run", "One scripted, headless attempt (lockstep), recorded, graded and stored",
                              chosen, [given] { return run_command(*given, std::cout, std::cerr); });
  run->add_option("exercise", o.exercise, "Exercise id, number or FILE.toml")->required();
  run->add_option("--hand", o.hand,
                  "expert, intermediate, novice, clumsy, speed-runner, heavy-handed, idle, learner, population#1, or "
                  "SCRIPT.toml")
      ->required();
  run->add_option("--attempt", o.attempt,
                  "Attempt of the learner, from 1 (default: one more than the trainee has stored)")
      ->check(CLI::Range(1, 100000));
  run->add_option("--level", o.level,
                  "Level: L1, L2, L3, or exam, where a trainee meets each board of an exercise once")
      ->capture_default_str();
  run->add_option("--seed", o.seed, "Seed of everything random")->capture_default_str();
  run->add_option("--board", o.board,
                  "Practice board 0-19, refused at level exam (default: an unseen one drawn by the seed)");
  run->add_option("--trainee", o.trainee, "Trainee code, created when new")->capture_default_str();
  run->add_option("--db", o.database, "Database file, or :memory:")->check(writable_path());
  run->add_option("--organ", o.organ, kOrganForms)->capture_default_str();
  add_tissue_option(*run, o.tissue);
  run->add_option("--record", o.record, "Recording file (default: beside the database)")->check(writable_path());
  run->add_option("--frames", o.frames, "Folder for PNG frames")->check(writable_path());
  run->add_option("--video", o.video, "Film: FILE.mp4, .webm or .mkv, by ffmpeg")->check(writable_path());
  run->add_option("--fps", o.fps, "Frames per second of loop time (default: 10, of a film 25)")
      ->check(CLI::Range(0.1, 50.0));
  std::string backends;
  for (const std::string& name : backend_names())
    if (backend_capabilities(name, 1000).motors) backends += (backends.empty() ? "" : ", ") + name;
  run->add_option("--backend", o.backend, "Device that it runs on: " + backends)->capture_default_str();
  run->add_option("--card", o.card, kCardForms);
  run->add_option("--sensor", o.force_sensor, kSensorForms);
  run->add_option("--rate", o.rate_hz, "Loop rate, Hz")
      ->capture_default_str()
      ->check(CLI::IsMember({1000, 2000, 4000}));
  run->add_option("--contact", o.contact_law, "Contact law: proxy, or thesis as baseline")->capture_default_str();
  run->add_option("--passivity", o.passivity_law, "Passivity law: budgeted, increment or off")->capture_default_str();
  run->add_flag("--clamp", o.clamp, "Weaken contacts stiffer than K_max, what the device can display, to it");
  add_device_file_options(*run, o.calibration, o.device);
  run->add_option("--inject", o.injections,
                  "Device fault KIND[:CHANNEL[:VALUE]]@SECONDS[+DURATION], repeatable: encoder-jump, encoder-stuck, "
                  "channel-invalid, dac-stuck, missed-sync, delay, sensor-silence, watchdog, e-stop, deadman-open, "
                  "drive-fault, over-temperature, beam-dark, beam-lit, hand-nan, hand-lets-go");
  run->add_option("--plant", o.plant, "Plant file of the simulated device, instead of the seed's")->check(file_name());
  run->add_flag("--realtime", o.realtime, "Live: threads and the clock instead of lockstep");
  run->add_flag("--json", o.json, "Result as JSON on stdout");
}

}  // namespace trocar
