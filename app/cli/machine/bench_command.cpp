#include "app/cli/machine/bench_command.h"

#include <algorithm>
#include <chrono>
#include <functional>
#include <iomanip>
#include <iostream>
#include <memory>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "app/cli/attempts/run_command.h"
#include "app/cli/command.h"
#include "app/cli/machine/bench_compiler.h"
#include "app/cli/machine/bench_contact.h"
#include "app/cli/machine/bench_pictures.h"
#include "app/cli/machine/bench_tissue.h"
#include "app/session/recording/recording_reader.h"
#include "app/session/session.h"
#include "app/window/practice/latency_bench.h"
#include "haptics/control/gravity.h"
#include "haptics/input_error.h"
#include "haptics/kinematics/hybrid_arm.h"
#include "tissue/collision/patch_extraction.h"

namespace trocar {
namespace {

/// Times `work` for each tick of the run.
StageTimes time_each(const std::string& stage, std::size_t count, const std::function<void(std::size_t)>& work) {
  StageTimes timing{stage, {}};
  timing.us.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double before = cpu_now_us();
    work(i);
    timing.us.push_back(cpu_now_us() - before);
  }
  return timing;
}

/// What the loop saw and computed during the attempt, for feeding single stages.
struct Captured {
  std::vector<DaqSample> samples;
  std::vector<TickRecord> records;
};

Captured capture(const Scene& scene, const Recording& recording) {
  Captured captured;
  for (const RecordedTick& row : recording.ticks) captured.samples.push_back(device_input(row));
  HapticLoop loop(scene.loop);
  PatchExtraction extraction(*scene.organ_T);
  auto patch = std::make_unique<ContactPatch>();
  patch->material[0] = scene.setup.exercise.surface;
  for (std::size_t i = 0; i < captured.samples.size(); ++i) {
    TickRecord& record = captured.records.emplace_back();
    loop.tick(captured.samples[i], *patch, record);
    if (i % 10 == 0) extraction.extract(record.stylus.X_TI, scene.loop.tool, *patch);
  }
  return captured;
}

std::vector<StageTimes> time_stages(const Scene& scene, const Captured& run) {
  const std::size_t count = run.samples.size();
  PatchExtraction extraction(*scene.organ_T);
  auto patch = std::make_unique<ContactPatch>();
  patch->material[0] = scene.setup.exercise.surface;
  ContactRenderer contact(scene.loop.contact_law, scene.loop.tool);
  HapticLoop loop(scene.loop);
  auto record = std::make_unique<TickRecord>();
  std::vector<ArmState> arms(count);
  std::vector<StageTimes> timings;
  timings.push_back(time_each("kinematics, Jacobian", count,
                              [&](std::size_t i) { arms[i] = arm_state(run.records[i].q.head<kArmJoints>()); }));
  double sink = 0;
  timings.push_back(
      time_each("gravity", count, [&](std::size_t i) { sink += gravity_torque(scene.loop.device, arms[i])[0]; }));
  const auto refresh = [&](std::size_t i) {
    if (i % 10 == 0) extraction.extract(run.records[i].stylus.X_TI, scene.loop.tool, *patch);
  };
  timings.push_back(time_each("patch (every 10th tick)", count / 10, [&](std::size_t i) { refresh(10 * i); }));
  StageTimes touch{"contact", {}}, tick{"whole tick", {}};
  for (std::size_t i = 0; i < count; ++i) {
    refresh(i);
    const StylusState& s = run.records[i].stylus;
    const double start = cpu_now_us();
    sink += contact.update(s.X_TI, s.V_TI_T, *patch).depth_m;
    const double middle = cpu_now_us();
    loop.tick(run.samples[i], *patch, *record);
    tick.us.push_back(cpu_now_us() - middle);
    touch.us.push_back(middle - start);
  }
  timings.push_back(std::move(touch));
  timings.push_back(std::move(tick));
  timings.push_back(time_each("the clock itself", count, [](std::size_t) {}));
  if (sink == 0.123456789) timings.clear();  // keeps the optimiser from dropping the stages
  return timings;
}

nlohmann::ordered_json percentiles(StageTimes& timing) {
  return {{"median", timing.percentile(0.5)}, {"p99", timing.percentile(0.99)}, {"p99.9", timing.percentile(0.999)}};
}

/// Patch, refit and contact step on balls of 5k, 50k and 500k triangles.
nlohmann::ordered_json contact_by_size(std::ostream& err) {
  nlohmann::ordered_json json;
  for (const int triangles : {5000, 50000, 500000}) {
    err << "trocar: contact on " << triangles << " triangles\n";
    ContactCost cost = contact_cost(triangles, 10000, 3);
    nlohmann::ordered_json row{{"triangles", cost.triangles},     {"patch_triangles", cost.patch},
                               {"reach_mm", cost.reach_m * 1e3},  {"missed_contacts", 10000 - cost.contact_ticks},
                               {"lists_a_tick", cost.lists},      {"listed_a_tick", cost.listed},
                               {"measured_a_tick", cost.measured}};
    for (StageTimes* timing : {&cost.step, &cost.fresh, &cost.least, &cost.extraction, &cost.refit})
      row[timing->stage] = percentiles(*timing);
    json.push_back(row);
  }
  return json;
}

void print_contact(const nlohmann::ordered_json& rows, std::ostream& out) {
  out << "\ncontact on a ball of 80 mm, probe, friction; median and p99.9, us CPU\n"
      << "(least: each tick's least of three runs; new: ticks that saw a new patch; measured: pairs a tick)\n"
      << "triangles    in patch  reach mm  missed measured        step           least            new           patch"
         "           refit\n";
  for (const auto& row : rows) {
    out << std::setw(9) << row["triangles"].get<int>() << std::setw(12) << row["patch_triangles"].get<int>()
        << std::setw(10) << row["reach_mm"].get<double>() << std::setw(8) << row["missed_contacts"].get<int>()
        << std::setw(9) << row["measured_a_tick"].get<double>();
    for (const char* stage :
         {"contact step", "contact step, least of runs", "contact step, new patch", "patch", "refit"}) {
      out << std::setw(8) << row[stage]["median"].get<double>() << std::setw(8) << row[stage]["p99.9"].get<double>();
    }
    out << '\n';
  }
}

/// A step of an organ that gives way, on cells of three sizes, whole and after 200 cuts.
nlohmann::ordered_json tissue_by_size(std::ostream& err) {
  constexpr int kCuts = 200, kSteps = 200;
  nlohmann::ordered_json json;
  for (const double edge_m : {0.0140, 0.0074, 0.00435}) {
    err << "trocar: a step of tissue on cells of " << 1e3 * edge_m << " mm, whole and after " << kCuts << " cuts\n";
    TissueCost cost = tissue_cost(edge_m, kCuts, kSteps);
    json.push_back({{"cells_mm", 1e3 * edge_m},
                    {"nodes", cost.nodes},
                    {"triangles", cost.triangles},
                    {"cuts", cost.cuts},
                    {"nodes_cut", cost.nodes_cut},
                    {"triangles_cut", cost.triangles_cut},
                    {"whole_us", percentiles(cost.whole)},
                    {"cut_us", percentiles(cost.cut)}});
  }
  return json;
}

void print_tissue(const nlohmann::ordered_json& rows, std::ostream& out) {
  out << "\na step of tissue (10 ms), probe pressing at 2 Hz; median and p99, ms CPU\n"
      << "   nodes  triangles           whole    cuts   nodes  triangles       after them    ratio\n";
  for (const auto& row : rows) {
    const auto ms = [&](const char* of, const char* share) { return 1e-3 * row[of][share].get<double>(); };
    out << std::setw(8) << row["nodes"].get<int>() << std::setw(11) << row["triangles"].get<int>() << std::setw(8)
        << ms("whole_us", "median") << std::setw(8) << ms("whole_us", "p99") << std::setw(8) << row["cuts"].get<int>()
        << std::setw(8) << row["nodes_cut"].get<int>() << std::setw(11) << row["triangles_cut"].get<int>()
        << std::setw(9) << ms("cut_us", "median") << std::setw(8) << ms("cut_us", "p99") << std::setw(9)
        << ms("cut_us", "median") / ms("whole_us", "median") << '\n';
  }
}

/// From a person's event to the frame that shows it; says why not where there is no OpenGL.
nlohmann::ordered_json input_to_picture(const AssetRoots& assets, std::ostream& err) {
  constexpr double kSeconds = 8;
  err << "trocar: a live attempt with its pictures for " << kSeconds
      << " s: from a mouse event to the frame that shows it\n";
  try {
    const PictureLatency l = measure_picture_latency(assets, kSeconds);
    return {{"renderer", l.renderer},
            {"width", l.width},
            {"height", l.height},
            {"frames", l.frames},
            {"events", l.events},
            {"frame_ms", {{"median", 1e3 * l.frame_median_s}, {"p95", 1e3 * l.frame_p95_s}}},
            {"event_to_picture_ms", {{"median", 1e3 * l.median_s}, {"p95", 1e3 * l.p95_s}, {"max", 1e3 * l.longest_s}}},
            {"bar_ms", 1e3 * l.bar_s()}};
  } catch (const EnvironmentError& error) {
    err << "trocar: not measured: " << error.what() << '\n';
    return nullptr;
  }
}

void print_latency(const nlohmann::ordered_json& json, std::ostream& out) {
  if (json.is_null()) return;
  const auto& ms = json["event_to_picture_ms"];
  out << "\ninput to picture  " << std::setprecision(1) << ms["median"].get<double>() << " ms median, "
      << ms["p95"].get<double>() << " ms 95 %, " << ms["max"].get<double>()
      << " ms longest; bar (2 frames + 1 tissue step) " << json["bar_ms"].get<double>() << " ms\n  frames of "
      << json["width"] << " x " << json["height"] << " take " << json["frame_ms"]["median"].get<double>()
      << " ms (95 %: " << json["frame_ms"]["p95"].get<double>() << " ms) on " << json["renderer"].get<std::string>()
      << '\n';
}

/// A liver of a CT of 512 x 512 x 80 voxels to 10 000 triangles: what the bars of the organ compiler are stated for.
nlohmann::ordered_json compiler_figures(std::ostream& err) {
  err << "trocar: organ compiler on 512 x 512 x 80 voxels\n";
  const CompilerCost cost = compiler_cost({512, 512, 80}, 10000);
  return {{"voxels", cost.size},
          {"raw_triangles", cost.raw_triangles},
          {"triangles", cost.triangles},
          {"cpu_s", cost.cpu_s},
          {"peak_memory_growth_mb", cost.peak_growth_mb},
          {"distance_mm", {{"mean", cost.mean_mm}, {"p99", cost.p99_mm}}}};
}

void print_compiler(const nlohmann::ordered_json& row, std::ostream& out) {
  out << "\norgan compiler, a liver on 512 x 512 x 80 voxels made in memory: " << row["raw_triangles"]
      << " raw triangles to " << row["triangles"] << "\n  " << std::setprecision(2) << row["cpu_s"].get<double>()
      << " s CPU, peak memory grown by " << std::setprecision(0) << row["peak_memory_growth_mb"].get<double>()
      << " MB, to the label " << std::setprecision(2) << row["distance_mm"]["mean"].get<double>()
      << " mm on average, p99 " << row["distance_mm"]["p99"].get<double>() << " mm\n";
}

nlohmann::ordered_json pictures_json(const std::vector<PictureCost>& costs) {
  nlohmann::ordered_json out = nlohmann::ordered_json::array();
  for (const PictureCost& cost : costs)
    out.push_back({{"scene", cost.scene}, {"preset", cost.preset}, {"cpu_ms", cost.cpu_ms}, {"per_s", cost.per_s}});
  return out;
}

/// One attempt in lockstep, then each stage over its ticks.
nlohmann::ordered_json loop_figures(const BenchOptions& options, const AssetRoots& assets, std::ostream& err) {
  RunOptions run;
  run.exercise = "surface-touch";
  run.hand = options.hand;
  run.organ = options.organ;
  const Scene scene = build_scene(attempt_setup(run, assets), assets, {"simulated", run.rate_hz, 16});
  err << "trocar: one attempt on the simulated plant, then each stage over its ticks; CPU time of the thread\n";
  MemorySink memory;
  RecordingWriter writer(memory, scene_json(scene), scene.loop.daq.rate_hz);
  const auto wall = std::chrono::steady_clock::now();
  const SessionOutcome outcome = run_session(scene, assets, writer);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - wall).count();
  const double simulated = static_cast<double>(outcome.device.ticks) / outcome.device.rate_hz;

