#include "app/cli/machine/bench_contact.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <memory>

#include "haptics/contact/contact_renderer.h"
#include "haptics/least_turn.h"
#include "tissue/collision/patch_extraction.h"

namespace trocar {
namespace {

constexpr double kBallRadius = 0.08, kDepth = 0.003, kContactStep = 3e-5;

/// Every face of an octahedron in n x n triangles, pushed out to the ball: 8 n^2 triangles.
TriangleSurface ball(int n) {
  TriangleSurface surface;
  for (int face = 0; face < 8; ++face) {
    const Vec3 a(face & 1 ? -1 : 1, 0, 0), b(0, face & 2 ? -1 : 1, 0), c(0, 0, face & 4 ? -1 : 1);
    const bool flipped = a.cross(b).dot(c) < 0;
    const auto first = static_cast<std::int32_t>(surface.vertices.size());
    const auto index = [&](int i, int j) { return first + i * (n + 1) - i * (i - 1) / 2 + j; };
    for (int i = 0; i <= n; ++i) {
      for (int j = 0; j <= n - i; ++j) {
        const Vec3 p = a * (n - i - j) + b * i + c * j;
        surface.vertices.push_back(kBallRadius * p.normalized());
      }
    }
    const auto add = [&](std::int32_t u, std::int32_t v, std::int32_t w) {
      surface.triangles.push_back({u, flipped ? w : v, flipped ? v : w});
    };
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n - i; ++j) {
        add(index(i, j), index(i + 1, j), index(i, j + 1));
        if (i + j < n - 1) add(index(i + 1, j), index(i + 1, j + 1), index(i, j + 1));
      }
    }
  }
  return surface;
}

/// On a great circle over the ball, pressed in, the shaft leaning back by 30 degrees.
Pose pressed(double angle, double lift) {
  const Vec3 n(std::sin(angle), 0.3 * std::cos(angle), std::cos(angle));
  const Mat3 R =
      least_turn(Vec3::UnitZ(), -n).toRotationMatrix() * Eigen::AngleAxisd(0.5, Vec3::UnitY()).toRotationMatrix();
  return {R, n.normalized() * (kBallRadius + ToolShape{}.radius_m - kDepth + lift)};
}

/// Down onto the ball and over it, `ticks` of contact.
void drag(PatchExtraction& extraction, int ticks, ContactCost& cost) {
  const auto patch = std::make_unique<ContactPatch>();
  patch->material[0].mu_static = 0.3;
  patch->material[0].mu_dynamic = 0.2;
  ContactRenderer renderer(ContactLaw::kProxy);
  constexpr int kDescent = 200;
  for (int i = -kDescent; i < ticks; ++i) {
    const Pose X = pressed(kContactStep / kBallRadius * std::max(0, i), i < 0 ? -i * kContactStep : 0);
    if (i % 10 == 0) {
      const double start = cpu_now_us();
      extraction.extract(X, {}, *patch);
      ++patch->stamp;
      enclose(*patch, patch->balls);
      cost.extraction.us.push_back(cpu_now_us() - start);
    }
    if (i == 0) renderer.take_work();
    const double start = cpu_now_us();
    const ContactResult result = renderer.update(X, Twist{}, *patch);
    if (i < 0) continue;
    cost.step.us.push_back(cpu_now_us() - start);
    if (i % 10 == 0) cost.fresh.us.push_back(cost.step.us.back());
    cost.contact_ticks += result.contact;
  }
  const NearPairs::Work work = renderer.take_work();
  cost.lists = static_cast<double>(work.lists) / ticks;
  cost.listed = static_cast<double>(work.listed) / ticks;
  cost.measured = static_cast<double>(work.measured) / ticks;
  cost.patch = patch->count;
  cost.reach_m = patch->reach_m;
}

}  // namespace

double cpu_now_us() {
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) * 1e6 + static_cast<double>(now.tv_nsec) * 1e-3;
}

double StageTimes::percentile(double share) {
  std::sort(us.begin(), us.end());
  return us.empty() ? 0 : us[std::min(us.size() - 1, static_cast<std::size_t>(share * static_cast<double>(us.size())))];
}

StageTimes fixed_work(int times) {
  StageTimes timing{"fixed work", {}};
  double x = 1;
  for (int i = 0; i < times; ++i) {
    const double start = cpu_now_us();
    for (int k = 0; k < 300; ++k) x = std::sqrt(x + 1);
    timing.us.push_back(cpu_now_us() - start);
  }
  if (x < 0) timing.us.clear();  // keeps the optimiser from dropping the work
  return timing;
}

ContactCost contact_cost(int triangles, int ticks, int runs) {
  ContactCost cost;
  const TriangleSurface surface = ball(static_cast<int>(std::lround(std::sqrt(triangles / 8.0))));
  cost.triangles = static_cast<int>(surface.triangles.size());
  cost.extraction.stage = "patch";
  cost.refit.stage = "refit";
  cost.step.stage = "contact step";
  cost.fresh.stage = "contact step, new patch";
  cost.least.stage = "contact step, least of runs";
  PatchExtraction extraction(surface);
  for (int i = 0; i < 20; ++i) {
    const double start = cpu_now_us();
    extraction.refit();
    cost.refit.us.push_back(cpu_now_us() - start);
  }
  drag(extraction, ticks, cost);
  cost.least.us = cost.step.us;
  for (int run = 1; run < runs; ++run) {
    ContactCost again;
    drag(extraction, ticks, again);
    for (int i = 0; i < ticks; ++i) cost.least.us[i] = std::min(cost.least.us[i], again.step.us[i]);
  }
  return cost;
}

}  // namespace trocar
