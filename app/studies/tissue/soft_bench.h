// A probe on an organ that gives way, without device and session: the loop's contact at 1 kHz, the tissue at its own
// rate, patches seen late. For studies and benchmarks.
//
// The organ is an ellipsoid of 200 x 150 x 80 mm on its bed, the probe's axis along -z of T, its tip above the organ's
// top. Frame T, SI. Thread: any.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "haptics/contact/contact_renderer.h"
#include "tissue/collision/patch_extraction.h"
#include "tissue/solid/soft_organ.h"

namespace trocar {

/// How the loop gets force from tissue that is solved more slowly than it runs.
enum class RateBridge : std::uint8_t {
  kGliding,  ///< ours: surface without its dent, glided into
  kHeld,     ///< the force of the last step, held
  kSpring,   ///< the force of the last step and a virtual coupling about the tool's place of it
  kThesis,   ///< nearest point of the deformed surface, held, at the sub-cell stiffness
};

struct SoftBenchSetup {
  TissueSolid material;
  SoftOrganOptions organ;
  RateBridge bridge = RateBridge::kGliding;
  int patch_delay = 5;            ///< ticks from a tissue step to the tick that first sees its patch
  double coupling_n_per_m = 250;  ///< of kSpring
  int rows = 60;                  ///< of triangles from pole to pole
};

/// CPU time of this thread so far.
double thread_cpu_s();

/// Ellipsoid about the origin with rings of triangles. @param half_m half axes
TriangleSurface ellipsoid_surface(const Vec3& half_m, int rows);

/// What becomes of the tissue's step, where one is due.
struct TissueNews {
  bool stalled = false;  ///< it is not made
  bool lost = false;     ///< its patch never arrives
  int delay = -1;        ///< ticks to the one that sees its patch, at most a period; -1: as set up
};

class SoftBench {
 public:
  explicit SoftBench(const SoftBenchSetup& setup);

  /// One tick. @param tip_T centre of the tip's sphere. @return force on the tool
  Vec3 tick(const Vec3& tip_T, const Vec3& velocity_T);
  /// One tick of ours with the tool in any pose.
  ContactResult tick(const Pose& X_TI, const Twist& V_TI_T, const TissueNews& news);
  /// Of the dent in the patch that the loop sees, N/m.
  double seen_stiffness() const { return seen_->material[0].stiffness_n_per_m; }

  /// Cuts the organ; the next step feels it. @return false: refused
  bool cut(const Blade& blade);

  /// Centre of the tip when it just touches at this place of the top.
  Vec3 touching(double x_m, double y_m) const;
  double tissue_force_n() const { return organ_.force_n(); }
  const SoftOrgan& organ() const { return organ_; }
  double tissue_cpu_s() const { return tissue_cpu_s_; }  ///< of all steps so far
  int tissue_steps() const { return steps_; }

 private:
  void step_tissue(const Pose& X_TI);
  void receive();
  Vec3 bridged(const ContactResult& contact, const Vec3& tip_T) const;

  SoftBenchSetup setup_;
  ToolShape tool_;
  SurfacePtr rest_;
  SoftOrgan organ_;
  TriangleSurface felt_;
  std::vector<Vec3> velocity_;
  std::optional<PatchExtraction> extraction_;
  ContactRenderer renderer_;
  std::unique_ptr<ContactPatch> seen_ = std::make_unique<ContactPatch>(), made_ = std::make_unique<ContactPatch>();
  Vec3 solved_force_ = Vec3::Zero(), solved_tip_ = Vec3::Zero();  ///< of the patch that is seen
  Vec3 made_force_ = Vec3::Zero(), made_tip_ = Vec3::Zero();
  std::uint64_t tick_ = 0, stamp_ = 0;
  std::int64_t due_ = -1;  ///< tick at which the loop sees the patch that was made last; -1: never
  double tissue_cpu_s_ = 0;
  int steps_ = 0, period_;
};

/// A hand that pulls a point mass through a spring, on the bench along z.
struct SoftHand {
  const char* name;
  double mass_kg, stiffness_n_per_m, damping_n_s_per_m;
};
inline constexpr SoftHand kFirmHand{"firm", 0.25, 250, 4}, kLightHand{"light", 0.12, 100, 0.7};

struct PressMeasures {
  double hold_n = 0;        ///< mean force in the last second of the hold
  double tissue_n = 0;      ///< that of the solid then
  double ripple_n = 0;      ///< most that the force is off its mean then
  double most_step_n = 0;   ///< in a millisecond, over the whole
  double energy_out_j = 0;  ///< most that the hand has got back beyond what it put in
};

/// Presses `depth_m` deep in a second, holds for two, moves by 4 mm at 2 Hz for two.
PressMeasures press(const SoftBenchSetup& setup, const SoftHand& hand, double depth_m);

}  // namespace trocar
