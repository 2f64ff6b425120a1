#include <algorithm>
#include <iomanip>
#include <sstream>

#include "app/cli/attempts/check_command.h"
#include "app/picture/attempt/attempt_picture.h"
#include "app/picture/attempt/attempt_scene.h"
#include "app/picture/gl/headless_context.h"
#include "app/picture/scene/renderer.h"
#include "app/session/setup/placement.h"
#include "haptics/input_error.h"
#include "haptics/kinematics/inverse_kinematics.h"
#include "scenarios/director/director.h"

namespace trocar {
namespace {

constexpr int kColumns = 40, kPanelWidth = 460, kMargin = 46, kCaption = 74;
constexpr double kHandleStep_m = 0.030;
constexpr double kTipAbove_m = 0.015;  // over the region's middle, where the pair is taken
const Vec3 kUsualPort(0.030, -0.060, 0.120);

/// Dark blue (nothing) over green to yellow (1 or more), readable without telling red from green.
std::string colour(double share) {
  const double t = std::clamp(share, 0.0, 1.0);
  const auto mix = [&](double low, double middle, double high) {
    return static_cast<int>(t < 0.5 ? low + 2 * t * (middle - low) : middle + (2 * t - 1) * (high - middle));
  };
  return "rgb(" + std::to_string(mix(38, 33, 253)) + ',' + std::to_string(mix(24, 145, 231)) + ',' +
         std::to_string(mix(74, 140, 37)) + ')';
}

void draw_cells(const LevelProof& proof, const Scene& scene, double x0, double y0, std::ostream& svg) {
  const TargetLayout& layout = scene.setup.exercise.layout;
  const double cell = double(kPanelWidth - 2 * kMargin) / kColumns;
  const int rows = std::max(1, static_cast<int>(kColumns * layout.region_y_m / layout.region_x_m));
  const RoomMap room = room_map(scene.loop.map, scene.loop.device, layout, kColumns, rows);
  const double full = std::max(0.1, 2 * proof.kappa * scene.setup.exercise.soft_force_n);
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < kColumns; ++i) {
      const double n = room.room_n[static_cast<std::size_t>(j * kColumns + i)];
      svg << "<rect x=\"" << x0 + i * cell << "\" y=\"" << y0 + (rows - 1 - j) * cell << "\" width=\"" << cell + 0.3
          << "\" height=\"" << cell + 0.3 << "\" fill=\"" << colour(n / full) << "\"/>\n";
    }
  }
  for (const Target& target : scene.board.targets) {
    svg << "<circle cx=\"" << x0 + (target.centre_T.x() / layout.region_x_m + 0.5) * kColumns * cell << "\" cy=\""
        << y0 + (0.5 - target.centre_T.y() / layout.region_y_m) * rows * cell
        << "\" r=\"3.5\" fill=\"none\" stroke=\"white\" stroke-width=\"1.5\"/>\n";
  }
}

void say(std::ostream& svg, double x, double y, int size, const std::string& words) {
  svg << "<text x=\"" << x << "\" y=\"" << y << "\" font-size=\"" << size << "\">" << words << "</text>\n";
}

}  // namespace

std::string room_map_svg(const std::vector<LevelProof>& proofs, const std::vector<Scene>& scenes) {
  std::ostringstream svg;
  svg << std::fixed << std::setprecision(2);
  double height = 0;
  for (const Scene& scene : scenes) {
    const TargetLayout& layout = scene.setup.exercise.layout;
    height = std::max(height, (kPanelWidth - 2 * kMargin) * layout.region_y_m / layout.region_x_m);
  }
  svg << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << kPanelWidth * proofs.size() << "\" height=\""
      << height + kCaption + 60 << "\" font-family=\"sans-serif\" fill=\"#222\">\n"
      << "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n";
  for (std::size_t k = 0; k < proofs.size(); ++k) {
    const LevelProof& p = proofs[k];
    const double x0 = kPanelWidth * static_cast<double>(k) + kMargin;
    const double full = std::max(0.1, 2 * p.kappa * scenes[k].setup.exercise.soft_force_n);
    std::ostringstream line, scale;
    line << std::fixed << std::setprecision(2) << "kappa " << p.kappa << ", soft limit given in "
         << std::setprecision(0) << 100 * p.room_share << " % of the region";
    scale << std::fixed << std::setprecision(2) << "dark 0 N, bright " << full
          << " N and more upwards; rings: discs of board " << scenes[k].setup.board;
    say(svg, x0, 24, 16, p.exercise + ' ' + p.level + (p.fulcrum ? ", through a port" : ", direct"));
    say(svg, x0, 44, 13, line.str());
    draw_cells(p, scenes[k], x0, kCaption - 14, svg);
    say(svg, x0, height + kCaption + 8, 12, scale.str());
    say(svg, x0, height + kCaption + 26, 12, "seen from above, the trainee stands below");
  }
  svg << "</svg>\n";
  return svg.str();
}

void paint_inversion(const Exercise& exercise, const Organ& organ, const AssetRoots& assets,
                     const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw EnvironmentError(folder.string() + ": cannot be made: " + error.message());
  AttemptSetup setup;
  setup.exercise = exercise;
  setup.level = exercise.levels.front().name;
  setup.weak_too = true;
  HeadlessContext context;
  Renderer renderer(context, assets.assets);
  for (const bool port : {false, true}) {
    ExerciseLevel& level = setup.exercise.levels.front();
    level.mapping = port ? Mapping::kFulcrum : Mapping::kDirect;
    if (level.port_m.isZero()) level.port_m = kUsualPort;
    const Scene scene = build_scene(setup, organ, {"simulated", 1000, 16});
    const InstrumentMap& map = scene.loop.map;
    const Mat3 R_TI = map.instrument_pose(home_pose()).R;
    Pose X_WS = map.stylus_pose({R_TI, scene.board.centre_T + Vec3(0, 0, kTipAbove_m)});
    const Pose before = map.instrument_pose(X_WS);
    X_WS.p += map.X_TW.R.transpose() * Vec3(kHandleStep_m / map.motion_scale, 0, 0);  // x of T is the trainee's right
    TickRecord record;
    record.stylus.X_TI = map.instrument_pose(X_WS);
    const Director director(scene.setup.exercise, scene.level, scene.board);
    SceneView view = attempt_scene({scene, record, director, 0});
    view.targets.clear();
    std::erase_if(view.objects, [](const SceneObject& o) { return o.shape == SceneObject::Shape::kSphere; });
    SceneObject ghost;
    ghost.shape = SceneObject::Shape::kPen;
    ghost.style = SceneObject::Style::kGhostLit;
    ghost.size_m = {0.005, 0.005, 0.080};
    ghost.X_TO = before;
    view.objects.push_back(ghost);
    const Vec3 moved = record.stylus.X_TI.p - before.p;
    std::ostringstream tip;
    tip << std::fixed << std::setprecision(0) << "Tip: " << 1e3 * std::abs(moved.x())
        << (moved.x() > 0 ? " mm to the right" : " mm to the LEFT");
    view.hud.title = port ? "Through a port" : "Direct mapping";
    view.hud.toast = "Handle: 30 mm to the right.  " + tip.str();
    view.hud.toast_hint = "The ghost stands where the instrument was.";
    write_png(folder / (port ? "inversion-fulcrum.png" : "inversion-direct.png"), renderer.render(view, 1280, 720));
  }
}

}  // namespace trocar
