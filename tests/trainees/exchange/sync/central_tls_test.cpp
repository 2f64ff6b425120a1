// Who answers is proved, or nothing goes: against a PostgreSQL that speaks TLS with a certificate of an authority of
// the test's own.
#include <fstream>

#include "tests/trainees/exchange/sync/stations.h"

namespace trocar::central_tls_test {
namespace {

using test::Stations;

class CentralTls : public Stations {
 protected:
  std::string refusal(const std::string& host, const std::string& more) {
    Database database = station("a");
    return message_of<EnvironmentError>(
        [&] { push_to_central(database, {server_.over_network(central_, host, more)}); });
  }
  void expect_refusal(const std::string& host, const std::string& more, const std::string& why) {
    const std::string told = refusal(host, more);
    EXPECT_NE(told.find(why), std::string::npos) << host << " " << more << ": " << told;
    EXPECT_EQ(told.find("Either provide"), std::string::npos) << told;
  }
};

TEST_F(CentralTls, TheRightAuthorityAndNameAreLetInAndNothingElseIs) {
  const std::string root = "&sslrootcert=" + server_.speak_tls().string();
  EXPECT_EQ(refusal("central.test", root), "");
  EXPECT_EQ(one("SELECT count(*) FROM station"), "1");
  const std::filesystem::path other = server_.folder() / "other.crt";
  std::filesystem::copy_file(server_.folder() / "ca.crt", other);
  server_.speak_tls();  // another authority of the same name
  expect_refusal("central.test", "&sslrootcert=" + other.string(), "is not signed by the root certificate here");
  expect_refusal("another.test", root, "its certificate is for another name");
  expect_refusal("central.test", "&sslrootcert=" + (folder_ / "none.crt").string(), "no root certificate to check");
  std::ofstream(folder_ / "bad.crt") << "none\n";
  expect_refusal("central.test", "&sslrootcert=" + (folder_ / "bad.crt").string(), "cannot be read");
  server_.speak_no_tls();
  expect_refusal("central.test", root, "it speaks no TLS");
}

TEST_F(CentralTls, WhoAsksForLessIsLetInAndWarned) {
  server_.speak_tls();
  Database database = station("a");
  CentralAddress weak = server_.over_network(central_, "central.test", "&sslmode=require");
  EXPECT_NE(message_of<InputError>([&] { push_to_central(database, {weak}); }), "");
  weak.weak_tls = true;
  const PushReport report = push_to_central(database, {weak});
  ASSERT_FALSE(report.remarks.empty());
  EXPECT_NE(report.remarks[0].find("sslmode=require: nobody checks"), std::string::npos) << report.remarks[0];
  server_.speak_no_tls();
}

}  // namespace
}  // namespace trocar::central_tls_test
