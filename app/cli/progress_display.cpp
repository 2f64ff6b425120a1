#include "app/cli/progress_display.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ostream>

namespace trocar {
namespace {

constexpr int kBarWidth = 24;
constexpr auto kRedraw = std::chrono::milliseconds(100);

}  // namespace

ProgressDisplay::ProgressDisplay(std::ostream& err, bool terminal, std::chrono::milliseconds moment)
    : err_(err), terminal_(terminal), moment_(moment) {}

ProgressDisplay::~ProgressDisplay() { clear(); }

void ProgressDisplay::show(std::string_view stage, double share, std::string_view detail) {
  if (watch_.seen()) throw Interrupted();
  detail_ = detail.empty() ? "" : ": " + std::string(detail);
  const bool fresh = stage != stage_;
  if (fresh) {
    stage_ = stage;
    quarter_ = -1;
  }
  if (!terminal_) return line(share);
  const auto now = std::chrono::steady_clock::now();
  if (drawn_ > 0 && !fresh && now - last_ < kRedraw) return;
  last_ = now;
  draw(share);
}

void ProgressDisplay::line(double share) {
  const int quarter = share < 0 ? 0 : static_cast<int>(std::floor(std::clamp(share, 0.0, 1.0) * 4));
  const auto now = std::chrono::steady_clock::now();
  if (quarter <= quarter_ || now - last_ < moment_) return;
  last_ = now;
  if (quarter_ < 0)
    err_ << stage_ << detail_ << '\n';
  else
    err_ << stage_ << ": " << 25 * quarter << " %" << (detail_.empty() ? "" : ",")
         << detail_.substr(detail_.empty() ? 0 : 1) << '\n';
  quarter_ = quarter;
  err_.flush();
}

void ProgressDisplay::draw(double share) {
  std::string text = stage_ + detail_;
  if (share >= 0) {
    const int filled = static_cast<int>(std::lround(std::clamp(share, 0.0, 1.0) * kBarWidth));
    text = "[" + std::string(static_cast<std::size_t>(filled), '#') +
           std::string(static_cast<std::size_t>(kBarWidth - filled), ' ') + "] " + text;
  }
  const std::size_t wiped = std::max(drawn_, text.size());
  err_ << '\r' << text << std::string(wiped - text.size(), ' ') << std::flush;
  drawn_ = text.size();
}

void ProgressDisplay::clear() {
  if (drawn_ > 0) err_ << '\r' << std::string(drawn_, ' ') << '\r' << std::flush;
  drawn_ = 0;
}

Progress ProgressDisplay::function() {
  return [this](std::string_view stage, double share) { show(stage, share); };
}

std::string pace_words(int done, int of, double seconds) {
  char text[96];
  const double rate = seconds > 0 ? (done - 1) / seconds : 0;
  if (done < 2 || !(rate > 0)) {
    std::snprintf(text, sizeof text, "%d of %d", done, of);
    return text;
  }
  const double left_s = std::ceil((of - done) / rate);
  if (left_s < 120)
    std::snprintf(text, sizeof text, "%d of %d, %.3g a second, %.0f s left", done, of, rate, left_s);
  else
    std::snprintf(text, sizeof text, "%d of %d, %.3g a second, %.0f min left", done, of, rate, std::ceil(left_s / 60));
  return text;
}

bool error_is_terminal() { return isatty(STDERR_FILENO) == 1; }

}  // namespace trocar
