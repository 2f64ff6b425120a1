// Addresses, passwords, and centres that are not to be had.
#include <sys/stat.h>

#include <algorithm>
#include <fstream>

#include "tests/trainees/exchange/sync/stations.h"
#include "trainees/exchange/sync/carried_rows.h"
#include "trainees/exchange/sync/central_address.h"
#include "trainees/integrity/sealed_rows.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar::address_test {
namespace {

using sync::connection_text;
using test::Stations;

class Address : public TemporaryFolder {
 protected:
  std::filesystem::path password(const std::string& text, mode_t mode) const {
    const auto file = folder_ / "password";
    std::ofstream(file) << text;
    chmod(file.c_str(), mode);
    return file;
  }
  static std::string refusal(const CentralAddress& address) {
    return message_of<InputError>([&] { connection_text(address); });
  }
};

TEST_F(Address, HoldsNoPassword) {
  EXPECT_NE(refusal({"postgresql://trocar:secret@central/trocar"}).find("holds a password"), std::string::npos);
  EXPECT_NE(refusal({"postgresql://central/trocar?user=a&password=secret"}).find("holds a password"),
            std::string::npos);
  EXPECT_EQ(refusal({"postgresql://trocar:secret@central/trocar"}).find("secret"), std::string::npos);
  EXPECT_EQ(refusal({"postgresql://trocar@central:5433/trocar"}), "");
  EXPECT_EQ(refusal({"postgres://[2001:db8::1]:5433/trocar"}), "");
}

TEST_F(Address, IsPostgresql) {
  for (const char* url : {"", "central", "mysql://central/x", "host=central dbname=x", "sqlite:///x"}) {
    EXPECT_NE(refusal({url}).find("begins with postgresql://"), std::string::npos) << url;
  }
}

TEST_F(Address, GetsTimeOutsUnlessItHasThem) {
  const std::string plain = connection_text({"postgresql://localhost/trocar"});
  EXPECT_NE(plain.find("/trocar?connect_timeout=10&"), std::string::npos) << plain;
  const std::string given = connection_text({"postgresql://localhost/trocar?connect_timeout=3"});
  EXPECT_EQ(given.find("connect_timeout=10"), std::string::npos) << given;
  EXPECT_NE(given.find("tcp_user_timeout=30000"), std::string::npos) << given;
}

TEST_F(Address, BeyondThisMachineProvesWhoAnswers) {
  for (const char* url :
       {"postgresql://central/t", "postgresql://10.0.0.7/t", "postgresql:///t?host=central",
        "postgresql://localhost,central/t", "postgresql://127.0.0.1.central.example/t", "postgresql:///t?service=x",
        "postgresql://central/t?hostaddr=127.0.0.1", "postgresql://localhost/t?hostaddr=10.0.0.7",
        "postgresql://[2001:db8::1]/t", "postgresql://%63entral/t"}) {
    EXPECT_NE(connection_text({url}).find("&sslmode=verify-full&gssencmode=disable"),
              connection_text({url}).find("?sslmode=verify-full&gssencmode=disable"))
        << url;
    const std::string weak = std::string(url) + (std::string(url).find('?') == std::string::npos ? "?" : "&");
    for (const std::string mode : {"disable", "prefer", "require", "verify-ca"}) {
      const CentralAddress address{weak + "sslmode=" + mode};
      EXPECT_NE(refusal(address).find("sslmode=" + mode + " does not check"), std::string::npos) << refusal(address);
      EXPECT_NE(refusal(address).find("--allow-weak-tls"), std::string::npos);
      const CentralAddress allowed{address.url, {}, true};
      EXPECT_EQ(refusal(allowed), "") << address.url;
      EXPECT_NE(sync::weak_tls_remark(allowed).find("sslmode=" + mode), std::string::npos) << address.url;
    }
    EXPECT_EQ(sync::weak_tls_remark({url}), "");
  }
  for (const char* url :
       {"postgresql:///t", "postgresql://localhost/t", "postgresql://127.8.0.1/t", "postgresql://[::1]/t",
        "postgresql:///t?host=/run/postgresql", "postgresql://localhost:5433,127.0.0.1/t?sslmode=disable"}) {
    EXPECT_EQ(connection_text({url}).find("sslmode=verify-full"), std::string::npos) << url;
    EXPECT_EQ(sync::weak_tls_remark({url}), "") << url;
  }
}

TEST_F(Address, TakesThePasswordFromAFileThatOthersCannotRead) {
  EXPECT_NE(connection_text({"postgresql://c/t", password("a?&\nsecond line", 0600)}).find("password=%61%3F%26&"),
            std::string::npos);
  EXPECT_NE(refusal({"postgresql://c/t", password("x", 0644)}).find("chmod 600"), std::string::npos);
  EXPECT_NE(refusal({"postgresql://c/t", password("", 0600)}).find("is empty"), std::string::npos);
  EXPECT_NE(refusal({"postgresql://c/t", folder_ / "none"}).find("no such file"), std::string::npos);
}

TEST_F(Address, ThatNobodyAnswersIsTheMachinesFault) {
  Database database(folder_ / "a.db");
  const PushOptions options{{"postgresql:///trocar?host=" + folder_.string() + "&user=trocar"}};
  EXPECT_NE(message_of<EnvironmentError>([&] { push_to_central(database, options); }).find("cannot be reached"),
            std::string::npos);
}

TEST(CarriedRows, AreTheSealedOnesInTheirOrder) {
  std::vector<std::string> names;
  for (const sync::CarriedTable& table : sync::carried_sealed()) names.push_back(table.name);
  EXPECT_EQ(names, sealed_tables());
}

TEST(CarriedRows, TakeEveryColumnOfTheTablesHere) {
  Database database(":memory:");
  std::vector<sync::CarriedTable> all = sync::carried_sealed();
  all.insert(all.end(), sync::carried_of_attempt().begin(), sync::carried_of_attempt().end());
  all.insert(all.end(), sync::carried_bases().begin(), sync::carried_bases().end());
  all.push_back(sync::carried_attempt());
  all.push_back(sync::carried_person());
  for (const sync::CarriedTable& table : all) {
    std::vector<std::string> here, carried;
    sql::Statement columns(database.connection(),
                           "SELECT name, type FROM pragma_table_info(?) WHERE (name <> 'id' OR type = 'TEXT')"
                           " AND name <> 'salt' ORDER BY 1");  // of the trail here alone
    columns.bind(table.name);
    while (columns.step()) here.push_back(columns.text(0));
    for (const sync::Column& column : table.columns) carried.push_back(column.local);
    std::sort(carried.begin(), carried.end());
    EXPECT_EQ(carried, here) << table.name;
  }
}

TEST_F(Stations, AWrongPasswordIsNotLetIn) {
  const auto file = folder_ / "wrong";
  std::ofstream(file) << "wrong\n";
  chmod(file.c_str(), 0600);
  Database database = station("a");
  const PushOptions options{{central_.url, file}};
  const std::string message = message_of<EnvironmentError>([&] { push_to_central(database, options); });
  EXPECT_NE(message.find("password authentication failed"), std::string::npos) << message;
}

TEST_F(Stations, ANewerCentreIsLeftAsItIs) {
  Database database = station("a");
  practise(database, "T-a", 1);
  push(database);
  ask("UPDATE central SET version = 99 RETURNING 1");
  practise(database, "T-a", 1);
  const auto before = everything();
  const std::string message = message_of<EnvironmentError>([&] { push(database); });
  EXPECT_NE(message.find("newer trocar (schema 99, this program knows up to 5)"), std::string::npos) << message;
  EXPECT_EQ(everything(), before);
}

TEST_F(Stations, AStationKeepsItsNameUntilToldOtherwise) {
  Database database = station("a");
  const PushReport first = push(database, "theatre 3");
  EXPECT_EQ(push(database).name, "theatre 3");
  const PushReport renamed = push(database, "theatre 4");
  EXPECT_EQ(renamed.station, first.station);
  EXPECT_EQ(one("SELECT name FROM station"), "theatre 4");
  EXPECT_NE(message_of<InputError>([&] { push(database, std::string(65, 'x')); }), "");
  EXPECT_EQ(database.check(), std::vector<std::string>{});
}

}  // namespace
}  // namespace trocar::address_test
