// `trocar device fk`: all eight forward solutions of joint angles with their meaning and loop residual.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <vector>

namespace trocar {

struct ForwardOptions {
  std::vector<double> angle_deg;  ///< th1..th6; th6 may have any value, it is unwrapped
  bool json = false;
  std::filesystem::path table_in;   ///< instead of angle_deg: a table with q1_rad..q6_rad
  std::filesystem::path table_out;  ///< where its solutions go
};

/// Angles: a table (or JSON) on `out`. Table: row,solution,trivial,residual,ring_room_m,det_a,T00..T23 for each
/// solution.
/// @return 0. @throws InputError when neither or both are given, angles are not six finite numbers, or the table is
/// bad.
int device_forward(const ForwardOptions& options, std::ostream& out, std::ostream& err);

}  // namespace trocar
