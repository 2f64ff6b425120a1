#include <algorithm>
#include <cmath>
#include <vector>

#include "app/studies/tissue/soft_bench.h"
#include "app/studies/tissue/soft_studies.h"
#include "tissue/interaction/suturing.h"

namespace trocar {
namespace {

constexpr double kTop = 0.035, kOver = 0.002;  // m, of the organ; of the circle's middle over it
constexpr double kTurn = 0.005;                // rad a step
constexpr double kPadsDeep = 0.002;            // m beyond the point that the jaws take

/// A driver that takes one stitch through the top of an ellipsoid: the needle turned about its own circle.
struct StitchRig {
  StitchRig(double thread_m, const NeedleTissueOptions& tissue, const SutureThreadOptions& thread)
      : rest(still_surface(ellipsoid_surface({0.06, 0.05, kTop}, 48))),
        organ(build_lattice(*rest, {}).lattice, rest, material, {}),
        setup{.X_TN = turned(0), .thread_m = thread_m, .thread = thread, .tissue = tissue},
        suturing(setup, organ) {
    jaws = from_above(turned(0) * setup.needle.place(0.3 * setup.needle.length_m) - 2 * kPadsDeep * Vec3::UnitZ());
    X_IN = jaws.inverse() * turned(0);
    suturing.load(jaws, X_IN);
  }

  static Pose from_above(const Vec3& tip) {
    Pose X;
    X.R.col(0) = Vec3::UnitX();
    X.R.col(1) = -Vec3::UnitY();
    X.R.col(2) = -Vec3::UnitZ();
    X.p = tip;
    return X;
  }
  static Pose turned(double angle) {
    Pose X;
    X.R.col(0) = Vec3::UnitX();
    X.R.col(1) = Vec3::UnitZ();
    X.R.col(2) = -Vec3::UnitY();
    X.R = Mat3(X.R * Eigen::AngleAxisd(angle, Vec3::UnitZ()).toRotationMatrix());
    X.p = Vec3(0, 0, kTop + kOver);
    return X;
  }
  void step(const Pose& X_TI, double opening_m) {
    HapticState state;
    state.stylus.X_TI = X_TI;
    state.stylus.jaw_opening_m = opening_m;
    std::vector<SoftSpring> springs;
    double from = thread_cpu_s();
    suturing.before(state, tool, true, organ, springs);
    cpu_s += thread_cpu_s() - from;
    organ.step({}, nullptr, springs);
    from = thread_cpu_s();
    suturing.after(state, tool, true, springs, organ);
    cpu_s += thread_cpu_s() - from;
    ++steps;
    jaws = X_TI;
    for (const SutureEvent& event : suturing.events()) all.push_back(event);
  }
  const SutureEvent* told(SutureEvent::Kind kind) const {
    const auto found = std::find_if(all.begin(), all.end(), [kind](const auto& e) { return e.kind == kind; });
    return found == all.end() ? nullptr : &*found;
  }
  void lift(double by_m, double opening_m, int count) {
    const Pose from = jaws;
    for (int i = 1; i <= count; ++i) step({from.R, from.p + by_m * i / count * Vec3::UnitZ()}, opening_m);
  }
  /// @param force of tissue on the needle, at every step of the way in
  void stitch(std::vector<double>* force = nullptr) {
    for (int i = 0; i <= 660; ++i) {
      step(turned(kTurn * i) * X_IN.inverse(), 0);
      if (force) force->push_back(suturing.needle().tissue_n());
    }
    step(jaws, 0.004);
    lift(0.03, 0.004, 30);
    const Pose at = from_above(suturing.needle().tip_T() - kPadsDeep * Vec3::UnitZ());
    for (int i = 0; i <= 10; ++i) step(at, 0.004 * (10 - i) / 10);
    const Pose taken = at.inverse() * suturing.needle().X_TN();
    const Vec3 middle = suturing.needle().X_TN().p, axis = suturing.needle().X_TN().R.col(2);
    for (int i = 0; i <= 700 && !told(SutureEvent::Kind::kStitch); ++i) {
      const Mat3 by = Eigen::AngleAxisd(kTurn * i, axis).toRotationMatrix();
      step(Pose{by * (at * taken).R, middle} * taken.inverse(), 0);
    }
  }
  double furthest_m() const {
    double most = 0;
    for (std::size_t v = 0; v < rest->vertices.size(); ++v)
      most = std::max(most, (organ.surface()->vertices[v] - rest->vertices[v]).norm());
    return most;
  }