  const Recording recording = parse_recording(memory.bytes(), "bench");
  nlohmann::ordered_json json;
  json["organ"] = scene.organ.name;
  json["organ_triangles"] = scene.organ_T->triangles.size();
  json["ticks"] = outcome.device.ticks;
  json["wall_s_per_simulated_s"] = seconds / simulated;
  json["times_real_time"] = simulated / seconds;
  json["recording_bytes_per_60_s"] = static_cast<double>(memory.bytes().size()) * 60 / simulated;
  for (StageTimes& timing : time_stages(scene, capture(scene, recording)))
    json["stages_us"][timing.stage] = percentiles(timing);
  StageTimes fixed = fixed_work(10000);
  json["stages_us"]["fixed work (the machine)"] = percentiles(fixed);
  json["contact_us"] = contact_by_size(err);
  json["tissue_step"] = tissue_by_size(err);
  return json;
}

void print_stages(const nlohmann::ordered_json& json, std::ostream& out) {
  out << std::fixed << std::setprecision(2) << "organ " << json["organ"].get<std::string>() << ", "
      << json["organ_triangles"] << " triangles, " << json["ticks"] << " ticks\n\n"
      << "stage                         median      p99    p99.9  us CPU\n";
  for (const auto& [stage, row] : json["stages_us"].items()) {
    out << std::left << std::setw(26) << stage << std::right;
    for (const char* key : {"median", "p99", "p99.9"}) out << std::setw(10) << row[key].get<double>();
    out << '\n';
  }
  print_contact(json["contact_us"], out);
  print_tissue(json["tissue_step"], out);
}

}  // namespace

