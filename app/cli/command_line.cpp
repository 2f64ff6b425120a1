#include "app/cli/command_line.h"

#include <functional>
#include <iostream>

#include <CLI/CLI.hpp>

#include "app/cli/attempts/catalogue_command.h"
#include "app/cli/attempts/check_command.h"
#include "app/cli/attempts/demo_command.h"
#include "app/cli/attempts/picture_command.h"
#include "app/cli/attempts/recording_command.h"
#include "app/cli/attempts/run_command.h"
#include "app/cli/attempts/sweep_command.h"
#include "app/cli/bench/bench_command.h"
#include "app/cli/command_line_export.h"
#include "app/cli/command_line_organs.h"
#include "app/cli/command_line_practice.h"
#include "app/cli/command_line_review.h"
#include "app/cli/command_line_texts.h"
#include "app/cli/command_line_trainees.h"
#include "app/cli/device/device_calibrate.h"
#include "app/cli/device/device_command.h"
#include "app/cli/device/device_forward.h"
#include "app/cli/device/device_monitor.h"
#include "app/cli/device/device_plant.h"
#include "app/cli/device/device_selftest.h"
#include "app/cli/device/identify_command.h"
#include "app/cli/doctor_command.h"
#include "app/cli/records/export_command.h"
#include "app/session/setup/scene.h"
#include "app/session/setup/typed_path.h"
#include "app/studies/study_command.h"
#include "haptics/input_error.h"

namespace trocar {
namespace {

const CLI::Validator kNamed(
    [](std::string& file) { return file.empty() ? std::string("is empty: a file is asked for") : std::string(); },
    "FILE");
const CLI::Validator kPlaced([](std::string& path) { return typed_path_fault(path); }, "PATH");
constexpr const char* kVersionLine = "trocar " TROCAR_VERSION;
const CLI::Range kSeed(0.0, 9e18, "SEED");

/// Options of every subcommand, and the one that was chosen.
struct CommandLine {
  CLI::App app{"Trocar: laparoscopic surgery training simulator round a 6-DOF haptic device"};
  std::function<int()> chosen;

  RunOptions run;
  SweepOptions sweep;
  RecordingOptions recording;
  std::string jigsaws_side;
  DemoOptions demo;
  bool headless = false;
  BenchOptions bench;
  StudyOptions study;
  ExercisesOptions exercises;
  CheckOptions check;
  std::filesystem::path table_in, table_out, device_file;
  IdentifyOptions identify;
  ForwardOptions forward;
  CalibrateOptions calibrate;
  SelfTestOptions selftest;
  MonitorOptions monitor;
  PlantOptionsGiven plant;
  std::shared_ptr<OrganCommandLine> organs;
  std::shared_ptr<PracticeCommandLine> practice;
  std::shared_ptr<ReviewCommandLine> review;
  std::shared_ptr<TraineeCommandLine> trainees;
  std::shared_ptr<ExportCommandLine> exports;
  DoctorOptions doctor;
  PictureOptions picture;
  std::string shell;

