#include "app/window/ui/plot.h"

#include <algorithm>
#include <cmath>

namespace trocar {
namespace {

constexpr double kAir = 6, kTick = 4, kMark = 5;  // px at 720 lines and scale 1
constexpr std::size_t kFewPoints = 2;

}  // namespace

void paint_plot_mark(Ui& ui, PlotMark mark, double x, double y, double r, Ink ink) {
  switch (mark) {
    case PlotMark::kDisc:
      return ui.paint_disc(x, y, 0.8 * r, ink);
    case PlotMark::kRing:
      return ui.paint_ring(x, y, 0.8 * r, ink, 1.8);
    case PlotMark::kDiamond:
      ui.paint_triangle(x - r, y, x, y - r, x + r, y, ink);
      return ui.paint_triangle(x + r, y, x, y + r, x - r, y, ink);
    case PlotMark::kTriangle:
      return ui.paint_triangle(x, y + r, x - r, y - r, x + r, y - r, ink);
  }
}

int y_ticks_for(const Ui& ui, double height_px) {
  return std::clamp(static_cast<int>(height_px / (1.5 * ui.line_height())) + 1, 2, 6);
}
int x_ticks_for(const Ui& ui, double width_px, double label_px) {
  return std::clamp(static_cast<int>(width_px / (label_px + ui.px(18))), 2, 10);
}

double Plot::left_room(const Ui& ui, const Axis& y) {
  double wide = 0;
  for (const double tick : y.ticks) wide = std::max(wide, ui.text_width(ui.words().number(tick, y.decimals)));
  return wide + ui.px(kAir + kTick);
}

Plot::Plot(Ui& ui, const Area& area, const PlotScales& scales) : ui_(ui), scales_(scales) {
  const double line = ui.line_height(), air = ui.px(kAir);
  const double left = std::max(scales.left_px, left_room(ui, scales.y));
  const double top = scales.title.empty() ? line / 2 : 1.5 * line + ui.px(1),
               bottom = scales.x_labels ? line + air : air;
  inner_ = {area.x + left, area.y + top, std::max(8.0, area.width - left - air),
            std::max(8.0, area.height - top - bottom)};
  draw_axes(area);
}

double Plot::x_px(double x) const {
  return inner_.x + inner_.width * (x - scales_.x.low) / (scales_.x.high - scales_.x.low);
}
double Plot::y_px(double y) const {
  return inner_.y + inner_.height * (1 - (y - scales_.y.low) / (scales_.y.high - scales_.y.low));
}
double Plot::clamped_y(double y) const { return std::clamp(y_px(y), inner_.y, inner_.y + inner_.height); }
int Plot::column_count() const { return std::max(1, static_cast<int>(inner_.width)); }

double Plot::x_at(double px) const {
  const double share = std::clamp((px - inner_.x) / inner_.width, 0.0, 1.0);
  return std::lerp(scales_.x.low, scales_.x.high, share);
}

void Plot::draw_axes(const Area& area) {
  const double line = ui_.line_height(), right = inner_.x + inner_.width, foot = inner_.y + inner_.height;
  if (!scales_.title.empty()) ui_.text_at(area.x, area.y, scales_.title, Ink::kDim, area.width);
  ui_.paint_ground(inner_, 1);
  double lowest_free = foot + line;
  for (const double tick : scales_.y.ticks) {
    const double y = y_px(tick);
    ui_.paint_line(inner_.x, y, right, y, Ink::kDim, 0.35);
    ui_.paint_line(inner_.x - ui_.px(kTick), y, inner_.x, y, Ink::kDim, 1);
    if (y + line / 2 > lowest_free) continue;  // too close to the one below
    const bool under_title = !scales_.title.empty() && y - line / 2 < area.y + line;
    if (!under_title)
      ui_.text_at(inner_.x - ui_.px(kAir), y - line / 2, ui_.words().number(tick, scales_.y.decimals), Ink::kDim, 0, 1);
    lowest_free = y - line / 2;
  }
  ui_.paint_line(inner_.x, inner_.y, inner_.x, foot, Ink::kDim, 1);
  ui_.paint_line(inner_.x, foot, right, foot, Ink::kDim, 1);
  draw_x_ticks();
}

void Plot::draw_x_ticks() {
  const double foot = inner_.y + inner_.height, right = inner_.x + inner_.width;
  double free = right + ui_.px(kAir);
  bool last = true;
  for (auto tick = scales_.x.ticks.rbegin(); tick != scales_.x.ticks.rend(); ++tick) {
    const double x = x_px(*tick);
    ui_.paint_line(x, foot, x, foot + ui_.px(kTick), Ink::kDim, 1);
    if (!scales_.x_labels) continue;
    std::string text = ui_.words().number(*tick, scales_.x.decimals);
    if (last && !scales_.x_unit.empty()) text += " " + scales_.x_unit;
    last = false;
    const double wide = ui_.text_width(text), left = std::min(x - wide / 2, free - wide);
    if (left + wide > free || left < inner_.x - ui_.px(kAir + kTick) - wide / 2) continue;
    ui_.text_at(left, foot + ui_.px(kTick), text, Ink::kDim);
    free = left - ui_.px(10);
  }
}

void Plot::band(double low, double high, const std::string& text, Ink ink) {
  const double top = clamped_y(high), bottom = clamped_y(low), right = inner_.x + inner_.width;
  ui_.paint_box({inner_.x, top, inner_.width, std::max(1.0, bottom - top)}, ink, 0.22);
  ui_.paint_line(inner_.x, top, right, top, ink, 1);
  ui_.paint_line(inner_.x, bottom, right, bottom, ink, 1);
  label(label_x(), high, text, ink);
}

void Plot::limit(double y, const std::string& text) {
  if (y >= scales_.y.high) return;
  const double at = clamped_y(y);
  ui_.paint_hatch({inner_.x, inner_.y, inner_.width, at - inner_.y}, Ink::kAlarm, 9, 0.8);
  ui_.paint_line(inner_.x, at, inner_.x + inner_.width, at, Ink::kAlarm, 2);
  label(label_x(), y, text, Ink::kAlarm);
}

void Plot::line(double y, const std::string& text, Ink ink, bool dashed) {
  if (y < scales_.y.low || y > scales_.y.high) return;
  ui_.paint_line(inner_.x, y_px(y), inner_.x + inner_.width, y_px(y), ink, 1.5, dashed);
  label(label_x(), y, text, ink);
}

void Plot::rule(double x, const std::string& text, Ink ink) {
  if (x < scales_.x.low || x > scales_.x.high) return;
  ui_.paint_line(x_px(x), inner_.y, x_px(x), inner_.y + inner_.height, ink, 1.5, true);
  label(x, scales_.y.high, text, ink);
}

void Plot::columns(const std::vector<ForceTrace::Column>& columns, Ink ink) {
  const double wide = inner_.width / std::max<double>(1, static_cast<double>(columns.size()));
  const ForceTrace::Column* before = nullptr;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    ForceTrace::Column column = columns[i];
    if (!column.any) continue;
    if (before) {  // no gap between neighbours: the force went through what lies between
      column.low = std::min(column.low, before->high);
      column.high = std::max(column.high, before->low);
    }
    before = &columns[i];
    const double top = clamped_y(column.high), bottom = clamped_y(column.low), least = ui_.px(1.6);
    const double middle = (top + bottom) / 2, half = std::max(least, bottom - top) / 2;
    ui_.paint_box({inner_.x + wide * static_cast<double>(i), middle - half, std::max(1.0, wide), 2 * half}, ink);
  }
}

