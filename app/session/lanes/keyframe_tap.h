// What the recorder gets of the tissue for playback: keyframes at their rate, one more wherever something changes that
// has no values in between, and every change of topology.
//
// Copies and allocates; neither locks nor waits. Thread: tissue task, after each of its steps.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "app/session/recording/tissue_keyframe.h"
#include "haptics/exchange/ring.h"
#include "tissue/world.h"

namespace trocar {

struct KeyframeRings {
  Ring<std::shared_ptr<TissueKeyframe>, 1024> keyframes;  ///< 50 s at 20 Hz; the recorder adds the instrument
  Ring<TopologyEvent, 1024> changes;
};

class KeyframeTap {
 public:
  /// @param rings of the recorder; nullptr: none. @param step_hz rate of the tissue task.
  KeyframeTap(KeyframeRings* rings, const KeyframeRule& rule, double step_hz);

  /// @param seen the state that the step saw.
  void tell(const StylusState& seen, const DirectorStatus& status, const World& world);

 private:
  /// What the last keyframe was made of.
  struct Last {
    StylusState seen;
    DirectorStatus status;
    TissueFrame tissue;
  };
  bool runs_on_from_last(const StylusState& seen, const DirectorStatus& status, const TissueFrame& tissue) const;

  KeyframeRings* rings_;
  KeyframeRule rule_;
  std::uint64_t every_;  ///< steps between two shapes
  std::uint64_t steps_ = 0;
  std::size_t changes_told_ = 0;
  std::optional<Last> last_;
  std::uint64_t topology_ = 0;  ///< of the last shape
};

}  // namespace trocar
