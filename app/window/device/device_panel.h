// F3: the engineer's panel of the thesis (figures 3.11, 3.12) over any screen with a run: numbers and the arm in two
// views.
//
// Refreshed ten times a second; F4 writes what it shows to a CSV file beside the person's data (C turns the wrist).
// Thread: the window's.
#pragma once

#include <filesystem>

#include "app/window/device/device_numbers.h"
#include "app/window/practice/practice_model.h"
#include "app/window/ui/ui.h"

namespace trocar {

/// Where the panel stands: at the left edge, at the right one for left-handed people, whose force bars are left.
Area device_panel_area(const Ui& ui, bool right);

class DevicePanel {
 public:
  static constexpr double kEvery_s = 0.1;

  bool open = false;
  /// Draws when open. @param record newest of the run.
  void frame(Ui& ui, PracticeModel& model, const TickRecord& record, const HapticLoopConfig& loop, double dt_s,
             const Area& area);
  /// What is shown now.
  const DeviceReading& reading() const { return reading_; }

 private:
  void draw(Ui& ui, const PracticeModel& model) const;
  void copy(PracticeModel& model) const;

  DeviceReading reading_;
  double age_s_ = kEvery_s;
};

/// Writes device_csv() to a new file of the folder. @return it. @throws EnvironmentError.
std::filesystem::path save_device_csv(const DeviceReading& reading, const std::filesystem::path& folder);

}  // namespace trocar
