#include "app/cli/device/device_forward.h"

#include <cmath>
#include <iomanip>
#include <iostream>
#include <memory>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "app/cli/command.h"
#include "app/cli/device/numeric_csv.h"
#include "haptics/input_error.h"
#include "haptics/kinematics/forward_solutions.h"
#include "haptics/kinematics/hybrid_arm.h"

namespace trocar {
namespace {

JointVector angles_of(const std::vector<double>& deg) {
  if (deg.size() != kArmJoints) {
    throw InputError("--deg: " + std::to_string(deg.size()) + " angles given, six are needed: th1,th2,...,th6");
  }
  JointVector q;
  for (int i = 0; i < kArmJoints; ++i) {
    q[i] = deg[static_cast<std::size_t>(i)] * kDegree;
    if (!std::isfinite(q[i])) throw InputError("--deg: angle " + std::to_string(i + 1) + " is not a finite number");
  }
  return q;
}

std::vector<double> pose_row(const Pose& X) {
  std::vector<double> row;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) row.push_back(X.R(i, j));
    row.push_back(X.p[i]);
  }
  return row;
}

void print_json(const JointVector& q, std::ostream& out) {
  nlohmann::ordered_json json{{"q_rad", std::vector<double>(q.begin(), q.end())},
                              {"in_limits", joint_limit_margin(q) >= 0},
                              {"solutions", nlohmann::ordered_json::array()}};
  for (const ForwardSolution& s : forward_solutions(q)) {
    json["solutions"].push_back({{"meaning", s.meaning},
                                 {"trivial", s.trivial},
                                 {"residual", s.residual},
                                 {"ring_room_m", s.ring_room_m},
                                 {"det_a", s.det_a},
                                 {"X_WS", pose_row(s.X_WS)}});
  }
  out << json.dump(2) << '\n';
}

void print_table(const JointVector& q, std::ostream& out) {
  out << "stylus in W', mm; residual |W.V|; det A; room of l1 in the base ring, mm\n" << std::fixed;
  int number = 1;
  for (const ForwardSolution& s : forward_solutions(q)) {
    const Vec3 mm = 1e3 * s.X_WS.p;
    out << number++ << "  " << std::setprecision(4) << std::setw(10) << mm.x() << std::setw(11) << mm.y()
        << std::setw(11) << mm.z() << "  " << std::scientific << std::setprecision(0) << s.residual << std::fixed
        << std::setprecision(3) << std::setw(8) << s.det_a << std::setprecision(1) << std::setw(7)
        << 1e3 * s.ring_room_m << "  " << s.meaning << '\n';
  }
  out << std::defaultfloat;
  if (joint_limit_margin(q) < 0) out << "th1..th5 outside the limits of table 2.4\n";
  out << "th6 is unwrapped: it counts whole turns and has no stop; poses repeat every 360 deg\n";
}

void write_table(const ForwardOptions& options, std::ostream& err) {
  const NumericCsv in = read_numeric_csv(options.table_in);
  NumericCsv table;
  table.columns = {"row", "solution", "trivial", "residual", "ring_room_m", "det_a", "T00", "T01", "T02",
                   "T03", "T10",      "T11",     "T12",      "T13",         "T20",   "T21", "T22", "T23"};
  for (std::size_t i = 0; i < in.rows.size(); ++i) {
    JointVector q;
    for (int j = 0; j < kArmJoints; ++j) {
      q[j] = in.rows[i][in.require("q" + std::to_string(j + 1) + "_rad", options.table_in)];
    }
    double number = 0;
    for (const ForwardSolution& s : forward_solutions(q)) {
      std::vector<double>& row = table.rows.emplace_back();
      row = {double(i), number++, s.trivial ? 1.0 : 0.0, s.residual, s.ring_room_m, s.det_a};
      const auto pose = pose_row(s.X_WS);
      row.insert(row.end(), pose.begin(), pose.end());
    }
  }
  write_numeric_csv(options.table_out, table);
  err << "trocar: " << table.rows.size() << " solutions of " << in.rows.size() << " configurations into "
      << options.table_out.string() << '\n';
}

}  // namespace

int device_forward(const ForwardOptions& options, std::ostream& out, std::ostream& err) {
  if (options.angle_deg.empty() == options.table_in.empty()) {
    throw InputError("device fk: give either --deg th1,...,th6 or --csv IN --out OUT");
  }
  if (!options.table_in.empty() && options.table_out.empty()) throw InputError("device fk: --csv needs --out OUT");
  if (!options.table_in.empty())
    write_table(options, err);
  else if (options.json)
    print_json(angles_of(options.angle_deg), out);
  else
    print_table(angles_of(options.angle_deg), out);
  return 0;
}

void add_device_forward(CLI::App& parent, CommandAction& chosen) {
  const auto given = std::make_shared<ForwardOptions>();
  ForwardOptions& o = *given;
  CLI::App* fk = add_command(parent, "fk", "All eight forward solutions of joint angles", chosen,
                             [given] { return device_forward(*given, std::cout, std::cerr); });
  fk->add_option("--deg", o.angle_deg, "th1,...,th6 in degrees")->delimiter(',');
  fk->add_option("--csv", o.table_in, "Input table instead of --deg");
  fk->add_option("--out", o.table_out, "Output table")->check(writable_path());
  fk->add_flag("--json", o.json, "As JSON");
}

}  // namespace trocar
