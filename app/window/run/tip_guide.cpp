#include "app/window/run/tip_guide.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "app/picture/attempt/attempt_scene.h"
#include "app/window/ui/ui.h"

namespace trocar {
namespace {

constexpr double kFootRadius = 0.002;  // m
constexpr double kRoundDisc = 0.002;   // m beyond a disc's edge: the foot's ring is seen within
constexpr double kPenLine = 0.03;      // m of a pen behind its tip
constexpr int kFootPoints = 24, kHeldPoints = 32, kCirclePoints = 32, kHalvings = 12;
constexpr double kHeldRadius = 17, kBarWide = 116, kBarHigh = 14, kBarBeside = 46;  // px at 720 lines
constexpr double kTouching_n = 0.01;
constexpr double kAtTip_m = 0.015;  // farther away the shaft touches

/// Last point on the way that is in the picture; the first one is.
Vec3 last_seen(const ScopeOptics& optics, const Vec3& from_T, const Vec3& to_T) {
  if (optics.project(to_T)) return to_T;
  double seen = 0, unseen = 1;
  for (int n = 0; n < kHalvings; ++n) {
    const double middle = 0.5 * (seen + unseen);
    (optics.project(from_T + middle * (to_T - from_T)) ? seen : unseen) = middle;
  }
  return from_T + seen * (to_T - from_T);
}

/// The line as far as it is in the picture, and the ring at its foot where all of that is.
void paint_plumb(Ui& ui, const ScopeOptics& optics, const Vec3& tip_T, const Vec3& foot_T) {
  const auto from = optics.project(tip_T);
  if (!from) return;
  const auto to = optics.project(last_seen(optics, tip_T, foot_T));
  const bool over = tip_T.z() > foot_T.z();  // not so within a block, which the open jaws stand round
  if (to && over && (*from - *to).norm() > ui.px(3))
    ui.paint_outlined({{from->x(), from->y()}, {to->x(), to->y()}}, Ink::kTip, 2.5);
  std::vector<Ui::Point> foot;
  for (int i = 0; i <= kFootPoints; ++i) {
    const double a = 2 * std::numbers::pi * i / kFootPoints;
    const auto at = optics.project(foot_T + kFootRadius * Vec3(std::cos(a), std::sin(a), 0));
    if (!at) return;
    foot.push_back({at->x(), at->y()});
  }
  ui.paint_outlined(foot, Ink::kTip, 2.5);
}

void paint_force(Ui& ui, const ForceBar& bar, double x, double y) {
  const double wide = ui.px(kBarWide), high = ui.px(kBarHigh);
  const auto at = [&](double n) { return x + wide * std::clamp(n / bar.full_scale_n, 0.0, 1.0); };
  const double now = at(bar.value_n), low = at(bar.band_low_n), top = at(bar.band_high_n), limit = at(bar.limit_n);
  ui.paint_ground({x - ui.px(4), y - ui.px(4), wide + ui.px(8), high + ui.px(8)}, 0.8, ui.px(4));
  ui.paint_hatch({limit, y, x + wide - limit, high}, Ink::kCaution, 5, 1);
  if (top > low) ui.paint_frame({low, y, top - low, high}, Ink::kGood, 1.5);
  const bool inside = bar.value_n >= bar.band_low_n && bar.value_n <= bar.band_high_n && top > low;
  const Ink ink = bar.value_n > bar.limit_n                    ? Ink::kAlarm
                  : inside                                     ? Ink::kGood
                  : top > low && bar.value_n > bar.band_high_n ? Ink::kCaution
                                                               : Ink::kHeading;
  if (now > x) ui.paint_box({x, y + high * 0.25, now - x, high * 0.5}, ink);
}

using Line = std::vector<Vec3>;

Line circle(const Vec3& centre, const Vec3& normal, double radius_m) {
  const Vec3 a = normal.unitOrthogonal(), b = normal.cross(a);
  Line out;
  for (int i = 0; i <= kCirclePoints; ++i) {
    const double t = 2 * std::numbers::pi * i / kCirclePoints;
    out.push_back(centre + radius_m * (std::cos(t) * a + std::sin(t) * b));
  }
  return out;
}

/// Edge of the face that is uppermost: one may lie on its side.
Line top_of(const SeenObject& block) {
  const Vec3 up = block.X_TO.R.row(2).transpose(), half = 0.5 * block.size_m;
  int axis = 0;
  up.cwiseAbs().maxCoeff(&axis);
  Line out;
  for (const auto& [a, b] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}, {-1, -1}}) {
    Vec3 corner = half;
    corner[axis] *= up[axis] < 0 ? -1 : 1;
    corner[(axis + 1) % 3] *= a;
    corner[(axis + 2) % 3] *= b;
    out.push_back(block.X_TO * corner);
  }
  return out;
}

void paint_lit(Ui& ui, const ScopeOptics& optics, const Line& line) {
  std::vector<Ui::Point> seen;
  for (const Vec3& p : line)
    if (const auto at = optics.project(p)) seen.push_back({at->x(), at->y()});
  if (seen.size() == line.size()) ui.paint_outlined(seen, Ink::kAccent, 3);
}

bool meet(const HudBox& a, const HudBox& b) {
  return a.x < b.right() && b.x < a.right() && a.y < b.bottom() && b.y < a.bottom();
}

HudBox wider(const HudBox& box, double by) { return {box.x - by, box.y - by, box.width + 2 * by, box.height + 2 * by}; }

