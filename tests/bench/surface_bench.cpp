// Bars of contact on surfaces that deform: the step of the tick <= 5 us at 50k triangles and at 500k no more than twice
// that at 5k; a refit no slower than Embree's. Ours, Embree's and FCL's in one run on the same surfaces and poses, one
// thread each.
//
// An organ of 220 x 160 x 120 mm all of whose vertices move in every tissue step (every 10th tick); a probe pressed
// 3 mm deep is dragged over it at 30 mm/s with friction. "Finer": the same organ at every size, so at 500k triangles
// ten times as many as at 50k lie within the same reach. "Larger": triangles of the same size, so that the organ grows.
// Every figure is of the least of some passes over the same steps: what the work itself costs, without what else the
// machine did. Wall clock; its own 0.03 us are in every figure.
//
//   bench_surface [passes]        default 5; FCL is measured at the first few steps only
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <embree3/rtcore.h>
#include <fcl/fcl.h>

#include "haptics/contact/contact_renderer.h"
#include "haptics/contact/segment_triangle.h"
#include "haptics/least_turn.h"
#include "tissue/collision/patch_extraction.h"

namespace {

using namespace trocar;

constexpr int kSteps = 150, kTicks = 10;        // tissue steps of a pass, ticks of one
constexpr int kDescent = 200;                   // ticks from 3 mm above down to the depth
constexpr int kRefits = 25;                     // tissue steps that the peers' refits are timed at
constexpr int kFclSteps = 3;                    // its refit takes seconds at 500k
constexpr double kTick = 1e-3, kSpeed = 0.03;   // s, m/s
constexpr double kDepth = 0.003, kNear = 0.03;  // m; of the shaft what the peers' queries cover
const Vec3 kHalf(0.11, 0.08, 0.06);             // m, half axes of the organ of 50k triangles
constexpr double kFriction = 0.3, kSliding = 0.2;

double now_us() {
  return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Times of the same steps in several passes: of each step the least.
class Times {
 public:
  template <class Work>
  void time(std::size_t step, Work&& work) {
    const double start = now_us();
    work();
    const double us = now_us() - start;
    if (step >= least_.size()) least_.resize(step + 1, std::numeric_limits<double>::infinity());
    least_[step] = std::min(least_[step], us);
  }
  double share(double part) const {
    std::vector<double> sorted(least_);
    std::sort(sorted.begin(), sorted.end());
    return sorted.empty() ? 0
                          : sorted[std::min(sorted.size() - 1,
                                            static_cast<std::size_t>(part * static_cast<double>(sorted.size())))];
  }
  double median() const { return share(0.5); }

 private:
  std::vector<double> least_;
};

/// A closed body of 8 n^2 triangles; the same shape and motion at any n.
class Organ {
 public:
  Organ(int triangles, double scale) : half_(scale * kHalf), moves_(0.1 * half_.z()) {
    const int n = static_cast<int>(std::lround(std::sqrt(triangles / 8.0)));
    for (int face = 0; face < 8; ++face) add_face(face, n);
    surface.vertices.resize(direction_.size());
    velocity.resize(direction_.size());
    for (const Vec3& d : direction_) {
      still_.push_back(at_rest(d));
      swell_.push_back(swell(d));
      bend_.push_back(bend(d));
    }
    move(0);
  }

  void move(double t_s) {
    const auto [s, b] = shares(t_s);
    const auto [ds, db] = shares(t_s + kTick * kTicks);
    for (std::size_t v = 0; v < still_.size(); ++v) {
      surface.vertices[v] = still_[v] + s * swell_[v] + b * bend_[v];
      velocity[v] = ((ds - s) * swell_[v] + (db - b) * bend_[v]) / (kTick * kTicks);
    }
  }

  /// The probe's pose after a way of its tip over the surface, pressed in by kDepth less `lift_m`, its shaft leaning.
  Pose pressed(double way_m, double t_s, double lift_m = 0) const {
    const double angle = way_m / half_.x();
    const auto direction = [&](double along, double across) {
      return Vec3(std::sin(angle + along), 0.25 + across, std::cos(angle + along)).normalized();
    };
    const Vec3 p = place(direction(0, 0), t_s);
    const Vec3 along = place(direction(1e-4, 0), t_s) - p, across = place(direction(0, 1e-4), t_s) - p;
    const Vec3 normal = along.cross(across).dot(p) > 0 ? along.cross(across).normalized().eval()
                                                       : across.cross(along).normalized().eval();
    const Mat3 R = least_turn(Vec3::UnitZ(), -normal).toRotationMatrix() *
                   Eigen::AngleAxisd(0.5, Vec3::UnitY()).toRotationMatrix();
    return {R, p + normal * (ToolShape{}.radius_m - kDepth + lift_m)};
  }

  TriangleSurface surface;
  std::vector<Vec3> velocity;

 private:
  void add_face(int face, int n) {
    const Vec3 a(face & 1 ? -1 : 1, 0, 0), b(0, face & 2 ? -1 : 1, 0), c(0, 0, face & 4 ? -1 : 1);
    const bool flipped = a.cross(b).dot(c) < 0;
    const auto first = static_cast<std::int32_t>(direction_.size());
    const auto index = [&](int i, int j) { return first + i * (n + 1) - i * (i - 1) / 2 + j; };
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= n - i; ++j) direction_.push_back(Vec3(a * (n - i - j) + b * i + c * j).normalized());
    const auto add = [&](std::int32_t u, std::int32_t v, std::int32_t w) {
      surface.triangles.push_back({u, flipped ? w : v, flipped ? v : w});
    };
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n - i; ++j) {
        add(index(i, j), index(i + 1, j), index(i, j + 1));
        if (i + j < n - 1) add(index(i + 1, j), index(i + 1, j + 1), index(i, j + 1));
      }
  }
  static std::pair<double, double> shares(double t_s) { return {std::sin(4 * t_s), std::sin(2.7 * t_s + 1)}; }
  Vec3 at_rest(const Vec3& d) const {
    return (1 + 0.06 * std::sin(5 * d.x()) * std::cos(4 * d.y() + d.z())) * half_.cwiseProduct(d);
  }
  Vec3 swell(const Vec3& d) const { return moves_ * std::sin(3 * d.x() + 2 * d.y()) * d; }
  Vec3 bend(const Vec3& d) const { return moves_ * Vec3(d.z() * d.z(), d.x() * d.z(), d.x() * d.x()); }
  Vec3 place(const Vec3& d, double t_s) const {
    const auto [s, b] = shares(t_s);
    return at_rest(d) + s * swell(d) + b * bend(d);
  }

