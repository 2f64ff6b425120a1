// Words into a width: wrapped at spaces, cut inside where a word is longer than a line, ended by an ellipsis where
// there are too many.
//
// How wide a text is says the one who prints it. Pure. Thread: any.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace trocar::printed {

using WidthOf = std::function<double(const std::string&)>;

/// What a font can be asked for: no control characters (a line's end stays), broken bytes and what lies beyond the
/// first plane as a box.
std::string printable(const std::string& text);

/// At least one line. @param most lines; 0: any number.
std::vector<std::string> wrapped(const std::string& text, double width, const WidthOf& width_of, int most = 0);

/// One line that fits, with an ellipsis where it was cut.
std::string shortened(const std::string& text, double width, const WidthOf& width_of);

}  // namespace trocar::printed
