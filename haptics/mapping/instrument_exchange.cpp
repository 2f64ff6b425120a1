#include "haptics/mapping/instrument_exchange.h"

#include <algorithm>

namespace trocar {

bool InstrumentExchange::update(bool pressed, double dt_s) {
  if (pressed && !was_pressed_) wanted_ = (wanted_ + 1) % count_;
  was_pressed_ = pressed;
  const double step = dt_s / kPart_s;
  if (index_ != wanted_) {
    share_ = std::max(0.0, share_ - step);
    if (share_ > 0) return false;
    index_ = wanted_;
    rest_s_ = kRest_s;
    return true;
  }
  if (rest_s_ > 0)
    rest_s_ -= dt_s;
  else
    share_ = std::min(1.0, share_ + step);
  return false;
}

}  // namespace trocar
