// An organ that gives way under the contact stage, each at its own rate: the loop at 1 kHz, the organ a step behind,
// its patch some periods late; and a hand with the device in it.
#pragma once

#include <algorithm>
#include <deque>
#include <memory>
#include <numbers>
#include <vector>

#include "haptics/contact/contact_renderer.h"
#include "tissue/collision/patch_extraction.h"
#include "tissue/solid/soft_organ.h"

namespace trocar::test {

/// An ellipsoid's surface, poles on z.
inline SurfacePtr ellipsoid(const Vec3& half_m, int rows) {
  SurfaceSnapshot s;
  const int columns = 2 * rows;
  s.vertices.push_back({0, 0, half_m.z()});
  for (int i = 1; i < rows; ++i)
    for (int j = 0; j < columns; ++j) {
      const double t = std::numbers::pi * i / rows, p = 2 * std::numbers::pi * j / columns;
      s.vertices.push_back(
          half_m.cwiseProduct(Vec3(std::sin(t) * std::cos(p), std::sin(t) * std::sin(p), std::cos(t))));
    }
  s.vertices.push_back({0, 0, -half_m.z()});
  const auto last = std::int32_t(s.vertices.size()) - 1;
  const auto id = [&](int i, int j) { return std::int32_t(1 + (i - 1) * columns + j % columns); };
  for (int j = 0; j < columns; ++j) s.triangles.push_back({0, id(1, j), id(1, j + 1)});
  for (int i = 1; i < rows - 1; ++i)
    for (int j = 0; j < columns; ++j) {
      s.triangles.push_back({id(i, j), id(i + 1, j), id(i + 1, j + 1)});
      s.triangles.push_back({id(i, j), id(i + 1, j + 1), id(i, j + 1)});
    }
  for (int j = 0; j < columns; ++j) s.triangles.push_back({id(rows - 1, j), last, id(rows - 1, j + 1)});
  return std::make_shared<const SurfaceSnapshot>(std::move(s));
}

struct SoftSceneOptions {
  Vec3 half_m{0.06, 0.05, 0.035};
  int rows = 48;
  TissueSolid material;
  SoftOrganOptions organ;
  GlideParameters glide;
  ToolShape tool;
  int period_ticks = 10;  ///< of the organ: its step in ms
  int delay_ticks = 5;    ///< after which the loop sees a patch
};

/// The shaft straight down, its tip at p.
inline Pose from_above(const Vec3& p) {
  Pose X;
  X.R << 1, 0, 0, 0, -1, 0, 0, 0, -1;
  X.p = p;
  return X;
}

class SoftScene {
 public:
  explicit SoftScene(const SoftSceneOptions& options)
      : options_(made_one(options)),
        tool_(options.tool),
        rest_(ellipsoid(options.half_m, options.rows)),
        organ_(build_lattice({rest_->vertices, rest_->triangles}, {.cell_m = options_.organ.solid.edge_m}).lattice,
               rest_, options.material, options_.organ),
        felt_{rest_->vertices, rest_->triangles},
        velocity_(felt_.vertices.size(), Vec3::Zero()),
        extraction_(felt_),
        renderer_(ContactLaw::kProxy, tool_, options.glide) {}

  /// One period of the loop. @param heard the organ gets the contacts; @param stalled the organ does not step
  ContactResult tick(const Pose& X, const Vec3& velocity, bool stalled = false, bool lost = false) {
    if (tick_ % options_.period_ticks == 0 && !stalled) step(X, lost);
    if (!waiting_.empty() && waiting_.front().due <= tick_) {
      std::swap(seen_, waiting_.front().patch);
      spare_.push_back(std::move(waiting_.front().patch));
      waiting_.pop_front();
    }
    ++tick_;
    if (seen_->stamp == 0) return {};
    return renderer_.update(X, {velocity, Vec3::Zero()}, *seen_);
  }

