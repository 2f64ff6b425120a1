#include "scenarios/director/surgery_watch.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "tissue/thin/duct_system.h"

namespace trocar {
namespace {

constexpr double kBleeds = 0.5, kDry = 0.25, kDry_s = 1;       // mL/min, below which it has stopped, for so long
constexpr double kWorse = 3;                                   // mL/min beyond twice what was told
constexpr double kTold_ml = 10;                                // of blood from one event to the next
constexpr double kBurn_c = 60, kCooled_c = 55, kAway_s = 0.2;  // of the tissue under the instrument

}  // namespace

SurgeryWatch::SurgeryWatch() : bleeds_(kBleeds, kDry, kDry_s), burns_(kBurn_c, kCooled_c, kAway_s) {}

void SurgeryWatch::update(const SurgeryState& now, double dt_s, EventLog& log) {
  for (std::int32_t i = seen_.cuts; i < now.cuts; ++i) log.add(event_type::kCut, Severity::kInfo, -1, now.cut_m, "m");
  for (std::int32_t i = seen_.tears; i < now.tears; ++i)
    log.add(event_type::kTear, Severity::kMajor, -1, now.cut_m, "m");
  for (std::int32_t i = seen_.clips; i < now.clips; ++i) log.add(event_type::kClip, Severity::kInfo, -1, i + 1);
  for (std::int32_t i = seen_.refusals; i < now.refusals; ++i)
    log.add(event_type::kRefused, Severity::kInfo, -1, now.refusal, std::string(closing_words(now.refusal)));
  tell_blood(now, dt_s, log);
  if (burns_.update(now.contact_c, dt_s)) log.add(event_type::kBurn, Severity::kInfo, -1, now.contact_c, "°C");
  seen_ = now;
}

void SurgeryWatch::update(const SutureState& now, EventLog& log) {
  const auto tell = [&](EventType type, std::int32_t before, std::int32_t count) {
    for (std::int32_t i = before; i < count; ++i) log.add(type, Severity::kInfo, -1, i + 1);
  };
  tell(event_type::kNeedle, sewn_.needles, now.needles);
  tell(event_type::kPuncture, sewn_.punctures, now.punctures);
  tell(event_type::kStitch, sewn_.stitches, now.stitches);
  tell(event_type::kThrow, sewn_.throws, now.throws);
  sewn_ = now;
}

void SurgeryWatch::tell_blood(const SurgeryState& now, double dt_s, EventLog& log) {
  const bool begins = bleeds_.update(now.blood_ml_per_min, dt_s);
  const bool further = std::floor(now.blood_ml / kTold_ml) > std::floor(seen_.blood_ml / kTold_ml);
  const bool worse = now.blood_ml_per_min > 2 * told_ml_per_min_ + kWorse;
  told_ml_per_min_ = begins || worse ? now.blood_ml_per_min : std::min(told_ml_per_min_, now.blood_ml_per_min);
  if (begins || further || worse)
    log.add(event_type::kBleeding, further ? Severity::kMinor : Severity::kInfo, -1, now.blood_ml, "mL");
}

}  // namespace trocar