  Vec3 half_;
  double moves_;
  std::vector<Vec3> direction_, still_, swell_, bend_;
};

/// The same surface in Embree. Its vertices are floats: they are brought there before the commit, outside its time.
class EmbreeSurface {
 public:
  enum class Update { kRefit, kRebuild };

  EmbreeSurface(const TriangleSurface& surface, Update update)
      : surface_(surface),
        device_(rtcNewDevice("threads=1,user_threads=1")),
        scene_(rtcNewScene(device_)),
        geometry_(rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE)) {
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_DYNAMIC);
    rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_LOW);
    rtcSetGeometryBuildQuality(geometry_, update == Update::kRefit ? RTC_BUILD_QUALITY_REFIT : RTC_BUILD_QUALITY_LOW);
    vertex_ = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry_, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 16, surface.vertices.size()));
    auto* index = static_cast<unsigned*>(
        rtcSetNewGeometryBuffer(geometry_, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, surface.triangles.size()));
    for (const auto& triangle : surface.triangles)
      for (const std::int32_t v : triangle) *index++ = static_cast<unsigned>(v);
    bring();
    rtcCommitGeometry(geometry_);
    rtcAttachGeometry(scene_, geometry_);
    rtcCommitScene(scene_);
  }
  EmbreeSurface(const EmbreeSurface&) = delete;
  EmbreeSurface& operator=(const EmbreeSurface&) = delete;
  ~EmbreeSurface() {
    rtcReleaseGeometry(geometry_);
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }

  void bring() {
    float* to = vertex_;
    for (const Vec3& v : surface_.vertices) {
      to[0] = static_cast<float>(v.x());
      to[1] = static_cast<float>(v.y());
      to[2] = static_cast<float>(v.z());
      to += 4;
    }
  }
  void commit() {
    rtcUpdateGeometryBuffer(geometry_, RTC_BUFFER_TYPE_VERTEX, 0);
    rtcCommitGeometry(geometry_);
    rtcCommitScene(scene_);
  }

  /// Distance of the surface from the axis; a point query about its middle that shrinks as nearer triangles are found.
  double nearest(const QuerySegment& axis) const {
    Search search{this, axis, (axis.b - axis.a).norm() / 2, std::numeric_limits<double>::infinity()};
    RTCPointQuery query;
    const Vec3 middle = (axis.a + axis.b) / 2;
    query.x = static_cast<float>(middle.x());
    query.y = static_cast<float>(middle.y());
    query.z = static_cast<float>(middle.z());
    query.time = 0;
    query.radius = static_cast<float>(search.half + kPatchRadius);
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(scene_, &query, &context, &EmbreeSurface::look, &search);
    return search.distance;
  }

 private:
  struct Search {
    const EmbreeSurface* of;
    QuerySegment axis;
    double half, distance;
  };
  static bool look(RTCPointQueryFunctionArguments* args) {
    Search& search = *static_cast<Search*>(args->userPtr);
    const auto& surface = search.of->surface_;
    const auto& [a, b, c] = surface.triangles[args->primID];
    const double distance = closest_segment_triangle(search.axis.a, search.axis.b,
                                                     {surface.vertices[static_cast<std::size_t>(a)],
                                                      surface.vertices[static_cast<std::size_t>(b)],
                                                      surface.vertices[static_cast<std::size_t>(c)]})
                                .distance;
    if (distance >= search.distance) return false;
    search.distance = distance;
    args->query->radius = static_cast<float>(search.half + distance);
    return true;
  }

  const TriangleSurface& surface_;
  RTCDevice device_;
  RTCScene scene_;
  RTCGeometry geometry_;
  float* vertex_;
};