  /// Where the tip just touches the resting surface above that place, coming down. m
  double touching_z(double x, double y) const {
    const Vec3 h = options_.half_m;
    // The tip's sphere rests on the ellipsoid: the foot lies nearer to the middle.
    double least = -1;
    for (int i = -60; i <= 60; ++i)
      for (int j = -60; j <= 60; ++j) {
        const double dx = i * tool_.radius_m / 60, dy = j * tool_.radius_m / 60;
        const double left = tool_.radius_m * tool_.radius_m - dx * dx - dy * dy;
        const double inside = 1 - std::pow((x + dx) / h.x(), 2) - std::pow((y + dy) / h.y(), 2);
        if (left >= 0 && inside > 0) least = std::max(least, h.z() * std::sqrt(inside) + std::sqrt(left));
      }
    return least;
  }

  SoftOrgan& organ() { return organ_; }
  const SurfacePtr& rest() const { return rest_; }
  ContactRenderer& renderer() { return renderer_; }
  const ContactPatch& seen() const { return *seen_; }

 private:
  struct Waiting {
    int due;
    std::unique_ptr<ContactPatch> patch;
  };

  static SoftSceneOptions made_one(SoftSceneOptions options) {
    options.organ.tool_radius_m = options.tool.radius_m;
    options.organ.solid.step_s = 1e-3 * options.period_ticks;
    return options;
  }

  void step(const Pose& X, bool lost) {
    organ_.step(renderer_.contacts(), &X.p);
    for (std::size_t v = 0; v < felt_.vertices.size(); ++v) {
      velocity_[v] = (organ_.felt()[v] - felt_.vertices[v]) / options_.organ.solid.step_s;
      felt_.vertices[v] = organ_.felt()[v];
    }
    extraction_.refit(velocity_);
    std::unique_ptr<ContactPatch> patch = spare_.empty() ? std::make_unique<ContactPatch>() : std::move(spare_.back());
    if (!spare_.empty()) spare_.pop_back();
    patch->clear();
    patch->reach_m = kPatchRadius;
    patch->stamp = ++stamp_;
    patch->topology = organ_.topology();
    extraction_.extract(X, tool_, *patch);
    patch->material[0] = {organ_.stiffness_n_per_m(), 0.5, options_.material.mu_static, options_.material.mu_dynamic};
    patch->glide_s = options_.organ.solid.step_s;
    patch->follows = stamp_ - 1;
    patch->given_j = organ_.given_j();
    enclose(*patch, patch->balls);
    if (lost)
      spare_.push_back(std::move(patch));
    else
      waiting_.push_back({tick_ + options_.delay_ticks, std::move(patch)});
  }

  SoftSceneOptions options_;
  ToolShape tool_;
  SurfacePtr rest_;
  SoftOrgan organ_;
  TriangleSurface felt_;
  std::vector<Vec3> velocity_;
  PatchExtraction extraction_;
  ContactRenderer renderer_;
  std::unique_ptr<ContactPatch> seen_ = std::make_unique<ContactPatch>();
  std::deque<Waiting> waiting_;
  std::vector<std::unique_ptr<ContactPatch>> spare_;
  std::uint64_t stamp_ = 0;
  int tick_ = 0;
};

/// A hand that holds the device: one mass, a spring to where it wants to be, damping, along z.
struct SoftHand {
  double mass_kg = 0.25, spring_n_per_m = 250, damping_n_s_per_m = 4;  ///< firm
  double z = 0, speed = 0;
  double out_j = 0, most_out_j = 0;  ///< what the contact has given to the hand, and the most of that at any time

  static SoftHand firm(double at) { return {0.25, 250, 4, at}; }
  static SoftHand light(double at) { return {0.12, 100, 0.7, at}; }

  /// 1 ms under a force that is held.
  void move(double wanted_z, double force_n) {
    constexpr int kParts = 100;
    for (int i = 0; i < kParts; ++i) {
      speed += 1e-3 / kParts * (spring_n_per_m * (wanted_z - z) - damping_n_s_per_m * speed + force_n) / mass_kg;
      z += 1e-3 / kParts * speed;
      out_j += 1e-3 / kParts * force_n * speed;
    }
    most_out_j = std::max(most_out_j, out_j);
  }
};

}  // namespace trocar::test
