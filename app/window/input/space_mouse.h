// A SpaceMouse beside the window: read in a thread of its own, looked for again every two seconds.
//
// A missing library, a missing device or one without permission is silence, never an error. Thread: members from one
// thread.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "app/window/input/input_event.h"
#include "app/window/input/space_mouse_report.h"

namespace trocar {

/// Where reports come from. Called from the reader's thread only.
class SpaceMouseSource {
 public:
  virtual ~SpaceMouseSource() = default;
  /// Looks for a device. @return false: none.
  virtual bool open() = 0;
  /// Waits at most timeout_ms. @return bytes of a report, 0 none, negative: the device is gone.
  virtual int read(std::span<std::uint8_t> report, int timeout_ms) = 0;
  virtual void close() = 0;
};

/// hidapi, opened at run time; one that finds nothing when the library is missing.
std::unique_ptr<SpaceMouseSource> usb_space_mice();

class SpaceMouse {
 public:
  explicit SpaceMouse(std::unique_ptr<SpaceMouseSource> source = usb_space_mice(), int look_again_ms = 2000);
  ~SpaceMouse();
  bool present() const;
  /// Where it is now, as an event; nothing when it has not moved since it rested and was last asked. A device that is
  /// pulled out comes to rest.
  std::optional<InputEvent> newest();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace trocar
