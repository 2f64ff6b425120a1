// C++ source as text: comments and literals blanked out, so that what is left is structure.
#pragma once

#include <cstddef>
#include <string>

namespace trocar {

/// The same text, line by line and column by column, with comments, string and character literals (raw ones too)
/// replaced by spaces. Quotes stay, so that `""` remains visible.
std::string blank_literals(const std::string& text);

/// Line (from 1) of a position.
std::size_t line_of(const std::string& text, std::size_t position);

}  // namespace trocar
