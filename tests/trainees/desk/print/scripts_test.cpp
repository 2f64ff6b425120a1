// Names of people in every script: in the file's properties and on the page, as poppler reads them, without a warning.
#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/trainees/desk/print/pdf_reader.h"
#include "trainees/desk/print/report.h"

namespace trocar::printed::scripts_test {
namespace {

struct Script {
  const char *name, *person;
  const char* letter = "";  ///< of it that a font of the machine must have; "" where DejaVu does
};

constexpr Script kScripts[] = {
    {"Greek", "Αθηνά Παπαδοπούλου"},    {"Cyrillic", "Йована Ђорђевић"},
    {"Vietnamese", "Nguyễn Thị Hằng"},  {"Chinese", "王小明", "738b"},
    {"Japanese", "佐藤さくら", "3055"}, {"Korean", "김민준", "ae40"},
    {"Arabic", "فاطمة حسين"},           {"Hebrew", "נועה לוי"},
};

CertificateSheet sheet_of(const std::string& person) {
  CertificateSheet out;
  out.holder = person;
  out.code = "T-7";
  out.skill = "Surface touch, level L2";
  out.statement = "Competence shown at attempt 14 of 16.";
  out.certified_by = person;
  out.date = "20 Mar 2026, 10:00";
  out.uuid = "01890000-aaaa-7bbb-8ccc-000000000009";
  out.newest_utc = "2026-03-20T10:00:00Z";
  return out;
}

/// Without the marks by which poppler tells which way words run, and without blanks: it sees some between Arabic
/// letters that do not join.
std::string letters(std::string text) {
  for (const std::string mark : {"\xE2\x80\xAA", "\xE2\x80\xAB", "\xE2\x80\xAC", "\xE2\x80\x8E", "\xE2\x80\x8F", " "})
    for (std::size_t at = 0; (at = text.find(mark, at)) != std::string::npos;) text.erase(at, mark.size());
  return text;
}

class Scripts : public testing::TestWithParam<Script> {};

TEST_P(Scripts, StandInThePropertiesAndOnThePage) {
  const Script& script = GetParam();
  const std::string bytes = pdf_of(sheet_of(script.person));
  EXPECT_EQ(poppler_warnings(bytes), "");
  const ReadPdf pdf = read_pdf(bytes);
  EXPECT_NE(letters(pdf.info).find(letters(script.person)), std::string::npos) << pdf.info;
  if (script.letter[0] != '\0') {
    ASSERT_EQ(std::system(("fc-list :charset=" + std::string(script.letter) + " | grep -q .").c_str()), 0)
        << "no font of this machine has its letters (fonts-wqy-microhei)";
  }
  EXPECT_NE(letters(pdf.all).find(letters(script.person)), std::string::npos) << pdf.all;
  EXPECT_EQ(pdf.fonts.find(" no  "), std::string::npos) << "a font is not embedded:\n" << pdf.fonts;
}

INSTANTIATE_TEST_SUITE_P(Of, Scripts, testing::ValuesIn(kScripts),
                         [](const auto& of) { return std::string(of.param.name); });

}  // namespace
}  // namespace trocar::printed::scripts_test
