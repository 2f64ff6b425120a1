// How warm the motors of a real device are, from one attempt to the next and from one program to the next: a new
// attempt is no way round "no reset while it is hot".
//
// A file for each device, "BACKEND-CARD.json", in a folder of the machine's user: temperatures of winding and case by
// the model (motor_heat.h), and when that was, by the clock that runs since the machine was started (nobody sets it)
// and by the calendar's (for after a restart; one set back counts as no time passed). A missing file is a cold motor,
// as is one that cannot be read: then the amplifiers' own over-temperature outputs are what is left.
// Thread: any, one at a time.
#pragma once

#include <filesystem>
#include <string>

#include "haptics/control/motor_heat.h"

namespace trocar {

class MotorMemory {
 public:
  /// @param card as AttemptSetup has it.
  MotorMemory(const std::filesystem::path& folder, const std::string& backend, const std::string& card);

  const std::filesystem::path& file() const { return file_; }
  /// Cooled down since they were kept.
  MotorStates now() const;
  /// In place of what was kept. @throws EnvironmentError: cannot be written.
  void keep(const MotorStates& motors) const;

 private:
  std::filesystem::path file_;
};

/// Folder of the machine's user; one for temporary files where they have none.
std::filesystem::path motor_folder();

/// What a trainee must know before such motors may work: "" while none is at its warning temperature, else which is,
/// and how long it takes to cool.
std::string too_hot_to_begin(const MotorStates& motors);

}  // namespace trocar
