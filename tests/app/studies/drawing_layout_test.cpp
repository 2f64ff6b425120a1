// Layout of everything that the device studies draw: every word lies on the page, and no two words lie on each other.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <regex>
#include <string>
#include <vector>

#include "app/device_bench/device_drawing.h"
#include "app/studies/device/kinematics_study.h"
#include "app/studies/device/motor_study.h"
#include "app/studies/study_files.h"
#include "app/studies/workspace/workspace_study.h"
#include "haptics/kinematics/device_geometry.h"

namespace trocar::drawing_layout_test {
namespace {

struct Word {
  std::string text;
  double left, right, top, bottom;
};

double attribute(const std::string& tag, const std::string& name, double otherwise) {
  std::smatch match;
  return std::regex_search(tag, match, std::regex(" " + name + "=\"([-0-9.]+)\"")) ? std::stod(match[1]) : otherwise;
}

std::string plain(std::string text) {
  for (const auto& [code, letter] : {std::pair("&#39;", "'"), std::pair("&lt;", "<"), std::pair("&gt;", ">"),
                                     std::pair("&amp;", "&"), std::pair("&quot;", "\"")}) {
    for (std::size_t at = text.find(code); at != std::string::npos; at = text.find(code)) {
      text.replace(at, std::string(code).size(), letter);
    }
  }
  return text;
}

/// Boxes of all words: a letter of a common sans-serif is about 0.54 of its size wide on average. Words turned upright
/// are turned with their boxes.
std::vector<Word> words_of(const std::string& svg) {
  static const std::regex text("<text([^>]*)>([^<]*)</text>");
  std::vector<Word> words;
  for (std::sregex_iterator it(svg.begin(), svg.end(), text), end; it != end; ++it) {
    const std::string tag = (*it)[1], label = plain((*it)[2]);
    const double size = attribute(tag, "font-size", 12), width = 0.54 * size * static_cast<double>(label.size());
    const double x = attribute(tag, "x", 0), y = attribute(tag, "y", 0);
    const bool middle = tag.find("\"middle\"") != std::string::npos, ends = tag.find("\"end\"") != std::string::npos;
    const double left = -(middle ? 0.5 : ends ? 1.0 : 0.0) * width;
    if (tag.find("rotate(-90") != std::string::npos) {
      words.push_back({label, x - 0.75 * size, x + 0.2 * size, y - left - width, y - left});
    } else {
      words.push_back({label, x + left, x + left + width, y - 0.75 * size, y + 0.2 * size});
    }
  }
  return words;
}

void expect_clean_layout(const std::string& name, const std::string& svg) {
  const double width = attribute(svg.substr(0, 400), "width", 0), height = attribute(svg.substr(0, 400), "height", 0);
  ASSERT_GT(width, 100) << name;
  const std::vector<Word> words = words_of(svg);
  EXPECT_GT(words.size(), 3u) << name;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const Word& a = words[i];
    EXPECT_GE(a.left, -1) << name << ": \"" << a.text << "\" leaves the page";
    EXPECT_LE(a.right, width + 1) << name << ": \"" << a.text << "\" leaves the page";
    EXPECT_GE(a.top, -1) << name << ": \"" << a.text << "\"";
    EXPECT_LE(a.bottom, height + 1) << name << ": \"" << a.text << "\"";
    for (std::size_t j = i + 1; j < words.size(); ++j) {
      const Word& b = words[j];
      const double over_x = std::min(a.right, b.right) - std::max(a.left, b.left);
      const double over_y = std::min(a.bottom, b.bottom) - std::max(a.top, b.top);
      EXPECT_FALSE(over_x > 1 && over_y > 1) << name << ": \"" << a.text << "\" lies on \"" << b.text << '"';
    }
  }
}

void expect_clean_study(const StudyResult& study) {
  for (const StudyCurves& curves : study.curves) expect_clean_layout(curves.file, curves_svg(curves));
  for (const StudyFile& file : study.files) {
    if (file.name.ends_with(".svg")) expect_clean_layout(file.name, file.bytes);
  }
}

TEST(Layout, OfTheKinematicsStudyIsClean) { expect_clean_study(kinematics_study({true, 1})); }

TEST(Layout, OfTheMotorStudyIsClean) { expect_clean_study(motor_study({true, 1})); }

TEST(Layout, OfTheWorkspaceStudyIsClean) { expect_clean_study(workspace_study({true, 1})); }

TEST(Layout, CheckSeesAWordOnAnother) {
  // The check itself: two words in one place, and one that leaves the page.
  const std::string svg =
      "<svg width=\"200\" height=\"100\"><text x=\"10\" y=\"50\">first</text>"
      "<text x=\"20\" y=\"52\">second</text><text x=\"190\" y=\"20\">beyond</text></svg>";
  const std::vector<Word> words = words_of(svg);
  ASSERT_EQ(words.size(), 3u);
  EXPECT_LT(words[1].left, words[0].right);
  EXPECT_GT(words[2].right, 200);
  const std::vector<Word> upright =
      words_of("<text x=\"20\" y=\"50\" text-anchor=\"middle\" transform=\"rotate(-90 20 50)\">tall</text>");
  EXPECT_GT(upright[0].bottom - upright[0].top, upright[0].right - upright[0].left);
}

TEST(Layout, AxesAreReadableFromManySides) {
  const Vec3 low(-0.2, -0.2, -0.3), high(0.2, 0.2, 0);
  for (const double azimuth : {10.0, 30.0, 45.0, 60.0, 80.0}) {
    for (const double elevation : {15.0, 25.0, 40.0}) {
      const DrawingView view =
          DrawingView::fitted(azimuth * kDegree, elevation * kDegree, low, high, {0, 30}, {640, 470});
      const std::string svg = drawing_svg(640, 500, "axes", {axes_group(low, high, 0.1, view)});
      for (const Word& word : words_of(svg)) {
        EXPECT_GE(word.left, 0) << word.text << " from " << azimuth << ", " << elevation;
        EXPECT_LE(word.right, 640) << word.text << " from " << azimuth << ", " << elevation;
        EXPECT_LE(word.bottom, 500) << word.text << " from " << azimuth << ", " << elevation;
      }
    }
  }
}

}  // namespace
}  // namespace trocar::drawing_layout_test
