#include "app/picture/attempt/surgery_hud.h"

#include <string>

#include "app/picture/attempt/attempt_scene.h"
#include "app/picture/kinds/hud_parts.h"
#include "tissue/thin/duct_system.h"
#include "tissue/thin/throws.h"

namespace trocar {
namespace {

constexpr double kTold_s = 3;  // that a refusal stays in sight
constexpr double kFast = 5;    // mL/min: moderate bleeding (tissue/interaction/bleeding.h)

bool gives_way(const SessionView& view) { return view.scene.soft && view.tissue; }

std::string refusal_told(InstrumentKind kind, std::int32_t why) {
  if (why >= kFirstClipRefusal) return std::string(closing_words(why));
  const bool clips = kind == InstrumentKind::kClipApplier;
  return (clips ? "No clip set: " : "Not cut: ") + std::string(closing_words(why));
}

void add_suture_rows(const SutureState& sewn, std::vector<HudRow>& rows) {
  for (const auto& [name, count] :
       {std::pair("Punctures", sewn.punctures), std::pair("Stitches", sewn.stitches), std::pair("Throws", sewn.throws)})
    rows.push_back({name, std::to_string(count), ""});
  const auto knot = static_cast<KnotKind>(sewn.knot);
  rows.push_back({"Knot", knot == KnotKind::kNone ? "-" : knot_name(knot), ""});
  rows.push_back({"Pull on the needle", sewn.held ? hud_number("%.1f", sewn.pull_n) : "-", sewn.held ? "N" : "", true});
}

}  // namespace

bool plays_freely(const Scene& scene) {
  const Exercise& exercise = scene.setup.exercise;
  return exercise.kind == ExerciseKind::kTouch && scene.board.targets.empty();
}

std::vector<HudRow> free_play_rows(const SessionView& view) {
  std::vector<HudRow> rows{{"Instrument", std::string(describe(in_hand(view)).title), ""},
                           {"Pedal", view.record.stylus.pedal ? "down" : "up", ""}};
  if (!gives_way(view)) return rows;
  const SurgeryState& done = view.tissue->surgery;
  for (const auto& [name, count] :
       {std::pair("Cuts", done.cuts), std::pair("Tears", done.tears), std::pair("Clips set", done.clips)})
    rows.push_back({name, std::to_string(count), ""});
  if (!view.scene.bound.empty()) rows.push_back({"Bed peeled off", hud_number("%.0f", 100 * done.bed_free), "%"});
  if (view.scene.setup.exercise.suture) add_suture_rows(view.tissue->suture, rows);
  rows.push_back({"Blood lost", hud_number("%.1f", done.blood_ml), "mL", true});
  rows.push_back({"Bleeding now", hud_number("%.1f", done.blood_ml_per_min), "mL/min", true});
  if (done.bile_leaks > 0) rows.push_back({"Bile lost", hud_number("%.1f", done.bile_ml), "mL", true});
  rows.push_back({"Sucked off", hud_number("%.1f", done.sucked_ml), "mL"});
  const bool touches = done.contact_c > 0;
  rows.push_back({"Tissue", touches ? hud_number("%.0f", done.contact_c) : "-", touches ? "°C" : "", true});
  return rows;
}

void add_surgery_notices(const SessionView& view, std::vector<HudNotice>& notices) {
  if (!gives_way(view)) return;
  const SurgeryState& done = view.tissue->surgery;
  const InstrumentKind kind = in_hand(view);
  const std::int32_t why = done.refusal;
  // What was refused to another instrument is not told of this one.
  const bool no_wound = why == static_cast<std::int32_t>(CutRefusal::kNoWound), of_duct = why >= kFirstClipRefusal;
  const bool concerns = why == kClipCameOff || (kind == InstrumentKind::kScissors && !no_wound) ||
                        (kind == InstrumentKind::kClipApplier && (no_wound || of_duct));
  if (concerns && why != 0 && view.tissue->t_s - done.refused_s < kTold_s)
    notices.push_back({refusal_told(kind, why), HudNotice::Kind::kWarning});
  if (done.blood_ml_per_min > kFast)
    notices.push_back(
        {"Bleeding: " + hud_number("%.0f", done.blood_ml_per_min) + " mL/min", HudNotice::Kind::kTooMuch});
}

}  // namespace trocar
