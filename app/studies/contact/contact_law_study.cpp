#include "app/studies/contact/contact_law_study.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "app/studies/contact/contact_law_scenes.h"

namespace trocar {
namespace {

using namespace contact_law;

constexpr std::array kLaws{ContactLaw::kThesis, ContactLaw::kProxy};
/// Index into what was measured on both laws.
constexpr std::size_t kThesis = 0, kOurs = 1;
using Both = std::array<double, 2>;

StudyCase entry(const std::string& name, const std::string& unit, const Both& values, const std::string& bar, bool met,
                const std::string& definition) {
  const auto clean = [](double v) { return std::abs(v) < 1e-12 ? 0.0 : v; };  // rounding is no finding
  return {name, unit, clean(values[kOurs]), clean(values[kThesis]), bar, met, definition};
}

double degrees_between(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / std::numbers::pi;
}

void thin_part(StudyResult& study) {
  const auto sheet = thin_sheet();
  StudyCurves curves{"thin_sheet",
                     "Pushed through a sheet of 2 mm at 10 mm/s",
                     "depth under the upper face, mm",
                     "force against the push, N",
                     {},
                     {{"thesis' law", {}}, {"Trocar", {}}}};
  Both held{};
  constexpr int kTicks = 600;
  for (int i = 0; i <= kTicks; ++i) curves.x.push_back((i - 100) * 1e-2);
  for (std::size_t law = 0; law < 2; ++law) {
    Probe probe(kLaws[law], *sheet);
    bool pushed_back = true;
    for (int i = -400; i <= kTicks; ++i) {
      const double depth = (i - 100) * kStep;
      const double force = probe.go(upright({0.0013, 0.0007, 0.001 + probe.clearance() - depth})).F_I_T.force.z();
      if (i >= 0) curves.series[law].y.push_back(force);
      pushed_back = pushed_back && (depth <= kStep || force > 0);
      if (pushed_back) held[law] = std::max(held[law], depth);
    }
  }
  study.curves.push_back(curves);
  study.cases.push_back(entry("thin part: held back to this depth", "mm", {held[0] * 1e3, held[1] * 1e3},
                              ">= 5 (end of the push)", held[kOurs] > 4.99e-3,
                              "Depth in a sheet of 2 mm up to which the force points out of the side it came from."));
}

void fast_entry(StudyResult& study) {
  const auto sheet = thin_sheet();
  Both wrong{};
  constexpr int kTrials = 100;
  for (std::size_t law = 0; law < 2; ++law) {
    for (int trial = 0; trial < kTrials; ++trial) {
      Probe probe(kLaws[law], *sheet);
      ContactResult result;
      // Stops 1.5 mm deep, at 1 m/s: the phase of the sampling differs from trial to trial.
      const double end = 0.001 + probe.clearance() - 0.0015;
      for (int k = 20; k >= 0; --k) result = probe.go(upright({0.0013, 0.0007, end + (k + 0.01 * trial) * 1e-3}));
      result = probe.go(upright({0.0013, 0.0007, end}));
      wrong[law] += result.F_I_T.force.z() < 0 ? 1.0 / kTrials : 0;
    }
  }
  study.cases.push_back(entry("wrong side after an entry at 1 m/s", "share", wrong, "0", wrong[kOurs] == 0,
                              "Share of 100 phases of sampling after which a tool 1.5 mm deep in a sheet of 2 mm is "
                              "pushed out on the far side."));
}

void edge(StudyResult& study) {
  const auto patch = block();
  StudyCurves curves{"block_edge",
                     "1 mm deep along the top of a block and over its edge",
                     "beyond the edge, mm",
                     "sideways force, N",
                     {},
                     {{"thesis' law", {}}, {"Trocar", {}}}};
  Both jump{};
  for (int i = -300; i <= 400; ++i) curves.x.push_back(i * 1e-2);
  for (std::size_t law = 0; law < 2; ++law) {
    Probe probe(kLaws[law], *patch);
    const double height = probe.clearance() - 0.001;
    probe.descend(upright({-0.003, 0.0003, height}), 0.005);
    std::vector<Vec3> past;
    for (int i = -300; i <= 400; ++i) {
      past.push_back(probe.go(upright({i * kStep, 0.0003, height})).F_I_T.force);
      curves.series[law].y.push_back(past.back().x());
      const std::size_t from = past.size() > 10 ? past.size() - 11 : 0;
      for (std::size_t k = from; k < past.size(); ++k) jump[law] = std::max(jump[law], (past.back() - past[k]).norm());
    }
  }
  study.curves.push_back(curves);
  study.cases.push_back(
      entry("force step at an edge", "N per 0.1 mm", jump, "<= 0.03", jump[kOurs] <= 0.03,
            "Largest change of the force within 0.1 mm of motion, 1 mm deep over a right-angled edge."));
}

void facets(StudyResult& study) {
  const auto patch = faceted_ball();
  constexpr double kRadius = 0.04, kDepth = 0.0015;
  StudyCurves curves{"facets",
                     "Along a ball of 40 mm, facets of 2 mm, 1.5 mm deep",
                     "way along the ball, mm",
                     "tilt of the force along the way, deg",
                     {},
                     {{"thesis' law", {}}, {"Trocar", {}}}};
  Both turn{};
  for (int i = 0; i <= 1000; ++i) curves.x.push_back(i * 1e-2 - 5);
  for (std::size_t law = 0; law < 2; ++law) {
    Probe probe(kLaws[law], *patch);
    const auto at = [&](int i) -> Vec3 {
      const double angle = (i - 500) * kStep / kRadius;
      const Vec3 n(std::sin(angle) * std::cos(0.3), std::sin(angle) * std::sin(0.3), std::cos(angle));
      return n * (kRadius + probe.clearance() - kDepth) - Vec3(0, 0, kRadius);
    };
    Vec3 last = probe.descend(upright(at(0)), 0.005).F_I_T.force;
    for (int i = 0; i <= 1000; ++i) {
      const Vec3 force = probe.go(upright(at(i))).F_I_T.force;
      const double angle = (i - 500) * kStep / kRadius;
      const Vec3 along(std::cos(angle) * std::cos(0.3), std::cos(angle) * std::sin(0.3), -std::sin(angle));
      curves.series[law].y.push_back(std::asin(force.normalized().dot(along)) * 180 / std::numbers::pi);
      turn[law] = std::max(turn[law], degrees_between(force, last));
      last = force;
    }
  }
  study.curves.push_back(curves);
  study.cases.push_back(entry("facets: turn of the force", "deg per tick", turn, "<= 2", turn[kOurs] <= 2,
                              "Largest change of the force's direction in one tick of 10 um along a faceted ball."));
}

void moments(StudyResult& study) {
  const auto patch = ridge();
  const double depth = 0.003, expected = kStiffness * depth * 0.10;
  Both torque{};
  for (std::size_t law = 0; law < 2; ++law) {
    Probe probe(kLaws[law], *patch);
    torque[law] = -probe.descend(lying({0, 0, ToolShape{}.radius_m - depth}), 0.008).F_I_T.moment.y() / expected;
  }
  study.cases.push_back(entry("torque of the shaft on a ridge", "share of the sum by hand", torque, "0.99 to 1.01",
                              std::abs(torque[kOurs] - 1) < 0.01,
                              "Moment about the tip, 3 mm deep 100 mm behind it, over k x depth x lever."));
  // The thesis prints M = r x F with r from the contact to the end point: minus the moment that does the work.
  Probe probe(ContactLaw::kProxy, *patch);
  const Pose X = lying({0, 0, ToolShape{}.radius_m - depth});
  const ContactResult at_rest = probe.descend(X, 0.008);
  Both energy{};
  constexpr double kTurn = 1e-4;
  for (const int side : {-1, 1}) {
    Probe turned(ContactLaw::kProxy, *patch);
    const Mat3 R = Eigen::AngleAxisd(side * kTurn, Vec3::UnitY()).toRotationMatrix() * X.R;
    energy[side > 0 ? 1 : 0] = turned.descend({R, X.p}, 0.008).stored_j;
  }
  const double by_work = -(energy[1] - energy[0]) / (2 * kTurn);
  const Vec3 lever = at_rest.point_T - X.p;
  const Both sign{(-lever).cross(at_rest.F_I_T.force).y() / by_work, at_rest.F_I_T.moment.y() / by_work};
  study.cases.push_back(entry("moment against virtual work", "share", sign, "0.99 to 1.01",
                              std::abs(sign[kOurs] - 1) < 0.01,
                              "Moment over minus the slope of the stored energy; the thesis' formula as printed."));
}

void friction(StudyResult& study) {
  const auto patch = ground();
  patch->material[0].mu_static = 0.10;  // smooth shaft on wet serosa
  patch->material[0].mu_dynamic = 0.05;
  StudyCurves curves{"friction",  "3 mm deep, dragged 6 mm forth and back at 30 mm/s, mu 0.10 and 0.05",
                     "place, mm", "force along the motion over normal force",
                     {},          {{"thesis' law", {}}, {"Trocar", {}}}};
  Both sliding{}, breakaway{};
  for (int i = 0; i <= 400; ++i) curves.x.push_back(0.03 * (i <= 200 ? i : 400 - i));
  for (std::size_t law = 0; law < 2; ++law) {
    Probe probe(kLaws[law], *patch);
    const double height = probe.clearance() - 0.003;
    probe.descend(upright({0, 0.0003, height}), 0.005);
    for (int i = 0; i <= 400; ++i) {
      const Vec3 F = probe.go(upright({curves.x[static_cast<std::size_t>(i)] * 1e-3, 0.0003, height})).F_I_T.force;
      const double ratio = F.x() / F.z();
      curves.series[law].y.push_back(ratio);
      if (i <= 200) breakaway[law] = std::max(breakaway[law], -ratio);
      if (i == 200) sliding[law] = -ratio;
    }
  }
  study.curves.push_back(curves);
  study.cases.push_back(entry("friction at break-away over normal force", "1", breakaway, "0.10 +- 2 %",
                              std::abs(breakaway[kOurs] - 0.10) < 0.002, "Largest tangential force, mu static 0.10."));
  study.cases.push_back(entry("friction when sliding over normal force", "1", sliding, "0.05 +- 2 %",
                              std::abs(sliding[kOurs] - 0.05) < 0.001, "At 30 mm/s, mu dynamic 0.05."));
}

void damping_and_ghosts(StudyResult& study) {
  const auto patch = ground();
  patch->material[0].damping_s_per_m = 0.5;
  Both lost{}, ghost{};
  for (std::size_t law = 0; law < 2; ++law) {
    Probe probe(kLaws[law], *patch);
    const double start = probe.clearance() + 0.003;
    probe.go(upright({0, 0, start}));
    double z = start, worst = 0, stored = 0;
    Vec3 before = Vec3::Zero();
    for (int i = 1; i <= 400; ++i) {  // a tap of 5 mm, 100 mm/s
      const double next = start - 0.008 * std::sin(std::numbers::pi * i / 400);
      const ContactResult r = probe.go(upright({0, 0, next}));
      lost[law] -= 0.5 * (before + r.F_I_T.force).z() * (next - z) * 1e3;
      stored = std::max(stored, r.stored_j * 1e3);
      if (next > probe.clearance() + 1e-6) worst = std::max(worst, r.F_I_T.force.norm());
      before = r.F_I_T.force;
      z = next;
    }
    ghost[law] = worst;
    lost[law] /= stored;
  }
  study.cases.push_back(entry("energy lost in a tap over energy stored", "1", lost, "> 0.01", lost[kOurs] > 0.01,
                              "Half-sine tap, 5 mm deep, damping 0.5 s/m; the thesis' force has no damping."));
  study.cases.push_back(entry("ghost force in the air", "N", ghost, "0", ghost[kOurs] == 0,
                              "Largest force before and after the tap with the tool off the surface."));
}

}  // namespace

StudyResult contact_law_study() {
  StudyResult study{"contact-law", "none: the contact laws alone, 150 N/m, 1 kHz", {}, {}};
  thin_part(study);
  fast_entry(study);
  edge(study);
  facets(study);
  moments(study);
  friction(study);
  damping_and_ghosts(study);
  return study;
}

}  // namespace trocar