  TissueSolid material;
  SurfacePtr rest;
  SoftOrgan organ;
  SutureSetup setup;
  Suturing suturing;
  Tool tool = make_tool(InstrumentKind::kGrasper);
  Pose jaws, X_IN;
  std::vector<SutureEvent> all;
  double cpu_s = 0;
  int steps = 0;
};

void add_ratio(StudyResult& study, const char* name, double value, double off, const char* bar, const char* words) {
  study.cases.push_back({name, "1", value, {}, bar, std::abs(value - 1) <= off, words});
}

void study_stitch(StudyResult& study) {
  StitchRig rig(0.06, {}, {});
  std::vector<double> force;
  rig.stitch(&force);
  StudyCurves curve{
      "stitch", "A half circle of 26 mm driven through liver", "turned by, rad", "N", {}, {{"force of tissue", {}}}};
  for (std::size_t i = 0; i < force.size(); i += 4) {
    curve.x.push_back(kTurn * static_cast<double>(i));
    curve.series[0].y.push_back(force[i]);
  }
  study.curves.push_back(std::move(curve));
  const double law = puncture_force(rig.material, rig.setup.needle, {});
  const auto force_of = [&](SutureEvent::Kind kind) { return rig.told(kind) ? rig.told(kind)->force_n : 0.0; };
  add_ratio(study, "force that opens the surface, over the law", force_of(SutureEvent::Kind::kPuncture) / law, 0.05,
            "0.95 to 1.05", "1.5 times J times the wire's width; 1.5 is unchecked.");
  add_ratio(study, "the same where the point comes out", force_of(SutureEvent::Kind::kExit) / law, 0.05, "0.95 to 1.05",
            "The second puncture.");
  study.cases.push_back({"stitches",
                         "1",
                         static_cast<double>(rig.suturing.counts().stitches),
                         {},
                         "1",
                         rig.suturing.counts().stitches == 1,
                         "The thread lies in both holes."});
  rig.lift(0.1, 0, 400);
  for (int i = 0; i < 500; ++i) rig.step(rig.jaws, 0);
  study.cases.push_back({"surface after the thread was drawn out",
                         "mm",
                         1e3 * rig.furthest_m(),
                         {},
                         "< 0.1",
                         rig.furthest_m() < 1e-4,
                         "Furthest vertex from its rest, 5 s later."});
}

void study_thread(StudyResult& study, bool quick) {
  StudyCurves curve{"friction", "A thread drawn through its stitch at 20 mm/s", "friction, N/m", "N", {}, {}};
  curve.series = {{"drawn", {}}, {"friction times the bridge", {}}};
  for (const double friction : quick ? std::vector<double>{20} : std::vector<double>{5, 20, 60}) {
    StitchRig rig(0.15, {}, {.friction_n_per_m = friction, .edge_friction = 0});
    rig.stitch();
    if (rig.suturing.thread().stitches().empty()) continue;
    double sum = 0;
    for (int i = 0; i < 300; ++i) {
      rig.lift(2e-4, 0, 1);
      if (i >= 200) sum += rig.suturing.needle().load_T().force.norm() / 100;
    }
    const double law = friction * rig.suturing.thread().stitches().back().bridge_m();
    curve.x.push_back(friction);
    curve.series[0].y.push_back(sum);
    curve.series[1].y.push_back(law);
    if (friction != 20) continue;
    add_ratio(study, "force on a thread drawn through, over friction times the bridge", sum / law, 0.25, "within 0.25",
              "Mean of the last second of three, 20 N/m.");
    study.cases.push_back({"needle and thread of 150 mm, a step",
                           "ms",
                           1e3 * rig.cpu_s / rig.steps,
                           {},
                           "<= 0.3",
                           rig.cpu_s / rig.steps <= 3e-4,
                           "Thread CPU time beside the organ's own step."});
  }
  study.curves.push_back(std::move(curve));
  StitchRig rig(0.15, {}, {.friction_n_per_m = 1000});
  rig.stitch();
  if (rig.suturing.thread().stitches().empty()) return;
  const double law = pull_out_force(rig.material, rig.suturing.thread().stitches().back().bridge_m(), rig.setup.tissue);
  double most = 0;
  for (int i = 0; i < 900 && !rig.told(SutureEvent::Kind::kPulledOut); ++i) {
    rig.lift(1e-4, 0, 1);
    if (!rig.suturing.thread().stitches().empty())
      most = std::max(most, rig.suturing.thread().stitches().back().load_n);
  }
  add_ratio(study, "load at which a stitch tears out, over the law", most / law, 0.05, "0.95 to 1.05",
            "Tear tension times the bridge, at most 4.62 N (human small bowel).");
}

}  // namespace

StudyResult suturing_study(const StudyRequest& request) {
  StudyResult study{"suturing", "none: a driver at prescribed places, tissue of 5 kPa", {}, {}};
  study_stitch(study);
  study_thread(study, request.quick);
  return study;
}

}  // namespace trocar
