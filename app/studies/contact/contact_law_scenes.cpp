#include "app/studies/contact/contact_law_scenes.h"

#include <cmath>

namespace trocar::contact_law {
namespace {

void add(ContactPatch& patch, const Vec3& a, const Vec3& b, const Vec3& c) {
  add_triangle(patch, {a, b, c}, patch.count);
}

/// Parallelogram with the normal u x v in cells x cells squares.
void add_sheet(ContactPatch& patch, const Vec3& origin, const Vec3& u, const Vec3& v, int cells) {
  const auto at = [&](int i, int j) -> Vec3 { return origin + u * i / cells + v * j / cells; };
  for (int i = 0; i < cells; ++i) {
    for (int j = 0; j < cells; ++j) {
      add(patch, at(i, j), at(i + 1, j), at(i + 1, j + 1));
      add(patch, at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
  }
}

}  // namespace

std::unique_ptr<ContactPatch> empty_patch() {
  auto patch = std::make_unique<ContactPatch>();
  patch->material[0].stiffness_n_per_m = kStiffness;
  patch->material[0].damping_s_per_m = 0;
  return patch;
}

std::unique_ptr<ContactPatch> thin_sheet() {
  auto patch = empty_patch();
  add_sheet(*patch, {-0.05, -0.05, 0.001}, {0.10, 0, 0}, {0, 0.10, 0}, 8);
  add_sheet(*patch, {-0.05, -0.05, -0.001}, {0, 0.10, 0}, {0.10, 0, 0}, 8);
  return patch;
}

std::unique_ptr<ContactPatch> block() {
  auto patch = empty_patch();
  add_sheet(*patch, {-0.03, -0.02, 0}, {0.03, 0, 0}, {0, 0.04, 0}, 6);
  add_sheet(*patch, {0, -0.02, 0}, {0, 0, -0.02}, {0, 0.04, 0}, 6);
  return patch;
}

std::unique_ptr<ContactPatch> faceted_ball() {
  auto patch = empty_patch();
  constexpr double kRadius = 0.04, kCell = 0.002;
  constexpr int kHalf = 7;
  const auto at = [&](int i, int j) {
    const double x = i * kCell, y = j * kCell;
    return Vec3(x, y, std::sqrt(kRadius * kRadius - x * x - y * y) - kRadius);
  };
  for (int i = -kHalf; i < kHalf; ++i) {
    for (int j = -kHalf; j < kHalf; ++j) {
      add(*patch, at(i, j), at(i + 1, j), at(i + 1, j + 1));
      add(*patch, at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
  }
  return patch;
}

std::unique_ptr<ContactPatch> ridge() {
  auto patch = empty_patch();
  add_sheet(*patch, {0.10, -0.02, 0}, {0, 0.04, 0}, {-0.01, 0, -0.01}, 3);
  add_sheet(*patch, {0.10, -0.02, 0}, {0.01, 0, -0.01}, {0, 0.04, 0}, 3);
  return patch;
}

std::unique_ptr<ContactPatch> ground() {
  auto patch = empty_patch();
  add_sheet(*patch, {-0.04, -0.04, 0}, {0.08, 0, 0}, {0, 0.08, 0}, 8);
  return patch;
}

Pose upright(const Vec3& p) { return {(Mat3() << 1, 0, 0, 0, -1, 0, 0, 0, -1).finished(), p}; }

Pose lying(const Vec3& p) { return {(Mat3() << 0, 0, -1, 0, 1, 0, 1, 0, 0).finished(), p}; }

ContactResult Probe::go(const Pose& X) {
  Twist V;
  if (started_) V.linear = (X.p - last_.p) / 1e-3;
  started_ = true;
  last_ = X;
  return renderer_.update(X, V, patch_);
}

ContactResult Probe::descend(const Pose& X, double height) {
  ContactResult result;
  for (double lift = height; lift > 0; lift -= kStep) result = go({X.R, X.p + Vec3(0, 0, lift)});
  return go(X);
}

}  // namespace trocar::contact_law
