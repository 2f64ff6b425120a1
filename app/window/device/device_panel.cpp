#include "app/window/device/device_panel.h"

#include <algorithm>
#include <cmath>

#include "app/device_bench/device_drawing.h"
#include "haptics/input_error.h"
#include "scenarios/director/homing_words.h"
#include "trainees/files/write_file.h"
#include "trainees/store/database.h"

namespace trocar {
namespace {

constexpr const char* kCopyKey = "F4";  // no action of the key map: it is spoken of here only
constexpr double kWidth = 560, kPanelMargin = 10, kFigure = 210;
const Vec3 kMiddle_W(0, -0.02, -0.115);  // of what the arm takes up
constexpr double kHalf_m = 0.165;

/// Right-aligned columns under small heads, without items.
void panel_columns(Ui& ui, const std::vector<std::string>& heads, const std::vector<double>& shares,
                   const std::vector<std::vector<std::string>>& rows, double from, double wide) {
  const double step = 1.16 * ui.line_height();
  const auto right = [&](std::size_t column) {
    double sum = 0;
    for (std::size_t i = 0; i <= column; ++i) sum += shares[i];
    return from + sum * wide;
  };
  const Area area = ui.placed(step * static_cast<double>(rows.size() + (heads.empty() ? 0 : 1)) / ui.px(1));
  double y = area.y;
  const auto put = [&](const std::vector<std::string>& row, Ink ink) {
    for (std::size_t i = 0; i < row.size(); ++i)
      ui.text_at(area.x + right(i), y, ui.words().made_number(row[i]), ink, shares[i] * wide, 1);
    y += step;
  };
  if (!heads.empty()) put(heads, Ink::kDim);
  for (const auto& row : rows) put(row, Ink::kText);
}

void figure(Ui& ui, const JointVector& q, const Area& area, double azimuth, double elevation,
            const std::string& caption) {
  DrawingView view;
  view.azimuth = azimuth;
  view.elevation = elevation;
  view.pixels_per_m = 0.5 * std::min(area.width, area.height) / kHalf_m;
  const Eigen::Vector2d middle = view.project(kMiddle_W);
  view.origin_x = area.x + area.width / 2 - middle.x();
  view.origin_y = area.y + area.height / 2 - middle.y();
  ui.paint_frame(area, Ink::kDim, 1);
  for (const DeviceStroke& stroke : device_strokes(q)) {
    std::vector<Ui::Point> points;
    for (const Vec3& p : stroke.points) {
      const Eigen::Vector2d at = view.project(p);
      points.push_back({at.x(), at.y()});
    }
    using Part = DeviceStroke::Part;
    const bool link = stroke.part == Part::kFirstLink || stroke.part == Part::kSecondLink,
               stylus = stroke.part == Part::kStylus;
    ui.paint_curve(points, stylus ? Ink::kAccent : link ? Ink::kText : Ink::kDim, stylus ? 4 : link ? 3 : 1.5);
    if (link || stylus) ui.paint_ring(points.front().x, points.front().y, ui.px(4), Ink::kHeading, 2);
  }
  ui.text_at(area.x + ui.px(6), area.y + ui.px(4), caption, Ink::kDim, area.width - ui.px(12));
}

std::string whole(double value) { return fixed_number(std::isfinite(value) ? std::round(value) : value, 6, 0); }

}  // namespace

Area device_panel_area(const Ui& ui, bool right) {
  const double m = ui.px(kPanelMargin), wide = std::min(ui.px(kWidth), ui.width() - 2 * m);
  return {right ? ui.width() - m - wide : m, m, wide, ui.height() - 2 * m};
}

void DevicePanel::draw(Ui& ui, const PracticeModel& model) const {
  const Translator& w = model.words();
  const DeviceReading& r = reading_;
  const double all = ui.room();
  if (r.state == LoopState::kUnhomed || r.state == LoopState::kHomed) {
    const HomingWords next = homing_words(r.state, r.homing);
    ui.heading(w(next.title));
    ui.line(w(next.hint), next.warning ? Ink::kCaution : Ink::kText);
  }
  auto joints = joint_rows(r);
  joints.back().front() = w("pinch");
  panel_columns(ui, {w("joint"), w("deg"), w("deg/s"), w("asked mN m"), w("given mN m")},
                {0.14, 0.17, 0.18, 0.255, 0.255}, joints, 0, all);
  ui.line(w("pinch in mm, mm/s and N"), Ink::kDim);
  ui.heading(w("Stylus in the base (mm), platform"));
  auto both = stylus_matrix(r);
  const auto platform = platform_matrix(r);
  for (std::size_t i = 0; i < platform.size(); ++i)
    both[i].insert(both[i].end(), platform[i].begin(), platform[i].end());
  panel_columns(ui, {}, {0.135, 0.135, 0.135, 0.16, 0.155, 0.14, 0.14}, both, 0, all);
  ui.heading(w("Force, N: x, y, z, size"));
  auto forces = force_rows(r);
  forces.front().front() = w("tip");
  forces.back().front() = w("stylus");
  panel_columns(ui, {}, {0.2, 0.2, 0.2, 0.2, 0.2}, forces, 0, all);
  panel_columns(ui, {}, {0.26, 0.15, 0.35, 0.2},
                {{w("det A"), fixed_number(r.det_a, 6, 3), w("K max, N/m"), whole(r.k_max_n_per_m)},
                 {w("winding, C"), fixed_number(r.winding_c, 6, 1), w("contact, N/m"), whole(r.stiffness_n_per_m)},
                 {w("energy, mJ"), fixed_number(1e3 * r.energy_j, 7, 2), w("loop"), w(r.loop)},
                 {w("torque cut"), r.saturated ? w("yes") : w("no"), w("passivity acts"),
                  r.passivity_active ? w("yes") : w("no")}},
                0, all);
  const Area place = ui.placed(std::max(90.0, std::min(kFigure, (ui.room_below() - ui.px(8)) / ui.px(1))));
  const double half = (place.width - ui.px(8)) / 2;
  const JointVector q = r.q.head<kArmJoints>();
  figure(ui, q, {place.x, place.y, half, place.height}, 0, 0, w("from the front"));
  figure(ui, q, {place.x + half + ui.px(8), place.y, half, place.height}, M_PI / 2, 0, w("from the side"));
}

void DevicePanel::frame(Ui& ui, PracticeModel& model, const TickRecord& record, const HapticLoopConfig& loop,
                        double dt_s, const Area& area) {
  if (!open) return;
  age_s_ += dt_s;
  if (age_s_ >= kEvery_s) {
    reading_ = device_reading(record, loop);
    age_s_ = 0;
  }
  if (ui.pressed(kCopyKey)) copy(model);
  ui.begin_panel("device", area);
  ui.in_front();
  ui.scroll_by_keys();
  const Translator& w = model.words();
  const std::string closes = w.name(key_name(model.keys().key_of(Action::kDevicePanel)));
  ui.line(w("Device, {0} s.  {1} closes, {2} copies", {w.number(reading_.t_s, 1), closes, w.name(kCopyKey)}),
          Ink::kHeading);
  draw(ui, model);
  ui.end_panel();
}

void DevicePanel::copy(PracticeModel& model) const {
  const Translator& w = model.words();
  const bool kept = model.database() != ":memory:";
  try {
    const auto folder = kept ? model.database().parent_path() : default_database_path().parent_path();
    model.notice = w("Device numbers written to {0}", {save_device_csv(reading_, folder).string()});
  } catch (const EnvironmentError& error) {
    model.notice = error.what();
  }
}

std::filesystem::path save_device_csv(const DeviceReading& reading, const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  std::filesystem::path file = folder / "device-1.csv";
  for (int n = 2; std::filesystem::exists(file, error); ++n) file = folder / ("device-" + std::to_string(n) + ".csv");
  write_file(file, device_csv(reading));
  return file;
}

}  // namespace trocar