int bench_command(const BenchOptions& options, std::ostream& out, std::ostream& err) {
  const nlohmann::ordered_json compiler = compiler_figures(err);  // first: later stages hold more memory
  const AssetRoots assets = find_assets();
  nlohmann::ordered_json json = loop_figures(options, assets, err);
  json["input_to_picture"] = input_to_picture(assets, err);
  const std::vector<PictureCost> pictures = picture_costs(assets.assets, err);
  json["pictures"] = pictures_json(pictures);
  json["organ_compiler"] = compiler;
  if (options.json) {
    out << json.dump(2) << '\n';
    return 0;
  }
  print_stages(json, out);
  print_latency(json["input_to_picture"], out);
  print_pictures(pictures, out);
  print_compiler(compiler, out);
  out << "\nwall seconds per simulated second  " << std::setprecision(4) << json["wall_s_per_simulated_s"].get<double>()
      << "  (" << std::setprecision(1) << json["times_real_time"].get<double>()
      << " x real time, plant and hand included)\n"
      << "recording                          " << std::setprecision(3)
      << json["recording_bytes_per_60_s"].get<double>() / 1048576 << " MiB a minute\n";
  return 0;
}

void add_bench(CLI::App& parent, CommandAction& chosen) {
  const auto given = std::make_shared<BenchOptions>();
  BenchOptions& o = *given;
  CLI::App* bench = add_command(parent, "bench", "What one tick, one picture and the organ compiler cost", chosen,
                                [given] { return bench_command(*given, std::cout, std::cerr); });
  bench->add_option("--organ", o.organ, kOrganForms)->capture_default_str();
  bench->add_flag("--json", o.json, "As JSON");
}

}  // namespace trocar
