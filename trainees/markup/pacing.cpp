#include "trainees/markup/pacing.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include <nlohmann/json.hpp>

#include "trainees/markup/html.h"
#include "trainees/markup/svg.h"

namespace trocar {
namespace {

using svg::attribute;
using svg::label;
using svg::line;
using svg::px;
using svg::rect;
using PacingJson = nlohmann::json;

template <typename T>
std::optional<T> pacing_value(const PacingJson& json, const char* name) {
  const auto at = json.find(name);
  if (at == json.end()) return std::nullopt;
  if constexpr (std::is_same_v<T, bool>)
    return at->is_boolean() ? std::optional<T>(at->get<T>()) : std::nullopt;
  else if constexpr (std::is_same_v<T, std::string>)
    return at->is_string() ? std::optional<T>(at->get<T>()) : std::nullopt;
  else if constexpr (std::is_integral_v<T>)
    return at->is_number_unsigned() ? std::optional<T>(at->get<T>()) : std::nullopt;
  else
    return at->is_number() ? std::optional<T>(at->get<T>()) : std::nullopt;
}

PacingJson pacing_part(const PacingJson& json, const char* name) {
  const auto at = json.find(name);
  return at != json.end() && at->is_object() ? *at : PacingJson::object();
}

PacingSpread pacing_spread(const PacingJson& lane, const char* name, const char* bins) {
  const PacingJson json = pacing_part(lane, name);
  const auto percentile = [&](const char* share) { return pacing_value<double>(json, share).value_or(0); };
  PacingSpread out{percentile("p50"), percentile("p90"), percentile("p99"), percentile("p99.9"), percentile("max")};
  const PacingJson counted = pacing_part(json, bins);
  for (const auto& [key, count] : counted.items()) {
    std::int64_t lower = 0;
    const auto [end, error] = std::from_chars(key.data(), key.data() + key.size(), lower);
    if (error == std::errc{} && end == key.data() + key.size() && count.is_number_unsigned() &&
        std::abs(lower) <= 1'000'000)
      out.bins[lower] = count.get<std::uint64_t>();
  }
  return out;
}

std::string microseconds(double us) {
  return us < 1000 ? number_text(us) + " \xC2\xB5s" : number_text(std::round(us / 10) / 100) + " ms";
}

std::string spread_text(const PacingSpread& s) {
  return "half within " + microseconds(s.p50_us) + ", 99 % within " + microseconds(s.p99_us) + ", 99.9 % within " +
         microseconds(s.p999_us) + ", longest " + microseconds(s.max_us);
}

constexpr double kPacingWidth = 1000, kPacingHeight = 250, kPacingTop = 34, kPacingBottom = 196, kPanel = 280,
                 kPanelGap = 38, kPanelLeft = 66, kCharacter = 7.6;
constexpr int kInDecade = 6;  // bins

/// Place of a bin in the row of all bins: 1, 2, 3, 5, 7, 10, 15, 20 ...; those below zero to the left.
double place_of(std::int64_t lower_us) {
  constexpr std::array<double, 6> kSteps{10, 15, 20, 30, 50, 70};  // of a decade
  auto magnitude = static_cast<double>(std::abs(lower_us));
  double place = std::min(magnitude, 3.0) + (magnitude >= 5 ? 1 : 0) + (magnitude >= 7 ? 1 : 0);
  if (magnitude >= 10) {
    for (place = kInDecade; magnitude >= 100; magnitude /= 10) place += kInDecade;
    for (std::size_t i = 1; i < kSteps.size(); ++i) place += magnitude >= kSteps[i] ? 1 : 0;
  }
  return lower_us < 0 ? -place : place;
}

std::string tick_words(std::int64_t us) {
  const std::int64_t magnitude = std::abs(us);
  const std::string sign = us < 0 ? "\xE2\x88\x92" : "";
  return sign + (magnitude >= 1'000'000 ? "1 s"
                 : magnitude >= 1000    ? std::to_string(magnitude / 1000) + " ms"
                                        : std::to_string(magnitude));
}

/// One histogram, both axes logarithmic: a single late tick among thousands must be seen.
class PacingPanel {
 public:
  PacingPanel(const PacingSpread& spread, double left, int decades)
      : bins_(spread.bins),
        left_(left),
        decades_(decades),
        low_(bins_.empty() ? 0 : place_of(bins_.begin()->first) - 1) {
    high_ = std::max(bins_.empty() ? 0.0 : place_of(bins_.rbegin()->first) + 2, low_ + 12);
  }
  std::string drawn(const std::string& title, bool names_counts, double period_us) const {
    std::string out = label(left_, 20, title, "start", "font-weight=\"bold\"");
    for (int decade = 0; decade <= decades_; ++decade) {
      out += line(left_, y(decade), left_ + kPanel, y(decade), "stroke=\"#000\" stroke-opacity=\"0.12\"");
      if (names_counts) out += label(left_ - 6, y(decade) + 5, fixed_text(std::pow(10, decade), 0), "end");
    }
    for (const auto& [lower, count] : bins_) {
      if (count == 0) continue;
      const double top = y(std::log10(static_cast<double>(count)));
      out += rect(x(place_of(lower)) + 0.5, top, std::max(1.0, step() - 1), kPacingBottom - top, "fill=\"#0072b2\"");
    }
    const double one = x(place_of(static_cast<std::int64_t>(period_us)));
    if (one < left_ + kPanel)
      out +=
          line(one, kPacingTop, one, kPacingBottom, "stroke=\"#d55e00\" stroke-width=\"2\" stroke-dasharray=\"6 3\"");
    return out + line(left_, kPacingBottom, left_ + kPanel, kPacingBottom, "stroke=\"#555\"") + abscissa();
  }

