// How long the functions of a source file are: a brace matcher, not a parser.
//
// Namespaces and classes are walked into; a function, a constructor with its initialiser list, a test or a lambda that
// stands outside any function counts from the first line of its head to its closing brace. What lies inside a function
// (lambdas, local classes) counts as part of it. Initialisers in braces and enums are skipped.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace trocar {

struct FunctionLength {
  std::string head;       ///< as written, on one line, without its body
  std::size_t line = 0;   ///< where the head begins, from 1
  std::size_t lines = 0;  ///< head and body
};

std::vector<FunctionLength> function_lengths(const std::string& text);

}  // namespace trocar
