#include "app/studies/tissue/drawn_contacts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "haptics/device/plant/plant_random.h"

namespace trocar {
namespace {

constexpr int kTicks = 3000;
constexpr double kTick = 1e-3;                        // s
constexpr int kParts = 20;                            // of a tick, for hand and body
constexpr double kAboveOrgan = 0.003;                 // m
constexpr int kPressTicks = 500, kLetGoTicks = 2500;  // down until; up from
constexpr int kOnTheWay = 20;                         // ticks in which the last patch arrives and is glided to
constexpr std::array kGrips{GripPreset::kFingertip, GripPreset::kLight, GripPreset::kNormal, GripPreset::kFirm};

double log_between(PlantRandom& random, double low, double high) { return low * std::pow(high / low, random.unit()); }

/// From 0 to 1 without a jerk.
double eased(double share) {
  const double s = std::clamp(share, 0.0, 1.0);
  return s * s * (3 - 2 * s);
}

Mat3 turn(double angle, const Vec3& axis) { return Eigen::AngleAxisd(angle, axis).toRotationMatrix(); }

/// Where the hand wants the tool at a tick. @param touch tip where it just touches
Pose wanted(const DrawnContact& draw, const Vec3& touch, int tick) {
  const double down = eased(tick / double{kPressTicks}) - eased((tick - kLetGoTicks) / double{kPressTicks});
  const double t = std::max(0, tick - kPressTicks) * kTick, moving = eased(t / 0.2);
  const auto wave = [&](double hertz) { return moving * std::sin(2 * std::numbers::pi * hertz * t); };
  const Vec3 lean(std::cos(draw.tilt_round_rad), std::sin(draw.tilt_round_rad), 0);
  Pose X;
  X.R = turn(draw.tilt_rad + draw.sway_rad * wave(draw.turn_hz), lean) * Vec3(1, -1, -1).asDiagonal() *
        turn(draw.twist_rad * wave(draw.turn_hz), Vec3::UnitZ());
  X.p = touch + Vec3(0, 0, kAboveOrgan - (draw.depth_m + kAboveOrgan) * down) + wave(draw.slide_hz) * draw.slide_m;
  return X;
}

/// The device in the hand.
struct Body {
  StylusMotion motion;
  double energy_j = 0, most_j = 0;  ///< that the contact has given it

