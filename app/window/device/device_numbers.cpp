#include "app/window/device/device_numbers.h"

#include <cmath>
#include <cstdio>

#include "haptics/device/transmission.h"
#include "haptics/kinematics/device_geometry.h"
#include "haptics/kinematics/forward_solutions.h"
#include "haptics/kinematics/hybrid_arm.h"

namespace trocar {
namespace {

/// SI to what the panel shows: the pinch's m and N are mm and N, the joints' rad and N m are deg and mN m.
double shown_angle(const ChannelVector& v, int i) { return i == kPinchChannel ? 1e3 * v[i] : v[i] / kDegree; }
double shown_torque(const ChannelVector& v, int i) { return i == kPinchChannel ? v[i] : 1e3 * v[i]; }

std::string name_of(int channel) { return channel == kPinchChannel ? "pinch" : "q" + std::to_string(channel + 1); }

std::vector<std::string> vector_row(const char* name, const Vec3& v) {
  return {name, fixed_number(v.x(), 7, 3), fixed_number(v.y(), 7, 3), fixed_number(v.z(), 7, 3),
          fixed_number(v.norm(), 7, 3)};
}

void add_line(std::string& out, const std::string& name, double value, const char* unit) {
  char number[40];
  std::snprintf(number, sizeof number, "%.9g", value);
  out += name + "," + number + "," + unit + "\n";
}

}  // namespace

DeviceReading device_reading(const TickRecord& record, const HapticLoopConfig& loop) {
  DeviceReading out;
  out.t_s = record.stylus.t_s;
  out.q = record.q;
  out.qd = record.qd;
  out.asked = record.torque;
  out.delivered = torques_of(loop.device, record.out, loop.daq.dac_bits);
  if (!record.amplifiers_armed) out.delivered.setZero();
  const JointVector q = record.q.head<kArmJoints>();
  out.X_WS = arm_state(q).X_WS;
  out.R_WP = forward_solutions(q)[0].R_WP;
  out.tip_force_T = record.stylus.F_I_T.force;
  out.stylus_force_T = record.stylus.rendered_force_T;
  out.grip_n = record.stylus.rendered_grip_n;
  out.det_a = record.det_a;
  out.winding_c = record.winding_c;
  out.energy_j = record.stylus.energy_j;
  out.k_max_n_per_m = record.k_max_n_per_m;
  out.stiffness_n_per_m = record.stiffness_n_per_m;
  out.state = record.stylus.loop;
  out.homing = record.stylus.homing;
  out.loop = loop_state_name(record.stylus.loop);
  out.saturated = record.stylus.saturated;
  out.passivity_active = record.stylus.passivity_active;
  return out;
}

std::string fixed_number(double value, int width, int decimals) {
  char text[48];
  std::snprintf(text, sizeof text, "%+.*f", decimals, value);
  std::string out = text;
  if (out.find_first_not_of("-0.") == std::string::npos) out.front() = '+';  // nothing has no sign that could flicker
  if (!std::isfinite(value)) out = value > 0 ? "inf" : "-";
  const int length = static_cast<int>(out.size());
  if (length > width) return std::string(static_cast<std::size_t>(width), '>');
  return out;
}

std::vector<std::vector<std::string>> joint_rows(const DeviceReading& r) {
  std::vector<std::vector<std::string>> rows;
  for (int i = 0; i < kChannels; ++i)
    rows.push_back({name_of(i), fixed_number(shown_angle(r.q, i), 8, 2), fixed_number(shown_angle(r.qd, i), 8, 1),
                    fixed_number(shown_torque(r.asked, i), 8, 2), fixed_number(shown_torque(r.delivered, i), 8, 2)});
  return rows;
}

std::vector<std::vector<std::string>> stylus_matrix(const DeviceReading& r) {
  std::vector<std::vector<std::string>> rows;
  for (int i = 0; i < 3; ++i) {
    std::vector<std::string> row;
    for (int k = 0; k < 3; ++k) row.push_back(fixed_number(r.X_WS.R(i, k), 6, 3));
    row.push_back(fixed_number(1e3 * r.X_WS.p[i], 8, 2));
    rows.push_back(row);
  }
  rows.push_back({fixed_number(0, 6, 3), fixed_number(0, 6, 3), fixed_number(0, 6, 3), fixed_number(1, 8, 2)});
  return rows;
}

std::vector<std::vector<std::string>> platform_matrix(const DeviceReading& r) {
  std::vector<std::vector<std::string>> rows;
  for (int i = 0; i < 3; ++i)
    rows.push_back(
        {fixed_number(r.R_WP(i, 0), 6, 3), fixed_number(r.R_WP(i, 1), 6, 3), fixed_number(r.R_WP(i, 2), 6, 3)});
  return rows;
}

std::vector<std::vector<std::string>> force_rows(const DeviceReading& r) {
  return {vector_row("tip", r.tip_force_T), vector_row("stylus", r.stylus_force_T)};
}

std::string device_csv(const DeviceReading& r) {
  std::string out = "name,value,unit\n";
  add_line(out, "t", r.t_s, "s");
  for (int i = 0; i < kChannels; ++i) {
    const bool pinch = i == kPinchChannel;
    add_line(out, name_of(i), shown_angle(r.q, i), pinch ? "mm" : "deg");
    add_line(out, name_of(i) + "_rate", shown_angle(r.qd, i), pinch ? "mm/s" : "deg/s");
    add_line(out, name_of(i) + "_asked", shown_torque(r.asked, i), pinch ? "N" : "mN m");
    add_line(out, name_of(i) + "_delivered", shown_torque(r.delivered, i), pinch ? "N" : "mN m");
  }
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k)
      add_line(out, "R_WS_" + std::to_string(i + 1) + std::to_string(k + 1), r.X_WS.R(i, k), "1");
  for (int i = 0; i < 3; ++i) add_line(out, std::string("p_WS_") + "xyz"[i], 1e3 * r.X_WS.p[i], "mm");
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k)
      add_line(out, "R_WP_" + std::to_string(i + 1) + std::to_string(k + 1), r.R_WP(i, k), "1");
  for (int i = 0; i < 3; ++i) add_line(out, std::string("tip_force_") + "xyz"[i], r.tip_force_T[i], "N");
  for (int i = 0; i < 3; ++i) add_line(out, std::string("stylus_force_") + "xyz"[i], r.stylus_force_T[i], "N");
  add_line(out, "grip", r.grip_n, "N");
  add_line(out, "det_A", r.det_a, "1");
  add_line(out, "winding", r.winding_c, "C");
  add_line(out, "energy", 1e3 * r.energy_j, "mJ");
  add_line(out, "k_max", r.k_max_n_per_m, "N/m");
  add_line(out, "stiffness", r.stiffness_n_per_m, "N/m");
  add_line(out, "saturated", r.saturated ? 1 : 0, "1");
  add_line(out, "passivity_active", r.passivity_active ? 1 : 0, "1");
  return out + "loop," + r.loop + ",\n";
}

}  // namespace trocar
