// A small plot in a panel: axes with ticks and units, bands, a hatched limit, ranges per column, curves, marks by
// shape, a cursor.
//
//   Plot plot(ui, ui.drawing("force", 180), {x_axis, y_axis, "s", "Force at the tip, N"});
//   plot.band(0.4, 0.8, "wanted"); plot.limit(1.5, "limit"); plot.columns(...); plot.cursor(12.5); plot.labels();
//
// Labels are kept until labels() and then placed so that none lies over another. px of the window. Thread: the
// window's, within a frame.
#pragma once

#include <string>
#include <vector>

#include "app/window/attempt/force_trace.h"
#include "app/window/ui/plot_layout.h"

namespace trocar {

enum class PlotMark : std::uint8_t { kDisc, kRing, kDiamond, kTriangle };

struct PlotScales {
  Axis x = {}, y = {};
  std::string x_unit = {};  ///< behind the last tick
  std::string title = {};   ///< above the axes, with the unit of y
  bool x_labels = true;
  bool labels_left = false;  ///< of bands and lines: where the curve leaves room
  double left_px = 0;        ///< room for the ticks of y, so that plots below each other align; 0: as needed
};

class Plot {
 public:
  Plot(Ui& ui, const Area& area, const PlotScales& scales);

  const Area& inner() const { return inner_; }
  double x_px(double x) const;
  double y_px(double y) const;
  double x_at(double px) const;  ///< clamped to the axis
  int column_count() const;      ///< one a px

  void band(double low, double high, const std::string& label, Ink ink = Ink::kGood);
  void limit(double y, const std::string& label);  ///< hatched above
  void line(double y, const std::string& label, Ink ink, bool dashed);
  void rule(double x, const std::string& label, Ink ink);
  void columns(const std::vector<ForceTrace::Column>& columns, Ink ink);
  void curve(const std::vector<Ui::Point>& values, Ink ink, bool dashed = false);
  void mark(double x, double y, PlotMark mark, Ink ink);
  void cursor(double x, const std::string& label);
  void label(double x, double y, const std::string& text, Ink ink);
  /// Draws what was kept. Last.
  void labels();

  /// px that the ticks of an axis need on its left.
  static double left_room(const Ui& ui, const Axis& y);

 private:
  void draw_axes(const Area& area);
  void draw_x_ticks();
  double clamped_y(double y) const;
  double label_x() const;

  Ui& ui_;
  PlotScales scales_;
  Area inner_;
  struct Wish {
    std::string text;
    Ink ink;
    double x, y;
  };
  std::vector<Wish> wishes_;
};

/// One mark with its centre at x, y; radius px.
void paint_plot_mark(Ui& ui, PlotMark mark, double x, double y, double radius, Ink ink);

/// Ticks of y that fit a plot of that height, of x that fit that width when each label is so wide.
int y_ticks_for(const Ui& ui, double height_px);
int x_ticks_for(const Ui& ui, double width_px, double label_px);

}  // namespace trocar
