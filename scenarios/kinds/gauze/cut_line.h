// A closed line on gauze, the way in to it from the edge, and what cuts have made of them.
//
// The closed line is told by rays from its middle: a cut that crosses one has come past it there, and how far from the
// line. Of several cuts across one ray the one furthest off counts, so that a second one beside the first mends
// nothing. The area between cut and line is that of the sectors between r and R, (r^2 - R^2) / 2 each, exact for a cut
// that keeps its r within a sector. The way in is told by bars across it; a cut outside the closed line that lies along
// it is never off the line. A cut reaches a little beyond its ends: threads that stay between two of them hold nothing.
// Where gauze itself ends at a cut's end, and an older cut ended near there, the two have met: the mesh parts along its
// edges, up to half an edge from where the blades were.
//
// Frame G (gauze_rules.h), m. Deterministic. Thread: one; adding a cut does not allocate.
#pragma once

#include <Eigen/Core>
#include <array>

#include "scenarios/kinds/gauze/gauze_rules.h"

namespace trocar {

inline constexpr int kRays = 120, kMostBars = 40, kMostEnds = 256;

/// A place on the line and its direction.
struct LinePlace {
  Eigen::Vector2d at = Eigen::Vector2d::Zero(), along = Eigen::Vector2d::UnitX();
};

class CutLine {
 public:
  CutLine(const GauzeLine& line, double off_m);

  /// What one cut added: to the area beside the line, as a share of what the line encloses; to the length outside, as a
  /// share of the line's; and how far from the line it lies at most.
  struct Added {
    double area_share = 0, outside_share = 0, off_m = 0;
  };
  Added add(const Eigen::Vector2d& from, const Eigen::Vector2d& to, bool from_rim = false, bool to_rim = false);

  double way_in_m() const { return line_.way_in_m; }
  double round_m() const { return round_m_; }
  /// From the gauze's edge along the way in, then round. @param arc_m 0 .. way_in_m() + round_m()
  LinePlace at(double arc_m) const;
  /// Has the line been cut past there?
  bool cut_at(double arc_m) const;
  /// Nearest of what is still to be cut, from the edge on; the whole: nothing is left.
  double uncut_from_m() const;
  bool closed() const { return uncut_from_m() >= way_in_m() + round_m(); }

 private:
  void cross_rays(const Eigen::Vector2d& a, const Eigen::Vector2d& b, Added& added, bool only_uncut = false);
  /// From older cuts' ends that are near this one, where gauze ends.
  void meet(const Eigen::Vector2d& end, Added& added);
  double radius(double turn_rad) const;
  Eigen::Vector2d on_line(double turn_rad) const;
  bool on_way_in(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const;
  double off(const Eigen::Vector2d& place) const;

  GauzeLine line_;
  double off_m_, round_m_ = 0, area_m2_ = 0;
  int bars_ = 0;
  std::array<double, kRays> arc_{};     ///< from where the way in meets the line to each ray
  std::array<double, kRays> r2_off_{};  ///< largest |r^2 - R^2| of the cuts across it
  std::array<bool, kRays> crossed_{};
  std::array<bool, kMostBars> passed_{};
  std::array<Eigen::Vector2d, kMostEnds> ends_{};  ///< of the cuts off the way in, the first of them
  int end_count_ = 0;
};

}  // namespace trocar
