#include "tissue/thin/sheet_grip.h"

#include <algorithm>
#include <cmath>

namespace trocar {
namespace {

constexpr std::size_t kMostSheetPlaces = 6;
constexpr double kTakesSheet = 0.1, kKeepsSheet = 0.05;  // N of squeeze, as SoftGrip
constexpr double kBesidePads = 0.001;                    // m
constexpr double kLeastArea = 4e-6;                      // m2 between the pads: an edge just caught
constexpr double kLeastSheetHold = 1;                    // N/m
constexpr std::size_t kAxes = 3;

constexpr Barycentric kMiddle{1. / 3, 1. / 3, 1. / 3};

}  // namespace

std::vector<std::int32_t> triangles_between(const ElasticSheet& sheet, const Pose& X_TI, double length_m,
                                            double width_m, double opening_m, double beyond_m) {
  std::vector<std::int32_t> out;
  const Pose X_IT = X_TI.inverse();
  for (std::size_t t = 0; t < sheet.triangles().size(); ++t) {
    const Vec3 p = X_IT * sheet.place_T({static_cast<std::int32_t>(t), kMiddle});
    if (std::abs(p.x()) <= width_m / 2 + beyond_m && std::abs(p.y()) <= opening_m / 2 + beyond_m && p.z() <= beyond_m &&
        p.z() >= -length_m - beyond_m)
      out.push_back(static_cast<std::int32_t>(t));
  }
  return out;
}

void SheetGrip::let_go() { *this = SheetGrip(options_); }

bool SheetGrip::on_pads(const Vec3& p) const {
  return std::abs(p.x()) < options_.pad_width_m / 2 + kBesidePads && p.z() < kBesidePads &&
         p.z() > -options_.pad_length_m - kBesidePads;
}

void SheetGrip::take(const Pose& X_TI, const ElasticSheet& sheet, std::span<const std::int32_t> between) {
  const std::size_t count = std::min(kMostSheetPlaces, between.size());
  for (std::size_t i = 0; i < count; ++i) {
    const MaterialPoint on{between[(2 * i + 1) * between.size() / (2 * count)], kMiddle};
    places_.push_back({on, X_TI.inverse() * sheet.place_T(on)});
  }
  slipped_m_ = 0;
  state_ = GripState::kHolding;
}

void SheetGrip::reach(const Pose& X_TI, double opening_m, const ElasticSheet& sheet,
                      std::vector<SheetSpring>& springs) {
  if (!std::isfinite(opening_m) || !X_TI.R.allFinite() || !X_TI.p.allFinite()) return let_go();
  const SheetOptions& o = sheet.options();
  const double thickness = std::max(o.thickness_m, options_.least_thickness_m);
  // Wide jaws have what lies between them, closed ones what is as thick as the sheet.
  const auto between = triangles_between(sheet, X_TI, options_.pad_length_m, options_.pad_width_m,
                                         std::max(opening_m, thickness), kBesidePads);
  const bool holding = !places_.empty();
  if (!holding) {
    const bool enters = state_ == GripState::kAround || opening_m > thickness;
    if (between.empty() || !enters) return let_go();
    state_ = GripState::kAround;
  }
  const double area = std::min(options_.pad_length_m * options_.pad_width_m,
                               std::max(kLeastArea, static_cast<double>(between.size()) * sheet.mean_area_m2()));
  const double stiffness = o.young_pa / (1 - o.poisson * o.poisson) * area / thickness;
  block_ = {thickness, std::min(stiffness, options_.most_stiffness_n_per_m)};
  squeeze_n_ = block_.stiffness_n_per_m * std::max(0.0, thickness - opening_m);
  if (holding && squeeze_n_ < kKeepsSheet) {
    let_go();
    state_ = GripState::kAround;
    return;
  }
  if (!holding && squeeze_n_ >= kTakesSheet) take(X_TI, sheet, between);
  for (const Place& place : places_) {
    const Vec3 apart = sheet.place_T(place.on) - X_TI * place.point_I;
    for (std::size_t axis = 0; axis < kAxes; ++axis)
      springs.push_back({.place = place.on,
                         .direction = Vec3::Unit(static_cast<Eigen::Index>(axis)),
                         .stiffness_n_per_m = options_.hold_n_per_m / static_cast<double>(places_.size()),
                         .stretch_m = apart[static_cast<Eigen::Index>(axis)]});
  }
}

void SheetGrip::feel(const Pose& X_TI, std::span<const SheetSpring> springs, const ElasticSheet& sheet) {
  hold_ = {};
  if (places_.empty() || springs.size() != kAxes * places_.size()) return;
  Vec3 pull = Vec3::Zero();
  for (const SheetSpring& spring : springs) pull += spring.force_n * spring.direction;
  const double most = 2 * options_.friction * squeeze_n_, size = pull.norm();
  const double kept = size > most ? most / size : 1;
  state_ = kept < 1 ? GripState::kSlipping : GripState::kHolding;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    Vec3 stretch = Vec3::Zero();
    for (std::size_t axis = 0; axis < kAxes; ++axis) {
      const SheetSpring& spring = springs[kAxes * i + axis];
      stretch += spring.force_n / spring.stiffness_n_per_m * spring.direction;
    }
    places_[i].point_I += X_TI.R.transpose() * ((1 - kept) * stretch);
  }
  slipped_m_ += (1 - kept) * size / options_.hold_n_per_m;
  pull *= kept;
  std::erase_if(places_, [&](const Place& place) { return !on_pads(place.point_I); });
  if (places_.empty()) return let_go();
  for (const Place& place : places_) hold_.point_I += place.point_I / static_cast<double>(places_.size());
  const Vec3 direction = size > 0 ? Vec3(pull.normalized()) : Vec3::UnitZ();
  const double k = options_.hold_n_per_m, one = k / static_cast<double>(places_.size());
  // In series with the sheet, whose step has the spring in it.
  const double loop = k * (1 - one * sheet.compliance(places_[places_.size() / 2].on, direction));
  hold_.stiffness_n_per_m = std::clamp(loop, kLeastSheetHold, options_.most_loop_n_per_m);
  hold_.anchor_T = X_TI * hold_.point_I + pull / hold_.stiffness_n_per_m;
}

}  // namespace trocar
