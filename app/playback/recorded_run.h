// A recording as a film: any moment of it, ready for pictures, plots and scrubbing.
//
// The loop is run again once from the recorded device input (the same code, the same bits); moments are kept at the tissue rate and the
// force trace at the loop's. Frame T, SI. Thread: the building one, then any for reading.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/run_moment.h"
#include "scenarios/scoring/attempt_result.h"

namespace trocar {

class RecordedRun {
 public:
  /// @param organ where the organ lies now, "" as recorded. @param progress share 0..1, returns false to stop. @throws InputError.
  RecordedRun(const std::filesystem::path& recording, const AssetRoots& assets, const std::string& organ = "",
              const std::function<bool(double)>& progress = {});
  ~RecordedRun();
  RecordedRun(RecordedRun&&) noexcept;

  const Scene& scene() const;
  double begin_s() const;                      ///< loop time of RUN's beginning
  double end_s() const;
  /// The moment at or before t. The reference stays.
  const RunMoment& at(double t_s) const;
  const std::vector<Event>& events() const;
  const Grade& grade() const;
  /// Contact and grip force over loop time, N: lowest and highest in each of `columns` equal parts of begin..end.
  struct Column { double low = 0, high = 0; };
  std::vector<Column> force_columns(int columns, double from_s, double to_s) const;
  std::vector<Column> grip_columns(int columns, double from_s, double to_s) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace trocar