void Plot::curve(const std::vector<Ui::Point>& values, Ink ink, bool dashed) {
  if (values.size() < kFewPoints) return;
  std::vector<Ui::Point> points;
  for (const Ui::Point& v : values) points.push_back({x_px(v.x), clamped_y(v.y)});
  if (!dashed) return ui_.paint_curve(points, ink, 2);
  for (std::size_t i = 1; i < points.size(); ++i)
    ui_.paint_line(points[i - 1].x, points[i - 1].y, points[i].x, points[i].y, ink, 1.5, true);
}

void Plot::mark(double x, double y, PlotMark shape, Ink ink) {
  paint_plot_mark(ui_, shape, x_px(x), clamped_y(y), ui_.px(kMark), ink);
}

double Plot::label_x() const { return scales_.labels_left ? scales_.x.low : scales_.x.high; }

void Plot::cursor(double x, const std::string& text) {
  const double at = x_px(std::clamp(x, scales_.x.low, scales_.x.high));
  ui_.paint_line(at, inner_.y, at, inner_.y + inner_.height, Ink::kText, 1.5);
  ui_.paint_triangle(at, inner_.y + ui_.px(6), at - ui_.px(5), inner_.y, at + ui_.px(5), inner_.y, Ink::kText);
  if (!text.empty()) label(x, scales_.y.high, text, Ink::kText);
}

void Plot::label(double x, double y, const std::string& text, Ink ink) {
  if (!text.empty()) wishes_.push_back({text, ink, x_px(std::clamp(x, scales_.x.low, scales_.x.high)), clamped_y(y)});
}

void Plot::labels() {
  std::vector<LabelWish> wanted;
  for (const Wish& wish : wishes_)
    wanted.push_back({wish.x, wish.y, ui_.text_width(wish.text) + ui_.px(6), ui_.line_height()});
  const auto places = place_labels(wanted, inner_, {}, ui_.px(1));
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!places[i]) continue;
    ui_.paint_ground(*places[i], 0.85, ui_.px(3));
    ui_.text_at(places[i]->x + ui_.px(3), places[i]->y, wishes_[i].text, wishes_[i].ink);
  }
}

}  // namespace trocar
