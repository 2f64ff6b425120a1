#include "app/studies/study_files.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>

#include <nlohmann/json.hpp>

#include "haptics/input_error.h"
#include "trainees/files/write_file.h"
#include "trainees/markup/html.h"

namespace trocar {
namespace {

constexpr double kPlotWidth = 720, kPlotHeight = 400, kPlotLeft = 70, kPlotRight = 20, kPlotTop = 40, kPlotBottom = 56;
/// Told apart without colour by their dashes.
constexpr std::array kColours{"#a02c20", "#1f6fb2", "#2e8b57", "#8e6bbf", "#c07a1e", "#404040"};
constexpr std::array kDashes{"none", "7 3", "2 3", "10 3 2 3", "14 4", "5 2 1 2 1 2"};

std::string rounded_text(double value, int digits = 4) {
  std::ostringstream text;
  text << std::setprecision(digits) << value;
  return text.str();
}

std::string csv_field(const std::string& text) { return text.find(',') == std::string::npos ? text : '"' + text + '"'; }

struct Axis {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  double step = 1;
  bool logarithmic = false;  ///< low, high and step are powers of ten
  double last = 0;           ///< above it no tick is named: room for the legend

  /// NaN where it has no place.
  double place(double v) const { return !logarithmic ? v : v > 0 ? std::log10(v) : std::nan(""); }
  std::string name(double tick) const { return rounded_text(logarithmic ? std::pow(10, tick) : tick, 6); }
  void take(const std::vector<double>& values) {
    for (const double value : values) {
      const double v = place(value);
      if (!std::isfinite(v)) continue;
      low = std::min(low, v);
      high = std::max(high, v);
    }
  }
  /// Ticks at 1, 2 or 5 times a power of ten, five to ten of them; the range ends on ticks.
  void round() {
    if (!(low < high)) high = (low = std::isfinite(low) ? low - 0.5 : 0) + 1;
    const double wish = (high - low) / 6, power = std::pow(10, std::floor(std::log10(wish)));
    const double mantissa = wish / power;
    step = logarithmic ? 1 : power * (mantissa < 1.5 ? 1 : mantissa < 3.5 ? 2 : mantissa < 7.5 ? 5 : 10);
    low = step * std::floor(low / step + 1e-9);
    high = step * std::ceil(high / step - 1e-9);
  }
  double share(double place) const { return (place - low) / (high - low); }
};

struct Frame {
  Axis x, y;
  double px(double v) const { return kPlotLeft + x.share(v) * (kPlotWidth - kPlotLeft - kPlotRight); }
  double py(double v) const { return kPlotHeight - kPlotBottom - y.share(v) * (kPlotHeight - kPlotTop - kPlotBottom); }
};

void draw_text(std::ostream& out, double x, double y, const std::string& text, const std::string& more) {
  out << "<text x=\"" << rounded_text(x) << "\" y=\"" << rounded_text(y) << "\" " << more << '>' << escape_html(text)
      << "</text>\n";
}

void draw_axes(std::ostream& out, const Frame& f, const StudyCurves& curves) {
  for (int axis = 0; axis < 2; ++axis) {
    const Axis& a = axis == 0 ? f.x : f.y;
    for (int i = 0; a.low + i * a.step <= a.high + 1e-9 * a.step; ++i) {
      const double v = std::abs(a.low + i * a.step) < 1e-9 * a.step ? 0 : a.low + i * a.step;
      const double x0 = axis == 0 ? f.px(v) : kPlotLeft, x1 = axis == 0 ? x0 : kPlotWidth - kPlotRight;
      const double y0 = axis == 0 ? kPlotTop : f.py(v), y1 = axis == 0 ? kPlotHeight - kPlotBottom : y0;
      out << "<line x1=\"" << rounded_text(x0) << "\" y1=\"" << rounded_text(y0) << "\" x2=\"" << rounded_text(x1)
          << "\" y2=\"" << rounded_text(y1) << "\" stroke=\"" << (v == 0 ? "#888" : "#ddd") << "\"/>\n";
      const std::string name = axis == 1 && a.logarithmic && v > a.last + 1e-9 ? "" : a.name(v);
      const bool at_edge = axis == 0 && name.size() > 5 && x0 > kPlotWidth - kPlotRight - 1;
      draw_text(out, axis == 0 ? x0 + (at_edge ? kPlotRight - 2 : 0) : kPlotLeft - 8,
                axis == 0 ? kPlotHeight - kPlotBottom + 18 : y0 + 4, name,
                axis == 0 && !at_edge ? "text-anchor=\"middle\"" : "text-anchor=\"end\"");
    }
  }
  draw_text(out, kPlotLeft, 22, curves.title, "font-size=\"15\" font-weight=\"bold\"");
  draw_text(out, (kPlotLeft + kPlotWidth - kPlotRight) / 2, kPlotHeight - 14, curves.x_label, "text-anchor=\"middle\"");
  const std::string middle = rounded_text((kPlotTop + kPlotHeight - kPlotBottom) / 2);
  draw_text(out, 16, (kPlotTop + kPlotHeight - kPlotBottom) / 2, curves.y_label,
            "text-anchor=\"middle\" transform=\"rotate(-90 16 " + middle + ")\"");
}

void draw_series(std::ostream& out, const Frame& f, const StudyCurves& curves, std::size_t which) {
  const auto& y = curves.series[which].y;
  const char* colour = kColours[which % kColours.size()];
  bool pen_down = false;
  const char* dash = kDashes[which % kDashes.size()];
  out << "<path fill=\"none\" stroke=\"" << colour << "\" stroke-width=\"2\" stroke-dasharray=\"" << dash << "\" d=\"";
  for (std::size_t i = 0; i < y.size(); ++i) {
    const double at = f.y.place(y[i]);
    if (std::isfinite(at)) {
      out << (pen_down ? 'L' : 'M') << std::fixed << std::setprecision(2) << f.px(f.x.place(curves.x[i])) << ' '
          << f.py(at) << ' ';
    }
    pen_down = std::isfinite(at);
  }
  out << "\"/>\n" << std::defaultfloat;
  const double spacing =
      std::min(160.0, (kPlotWidth - kPlotLeft - kPlotRight - 12) / static_cast<double>(curves.series.size()));
  const double x = kPlotLeft + 12 + spacing * static_cast<double>(which);
  out << "<line x1=\"" << rounded_text(x) << "\" y1=\"" << kPlotTop + 10 << "\" x2=\"" << rounded_text(x + 28)
      << "\" y2=\"" << kPlotTop + 10 << "\" stroke=\"" << colour << "\" stroke-width=\"2.5\" stroke-dasharray=\""
      << dash << "\"/>\n";
  draw_text(out, x + 34, kPlotTop + 14, curves.series[which].name, "");
}

}  // namespace

std::string curves_csv(const StudyCurves& curves) {
  std::ostringstream out;
  out << std::setprecision(9) << csv_field(curves.x_label);
  for (const auto& series : curves.series) out << ',' << csv_field(series.name);
  out << '\n';
  for (std::size_t i = 0; i < curves.x.size(); ++i) {
    out << curves.x[i];
    for (const auto& series : curves.series) out << ',' << series.y[i];
    out << '\n';
  }
  return out.str();
}

std::string curves_svg(const StudyCurves& curves) {
  Frame frame;
  frame.x.logarithmic = frame.y.logarithmic = curves.logarithmic;
  frame.x.take(curves.x);
  for (const auto& series : curves.series) frame.y.take(series.y);
  frame.x.last = frame.x.high;
  frame.y.last = frame.y.high;
  const double head_room = 0.12 * (frame.y.high - frame.y.low);  // the legend lies over no curve
  frame.y.high += head_room;
  frame.x.round();
  frame.y.round();
  std::ostringstream out;
  out << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " << kPlotWidth << ' ' << kPlotHeight << "\" width=\""
      << kPlotWidth << "\" height=\"" << kPlotHeight << "\" font-family=\"sans-serif\" font-size=\"12\">\n"
      << "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n";
  draw_axes(out, frame, curves);
  for (std::size_t i = 0; i < curves.series.size(); ++i) draw_series(out, frame, curves, i);
  out << "</svg>\n";
  return out.str();
}

std::string summary_json(const StudyResult& result) {
  nlohmann::ordered_json json{{"study", result.study}, {"plant", result.plant}, {"cases", nlohmann::json::array()}};
  for (const StudyCase& c : result.cases) {
    nlohmann::ordered_json entry{
        {"name", c.name}, {"value", c.value},          {"unit", c.unit}, {"thesis", nullptr}, {"bar", c.bar},
        {"met", c.met},   {"definition", c.definition}};
    if (c.thesis) entry["thesis"] = *c.thesis;
    json["cases"].push_back(entry);
  }
  if (!result.notes.empty()) json["notes"] = result.notes;
  return json.dump(2) + "\n";
}

std::string table_markdown(const StudyResult& result) {
  std::ostringstream out;
  out << "| measure | unit | " << result.beside << " | Trocar | asked for | met |\n|---|---|---|---|---|---|\n";
  for (const StudyCase& c : result.cases) {
    out << "| " << c.name << " | " << c.unit << " | " << (c.thesis ? rounded_text(*c.thesis) : "-") << " | "
        << rounded_text(c.value) << " | " << c.bar << " | " << (c.met ? "yes" : "no") << " |\n";
  }
  for (const std::string& note : result.notes) out << '\n' << note << '\n';
  return out.str();
}

void write_study(const StudyResult& result, const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw EnvironmentError(folder.string() + ": cannot be made a folder: " + error.message());
  for (const StudyCurves& curves : result.curves) {
    write_file(folder / (curves.file + ".csv"), curves_csv(curves));
    write_file(folder / (curves.file + ".svg"), curves_svg(curves));
  }
  for (const StudyFile& file : result.files) write_file(folder / file.name, file.bytes);
  write_file(folder / "summary.json", summary_json(result));
  write_file(folder / "table.md", table_markdown(result));
}

}  // namespace trocar