 private:
  double step() const { return kPanel / (high_ - low_); }
  double x(double place) const { return left_ + step() * (place - low_); }
  double y(double decade) const {
    return kPacingBottom - 10 - (kPacingBottom - 10 - kPacingTop) * decade / std::max(1, decades_);
  }
  /// Powers of ten, as many as have room; zero first.
  std::string abscissa() const {
    std::string out;
    std::vector<std::pair<double, double>> taken;
    for (const std::int64_t us :
         {0L, 10L, 1000L, -10L, -1000L, 100L, -100L, 10'000L, 100'000L, 1'000'000L, -10'000L, 1L}) {
      const double tick = x(place_of(us) + (us < 0 ? 1 : 0));  // a bin below zero ends there
      const double half = kCharacter * static_cast<double>(tick_words(us).size()) / 2;
      if (tick < left_ - 1 || tick > left_ + kPanel + 1) continue;
      out += line(tick, kPacingBottom, tick, kPacingBottom + 4, "stroke=\"#555\"");
      const double at = std::clamp(tick, left_ + half - 8, left_ + kPanel - half + 8);  // off the next panel's
      if (std::any_of(taken.begin(), taken.end(),
                      [&](const auto& other) { return std::abs(other.first - at) < other.second + half + 4; }))
        continue;
      taken.emplace_back(at, half);
      out += label(at, kPacingBottom + 19, tick_words(us), "middle");
    }
    return out;
  }

  const std::map<std::int64_t, std::uint64_t>& bins_;
  double left_;
  int decades_;
  double low_, high_ = 0;
};

}  // namespace

std::optional<Pacing> parse_pacing(const std::string& realtime) {
  const PacingJson json = PacingJson::parse(realtime, nullptr, false);
  if (!json.is_object()) return std::nullopt;
  const PacingJson lane = pacing_part(pacing_part(json, "lanes"), "haptic");
  if (lane.empty()) return std::nullopt;
  Pacing out;
  out.scheduler = pacing_value<std::string>(lane, "policy").value_or("");
  out.refused = pacing_value<std::string>(lane, "refused").value_or("");
  out.kernel = pacing_value<std::string>(json, "kernel").value_or("");
  out.kernel_realtime = pacing_value<bool>(json, "kernel_realtime").value_or(false);
  out.memory_locked = pacing_value<bool>(json, "memory_locked").value_or(false);
  out.processors_awake = pacing_value<bool>(json, "processors_awake");
  out.processors = pacing_value<std::int64_t>(json, "processors").value_or(0);
  out.processor = pacing_value<std::int64_t>(lane, "processor");
  out.load = pacing_value<double>(json, "load");
  out.rate_hz = pacing_value<double>(lane, "rate_hz").value_or(0);
  out.longest_gap_ms = pacing_value<double>(lane, "longest_gap_ms").value_or(0);
  out.wakes = pacing_value<std::uint64_t>(lane, "wakes").value_or(0);
  out.missed = pacing_value<std::uint64_t>(lane, "missed").value_or(0);
  out.overruns = pacing_value<std::uint64_t>(lane, "overruns").value_or(0);
  out.late = pacing_spread(lane, "late_us", "bins");
  out.period = pacing_spread(lane, "period_us", "off_bins");
  out.work = pacing_spread(lane, "cpu_us", "bins");
  return out;
}

std::vector<std::pair<std::string, std::string>> pacing_facts(const Pacing& p) {
  std::vector<std::pair<std::string, std::string>> out{
      {"Scheduler", p.scheduler.empty() ? "not recorded" : p.scheduler},
      {"Memory", p.memory_locked ? "locked" : "not locked"},
      {"Mean rate", fixed_text(p.rate_hz, 1) + " Hz"},
      {"Longest gap", fixed_text(p.longest_gap_ms, 2) + " ms"},
      {"Ticks that took too long", std::to_string(p.overruns)},
      {"Wake-up late", spread_text(p.late)}};
  if (p.period.p50_us > 0) out.emplace_back("Period", spread_text(p.period));
  out.emplace_back("Work of a tick", spread_text(p.work));
  if (!p.kernel.empty()) out.emplace_back("Kernel", p.kernel + (p.kernel_realtime ? ", real-time" : ", not real-time"));
  if (p.processors > 0 && p.load)
    out.emplace_back("Load", fixed_text(*p.load, 1) + " on " + std::to_string(p.processors) +
                                 (p.processors == 1 ? " processor" : " processors"));
  if (p.processors_awake) out.emplace_back("Idle states", *p.processors_awake ? "kept away" : "allowed");
  if (p.processor) out.emplace_back("Kept on processor", std::to_string(*p.processor));
  return out;
}

std::string pacing_plot_svg(const Pacing& pacing, double rate_hz) {
  std::uint64_t most = 0;
  for (const PacingSpread* spread : {&pacing.late, &pacing.period, &pacing.work})
    for (const auto& [lower, count] : spread->bins) most = std::max(most, count);
  if (most == 0) return "";
  const int decades = std::clamp(static_cast<int>(std::ceil(std::log10(static_cast<double>(most)))), 1, 7);
  const double period_us = rate_hz > 0 ? 1e6 / rate_hz : 1e9;
  std::string out = "<svg viewBox=\"0 0 " + px(kPacingWidth) + " " + px(kPacingHeight) +
                    "\" role=\"img\" aria-label=\"Pace of the loop\">";
  double left = kPanelLeft;
  for (const auto& [spread, title] : {std::pair(&pacing.late, "Wake-up: late by"),
                                      {&pacing.period, "Period: off by"},
                                      {&pacing.work, "Work of a tick"}}) {
    out += PacingPanel(*spread, left, decades).drawn(title, left == kPanelLeft, period_us);
    left += kPanel + kPanelGap;
  }
  out +=
      label(kPanelLeft, kPacingBottom + 44, "ticks against microseconds, both logarithmic; dashed: one whole period");
  return out + "</svg>";
}

std::string soft_real_time(const RunReport& device) {
  if (device.without_device()) return "";
  const std::optional<Pacing> pacing = parse_pacing(device.realtime);
  if (!pacing || pacing->refused.empty()) return "";
  return "Soft real time: the system gave the haptic loop no real-time priority, so forces may have come late.";
}

}  // namespace trocar
