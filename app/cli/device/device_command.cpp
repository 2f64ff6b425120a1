#include "app/cli/device/device_command.h"

#include <array>
#include <iostream>
#include <memory>
#include <optional>

#include <CLI/CLI.hpp>

#include "app/cli/command.h"
#include "app/cli/device/numeric_csv.h"
#include "haptics/control/gravity.h"
#include "haptics/input_error.h"
#include "haptics/kinematics/hybrid_arm.h"
#include "haptics/kinematics/inverse_kinematics.h"
#include "scenarios/files/device_file.h"

namespace trocar {
namespace {

using Names = std::array<const char*, 6>;

constexpr Names kAngles{"q1_rad", "q2_rad", "q3_rad", "q4_rad", "q5_rad", "q6_rad"};
constexpr Names kRates{"qd1_rad_s", "qd2_rad_s", "qd3_rad_s", "qd4_rad_s", "qd5_rad_s", "qd6_rad_s"};
constexpr Names kWrench{"fx6_N", "fy6_N", "fz6_N", "mx6_Nm", "my6_Nm", "mz6_Nm"};
constexpr Names kTwist{"vx_m_s", "vy_m_s", "vz_m_s", "wx_rad_s", "wy_rad_s", "wz_rad_s"};
constexpr Names kTorque{"tau1_Nm", "tau2_Nm", "tau3_Nm", "tau4_Nm", "tau5_Nm", "tau6_Nm"};
constexpr Names kHolding{"taug1_Nm", "taug2_Nm", "taug3_Nm", "taug4_Nm", "taug5_Nm", "taug6_Nm"};
constexpr std::array<const char*, 12> kPose{"T00", "T01", "T02", "T03", "T10", "T11",
                                            "T12", "T13", "T20", "T21", "T22", "T23"};
constexpr double kConditioningLength = 0.2;  // m: linear rows of J are divided by this

Vec6 read_six(const NumericCsv& csv, std::size_t row, const Names& names, const std::filesystem::path& file) {
  Vec6 values;
  for (int i = 0; i < 6; ++i) values[i] = csv.rows[row][csv.require(names[i], file)];
  return values;
}

/// The six columns when the table has any of them (then it must have all), else nothing.
std::optional<Vec6> read_optional_six(const NumericCsv& csv, std::size_t row, const Names& names,
                                      const std::filesystem::path& file) {
  for (const char* name : names) {
    if (csv.find(name)) return read_six(csv, row, names, file);
  }
  return std::nullopt;
}

void append(std::vector<double>& row, const Vec6& values) { row.insert(row.end(), values.begin(), values.end()); }

void append_pose(std::vector<double>& row, const Pose& X) {
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) row.push_back(X.R(i, j));
    row.push_back(X.p[i]);
  }
}

Pose read_pose(const NumericCsv& csv, std::size_t row, const std::filesystem::path& file) {
  Pose X;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) X.R(i, j) = csv.rows[row][csv.require(kPose[4 * i + j], file)];
    X.p[i] = csv.rows[row][csv.require(kPose[4 * i + 3], file)];
  }
  if ((X.R.transpose() * X.R - Mat3::Identity()).norm() > 1e-6 || X.R.determinant() < 0) {
    throw InputError(file.string(), static_cast<int>(row) + 2, 1, "T00..T22 is not a rotation matrix");
  }
  return X;
}

}  // namespace