  /// A subcommand that runs `action` when chosen.
  CLI::App* add(CLI::App& parent, const char* name, const char* help, std::function<int()> action) {
    CLI::App* command = parent.add_subcommand(name, help);
    command->callback([this, action = std::move(action)] { chosen = action; });
    return command;
  }
  /// A group of subcommands.
  CLI::App* group(const char* name, const char* help) {
    CLI::App* command = app.add_subcommand(name, help);
    command->require_subcommand(1);
    return command;
  }
};

void add_run(CommandLine& c) {
  CLI::App* run = c.add(c.app, "run", "One scripted, headless attempt (lockstep), recorded, graded and stored",
                        [&c] { return run_command(c.run, std::cout, std::cerr); });
  run->add_option("exercise", c.run.exercise, "Exercise id, number or FILE.toml")->required();
  run->add_option("--hand", c.run.hand,
                  "expert, intermediate, novice, clumsy, speed-runner, heavy-handed, idle, learner, or SCRIPT.toml")
      ->required();
  run->add_option("--attempt", c.run.attempt,
                  "Attempt of the learner, from 1 (default: one more than the trainee has stored)")
      ->check(CLI::Range(1, 100000));
  run->add_option("--level", c.run.level,
                  "Level: L1, L2, L3, or exam, where a trainee meets each board of an exercise once")
      ->capture_default_str();
  run->add_option("--seed", c.run.seed, "Seed of everything random")->capture_default_str();
  run->add_option("--board", c.run.board,
                  "Practice board 0-19, refused at level exam (default: an unseen one drawn by the seed)");
  run->add_option("--trainee", c.run.trainee, "Trainee code, created when new")->capture_default_str();
  run->add_option("--db", c.run.database, "Database file, or :memory:")->check(kPlaced);
  run->add_option("--organ", c.run.organ,
                  "NAME.organ.toml, NAME.scene.toml (#ORGAN behind it: another subject) or a shipped organ")
      ->capture_default_str();
  run->add_option("--record", c.run.record, "Recording file (default: beside the database)")->check(kPlaced);
  run->add_option("--frames", c.run.frames, "Folder for PNG frames")->check(kPlaced);
  run->add_option("--video", c.run.video, "Film: FILE.mp4, .webm or .mkv, by ffmpeg")->check(kPlaced);
  run->add_option("--fps", c.run.fps, "Frames per second of loop time (default: 10, of a film 25)")
      ->check(CLI::Range(0.1, 50.0));
  std::string backends;
  for (const std::string& name : backend_names()) backends += (backends.empty() ? "" : ", ") + name;
  run->add_option("--backend", c.run.backend, "Device that it runs on: " + backends)->capture_default_str();
  run->add_option("--rate", c.run.rate_hz, "Loop rate, Hz")
      ->capture_default_str()
      ->check(CLI::IsMember({1000, 2000, 4000}));
  run->add_option("--contact", c.run.contact_law, "Contact law: proxy, or thesis as baseline")->capture_default_str();
  run->add_option("--passivity", c.run.passivity_law,
                  "Passivity law: budgeted, distributed, increment, cap, reference, thesis or off")
      ->capture_default_str();
  run->add_flag("--clamp", c.run.clamp, "Weaken contacts stiffer than K_max, what the device can display, to it");
  run->add_option("--calibration", c.run.calibration,
                  "Amplifier gains and offsets from device calibrate (default: nominal)")
      ->check(kNamed);
  run->add_option("--device", c.run.device, "Weights and friction from device identify (default: nominal)")
      ->check(kNamed);
  run->add_option("--inject", c.run.injections,
                  "Device fault KIND[:CHANNEL[:VALUE]]@SECONDS[+DURATION], repeatable: encoder-jump, encoder-stuck, "
                  "channel-invalid, dac-stuck, missed-sync, delay, sensor-silence, watchdog, e-stop, deadman-open, "
                  "drive-fault, over-temperature, hand-nan, hand-lets-go");
  run->add_option("--plant", c.run.plant, "Plant file of the simulated device, instead of the seed's")->check(kNamed);
  run->add_flag("--realtime", c.run.realtime, "Live: threads and the clock instead of lockstep");
  run->add_flag("--json", c.run.json, "Result as JSON on stdout");
}

void add_sweep(CommandLine& c) {
  CLI::App* sweep = c.add(c.app, "sweep", "Many scripted attempts: does the score tell skill apart?",
                          [&c] { return sweep_command(c.sweep, std::cout, std::cerr); });
  sweep->add_option("exercise", c.sweep.exercises, "Exercise ids, numbers or files (default: all)");
  sweep->add_option("--hand", c.sweep.hands, "Hands, separated by commas")->delimiter(',')->capture_default_str();
  sweep->add_option("--level", c.sweep.levels, "Levels, separated by commas (default: all)")->delimiter(',');
  sweep->add_option("--seeds", c.sweep.seeds, "First and last seed, A..B")->capture_default_str();
  sweep
      ->add_option("--organ", c.sweep.organ,
                   "NAME.organ.toml, NAME.scene.toml (#ORGAN behind it: another subject) or a shipped organ")
      ->capture_default_str();
  sweep->add_option("--jobs", c.sweep.jobs, "Attempts at once (0: one a processor)")
      ->capture_default_str()
      ->check(CLI::Range(0, 256));
  sweep->add_flag("--json", c.sweep.json, "As JSON");
}

void add_recordings(CommandLine& c) {
  CLI::App* replay = c.add(c.app, "replay", "Run the loop again from a recording",
                           [&c] { return replay_command(c.recording, std::cout, std::cerr); });
  replay->add_flag("--verify", c.recording.verify, "Compare the state hash with the recorded one");
  replay->add_option("--frames", c.recording.frames, "Folder for PNG frames")->check(kPlaced);
  replay->add_option("--video", c.recording.video, "Film: FILE.mp4, .webm or .mkv, by ffmpeg")->check(kPlaced);
  replay->add_option("--fps", c.recording.fps, "Frames per second (default: 10, of a film 25)")
      ->check(CLI::Range(0.1, 60.0));
  replay->add_option("--speed", c.recording.speed, "Of the film: 0.25 is slow motion, 4 four times as fast")
      ->capture_default_str()
      ->check(CLI::Range(0.05, 20.0));
  replay->add_option("--width", c.recording.width, "Of the pictures, px: from 320, with --beside from 720")
      ->capture_default_str()
      ->check(CLI::Range(320, 7680));
  replay->add_option("--height", c.recording.height, "Of the pictures, px: from 240, with --beside from 400")
      ->capture_default_str()
      ->check(CLI::Range(240, 4320));
  replay
      ->add_option("--preset", c.recording.preset,
                   "Of a film's pictures: potato, soft, full, or auto: full, and soft where no GPU draws")
      ->capture_default_str()
      ->check(CLI::IsMember({"auto", "potato", "soft", "full"}));
  replay->add_option("--beside", c.recording.beside, "Second run in the same film: recording, attempt, or 'expert'")
      ->check(kNamed);
  replay->add_option("--organ", c.recording.organ, "Where the recorded organ lies now");
  CLI::App* score = c.add(c.app, "score", "Grade again from the raw record", [&c] {
    if (!c.jigsaws_side.empty())
      return kinematics_command({c.recording.subject, c.jigsaws_side, c.recording.json}, std::cout);
    return score_command(c.recording, std::cout, std::cerr);
  });
  CLI::Option* rubric = score->add_option("--rubric", c.recording.rubric, "Exercise file whose rubric to use instead");
  score
      ->add_option("--jigsaws", c.jigsaws_side,
                   "Not a recording but kinematics of 76 columns: motion metrics of the right or left tool")
      ->check(CLI::IsMember({"right", "left"}))
      ->excludes(rubric);
  score->add_flag("--json", c.recording.json, "Result as JSON on stdout");
  for (CLI::App* command : {replay, score}) {
    command->add_option("recording", c.recording.subject, "Recording file or attempt (UUID part, 'latest')")
        ->required();
    command->add_option("--db", c.recording.database, "Database file");
  }
}

void add_first_contact(CommandLine& c) {
  CLI::App* demo = c.add(c.app, "demo", "The whole chain once: picture, score, report",
                         [&c] { return demo_command(c.demo, std::cout, std::cerr); });
  demo->add_flag("--headless", c.headless, "Without a window, as it always is; trocar practice is the window");
  demo->add_option("--out", c.demo.output, "Folder")->capture_default_str()->check(kPlaced);
  demo->add_option("--video", c.demo.video, "Film of it too: FILE.mp4, .webm or .mkv, by ffmpeg")->check(kPlaced);
  demo->add_option("--exercise", c.demo.exercise, "Identifier of the exercise, or its TOML file")
      ->capture_default_str();
  demo->add_option("--level", c.demo.level, "L1, L2, L3 or exam")->capture_default_str();
  demo->add_option("--organ", c.demo.organ,
                   "NAME.organ.toml, NAME.scene.toml (#ORGAN behind it: another subject) or a shipped organ")
      ->capture_default_str();
  CLI::App* bench = c.add(c.app, "bench", "What one tick, one picture and the organ compiler cost",
                          [&c] { return bench_command(c.bench, std::cout, std::cerr); });
  bench
      ->add_option("--organ", c.bench.organ,
                   "NAME.organ.toml, NAME.scene.toml (#ORGAN behind it: another subject) or a shipped organ")
      ->capture_default_str();
  bench->add_flag("--json", c.bench.json, "As JSON");
  std::string studies;
  for (const std::string& name : study_names()) studies += (studies.empty() ? "" : ", ") + name;
  CLI::App* study = c.add(c.app, "study", "Do an experiment again: data, plots, summary",
                          [&c] { return study_command(c.study, std::cout, std::cerr); });
  study->add_option("name", c.study.name, "One of: " + studies)->required();
  study->add_option("--out", c.study.out, "Folder")->required()->check(kPlaced);
  study->add_flag("--quick", c.study.quick, "Fewer trials of the same kind");
  study
      ->add_option("--plant", c.study.plant,
                   "Plant file of the device, instead of the seed's: gravity, transparency, plant")
      ->check(kNamed);
  study->add_option("--seed", c.study.seed, "Of everything that is drawn")->capture_default_str()->check(kSeed);
  study->add_flag("--json", c.study.json, "Summary as JSON");
  c.add(c.app, "version", "Version of the program", [] {
    std::cout << kVersionLine << '\n';
    return 0;
  });
}

void add_picture(CommandLine& c) {
  std::string scenes;
  for (const std::string& name : picture_scenes()) scenes += (scenes.empty() ? "" : ", ") + name;
  CLI::App* picture = c.add(c.app, "picture", "A picture of the show scene, as this machine draws it",
                            [&c] { return picture_command(c.picture, find_assets().assets, std::cout, std::cerr); });
  picture->add_option("--out", c.picture.output, "PNG file")->required()->check(kPlaced);
  picture->add_option("--scene", c.picture.scene, "One of: " + scenes)->capture_default_str();
  picture->add_option("--preset", c.picture.preset, "potato, soft, full, or auto: chosen by timing")
      ->capture_default_str();
  picture->add_option("--scope", c.picture.scope, "Tip of the scope: 0 or 30 degrees")->capture_default_str();
  picture->add_option("--post", c.picture.post_deg, "Degrees by which the light post is turned")->capture_default_str();
  picture->add_option("--width", c.picture.width, "Pixels")->capture_default_str();
  picture->add_option("--height", c.picture.height, "Pixels")->capture_default_str();
  picture->add_flag("--no-grain", c.picture.no_grain, "Without sensor grain: smaller files");
  picture->add_option("--seed", c.picture.seed, "Of lumps and lobes")->capture_default_str()->check(kSeed);
}

void add_catalogue(CommandLine& c) {
  CLI::App* exercises = c.add(c.app, "exercises", "The catalogue of exercises",
                              [&c] { return exercises_command(c.exercises, std::cout, std::cerr); });
  exercises->add_flag("--json", c.exercises.json, "As JSON");
  exercises->add_option("--explain", c.exercises.explain, "Explain a metric, an exercise or a sub-score");
  CLI::App* check = c.add(c.app, "check", "Prove that the device can do what exercises ask for",
                          [&c] { return check_command(c.check, std::cout, std::cerr); });
  check->add_option("exercise", c.check.subjects, "Exercise ids or files")->required();
  check->add_option("--organ", c.check.organ, "Organ to lay the boards on")->capture_default_str();
  check->add_option("--unseen", c.check.unseen, "Boards of graded runs to prove besides the practice boards 0 to 19")
      ->capture_default_str()
      ->check(CLI::Range(0, 1000));
  check->add_option("--map", c.check.map, "SVG of the force that the device can give over the board")->check(kPlaced);
  check
      ->add_option("--inversion", c.check.inversion,
                   "Folder for two pictures of one hand motion, direct and through a port")
      ->check(kPlaced);
  check->add_flag("--json", c.check.json, "As JSON");
}

void add_device_bench(CommandLine& c, CLI::App& device) {
  CLI::App* fk = c.add(device, "fk", "All eight forward solutions of joint angles",
                       [&c] { return device_forward(c.forward, std::cout, std::cerr); });
  fk->add_option("--deg", c.forward.angle_deg, "th1,...,th6 in degrees")->delimiter(',');
  fk->add_option("--csv", c.forward.table_in, "Input table instead of --deg");
  fk->add_option("--out", c.forward.table_out, "Output table")->check(kPlaced);
  fk->add_flag("--json", c.forward.json, "As JSON");
  CLI::App* calibrate = c.add(device, "calibrate", "Gain and offset of the amplifiers, found on a bench rig",
                              [&c] { return device_calibrate(c.calibrate, std::cout, std::cerr); });
  calibrate->add_option("--seed", c.calibrate.seed, "Of the simulated device and the rig")
      ->capture_default_str()
      ->check(kSeed);
  calibrate->add_option("--gain", c.calibrate.gain, "Of the simulated amplifiers over nominal (the thesis': 5)")
      ->capture_default_str();
  calibrate->add_option("--out", c.calibrate.out, "Calibration as JSON")->check(kPlaced);
  calibrate->add_option("--check", c.calibrate.check, "A calibration file: how well does it render on this device?");
  calibrate->add_option("--plant", c.calibrate.plant, "Plant file of the device, instead of the seed's")->check(kNamed);
  calibrate->add_flag("--json", c.calibrate.json, "As JSON");
}

void add_device_board(CommandLine& c, CLI::App& device) {
  CLI::App* selftest = c.add(device, "selftest", "What the back-end owes the loop, check by check; 4 when one fails",
                             [&c] { return device_selftest(c.selftest, std::cout, std::cerr); });
  selftest->add_flag("--json", c.selftest.json, "As JSON");
  CLI::App* monitor = c.add(device, "monitor", "Live values of the device loop, ten times a second",
                            [&c] { return device_monitor(c.monitor, std::cout, std::cerr); });
  monitor->add_option("--seconds", c.monitor.seconds, "Until it ends by itself")
      ->capture_default_str()
      ->check(CLI::Range(0.1, 86400.0));
  monitor->add_flag("--lockstep", c.monitor.lockstep, "As fast as it goes instead of by the clock");
  monitor->add_option("--calibration", c.monitor.calibration, "Amplifier gains and offsets from device calibrate")
      ->check(kNamed);
  monitor->add_option("--device", c.monitor.device, "Weights and friction from device identify")->check(kNamed);
  monitor->add_flag("--json", c.monitor.json, "A JSON object a line");
  selftest->add_option("--seed", c.selftest.seed, "Of the simulated device")->capture_default_str()->check(kSeed);
  selftest->add_option("--rate", c.selftest.rate_hz, "SYNC rate, Hz")
      ->capture_default_str()
      ->check(CLI::IsMember({1000, 2000, 4000}));
  selftest->add_option("--inject", c.selftest.injections, "Device fault as in run, repeatable: see a check fail");
  monitor->add_option("--seed", c.monitor.seed, "Of the simulated device")->capture_default_str()->check(kSeed);
  monitor->add_option("--rate", c.monitor.rate_hz, "Loop rate, Hz")
      ->capture_default_str()
      ->check(CLI::IsMember({1000, 2000, 4000}));
  monitor->add_option("--inject", c.monitor.injections, "Device fault as in run, repeatable");
}

void add_device_plant(CommandLine& c, CLI::App& device) {
  CLI::App* plant =
      c.add(device, "plant", "The simulated device as a plant file, every value with its source; or the check of one",
            [&c] { return device_plant(c.plant, std::cout, std::cerr); });
  plant->add_option("--seed", c.plant.seed, "The device that this seed draws (default: the nominal one)")->check(kSeed);
  plant->add_flag("--all", c.plant.all, "Draw also what seeds leave nominal");
  plant->add_option("--plant", c.plant.plant, "Plant file: check it and print it complete")->check(kNamed);
  plant->add_option("--out", c.plant.out, "File instead of standard output")->check(kPlaced);
}

void add_device(CommandLine& c) {
  CLI::App* device = c.group("device", "Models of the device, its back-end on the bench");
  add_device_bench(c, *device);
  add_device_board(c, *device);
  add_device_plant(c, *device);
  CLI::App* eval = c.add(*device, "eval", "Pose, twist, torques, gravity, conditioning of joint angles",
                         [&c] { return device_eval(c.table_in, c.table_out, std::cerr, c.device_file); });
  CLI::App* ik = c.add(*device, "ik", "Every inverse kinematic candidate of stylus poses",
                       [&c] { return device_ik(c.table_in, c.table_out, std::cerr); });
  for (CLI::App* command : {eval, ik}) {
    command->add_option("--csv", c.table_in, "Input table")->required();
    command->add_option("--out", c.table_out, "Output table")->required()->check(kPlaced);
  }
  eval->add_option("--device", c.device_file, "Device file with identified weights (default: nominal)")->check(kNamed);
  CLI::App* identify =
      c.add(*device, "identify", "Weights, inertias and friction of a simulated device from its motion",
            [&c] { return identify_command(c.identify, std::cout, std::cerr); });
  identify->add_option("--seed", c.identify.seed, "Of the simulated device, poses and trajectories")
      ->capture_default_str()
      ->check(kSeed);
  identify->add_option("--poses", c.identify.poses, "Static poses")->capture_default_str()->check(CLI::Range(6, 1000));
  identify->add_option("--span", c.identify.span, "Share of workspace and amplitude that is used")
      ->capture_default_str()
      ->check(CLI::Range(0.001, 1.0));
  identify->add_option("--payload", c.identify.payload_kg, "Unknown mass on the stylus, kg")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 0.05));
  identify->add_option("--plant", c.identify.plant, "Plant file of the device, instead of the seed's")->check(kNamed);
  identify->add_flag("--quick", c.identify.quick, "20 poses and one trajectory");
  identify->add_option("--out", c.identify.out, "Device file (TOML) to write")->check(kPlaced);
  identify->add_flag("--json", c.identify.json, "As JSON");
}

