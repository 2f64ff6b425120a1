// 64-bit hash over what a task computes, step by step: equal runs give equal hashes, and a difference in any step shows
// (up to the 2^-64 chance of a collision). The haptic and the tissue task keep one each, because live they do not run
// in one order; the hash of a run is that of the two. Not cryptographic. Mixing step of splitmix64 (Steele, Lea and
// Flood, OOPSLA 2014).
#pragma once

#include <bit>
#include <cstdint>
#include <string>

#include "haptics/exchange/contact_patch.h"
#include "haptics/exchange/tick_record.h"
#include "scenarios/director/director.h"
#include "tissue/tissue_frame.h"

namespace trocar {

class StateHash {
 public:
  StateHash() = default;
  /// A hash read from a recording, for printing.
  explicit StateHash(std::uint64_t value) : state_(value) {}

  void add(std::uint64_t word) {
    state_ ^= word + 0x9e3779b97f4a7c15u + (state_ << 6) + (state_ >> 2);
    state_ = (state_ ^ (state_ >> 30)) * 0xbf58476d1ce4e5b9u;
    state_ = (state_ ^ (state_ >> 27)) * 0x94d049bb133111ebu;
    state_ ^= state_ >> 31;
  }
  void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }
  template <typename Derived>
  void add(const Eigen::MatrixBase<Derived>& values) {
    for (Eigen::Index i = 0; i < values.size(); ++i) add(static_cast<double>(values.reshaped()[i]));
  }

  void add(const TickRecord& record);
  void add(const ContactPatch& patch);
  void add(const TissueFrame& frame);
  void add(const DirectorStatus& status);

  std::uint64_t value() const { return state_; }
  /// 16 hexadecimal digits.
  std::string hex() const;

 private:
  void add_marks(const TissueFrame& frame);
  void add_duct_marks(const TissueFrame& frame);
  void add_sheet_cuts(const TissueFrame& frame);
  void add_surgery(const SurgeryState& surgery);
  void add_suture(const SutureState& suture);
  void add_bites(const NeedleSight& needle);
  void add_clips_and_drops(const TissueFrame& frame);
  std::uint64_t state_ = 0;
};

}  // namespace trocar
