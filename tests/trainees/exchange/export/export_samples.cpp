#include "tests/trainees/exchange/export/export_samples.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

#include "haptics/least_turn.h"

namespace trocar::test {

CsvTable read_csv(const std::string& text) {
  CsvTable table;
  std::size_t at = 0;
  while (at < text.size()) {
    std::vector<std::string> line(1);
    while (true) {
      if (at < text.size() && text[at] == '"') {
        for (++at; at < text.size() && (text[at] != '"' || text.substr(at, 2) == "\"\""); ++at) {
          if (text[at] == '"') ++at;
          line.back() += text[at];
        }
        ++at;  // closing quote
      } else {
        while (at < text.size() && text[at] != ',' && text[at] != '\r' && text[at] != '\n' && text[at] != '"')
          line.back() += text[at++];
      }
      if (at < text.size() && text[at] == ',') {
        ++at;
        line.emplace_back();
        continue;
      }
      EXPECT_EQ(text.substr(at, 2), "\r\n") << "at byte " << at;
      at += 2;
      break;
    }
    table.push_back(line);
  }
  for (const auto& line : table) EXPECT_EQ(line.size(), table.front().size());
  return table;
}

std::string cell_of(const CsvTable& table, const std::string& key, const std::string& header) {
  const auto column = std::find(table.at(0).begin(), table.at(0).end(), header) - table.at(0).begin();
  for (const auto& line : table) {
    if (line.front() == key && static_cast<std::size_t>(column) < line.size())
      return line[static_cast<std::size_t>(column)];
  }
  return "?";
}

std::string bytes_of_file(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  EXPECT_TRUE(in) << file;
  return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<std::string> names_in(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());
  return names;
}

XapiAttempt sample_xapi(double score) {
  XapiAttempt attempt;
  attempt.result = sample_result(score);
  attempt.result.uuid = "01890a5d-ac96-774b-bcce-b302099a8057";
  attempt.result.exercise_id = "surface-touch";
  attempt.result.exercise_version = "1.0";
  attempt.result.level = "L1";
  attempt.result.seed = -7;
  attempt.result.board = 3;
  attempt.result.trainee = "T-secret";
  attempt.result.hand = "mouse";
  attempt.result.rubric_sha256 = std::string(64, 'b');
  attempt.result.recording_sha256 = std::string(64, 'c');
  attempt.result.grade.caps.clear();
  attempt.trainee_uuid = "01890a5d-0000-7000-8000-000000000001";
  attempt.finished_utc = "2026-03-01T09:30:00.123Z";
  attempt.row_hash = std::string(64, 'd');
  attempt.title = "Touch the surface";
  attempt.program = "1.2.3";
  attempt.pass_at = 75;
  return attempt;
}

Trace sample_motion(double rate_hz, double seconds, bool mirrored) {
  Trace trace;
  trace.rate_hz = rate_hz;
  const auto count = static_cast<std::size_t>(std::floor(seconds * rate_hz + 1e-6)) + 1;
  for (std::size_t i = 0; i < count; ++i) {
    TraceSample s;
    s.t_s = static_cast<double>(i) / rate_hz;
    const double w = 2 * M_PI * s.t_s;
    s.tip_T = Vec3(0.04 * std::sin(0.31 * w) + 0.004 * std::sin(1.7 * w), 0.03 * std::cos(0.23 * w),
                   0.1 + 0.02 * std::sin(0.47 * w + 1));
    s.shaft_T = Vec3(0.3 * std::sin(0.2 * w), 0.25 * std::cos(0.13 * w), -1).normalized();
    if (mirrored) s.tip_T.x() = -s.tip_T.x();
    if (mirrored) s.shaft_T.x() = -s.shaft_T.x();
    s.jaw_opening_m = 0.01 + 0.009 * std::sin(0.5 * w);
    trace.samples.push_back(s);
  }
  return trace;
}

std::string jigsaws_layout(const Trace& trace) {
  std::ostringstream out;
  out.precision(17);
  for (const TraceSample& sample : trace.samples) {
    const Mat3 R = least_turn(Vec3::UnitZ(), sample.shaft_T).toRotationMatrix();
    for (int i = 0; i < 57; ++i) out << "0 ";
    out << sample.tip_T.transpose() << ' ' << R.row(0) << ' ' << R.row(1) << ' ' << R.row(2) << " 0 0 0 0 0 0 "
        << 2 * std::asin(sample.jaw_opening_m / (2 * 0.020)) << '\n';  // jaws of 20 mm
  }
  return out.str();
}

}  // namespace trocar::test
