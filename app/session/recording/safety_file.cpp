#include "app/session/recording/safety_file.h"

#include <cstdio>

#include "app/session/recording/recording_sink.h"

namespace trocar {
namespace {

std::string decimal(double value, const char* format) {
  char text[48];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

void append_transition(std::string& out, const SafetyTransition& t, double rate_hz) {
  out += "# " + std::to_string(t.period) + ',' + decimal(static_cast<double>(t.period) / rate_hz, "%.6f") + ',' +
         loop_state_name(t.from) + ',' + loop_state_name(t.to) + ',' + fault_name(t.fault.code) + ',' +
         std::to_string(t.fault.channel) + ',' + decimal(t.fault.value, "%.9g") + '\n';
}

void append_row(std::string& out, const SafetyRow& row) {
  out += std::to_string(row.period) + ',' + loop_state_name(row.state) + ',' + std::to_string(row.warnings) + ',' +
         std::to_string(row.valid) + ',' + std::to_string(row.elapsed_periods) + ',' + std::to_string(row.digital_in);
  for (const std::int32_t count : row.counts) out += ',' + std::to_string(count);
  for (const std::int32_t code : row.codes) out += ',' + std::to_string(code);
  out += '\n';
}

}  // namespace

std::string safety_csv(const std::vector<SafetyTransition>& transitions, const std::vector<SafetyRow>& rows,
                       double rate_hz) {
  std::string out = "# period,t_s,from,to,cause,channel,value\n";
  for (const SafetyTransition& t : transitions) append_transition(out, t, rate_hz);
  out += "period,state,warnings,valid,elapsed_periods,digital_in";
  for (const char* group : {",count", ",code"}) {
    for (int i = 0; i < kChannels; ++i) out += group + std::to_string(i);
  }
  out += '\n';
  for (const SafetyRow& row : rows) append_row(out, row);
  return out;
}

std::filesystem::path safety_file_of(const std::filesystem::path& recording) {
  std::filesystem::path file = recording;
  return file.replace_extension(".safety.csv");
}

void write_safety_file(const std::filesystem::path& file, const std::string& csv) {
  FileSink sink(file);
  sink.append(csv);
  sink.sync();
}

}  // namespace trocar
