#include "app/picture/display/hud_layout.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string_view>
#include <utility>

#include "app/picture/display/hud_column.h"

namespace trocar {
namespace {

std::string clock_text(double seconds) {
  const int whole = std::isfinite(seconds) ? static_cast<int>(std::clamp(seconds, 0.0, 359999.0)) : 0;
  std::array<char, 24> text{};
  std::snprintf(text.data(), text.size(), "%02d:%02d", whole / 60, whole % 60);
  return text.data();
}

constexpr int kLeastNumber = 8;  // px: of a number in a place far too small
constexpr std::string_view kBetween = " · ";

/// "a · b · c", then "a · b", then "a".
std::vector<std::string> shorter(const std::string& text) {
  std::vector<std::string> out{text};
  for (std::size_t end = text.rfind(kBetween); end != std::string::npos && end > 0; end = text.rfind(kBetween, end - 1))
    out.push_back(text.substr(0, end));
  return out;
}

/// Without its last parts, as many of them as do not fit.
std::string without_last(HudPen& pen, const std::string& text, int size, double room) {
  for (const std::string& part : shorter(text))
    if (pen.width(part, size, false) <= room) return part;
  return text;
}

/// Number and level of "E02 Surface touch · L1 · direct".
std::string number_and_level(const std::string& title) {
  const std::size_t end = title.find(kBetween), word = title.find(' ');
  if (end == std::string::npos || word >= end) return title;
  const std::string level = title.substr(end + kBetween.size());
  return title.substr(0, word) + std::string(kBetween) + level.substr(0, level.find(kBetween));
}

/// Who and what, as much of it as stands in `room` px uncut: the level is said always, the mapping and who it is give
/// way first.
std::pair<std::string, std::string> fitting_names(HudPen& pen, const Hud& hud, const HudFrame& frame, double room) {
  const std::size_t colon = hud.trainee.find(": ");
  const std::string code = colon == std::string::npos ? hud.trainee : hud.trainee.substr(colon + 2);
  const std::vector<std::string> titles = shorter(hud.title);
  const std::string level = titles.size() > 2 ? titles[titles.size() - 2] : hud.title;  // without the mapping
  const std::pair<std::string, std::string> wishes[] = {
      {hud.trainee, hud.title}, {code, hud.title}, {code, level}, {"", level}};
  for (const auto& [who, what] : wishes) {
    const double air = who.empty() ? 0 : 1.6 * frame.px(14);
    if (pen.width(who, frame.body, false) + air + pen.width(what, frame.title_size(), true) <= room) return {who, what};
  }
  return {"", number_and_level(hud.title)};
}

void lay_top_bar(HudPen& pen, const Hud& hud, const HudFrame& frame) {
  const HudBox bar{0, 0, static_cast<double>(frame.width), frame.top};
  pen.shape(HudShape::Kind::kPanel, bar);
  const int big = frame.clock_size(), body = frame.body;
  const double margin = frame.px(14), baseline = 0.5 * frame.top + 0.36 * big;
  double right = frame.width - margin;
  if (hud.elapsed_s >= 0 && hud.limit_s > 0)
    right =
        pen.text_right("/ " + clock_text(hud.limit_s), right, baseline, body, false, HudInk::kDim, right) - frame.px(8);
  const bool late = hud.limit_s > 0 && hud.elapsed_s > 0.9 * hud.limit_s;
  if (hud.elapsed_s >= 0)
    right = pen.text_right(clock_text(hud.elapsed_s), right, baseline, big, true,
                           late ? HudInk::kCaution : HudInk::kText, right);
  const auto [who, what] = fitting_names(pen, hud, frame, right - 2 * margin);
  const double used = pen.text(who, margin, baseline, body, false, HudInk::kDim, right - margin);
  const double title_x = who.empty() ? margin : used + 1.6 * margin;
  pen.text(what, title_x, baseline, frame.title_size(), true, HudInk::kText, right - margin - title_x);
}

/// A message as it stands in a box of its own, text of `size` px.
struct Toast {
  int size;
  double pad, icon, line, width, room;
  std::vector<std::string> message, hint;
  double height() const { return 2 * pad + line * static_cast<double>(message.size() + hint.size()); }
};

Toast toast_at(HudPen& pen, const Hud& hud, const HudFrame& frame, int size) {
  constexpr int kLines = 3;  // of message and of hint
  Toast t{size, size * 12 / 18.0, size * 34 / 18.0, 1.25 * size, 0, 0, {}, {}};
  const double wish = std::max(pen.width(hud.toast, size, true), pen.width(hud.toast_hint, size, false));
  t.width = std::min(wish + 3.5 * t.pad + t.icon, frame.scene.width - 2 * t.pad);
  t.room = t.width - 3 * t.pad - t.icon;
  t.message = pen.wrapped(hud.toast, size, true, t.room, kLines).lines;
  if (!hud.toast_hint.empty()) t.hint = pen.wrapped(hud.toast_hint, size, false, t.room, kLines).lines;
  return t;
}

/// Between the lower edge of the picture and what is at the upper one. It may cover a fifth of the picture's height:
/// larger text is drawn as at 100 % before it covers more.
void lay_toast(HudPen& pen, const Hud& hud, const HudFrame& frame, double upper) {
  if (hud.toast.empty()) return;
  constexpr double kMost = 0.2;
  Toast t = toast_at(pen, hud, frame, frame.body);
  for (int size = frame.body - 1; size >= frame.plain && t.height() > kMost * frame.scene.height; --size)
    t = toast_at(pen, hud, frame, size);
  const double lower = frame.scene.y + frame.scene.height - t.height() - t.pad;
  const double y = std::lerp(std::min(upper, lower), lower, hud.toast_at);
  const HudBox box{frame.scene.x + 0.5 * (frame.scene.width - t.width), y, t.width, t.height()};
  pen.shape(HudShape::Kind::kToast, box);
  pen.shape(hud.toast_warning ? HudShape::Kind::kWarning
            : hud.toast_done  ? HudShape::Kind::kTick
                              : HudShape::Kind::kInfo,
            {box.x + t.pad, box.y + 0.5 * (box.height - t.icon), t.icon, t.icon});
  double baseline = box.y + t.pad + 0.95 * t.size;
  const auto write = [&](const std::vector<std::string>& lines, bool bold, HudInk ink) {
    for (const std::string& words : lines) {
      pen.text(words, box.x + 2 * t.pad + t.icon, baseline, t.size, bold, ink, t.room);
      baseline += t.line;
    }
  };
  write(t.message, true, HudInk::kText);
  write(t.hint, false, HudInk::kDim);
}

/// One line each, below the notch, at most two. @return where they end.
double lay_notices(HudPen& pen, const Hud& hud, const HudFrame& frame) {
  const double pad = 0.45 * frame.body, icon = 1.15 * frame.body, height = 1.25 * frame.body + pad;
  double y = frame.scene.y + 1.3 * frame.body;
  for (std::size_t i = 0; i < std::min<std::size_t>(hud.notices.size(), 2); ++i) {
    const HudNotice& notice = hud.notices[i];
    const double most = frame.scene.width - 6 * pad - icon;
    const double room = std::min(pen.width(notice.text, frame.body, true) + 1, most);
    const HudBox box{frame.scene.x + 0.5 * (frame.scene.width - room - 3 * pad - icon), y, room + 3 * pad + icon,
                     height};
    pen.shape(HudShape::Kind::kToast, box);
    const HudShape::Kind kind = notice.kind == HudNotice::Kind::kTooMuch     ? HudShape::Kind::kUp
                                : notice.kind == HudNotice::Kind::kTooLittle ? HudShape::Kind::kDown
                                : notice.kind == HudNotice::Kind::kWarning   ? HudShape::Kind::kWarning
                                                                             : HudShape::Kind::kInfo;
    pen.shape(kind, {box.x + pad, box.y + 0.5 * (height - icon), icon, icon});
    const HudInk ink = notice.kind == HudNotice::Kind::kInfo ? HudInk::kText : HudInk::kCaution;
    pen.text(notice.text, box.x + 2 * pad + icon, box.y + 0.5 * height + 0.36 * frame.body, frame.body, true, ink,
             room);
    y += height + pad;
  }
  return y;
}

}  // namespace

double dial_share(double error) {
  constexpr double kRing = 0.4, kFade = 4;  // four tolerances further on, two thirds of the rest are used up
  const double size = std::abs(error);
  const double share = size <= 1 ? kRing * size : kRing + (1 - kRing) * (1 - std::exp(-(size - 1) / kFade));
  return std::copysign(std::isfinite(share) ? share : 1.0, error);
}

bool hud_is_empty(const Hud& hud) {
  return hud.trainee.empty() && hud.title.empty() && hud.bars.empty() && hud.steps.empty() && hud.rows.empty() &&
         hud.device.empty() && !hud.dial;
}

constexpr int kBody = 18, kLeastBody = 12;  // px: at 720 lines, and in the smallest window
/// px that the display needs beside a picture worth seeing, at 720 lines: what 1280 x 720 leaves at 200 %.
constexpr double kColumnNeeds = 640;

HudFrame::HudFrame(const Hud& hud, int w, int h, double text_scale) : width(w), height(h) {
  const double wanted = std::clamp(text_scale, 1.0, 2.0);
  scale = std::min(h / 720.0 * wanted, w / kColumnNeeds);
  body = std::max(px(kBody), kLeastBody);
  plain = std::max(static_cast<int>(std::lround(kBody * scale / wanted)), kLeastBody);
  empty = hud_is_empty(hud);
  bottom = hud.credit.empty() ? 0.0 : std::round(1.7 * body);
  top = empty ? 0.0 : std::round(2.5 * body);
  const bool has_column =
      !(hud.bars.empty() && hud.steps.empty() && hud.rows.empty() && hud.device.empty()) || hud.dial.has_value();
  column_width = has_column ? std::round(std::min(17.8 * body, 0.44 * w)) : 0.0;
  scene = {0, static_cast<int>(top), w - static_cast<int>(column_width), h - static_cast<int>(top + bottom)};
}

int HudFrame::title_size() const { return static_cast<int>(std::lround(20.0 / 18 * body)); }
int HudFrame::clock_size() const { return static_cast<int>(std::lround(26.0 / 18 * body)); }
int HudFrame::px(double at_720) const { return static_cast<int>(std::lround(at_720 * scale)); }

PixelRect hud_scene_window(const Hud& hud, int width, int height, double text_scale) {
  return HudFrame(hud, width, height, text_scale).scene;
}

HudBar::Level force_level(const ForceBar& bar) {
  if (bar.limit_n > 0 && bar.value_n >= bar.limit_n) return HudBar::Level::kOverLimit;
  if (bar.band_high_n > 0 && bar.value_n > bar.band_high_n) return HudBar::Level::kAbove;
  if (bar.band_high_n > 0 && bar.value_n >= bar.band_low_n && bar.value_n > 0) return HudBar::Level::kInBand;
  return HudBar::Level::kBelow;
}

HudLayout layout_hud(const Hud& hud, int width, int height, double text_scale, FontSet& fonts) {
  const HudFrame frame(hud, width, height, text_scale);
  HudLayout layout;
  HudPen pen(layout, fonts);
  if (!frame.empty) lay_top_bar(pen, hud, frame);
  if (frame.column_width > 0) lay_column(pen, hud, frame);
  if (!hud.credit.empty()) {
    const double margin = frame.px(14), strip = frame.scene.width;
    pen.shape(HudShape::Kind::kPanel, {0, height - frame.bottom, strip, frame.bottom});
    pen.text(without_last(pen, hud.credit, frame.body, strip - 2 * margin), margin,
             height - frame.bottom * 0.5 + 0.34 * frame.body, frame.body, false, HudInk::kDim, strip - 2 * margin);
  }
  const double upper = lay_notices(pen, hud, frame);
  lay_toast(pen, hud, frame, upper);
  return layout;
}

/// Of whole text where that is three quarters of `size` or more; below only for a number.
int HudPen::fitting_size(const std::string& words, int size, bool bold, double room) {
  const bool number = words.find_first_of("0123456789") != std::string::npos;
  const int least = number ? kLeastNumber : (3 * size + 3) / 4;
  while (size > least && fonts_.width(words, size, bold) > room) --size;
  return size;
}

double HudPen::text(const std::string& words, double x, double baseline, int size, bool bold, HudInk ink, double room) {
  const int fit = fitting_size(words, size, bold, room);
  const std::string shown = fonts_.fitted(words, fit, bold, room);
  if (shown.empty()) return x;
  const double w = fonts_.width(shown, fit, bold);
  layout_.texts.push_back(
      {shown, {x, baseline - fonts_.ascent(fit), w, fonts_.line_height(fit)}, baseline, fit, bold, ink});
  return x + w;
}

double HudPen::text_right(const std::string& words, double right, double baseline, int size, bool bold, HudInk ink,
                          double room) {
  const int fit = fitting_size(words, size, bold, room);
  const double x = right - fonts_.width(words, fit, bold);
  text(words, x, baseline, fit, bold, ink, right - x + 1);
  return x;
}

HudPen::Lines HudPen::wrapped(const std::string& words, int size, bool bold, double room, int limit) {
  const auto whole = [](const std::vector<std::string>& lines) {
    return std::none_of(lines.begin(), lines.end(), [](const std::string& l) { return l.ends_with("\u2026"); });
  };
  Lines out{fonts_.wrapped(words, size, bold, room, limit), size};
  for (int smaller = size - 1; smaller >= (3 * size + 3) / 4 && !whole(out.lines); --smaller)
    out = {fonts_.wrapped(words, smaller, bold, room, limit), smaller};
  return out;
}

}  // namespace trocar
