// Pages as poppler reads them: nothing cut, nothing on top of anything, heads that come again, the same bytes for the
// same report.
#include <gtest/gtest.h>

#include <set>

#include "tests/trainees/desk/print/pdf_reader.h"
#include "trainees/desk/print/report.h"

namespace trocar::printed::report_pdf_test {
namespace {

constexpr const char* kNames = "M\xC3\xBCller, \xC5\x81ukasz, Ng\xC3\xB4";

Report plain() {
  Report out;
  out.kind = "Trainee report";
  out.title = kNames;
  out.subtitle = "Trainee T-1, group 2026 A";
  out.who = "T-1";
  out.newest_utc = "2026-03-19T09:30:00.000Z";
  return out;
}

Table long_table(int rows, const std::string& words = "word") {
  Table table{"Attempts", {{"No.", 1, true}, {"What", 4}, {"Hash", 3, false, true}}, {}};
  for (int i = 1; i <= rows; ++i) table.rows.push_back({"r" + std::to_string(i), words, "h" + std::to_string(i)});
  return table;
}

TEST(ReportPdf, NamesOfEveryAlphabetArePrinted) {
  Report report = plain();
  report.blocks = {Paragraph{"\xCE\x91\xCE\xB8\xCE\xAE\xCE\xBD\xCE\xB1, \xD0\x98\xD0\xB2\xD0\xB0\xD0\xBD"},
                   Paragraph{"lacking: \xE6\xBC\xA2 and \xF0\x9F\x98\x80 end"}};
  const ReadPdf pdf = read_pdf(pdf_of(report));
  EXPECT_TRUE(pdf.holds(kNames));
  EXPECT_TRUE(pdf.holds("\xCE\x91\xCE\xB8\xCE\xAE\xCE\xBD\xCE\xB1, \xD0\x98\xD0\xB2\xD0\xB0\xD0\xBD"));
  EXPECT_TRUE(pdf.holds("lacking: "));
  EXPECT_TRUE(pdf.holds(" end")) << "what the font lacks is a box and no error";
  for (const char* face : {"+DejaVuSans ", "+DejaVuSans-Bold "})
    EXPECT_NE(pdf.fonts.find(face), std::string::npos) << pdf.fonts;
  EXPECT_EQ(pdf.fonts.find(" no  "), std::string::npos) << "a font is not embedded:\n" << pdf.fonts;
}

TEST(ReportPdf, TheSameReportIsTheSameBytes) {
  Report report = plain();
  report.blocks = {
      Heading{"Part", 1}, long_table(80),
      Figures{
          {{"<svg viewBox=\"0 0 10 10\"><line x1=\"0\" y1=\"0\" x2=\"9\" y2=\"9\" stroke=\"#000\"/></svg>", "c", 1}}}};
  const std::string bytes = pdf_of(report);
  EXPECT_EQ(bytes, pdf_of(report));
  report.title += " ";
  report.blocks.emplace_back(Paragraph{"x"});
  EXPECT_NE(bytes, pdf_of(report));
}

TEST(ReportPdf, TheFileBearsTheDateOfTheRecord) {
  const ReadPdf pdf = read_pdf(pdf_of(plain()));
  EXPECT_NE(squeezed(pdf.info).find("CreationDate: Thu Mar 19 09:30:00 2026"), std::string::npos) << pdf.info;
  EXPECT_EQ(pdf.info.find("ModDate"), std::string::npos);
  EXPECT_TRUE(pdf.holds("Record to 19 Mar 2026"));
  EXPECT_NE(squeezed(pdf.info).find("A4"), std::string::npos);
  Report undated = plain();
  undated.newest_utc = "";
  EXPECT_EQ(read_pdf(pdf_of(undated)).info.find("CreationDate"), std::string::npos) << "no date is made up";
}

TEST(ReportPdf, LongTablesGoOnWithTheirHeadAndLoseNoRow) {
  Report report = plain();
  report.blocks = {Heading{"All", 1}, long_table(300)};
  const ReadPdf pdf = read_pdf(pdf_of(report));
  ASSERT_GT(pdf.pages.size(), 4U);
  for (std::size_t i = 0; i < pdf.pages.size(); ++i) {
    EXPECT_NE(pdf.pages[i].find("No."), std::string::npos) << "page " << i + 1;
    EXPECT_NE(squeezed(pdf.pages[i]).find(std::to_string(i + 1) + " of " + std::to_string(pdf.pages.size())),
              std::string::npos)
        << pdf.pages[i];
    EXPECT_NE(pdf.pages[i].find("T-1"), std::string::npos) << "who, on every page";
  }
  EXPECT_TRUE(pdf.holds("Attempts (continued)"));
  for (int i = 1; i <= 300; ++i) EXPECT_TRUE(pdf.holds("r" + std::to_string(i) + " word h" + std::to_string(i))) << i;
}

TEST(ReportPdf, ARowStaysWhole) {
  Report report = plain();
  Table table{"", {{"A", 1}, {"B", 4}}, {}};
  for (int i = 0; i < 60; ++i) {
    const std::string n = std::to_string(i);
    table.rows.push_back({"first" + n + "\nsecond" + n + "\nthird" + n, "b"});
  }
  report.blocks = {table};
  for (const std::string& page : read_pdf(pdf_of(report)).pages)
    for (int i = 0; i < 60; ++i) {
      const bool begins = page.find("first" + std::to_string(i) + " ") != std::string::npos ||
                          page.find("first" + std::to_string(i) + "\n") != std::string::npos;
      if (begins) {
        EXPECT_NE(page.find("third" + std::to_string(i)), std::string::npos) << "row " << i << " goes over a page";
      }
    }
}

TEST(ReportPdf, NothingCollidesOrLeavesThePaperWhateverIsWritten) {
  Report report = plain();
  const std::string endless(300, 'W'), sixty(60, 'M');
  report.title = sixty + " " + sixty;
  report.who = report.title;
  report.subtitle = endless;
  Facts facts{{{"Name", sixty}, {"Short", "1"}, {"Other", endless}}, 4, false};
  Table table = long_table(30, endless);
  for (auto& row : table.rows) row[2].words = std::string(64, 'f');
  report.blocks = {facts,
                   Heading{endless, 1},
                   table,
                   Verdict{endless, endless, "100.0", "of 100, pass 75, proficient", Tone::kBad},
                   Paragraph{endless},
                   Heading{"At the end", 2},
                   Paragraph{"words ", Tone::kBad, true}};
  const std::string bytes = pdf_of(report);
  EXPECT_EQ(collisions(bytes), std::vector<std::string>{});
  EXPECT_EQ(outside(bytes, 28), std::vector<std::string>{});
}

TEST(ReportPdf, AHeadingStaysWithWhatItHeads) {
  for (int rows = 40; rows < 54; ++rows) {
    Report report = plain();
    report.blocks = {long_table(rows), Heading{"HEADED", 1}, long_table(3, "beneath")};
    for (const std::string& page : read_pdf(pdf_of(report)).pages)
      if (page.find("HEADED") != std::string::npos) {
        EXPECT_NE(page.find("beneath"), std::string::npos) << rows;
      }
  }
}

TEST(ReportPdf, AChartIsLinesAndItsWordsAreText) {
  Report report = plain();
  report.blocks = {
      Figures{{{"<svg viewBox=\"0 0 720 300\"><text x=\"20\" y=\"50\">pass 75</text><circle r=\"4\" cx=\"9\" cy=\"9\" "
                "fill=\"#0072b2\" "
                "fill-opacity=\"0.5\"/><rect x=\"0\" y=\"0\" width=\"90\" height=\"40\" fill=\"url(#hatch)\"/></svg>",
                "Caption with n = 8.", 1}}}};
  const std::string bytes = pdf_of(report);
  EXPECT_TRUE(read_pdf(bytes).holds("pass 75"));
  EXPECT_TRUE(read_pdf(bytes).holds("Caption with n = 8."));
  EXPECT_EQ(bytes.find("/Subtype /Image"), std::string::npos) << "not a picture of a chart";
}

TEST(ReportPdf, DemoIsSaidOnEveryPage) {
  Report report = plain();
  report.mark = "DEMO";
  report.blocks = {long_table(120)};
  const ReadPdf pdf = read_pdf(pdf_of(report));
  ASSERT_GT(pdf.pages.size(), 1U);
  for (const std::string& page : pdf.pages) EXPECT_NE(page.find("invented"), std::string::npos);
  report.mark = "";
  EXPECT_FALSE(read_pdf(pdf_of(report)).holds("invented"));
}

TEST(ReportPdf, AnEmptyReportAndABrokenPictureAreNoError) {
  Report report;
  EXPECT_EQ(read_pdf(pdf_of(report)).pages.size(), 1U);
  report.blocks = {Table{},
                   Facts{},
                   Figures{},
                   Picture{"\x89PNG but not really", "c", 1},
                   Picture{},
                   Heading{},
                   Table{"Certificates", {{"A", 1}}, {}, "None yet."}};
  const ReadPdf pdf = read_pdf(pdf_of(report));
  EXPECT_TRUE(pdf.holds("None yet."));
}

TEST(DayText, DatesAndWhatIsNone) {
  EXPECT_EQ(day_text("2026-03-09T10:00:00Z"), "9 Mar 2026");
  EXPECT_EQ(day_text("2026-12-31"), "31 Dec 2026");
  EXPECT_EQ(day_text("2026-13-01"), "2026-13-01");
  EXPECT_EQ(day_text("soon"), "soon");
}

}  // namespace
}  // namespace trocar::printed::report_pdf_test
