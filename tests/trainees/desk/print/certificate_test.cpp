// The certificate: one page whatever it rests on, what it is and is not, withdrawn and demo ones that say so.
#include <gtest/gtest.h>

#include "tests/trainees/desk/print/pdf_reader.h"
#include "trainees/desk/print/report.h"

namespace trocar::printed::certificate_test {
namespace {

CertificateSheet sheet(int attempts = 16) {
  CertificateSheet out;
  out.holder = "Ng\xC3\xB4 \xC5\x81ukasz M\xC3\xBCller";
  out.code = "T-7";
  out.skill = "Surface touch, level L2";
  out.statement = "Competence shown at attempt 14 of 16, reliability 0.84.";
  out.facts = {{"Attempts it rests on", "n = 16"},
               {"Passed", "15 of 16"},
               {"Reliability of the mean score", "0.84"},
               {"Rules of progress", "version 1"}};
  out.columns = {{"No.", 0.6, true},
                 {"When (UTC)", 2.2},
                 {"Score", 0.9, true},
                 {"Result", 2.6},
                 {"Row hash (sha256)", 4.6, false, true}};
  for (int i = 1; i <= attempts; ++i)
    out.evidence.push_back(
        {std::to_string(i), "10 Mar 2026, 09:00", "91.5", "passed", "hash" + std::to_string(1000 + i)});
  out.evidence_words = "16 attempts";
  out.not_attested = {"Skill with patients.", "That the skill is kept."};
  out.certified_by = "Dr Ines Okafor";
  out.date = "20 Mar 2026, 10:00";
  out.uuid = "01890000-aaaa-7bbb-8ccc-000000000009";
  out.newest_utc = "2026-03-20T10:00:00Z";
  return out;
}

TEST(CertificatePdf, SaysWhoWhatWhenAndByWhom) {
  const ReadPdf pdf = read_pdf(pdf_of(sheet()));
  ASSERT_EQ(pdf.pages.size(), 1U);
  for (const char* words : {"Ng\xC3\xB4 \xC5\x81ukasz M\xC3\xBCller", "trainee T-7", "Surface touch, level L2",
                            "Competence shown at attempt 14 of 16, reliability 0.84.", "n = 16", "15 of 16",
                            "version 1", "Skill with patients.", "What it does not attest", "Dr Ines Okafor",
                            "20 Mar 2026, 10:00", "01890000-aaaa-7bbb-8ccc-000000000009"})
    EXPECT_TRUE(pdf.holds(words)) << words;
  for (int i = 1; i <= 16; ++i) EXPECT_TRUE(pdf.holds("hash" + std::to_string(1000 + i))) << i;
  EXPECT_FALSE(pdf.holds("WITHDRAWN"));
  EXPECT_FALSE(pdf.holds("DEMO"));
}

TEST(CertificatePdf, StaysOnePageAndCountsWhatItLeavesOut) {
  const ReadPdf pdf = read_pdf(pdf_of(sheet(120)));
  ASSERT_EQ(pdf.pages.size(), 1U);
  EXPECT_TRUE(pdf.holds("hash1120")) << "the newest are kept";
  EXPECT_FALSE(pdf.holds("hash1001"));
  int shown = 0;
  for (int i = 1; i <= 120; ++i) shown += pdf.holds("hash" + std::to_string(1000 + i)) ? 1 : 0;
  EXPECT_TRUE(pdf.holds("and " + std::to_string(120 - shown) + " earlier ones")) << shown;
}

TEST(CertificatePdf, NothingCollidesWithLongNames) {
  CertificateSheet long_one = sheet(120);
  long_one.holder = std::string(60, 'W');
  long_one.code = std::string(32, 'W');
  long_one.skill = std::string(70, 'W') + ", level L2";
  long_one.certified_by = std::string(60, 'W');
  long_one.withdrawn = "on 3 Feb 2026: " + std::string(400, 'r');
  for (const auto& subject : {long_one, sheet(0), sheet(40)}) {
    EXPECT_EQ(collisions(pdf_of(subject)), std::vector<std::string>{});
    EXPECT_EQ(outside(pdf_of(subject), 36), std::vector<std::string>{});
  }
}

TEST(CertificatePdf, WithdrawnAndDemoAreMarked) {
  CertificateSheet withdrawn = sheet();
  withdrawn.withdrawn = "on 3 Feb 2026: device was out of calibration";
  EXPECT_TRUE(read_pdf(pdf_of(withdrawn)).holds("WITHDRAWN on 3 Feb 2026: device was out of calibration"));
  EXPECT_NE(html_of(withdrawn).find("WITHDRAWN on 3 Feb 2026"), std::string::npos);
  CertificateSheet demo = sheet();
  demo.demo = true;
  EXPECT_TRUE(read_pdf(pdf_of(demo)).holds("DEMO: an invented trainee."));
  EXPECT_NE(html_of(demo).find("DEMO: an invented trainee."), std::string::npos);
  EXPECT_EQ(html_of(sheet()).find("WITHDRAWN"), std::string::npos);
}

TEST(CertificatePdf, SameBytesForTheSameRecord) {
  EXPECT_EQ(pdf_of(sheet()), pdf_of(sheet()));
  EXPECT_EQ(html_of(sheet()), html_of(sheet()));
}

}  // namespace
}  // namespace trocar::printed::certificate_test