  /// A tick under the contact's wrench, held.
  void move(const DrawnContact& draw, HandModel& hand, const Wrench& contact) {
    constexpr double kPartOfTick = kTick / kParts;
    for (int i = 0; i < kParts; ++i) {
      const Wrench all = hand.update(motion, kPartOfTick).stylus_B + contact;
      motion.V_BS.linear += kPartOfTick / draw.mass_kg * all.force;
      motion.V_BS.angular += kPartOfTick / draw.inertia_kg_m2 * all.moment;
      motion.X_BS.p += kPartOfTick * motion.V_BS.linear;
      const double angle = kPartOfTick * motion.V_BS.angular.norm();
      if (angle > 0) motion.X_BS.R = turn(angle, motion.V_BS.angular.normalized()) * motion.X_BS.R;
      energy_j += kPartOfTick * (contact.force.dot(motion.V_BS.linear) + contact.moment.dot(motion.V_BS.angular));
    }
    most_j = std::max(most_j, energy_j);
  }
};

}  // namespace

DrawnContact drawn_contact(std::uint64_t seed, std::size_t n, bool stiff) {
  DrawnContact draw;
  draw.seed = seed * 1'000'003 + n;
  PlantRandom random(draw.seed);
  draw.grip = kGrips[n % kGrips.size()];
  draw.hand = draw_hand_parameters(draw.grip, draw.seed);
  draw.mass_kg = log_between(random, 0.05, 0.4);
  draw.inertia_kg_m2 = log_between(random, 2e-4, 6e-4);
  draw.young_pa = stiff ? log_between(random, 20e3, 50e3) : log_between(random, 2e3, 20e3);
  draw.mu_static = log_between(random, 0.03, 0.3);
  draw.x_m = random.symmetric(0.03);
  draw.y_m = random.symmetric(0.02);
  draw.tilt_rad = 1.2 * random.unit();
  draw.tilt_round_rad = random.symmetric(std::numbers::pi);
  draw.depth_m = 0.003 + 0.009 * random.unit();
  const double way = 0.003 + 0.017 * random.unit(), to = random.symmetric(std::numbers::pi);
  draw.slide_m = way * Vec3(std::cos(to), std::sin(to), 0);
  draw.slide_hz = 0.3 + 0.7 * random.unit();
  draw.turn_hz = 0.3 + 1.2 * random.unit();
  draw.twist_rad = random.symmetric(1.2);
  draw.sway_rad = random.symmetric(0.3);
  draw.loss = 0.3 * random.unit();
  for (int at = 300; at < 2700;) {
    const int length = static_cast<int>(std::lround(log_between(random, 10, 100)));
    draw.stall.emplace_back(at, length);
    at += length + 150 + static_cast<int>(500 * random.unit());
  }
  return draw;
}

DrawnContactMeasures run_drawn_contact(const DrawnContact& draw, const DrawnContactOptions& options) {
  SoftBenchSetup setup;
  setup.rows = options.rows;
  setup.organ.solid.edge_m = options.cell_m;
  setup.material.young_pa = draw.young_pa;
  setup.material.prony = {PronyBranch{0.35, 0.1}, PronyBranch{0.25, 5}};
  setup.material.mu_static = draw.mu_static;
  setup.material.mu_dynamic = draw.mu_static / 2;
  SoftBench bench(setup);
  PlantRandom random(draw.seed ^ 0x5bd1e995u);
  HandModel hand(draw.hand, draw.seed);
  Body body;
  const Vec3 touch = bench.touching(draw.x_m, draw.y_m);
  const Pose begin = body.motion.X_BS = wanted(draw, touch, 0);

  DrawnContactMeasures out;
  Vec3 last = Vec3::Zero();
  Pose stall_begin;
  double stall_force = 0, stall_way = 0;
  int touched = 0, slipped = 0;
  auto stall = draw.stall.begin();
  for (int tick = 0; tick < kTicks; ++tick) {
    if (stall != draw.stall.end() && tick >= stall->first + stall->second) ++stall;
    const int into = stall == draw.stall.end() ? -1 : tick - stall->first;
    TissueNews news{into >= 0};
    news.lost = random.unit() < draw.loss;
    news.delay = 2 + static_cast<int>(8 * random.unit());
    Pose seen = body.motion.X_BS;
    if (options.encoder_m > 0) seen.p = options.encoder_m * (seen.p / options.encoder_m).array().round().matrix();
    const ContactResult felt = bench.tick(seen, body.motion.V_BS, news);
    const Vec3& spring = felt.spring_I_T.force;
    if (into == kOnTheWay) {
      stall_begin = seen;
      stall_force = spring.norm();
      stall_way = 0;
    }
    if (into > kOnTheWay) {
      const Vec3 arm = seen.R.transpose() * (felt.point_T - seen.p);
      stall_way = std::max(stall_way, (seen * arm - stall_begin * arm).norm());
      const double friction = 1 + draw.mu_static;
      out.stall_growth_n =
          std::max(out.stall_growth_n, spring.norm() - friction * (stall_force + bench.seen_stiffness() * stall_way));
    }
    touched += felt.contact;
    slipped += felt.slipping;
    out.most_n = std::max(out.most_n, felt.F_I_T.force.norm());
    out.most_step_n = std::max(out.most_step_n, (felt.F_I_T.force - last).norm());
    last = felt.F_I_T.force;
    hand.set_intent(wanted(draw, touch, tick), 0, kTick);
    body.move(draw, hand, felt.F_I_T);
    out.turned_rad = std::max(out.turned_rad, Eigen::AngleAxisd(begin.R.transpose() * body.motion.X_BS.R).angle());
    out.finite = out.finite && body.motion.X_BS.p.allFinite() && felt.F_I_T.force.allFinite();
  }
  out.energy_out_j = body.most_j;
  out.put_in_j = -body.energy_j;
  out.slipping = touched > 0 ? double(slipped) / touched : 0;
  return out;
}

}  // namespace trocar
