#include "tests/app/window/play/player_hand.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace trocar::testing_support {
namespace {

InputEvent mouse_event(InputEvent::Kind kind, double x, double y) {
  InputEvent event;
  event.kind = kind;
  event.x = x;
  event.y = y;
  return event;
}

class MouseHand final : public PlayerHand {
 public:
  std::vector<InputEvent> move(double right_px, double down_px) override {
    x_ += right_px;
    y_ += down_px;
    return {mouse_event(InputEvent::Kind::kMouseMove, x_, y_)};
  }
  std::vector<InputEvent> act(bool down) override {
    return {mouse_event(down ? InputEvent::Kind::kButtonDown : InputEvent::Kind::kButtonUp, x_, y_)};
  }
  std::vector<InputEvent> lean(double right_px, double down_px) override {
    std::vector<InputEvent> out{mouse_event(InputEvent::Kind::kButtonDown, x_, y_)};
    out.push_back(move(right_px, down_px).front());
    out.push_back(mouse_event(InputEvent::Kind::kButtonUp, x_, y_));
    for (InputEvent& event : out) event.button = MouseButton::kRight;
    return out;
  }
  std::vector<InputEvent> roll(int notches) override {
    std::vector<InputEvent> out;
    for (const auto kind : {InputEvent::Kind::kButtonDown, InputEvent::Kind::kWheel, InputEvent::Kind::kButtonUp}) {
      out.push_back(mouse_event(kind, x_, y_));
      out.back().button = MouseButton::kRight;
    }
    out[1].wheel = notches;
    return out;
  }

 private:
  double x_ = 400, y_ = 300;
};

// What practice teaches of the speeds.
constexpr double kPicture_m = 0.14;                // what the picture's height shows, about where the tip is
constexpr double kNotch_deg = 4, kDrag_deg = 120;  // a notch of the wheel; a drag over the picture's height
constexpr double kTurn_deg_s = 45, kRoll_deg_s = 90;
constexpr double kTap_s = 0.06;  // nobody taps a key for less

/// Of keys: metres gone after being held so long, as they gain speed.
double key_way(double s) {
  constexpr double kSlow = 0.008, kFast = 0.080, kRamp = 1.2;
  return kSlow * s + (kFast - kSlow) * s * s * s / (3 * kRamp * kRamp);
}
double key_time(double way_m) {
  double low = 0, high = 2;
  for (int i = 0; i < 20; ++i) (key_way(0.5 * (low + high)) < way_m ? low : high) = 0.5 * (low + high);
  return low;
}

/// Holds and lets go.
class KeyHand final : public PlayerHand {
 public:
  explicit KeyHand(double height_px) : height_px_(height_px) {}
  std::vector<InputEvent> move(double right_px, double down_px) override {
    const double m_per_px = kPicture_m / height_px_;
    return press(right_px * m_per_px, kKeyRight, kKeyLeft, -down_px * m_per_px, kKeyUp, kKeyDown, 0.004, key_time);
  }
  std::vector<InputEvent> act(bool down) override { return {key(kKeySpace, down)}; }
  std::vector<InputEvent> lean(double right_px, double down_px) override {
    const double deg_per_px = kDrag_deg / height_px_;
    return press(right_px * deg_per_px, kKeyEnd, kKeyHome, -down_px * deg_per_px, 'Z', 'C', 6,
                 [](double deg) { return deg / kTurn_deg_s; });
  }
  std::vector<InputEvent> roll(int notches) override {
    return press(notches * kNotch_deg, 'E', 'Q', 0, 0, 0, 12, [](double deg) { return deg / kRoll_deg_s; });
  }
  std::vector<InputEvent> pass(double t_s) override {
    now_s_ = t_s;
    std::vector<InputEvent> out;
    std::erase_if(held_, [&](const std::pair<std::int32_t, double>& one) {
      if (one.second > t_s + 1e-9) return false;
      out.push_back(key(one.first, false));
      return true;
    });
    return out;
  }
  bool busy() const override { return !held_.empty(); }

