#include "tests/app/window/play/picture_player.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/window/ui/theme.h"

namespace trocar::testing_support {
namespace {

constexpr double kPictureShare = 0.75;  // of the window's width: the column stands beside it
constexpr double kMoved_px = 12;        // what is lit is somewhere else
constexpr double kBall_px = 40;         // the start ball is large, and a message may hide a part of it
constexpr double kClick_s = 0.08;
constexpr double kAfterHand_s = 0.1;  // until what the hand did is in the picture
constexpr double kRounding_s = 1e-9;  // of times that are sums of frames
constexpr double kGlance_s = 0.15;    // from look to look, but while it presses

bool is(const std::uint8_t* pixel, Rgb colour, int within = 6) {
  return std::abs(pixel[0] - colour.r) <= within && std::abs(pixel[1] - colour.g) <= within &&
         std::abs(pixel[2] - colour.b) <= within;
}

/// The core of a painted line: nothing that is lit has its colour.
bool is_tip(const std::uint8_t* p) { return is(p, shape_colour(Ink::kTip), 12); }
bool is_lit(const std::uint8_t* p) { return is(p, shape_colour(Ink::kAccent), 12); }

/// Yellow in any light, and no orange.
bool is_yellow(const std::uint8_t* p) { return p[0] > 150 && p[1] > 130 && p[0] - p[1] < 50 && p[1] - p[2] > 60; }

struct Patch {
  int count = 0;
  double left = 1e9, right = -1, top = 1e9, bottom = -1;
  void add(int x, int y) {
    ++count;
    left = std::min<double>(left, x);
    right = std::max<double>(right, x);
    top = std::min<double>(top, y);
    bottom = std::max<double>(bottom, y);
  }
  Spot middle() const { return {0.5 * (left + right), 0.5 * (top + bottom)}; }
};

/// Of all pixels of a colour the largest patch whose parts lie within some px of each other.
Patch patch_of(const Image& picture, bool (*is_colour)(const std::uint8_t*), double near_px) {
  std::vector<Patch> patches;
  const int wide = static_cast<int>(kPictureShare * picture.width);
  for (int y = picture.height / 15; y < picture.height - picture.height / 22; ++y)
    for (int x = 0; x < wide; ++x) {
      if (!is_colour(picture.pixel(x, y))) continue;
      const auto at = std::find_if(patches.begin(), patches.end(), [&](const Patch& p) {
        return x >= p.left - near_px && x <= p.right + near_px && y >= p.top - near_px && y <= p.bottom + near_px;
      });
      (at == patches.end() ? patches.emplace_back() : *at).add(x, y);
    }
  for (std::size_t i = 0; i < patches.size(); ++i)  // parts that have grown together
    for (std::size_t j = i + 1; j < patches.size();) {
      Patch &a = patches[i], b = patches[j];
      const bool meet = b.left <= a.right + near_px && b.right >= a.left - near_px && b.top <= a.bottom + near_px &&
                        b.bottom >= a.top - near_px;
      if (!meet) {
        ++j;
        continue;
      }
      a = {a.count + b.count, std::min(a.left, b.left), std::max(a.right, b.right), std::min(a.top, b.top),
           std::max(a.bottom, b.bottom)};
      patches.erase(patches.begin() + static_cast<std::ptrdiff_t>(j));
      j = i + 1;
    }
  const auto most = std::max_element(patches.begin(), patches.end(),
                                     [](const Patch& a, const Patch& b) { return a.count < b.count; });
  return most == patches.end() ? Patch{} : *most;
}

double way(const Spot& a, const Spot& b) { return std::hypot(a.x - b.x, a.y - b.y); }

/// Where the two dials are, px.
struct Dials {
  double radius, y, place_x, turn_x;
};
/// As text is set in whole sizes they do not scale with the window: measured in two, in a straight line between them.
Dials dials_in(const Image& picture) {
  constexpr Dials kAt960{43.5, 104.5, 765.5, 879.5}, kAt1280{56, 134, 1027, 1176};
  const double s = (picture.width - 960) / 320.0;
  const auto at = [s](double a, double b) { return a + s * (b - a); };
  return {at(kAt960.radius, kAt1280.radius), at(kAt960.y, kAt1280.y), at(kAt960.place_x, kAt1280.place_x),
          at(kAt960.turn_x, kAt1280.turn_x)};
}

/// Of a dial's pixels: each with its place, 1 at the rim, up positive.
template <class Look>
void over_dial(const Image& picture, const Dials& dials, double x0, Look look) {
  for (int y = static_cast<int>(dials.y - dials.radius); y <= dials.y + dials.radius; ++y)
    for (int x = static_cast<int>(x0 - dials.radius); x <= x0 + dials.radius; ++x)
      look(picture.pixel(x, y), Spot{(x - x0) / dials.radius, (dials.y - y) / dials.radius});
}

/// Dot of a dial, while it is yellow: middle of what is bright and yellow.
std::optional<Spot> dot_of(const Image& picture, const Dials& dials, double x0) {
  Spot sum;
  int count = 0;
  over_dial(picture, dials, x0, [&](const std::uint8_t* p, const Spot& at) {
    if (p[0] < 215 || p[1] < 170 || p[2] > 90) return;
    ++count, sum.x += at.x, sum.y += at.y;
  });
  if (count < 0.0128 * dials.radius * dials.radius) return std::nullopt;
  return Spot{sum.x / count, sum.y / count};
}

/// Angle of the white mark on a dial's rim, clockwise from the top.
double mark_of(const Image& picture, const Dials& dials, double x0) {
  Spot sum;
  over_dial(picture, dials, x0, [&](const std::uint8_t* p, const Spot& at) {
    const double r = std::hypot(at.x, at.y);
    if (r < 0.7 || r > 1 || std::min({p[0], p[1], p[2]}) < 220) return;
    sum.x += at.x, sum.y += at.y;
  });
  return std::atan2(sum.x, sum.y);
}

}  // namespace

Glance glance(const Image& picture) {
  Glance out;
  const Dials dials = dials_in(picture);
  out.place = dot_of(picture, dials, dials.place_x);
  out.turn = dot_of(picture, dials, dials.turn_x);
  out.roll_rad = mark_of(picture, dials, dials.turn_x);
  const double unit = picture.height / 720.0;
  out.high = picture.height;
  const Patch lit = patch_of(picture, is_lit, 10 * unit);
  if (lit.count > 8) out.lit = lit.middle(), out.lit_wide = lit.right - lit.left;
  const Patch glow = patch_of(picture, is_yellow, 3 * unit);
  if (glow.count > 60) out.glow = glow.middle();
  const Patch plumb = patch_of(picture, is_tip, 10 * unit);
  if (plumb.count > 8) {
    const double ring = std::min(plumb.bottom - plumb.top, 0.6 * (plumb.right - plumb.left));
    out.foot = Spot{plumb.middle().x, plumb.bottom - 0.5 * ring};
    out.tip = Spot{plumb.middle().x, plumb.bottom - plumb.top > 2 * ring ? plumb.top : out.foot->y};
  }
  if (!out.tip) return out;
  // The bar lies left of the tip.
  const int x0 = static_cast<int>(out.tip->x - 170 * unit), x1 = static_cast<int>(out.tip->x - 40 * unit);
  const int y0 = static_cast<int>(out.tip->y - 14 * unit), y1 = static_cast<int>(out.tip->y + 14 * unit);
  using Force = Glance::Force;
  const std::pair<Ink, Force> colours[] = {{Ink::kHeading, Force::kLow},
                                           {Ink::kGood, Force::kGood},
                                           {Ink::kCaution, Force::kHigh},
                                           {Ink::kAlarm, Force::kHigh}};
  for (int x = std::max(0, x0); x < std::min(picture.width, x1); ++x)  // the bar begins at its left end
    for (const auto& [ink, force] : colours) {
      int count = 0;
      for (int y = std::max(0, y0); y < std::min(picture.height, y1); ++y)
        count += is(picture.pixel(x, y), shape_colour(ink)) ? 1 : 0;
      if (count < 3 || x > out.tip->x - 140 * unit) continue;  // further right it is the band
      out.force = force;
      return out;
    }
  return out;
}

bool PicturePlayer::looks(double t_s) const {
  if (hand_.busy() || t_s + kRounding_s < std::max(hand_s_ + kAfterHand_s, wait_until_s_ - kEye_s)) return false;
  return down_ || t_s + kRounding_s >= looked_s_ + kGlance_s;
}

std::vector<InputEvent> PicturePlayer::play(double t_s, const Image* picture) {
  if (picture) {
    looked_s_ = t_s;
    eye_.push_back({t_s, glance(*picture)});
  }
  std::optional<Glance> seen;
  while (!eye_.empty() && eye_.front().t_s <= t_s - kEye_s + kRounding_s) {
    seen = eye_.front().seen;
    eye_.pop_front();
  }
  std::vector<InputEvent> out = hand_.pass(t_s);
  if (hand_.busy()) hand_s_ = t_s;
  if (!seen || hand_.busy() || t_s - hand_s_ < kEye_s + kAfterHand_s - kRounding_s)
    return out;  // a look at what became of it
  const std::vector<InputEvent> more = decide(t_s, *seen);
  out.insert(out.end(), more.begin(), more.end());
  return out;
}

/// Half of the way that is left, then a look at what became of it.
std::vector<InputEvent> PicturePlayer::aim(double t_s, const Spot& from, const Spot& to) {
  wait_until_s_ = t_s + kEye_s + 0.15;
  const double share = way(from, to) > 40 ? 0.85 : 0.7;
  return hand_.move(share * (to.x - from.x), share * (to.y - from.y));
}

std::vector<InputEvent> PicturePlayer::press(double t_s, const Glance& seen) {
  using Force = Glance::Force;
  switch (stage_) {
    case Stage::kAim:
    case Stage::kCarry:
      break;
    case Stage::kPress:
      doing = "press";
      if (!down_) {
        down_ = true;
        since_s_ = t_s;
        return hand_.act(true);
      }
      if (seen.force == Force::kGood || seen.force == Force::kHigh || t_s - since_s_ > 8) {
        stage_ = seen.force == Force::kGood ? Stage::kKeep : Stage::kLift;
        down_ = false;
        since_s_ = t_s;
        wait_until_s_ = t_s + 0.5;
        return hand_.act(false);
      }
      break;
    case Stage::kKeep:
      doing = "keep";
      if (seen.force == Force::kLow && t_s - since_s_ > 0.7) stage_ = Stage::kPress;
      if (seen.force == Force::kHigh || t_s - since_s_ > 6) stage_ = Stage::kLift;
      break;
    case Stage::kLift:
      doing = "lift";
      if (!down_) {
        down_ = true;
        since_s_ = t_s;
        return hand_.act(true);
      }
      if (t_s - since_s_ < kClick_s) return {};
      down_ = false;
      stage_ = Stage::kAim;
      wait_until_s_ = t_s + kEye_s + 0.3;
      return hand_.act(false);
  }
  return {};
}

/// Over the block, which the tip then goes down to by itself; squeeze until the bar is green; over its ring; open.
std::vector<InputEvent> PicturePlayer::grasp(double t_s, const Glance& seen) {
  const std::optional<Spot> there = task_ == Task::kPegs && stage_ == Stage::kCarry ? seen.glow
                                    : seen.lit                                      ? seen.lit
                                                                                    : goal_;
  if (!there) return {};
  const double off = way(*seen.foot, *there);
  switch (stage_) {
    case Stage::kAim:
      doing = "over the block";
      if (off > 7) return aim(t_s, *seen.foot, *there);
      goal_ = there;
      stage_ = Stage::kPress;
      wait_until_s_ = t_s + 1.2;  // it goes down
      return {};
    case Stage::kPress:
      if (down_ && goal_ && way(*goal_, *there) > kMoved_px && seen.force == Glance::Force::kNone) break;
      {
        auto out = press(t_s, seen);
        if (stage_ == Stage::kKeep) stage_ = Stage::kCarry;
        return out;
      }
    case Stage::kCarry:
      doing = "carry";
      if (way(*goal_, *there) < kMoved_px) {  // it was not held
        if (t_s - since_s_ > 2) stage_ = Stage::kLift;
        return {};
      }
      if (off > (task_ == Task::kPegs ? 15 : 10)) return aim(t_s, *seen.foot, *there);
      if (std::abs(way(*seen.foot, *seen.tip) - plumb_px_) > 3) {  // it goes down by itself
        plumb_px_ = way(*seen.foot, *seen.tip);
        settled_s_ = t_s;
      }
      if (t_s - settled_s_ > 0.5) stage_ = Stage::kLift;
      return {};
    default:
      return press(t_s, seen);
  }
  return {};
}

/// Over the disc, to which the tip then goes down by itself; squeeze until the bar is green; it is lifted, and what is
/// lit is above; when the disc is lit again it has been let down: open.
std::vector<InputEvent> PicturePlayer::retract(double t_s, const Glance& seen) {
  switch (stage_) {
    case Stage::kAim:
      doing = "over the place";
      if (way(*seen.foot, *seen.lit) > 0.25 * seen.lit_wide)
        return aim(t_s, *seen.foot, *seen.lit);  // it moves with the breath
      goal_ = seen.lit;
      stage_ = Stage::kPress;
      wait_until_s_ = t_s + 1.5;  // it goes down
      return {};
    case Stage::kPress: {
      auto out = press(t_s, seen);
      if (stage_ == Stage::kKeep) stage_ = Stage::kCarry;
      return out;
    }
    case Stage::kCarry:
      doing = "hold";
      if (way(*goal_, *seen.lit) > kMoved_px) settled_s_ = t_s;
      if (t_s - std::max(settled_s_, since_s_) > 3) stage_ = Stage::kLift;
      return {};
    default:
      return press(t_s, seen);
  }
}

/// By the dials: the place first, then the lean, then the roll.
std::vector<InputEvent> PicturePlayer::reach(double t_s, const Glance& seen) {
  wait_until_s_ = t_s + kEye_s + 0.15;
  // From a dot's place to the error, in tolerances: what practice with the dial teaches.
  const auto tolerances = [](const Spot& dot) {
    const double share = std::min(0.99, std::hypot(dot.x, dot.y));
    return share <= 0.4 ? share / 0.4 : 1 - 4 * std::log(1 - (share - 0.4) / 0.6);
  };
  const auto step = [&](const Spot& dot, double px_a_tolerance) {
    const double length = 0.85 * px_a_tolerance * tolerances(dot) / std::hypot(dot.x, dot.y);
    return Spot{-length * dot.x, length * dot.y};
  };
  if (seen.place) {
    doing = "to the pen";
    const Spot by = step(*seen.place, 0.025 * seen.high);
    return hand_.move(by.x, by.y);
  }
  if (!seen.turn) return {};
  if (std::hypot(seen.turn->x, seen.turn->y) > 0.2) {
    doing = "lean";
    const Spot by = step(*seen.turn, 0.06 * seen.high);
    return hand_.lean(by.x, by.y);
  }
  doing = "roll";
  const double degrees = seen.roll_rad * 180 / std::numbers::pi;
  return hand_.roll(static_cast<int>(std::lround(-degrees / 4)));
}

std::vector<InputEvent> PicturePlayer::decide(double t_s, const Glance& seen) {
  if (t_s < wait_until_s_ || !seen.tip) return {};
  const bool carries = task_ == Task::kPegs && (stage_ == Stage::kPress || stage_ == Stage::kCarry);
  if (!seen.lit && !carries) {  // nothing is lit: a grip is asked for, or it is over
    if (dark_s_ < 0) dark_s_ = t_s;
    if (t_s - dark_s_ < 0.8) return {};
    if (stage_ == Stage::kAim) stage_ = Stage::kPress;
    return press(t_s, seen);
  }
  dark_s_ = -1;
  if (carries) return grasp(t_s, seen);
  if (!ball_) ball_ = seen.lit;  // the first that is lit
  const bool ball = way(*ball_, *seen.lit) < kBall_px;
  if (!ball) ball_ = Spot{-1000, -1000};
  if (task_ == Task::kReach && !ball) return reach(t_s, seen);
  if ((task_ == Task::kGrasp || task_ == Task::kPegs) && !ball) return grasp(t_s, seen);
  if (task_ == Task::kRetract && !ball) return retract(t_s, seen);
  const bool moved = goal_ && way(*goal_, *seen.lit) > kMoved_px;
  goal_ = seen.lit;
  if (moved && stage_ != Stage::kAim && stage_ != Stage::kLift) {
    stage_ = Stage::kLift;
    if (down_) {
      down_ = false;
      return hand_.act(false);
    }
  }
  if (stage_ != Stage::kAim) return press(t_s, seen);
  const Spot& mine = ball ? *seen.tip : *seen.foot;
  const double off = way(mine, *seen.lit);
  doing = ball ? "to the ball" : "over the disc";
  if (off > (ball ? 8 : 4)) return aim(t_s, mine, *seen.lit);
  if (ball) return {};
  stage_ = Stage::kPress;
  return press(t_s, seen);
}

}  // namespace trocar::testing_support
