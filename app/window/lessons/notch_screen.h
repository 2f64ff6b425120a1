// The notch of the thesis (figure 3.40) as a page: three walls felt by the same loop, the force as an arrow at the tip,
// the engineer's panel beside it. Nothing is graded or kept. Thread: the window's.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "app/window/attempt/notch_run.h"
#include "app/window/device/device_panel.h"
#include "app/window/practice/screen.h"
#include "app/window/ui/ui.h"

namespace trocar {

inline constexpr double kArrow_m_per_n = 0.06, kLongestArrow_m = 0.05;

/// Walls, the tip's axes and the force arrow: what the renderer shows. Pure.
SceneView notch_view(const Scene& scene, const Notch& notch, const RunMoment& moment);

class NotchScreen final : public Screen {
 public:
  std::optional<ScreenName> frame(Ui& ui, PracticeModel& model, double dt_s) override;
  std::optional<ScreenName> handle(const InputEvent& event, PracticeModel& model) override;
  std::optional<Stage> stage(PracticeModel& model, int width, int height) override;
  void settle(PracticeModel& model, double wait_s) override;
  bool takes_escape() const override { return true; }

  /// Null: it has not begun, or could not.
  const NotchRun* run() const { return run_.get(); }

 private:
  void begin(PracticeModel& model);
  void steer(PracticeModel& model, double dt_s);
  std::string side(Ui& ui, PracticeModel& model, const Area& area);

  std::unique_ptr<NotchRun> run_;
  std::string wrong_;
  bool seen_ = false, steering_ = false, side_shown_ = true;
  Area picture_;
  Camera camera_;
  DevicePanel panel_;
};

}  // namespace trocar
