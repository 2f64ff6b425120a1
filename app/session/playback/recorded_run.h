// A recording as a film: any moment of it, ready for pictures, plots and scrubbing.
//
// Where the recording has keyframes, moments are taken from them and nothing is run (recorded_moments.h). Else the loop
// is run again once from the recorded device input (the same code, the same bits), and moments are kept at the tissue
// rate (moment_store.h). A recording that was cut off is played up to where it ends; torn() says so. Frame T, SI.
// Thread: any may read, while a thread of the run's own goes on with it.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/session/run_moment.h"
#include "scenarios/scoring/attempt_result.h"

namespace trocar {

class RecordedRun {
 public:
  /// Whole when it returns, unless it was stopped. @param organ where the organ lies now, "" as recorded.
  /// @param progress share 0..1, returns false to stop; what was run until then stays. @throws InputError.
  RecordedRun(const std::filesystem::path& recording, const AssetRoots& assets, const std::string& organ = "",
              const std::function<bool(double)>& progress = {});
  /// Returns at once; everything happens in a thread of its own. What goes wrong is failure(), never an exception.
  static RecordedRun in_background(const std::filesystem::path& recording, const AssetRoots& assets,
                                   const std::string& organ = "");
  /// Gives up what runs.
  ~RecordedRun();
  RecordedRun(RecordedRun&&) noexcept;
  RecordedRun& operator=(RecordedRun&&) noexcept;

  enum class Stage : std::uint8_t {
    kLoading,    ///< nothing can be asked yet but this, torn() and failure()
    kReplaying,  ///< there are moments up to available_until(), everything else can be asked
    kWhole,
    kStopped,
    kFailed
  };
  Stage stage() const;
  /// There is at least one moment, and the scene: pictures can be made.
  bool has_pictures() const;
  std::string failure() const;  ///< why kFailed, else empty
  std::string torn() const;     ///< why the recording has no end, empty when it has one

  const Scene& scene() const;
  double begin_s() const;          ///< loop time of RUN's beginning; 0 when it never began
  double end_s() const;            ///< of the last tick
  double available_until() const;  ///< loop time up to which at() is exact
  /// The moment at or before t, as far as it has been run. A keyframe that cannot be decoded makes the run kFailed.
  RunMoment at(double t_s) const;
  const std::vector<Event>& events() const;
  const Grade& grade() const;
  /// It plays keyframes: nothing was run again, and there is no outcome().
  bool plays_keyframes() const;
  /// What the loop left when it was run again: ticks, hash, events. Only when kWhole.
  const SessionOutcome& outcome() const;
  /// Contact and grip force over loop time, N: lowest and highest in each of `columns` equal parts of from..to; 0 where
  /// there is none.
  struct Column {
    double low = 0, high = 0;
  };
  std::vector<Column> force_columns(int columns, double from_s, double to_s) const;
  std::vector<Column> grip_columns(int columns, double from_s, double to_s) const;
  std::size_t bytes() const;  ///< that moments and traces take

 private:
  struct State;
  explicit RecordedRun(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace trocar
