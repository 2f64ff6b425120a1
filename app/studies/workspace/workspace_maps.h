// Sections through the reachable region as SVG: the sets laid over each other, or a quality by colour.
//
// Three planes of W': x' = 0, y' = 0 and z' = -200 mm (at the height of the hand). Colours run from dark to bright, so
// they are read in grey as well. Thread: any.
#pragma once

#include <functional>
#include <string>

#include "app/studies/workspace/workspace_grid.h"

namespace trocar {

/// How a quality is shown: values at or under `low` take the darkest level, at or over `high` the brightest.
struct MapScale {
  std::string title, unit;
  double low = 0, high = 1;
  int decimals = 1;
};

/// Sets as shades: limits, ring, clear of the links, clear and within the rules.
std::string set_sections(const WorkspaceGrid& grid);

/// A quality over the cells of limits_clear, with a black line round rules_clear. @param value of a cell.
std::string value_sections(const WorkspaceGrid& grid, const MapScale& scale,
                           const std::function<double(const ReachCell&)>& value);

/// The region clear of the links in space, a quarter cut away, the device at home in it. A coarse grid keeps it small.
std::string workspace_picture(const WorkspaceGrid& grid);

}  // namespace trocar