void add_organ(CommandLine& c) {
  c.organs = add_organ_commands(c.app, [&c](std::function<int()> action) { c.chosen = std::move(action); });
}

void add_review(CommandLine& c) {
  c.review = add_review_command(c.app, [&c](std::function<int()> action) { c.chosen = std::move(action); });
}

void add_practice(CommandLine& c) {
  c.practice = add_practice_command(c.app, [&c](std::function<int()> action) { c.chosen = std::move(action); });
}

void add_export(CommandLine& c) {
  c.exports = add_export_command(c.app, [&c](std::function<int()> action) { c.chosen = std::move(action); });
}

void add_trainees(CommandLine& c) {
  c.trainees = add_trainee_commands(c.app, [&c](std::function<int()> action) { c.chosen = std::move(action); });
}

void add_machine(CommandLine& c) {
  CLI::App* doctor = c.add(c.app, "doctor", "What this machine offers, and what is missing",
                           [&c] { return doctor_command(c.doctor, std::cout, std::cerr); });
  doctor->add_option("--db", c.doctor.database, "Database file");
  doctor->add_flag("--json", c.doctor.json, "As JSON");
  CLI::App* completion = c.add(c.app, "completion", "Shell completion, as it is installed", [&c] {
    std::cout << completion_script(c.app, c.shell);
    return 0;
  });
  completion->add_option("shell", c.shell, "bash, zsh or fish")->required();
  c.add(c.app, "manual", "Manual page in roff, as it is installed", [&c] {
    std::cout << manual_page(c.app, TROCAR_VERSION);
    return 0;
  });
}

