// Blocks of a report one under the other, page after page: nothing is cut through, a heading stays with what it heads.
//
// Points, y from the top down. Thread: one.
#pragma once

#include "trainees/desk/print/pdf_pages.h"
#include "trainees/desk/print/report.h"

namespace trocar::printed {

class PageFlow {
 public:
  static constexpr double kLeft = 46, kRight = PdfPages::kWidth - 46, kTop = 66, kBottom = 782,
                          kContent = kRight - kLeft;

  static constexpr double kKeptWhole = 200;  ///< blocks up to this height are not parted

  explicit PageFlow(PdfPages& pages) : pages_(&pages) { next_page(); }
  PdfPages& pages() { return *pages_; }
  double y() const { return y_; }
  void down(double by) { y_ += by; }
  bool fits(double height) const { return y_ + height <= kBottom; }
  bool at_top() const { return y_ <= kTop; }
  void next_page();
  void need(double height);  ///< goes on to the next page where it does not fit

  /// Wrapped over the width from x on; goes on over the page.
  void words(const std::string& text, const Font& font, const Colour& colour, double x = kLeft,
             double width = kContent);
  /// 0 for no words.
  double height_of_words(const std::string& text, const Font& font, double width = kContent) const;

 private:
  PdfPages* pages_;
  double y_ = kTop;
};

/// One block. @param least_behind height that must fit under a heading.
void put(PageFlow& flow, const Heading& heading, double least_behind);
void put(PageFlow& flow, const Paragraph& paragraph);
void put(PageFlow& flow, const Facts& facts);
void put(PageFlow& flow, const Table& table);
void put(PageFlow& flow, const Figures& figures);
void put(PageFlow& flow, const Picture& picture);
void put(PageFlow& flow, const Verdict& verdict);
/// Of a block, or of its beginning where it may go on over the page.
double least_height(PageFlow& flow, const Block& block);
double least_height(PageFlow& flow, const Table& table);

const Colour& colour_of(Tone tone);

}  // namespace trocar::printed
