// Grades every attempt of a record again from its recording, behind the desk's pages: when the desk begins, and
// whenever it is asked to. One thread, so that the desk stays quick. Thread: any may ask.
#pragma once

#include <functional>
#include <memory>

#include "trainees/desk/queries/recordings_checked.h"
#include "trainees/store/database.h"

namespace trocar {

class DeskRecordingCheck {
 public:
  /// @param open the record, for the thread that checks.
  explicit DeskRecordingCheck(std::function<Database()> open);
  /// Ends what is being checked.
  ~DeskRecordingCheck();
  DeskRecordingCheck(const DeskRecordingCheck&) = delete;
  DeskRecordingCheck& operator=(const DeskRecordingCheck&) = delete;

  /// Nothing when it is at work.
  void begin();
  review::RecordingsChecked state() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace trocar
