// The certificate's page. What it rests on fills what room is left; the rest is counted, so that it stays one page.
#include <algorithm>

#include "trainees/desk/print/pdf_pages.h"
#include "trainees/desk/print/report.h"

namespace trocar::printed {
namespace {

constexpr double kEdge = 30, kLeft = 64, kRight = PdfPages::kWidth - 64, kContent = kRight - kLeft,
                 kMiddle = 0.5 * PdfPages::kWidth;
constexpr double kRow = 10.4, kRowSize = 7.2, kCodeSize = 6.6;

class CertificatePage {
 public:
  explicit CertificatePage(const CertificateSheet& sheet)
      : sheet_(sheet), pages_("Certificate: " + sheet.code, sheet.newest_utc) {}

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
    const Colour& colour = sheet_.withdrawn.empty() ? kBlue : kRed;
    pages_.frame(kEdge, kEdge, PdfPages::kWidth - 2 * kEdge, PdfPages::kHeight - 2 * kEdge, 2.2, colour);
    pages_.frame(kEdge + 5, kEdge + 5, PdfPages::kWidth - 2 * kEdge - 10, PdfPages::kHeight - 2 * kEdge - 10, 0.7,
                 colour);
    if (!sheet_.withdrawn.empty())
      pages_.stamp("WITHDRAWN", kRed);
    else if (sheet_.demo)
      pages_.stamp("DEMO", kRed);
  }

  void middle(const std::string& words, Face face, double size, const Colour& colour, int most = 0) {
    for (const std::string& line : wrapped(printable(words), kContent, pages_.measure(face, size), most)) {
      y_ += 1.34 * size;
      pages_.text_middle(kMiddle, y_, line, face, size, colour);
    }
  }

  void title() {
    y_ = 56;
    std::string above = sheet_.demo ? "DEMO: an invented trainee. Nothing here is a record." : "";
    if (!sheet_.withdrawn.empty()) above = "WITHDRAWN " + sheet_.withdrawn;
    if (!above.empty()) middle(above, Face::kBold, 9, kRed, 3);
    y_ = std::max(y_ + 8, 84.0);
    middle("Certificate of training", Face::kPlain, 22, kBlue);
    y_ += 12;
    middle("It is certified that", Face::kPlain, 10, kDim);
    y_ += 6;
    middle(sheet_.holder, Face::kBold, 24, kInk, 2);
    y_ += 8;
    pages_.line(kMiddle - 130, y_, kMiddle + 130, y_, 0.6, kDim);
    y_ += 2;
    if (sheet_.code != sheet_.holder) middle("trainee " + sheet_.code, Face::kPlain, 9, kDim, 1);
    y_ += 5;
    middle("has shown competence in", Face::kPlain, 10, kDim);
    y_ += 3;
    middle(sheet_.skill, Face::kBold, 15, kInk, 2);
    y_ += 6;
    middle(sheet_.statement, Face::kPlain, 9.4, kInk, 4);
    y_ += 14;
  }

  void facts() {
    constexpr int kColumns = 3;
    const double slot = kContent / kColumns;
    for (std::size_t from = 0; from < sheet_.facts.size(); from += kColumns) {
      double lowest = y_;
      for (std::size_t i = from; i < sheet_.facts.size() && i < from + kColumns; ++i) {
        const double x = kLeft + slot * static_cast<double>(i - from);
        double y = y_ + 7;
        pages_.text(x, y, printable(sheet_.facts[i].first), Face::kPlain, 7, kDim);
        for (const std::string& line :
             wrapped(printable(sheet_.facts[i].second), slot - 10, pages_.measure(Face::kBold, 9), 2))
          pages_.text(x, y += 11.6, line, Face::kBold, 9, kInk);
        lowest = std::max(lowest, y);
      }
      y_ = lowest + 8;
    }
  }

  std::vector<std::string> not_attested() const {
    std::vector<std::string> out;
    for (const std::string& point : sheet_.not_attested)
      for (const std::string& line :
           wrapped(printable("\xE2\x80\x93 " + point), kContent, pages_.measure(Face::kPlain, 8)))
        out.push_back(line);
    return out;
  }

  /// Where what it does not attest, signature and number begin.
  double foot_top() const { return PdfPages::kHeight - 138 - 10.6 * static_cast<double>(not_attested().size()) - 16; }

  void evidence(double foot) {
    y_ += 4;
    for (const std::string& line :
         wrapped(printable("Evidence: " + sheet_.evidence_words), kContent, pages_.measure(Face::kBold, 8), 3))
      pages_.text(kLeft, y_ += 11, line, Face::kBold, 8, kInk);
    y_ += 4;
    double all = 0;
    for (const Column& column : sheet_.columns) all += column.share;
    const auto put = [&](const std::vector<std::string>& cells, bool head) {
      double x = kLeft;
      y_ += kRow;
      for (std::size_t i = 0; i < sheet_.columns.size() && i < cells.size(); ++i) {
        const Column& column = sheet_.columns[i];
        const double width = kContent * column.share / all;
        const Face face = head ? Face::kBold : column.mono ? Face::kMono : Face::kPlain;
        const double size = column.mono && !head ? kCodeSize : kRowSize;
        const std::string words = shortened(printable(cells[i]), width - 6, pages_.measure(face, size));
        if (column.number)
          pages_.text_right(x + width - 6, y_, words, face, size, kInk);
        else
          pages_.text(x, y_, words, face, size, kInk);
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
      pages_.text(kLeft, y_ += kRow, "and " + std::to_string(begin) + " earlier ones, in the record", Face::kPlain,
                  kRowSize, kDim);
    for (std::size_t i = begin; i < count; ++i) put(sheet_.evidence[i], false);
  }

  void foot_words(double top) {
    y_ = top + 6;
    pages_.text(kLeft, y_, "What it does not attest", Face::kBold, 8, kInk);
    for (const std::string& line : not_attested()) pages_.text(kLeft, y_ += 10.6, line, Face::kPlain, 8, kInk);
    const double line = PdfPages::kHeight - 92;
    const double half = 0.5 * kContent - 16;
    const auto signed_line = [&](double x, const std::string& words, const std::string& under) {
      pages_.text(x, line - 5, shortened(printable(words), half, pages_.measure(Face::kBold, 11)), Face::kBold, 11,
                  kInk);
      pages_.line(x, line, x + half, line, 0.6, kDim);
      pages_.text(x, line + 11, under, Face::kPlain, 7.6, kDim);
    };
    signed_line(kLeft, sheet_.certified_by, "certified by");
    signed_line(kLeft + half + 32, sheet_.date, "date (UTC)");
    pages_.text_middle(kMiddle, PdfPages::kHeight - 62, printable("Certificate " + sheet_.uuid), Face::kMono, 7.4,
                       kInk);
    pages_.text_middle(
        kMiddle, PdfPages::kHeight - 50,
        "Trocar, a training aid and no medical device. This page prints a record and is not itself the record.",
        Face::kPlain, 7, kDim);
  }

  const CertificateSheet& sheet_;
  PdfPages pages_;
  double y_ = 0;
};

}  // namespace

std::string pdf_of(const CertificateSheet& sheet) { return CertificatePage(sheet).draw(); }

}  // namespace trocar::printed
