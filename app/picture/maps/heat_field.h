// Where the tip of an attempt was for how long, and how hard it pressed there: a field over space, from the trace.
//
//   time:   T(P) = sum of the tick periods while |tip - P| < r          s
//   force:  F(P) = largest |force| of ticks in contact with |tip - P| < r   virtual N
//
// r = kReach. Flat: distances are taken along the board (x, y) only. Ticks are gathered in cells of kCell first, at the
// mean place of each, so that borders are exact to a cell. Frame T, m. Thread: immutable once made.
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "scenarios/scoring/trace.h"

namespace trocar {

enum class HeatOf : std::uint8_t { kTime, kForce };

class HeatField {
 public:
  static constexpr double kReach = 0.003, kCell = 0.0005;  ///< m

  HeatField(const Trace& trace, HeatOf of, bool flat);
  double at(const Vec3& place_T) const;
  bool empty() const { return cells_.empty(); }
  std::size_t cells() const { return cells_.size(); }

 private:
  struct Cell {
    Vec3 sum_T = Vec3::Zero();
    double ticks = 0, value = 0;  ///< value: s, or N
  };
  using Key = std::array<std::int32_t, 3>;
  struct Hash {
    std::size_t operator()(const Key& key) const;
  };
  Key key_of(const Vec3& place_T, double size) const;

  HeatOf of_;
  bool flat_;
  std::vector<Cell> cells_;
  std::unordered_map<Key, std::vector<std::uint32_t>, Hash> near_;  ///< cells by blocks of kReach
};

}  // namespace trocar
