// Moments of a run in little room, each to the bit.
//
// A moment as it stands takes some 8 kB, of which most are places for objects and contacts that are not there: of the
// tissue frame only the words are kept in which it differs from an empty one. Beyond kMostMoments every second moment
// is dropped, and so are every second of those that follow: memory stays bounded however long a run is. Frame T, SI.
// Thread: one adds, any read at the same time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <vector>

#include "app/session/run_moment.h"

namespace trocar {

class MomentStore {
 public:
  static constexpr std::size_t kMostMoments = 36000;  ///< 6 min at the tissue rate

  explicit MomentStore(std::size_t most = kMostMoments) : most_(most) {}
  /// @param moment not earlier than the one before.
  void add(const RunMoment& moment);
  /// The newest at or before t; the first when t is before it. @throws std::out_of_range while there is none.
  RunMoment at(double t_s) const;
  std::size_t size() const;
  double first_s() const;  ///< 0 while there is none
  double last_s() const;
  std::size_t bytes() const;  ///< that it takes, nearly

 private:
  struct Kept {
    TickRecord record;
    DirectorStatus status;
    std::vector<std::uint64_t> tissue = {};  ///< runs of words: place << 32 | count, then they
    double t_s = 0;
    SurfacePtr organ_T = nullptr;
    std::vector<SurfacePtr> thin_T = {};
  };
  void thin();

  std::size_t most_;
  mutable std::mutex mutex_;
  std::deque<Kept> kept_;
  std::size_t step_ = 1, since_ = 0;
  double last_s_ = 0;
};

}  // namespace trocar
