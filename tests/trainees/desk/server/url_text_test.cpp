// Decoding of addresses and forms: RFC 3986 examples, what must be refused, and that encoding is undone by decoding.
#include "trainees/desk/server/url_text.h"
#include "trainees/desk/server/path_redaction.h"

#include <gtest/gtest.h>

#include <random>

namespace trocar::review::url_text_test {
namespace {

using Fields = std::map<std::string, std::string>;

TEST(UrlText, DecodesOnce) {
  EXPECT_EQ(percent_decoded("a%41%7ez", false), "aA~z");
  EXPECT_EQ(percent_decoded("%2541", false), "%41") << "decoded twice";
  EXPECT_EQ(percent_decoded("a+b%2Bc", true), "a b+c");
  EXPECT_EQ(percent_decoded("a+b", false), "a+b");
  EXPECT_EQ(percent_decoded("%C3%A4%E2%82%AC", false), "\xC3\xA4\xE2\x82\xAC");
}

TEST(UrlText, RefusesWhatCannotBeDecoded) {
  for (const char* text :
       {"%", "%4", "%4g", "%g4", "a%", "%00", "x%00y", "%1b", "%7f", "%ff", "%c3", "%c3%28", "%80"}) {
    EXPECT_FALSE(percent_decoded(text, false)) << text;
  }
  EXPECT_TRUE(percent_decoded("a%0D%0Ab%09", true)) << "text areas send line ends";
}

TEST(UrlText, EncodingIsUndone) {
  std::mt19937 random(7);
  for (int round = 0; round < 500; ++round) {
    std::string text;
    for (int i = 0; i < 20; ++i) text += static_cast<char>(0x20 + random() % 0x5f);
    const std::string encoded = percent_encoded(text);
    EXPECT_EQ(
        encoded.find_first_of("<>\"'&?#/ %+") == std::string::npos || encoded.find_first_not_of("<>\"'&?#/ +") == 0,
        true);
    EXPECT_EQ(percent_decoded(encoded, true), text);
  }
  EXPECT_EQ(percent_encoded("a/b c\xC3\xA4"), "a%2Fb%20c%C3%A4");
}

TEST(UrlText, ReadsForms) {
  EXPECT_EQ(form_fields("a=1&b=two+words&c=%3D%26&d&=x&a=2"),
            (Fields{{"a", "2"}, {"b", "two words"}, {"c", "=&"}, {"d", ""}, {"", "x"}}));
  EXPECT_EQ(form_fields(""), Fields{});
  EXPECT_EQ(form_fields("&&a=b=c&&"), (Fields{{"a", "b=c"}}));
  EXPECT_FALSE(form_fields("a=%zz"));
  EXPECT_FALSE(form_fields("%00=1"));
  EXPECT_TRUE(form_fields("a&b&c", 3));
  EXPECT_FALSE(form_fields("a&b&c&d", 3));
}

TEST(UrlText, LeadsNowhereElse) {
  EXPECT_TRUE(local_path("/trainee/T01?from=2026"));
  for (const char* text : {"", "x", "//evil.example/", "/\\evil.example", "http://evil.example/", "/a b",
                           "/a\r\nSet-Cookie: x=1", "/\xC3\xA4"}) {
    EXPECT_FALSE(local_path(text)) << text;
  }
  EXPECT_FALSE(local_path("/" + std::string(1000, 'a')));
  EXPECT_EQ(redirection_to("/a?b=c#d"), "/a?b=c#d");
  EXPECT_EQ(redirection_to("/a\r\nSet-Cookie: x=1"), "/a%0D%0ASet-Cookie:%20x=1");
  EXPECT_EQ(redirection_to("//evil.example"), "/");
  EXPECT_EQ(redirection_to("javascript:alert(1)"), "/");
  EXPECT_EQ(redirection_to("/\\evil.example"), "/%5Cevil.example");
}

TEST(UrlText, NamesDownloads) {
  EXPECT_EQ(download_name("cohort-2026.csv"), "cohort-2026.csv");
  EXPECT_EQ(download_name("../../etc/passwd"), "_._.._etc_passwd");
  EXPECT_EQ(download_name("a\"; x=\"b\r\nc"), "a___x__b__c");
  EXPECT_EQ(download_name(""), "download");
  EXPECT_EQ(download_name(std::string(300, 'a')).size(), 100U);
}

TEST(PathRedaction, KeepsNamesAndDropsFolders) {
  EXPECT_EQ(without_folders("/home/ida/data/trocar.db: no trainee \"T-9\""), "trocar.db: no trainee \"T-9\"");
  EXPECT_EQ(without_folders("cannot open \"/srv/x/t.recordings/1.trec\" (/tmp/a/b)"), "cannot open \"1.trec\" (b)");
  EXPECT_EQ(without_folders("/srv/my files/t.db: full; see /srv/my files/t.recordings/1.trec", "/srv/my files/t.db"),
            "t.db: full; see t.recordings/1.trec");
  EXPECT_EQ(without_folders("/srv/x/"), "");
}

TEST(PathRedaction, LeavesWhatIsNoFolder) {
  for (const std::string text :
       {"", "81.5 / 100", "1/2 of it", "and/or", "/curriculum", "3 m/s, N/m", "2026-01-01T10:00:00Z"}) {
    EXPECT_EQ(without_folders(text), text);
    EXPECT_EQ(without_folders(text, "t.db"), text);
  }
}

TEST(FormFields, LinesEndOneWayWhateverTheBrowserSends) {
  const auto fields = form_fields("text=one%0D%0Atwo%0Dthree%0Afour%0D%0A");
  ASSERT_TRUE(fields);
  EXPECT_EQ(fields->at("text"), "one\ntwo\nthree\nfour\n");
}

}  // namespace
}  // namespace trocar::review::url_text_test
