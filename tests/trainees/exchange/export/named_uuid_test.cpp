// Version 5 of RFC 9562 against its own examples.
#include "trainees/exchange/export/named_uuid.h"
#include "tests/trainees/exchange/export/export_samples.h"
#include "trainees/exchange/export/xapi_terms.h"

namespace trocar::named_uuid_test {
namespace {

constexpr const char* kDns = "6ba7b810-9dad-11d1-80b4-00c04fd430c8";
constexpr const char* kUrl = "6ba7b811-9dad-11d1-80b4-00c04fd430c8";

TEST(NamedUuid, AgreesWithTheStandardsExamples) {
  EXPECT_EQ(named_uuid(kDns, "www.example.com"), "2ed6657d-e927-568b-95e1-2665a8aea6a2");  // RFC 9562, A.4
  EXPECT_EQ(named_uuid(kDns, "python.org"), "886313e1-3b8a-5372-9b90-0c9aee199e5d");  // uuid5 of Python's documentation
  EXPECT_EQ(named_uuid(kUrl, "http://python.org/"), "4c565f0d-3f5a-5890-b41b-20cf47701c5e");
}

TEST(NamedUuid, DependsOnNamespaceAndName) {
  const std::string one = named_uuid(kDns, "a");
  EXPECT_EQ(one, named_uuid(kDns, "a"));
  EXPECT_NE(one, named_uuid(kDns, "b"));
  EXPECT_NE(one, named_uuid(kUrl, "a"));
  EXPECT_EQ(one, named_uuid("6BA7B810-9DAD-11D1-80B4-00C04FD430C8", "a")) << "case of the digits means nothing";
  EXPECT_TRUE(xapi::is_uuid(one));
  EXPECT_EQ(one[14], '5');
}

TEST(NamedUuid, RefusesWhatIsNoNamespace) {
  for (const char* bad : {"", "x", "6ba7b810-9dad-11d1-80b4-00c04fd430c", "6ba7b8109dad11d180b400c04fd430c8",
                          "6ba7b810-9dad-11d1-80b4-00c04fd430cg", "6ba7b810-9dad-11d1-80b4-00c04fd430c8 "}) {
    EXPECT_THROW(named_uuid(bad, "a"), InputError) << bad;
  }
}

}  // namespace
}  // namespace trocar::named_uuid_test
