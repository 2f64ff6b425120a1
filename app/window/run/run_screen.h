// T4, the run: scope's picture, head-up display, what the person's hand does to both, and the pause.
//
// Steering begins when the device is ready and goes on from where the instrument is. Events move the intent at once,
// held keys with the time between two frames; the moment is taken last before it is drawn. On the end the model takes
// the result and the debrief follows. Thread: the window's.
#pragma once

#include <memory>

#include "app/window/attempt/latency_meter.h"
#include "app/window/practice/screen.h"

namespace trocar {

class Tutorial;  // app/window/run/tutorial.h

class RunScreen final : public Screen {
 public:
  RunScreen();
  ~RunScreen() override;
  std::optional<ScreenName> frame(Ui& ui, PracticeModel& model, double dt_s) override;
  std::optional<ScreenName> handle(const InputEvent& event, PracticeModel& model) override;
  bool asks() const override;
  bool holds_pointer() const override;
  bool takes_escape() const override;  ///< while its box is up, which Esc closes
  std::optional<Stage> stage(PracticeModel& model, int width, int height) override;

  /// From events to the frames that show them, of the attempt that runs.
  const LatencyMeter& latency() const;
  const Tutorial* tutorial() const;  ///< nullptr: none runs

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace trocar
