#include "trainees/exchange/export/trace_tables.h"

#include "trainees/markup/csv.h"

namespace trocar {
namespace {

void add(std::vector<std::string>& fields, const Vec3& v) {
  for (int axis = 0; axis < 3; ++axis) fields.push_back(csv_number(v[axis]));
}

std::string csv_flag(bool value) { return value ? "1" : "0"; }

}  // namespace

void write_trace_csv(const Trace& trace, std::ostream& out) {
  out << csv_line({"t_s",           "tip_x_m",    "tip_y_m",   "tip_z_m",          "shaft_x_1",
                   "shaft_y_1",     "shaft_z_1",  "force_x_n", "force_y_n",        "force_z_n",
                   "commanded_n",   "rendered_n", "grip_n",    "jaw_opening_m",    "stiffness_n_per_m",
                   "k_max_n_per_m", "contact",    "saturated", "passivity_active", "pedal",
                   "instrument"});
  std::vector<std::string> fields;
  for (const TraceSample& sample : trace.samples) {
    fields = {csv_number(sample.t_s)};
    for (const Vec3* v : {&sample.tip_T, &sample.shaft_T, &sample.force_T}) add(fields, *v);
    for (const double value : {sample.commanded_n, sample.rendered_n, sample.grip_n, sample.jaw_opening_m,
                               sample.stiffness_n_per_m, sample.k_max_n_per_m})
      fields.push_back(csv_number(value));
    for (const bool flag : {sample.contact, sample.saturated, sample.passivity_active, sample.pedal})
      fields.push_back(csv_flag(flag));
    fields.push_back(std::to_string(sample.instrument));
    out << csv_line(fields);
  }
}

void write_events_csv(const std::vector<Event>& events, std::ostream& out) {
  out << csv_line({"t_s", "type", "severity", "object", "value", "unit", "tip_x_m", "tip_y_m", "tip_z_m"});
  for (const Event& event : events) {
    std::vector<std::string> fields{csv_number(event.t_s),         csv_text(event.type),
                                    severity_name(event.severity), std::to_string(event.object),
                                    csv_number(event.value),       csv_text(event.unit)};
    add(fields, event.tip_T);
    out << csv_line(fields);
  }
}

}  // namespace trocar
