#include "app/studies/tissue/soft_bench.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <numbers>
#include <utility>
#include <vector>

namespace trocar {
namespace {

const Vec3 kOrganHalf(0.100, 0.075, 0.040);  // m
constexpr double kLoopPeriod = 1e-3;
constexpr double kEncoderStep = 3e-5;  // m of the tip to one count of an encoder
constexpr int kHandSubsteps = 100;     // of the hand in a tick

Pose pointing_down(const Vec3& tip_T) {
  Pose X;
  X.R = Vec3(1, -1, -1).asDiagonal();
  X.p = tip_T;
  return X;
}

SoftOrgan organ_on(const SurfacePtr& rest, const SoftBenchSetup& setup) {
  LatticeOptions options;
  options.cell_m = setup.organ.solid.edge_m;
  return SoftOrgan(build_lattice(*rest, options).lattice, rest, setup.material, setup.organ);
}

}  // namespace

double thread_cpu_s() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

TriangleSurface ellipsoid_surface(const Vec3& half_m, int rows) {
  TriangleSurface out;
  const int columns = 2 * rows;
  const auto add = [&](const Vec3& direction) { out.vertices.push_back(half_m.cwiseProduct(direction)); };
  const auto at = [&](int row, int column) { return 1 + (row - 1) * columns + column % columns; };
  add(Vec3::UnitZ());
  for (int row = 1; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const double down = std::numbers::pi * row / rows, round = 2 * std::numbers::pi * column / columns;
      add({std::sin(down) * std::cos(round), std::sin(down) * std::sin(round), std::cos(down)});
    }
  add(-Vec3::UnitZ());
  const int last = static_cast<int>(out.vertices.size()) - 1;
  for (int column = 0; column < columns; ++column) {
    out.triangles.push_back({0, at(1, column), at(1, column + 1)});
    out.triangles.push_back({at(rows - 1, column), last, at(rows - 1, column + 1)});
    for (int row = 1; row < rows - 1; ++row) {
      out.triangles.push_back({at(row, column), at(row + 1, column), at(row + 1, column + 1)});
      out.triangles.push_back({at(row, column), at(row + 1, column + 1), at(row, column + 1)});
    }
  }
  return out;
}

SoftBench::SoftBench(const SoftBenchSetup& setup)
    : setup_(setup),
      rest_(still_surface(ellipsoid_surface(kOrganHalf, setup.rows))),
      organ_(organ_on(rest_, setup)),
      felt_(*rest_),
      velocity_(felt_.vertices.size(), Vec3::Zero()),
      extraction_(std::in_place, felt_),
      renderer_(setup.bridge == RateBridge::kThesis ? ContactLaw::kThesis : ContactLaw::kProxy, tool_),
      period_(static_cast<int>(std::lround(setup.organ.solid.step_s / kLoopPeriod))) {}

Vec3 SoftBench::touching(double x_m, double y_m) const {
  const double x = x_m / kOrganHalf.x(), y = y_m / kOrganHalf.y();
  return {x_m, y_m, kOrganHalf.z() * std::sqrt(1 - x * x - y * y) + tool_.radius_m};
}

bool SoftBench::cut(const Blade& blade) {
  if (organ_.cut(blade).refusal != CutRefusal::kNone) return false;
  felt_.vertices.assign(organ_.felt().begin(), organ_.felt().end());
  felt_.triangles = organ_.rest()->triangles;
  velocity_.assign(felt_.vertices.size(), Vec3::Zero());
  extraction_.emplace(felt_);
  return true;
}

void SoftBench::step_tissue(const Pose& X_TI) {
  const double begin = thread_cpu_s();
  organ_.step(renderer_.contacts(), &X_TI.p);
  const bool dented = setup_.bridge == RateBridge::kThesis;
  const auto now = dented ? std::span<const Vec3>(organ_.surface()->vertices) : organ_.felt();
  for (std::size_t v = 0; v < now.size(); ++v) {
    velocity_[v] = (now[v] - felt_.vertices[v]) / setup_.organ.solid.step_s;
    felt_.vertices[v] = now[v];
  }
  extraction_->refit(velocity_);
  extraction_->extract(X_TI, tool_, *made_);
  made_->stamp = ++stamp_;
  made_->topology = organ_.topology();
  made_->follows = stamp_ - 1;
  made_->glide_s = setup_.bridge == RateBridge::kGliding ? setup_.organ.solid.step_s : 0;
  made_->moving = setup_.bridge == RateBridge::kGliding;
  made_->given_j = organ_.given_j();
  made_->material[0] = {organ_.stiffness_n_per_m(), 0.5, setup_.material.mu_static, setup_.material.mu_dynamic};
  enclose(*made_, made_->balls);
  tissue_cpu_s_ += thread_cpu_s() - begin;
  ++steps_;
  made_force_ = organ_.force_n() * Vec3::UnitZ();
  made_tip_ = X_TI.p;
}

Vec3 SoftBench::bridged(const ContactResult& contact, const Vec3& tip_T) const {
  if (setup_.bridge == RateBridge::kHeld) return solved_force_;
  if (setup_.bridge != RateBridge::kSpring) return contact.F_I_T.force;
  const double force = solved_force_.z() + setup_.coupling_n_per_m * (solved_tip_ - tip_T).z();
  return solved_force_.z() > 0 ? Vec3(0, 0, std::max(0.0, force)) : Vec3::Zero();
}

void SoftBench::receive() {
  if (due_ != static_cast<std::int64_t>(tick_)) return;
  std::swap(seen_, made_);
  solved_force_ = made_force_;
  solved_tip_ = made_tip_;
  due_ = -1;
}

ContactResult SoftBench::tick(const Pose& X_TI, const Twist& V_TI_T, const TissueNews& news) {
  receive();
  if (tick_ % static_cast<std::uint64_t>(period_) == 0 && !news.stalled) {
    step_tissue(X_TI);
    const int delay = news.delay < 0 ? setup_.patch_delay % period_ : news.delay;
    due_ = news.lost ? -1 : static_cast<std::int64_t>(tick_) + delay;
    receive();
  }
  ++tick_;
  return seen_->stamp == 0 ? ContactResult{} : renderer_.update(X_TI, V_TI_T, *seen_);
}

Vec3 SoftBench::tick(const Vec3& tip_T, const Vec3& velocity_T) {
  return bridged(tick(pointing_down(tip_T), {velocity_T, Vec3::Zero()}, {}), tip_T);
}

PressMeasures press(const SoftBenchSetup& setup, const SoftHand& hand, double depth_m) {
  SoftBench bench(setup);
  constexpr double kX = 0.013, kY = 0.007, kAbove = 0.003;  // m: no symmetry, clear of the organ
  const Vec3 touch = bench.touching(kX, kY);
  PressMeasures out;
  std::vector<double> held;
  double z = kAbove, speed = 0, before = 0, energy = 0, most = 0;
  for (int tick = 0; tick < 5000; ++tick) {
    const double t = tick * kLoopPeriod;
    const double wave = t > 3 ? 0.004 * std::sin(4 * std::numbers::pi * (t - 3)) : 0;
    const double wanted = kAbove - (depth_m + kAbove) * std::min(1.0, t) + wave;
    const double counted = kEncoderStep * std::round(z / kEncoderStep);
    const double force = bench.tick(touch + Vec3(0, 0, counted), {0, 0, speed}).z();
    out.most_step_n = std::max(out.most_step_n, std::abs(force - before));
    before = force;
    for (int i = 0; i < kHandSubsteps; ++i) {
      constexpr double kStep = kLoopPeriod / kHandSubsteps;
      speed += kStep * (hand.stiffness_n_per_m * (wanted - z) - hand.damping_n_s_per_m * speed + force) / hand.mass_kg;
      z += kStep * speed;
      energy += kStep * force * speed;
    }
    most = std::max(most, energy);
    if (t >= 2 && t < 3) held.push_back(force);
    if (tick == 2999) out.tissue_n = bench.tissue_force_n();
  }
  for (const double force : held) out.hold_n += force / static_cast<double>(held.size());
  for (const double force : held) out.ripple_n = std::max(out.ripple_n, std::abs(force - out.hold_n));
  out.energy_out_j = most;
  return out;
}

}  // namespace trocar
