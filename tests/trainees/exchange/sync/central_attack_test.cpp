// What somebody with a station's password may try at the central database, past this program: nothing of others' is
// changed, nothing comes in another's name, and what his own station says differently shows.
#include <pqxx/pqxx>

#include <fstream>

#include "tests/trainees/exchange/sync/stations.h"
#include "trainees/exchange/sync/central_address.h"
#include "trainees/exchange/sync/central_logins.h"
#include "trainees/integrity/audit.h"
#include "trainees/integrity/sealed_rows.h"
#include "trainees/records/accounts.h"
#include "trainees/records/attempt_identity.h"
#include "trainees/records/consents.h"
#include "trainees/records/curricula.h"
#include "trainees/records/erasure.h"
#include "trainees/records/programmes.h"
#include "trainees/records/standings.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar::central_attack_test {
namespace {

using test::kTeacher;
using test::Stations;
using Lines = std::vector<std::string>;

class CentralAttack : public Stations {
 protected:
  void SetUp() override {
    Stations::SetUp();
    if (IsSkipped()) return;
    north_ = admitted(central_, "north_" + database_name(), "station");
    south_ = admitted(central_, "south_" + database_name(), "station");
    for (const auto& [name, login] : {std::pair{"north", north_}, std::pair{"south", south_}}) {
      Database database = station(name);
      practise(database, std::string("T-") + name, 2);
      ConsentStore(database).record(std::string("T-") + name, "research", true, "I agree.", kTeacher);
      const PushReport report = come(database, login, name);
      EXPECT_TRUE(report.conflicts.empty() && report.problems.empty() && report.remarks.empty());
    }
    own_ = one("SELECT uuid FROM station WHERE name = 'south'");
    other_ = one("SELECT uuid FROM station WHERE name = 'north'");
    attempt_ = one("SELECT uuid FROM attempt WHERE station = '" + other_ + "' AND chain_position = 1");
    trainee_ = one("SELECT DISTINCT trainee_uuid FROM attempt WHERE station = '" + other_ + "'");
  }
  std::string database_name() const {
    const std::size_t start = std::string("postgresql:///").size();
    return central_.url.substr(start, central_.url.find('?') - start);
  }
  static PushReport come(Database& database, const CentralAddress& as, const std::string& name = "") {
    PushOptions options{as};
    options.station_name = name;
    options.with_identity = true;
    return push_to_central(database, options);
  }
  /// What the server says to a statement of the south; "" when it does it.
  std::string attack(const std::string& sql) const {
    try {
      pqxx::connection connection(sync::connection_text(south_));
      pqxx::nontransaction transaction(connection);
      transaction.exec("SET search_path TO trocar");
      for (const auto& row : transaction.exec(sql)) last_ = row.empty() || row[0].is_null() ? "" : row[0].c_str();
    } catch (const pqxx::failure& error) {
      return error.what();
    }
    return "";
  }
  std::string filled(std::string text) const {
    for (const auto& [word, value] : {std::pair{"OWN", own_}, std::pair{"OTHER", other_},
                                      std::pair{"ATTEMPT", attempt_}, std::pair{"TRAINEE", trainee_}}) {
      for (std::size_t at = 0; (at = text.find(word, at)) != std::string::npos; at += value.size())
        text.replace(at, std::string(word).size(), value);
    }
    return text;
  }
  /// SQL that adds an entry to the south's trail which goes on from what is there.
  std::string one_more_entry(const std::string& action, const std::string& subject, const std::string& detail) const {
    const std::string words = "'', '', '" + action + "', '" + subject + "', '" + detail + "'";
    return "INSERT INTO audit (station, position, utc, actor, action, subject, detail, prev_hash, row_hash) SELECT"
           " station, position + 1, " +
           words +
           ", row_hash, encode(sha256(convert_to(concat_ws(E'\\n',"
           " 'trocar-audit-1', row_hash, position + 1, " +
           words + "), 'UTF8')), 'hex') FROM audit WHERE station = '" + own_ + "' ORDER BY position DESC LIMIT 1";
  }
  std::vector<std::string> all() const {
    std::vector<std::string> lines = everything();
    for (const char* table : {"head", "login"})
      for (const std::string& line : ask(std::string("SELECT to_jsonb(t)::text FROM ") + table + " t ORDER BY 1"))
        lines.push_back(line);
    return lines;
  }
  CentralAddress north_, south_;
  std::string own_, other_, attempt_, trainee_;
  mutable std::string last_;  ///< first value of the last row
};

TEST_F(CentralAttack, NothingIsChangedTakenAwayOrWrittenInAnothersName) {
  const Lines before = all();
  const char* audit = "INSERT INTO audit (station, position, utc, actor, action, subject, detail, prev_hash, row_hash";
  for (const std::string& sql : std::initializer_list<std::string>{
           "UPDATE score SET value = 100, passed = 1", "UPDATE attempt SET status = 'void' WHERE station = 'OWN'",
           "DELETE FROM attempt WHERE station = 'OTHER'", "DELETE FROM audit", "DELETE FROM conflict",
           "TRUNCATE attempt", "DROP TABLE event", "DROP SCHEMA trocar CASCADE",
           "ALTER TABLE attempt ADD COLUMN mine text", "ALTER TABLE attempt DISABLE ROW LEVEL SECURITY",
           "ALTER TABLE attempt DISABLE TRIGGER ALL", "ALTER TABLE attempt OWNER TO CURRENT_USER",
           "DROP POLICY brings ON attempt", "CREATE POLICY mine ON attempt FOR UPDATE USING (true)",
           "CREATE TABLE trocar.mine (x text)", "CREATE FUNCTION trocar.mine() RETURNS int LANGUAGE sql AS 'SELECT 1'",
           "CREATE OR REPLACE FUNCTION trocar.is_owner() RETURNS boolean LANGUAGE sql AS 'SELECT true'",
           "CREATE TRIGGER mine BEFORE INSERT ON attempt FOR EACH ROW EXECUTE FUNCTION erase()",
           "CREATE RULE mine AS ON INSERT TO attempt DO INSTEAD NOTHING",
           "GRANT UPDATE ON score TO CURRENT_USER; UPDATE score SET value = 100", "SET ROLE trocar",
           "SET SESSION AUTHORIZATION trocar", "SET session_replication_role = replica", "CREATE ROLE mine SUPERUSER",
           "SELECT setval('arrival', 1)", "COPY audit FROM PROGRAM 'id'", "COPY audit (station, position) FROM STDIN",
           "UPDATE central SET revision = 0", "UPDATE station SET last_position = 0",
           "INSERT INTO station (uuid, name, login) VALUES ('x', 'x', 'x')",
           "INSERT INTO login (name, kind) VALUES (session_user, 'desk')", "UPDATE login SET kind = 'desk'",
           // in the name of another station, or of another login
           std::string(audit) + ") VALUES ('OTHER', 9999, '', '', 'note added', '', '', '', '')",
           std::string(audit) + ", login) VALUES ('OWN', 9999, '', '', '', '', '', '', '', 'north')",
           std::string(audit) + ", received) VALUES ('OWN', 9999, '', '', '', '', '', '', '', now())",
           std::string(audit) + ", seq) VALUES ('OWN', 9999, '', '', '', '', '', '', '', 1)",
           "INSERT INTO attempt (uuid, trainee_uuid, station) VALUES ('x', 'TRAINEE', 'OTHER')",
           "SELECT announce('OTHER', 'mine now')", "SELECT advance('OTHER', 1000000)",
           "SELECT keep_people('OTHER', '[]')",
           // more rows for an attempt that is there, of another's or of one's own
           "INSERT INTO event (attempt_uuid, position, station) VALUES ('ATTEMPT', 999, 'OWN')",
           "INSERT INTO event (attempt_uuid, position, station) SELECT uuid, 999, 'OWN' FROM attempt WHERE"
           " station = 'OWN'",
           "INSERT INTO metric (attempt_uuid, name, value, station) VALUES ('ATTEMPT', 'mine', 1, 'OWN')",
           // decisions on others' people
           "INSERT INTO verdict_override (uuid, attempt_uuid, passed, digest, station) VALUES ('x', 'ATTEMPT', 1, '',"
           " 'OWN')",
           "INSERT INTO signature (uuid, attempt_uuid, digest, station) VALUES ('x', 'ATTEMPT', '', 'OWN')",
           "INSERT INTO certificate (uuid, trainee_uuid, digest, station) VALUES ('x', 'TRAINEE', '', 'OWN')",
           "INSERT INTO revocation (uuid, certificate_uuid, digest, station) SELECT 'x', uuid, '', 'OWN' FROM"
           " certificate WHERE station = 'OTHER'",
           "INSERT INTO note (uuid, trainee_uuid, text, digest, station) VALUES ('x', 'TRAINEE', 'x', '', 'OWN')",
           "INSERT INTO standing (uuid, trainee_uuid, active, digest, station) VALUES ('x', 'TRAINEE', 0, '', 'OWN')",
           "INSERT INTO assignment (uuid, trainee_uuid, programme, digest, station) VALUES ('x', 'TRAINEE', 'x', '',"
           " 'OWN')",
           "INSERT INTO assignment (uuid, group_name, programme, digest, station) VALUES ('x', 'monday', 'x', '',"
           " 'OWN')",
           "INSERT INTO withdrawal (uuid, assignment_uuid, digest, station) SELECT 'x', uuid, '', 'OWN' FROM"
           " assignment UNION SELECT 'y', 'y', '', 'OWN'",
           "INSERT INTO erasure (uuid, trainee_uuid, kind, digest, station) VALUES ('x', 'TRAINEE', 'training', '',"
           " 'OWN')",
           "INSERT INTO person_link (one, other, linked, author, utc) VALUES ('a', 'b', true, 'me', '')",
           // attempts of another's person, their notes as met, rows that no program writes, versions without end
           "INSERT INTO attempt (uuid, trainee_uuid, station) VALUES ('01890000-0000-7000-8000-000000000000',"
           " 'TRAINEE', 'OWN')",
           "INSERT INTO attempt (uuid, trainee_uuid, station) SELECT 'zz', uuid, 'OWN' FROM trainee WHERE station ="
           " 'OWN' LIMIT 1",
           "INSERT INTO note_seen (note_uuid, utc, station) VALUES ('x', '2026-01-01T00:00:00.000Z', 'OWN')",
           "INSERT INTO note_seen (note_uuid, utc, station) SELECT uuid, '2026-01-01T00:00:00.000Z', 'OWN' FROM note"
           " WHERE trainee_uuid = 'TRAINEE' UNION SELECT 'y', '', 'OWN'",
           "INSERT INTO trainee (uuid, created_utc, station) VALUES ('zz', 'x', 'OWN')",
           "INSERT INTO curriculum (uuid, name, version, sha256, toml, author, utc, digest, station) VALUES ('x',"
           " 'standard', 2147483647, '', '', '', '', '', 'OWN')",
           "INSERT INTO person (trainee_uuid, code, station) VALUES ('x', 'x', 'OWN')",
           "INSERT INTO recording (sha256, attempt_uuid, bytes, chunks, station) VALUES ('x', 'ATTEMPT', 1, 1, 'OWN')",
           "INSERT INTO recording_chunk (sha256, position, data) VALUES ('x', 0, 'x')",
           // the witness
           "UPDATE head SET row_hash = ''", "DELETE FROM head",
           "INSERT INTO head (station, position, row_hash, utc, key, signature) VALUES ('OTHER', 9999, '', '', '',"
           " '')"}) {
    EXPECT_NE(attack(filled(sql)), "") << filled(sql);
  }
  EXPECT_EQ(all(), before);
}

TEST_F(CentralAttack, WhatItMayCallDoesNothingToOthers) {
  const Lines before = all();
  for (const char* call :
       {"SELECT erase()", "SELECT touch()", "SELECT advance('OWN', 0)",
        "SELECT keep_people('OWN', '[{\"trainee_uuid\": \"TRAINEE\", \"code\": \"mine\", \"name\": \"\","
        " \"email\": \"\"}]')",
        "SELECT complete_recording('x')"})
    EXPECT_EQ(attack(filled(call)), "") << call;
  EXPECT_EQ(all(), before);
}

TEST_F(CentralAttack, NamesNotesAndConsentsOfOtherStationsAreNotSeen) {
  Database north = station("north");
  StandingStore(north).set_active({"T-north"}, false, "ill", kTeacher);
  come(north, north_);
  EXPECT_EQ(one("SELECT count(*) FROM standing"), "1");
  EXPECT_NE(one("SELECT count(*) FROM signature WHERE station = '" + other_ + "'"), "0");
  EXPECT_EQ(attack("SELECT count(*) FROM person WHERE code = 'T-south'"), "");
  EXPECT_EQ(last_, "1");
  for (const char* hidden : {"SELECT count(*) FROM person WHERE code = 'T-north'",
                             "SELECT count(*) FROM consent WHERE trainee_uuid = 'TRAINEE'",
                             "SELECT count(*) FROM note WHERE trainee_uuid = 'TRAINEE'",
                             "SELECT count(*) FROM standing", "SELECT count(*) FROM rating WHERE station = 'OTHER'",
                             "SELECT count(*) FROM signature WHERE station = 'OTHER'"}) {
    EXPECT_EQ(attack(filled(hidden)), "");
    EXPECT_EQ(last_, "0") << hidden;
  }
}

TEST_F(CentralAttack, ARecordingStaysWithTheAttemptThatNamedItFirst) {
  ask("UPDATE attempt SET recording_sha256 = repeat('a', 64) WHERE uuid = '" + attempt_ + "' RETURNING 1");
  const std::string mine =
      "INSERT INTO attempt (uuid, trainee_uuid, recording_sha256, station) SELECT"
      " '01890000-0000-7000-8000-00000000000' || number, uuid, repeat(letter, 64), 'OWN' FROM"
      " trainee, (VALUES ('1', 'a'), ('2', 'b')) v (number, letter) WHERE station = 'OWN'";
  EXPECT_EQ(attack(filled(mine)), "");
  EXPECT_EQ(ask("SELECT recording_sha256 FROM attempt WHERE uuid LIKE '01890000%'"), Lines{std::string(64, 'b')});
  EXPECT_NE(
      attack(filled("INSERT INTO recording (sha256, attempt_uuid, bytes, chunks, station) VALUES (repeat('a', 64),"
                    " '01890000-0000-7000-8000-000000000001', 1, 1, 'OWN')")),
      "");
}

TEST_F(CentralAttack, AnErasureOfOnesOwnTakesNobodyElsesWords) {
  Database north = station("north");
  const Account own = AccountStore(north).add("nora", "Nora North", Role::kTrainee, "T-north", "580274", "");
  AssessmentStore(north).sign(attempt_, "authorship", "", {own.uuid, own.name});
  come(north, north_);
  const std::string signature = one("SELECT uuid FROM signature WHERE meaning = 'authorship'");
  Database south = station("south");
  erase_trainee(south, "T-south", ErasureKind::kIdentity, "request", {});
  come(south, south_);
  const std::string erasure = one("SELECT uuid FROM erasure");
  EXPECT_EQ(attack(one_more_entry("signature erased", signature, erasure)), "");
  EXPECT_EQ(attack("SELECT erase()"), "");
  EXPECT_EQ(one("SELECT count(*) FROM signature WHERE uuid = '" + signature + "'"), "1");
}

TEST_F(CentralAttack, EveryRowSaysWhichLoginBroughtIt) {
  for (const char* table : {"attempt", "audit", "note", "certificate", "head", "trainee"})
    EXPECT_EQ(
        ask(std::string("SELECT DISTINCT s.name || t.login FROM ") + table +
            " t JOIN station s ON s.uuid = t.station ORDER BY 1"),
        (Lines{"north" + std::string("north_") + database_name(), "south" + std::string("south_") + database_name()}))
        << table;
}

TEST_F(CentralAttack, AStationThatSaysSomethingOfAnothersPeopleIsToldAndTheRestGoesOn) {
  const CentralAddress desk = admitted(central_, "desk_" + database_name(), "desk");
  Database copy = station("copy");
  replicate_central(copy, desk);
  const std::string north = ask("SELECT uuid FROM attempt WHERE station = '" + other_ + "'").front();
  AssessmentStore(copy).override_verdict(north, false, "Seen on the film", kTeacher);
  PushOptions as_desk{desk};
  EXPECT_TRUE(push_to_central(copy, as_desk).conflicts.empty()) << "a desk decides on everybody";
  // A station's own desk cannot: the rest goes on, and the row is named until somebody settles it.
  ask("UPDATE login SET kind = 'station' WHERE name LIKE 'desk%' RETURNING 1");
  AssessmentStore(copy).override_verdict(north, true, "It was not so bad", kTeacher);
  CurriculumStore(copy).add("course", "name = \"x\"\n", kTeacher);
  for (int time = 0; time < 2; ++time) {
    const PushReport report = push_to_central(copy, as_desk);
    ASSERT_EQ(report.conflicts.size(), 1u);
    EXPECT_NE(report.conflicts[0].find("is about somebody of another station"), std::string::npos);
  }
  EXPECT_EQ(one("SELECT count(*) FROM curriculum"), "1");
  EXPECT_EQ(one("SELECT count(*) FROM verdict_override WHERE attempt_uuid = '" + north + "' AND passed = 1"),
            north == attempt_ ? "1" : "0");
}

TEST_F(CentralAttack, AStationDeactivatesAndAssignsItsOwnPeopleAndNoGroups) {
  Database south = station("south");
  CurriculumStore(south).join("T-south", "monday", kTeacher);
  ProgrammeStore programmes(south);
  programmes.save("Basics", "[[step]]\nexercise = \"surface-touch\"\nlevel = \"L1\"\n", kTeacher);
  const Assignment own = programmes.assign("Basics", "T-south", "", "", kTeacher);
  programmes.withdraw(own.uuid, "", kTeacher);
  StandingStore(south).set_active({"T-south"}, false, "", kTeacher);
  const PushReport report = come(south, south_);
  EXPECT_EQ(report.conflicts, Lines{});
  for (const char* table : {"standing", "assignment", "withdrawal"}) EXPECT_EQ(report.added.at(table), 1) << table;
  programmes.assign("Basics", "", "monday", "", kTeacher);
  const PushReport group = come(south, south_);
  ASSERT_EQ(group.conflicts.size(), 1u);
  EXPECT_NE(group.conflicts[0].find("or about a group"), std::string::npos) << group.conflicts[0];
}

TEST_F(CentralAttack, ARecordThatWasRewrittenOrPutBackIsFoundByItsWitness) {
  Database south = station("south");
  EXPECT_EQ(check_central_witness(south, south_), Lines{});
  south.backup(folder_ / "older.db");
  practise(south, "T-south", 1);
  come(south, south_);
  EXPECT_EQ(check_central_witness(south, south_), Lines{});
  Database older(folder_ / "older.db");
  const std::int64_t kept = audit_head(older.connection()).position;
  const Lines rolled_back = check_central_witness(older, south_);
  ASSERT_EQ(rolled_back.size(), 1u);
  EXPECT_NE(rolled_back[0].find("an older copy was put back"), std::string::npos) << rolled_back[0];
  EXPECT_NE(rolled_back[0].find("station south"), std::string::npos) << rolled_back[0];
  EXPECT_NE(rolled_back[0].find("the same up to entry " + std::to_string(kept)), std::string::npos) << rolled_back[0];
  EXPECT_NE(message_of<InputError>([&] { come(older, south_); }).find("is not the one that was pushed"),
            std::string::npos);
  // Another record in its place, with a key and a name of its own: the login gives it away.
  Database another = station("another");
  practise(another, "T-south", 9);
  const Lines replaced = check_central_witness(another, south_);
  ASSERT_EQ(replaced.size(), 1u);
  EXPECT_NE(replaced[0].find("is another: the record was rewritten"), std::string::npos) << replaced[0];
  const PushReport report = come(another, south_, "south");
  ASSERT_EQ(report.told.size(), 1u);
  EXPECT_NE(report.told[0].find("this login pushed as station south"), std::string::npos) << report.told[0];
}

TEST_F(CentralAttack, WhatIsAddedToItsOwnTrailShowsAtItsNextPush) {
  for (const char* entry : {"1000, '', ''", "1000, '', repeat('0', 64)", "1, '', ''"})
    EXPECT_NE(attack(filled("INSERT INTO audit (station, utc, actor, action, subject, detail, position, prev_hash,"
                            " row_hash) VALUES ('OWN', '', '', '', '', '', " +
                            std::string(entry) + ")")),
              "")
        << entry;
  const std::string head = one("SELECT max(position) + 1 FROM audit WHERE station = '" + own_ + "'");
  EXPECT_EQ(attack(one_more_entry("note added", "", "")), "");
  Database south = station("south");
  const std::string told = message_of<InputError>([&] { come(south, south_); });
  EXPECT_NE(told.find("is not the one that was pushed, at position " + head), std::string::npos) << told;
}

TEST_F(CentralAttack, OnlyADeskSaysWhoIsTheSamePerson) {
  const auto link = [&](const CentralAddress& as) { link_people(as, "T-north@north", "T-south@south", true, "me"); };
  EXPECT_NE(message_of<InputError>([&] { link(south_); }).find("only a desk's login"), std::string::npos);
  link(admitted(central_, "desk_" + database_name(), "desk"));
  EXPECT_EQ(one("SELECT count(*) FROM holding_link"), "1");
}

TEST_F(CentralAttack, AFalseHeadIsKnownByItsSignature) {
  Database south = station("south");
  const std::string insert = "INSERT INTO head (station, position, row_hash, utc, key, signature) SELECT station, ";
  EXPECT_NE(attack(insert + "9999, '', '', '', '' FROM head WHERE station = '" + own_ + "'"), "");
  EXPECT_EQ(attack(insert +
                   "2, (SELECT row_hash FROM audit a WHERE a.station = h.station AND a.position = 2), utc, key,"
                   " repeat('0', 128) FROM head h WHERE station = '" +
                   own_ + "'"),
            "");
  const Lines told = check_central_witness(south, south_);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_NE(told[0].find("entry 2 bears no signature of its key"), std::string::npos) << told[0];
}

TEST_F(CentralAttack, ARecordThatWasNeverPushedHasNoWitness) {
  Database fresh = station("fresh");
  const Lines told = check_central_witness(fresh, admitted(central_, "fresh_" + database_name(), "station"));
  ASSERT_EQ(told.size(), 1u);
  EXPECT_NE(told[0].find("has no head of this record"), std::string::npos) << told[0];
}

TEST_F(CentralAttack, RowsThatNoProgramWritesDoNotComeIn) {
  const Lines before = all();
  const std::string curriculum =
      "INSERT INTO curriculum (name, version, sha256, toml, author, utc, digest, station, uuid) VALUES ('course', 1, "
      "'',"
      " '', '', '', '', 'OWN', ";
  for (const std::string& sql : std::initializer_list<std::string>{
           "INSERT INTO ruleset (sha256, exercise_id, version, toml, station) VALUES ('x', 'surface-touch', '1', '',"
           " 'OWN')",
           "INSERT INTO ruleset (sha256, exercise_id, version, toml, station) VALUES (encode(sha256('x'), 'hex'),"
           " 'nothing', '1', 'x', 'OWN')",
           "INSERT INTO ruleset (sha256, exercise_id, toml, station) VALUES (encode(sha256('x'), 'hex'),"
           " 'surface-touch', 'x', 'OWN')",
           "INSERT INTO exercise (id, number, station) VALUES ('x', '1', 'OWN')",
           "INSERT INTO exercise (id, number, title, station) VALUES (E'x\ty', '1', 'x', 'OWN')",
           "INSERT INTO trainee (uuid, station) VALUES ('01890000-0000-7000-8000-000000000000', 'OWN')",
           curriculum + "'ffffffff-ffff-7fff-bfff-ffffffffffff')",
           curriculum + "'0fffffff-ffff-7fff-8000-000000000000')",
           curriculum + "'01890000-0000-4000-8000-000000000000')", curriculum + "'zz')"}) {
    EXPECT_NE(attack(filled(sql)), "") << filled(sql);
  }
  EXPECT_EQ(all(), before);
  EXPECT_EQ(attack(filled(curriculum + "'01890000-0000-7000-8000-000000000000')")), "") << "all else about it is right";
}

/// What was there before the centre refused it, and what it cannot know.
TEST_F(CentralAttack, RowsThatNobodyCanTakeStopNobody) {
  ask(
      filled("INSERT INTO ruleset (sha256, exercise_id, version, toml, station) VALUES ('x', 'nothing', '1', '',"
             " 'OWN')"));
  ask(filled("INSERT INTO exercise (id, number, title, station) VALUES (E'two\nlines', '', '', 'OWN')"));
  ask(filled("INSERT INTO trainee (uuid, station) VALUES ('01890000-0000-7000-8000-000000000000', 'OWN')"));
  for (const char* one : {"1", "2", "3"}) {
    const std::string uuid = std::string("'0189000") + one + "-0000-7000-8000-000000000009'";
    ask(filled("INSERT INTO trainee (uuid, created_utc, station) VALUES (" + uuid + ", '', 'OWN')"));
    ask(filled("INSERT INTO person (trainee_uuid, code, name, email, station) VALUES (" + uuid +
               ", 't-NORTH', '', '', 'OWN')"));
  }
  const std::string note = one("SELECT uuid FROM note WHERE station = '" + other_ + "'");
  ask(filled("INSERT INTO note_seen (note_uuid, utc, station) VALUES ('" + note + "', E'2026\n', 'OWN')"));
  const std::string own = one("SELECT DISTINCT trainee_uuid FROM attempt WHERE station = '" + own_ + "'"),
                    group(65, 'g');
  EXPECT_EQ(attack(one_more_entry("group joined", own, group)), "");
  Database copy = station("copy"), north = station("north");
  const PullReport pulled = replicate_central(copy, admitted(central_, "desk_" + database_name(), "desk"));
  const Lines named{"exercise two?lines: ", "ruleset x: ", "trainee 01890000-0000-7000-8000-000000000000: ",
                    "membership of trainee " + own + " in \"" + group + "\": ", "that note " + note + " was met: "};
  ASSERT_EQ(pulled.problems.size(), named.size());
  for (std::size_t i = 0; i < named.size(); ++i)
    EXPECT_TRUE(pulled.problems[i].starts_with(named[i])) << pulled.problems[i];
  EXPECT_EQ(AttemptStore(copy).list().size(), 4u);
  EXPECT_EQ(sql::query_integer(copy.connection(), "SELECT count(*) FROM person WHERE code LIKE 'T-north%'"), 4);
  EXPECT_EQ(problems_of(copy), "");
  EXPECT_EQ(pull_from_central(north, north_, false).problems.size(), 1u) << "its note's";
  EXPECT_EQ(problems_of(north), "");
}

TEST_F(CentralAttack, AUuidOfTheEndOfAllTimesIsNobodysLastWord) {
  ask(
      filled("INSERT INTO curriculum (uuid, name, version, sha256, toml, author, utc, digest, station) VALUES"
             " ('ffffffff-ffff-7fff-bfff-ffffffffffff', 'course', 1, repeat('0', 64), 'x', '', '', '', 'OWN')"));
  Database north = station("north");
  const PullReport pulled = pull_from_central(north, north_, false);
  ASSERT_EQ(pulled.problems.size(), 1u);
  EXPECT_TRUE(pulled.problems[0].starts_with(
      "curriculum ffffffff-ffff-7fff-bfff-ffffffffffff: its UUID is of a time more than a year ahead"))
      << pulled.problems[0];
  EXPECT_LT(CurriculumStore(north).add("course", "a = 1\n", kTeacher).uuid, "1");
  EXPECT_EQ(come(north, north_).conflicts, Lines{});
  // Its own clock runs ahead by centuries: what was written under it stays at home, is named, and the rest goes on.
  sql::execute(north.connection(),
               "INSERT INTO curriculum (uuid, name, version, sha256, toml, author, utc) SELECT"
               " '0fffffff-0000-7000-8000-000000000001', name, 2, sha256, toml, author, utc FROM curriculum");
  seal_row(north.connection(), "curriculum", "0fffffff-0000-7000-8000-000000000001", "");
  const std::string ahead = CurriculumStore(north).add("course", "a = 2\n", kTeacher).uuid;
  EXPECT_GT(ahead, "0fffffff");
  practise(north, "T-north", 1);
  const PushReport pushed = come(north, north_);
  EXPECT_EQ(pushed.added.at("attempt"), 1);
  ASSERT_EQ(pushed.conflicts.size(), 2u) << "that which was put in as if by an older program, and the one after it";
  EXPECT_TRUE(pushed.conflicts[1].starts_with("curriculum " + ahead + ": its UUID is none of trocar's, or of a time"))
      << pushed.conflicts[1];
}

TEST(UuidsOfRows, EndWhereThereAreNoMore) {
  for (const char* before : {"ffffffff-ffff-7fff-8000-000000000001", "ffffffff-ffff-7fff-bfff-fffffffffffe"}) {
    const std::string next = make_uuid_after(before);
    EXPECT_GT(next, before);
    EXPECT_LE(next, "ffffffff-ffff-7fff-bfff-ffffffffffff");
    EXPECT_EQ(next.size(), 36u);
  }
  EXPECT_NE(message_of<InputError>([] { make_uuid_after("ffffffff-ffff-7fff-bfff-ffffffffffff"); }), "");
  for (const char* none : {"ffffffff-ffff-7fff-bfff-fffffffffff", "ffffffff-ffff-7fff-ffff-ffffffffffff",
                           " fffffff-ffff-7fff-bfff-ffffffffffff", "FFFFFFFF-FFFF-7FFF-BFFF-FFFFFFFFFFFF"})
    EXPECT_LT(make_uuid_after(none), "1") << none;
}

TEST_F(CentralAttack, AStationPutsNobodyElsesPeopleIntoGroups) {
  const CentralAddress desk = admitted(central_, "desk_" + database_name(), "desk");
  const std::string own = one("SELECT DISTINCT trainee_uuid FROM attempt WHERE station = '" + own_ + "'");
  Database copy = station("copy"), north = station("north");
  replicate_central(copy, desk);
  CurriculumStore(copy).join("T-north", "friday", kTeacher);
  push_to_central(copy, PushOptions{desk});
  EXPECT_EQ(attack(one_more_entry("group joined", trainee_, "monday")), "");
  EXPECT_EQ(attack(one_more_entry("group left", trainee_, "friday")), "");
  EXPECT_EQ(attack(one_more_entry("group joined", own, "tuesday")), "");
  EXPECT_NE(attack(filled("INSERT INTO audit (station, of_desk) VALUES ('OWN', true)")), "");
  replicate_central(copy, desk);
  EXPECT_EQ(CurriculumStore(copy).groups_of("T-north"), Lines{"friday"});
  EXPECT_EQ(CurriculumStore(copy).groups_of("T-south"), Lines{"tuesday"});
  dismiss_login(server_.owner_of(central_), "desk_" + database_name());
  pull_from_central(north, north_, false);
  EXPECT_EQ(CurriculumStore(north).groups_of("T-north"), Lines{"friday"}) << "what the desk's login said stays";
  link_people(server_.owner_of(central_), "T-north@north", "T-south@south", true, "me");
  pull_from_central(north, north_, false);
  EXPECT_EQ(CurriculumStore(north).groups_of("T-north"), (Lines{"monday", "tuesday"})) << "one person now";
}

class CentralLogins : public CentralAttack {};

TEST_F(CentralLogins, ThatHoldUpEverybodyAreNamedAndShutOut) {
  const std::string south = "south_" + database_name();
  ask("ALTER ROLE north_" + database_name() + " SET lock_timeout = '200ms'");  // instead of half a minute
  pqxx::connection held(sync::connection_text(south_));
  pqxx::nontransaction holds(held);
  holds.exec("SELECT pg_advisory_lock(1414677330)");
  Database north = station("north"), its = station("south");
  practise(north, "T-north", 1);
  const std::string told = message_of<EnvironmentError>([&] { come(north, north_); });
  EXPECT_NE(told.find("somebody holds the lock that writers take, for too long now: login " + south + " (process "),
            std::string::npos)
      << told;
  EXPECT_EQ(dismiss_login(server_.owner_of(central_), south), Lines{});
  EXPECT_EQ(come(north, north_).added.at("attempt"), 1);
  EXPECT_NE(attack("SELECT 1").find("not permitted to log in"), std::string::npos);
  EXPECT_FALSE(admit_login(server_.owner_of(central_), {south, "station"})) << "its password is what it was";
  practise(its, "T-south", 1);
  EXPECT_EQ(come(its, south_).added.at("attempt"), 1);
}

/// As the documents set one up: an owner that may make roles and nothing more.
TEST_F(CentralLogins, AreShutOutByAnOwnerWhoIsNoSuperuser) {
  const std::string boss = "boss_" + database_name(), mine = "mine_" + database_name();
  ask("CREATE ROLE " + boss + " LOGIN CREATEROLE PASSWORD 'boss'");
  const CentralAddress central = server_.make_database("of_" + boss);
  server_.ask(central, "ALTER DATABASE of_" + boss + " OWNER TO " + boss);
  const auto password = folder_ / "boss.password";
  std::ofstream(password) << "boss\n";
  std::filesystem::permissions(password, std::filesystem::perms::owner_read);
  const CentralAddress owner = server_.as(central, boss, password);
  set_up_central(owner);
  const auto file = folder_ / "mine.password";
  EXPECT_TRUE(admit_login(owner, {mine, "station", "", file}));
  const CentralAddress login = server_.as(central, mine, file);
  pqxx::connection open(sync::connection_text(login));
  EXPECT_EQ(dismiss_login(owner, mine), Lines{});
  EXPECT_THROW(pqxx::nontransaction(open).exec("SELECT 1"), pqxx::failure);
  EXPECT_EQ(server_.ask(central, "SELECT count(*) FROM pg_auth_members WHERE roleid = '" + mine +
                                     "'::regrole AND"
                                     " (member <> '" +
                                     boss + "'::regrole OR grantor = member)"),
            Lines{"0"});
  EXPECT_FALSE(admit_login(owner, {mine, "station"}));
  Database database = station("mine");
  EXPECT_EQ(come(database, login).conflicts, Lines{});
}

TEST_F(CentralLogins, AreMadeByTheOwnerAloneAndNeverMightyOnes) {
  const CentralAddress owner = server_.owner_of(central_);
  EXPECT_NE(message_of<InputError>([&] { admit_login(south_, {"mine", "desk", "", folder_ / "p"}); }), "");
  EXPECT_NE(message_of<InputError>([&] { set_up_central(south_); }).find("only its owner, trocar"), std::string::npos);
  EXPECT_NE(message_of<InputError>([&] { dismiss_login(south_, "north"); }), "");
  EXPECT_NE(message_of<InputError>([&] {
              admit_login(owner, {"trocar", "station"});
            }).find("is a superuser"),
            std::string::npos);
  const std::string mighty = "mighty_" + database_name();
  ask("CREATE ROLE " + mighty + " LOGIN IN ROLE pg_read_all_data");
  EXPECT_NE(message_of<InputError>([&] {
              admit_login(owner, {mighty, "station"});
            }).find("is a member of other roles"),
            std::string::npos);
  const auto file = folder_ / "there";
  std::ofstream(file) << "mine\n";
  EXPECT_NE(message_of<InputError>([&] { admit_login(owner, {"x" + database_name(), "station", "", file}); }), "");
  EXPECT_NE(message_of<InputError>([&] { admit_login(owner, {"x" + database_name(), "station"}); }), "");
  EXPECT_EQ(one("SELECT count(*) FROM pg_roles WHERE rolname = 'x" + database_name() + "'"), "0");
  const CentralState state = set_up_central(owner);
  EXPECT_EQ(state.problems, Lines{});
  ASSERT_EQ(state.stations.size(), 2u);
  EXPECT_EQ(state.stations[0].login, "north_" + database_name());
  EXPECT_EQ(state.stations[0].entries, state.stations[0].head);
  ask("ALTER ROLE north_" + database_name() + " CREATEROLE");
  EXPECT_EQ(set_up_central(owner).problems, (Lines{"login north_" + database_name() + " may make roles"}));
}

TEST_F(CentralLogins, ThatAreDismissedAreOutAndWhatTheyWroteStays) {
  const Lines before = everything();
  dismiss_login(server_.owner_of(central_), "south_" + database_name());
  for (const char* sql : {"SELECT 1 FROM attempt", "SELECT announce('OWN', 'x')",
                          "INSERT INTO trainee (uuid, station) VALUES ('x', 'OWN')", "SELECT erase()"})
    EXPECT_NE(attack(filled(sql)), "") << sql;
  EXPECT_EQ(everything(), before);
}

TEST_F(CentralLogins, AStationOfBeforeIsGivenItsLogin) {
  Database west = station("west");
  come(west, server_.owner_of(central_), "west");
  const CentralAddress login = admitted(central_, "west_" + database_name(), "station");
  EXPECT_NE(message_of<EnvironmentError>([&] { come(west, login); }).find("does not belong to the login"),
            std::string::npos);
  EXPECT_FALSE(admit_login(server_.owner_of(central_), {"west_" + database_name(), "station", "west"}));
  practise(west, "T-west", 1);
  EXPECT_EQ(come(west, login).added.at("attempt"), 1);
}

}  // namespace
}  // namespace trocar::central_attack_test
