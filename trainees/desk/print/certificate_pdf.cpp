// The certificate's page. What it rests on fills what room is left; the rest is counted, so that it stays one page.
#include <algorithm>

#include "trainees/desk/print/pdf_pages.h"
#include "trainees/desk/print/report.h"

namespace trocar::printed {
namespace {

constexpr double kEdge = 30, kLeft = 64, kRight = PdfPages::kWidth - 64, kContent = kRight - kLeft,
                 kMiddle = 0.5 * PdfPages::kWidth;
constexpr double kRow = 10.4, kRowSize = 7.2, kCodeSize = 6.6, kFactStep = 11.6, kPointStep = 10.6;

class CertificatePage {
 public:
  explicit CertificatePage(const CertificateSheet& sheet)
      : sheet_(sheet), pages_(sheet.file_title(), sheet.newest_utc) {}

  std::string draw() {
    pages_.add();
    border();
    title();
    facts();
    const double foot = foot_top();
    evidence(foot);
    foot_words(foot);
    return pages_.bytes();
  }

 private:
  void border() {
    const Colour& colour = sheet_.withdrawn.empty() && sheet_.in_question.empty() ? kBlue : kRed;
    pages_.frame(kEdge, kEdge, PdfPages::kWidth - 2 * kEdge, PdfPages::kHeight - 2 * kEdge, 2.2, colour);
    pages_.frame(kEdge + 5, kEdge + 5, PdfPages::kWidth - 2 * kEdge - 10, PdfPages::kHeight - 2 * kEdge - 10, 0.7,
                 colour);
    if (!sheet_.withdrawn.empty())
      pages_.stamp("WITHDRAWN", kRed);
    else if (!sheet_.in_question.empty())
      pages_.stamp("IN QUESTION", kRed);
    else if (sheet_.demo)
      pages_.stamp("DEMO", kRed);
  }

  void middle(const std::string& words, const Font& font, const Colour& colour, int most = 0) {
    const Lines lines = pages_.lines(words, font, kContent, most);
    pages_.text(kMiddle, y_ + 1.34 * font.size, lines, colour, Side::kMiddle, 1.34 * font.size);
    y_ += 1.34 * font.size * lines.count();
  }

  void title() {
    y_ = 56;
    std::string above = sheet_.demo ? "DEMO: an invented trainee. Nothing here is a record." : "";
    if (!sheet_.in_question.empty()) above = "IN QUESTION: " + sheet_.in_question;
    if (!sheet_.withdrawn.empty()) above = "WITHDRAWN " + sheet_.withdrawn;
    if (!above.empty()) middle(above, bold(9), kRed, 3);
    y_ = std::max(y_ + 8, 84.0);
    middle("Certificate of training", plain(22), kBlue);
    y_ += 12;
    middle("It is certified that", plain(10), kDim);
    y_ += 6;
    middle(sheet_.holder, bold(24), kInk, 2);
    y_ += 8;
    pages_.line(kMiddle - 130, y_, kMiddle + 130, y_, 0.6, kDim);
    y_ += 2;
    if (sheet_.code != sheet_.holder) middle("trainee " + sheet_.code, plain(9), kDim, 1);
    y_ += 5;
    middle("has shown competence in", plain(10), kDim);
    y_ += 3;
    middle(sheet_.skill, bold(15), kInk, 2);
    y_ += 6;
    middle(sheet_.statement, plain(9.4), kInk, 4);
    y_ += 14;
  }

  void facts() {
    constexpr int kColumns = 3;
    const double slot = kContent / kColumns;
    for (std::size_t from = 0; from < sheet_.facts.size(); from += kColumns) {
      double lowest = y_;
      for (std::size_t i = from; i < sheet_.facts.size() && i < from + kColumns; ++i) {
        const double x = kLeft + slot * static_cast<double>(i - from);
        const Lines value = pages_.lines(sheet_.facts[i].second, bold(9), slot - 10, 2);
        pages_.text(x, y_ + 7, sheet_.facts[i].first, plain(7), kDim);
        pages_.text(x, y_ + 7 + kFactStep, value, kInk, Side::kLeft, kFactStep);
        lowest = std::max(lowest, y_ + 7 + kFactStep * value.count());
      }
      y_ = lowest + 8;
    }
  }

