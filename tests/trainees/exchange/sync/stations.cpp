#include "tests/trainees/exchange/sync/stations.h"

#include "trainees/exchange/sync/central_logins.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar::test {
namespace {

std::string next_name() {
  static int count = 0;
  return "c" + std::to_string(++count);
}

}  // namespace

void Stations::SetUp() {
  if (!server_.installed()) GTEST_SKIP() << server_.reason();
  ASSERT_EQ(server_.reason(), "");
  central_ = another_central();
}

CentralAddress Stations::another_central() {
  const CentralAddress made = server_.make_database(next_name());
  set_up_central(made);
  return admitted(made, "any_" + next_name(), "desk");
}

CentralAddress Stations::admitted(const CentralAddress& central, const std::string& login, const std::string& kind) {
  const std::filesystem::path password = folder_ / (login + ".password");
  EXPECT_TRUE(admit_login(server_.owner_of(central), {login, kind, "", password}));
  return server_.as(central, login, password);
}

CentralAddress Stations::backup_of_central() {
  CentralAddress copy = central_;
  const std::string copied = server_.copy_database(central_, next_name()).url, own = central_.url;
  copy.url = copied.substr(0, copied.find('?')) + own.substr(own.find('?'));
  return copy;
}

PushReport Stations::push_named(Database& database, const std::string& name) {
  PushOptions options{central_};
  options.station_name = name;
  options.with_identity = true;
  return push_to_central(database, options);
}

Database Stations::desk(const std::string& name) {
  Database database = station(name);
  EXPECT_EQ(replicate_central(database, central_).problems, std::vector<std::string>{});
  EXPECT_EQ(problems_of(database), "");
  return database;
}

std::string Stations::trainee_uuid(Database& database, const std::string& code) const {
  sql::Statement row(database.connection(), "SELECT uuid FROM known_trainee WHERE code = ?");
  return row.bind(code).step() ? row.text(0) : "";
}

void Stations::practise(Database& database, const std::string& code, int attempts) {
  AssessmentStore assessments(database);
  for (int i = 0; i < attempts; ++i) {
    AttemptStart start = sample_start(code);
    start.seed = i;
    const AttemptId id = store_attempt(database, start, sample_result(60 + i));
    if (i > 0) continue;
    assessments.add_note(code, id.uuid,
                         "Keep the left hand still: \xc3\xbc"
                         "ben \"jetzt\"\n\\n",
                         kTeacher);
    assessments.add_rating(id.uuid, "GOALS", "efficiency", 1.0 / 3, kTeacher);
    assessments.sign(id.uuid, "approval", "", kTeacher);
    assessments.override_verdict(id.uuid, true, "The camera was knocked", kTeacher);
    if (assessments.certificates_of(code).empty())
      assessments.certify(code, "surface-touch", "L1", "1", "{}", kTeacher);
  }
}

PushReport Stations::push(Database& database, const std::string& name) {
  PushOptions options{central_};
  options.station_name = name;
  return push_to_central(database, options);
}

std::string Stations::one(const std::string& sql) const {
  const auto rows = ask(sql);
  return rows.size() == 1 ? rows.front() : std::to_string(rows.size()) + " rows";
}

std::vector<std::string> Stations::everything(const CentralAddress& central) const {
  std::string union_of;
  for (const std::string& table : server_.ask(
           central,
           "SELECT table_name FROM information_schema.tables WHERE table_schema = 'trocar'"
           " AND table_name NOT IN ('central', 'head', 'login') AND table_name NOT LIKE 'own\\_%' ORDER BY 1")) {
    union_of +=
        (union_of.empty() ? "" : " UNION ALL ") + std::string("SELECT '") + table +
        " ' || (to_jsonb(t) - 'received' - 'first_seen' - 'last_seen' - 'seq' - 'login')::text AS line FROM \"" +
        table + "\" t";
  }
  return server_.ask(central, union_of + " ORDER BY line");
}

}  // namespace trocar::test