/// The same in FCL: OBBRSS, the type whose queries are quick. Refitted from the bottom up, which is its default, its
/// answers are wrong: from the top down.
class FclSurface {
 public:
  explicit FclSurface(const TriangleSurface& surface)
      : surface_(surface), model_(std::make_shared<fcl::BVHModel<fcl::OBBRSSd>>()) {
    std::vector<fcl::Triangle> triangles;
    for (const auto& [a, b, c] : surface.triangles)
      triangles.emplace_back(static_cast<std::size_t>(a), static_cast<std::size_t>(b), static_cast<std::size_t>(c));
    model_->beginModel();
    model_->addSubModel(surface.vertices, triangles);
    model_->endModel();
  }
  void refit() {
    model_->beginReplaceModel();
    model_->replaceSubModel(surface_.vertices);
    model_->endReplaceModel(true, false);
  }
  double distance(const QuerySegment& axis, double radius) const {
    const auto [capsule, X] = placed(axis, radius);
    fcl::DistanceResultd result;
    return fcl::distance(model_.get(), fcl::Transform3d::Identity(), &capsule, X, fcl::DistanceRequestd(true), result);
  }
  std::size_t contacts(const QuerySegment& axis, double radius) const {
    const auto [capsule, X] = placed(axis, radius);
    fcl::CollisionResultd result;
    return fcl::collide(model_.get(), fcl::Transform3d::Identity(), &capsule, X, fcl::CollisionRequestd(64, true),
                        result);
  }

