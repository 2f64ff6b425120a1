#include "scenarios/files/device_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <sstream>
#include <utility>

#include "haptics/input_error.h"
#include "scenarios/files/file_units.h"
#include "scenarios/files/strict_toml.h"

namespace trocar {
namespace {

constexpr double kMostMoment = 5;  // N m: ten times what the motors could ever carry
constexpr double kMostCoulomb = 0.2, kMostViscous = 1;

/// The fewest digits that read back as the same number.
std::string digits(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  std::string number(text, end);
  return number.find_first_of(".en") == std::string::npos ? number + ".0" : number;
}

template <class Vector>
std::string array(const Vector& v) {
  std::string text = "[";
  for (int i = 0; i < v.size(); ++i) text += (i ? ", " : "") + digits(v[i]);
  return text + "]";
}

Eigen::Vector2d two(StrictTable& table, const std::string& key) {
  const auto [x, y] = table.pair(key, -kMostMoment, kMostMoment);
  return {x, y};
}

const std::vector<std::string> kHomingMethods{"light", "edges", "index"};
const std::vector<std::string> kPinchDesigns{"direct", "geared", "potentiometer"};
constexpr double kMostMark = 1e6, kMostPinchCounts = 1e9;

void write_homing(std::ostream& out, const HomingModel& h) {
  out << "\n[homing]\nmethod = \"" << kHomingMethods[static_cast<std::size_t>(h.method)]
      << "\"\nsee_dark = " << (h.see_dark ? "true" : "false") << '\n';
  if (h.method != HomingMethod::kIndex) return;
  out << "marks_123_counts = [" << h.index_counts[0] << ", " << h.index_counts[1] << ", " << h.index_counts[2]
      << "]\nmarks_456_counts = [" << h.index_counts[3] << ", " << h.index_counts[4] << ", " << h.index_counts[5]
      << "]\n";
}

void read_homing(StrictTable table, HomingModel& h) {
  const std::string method = table.choice_or("method", kHomingMethods, kHomingMethods[0]);
  h.method = static_cast<HomingMethod>(std::find(kHomingMethods.begin(), kHomingMethods.end(), method) -
                                       kHomingMethods.begin());
  h.see_dark = table.flag_or("see_dark", h.see_dark);
  if (h.method == HomingMethod::kIndex) {
    const Vec3 first = table.vector("marks_123_counts", -kMostMark, kMostMark);
    const Vec3 last = table.vector("marks_456_counts", -kMostMark, kMostMark);
    for (int i = 0; i < kArmJoints; ++i)
      h.index_counts[static_cast<std::size_t>(i)] =
          static_cast<std::int32_t>(std::lround(i < 3 ? first[i] : last[i - 3]));
  }
  table.finish();
}

void write_pinch(std::ostream& out, const DeviceModel& model) {
  const Transmission& t = model.transmission[kPinchChannel];
  out << "\n[pinch]\ndesign = \"" << kPinchDesigns[static_cast<std::size_t>(model.pinch.design)]
      << "\"\nm_per_rad = " << digits(t.ratio) << "\nclosed_counts = 0.0\nopen_counts = "
      << digits(model.pinch_travel_m * t.counts_per_turn / (2 * std::numbers::pi * t.ratio))
      << "\ntravel_m = " << digits(model.pinch_travel_m) << "\nhome_m = " << digits(model.pinch_home_m)
      << "\nmost_force_n = " << digits(t.max_motor_torque / t.ratio) << "\nnoise_counts = " << model.pinch.noise_counts
      << "\njaw_length_m = " << digits(model.pinch.jaw_length_m) << '\n';
}

/// Two points of the slide, closed and open, give the size of a count whatever the design.
void read_pinch(StrictTable table, DeviceModel& model) {
  Transmission& t = model.transmission[kPinchChannel];
  const std::string design = table.choice("design", kPinchDesigns);
  model.pinch.design =
      static_cast<PinchDesign>(std::find(kPinchDesigns.begin(), kPinchDesigns.end(), design) - kPinchDesigns.begin());
  t.ratio = table.number_or("m_per_rad", 1e-4, 0.1, t.ratio);
  model.pinch_travel_m = table.number_or("travel_m", 0.002, 0.1, model.pinch_travel_m);
  model.pinch_home_m = table.number_or("home_m", 0, 0.1, model.pinch_home_m);
  if (model.pinch_home_m > model.pinch_travel_m)
    table.fail("home_m", "the jig cannot hold the slide beyond its travel");
  const double closed = table.number("closed_counts", -kMostPinchCounts, kMostPinchCounts);
  const double open = table.number("open_counts", -kMostPinchCounts, kMostPinchCounts);
  if (!(open - closed >= 50))
    table.fail("open_counts", "must be at least 50 counts above 'closed_counts': is a wire of the reading swapped?");
  t.counts_per_turn = 2 * std::numbers::pi * t.ratio * (open - closed) / model.pinch_travel_m;
  t.max_motor_torque = t.ratio * table.number_or("most_force_n", 0.1, 100, t.max_motor_torque / t.ratio);
  model.pinch.noise_counts = table.integer_or("noise_counts", 0, 100, model.pinch.noise_counts);
  model.pinch.jaw_length_m = table.number_or("jaw_length_m", 0.002, 0.2, model.pinch.jaw_length_m);
  if (model.pinch_travel_m >= 2 * model.pinch.jaw_length_m)
    table.fail("jaw_length_m", "jaws of this length cannot open as far as the slide travels");
  table.finish();
}

const std::vector<std::string> kSensorBodies{"hand", "device"};

void write_mount(std::ostream& out, const SensorMount& s) {
  out << "\n[sensor]\n";
  if (s.rpy_rad) out << "rpy_deg = " << array(Vec3(*s.rpy_rad / file_units::kDegrees)) << '\n';
  out << "body = \"" << kSensorBodies[s.body_on_device ? 1 : 0] << "\"\n";
  if (s.fixture_kg > 0)
    out << "fixture_kg = " << digits(s.fixture_kg)
        << "\nfixture_com_mm = " << array(Vec3(s.fixture_com_F / file_units::kMilli)) << '\n';
  if (s.lag_s) out << "lag_ms = " << digits(*s.lag_s / file_units::kMilli) << '\n';
  if (s.counts_per_n) out << "counts_per_n = " << digits(*s.counts_per_n) << '\n';
  if (s.counts_per_nm) out << "counts_per_nm = " << digits(*s.counts_per_nm) << '\n';
}

SensorMount read_mount(StrictTable table) {
  SensorMount s;
  table.allow("rpy_deg");
  if (table.has("rpy_deg")) s.rpy_rad = table.vector("rpy_deg", -180, 180) * file_units::kDegrees;
  s.body_on_device = table.choice_or("body", kSensorBodies, kSensorBodies[0]) == kSensorBodies[1];
  s.fixture_kg = table.number_or("fixture_kg", 0, 5, 0);
  if (s.fixture_kg > 0 && !s.rpy_rad)
    table.fail("fixture_kg", "its weight cannot be taken away while 'rpy_deg' does not say how the sensor sits");
  s.fixture_com_F = table.vector_or("fixture_com_mm", -500, 500, Vec3::Zero()) * file_units::kMilli;
  if (table.has("fixture_com_mm") && s.fixture_kg == 0)
    table.fail("fixture_com_mm", "without 'fixture_kg' there is no fixture");
  table.allow("lag_ms");
  if (table.has("lag_ms")) s.lag_s = table.number("lag_ms", 0, 1000) * file_units::kMilli;
  for (const auto& [key, value] : {std::pair{"counts_per_n", &s.counts_per_n}, {"counts_per_nm", &s.counts_per_nm}}) {
    table.allow(key);
    if (table.has(key)) *value = table.number(key, 1, 1e9);
  }
  table.finish();
  return s;
}

}  // namespace

std::string device_toml(const DeviceModel& model, const std::string& comment, const std::string& plant) {
  const HomingModel plain;
  const bool homing = model.homing.method != plain.method || model.homing.see_dark;
  const bool pinch = model.pinch.design != PinchDesign::kDirect;
  if (!model.identified_gravity && !homing && !pinch && !model.sensor)
    throw InputError("device file: the model has not been identified");
  std::ostringstream out;
  std::istringstream lines(comment);
  for (std::string line; std::getline(lines, line);) out << "# " << line << '\n';
  if (!plant.empty()) out << "\nplant = \"" << plant << "\"\n";
  if (homing) write_homing(out, model.homing);
  if (pinch) write_pinch(out, model);
  if (model.sensor) write_mount(out, *model.sensor);
  if (!model.identified_gravity) return out.str();
  const IdentifiedGravity& g = *model.identified_gravity;
  out << "\n[gravity]\nplatform_n_m = " << array(g.platform) << "\nlink2_n_m = " << array(g.link2)
      << "\nwrist_n_m = " << array(g.wrist) << "\nstylus_n_m = " << array(g.stylus) << '\n';
  for (int i = 0; i < kArmJoints; ++i) {
    out << "\n[[joint]]  # th" << i + 1 << "\ncoulomb_n_m = " << digits(model.coulomb[i])
        << "\nviscous_n_m_s_per_rad = " << digits(model.viscous[i]) << '\n';
  }
  return out.str();
}

DeviceModel load_device(const std::filesystem::path& file) {
  return parse_device(read_text_file(file.string()), file.string());
}

DeviceModel parse_device(const std::string& text, const std::string& file, std::string* plant) {
  StrictTable root = StrictTable::parse(text, file);
  const std::string identified = root.text_or("plant", "");
  if (plant) *plant = identified;
  DeviceModel model;
  for (const char* table : {"homing", "pinch", "sensor"}) root.allow(table);
  if (root.has("homing")) read_homing(root.table("homing"), model.homing);
  if (root.has("pinch")) read_pinch(root.table("pinch"), model);
  if (root.has("sensor")) model.sensor = read_mount(root.table("sensor"));
  const bool apart =
      root.has("homing") || root.has("pinch") || root.has("sensor");  // such a file need not have been identified
  if (apart && !root.has("gravity") && !root.has("joint")) {
    root.finish();
    return model;
  }
  IdentifiedGravity& g = model.identified_gravity.emplace();
  StrictTable gravity = root.table("gravity");
  g.platform = gravity.vector("platform_n_m", -kMostMoment, kMostMoment);
  g.link2 = two(gravity, "link2_n_m");
  g.wrist = two(gravity, "wrist_n_m");
  g.stylus = two(gravity, "stylus_n_m");
  gravity.finish();
  std::vector<StrictTable> joints = root.tables("joint");
  if (joints.size() != kArmJoints) root.fail("joint", "the arm has six joints, not " + std::to_string(joints.size()));
  for (int i = 0; i < kArmJoints; ++i) {
    StrictTable& joint = joints[static_cast<std::size_t>(i)];
    model.coulomb[i] = joint.number("coulomb_n_m", 0, kMostCoulomb);
    model.viscous[i] = joint.number("viscous_n_m_s_per_rad", 0, kMostViscous);
    joint.finish();
  }
  root.finish();
  return model;
}

}  // namespace trocar
