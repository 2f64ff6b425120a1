// What no page may do: cut a text, lay one over another, leave the window. For tests of screens.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "app/window/ui/ui.h"

namespace trocar::testing_support {

/// Lesser side of the common rectangle, px.
inline double common_side(const DrawnText& a, const DrawnText& b) {
  const double w = std::min(a.x + a.width, b.x + b.width) - std::max(a.x, b.x),
               h = std::min(a.y + a.height, b.y + b.height) - std::max(a.y, b.y);
  return w <= 0 || h <= 0 ? 0 : std::min(w, h);
}

inline void expect_laid_out(const std::vector<DrawnText>& texts, double width, double height,
                            const std::string& where) {
  EXPECT_FALSE(texts.empty()) << where;
  for (const DrawnText& t : texts) {
    EXPECT_FALSE(t.shortened) << where << ": cut: " << t.text;
    EXPECT_LE(t.width, t.room + 1.5) << where << ": wider than its room: " << t.text;
    EXPECT_GE(t.x, -0.5) << where << ": " << t.text;
    EXPECT_LE(t.x + t.width, width + 0.5) << where << ": out of the window: " << t.text;
    EXPECT_LE(t.y + t.height, height + 0.5) << where << ": below the window: " << t.text;
  }
  for (std::size_t i = 0; i < texts.size(); ++i) {
    for (std::size_t j = i + 1; j < texts.size(); ++j) {
      if (texts[i].in_front != texts[j].in_front || texts[i].ground != texts[j].ground)
        continue;  // a menu covers what it lies over
      EXPECT_LE(common_side(texts[i], texts[j]), 2.0)
          << where << ": '" << texts[i].text << "' lies over '" << texts[j].text << "'";
    }
  }
}

}  // namespace trocar::testing_support
