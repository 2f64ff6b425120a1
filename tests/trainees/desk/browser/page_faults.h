// What is wrong with the page that a browser shows, measured in the browser: width, labels, contrast, clipped words,
// the way of the Tab key.
#pragma once

#include <string>
#include <vector>

#include "tests/trainees/desk/browser/browser.h"

namespace trocar::test {

/// Scrolls sideways; fields and buttons without a name; text under 4.5:1 (3:1 when large) by WCAG 2.1; words cut off in
/// buttons; things to press smaller than 24 px that stand alone.
std::vector<std::string> faults_of_page(Browser& browser);

/// Tab from the beginning: everything that can have the focus gets it, in order, with an outline of at least 2 px, on
/// the screen.
std::vector<std::string> faults_of_tab_order(Browser& browser);

/// As on paper as wide as the window: something to press or to fill in is left, a link is underlined, a thing is wider
/// than the paper, or the line that says whose page it is and when it was made is missing.
std::vector<std::string> faults_of_paper(Browser& browser);

}  // namespace trocar::test