void paint_to_go(Ui& ui, const ScopeOptics& optics, const TipGuide& guide, const std::vector<HudBox>& messages) {
  double left = 1e9, right = 0, top = 1e9, bottom = 0;
  for (const Vec3& p : guide.lit_T.front()) {
    const auto at = optics.project(p);
    if (!at) return;
    left = std::min(left, at->x());
    right = std::max(right, at->x());
    top = std::min(top, at->y());
    bottom = std::max(bottom, at->y());
  }
  const double side = ui.px(6), edge = ui.px(2);
  const HudBox lit = wider({left, top, right - left, bottom - top}, ui.px(8));
  const HudBox words{0, 0, ui.text_width(guide.to_go) + 2 * side, ui.line_height() + 2 * edge};
  const auto at = place_words(lit, words, optics.project(guide.tip_T), {0, 0, ui.width(), ui.height()}, messages);
  if (!at) return;
  ui.paint_ground({at->x, at->y, at->width, at->height}, 0.8, ui.px(4));
  ui.text_at(at->x + side, at->y + edge, guide.to_go, Ink::kText);
}

}  // namespace

std::optional<Vec3> touched_at(const StylusState& stylus, const Vec3& hangs_T) {
  if (!stylus.contact || (stylus.contact_point_T - hangs_T).norm() > kAtTip_m) return std::nullopt;
  return stylus.contact_point_T;
}

Vec3 middle_of(const std::vector<Line>& lit_T) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& p : lit_T.front()) sum += p;
  return sum / static_cast<double>(lit_T.front().size());
}

std::vector<Line> lit_outline(const SessionView& view, const Camera& camera) {
  const DirectorStatus& status = view.director.status();
  const Board& board = view.director.board();
  const auto facing = [&](const Vec3& p) { return Vec3((camera.eye_T - p).normalized()); };
  if (waits_for_start(status.phase))
    return {circle(board.start_T, facing(board.start_T), view.scene.setup.exercise.start_sphere_m)};
  if (status.phase != Phase::kRun || status.target_index < 0) return {};
  const Demand& d = status.demand;
  if (status.cue == Cue::kPick) return {top_of(d.object)};
  if (status.cue == Cue::kCarry || status.cue == Cue::kPlace)
    return {circle(board.targets.at(static_cast<std::size_t>(status.target_index)).centre_T, Vec3::UnitZ(),
                   view.scene.setup.exercise.grasp.ring_radius_m)};
  if (status.cue == Cue::kRead) return {};  // one of the balls, and which is the question
  if (status.cue == Cue::kLift) return {circle(d.goal_T, Vec3::UnitZ(), d.radius_m + kRoundDisc)};
  if (is_scope(view.scene.setup.exercise))
    return {circle(d.object.X_TO.p, facing(d.object.X_TO.p), 0.5 * d.object.size_m.x() + kRoundDisc)};
  if (d.oriented)
    return {circle(d.centre_T, facing(d.centre_T), d.radius_m), {d.centre_T, d.centre_T - kPenLine * d.R_TI.col(2)}};
  return {circle(d.centre_T, d.normal_T, d.radius_m + kRoundDisc)};
}

std::optional<HudBox> place_words(const HudBox& lit, const HudBox& words, const std::optional<Eigen::Vector2d>& tip,
                                  const HudBox& window, const std::vector<HudBox>& messages) {
  const double x = lit.x + 0.5 * (lit.width - words.width), y = lit.y + 0.5 * (lit.height - words.height);
  std::vector<Eigen::Vector2d> places{
      {x, lit.bottom()}, {x, lit.y - words.height}, {lit.right(), y}, {lit.x - words.width, y}};
  for (const HudBox& message : messages) {
    places.emplace_back(x, message.bottom());
    places.emplace_back(x, message.y - words.height);
  }
  std::optional<HudBox> best;
  int least = 0;
  for (const Eigen::Vector2d& place : places) {
    const HudBox box{place.x(), place.y(), words.width, words.height};
    const bool inside =
        box.x >= window.x && box.y >= window.y && box.right() <= window.right() && box.bottom() <= window.bottom();
    if (!inside || std::any_of(messages.begin(), messages.end(), [&](const HudBox& m) { return meet(box, m); }))
      continue;
    const HudBox near_tip = wider(box, 0.5 * words.height);
    const bool hides_tip = tip && meet(near_tip, {tip->x(), tip->y(), 0, 0});
    const int hides = (hides_tip ? 1 : 0) + (meet(box, lit) ? 1 : 0);
    if (best && hides >= least) continue;
    best = box;
    least = hides;
  }
  return best;
}

void paint_tip_guide(Ui& ui, const ScopeOptics& optics, const TipGuide& guide, const std::vector<HudBox>& messages) {
  for (const Line& line : guide.lit_T) paint_lit(ui, optics, line);
  if (!guide.to_go.empty() && !guide.lit_T.empty()) paint_to_go(ui, optics, guide, messages);
  if (guide.foot_T) paint_plumb(ui, optics, guide.plumb_T.value_or(guide.tip_T), *guide.foot_T);
  const auto tip = optics.project(guide.tip_T);
  if (!tip) return;
  if (guide.held > 0) {
    std::vector<Ui::Point> ring;
    for (int i = 0; i <= kHeldPoints; ++i) {
      const double a = 2 * std::numbers::pi * std::min(1.0, guide.held) * i / kHeldPoints;
      ring.push_back({tip->x() + ui.px(kHeldRadius) * std::sin(a), tip->y() - ui.px(kHeldRadius) * std::cos(a)});
    }
    ui.paint_outlined(ring, Ink::kGood, 3.5);
  }
  if (!guide.force || guide.force->value_n < kTouching_n) return;
  paint_force(ui, *guide.force, tip->x() - ui.px(kBarBeside + kBarWide), tip->y() - 0.5 * ui.px(kBarHigh));
}

}  // namespace trocar
