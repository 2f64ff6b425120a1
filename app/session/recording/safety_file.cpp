#include "app/session/recording/safety_file.h"

#include <cstdio>
#include <fstream>

#include "app/session/recording/recording_sink.h"
#include "haptics/input_error.h"

namespace trocar {
namespace {

constexpr const char* kChangeColumns = "# period,t_s,from,to,cause,channel,value";
constexpr std::size_t kChangeFields = 7, kRowFields = 6 + 2 * kChannels;

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
  std::string out = std::string(kChangeColumns) + '\n';
  for (const SafetyTransition& t : transitions) append_transition(out, t, rate_hz);
  out += "period,state,warnings,valid,elapsed_periods,digital_in";
  for (const char* group : {",count", ",code"}) {
    for (int i = 0; i < kChannels; ++i) out += group + std::to_string(i);
  }
  out += '\n';
  for (const SafetyRow& row : rows) append_row(out, row);
  return out;
}

SafetyFile read_safety_file(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) throw EnvironmentError(file.string() + ": cannot be read (missing file or no permission)");
  SafetyFile out;
  int number = 0;
  const auto fields = [&](const std::string& line, std::size_t expected) {
    SafetyFile::Fields found(1);
    for (const char c : line)
      if (c == ',')
        found.emplace_back();
      else
        found.back() += c;
    if (found.size() != expected)
      throw InputError(file.string(), number, 1,
                       std::to_string(found.size()) + " fields where " + std::to_string(expected) +
                           " are expected: no safety log, or one that was cut off");
    return found;
  };
  for (std::string line; std::getline(in, line);) {
    ++number;
    if (number == 1 && line != kChangeColumns) fields("", kChangeFields);
    if (number == 1) continue;
    if (line.starts_with("# "))
      out.changes.push_back(fields(line.substr(2), kChangeFields));
    else if (out.columns.empty())
      out.columns = fields(line, kRowFields);
    else
      out.rows.push_back(fields(line, kRowFields));
  }
  if (out.columns.empty()) fields("", kChangeFields);
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
