#include "tissue/thin/clip_applier.h"

#include <algorithm>
#include <cmath>

namespace trocar {
namespace {

constexpr double kRodSampling = 0.001;  // m
constexpr double kBesideClip = 0.0005;  // m between the legs of two clips

JawSpace clip_space(const ClipApplierOptions& options, double opening_m) {
  return {options.clip.length_m, options.clip.width_m, opening_m};
}

bool organ_between(const Pose& X_TI, const JawSpace& jaws, const TriangleSurface& organ_T) {
  const Pose X_IT = X_TI.inverse();
  const double round = jaws.length_m + jaws.opening_m;
  const auto inside = [&](const Vec3& p) {
    return std::abs(p.x()) < jaws.width_m / 2 && std::abs(p.y()) < jaws.opening_m / 2 && p.z() > -jaws.length_m &&
           p.z() < 0;
  };
  for (const auto& corner : organ_T.triangles) {
    const Vec3 a = organ_T.vertices[static_cast<std::size_t>(corner[0])];
    const Vec3 b = organ_T.vertices[static_cast<std::size_t>(corner[1])];
    const Vec3 c = organ_T.vertices[static_cast<std::size_t>(corner[2])];
    const double longest = std::max((b - a).norm(), (c - a).norm());
    if ((a - X_TI.p).norm() > round + longest) continue;
    const int pieces = std::max(1, static_cast<int>(std::ceil(longest / (jaws.width_m / 2))));
    for (int i = 0; i <= pieces; ++i)
      for (int k = 0; k + i <= pieces; ++k)
        if (inside(X_IT * Vec3(a + (b - a) * i / pieces + (c - a) * k / pieces))) return true;
  }
  return false;
}

}  // namespace

std::string_view sentence(ClipRefusal refusal) {
  switch (refusal) {
    case ClipRefusal::kNone:
      return "The clip is placed.";
    case ClipRefusal::kMagazineEmpty:
      return "The clip applier is empty.";
    case ClipRefusal::kNothingBetween:
      return "There is no duct between the jaws.";
    case ClipRefusal::kSomethingElse:
      return "Something else is between the jaws too.";
    case ClipRefusal::kAngle:
      return "The clip must lie straight across the duct.";
    case ClipRefusal::kNotWhole:
      return "A part of the duct lies outside the jaws.";
    case ClipRefusal::kTipHidden:
      return "The tips of the clip do not show beyond the duct.";
    case ClipRefusal::kNotShut:
      return "The jaws were not closed fully.";
  }
  return "";
}

ClipVerdict judge_clip(const Pose& X_TI, double opening_m, const ClipSurroundings& round,
                       const ClipApplierOptions& options) {
  const JawSpace jaws = clip_space(options, opening_m);
  ClipVerdict verdict;
  std::vector<RodCrossing> crossings;
  int touched = 0;
  bool on_clip = false;
  for (std::size_t r = 0; r < round.rods.size(); ++r) {
    const ElasticRod& rod = *round.rods[r].rod;
    const std::vector<RodCrossing> of_rod = rod_crossings(rod, X_TI, jaws);
    const std::vector<double> between = arcs_between(rod, X_TI, jaws, 0, kRodSampling);
    if (of_rod.empty() && between.empty()) continue;
    ++touched;
    if (!crossings.empty()) continue;  // the second one is something else
    verdict.rod = static_cast<std::int32_t>(r);
    crossings = of_rod;
    if (of_rod.empty()) {  // it runs along the jaws
      verdict.arc_m = between[between.size() / 2];
      verdict.angle_rad = std::acos(std::min(1.0, std::abs(rod.frame_at(verdict.arc_m).col(2).dot(X_TI.R.col(0)))));
      continue;
    }
    for (const double arc : round.rods[r].clips)
      on_clip = on_clip || std::abs(arc - of_rod.front().arc_m) < options.clip.width_m + kBesideClip;
  }
  if (!crossings.empty()) {
    const RodCrossing& at = crossings.front();
    verdict.arc_m = at.arc_m;
    verdict.width_share = at.share_between;
    verdict.tip_beyond_m = at.tip_beyond_m;
    verdict.angle_rad = at.angle_rad;
  }
  const bool else_between =
      touched > 1 || crossings.size() > 1 || on_clip || (round.organ_T && organ_between(X_TI, jaws, *round.organ_T));
  if (touched == 0)
    verdict.refusal = ClipRefusal::kNothingBetween;
  else if (else_between)
    verdict.refusal = ClipRefusal::kSomethingElse;
  else if (verdict.angle_rad > options.most_angle_rad)
    verdict.refusal = ClipRefusal::kAngle;
  else if (verdict.width_share < 1)
    verdict.refusal = ClipRefusal::kNotWhole;
  else if (verdict.tip_beyond_m < options.least_tip_m)
    verdict.refusal = ClipRefusal::kTipHidden;
  return verdict;
}

ClipApplier::ClipApplier(const ClipApplierOptions& options) : options_(options), left_(std::max(0, options.magazine)) {
  if (left_ == 0) phase_ = Phase::kEmpty;
}

ClipOutcome ClipApplier::shut(bool forced) {
  ClipOutcome outcome{verdict_};
  if (left_ == 0) {
    outcome.verdict.refusal = ClipRefusal::kMagazineEmpty;
    return outcome;
  }
  const bool good = verdict_.refusal == ClipRefusal::kNone;
  outcome.placed = good || (forced && verdict_.width_share > 0);
  outcome.lost = !outcome.placed && forced;
  if (outcome.placed || outcome.lost) --left_;
  return outcome;
}

std::optional<ClipOutcome> ClipApplier::step(const Pose& X_TI, double opening_m, const ClipSurroundings& round,
                                             bool forced) {
  if (!std::isfinite(opening_m) || !X_TI.R.allFinite() || !X_TI.p.allFinite()) return std::nullopt;
  if (phase_ == Phase::kShut) {
    if (opening_m > options_.engaged_opening_m) phase_ = left_ > 0 ? Phase::kLoaded : Phase::kEmpty;
    return std::nullopt;
  }
  if (phase_ != Phase::kEngaged) {
    if (opening_m > options_.engaged_opening_m) return std::nullopt;
    phase_ = Phase::kEngaged;
    least_opening_m_ = opening_m;
    something_else_ = false;
  }
  verdict_ = judge_clip(X_TI, opening_m, round, options_);
  // Squeezed out by jaws that shut, it was between them all the same.
  something_else_ = something_else_ || verdict_.refusal == ClipRefusal::kSomethingElse;
  if (something_else_ && verdict_.rod >= 0) verdict_.refusal = ClipRefusal::kSomethingElse;
  least_opening_m_ = std::min(least_opening_m_, opening_m);
  const double walls =
      verdict_.rod >= 0 ? 2 * round.rods[static_cast<std::size_t>(verdict_.rod)].rod->options().wall_m : 0;
  if (opening_m <= options_.shut_opening_m + walls) {
    phase_ = Phase::kShut;
    return shut(forced);
  }
  if (opening_m < least_opening_m_ + options_.reopened_m && opening_m <= options_.engaged_opening_m)
    return std::nullopt;
  phase_ = Phase::kShut;  // until they are wide open again
  if (opening_m > options_.engaged_opening_m) phase_ = left_ > 0 ? Phase::kLoaded : Phase::kEmpty;
  if (verdict_.rod < 0) return std::nullopt;
  ClipOutcome outcome{verdict_};
  outcome.verdict.refusal = left_ > 0 ? ClipRefusal::kNotShut : ClipRefusal::kMagazineEmpty;
  return outcome;
}

}  // namespace trocar
