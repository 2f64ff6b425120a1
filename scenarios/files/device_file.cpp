#include "scenarios/files/device_file.h"

#include <charconv>
#include <sstream>

#include "haptics/input_error.h"
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

}  // namespace

std::string device_toml(const DeviceModel& model, const std::string& comment, const std::string& plant) {
  if (!model.identified_gravity) throw InputError("device file: the model has not been identified");
  const IdentifiedGravity& g = *model.identified_gravity;
  std::ostringstream out;
  std::istringstream lines(comment);
  for (std::string line; std::getline(lines, line);) out << "# " << line << '\n';
  if (!plant.empty()) out << "\nplant = \"" << plant << "\"\n";
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
