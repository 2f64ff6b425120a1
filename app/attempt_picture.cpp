#include "app/attempt_picture.h"

#include <cmath>
#include <cstdio>

#include "app/graphics/headless_context.h"
#include "app/graphics/renderer.h"
#include "haptics/input_error.h"

namespace trocar {
namespace {

std::string text(const char* format, double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, format, value);
  return buffer;
}

/// Scope from the side of the trainee (-y of T), above the board, looking down on the region.
Camera scope(const Scene& scene) {
  const TargetLayout& layout = scene.setup.exercise.layout;
  Camera camera;
  camera.look_at_T = scene.board.centre_T + Vec3(0, 0.004, 0.004);
  camera.eye_T = camera.look_at_T + Vec3(-0.012, -1.15 * layout.region_y_m, 1.0 * layout.region_y_m);
  camera.diagonal_fov_deg = 72;
  return camera;
}

std::vector<TargetMark> marks(const DirectorView& director) {
  std::vector<TargetMark> out;
  const DirectorStatus& status = director.status();
  for (std::size_t i = 0; i < director.board().targets.size(); ++i) {
    const Target& target = director.board().targets[i];
    const int index = static_cast<int>(i);
    auto state = TargetMark::State::kWaiting;
    if (index < status.targets_done) state = TargetMark::State::kDone;
    else if (index == status.target_index) state = TargetMark::State::kLit;
    out.push_back({target.centre_T, target.normal_T, target.radius_m, state});
  }
  return out;
}

std::vector<HudStep> steps(const Exercise& exercise, const DirectorStatus& status) {
  const auto state = [&](bool done, bool current) {
    return done ? HudStep::State::kDone : current ? HudStep::State::kCurrent : HudStep::State::kOpen;
  };
  const int total = exercise.layout.count;
  const bool started = status.phase != Phase::kReady && status.phase != Phase::kArmed;
  const bool touched = status.targets_done >= total;
  const bool done = status.phase == Phase::kDone;
  return {{"Rest at the start", state(started, !started)},
          {"Touch and hold each disc", state(touched, started && !touched)},
          {"Squeeze the block", state(done, touched && !done)}};
}

std::vector<ForceBar> bars(const Exercise& exercise, const ExerciseLevel& level, const SessionView& view) {
  const DirectorStatus& status = view.director.status();
  std::vector<ForceBar> out;
  if (level.force_display == "always") {
    ForceBar tip{"Tip force", view.record.stylus.F_I_T.force.norm(), status.peak_force_n, level.band_low_n,
                 level.band_high_n, exercise.hard_force_n, exercise.hard_force_n * 1.25};
    out.push_back(tip);
  }
  out.push_back({"Grip force", view.record.stylus.grip_force_n, 0, exercise.grip.low_n, exercise.grip.high_n,
                 exercise.grip.excess_n, exercise.grip.excess_n * 1.25});
  return out;
}

Hud hud(const SessionView& view, const std::string& trainee) {
  const Scene& scene = view.scene;
  const Exercise& exercise = scene.setup.exercise;
  const DirectorStatus& status = view.director.status();
  const StylusState& stylus = view.record.stylus;
  Hud hud;
  hud.trainee = trainee.empty() ? "Guest" : "Trainee: " + trainee;
  hud.title = exercise.number + " " + exercise.title + " · " + scene.level.name;
  hud.elapsed_s = status.run_time_s;
  hud.limit_s = exercise.time_limit_s;
  hud.bars = bars(exercise, scene.level, view);
  hud.steps = steps(exercise, status);
  hud.rows = {{"Discs held", std::to_string(status.targets_done) + " / " + std::to_string(exercise.layout.count), ""},
              {"Wrong places", std::to_string(status.wrong_places), ""},
              {"Too much force", std::to_string(status.excess_forces), "x"},
              {"Hold", text("%.0f", 100 * status.hold_progress), "%"}};
  hud.device = {{"plant", "simulated", ""},
                {"loop", text("%.0f", scene.loop.daq.rate_hz), "Hz"},
                {"passivity", stylus.passivity_active ? "acting" : "ok", ""},
                {"force scale", text("%.2f", scene.loop.map.force_scale), ""},
                {"motor heat", text("%.0f", view.record.winding_c), "°C"}};
  hud.toast = status.message;
  hud.toast_hint = status.hint;
  hud.toast_warning = status.warning;
  hud.credit = "Organ: " + scene.organ.name + (scene.organ.synthetic ? " (synthetic)" : "") +
               (scene.organ.credit.empty() ? "" : " · " + scene.organ.credit);
  return hud;
}

}  // namespace

SceneView attempt_view(const SessionView& view, const std::shared_ptr<const TriangleSurface>& organ_T,
                       const std::string& trainee) {
  const StylusState& stylus = view.record.stylus;
  SceneView out;
  out.organ = organ_T;
  out.material = view.scene.organ.material;
  out.targets = marks(view.director);
  out.X_TI = stylus.X_TI;
  out.shaft_radius_m = view.scene.loop.tool.radius_m;
  out.shaft_length_m = view.scene.loop.tool.shaft_length_m;
  out.jaw_opening_m = stylus.jaw_opening_m;
  if (stylus.contact) {
    out.dimple_T = stylus.contact_point_T;
    out.dimple_normal_T = stylus.contact_normal_T;
    out.dimple_depth_m = stylus.depth_m;
  }
  out.camera = scope(view.scene);
  out.hud = hud(view, trainee);
  return out;
}

struct AttemptPainter::Impl {
  Impl(const Scene& scene, const AssetRoots& assets, std::string trainee_in, int width_in, int height_in)
      : renderer(context, assets.assets),
        organ_T(std::make_shared<TriangleSurface>(scene.organ_T)),
        trainee(std::move(trainee_in)),
        width(width_in),
        height(height_in) {}

  HeadlessContext context;
  Renderer renderer;
  std::shared_ptr<const TriangleSurface> organ_T;
  std::string trainee;
  int width, height;
};

AttemptPainter::AttemptPainter(const Scene& scene, const AssetRoots& assets, std::string trainee, int width, int height)
    : impl_(std::make_unique<Impl>(scene, assets, std::move(trainee), width, height)) {}
AttemptPainter::~AttemptPainter() = default;

Image AttemptPainter::paint(const SessionView& view) {
  return impl_->renderer.render(attempt_view(view, impl_->organ_T, impl_->trainee), impl_->width, impl_->height);
}

FrameWriter::FrameWriter(AttemptPainter& painter, std::filesystem::path directory, double fps)
    : painter_(painter), directory_(std::move(directory)), period_s_(1 / fps) {
  std::error_code error;
  std::filesystem::create_directories(directory_, error);
  if (error) throw EnvironmentError(directory_.string() + ": cannot be made: " + error.message());
}

void FrameWriter::observe(const SessionView& view) {
  if (view.t_s + 1e-9 < next_s_) return;
  next_s_ += period_s_;
  char name[32];
  std::snprintf(name, sizeof name, "frame_%05d.png", ++written_);
  write_png(directory_ / name, painter_.paint(view));
}

}  // namespace trocar