/// What was printed has to have arrived: a full disk behind a redirection is no success.
int printed(int code) {
  if (std::cout.flush()) return code;
  std::cerr << "trocar: standard output could not be written\n";
  return code == 0 ? 3 : code;
}

int fail(const std::exception& error, int code) {
  std::cerr << "trocar: " << error.what() << '\n';
  return code;
}

}  // namespace

int run_command_line(int argc, char** argv) {
  CommandLine c;
  c.app.require_subcommand(1);
  c.app.set_version_flag("--version", kVersionLine, "Version of the program");
  for (auto* add : {add_practice, add_run, add_sweep, add_recordings, add_first_contact, add_picture, add_catalogue,
                    add_device, add_organ, add_trainees, add_review, add_export, add_machine}) {
    add(c);
  }
  try {
    c.app.parse(argc, argv);
    return printed(c.chosen());
  } catch (const CLI::ParseError& error) {
    // CLI11 asks for what is missing before it looks at the word that is none.
    const bool help = error.get_exit_code() == 0;
    const std::string said = help ? "" : misspelt(c.app, {argv + 1, argv + argc});
    if (!said.empty()) std::cerr << "trocar: " << said << '\n';
    return c.app.exit(error) == 0 ? 0 : 2;
  } catch (const InputError& error) {
    return fail(error, 2);
  } catch (const EnvironmentError& error) {
    return fail(error, 3);
  } catch (const std::filesystem::filesystem_error& error) {
    return fail(error, 3);
  } catch (const std::bad_alloc& error) {
    return fail(error, 3);
  } catch (const std::exception& error) {
    return fail(error, 2);
  }
}

}  // namespace trocar