  Lines not_attested() const {
    std::string points;
    for (const std::string& point : sheet_.not_attested)
      points += (points.empty() ? "\xE2\x80\x93 " : "\n\xE2\x80\x93 ") + point;
    return pages_.lines(points, plain(8), kContent);
  }

  /// Where what it does not attest, signature and number begin.
  double foot_top() const { return PdfPages::kHeight - 138 - kPointStep * not_attested().count() - 16; }

  void evidence(double foot) {
    const Lines words = pages_.lines("Evidence: " + sheet_.evidence_words, bold(8), kContent, 3);
    pages_.text(kLeft, y_ + 15, words, kInk, Side::kLeft, 11);
    y_ += 8 + 11 * words.count();
    double all = 0;
    for (const Column& column : sheet_.columns) all += column.share;
    const auto put = [&](const std::vector<std::string>& cells, bool head) {
      double x = kLeft;
      y_ += kRow;
      for (std::size_t i = 0; i < sheet_.columns.size() && i < cells.size(); ++i) {
        const Column& column = sheet_.columns[i];
        const double width = kContent * column.share / all;
        const Font font = head ? bold(kRowSize) : column.mono ? mono(kCodeSize) : plain(kRowSize);
        const Lines cell = pages_.lines(cells[i], font, width - 6, 1);
        pages_.text(column.number ? x + width - 6 : x, y_, cell, kInk, column.number ? Side::kRight : Side::kLeft);
        x += width;
      }
      pages_.line(kLeft, y_ + 2.8, kRight, y_ + 2.8, head ? 0.8 : 0.3, head ? kInk : kRule);
    };
    std::vector<std::string> titles;
    for (const Column& column : sheet_.columns) titles.push_back(column.title);
    put(titles, true);
    const auto room = static_cast<std::size_t>(std::max(1.0, (foot - y_ - 18) / kRow));
    const std::size_t count = sheet_.evidence.size(), begin = count > room ? count - room + 1 : 0;
    if (begin > 0)
      pages_.text(kLeft, y_ += kRow, "and " + std::to_string(begin) + " earlier ones, in the record", plain(kRowSize),
                  kDim);
    for (std::size_t i = begin; i < count; ++i) put(sheet_.evidence[i], false);
  }

  void foot_words(double top) {
    y_ = top + 6;
    pages_.text(kLeft, y_, "What it does not attest", bold(8), kInk);
    pages_.text(kLeft, y_ + kPointStep, not_attested(), kInk, Side::kLeft, kPointStep);
    const double line = PdfPages::kHeight - 92, half = 0.5 * kContent - 16;
    const auto signed_line = [&](double x, const std::string& words, const std::string& under) {
      pages_.text(x, line - 5, pages_.lines(words, bold(11), half, 1), kInk);
      pages_.line(x, line, x + half, line, 0.6, kDim);
      pages_.text(x, line + 11, under, plain(7.6), kDim);
    };
    signed_line(kLeft, sheet_.certified_by, "certified by");
    signed_line(kLeft + half + 32, sheet_.date, "date (UTC)");
    pages_.text(kMiddle, PdfPages::kHeight - 62, "Certificate " + sheet_.uuid, mono(7.4), kInk, Side::kMiddle);
    pages_.text(kMiddle, PdfPages::kHeight - 50,
                "Trocar, a training aid and no medical device. This page prints a record and is not itself the record.",
                plain(7), kDim, Side::kMiddle);
  }

  const CertificateSheet& sheet_;
  PdfPages pages_;
  double y_ = 0;
};

}  // namespace

std::string pdf_of(const CertificateSheet& sheet) { return CertificatePage(sheet).draw(); }

}  // namespace trocar::printed
