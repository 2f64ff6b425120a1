// The forms of values: good ones pass, near misses do not.
#include <gtest/gtest.h>

#include <string>

#include "trainees/exchange/export/xapi_terms.h"

namespace trocar::xapi::xapi_terms_test {
namespace {

using Form = bool (*)(std::string_view);

void expect(Form form, bool wanted, std::initializer_list<const char*> texts) {
  for (const char* text : texts) EXPECT_EQ(form(text), wanted) << '"' << text << '"';
}

TEST(XapiTerms, Uuids) {
  expect(is_uuid, true,
         {"fd41c918-b88b-4b20-a0a5-a4c32391aaa0", "FD41C918-B88B-4B20-A0A5-A4C32391AAA0",
          "01890a5d-ac96-774b-bcce-b302099a8057"});
  expect(is_uuid, false,
         {"", "fd41c918b88b4b20a0a5a4c32391aaa0", "{fd41c918-b88b-4b20-a0a5-a4c32391aaa0}",
          "fd41c918-b88b-4b20-a0a5-a4c32391aaa", "fd41c918-b88b-4b20-a0a5-a4c32391aaag",
          "00000000-0000-0000-0000-000000000000", "fd41c918-b88b-4b20-a0a5-a4c32391aaa0\n"});
}

TEST(XapiTerms, Iris) {
  expect(is_iri, true, {"http://example.org", "urn:uuid:1", "mailto:a@b", "https://例え.jp/é?x=1#y", "x-y+z.1:a"});
  expect(is_iri, false,
         {"", "example.org/path", "/path", "http:", ":x", "1http://x", "http://a b", "http://a<b>", "http://a\"b",
          "http://a\nb", "http://{x}", "http://a|b", "http://a\\b", "http://a^b", "http://a`b"});
  EXPECT_FALSE(is_iri("http://" + std::string(3000, 'a')));
}

TEST(XapiTerms, Timestamps) {
  expect(is_timestamp, true,
         {"2026-03-01T09:30:00Z", "2026-03-01T09:30:00.123Z", "2024-02-29T23:59:59+00:00",
          "2026-03-01T09:30:00.123456789-05:00", "2026-12-31T23:59:60Z", "2026-03-01T09:30:00+0530",
          "2026-03-01t09:30:00z"});
  expect(
      is_timestamp, false,
      {"", "2026-03-01", "2026-03-01T09:30:00", "2026-03-01 09:30:00Z", "2026-02-29T09:30:00Z", "2026-13-01T09:30:00Z",
       "2026-00-10T09:30:00Z", "2026-03-01T24:00:00Z", "2026-03-01T09:60:00Z", "2026-03-01T09:30:61Z",
       "2026-03-01T09:30Z", "2026-03-01T09:30:00-00:00", "2026-03-01T09:30:00-0000", "2026-03-01T09:30:00-00",
       "2026-03-01T09:30:00+24:00", "26-03-01T09:30:00Z", "2026-03-01T09:30:00.Z", "1772357400"});
}

TEST(XapiTerms, Durations) {
  expect(is_duration, true, {"PT0S", "PT46.2S", "PT46,2S", "P1D", "P2W", "P1Y2M3DT4H5M6S", "PT1.5H", "PT90M", "P0.5W"});
  expect(is_duration, false,
         {"", "P", "PT", "T1S", "46.2", "PT-1S", "-PT1S", "P1DT", "PT1S2M", "PT1.5H3M", "P1.5DT2S", "PT.5S", "P1H",
          "P1W2D", "PT1S ", "pt1s"});
}

TEST(XapiTerms, Languages) {
  expect(is_language, true, {"en", "en-GB", "zh-Hant-TW", "x-klingon", "und"});
  expect(is_language, false, {"", "en_GB", "en-", "-en", "english-language-x-toolongpart", "e n", "1"});
}

}  // namespace
}  // namespace trocar::xapi::xapi_terms_test
