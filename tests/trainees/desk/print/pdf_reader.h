// A PDF read back by poppler's programs: what a person would find on its pages.
#pragma once

#include <string>
#include <vector>

namespace trocar::printed {

struct ReadPdf {
  std::vector<std::string> pages = {};  ///< text of each, as it lies on the page
  std::string all = {};                 ///< of all of them, lines and columns joined by single spaces
  std::string info = {};                ///< what pdfinfo says
  std::string fonts = {};
  bool holds(const std::string& words) const { return all.find(words) != std::string::npos; }
};

/// @throws std::runtime_error when poppler cannot read it.
ReadPdf read_pdf(const std::string& bytes);

/// What poppler's programs complain of while they read and draw it; "" when it is sound.
std::string poppler_warnings(const std::string& bytes);

/// Left upper and right lower corner of every word, points from the page's left upper corner.
struct WordBox {
  int page = 0;  ///< from 0
  double x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  std::string words = {};
};
std::vector<WordBox> word_boxes(const std::string& bytes);
/// Pairs of words that lie on each other on a page, as "a / b".
std::vector<std::string> collisions(const std::string& bytes);
/// Words that leave the paper's margin of so many points.
std::vector<std::string> outside(const std::string& bytes, double margin);

/// Any run of white space as one space.
std::string squeezed(const std::string& text);

}  // namespace trocar::printed