 private:
  static std::pair<fcl::Capsuled, fcl::Transform3d> placed(const QuerySegment& axis, double radius) {
    fcl::Transform3d X = fcl::Transform3d::Identity();
    X.linear() = least_turn(Vec3::UnitZ(), axis.b - axis.a).toRotationMatrix();
    X.translation() = (axis.a + axis.b) / 2;
    return {fcl::Capsuled(radius, (axis.b - axis.a).norm()), X};
  }

  const TriangleSurface& surface_;
  std::shared_ptr<fcl::BVHModel<fcl::OBBRSSd>> model_;
};

/// What the peers are asked about: the foremost part of the shaft, where ours looks at the whole.
QuerySegment foremost(const Pose& X) { return {X.p, X.p - X.R.col(2) * kNear}; }

struct Row {
  int triangles = 0, patch = 0;
  double reach_mm = 0, measured = 0, felt = 0;
  Times refit, extraction, gliding, still;
  Times brought, embree_refit, embree_build, embree_point, embree_query;
  Times fcl_refit, fcl_distance, fcl_collide;
};

double time_of(int step, int tick) { return kTick * (kTicks * step + tick); }

template <class OnStep, class OnTick>
void drag(Organ& organ, int steps, OnStep&& on_step, OnTick&& on_tick) {
  for (int step = 0; step < steps; ++step) {
    // The patch says where the surface is at the step's end, and the ticks press on where it is on its way there.
    organ.move(time_of(step, 0));
    on_step(static_cast<std::size_t>(step), organ.pressed(kSpeed * time_of(step, 0), time_of(step, 0)));
    for (int tick = 0; tick < kTicks; ++tick) {
      const double t = time_of(step, tick);
      on_tick(static_cast<std::size_t>(kTicks * step + tick), organ.pressed(kSpeed * t, t - kTick * kTicks));
    }
  }
}

void ours(Organ& organ, PatchExtraction& extraction, bool gliding, Row& row) {
  const auto patch = std::make_unique<ContactPatch>();
  patch->material[0].mu_static = kFriction;
  patch->material[0].mu_dynamic = kSliding;
  ContactRenderer renderer(ContactLaw::kProxy);
  Times& steps = gliding ? row.gliding : row.still;
  const auto velocity = gliding ? std::span<const Vec3>(organ.velocity) : std::span<const Vec3>();
  const auto hand_over = [&](const Pose& X) {
    extraction.extract(X, {}, *patch);
    patch->follows = patch->stamp;
    ++patch->stamp;
    patch->glide_s = gliding ? kTick * kTicks : 0;
    enclose(*patch, patch->balls);
  };
  organ.move(0);
  extraction.refit();
  for (int tick = 0; tick < kDescent; ++tick) {
    const Pose X = organ.pressed(0, 0, kSpeed * kTick * (kDescent - tick));
    if (tick % kTicks == 0) hand_over(X);
    renderer.update(X, {}, *patch);
  }
  renderer.take_work();
  double felt = 0, ticks = 0;
  drag(
      organ, kSteps,
      [&](std::size_t step, const Pose& X) {
        row.refit.time(step, [&] { extraction.refit(velocity); });
        row.extraction.time(step, [&] { hand_over(X); });
      },
      [&](std::size_t tick, const Pose& X) {
        ContactResult result;
        steps.time(tick, [&] { result = renderer.update(X, {}, *patch); });
        felt += result.contact && result.depth_m < 2 * kDepth && result.normal_T.dot(X.R.col(2)) < 0;
        ++ticks;
      });
  row.felt = felt / ticks;
  row.patch = patch->count;
  row.reach_mm = patch->reach_m * 1e3;
  row.measured = renderer.take_work().measured / ticks;
}

void peers(Organ& organ, Row& row) {
  EmbreeSurface refitted(organ.surface, EmbreeSurface::Update::kRefit),
      rebuilt(organ.surface, EmbreeSurface::Update::kRebuild);
  double sink = 0;
  drag(
      organ, kRefits,
      [&](std::size_t step, const Pose&) {
        row.brought.time(step, [&] { refitted.bring(); });
        row.embree_refit.time(step, [&] { refitted.commit(); });
        rebuilt.bring();
        if (step < 5) row.embree_build.time(step, [&] { rebuilt.commit(); });
      },
      [&](std::size_t tick, const Pose& X) {
        row.embree_point.time(tick, [&] { sink += refitted.nearest({X.p, X.p}); });
        row.embree_query.time(tick, [&] { sink += refitted.nearest(foremost(X)); });
      });
  if (sink < 0) std::puts("");
}

