// Reads sentences out of sources: string literals, and those that are given to words("...").
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace trocar {

/// A literal as the compiler joins it ("a " "b" is one), and where it stands.
struct Literal {
  std::string text;
  std::size_t at = 0;  ///< of its first quote
};

/// Of C++ code, comments left out; raw strings are taken as they are.
std::vector<Literal> literals_of(const std::string& code);

/// First arguments of calls words("..."), w("..."), words()("..."): several when it chooses between them.
std::vector<std::string> words_asked(const std::string& code);

/// First two arguments of say(status, "...", "...") and what is given to toast_, as far as they are literals.
std::vector<std::string> sentences_said(const std::string& code);

/// What a sentence says between its places: "Disc {0}: {1}." has "Disc" and ":"; trimmed, without what has no letter.
std::vector<std::string> own_pieces(const std::string& sentence);

std::string file_text(const std::filesystem::path& file);
/// Files below, by suffixes, sorted.
std::vector<std::filesystem::path> files_below(const std::filesystem::path& folder,
                                               const std::vector<std::string>& suffixes);

}  // namespace trocar
