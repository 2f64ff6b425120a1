#include "trainees/exchange/sync/central_rights.h"

#include <algorithm>
#include <map>

#include "trainees/exchange/sync/central_schema.h"

namespace trocar::sync {
namespace {

// Everything a function names is looked for where its owner put it.
constexpr const char* kAsOwner = " SECURITY DEFINER SET search_path = trocar, pg_temp ";

constexpr const char* kOwnStation = "\"station\" IN (SELECT s.uuid FROM trocar.station s WHERE s.login = session_user)";

constexpr const char* kOfOwnPerson = "trainee_uuid IN (SELECT p.uuid FROM trocar.own_person p)";
constexpr const char* kErase = "erase() RETURNS void LANGUAGE plpgsql";

constexpr const char* kAdded[] = {
    "CREATE TABLE login (name text PRIMARY KEY, kind text NOT NULL CHECK (kind IN ('station', 'desk')),"
    " admitted timestamptz NOT NULL DEFAULT clock_timestamp())",
    // "": of nobody yet, the owner says whose (central_logins.h)
    "ALTER TABLE station ADD COLUMN login text NOT NULL DEFAULT ''",
    "CREATE TABLE head (station text NOT NULL, position bigint NOT NULL, row_hash text NOT NULL, utc text NOT NULL,"
    " key text NOT NULL, signature text NOT NULL, login text NOT NULL DEFAULT session_user,"
    " received timestamptz NOT NULL DEFAULT clock_timestamp(), PRIMARY KEY (station, position))",
    "CREATE VIEW own_trainee AS SELECT t.uuid FROM trainee t JOIN station s ON s.uuid = t.station"
    " WHERE s.login = session_user",
    "CREATE VIEW own_person AS SELECT uuid FROM own_trainee UNION SELECT l.same_uuid FROM own_trainee o"
    " JOIN linked_trainee l ON l.trainee_uuid = o.uuid",
    "CREATE VIEW own_attempt AS SELECT a.uuid, a.recording_sha256 FROM attempt a JOIN station s ON s.uuid = a.station"
    " WHERE s.login = session_user",
    "CREATE VIEW own_certificate AS SELECT uuid FROM certificate WHERE trainee_uuid IN (SELECT uuid FROM own_person)",
};

/// Who brought an entry of the trail the server says, as in the column login: what a station says of groups counts for
/// its own people (take_memberships). What stood before version 5 stays, but for what stations' logins had brought.
constexpr const char* kOfDesk[] = {"ALTER TABLE audit ADD COLUMN of_desk boolean NOT NULL DEFAULT true",
                                   "ALTER TABLE audit ALTER COLUMN of_desk SET DEFAULT may_all()",
                                   "UPDATE audit SET of_desk = false WHERE action IN ('group joined', 'group left') AND"
                                   " login IN (SELECT name FROM login WHERE kind = 'station')"};

struct Function {
  const char *head, *body;
};

constexpr Function kFunctions[] = {
    {"is_owner() RETURNS boolean LANGUAGE sql STABLE", "SELECT pg_has_role(session_user, current_user, 'USAGE')"},
    {"may_all() RETURNS boolean LANGUAGE sql STABLE",
     "SELECT is_owner() OR EXISTS (SELECT 1 FROM login WHERE name = session_user AND kind = 'desk')"},
    {"require_own(wanted text) RETURNS void LANGUAGE plpgsql",
     "BEGIN IF NOT is_owner() AND NOT EXISTS (SELECT 1 FROM station WHERE uuid = wanted AND login = session_user) THEN"
     " RAISE EXCEPTION 'station % does not belong to the login % (the owner gives it: trocar sync admit --station)', "
     "wanted, session_user USING ERRCODE = '42501';"
     " END IF; END"},
    {"announce(wanted text, called text) RETURNS bigint LANGUAGE plpgsql",
     "BEGIN INSERT INTO station (uuid, name, login) VALUES (wanted, called, session_user) ON CONFLICT DO NOTHING;"
     " PERFORM require_own(wanted);"
     " UPDATE station SET name = called, last_seen = clock_timestamp() WHERE uuid = wanted;"
     " RETURN (SELECT last_position FROM station WHERE uuid = wanted); END"},
    {"advance(wanted text, reached bigint) RETURNS void LANGUAGE plpgsql",
     "BEGIN PERFORM require_own(wanted);"
     " UPDATE station SET last_position = greatest(last_position, reached), last_seen = clock_timestamp()"
     " WHERE uuid = wanted; END"},
    {"touch() RETURNS void LANGUAGE sql", "UPDATE central SET revision = (SELECT last_value FROM arrival)"},
    {"keep_people(wanted text, people json) RETURNS bigint LANGUAGE plpgsql",
     "DECLARE changed bigint; BEGIN PERFORM require_own(wanted);"
     " WITH kept AS (INSERT INTO person (trainee_uuid, code, name, email, station)"
     " SELECT r.trainee_uuid, r.code, r.name, r.email, wanted FROM"
     " json_to_recordset(people) AS r(trainee_uuid text, code text, name text, email text) WHERE NOT EXISTS"
     " (SELECT 1 FROM erased_trainee e WHERE e.trainee_uuid = r.trainee_uuid)"
     " AND (is_owner() OR r.trainee_uuid IN (SELECT uuid FROM own_trainee))"
     " ON CONFLICT (trainee_uuid) DO UPDATE SET code = excluded.code, name = excluded.name, email = excluded.email,"
     " seq = nextval('arrival') WHERE (person.code, person.name, person.email) <>"
     " (excluded.code, excluded.name, excluded.email) RETURNING 1) SELECT count(*) INTO changed FROM kept;"
     " RETURN changed; END"},
    // A recording is whole when its bytes are what the attempt recorded; else what came of it goes, to be sent again.
    {"complete_recording(wanted text) RETURNS boolean LANGUAGE plpgsql",
     "BEGIN IF NOT EXISTS (SELECT 1 FROM recording WHERE sha256 = wanted) THEN RETURN false; END IF;"
     " PERFORM require_own((SELECT station FROM recording WHERE sha256 = wanted));"
     " IF (SELECT encode(sha256(string_agg(data, ''::bytea ORDER BY position)), 'hex') FROM recording_chunk"
     " WHERE sha256 = wanted) = wanted THEN"
     " UPDATE recording SET complete = true, seq = nextval('arrival') WHERE sha256 = wanted AND NOT complete;"
     " RETURN FOUND; END IF;"
     " DELETE FROM recording WHERE sha256 = wanted AND NOT complete; RETURN false; END"},
    // What a station adds to its trail goes on from what is there, so that the newest entry holds all before it.
    {"chained() RETURNS trigger LANGUAGE plpgsql",
     "BEGIN IF EXISTS (SELECT 1 FROM fresh f WHERE f.row_hash <> encode(sha256(convert_to(concat_ws(E'\\n',"
     " 'trocar-audit-1', f.prev_hash, f.position, f.utc, f.actor, f.action, f.subject, f.detail), 'UTF8')), 'hex')"
     " OR NOT (f.position = 1 AND f.prev_hash = '' OR EXISTS (SELECT 1 FROM audit a WHERE a.station = f.station AND"
     " a.position = f.position - 1 AND a.row_hash = f.prev_hash))) THEN"
     " RAISE EXCEPTION 'the entries do not go on from the audit trail that is there' USING ERRCODE = '23514'; END IF;"
     " RETURN NULL; END"},
};

// Who reads the digest of somebody's recording at the centre cannot bring an attempt of his own with it: it would be
// that attempt's to send, and the recording's station could not. The row is left out, as one that may not be brought.
constexpr Function kRecordedOnce = {
    "recorded_once() RETURNS trigger LANGUAGE plpgsql",
    "BEGIN IF NEW.recording_sha256 <> '' AND EXISTS (SELECT 1 FROM attempt a WHERE a.recording_sha256 ="
    " NEW.recording_sha256 AND a.uuid <> NEW.uuid) THEN RETURN NULL; END IF; RETURN NEW; END"};

std::string erase_body() {
  std::string body = "BEGIN ";
  for (const std::string& statement : central_erasing()) body += statement + "; ";
  return body + "END";
}

std::string function_statement(const std::string& head, const std::string& body) {
  return "CREATE OR REPLACE FUNCTION " + head + kAsOwner + "AS $body$ " + body + " $body$";
}

std::vector<const CarriedTable*> with_login() {
  std::vector<const CarriedTable*> all{&carried_person(), &carried_attempt()};
  for (const CarriedTable& table : carried_bases()) all.push_back(&table);
  for (const CarriedTable& table : carried_sealed()) all.push_back(&table);
  return all;
}

/// What a station may insert into each table and what it sees of it. Tables that are not here are changed by functions.
struct Policy {
  std::string table, columns;  ///< that can be given
  std::string check;           ///< of an insertion
  std::string sees = "true";
};

/// What a station sees of a sealed table: of what is said about people, what is said about its own.
std::string sees(const std::string& table) {
  const std::string all = "(SELECT trocar.may_all())";
  const std::string of_attempt =
      "EXISTS (SELECT 1 FROM trocar.attempt a WHERE a.uuid = attempt_uuid AND a." + std::string(kOfOwnPerson) + ")";
  if (table == "consent" || table == "standing") return all + " OR " + kOfOwnPerson;
  if (table == "assignment") return all + " OR trainee_uuid IS NULL OR " + kOfOwnPerson;
  if (table == "note") return all + " OR " + kOfOwnPerson + " OR " + of_attempt;
  if (table == "rating" || table == "signature") return all + " OR " + of_attempt;
  return "true";
}

std::string quoted_columns(const CarriedTable& table) {
  std::string text;
  for (const Column& column : table.columns) text += "\"" + column.central + "\", ";
  if (table.seal == "digest") text += "\"digest\", ";
  return text + "\"station\"";
}

std::string both(const std::string& one, const std::string& other) { return one + " AND (" + other + ")"; }

constexpr const char* kIsUuid = "uuid ~ '^[0-9a-f]{8}(-[0-9a-f]{4}){3}-[0-9a-f]{12}$'";

// Versions go on from what is there: one far beyond would leave no number to anybody's next one.
constexpr const char* kNextVersion =
    "version <= 1000 + coalesce((SELECT max(c.version) FROM trocar.curriculum c WHERE c.name = curriculum.name), 0)";

std::vector<Policy> policies() {
  const std::string all = "(SELECT trocar.may_all())", own = kOwnStation;
  std::vector<Policy> out;
  for (const CarriedTable& table : carried_bases())
    out.push_back({table.name, quoted_columns(table), both(own, is_sound(table.name))});
  out.push_back({carried_attempt().name, quoted_columns(carried_attempt()),
                 both(both(own, kIsUuid), all + " OR trainee_uuid IN (SELECT t.uuid FROM trocar.own_trainee t)")});
  for (const CarriedTable& table : carried_of_attempt()) {
    // They come with their attempt: nothing is added to one that is there.
    out.push_back({table.name, quoted_columns(table),
                   both(own, "EXISTS (SELECT 1 FROM trocar.attempt a WHERE a.uuid = attempt_uuid AND a.station = \"" +
                                 table.name + "\".station AND a.xmin = pg_current_xact_id()::xid)")});
  }
  for (const CarriedTable& table : carried_sealed()) {
    out.push_back(
        {table.name, quoted_columns(table),
         both(both(own, is_sound(table.name)), table.name == "curriculum" ? kNextVersion : may_bring(table.name)),
         sees(table.name)});
  }
  out.push_back({"person", "", "false", all + " OR " + own});
  out.push_back({"audit", "station, position, utc, actor, action, subject, detail, prev_hash, row_hash", own});
  out.push_back({"conflict", "station, kind, uuid, hash, kept", own});
  out.push_back({"head", "station, position, row_hash, utc, key, signature",
                 both(own,
                      "EXISTS (SELECT 1 FROM trocar.audit a WHERE a.station = head.station AND a.position ="
                      " head.position AND a.row_hash = head.row_hash)")});
  out.push_back({"note_seen", "note_uuid, utc, station",
                 both(own, all + " OR EXISTS (SELECT 1 FROM trocar.note n JOIN trocar.own_person p ON p.uuid ="
                                 " n.trainee_uuid WHERE n.uuid = note_uuid)")});
  out.push_back({"person_link", "one, other, linked, author, utc", all});
  out.push_back({"recording", "sha256, attempt_uuid, bytes, chunks, station",
                 both(own,
                      "EXISTS (SELECT 1 FROM trocar.own_attempt o WHERE o.uuid = attempt_uuid AND"
                      " o.recording_sha256 = recording.sha256)")});
  const std::string mine =
      "EXISTS (SELECT 1 FROM trocar.recording r JOIN trocar.station s ON s.uuid = r.station WHERE"
      " r.sha256 = recording_chunk.sha256 AND s.login = session_user";
  out.push_back(
      {"recording_chunk", "sha256, position, data", mine + " AND NOT r.complete)", all + " OR " + mine + ")"});
  return out;
}

void add_recorded_once(std::vector<std::string>& out) {
  out.push_back(function_statement(kRecordedOnce.head, kRecordedOnce.body));
  out.emplace_back("CREATE INDEX attempt_by_recording ON attempt (recording_sha256) WHERE recording_sha256 <> ''");
  out.emplace_back(
      "CREATE TRIGGER recorded_once BEFORE INSERT ON attempt FOR EACH ROW EXECUTE FUNCTION recorded_once()");
  out.emplace_back("REVOKE EXECUTE ON FUNCTION recorded_once() FROM PUBLIC");
}

void say_login(const std::string& table, std::vector<std::string>& out) {
  out.push_back("ALTER TABLE " + table + " ADD COLUMN login text NOT NULL DEFAULT ''");
  out.push_back("ALTER TABLE " + table + " ALTER COLUMN login SET DEFAULT session_user");
}

std::vector<std::string> policy_statements(const Policy& policy) {
  return {"ALTER TABLE " + policy.table + " ENABLE ROW LEVEL SECURITY",
          "CREATE POLICY sees ON " + policy.table + " FOR SELECT USING (" + policy.sees + ")",
          "CREATE POLICY brings ON " + policy.table + " FOR INSERT WITH CHECK (" + policy.check + ")"};
}

std::string quoted_login(const std::string& login) {
  std::string text = "\"";
  for (const char c : login) text += c == '"' ? std::string("\"\"") : std::string(1, c);
  return text + "\"";
}

constexpr const char* kCallable[] = {"is_owner()", "may_all()", "announce(text, text)",    "advance(text, bigint)",
                                     "touch()",    "erase()",   "keep_people(text, json)", "complete_recording(text)"};

}  // namespace

// The greatest UUID of its kind is the latest word, and whoever writes next goes beyond it: one of a time far ahead
// would be the last word for as long, and beyond the last of all there is nothing.
std::string latest_time() {
  return "lpad(to_hex((extract(epoch FROM clock_timestamp() + interval '1 year') * 1000)::bigint), 12, '0')";
}

std::string names_row() {
  return "uuid ~ '^[0-9a-f]{8}-[0-9a-f]{4}-7[0-9a-f]{3}-[89ab][0-9a-f]{3}-[0-9a-f]{12}$' AND"
         " replace(left(uuid, 13), '-', '') COLLATE \"C\" <= " +
         latest_time();
}

std::string is_sound(const std::string& table) {
  // A row that no program writes would be left out by everybody who fetches, and what honest rows say of it with it.
  if (table == "exercise") return "number IS NOT NULL AND title IS NOT NULL AND id !~ '[\\x01-\\x1f\\x7f]'";
  if (table == "ruleset")
    return "version IS NOT NULL AND sha256 = encode(sha256(convert_to(toml, 'UTF8')), 'hex') AND"
           " EXISTS (SELECT 1 FROM trocar.exercise e WHERE e.id = exercise_id)";
  if (table == "trainee") return std::string("created_utc IS NOT NULL AND ") + kIsUuid;
  const auto& sealed = carried_sealed();
  const bool has_name = std::any_of(sealed.begin(), sealed.end(), [&](const auto& one) { return one.name == table; });
  return has_name ? names_row() : "true";
}

std::string may_bring(const std::string& table) {
  static const std::string kOfAttempt = "EXISTS (SELECT 1 FROM trocar.own_attempt o WHERE o.uuid = attempt_uuid)",
                           kOfCertificate =
                               "EXISTS (SELECT 1 FROM trocar.own_certificate o WHERE o.uuid = certificate_uuid)",
                           kOfAssignment =
                               "EXISTS (SELECT 1 FROM trocar.assignment o WHERE o.uuid = assignment_uuid AND"
                               " o.trainee_uuid IN (SELECT p.uuid FROM trocar.own_person p))";
  static const std::map<std::string, std::string> kAbout{
      {"consent", kOfOwnPerson},        {"note", kOfOwnPerson},         {"certificate", kOfOwnPerson},
      {"erasure", kOfOwnPerson},        {"rating", kOfAttempt},         {"signature", kOfAttempt},
      {"verdict_override", kOfAttempt}, {"revocation", kOfCertificate}, {"standing", kOfOwnPerson},
      {"assignment", kOfOwnPerson},     {"withdrawal", kOfAssignment}};
  const auto about = kAbout.find(table);
  return about == kAbout.end() ? "true" : "(SELECT trocar.may_all()) OR " + about->second;
}

std::vector<std::string> rights_statements() {
  std::vector<std::string> out;
  for (const char* statement : kAdded) out.emplace_back(statement);
  for (const char* table : {"audit", "conflict", "note_seen", "person_link", "recording"}) say_login(table, out);
  for (const CarriedTable* table : with_login()) say_login(table->name, out);
  for (const Function& function : kFunctions) out.push_back(function_statement(function.head, function.body));
  out.push_back(function_statement(kErase, erase_body()));
  out.emplace_back(
      "CREATE TRIGGER chained AFTER INSERT ON audit REFERENCING NEW TABLE AS fresh FOR EACH STATEMENT EXECUTE FUNCTION"
      " chained()");
  add_recorded_once(out);
  for (const char* statement : kOfDesk) out.emplace_back(statement);
  out.emplace_back("REVOKE EXECUTE ON ALL FUNCTIONS IN SCHEMA trocar FROM PUBLIC");
  for (const Policy& policy : policies()) {
    for (std::string& statement : policy_statements(policy)) out.push_back(std::move(statement));
  }
  return out;
}

std::vector<std::string> rights_since_3() {
  std::vector<std::string> out{function_statement(kErase, erase_body())};
  add_recorded_once(out);
  const auto& added = programme_tables();
  for (const std::string& table : added) say_login(table, out);
  for (const Policy& policy : policies()) {
    if (std::find(added.begin(), added.end(), policy.table) != added.end()) {
      for (std::string& statement : policy_statements(policy)) out.push_back(std::move(statement));
    } else if (policy.sees != "true") {  // what a station sees has become less
      out.push_back("ALTER POLICY sees ON " + policy.table + " USING (" + policy.sees + ")");
    }
  }
  return out;
}

std::vector<std::string> rights_since_4() {
  std::vector<std::string> out(std::begin(kOfDesk), std::end(kOfDesk));
  for (const Policy& policy : policies())
    out.push_back("ALTER POLICY brings ON " + policy.table + " WITH CHECK (" + policy.check + ")");
  return out;
}

const std::vector<std::string>& programme_tables() {
  static const std::vector<std::string> kTables{"standing", "assignment", "withdrawal"};
  return kTables;
}

std::vector<std::string> grant_statements(const std::string& login) {
  const std::string to = " TO " + quoted_login(login);
  std::vector<std::string> out{"GRANT USAGE ON SCHEMA trocar" + to, "GRANT SELECT ON ALL TABLES IN SCHEMA trocar" + to,
                               "GRANT USAGE ON SEQUENCE arrival" + to};
  for (const Policy& policy : policies()) {
    if (!policy.columns.empty()) out.push_back("GRANT INSERT (" + policy.columns + ") ON " + policy.table + to);
  }
  for (const char* function : kCallable) out.push_back(std::string("GRANT EXECUTE ON FUNCTION ") + function + to);
  return out;
}

std::vector<std::string> revoke_statements(const std::string& login) {
  const std::string from = " FROM " + quoted_login(login);
  std::vector<std::string> out;
  for (const char* what : {"ALL ON ALL TABLES IN SCHEMA trocar", "ALL ON ALL SEQUENCES IN SCHEMA trocar",
                           "ALL ON ALL FUNCTIONS IN SCHEMA trocar", "ALL ON SCHEMA trocar"})
    out.push_back(std::string("REVOKE ") + what + from);
  for (const Policy& policy : policies()) {  // those of columns go with their table's
    if (!policy.columns.empty()) out.push_back("REVOKE INSERT (" + policy.columns + ") ON " + policy.table + from);
  }
  return out;
}

}  // namespace trocar::sync