void fcl_alone(Organ& organ, Row& row) {
  FclSurface model(organ.surface);
  double sink = 0;
  const double radius = ToolShape{}.radius_m;
  drag(
      organ, kFclSteps, [&](std::size_t step, const Pose&) { row.fcl_refit.time(step, [&] { model.refit(); }); },
      [&](std::size_t tick, const Pose& X) {
        row.fcl_collide.time(tick, [&] { sink += static_cast<double>(model.contacts(foremost(X), radius)); });
        // Once it touches FCL gives no distance: from 1 mm above the surface.
        const Pose away{X.R, X.p - X.R.col(2) * (kDepth + 1e-3)};
        row.fcl_distance.time(tick, [&] { sink += model.distance(foremost(away), radius); });
      });
  if (sink < 0) std::puts("");
}

Row measure(int triangles, double scale, int passes, bool with_peers) {
  Organ organ(triangles, scale);
  Row row;
  row.triangles = static_cast<int>(organ.surface.triangles.size());
  PatchExtraction extraction(organ.surface);
  for (int pass = 0; pass < passes; ++pass) {
    ours(organ, extraction, true, row);
    ours(organ, extraction, false, row);
    if (with_peers) peers(organ, row);
  }
  if (with_peers) fcl_alone(organ, row);
  return row;
}

void print(const char* reading, const std::vector<Row>& rows) {
  std::printf("\n%s: us, median and p99.9\n%-34s", reading, "");
  for (const Row& row : rows) std::printf("%20d", row.triangles);
  const auto line = [&](const char* what, const Times Row::*times) {
    std::printf("\n%-34s", what);
    for (const Row& row : rows)
      if ((row.*times).median() > 0)
        std::printf("%10.2f%10.2f", (row.*times).median(), (row.*times).share(0.999));
      else
        std::printf("%20s", "-");
  };
  line("contact step, gliding", &Row::gliding);
  line("contact step, still between", &Row::still);
  line("patch", &Row::extraction);
  line("Embree nearest to tip", &Row::embree_point);
  line("Embree nearest to capsule", &Row::embree_query);
  line("FCL collide capsule, 64", &Row::fcl_collide);
  line("FCL distance capsule", &Row::fcl_distance);
  line("refit", &Row::refit);
  line("Embree refit", &Row::embree_refit);
  line("  its vertices as floats", &Row::brought);
  line("Embree rebuild", &Row::embree_build);
  line("FCL refit", &Row::fcl_refit);
  std::printf("\n%-34s", "felt, measured a tick, patch, reach");
  for (const Row& row : rows)
    std::printf("%5.0f%%%5.1f%4d%5.1f", 100 * row.felt, row.measured, row.patch, row.reach_mm);
  const auto ratio = [&](const Times Row::*times) {
    return (rows.back().*times).median() / (rows.front().*times).median();
  };
  std::printf("\nlargest over smallest: step gliding %.2f, still %.2f, patch %.2f\n", ratio(&Row::gliding),
              ratio(&Row::still), ratio(&Row::extraction));
}

}  // namespace

int main(int argc, char** argv) {
  const int passes = argc > 1 ? std::max(1, std::atoi(argv[1])) : 5;
  std::vector<Row> finer, larger;
  for (const int triangles : {5000, 50000, 500000}) {
    finer.push_back(measure(triangles, 1, passes, true));
    larger.push_back(measure(triangles, std::sqrt(triangles / 50000.0), passes, false));
  }
  print("the same organ, finer triangles", finer);
  print("a larger organ, triangles of the same size", larger);
}