 private:
  static InputEvent key(std::int32_t code, bool down) {
    InputEvent event;
    event.kind = down ? InputEvent::Kind::kKeyDown : InputEvent::Kind::kKeyUp;
    event.key = code;
    return event;
  }
  /// Two axes at once; what is short with Shift, which makes it a quarter as fast.
  template <class Time>
  std::vector<InputEvent> press(double a, std::int32_t a_plus, std::int32_t a_minus, double b, std::int32_t b_plus,
                                std::int32_t b_minus, double is_short, Time time_of) {
    std::vector<InputEvent> out;
    const bool fine = std::max(std::abs(a), std::abs(b)) < is_short;
    double until_s = now_s_;
    for (const auto& [way, plus, minus] : {std::tuple(a, a_plus, a_minus), std::tuple(b, b_plus, b_minus)}) {
      const double s = time_of(std::abs(way) * (fine ? 4 : 1));
      if (s < 0.5 * kTap_s) continue;
      held_.emplace_back(way > 0 ? plus : minus, now_s_ + std::max(kTap_s, s));
      until_s = std::max(until_s, held_.back().second);
      out.push_back(key(held_.back().first, true));
    }
    if (fine && !out.empty()) {
      out.insert(out.begin(), key(kKeyShift, true));
      held_.emplace_back(kKeyShift, until_s);
    }
    for (InputEvent& event : out) event.shift = fine;
    return out;
  }

  double height_px_, now_s_ = 0;
  std::vector<std::pair<std::int32_t, double>> held_;  // until when
};

/// Tilts a stick, far for a long way, and lets it go.
class PadHand final : public PlayerHand {
 public:
  explicit PadHand(double height_px) : height_px_(height_px) {}
  std::vector<InputEvent> move(double right_px, double down_px) override {
    const double speed = 0.10 * height_px_ / kPicture_m;  // px/s at full tilt
    return tilt(0, right_px / speed, down_px / speed);
  }
  std::vector<InputEvent> act(bool down) override {
    buttons_ = down ? std::uint32_t{kPadA} : 0u;
    return {pad()};
  }
  std::vector<InputEvent> lean(double right_px, double down_px) override {
    const double speed = kTurn_deg_s * height_px_ / kDrag_deg;
    return tilt(2, right_px / speed, down_px / speed);
  }
  std::vector<InputEvent> roll(int notches) override {
    if (notches == 0) return {};
    buttons_ = notches > 0 ? kPadRight : kPadLeft;
    until_s_ = now_s_ + std::max(kTap_s, std::abs(notches) * kNotch_deg / kRoll_deg_s);
    return {pad()};
  }
  std::vector<InputEvent> pass(double t_s) override {
    now_s_ = t_s;
    if (!busy() || t_s + 1e-9 < until_s_) return {};
    until_s_ = -1;
    axis_ = {};
    buttons_ &= kPadA;
    return {pad()};
  }
  bool busy() const override { return until_s_ >= 0; }

 private:
  InputEvent pad() const {
    InputEvent event;
    event.kind = InputEvent::Kind::kPad;
    event.axis = axis_;
    event.buttons = buttons_;
    return event;
  }
  /// @param x_s, y_s for how long at full tilt.
  std::vector<InputEvent> tilt(std::size_t first, double x_s, double y_s) {
    const double full_s = std::hypot(x_s, y_s);
    if (full_s <= 0) return {};
    const double share = std::clamp(full_s / 0.3, 0.04, 0.5);          // of the speed: in a third of a second
    const double deflection = 0.12 + 0.88 * std::pow(share, 1 / 1.8);  // as sticks are shaped
    axis_[first] = deflection * x_s / full_s;
    axis_[first + 1] = deflection * y_s / full_s;
    until_s_ = now_s_ + std::max(kTap_s, full_s / share);
    return {pad()};
  }

  double height_px_, now_s_ = 0, until_s_ = -1;
  std::array<double, 6> axis_{};
  std::uint32_t buttons_ = 0;
};

}  // namespace

std::unique_ptr<PlayerHand> player_hand(InputKind input, double height_px) {
  switch (input) {
    case InputKind::kMouse:
      return std::make_unique<MouseHand>();
    case InputKind::kKeyboard:
      return std::make_unique<KeyHand>(height_px);
    case InputKind::kPad:
      return std::make_unique<PadHand>(height_px);
    default:
      return nullptr;
  }
}

}  // namespace trocar::testing_support