int device_eval(const std::filesystem::path& input, const std::filesystem::path& output, std::ostream& err,
                const std::filesystem::path& device) {
  const DeviceModel model = device.empty() ? DeviceModel{} : load_device(device);
  const NumericCsv in = read_numeric_csv(input);
  NumericCsv out;
  for (const auto* names : {&kAngles}) out.columns.insert(out.columns.end(), names->begin(), names->end());
  out.columns.insert(out.columns.end(), kPose.begin(), kPose.end());
  const bool rates = in.find(kRates[0]).has_value(), wrench = in.find(kWrench[0]).has_value();
  const auto add = [&](const Names& names) { out.columns.insert(out.columns.end(), names.begin(), names.end()); };
  if (rates) add(kRates), add(kTwist);
  if (wrench) add(kWrench), add(kTorque);
  add(kHolding);
  out.columns.push_back("sigma_min_L0.2m");

  for (std::size_t i = 0; i < in.rows.size(); ++i) {
    const JointVector q = read_six(in, i, kAngles, input);
    const ArmState arm = arm_state(q);
    std::vector<double>& row = out.rows.emplace_back();
    append(row, q);
    append_pose(row, arm.X_WS);
    if (const auto qd = read_optional_six(in, i, kRates, input)) {
      append(row, *qd);
      append(row, arm.J_WS * *qd);
    }
    if (const auto w = read_optional_six(in, i, kWrench, input)) {
      Vec6 w_W;  // from the stylus frame into W'
      w_W << arm.X_WS.R * w->head<3>(), arm.X_WS.R * w->tail<3>();
      append(row, *w);
      append(row, arm.J_WS.transpose() * w_W);
    }
    append(row, gravity_torque(model, arm));
    row.push_back(smallest_singular_value(arm.J_WS, kConditioningLength));
  }
  write_numeric_csv(output, out);
  err << "trocar: " << out.rows.size() << " poses evaluated into " << output.string() << '\n';
  return 0;
}

int device_ik(const std::filesystem::path& input, const std::filesystem::path& output, std::ostream& err) {
  const NumericCsv in = read_numeric_csv(input);
  NumericCsv out;
  out.columns = {"row", "solution", "in_limits"};
  out.columns.insert(out.columns.end(), kAngles.begin(), kAngles.end());
  int unsolved = 0;
  for (std::size_t i = 0; i < in.rows.size(); ++i) {
    const InverseSolutions solutions = inverse_kinematics(read_pose(in, i, input));
    if (solutions.count == 0) {
      ++unsolved;
      err << input.string() << ':' << i + 2 << ": no solution: ";
      if (solutions.missed_by_m > 0)
        err << "out of reach by " << solutions.missed_by_m * 1e3 << " mm\n";
      else
        err << "the stylus axis points through the centre of rotation, the arm plane is undefined\n";
    }
    for (int k = 0; k < solutions.count; ++k) {
      std::vector<double>& row = out.rows.emplace_back();
      row = {static_cast<double>(i), static_cast<double>(k), solutions.candidate[k].in_limits ? 1.0 : 0.0};
      append(row, solutions.candidate[k].q);
    }
  }
  write_numeric_csv(output, out);
  err << "trocar: " << out.rows.size() << " candidates for " << in.rows.size() << " poses into " << output.string()
      << '\n';
  return unsolved == 0 ? 0 : 2;
}

namespace {

struct TableArguments {
  std::filesystem::path in, out, device;
};

void add_tables(CLI::App& command, TableArguments& o) {
  command.add_option("--csv", o.in, "Input table")->required();
  command.add_option("--out", o.out, "Output table")->required()->check(writable_path());
}

}  // namespace

void add_device_eval(CLI::App& parent, CommandAction& chosen) {
  const auto given = std::make_shared<TableArguments>();
  CLI::App* eval = add_command(parent, "eval", "Pose, twist, torques, gravity, conditioning of joint angles", chosen,
                               [given] { return device_eval(given->in, given->out, std::cerr, given->device); });
  add_tables(*eval, *given);
  eval->add_option("--device", given->device, "Device file with identified weights (default: nominal)")
      ->check(file_name());
}

void add_device_ik(CLI::App& parent, CommandAction& chosen) {
  const auto given = std::make_shared<TableArguments>();
  CLI::App* ik = add_command(parent, "ik", "Every inverse kinematic candidate of stylus poses", chosen,
                             [given] { return device_ik(given->in, given->out, std::cerr); });
  add_tables(*ik, *given);
}

}  // namespace trocar
