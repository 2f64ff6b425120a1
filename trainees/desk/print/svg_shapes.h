// The desk's charts read back as shapes, so that a printed page draws the very picture that a screen shows: lines, not
// pixels.
//
// Reads what this program writes and nothing more: line, rect, circle, polyline, polygon, path of M L H V Z, text, g
// with translate, a; title and defs are passed over. A fill by pattern is hatched. Units: those of the viewBox, y down.
// Pure. Thread: any.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace trocar::printed {

using Colour = std::array<double, 3>;  ///< 0..1

struct Point {
  double x = 0, y = 0;
};

struct Shape {
  enum class Kind : std::uint8_t { kLines, kCircle, kText } kind = Kind::kLines;
  struct Run {
    std::vector<Point> points = {};
    bool closed = false;
  };
  std::vector<Run> runs = {};  ///< of kLines
  Point at = {};               ///< centre, or begin of the words' base line
  double radius = 0;
  std::string words = {}, anchor = "start";
  bool bold = false;
  std::optional<Colour> fill = {}, stroke = {};
  bool hatched = false;
  double fill_opacity = 1, stroke_opacity = 1, stroke_width = 1;
  std::vector<double> dash = {};
  bool round = false;
};

struct Drawing {
  double width = 0, height = 0, font_size = 14;
  std::vector<Shape> shapes = {};
};

/// @throws std::invalid_argument: an element, colour or path that is none of these.
Drawing read_svg(const std::string& svg);

/// The same chart without links, for a file by itself.
std::string without_links(const std::string& svg);

}  // namespace trocar::printed
