// The tables against the stores: every attempt, every row, every bit; what was not chosen stays out; nobody is named.
#include <bit>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/trainees/exchange/export/export_samples.h"
#include "tests/trainees/records/cohort_samples.h"
#include "trainees/exchange/export/export_tables.h"
#include "trainees/exchange/export/table_export.h"
#include "trainees/records/assessments.h"
#include "trainees/records/curricula.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar::table_export_test {
namespace {

using nlohmann::json;
using test::bytes_of_file;
using test::cell_of;
using test::CsvTable;
using test::read_csv;

const Author kTeacher{"0192-t", "Dr =Teach, \"MD\""};
const std::vector<std::string> kFiles{"attempts.csv",   "caps.csv",     "certificates.csv", "events.csv",
                                      "metrics.csv",    "notes.csv",    "overrides.csv",    "ratings.csv",
                                      "signatures.csv", "subscores.csv"};

class TableExport : public TemporaryFolder {
 protected:
  TableExport() : database_(":memory:") {
    first_ = store("A", 81.25, "surface-touch");
    second_ = store("B", 60, "surface-touch");
    third_ = store("A", 90, "peg-transfer");
    AttemptStore(database_).begin_attempt(sample_start("A"));  // still running: not exported
    CurriculumStore(database_).join("B", "2026 B", kTeacher);
    AssessmentStore assessments(database_);
    assessments.add_note("A", first_.uuid, "=cmd|' /C calc'!A0\nsecond line, \"quoted\"", kTeacher);
    assessments.add_note("A", "", "On the whole: good", kTeacher);
    assessments.sign(first_.uuid, "review", "+49 seen", kTeacher);
    assessments.override_verdict(second_.uuid, true, "Patient moved; see film", kTeacher);
  }

  AttemptId store(const std::string& trainee, double score, const std::string& exercise) {
    AttemptStart start = sample_start(trainee);
    start.exercise_id = exercise;
    start.exercise_text = "id = \"" + exercise + "\"\n";
    return store_attempt(database_, start, sample_result(score));
  }

  std::filesystem::path csv(const ExportFilter& filter = {}) {
    const std::filesystem::path out = folder_ / ("out" + std::to_string(++count_));
    PendingExport pending(out, PendingExport::Shape::kFolder);
    write_csv_files(database_, choose_attempts(database_, filter), pending);
    pending.commit();
    return out;
  }
  CsvTable table(const std::filesystem::path& out, const std::string& name) {
    return read_csv(bytes_of_file(out / (name + ".csv")));
  }

  json document(const ExportFilter& filter = {}) {
    std::ostringstream out;
    write_json(database_, choose_attempts(database_, filter), out);
    return json::parse(out.str());
  }

  Database database_;
  AttemptId first_, second_, third_;
  int count_ = 0;
};

TEST_F(TableExport, WritesOneFileATable) {
  const auto out = csv();
  EXPECT_EQ(test::names_in(out), kFiles);
  EXPECT_EQ(table(out, "attempts").size(), 1u + 3);
  EXPECT_EQ(table(out, "metrics").size(), 1u + 9);
  EXPECT_EQ(table(out, "subscores").size(), 1u + 6);
  EXPECT_EQ(table(out, "events").size(), 1u + 6);
  EXPECT_EQ(table(out, "caps").size(), 1u + 3);
  EXPECT_EQ(table(out, "notes").size(), 1u + 2);
  EXPECT_EQ(table(out, "signatures").size(), 1u + 1);
  EXPECT_EQ(table(out, "overrides").size(), 1u + 1);
}

TEST_F(TableExport, CapsOfEveryKindAreSentences) {
  const AttemptResult result = capped_result();
  const AttemptId id = store_attempt(database_, sample_start("C"), result);
  const CsvTable caps = table(csv({.trainee = "C"}), "caps");
  ASSERT_EQ(caps.size(), 5u);
  EXPECT_EQ(caps[0], (std::vector<std::string>{"attempt_uuid", "reason"}));
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_EQ(caps[i + 1], (std::vector<std::string>{id.uuid, cap_sentence(result.grade.caps[i])}));
}

TEST_F(TableExport, AttemptsHaveEveryColumn) {
  const CsvTable attempts = table(csv(), "attempts");
  const AttemptResult stored = AttemptStore(database_).load(first_.row);
  const auto cell = [&](const char* column) { return cell_of(attempts, first_.uuid, column); };
  EXPECT_EQ(cell("trainee"), "A");
  EXPECT_EQ(cell("exercise"), "surface-touch");
  EXPECT_EQ(cell("ruleset_sha256"), stored.rubric_sha256);
  EXPECT_EQ(cell("seed"), "-7") << "numbers are not defused";
  EXPECT_EQ(cell("board"), "3");
  EXPECT_EQ(cell("assists"), "plumb");
  EXPECT_EQ(cell("organ_synthetic"), "1");
  EXPECT_EQ(cell("organ_credit"), "Synthetic phantom, CC0-1.0");
  EXPECT_EQ(cell("status"), "completed");
  EXPECT_EQ(cell("score_of_100"), "81.25");
  EXPECT_EQ(cell("passed"), "1");
  EXPECT_EQ(cell("session_uuid"), "") << "none";
  EXPECT_EQ(cell("device_rate_hz"), "1000");
  EXPECT_EQ(cell("min_energy_j"), "-1e-09");
  EXPECT_EQ(cell("device_realtime_json"), "{\"policy\":\"fifo\"}");
  EXPECT_EQ(cell("device_plant_json"), "{\"seed\":7,\"calibration\":null,\"identification\":null}");
  EXPECT_EQ(cell("row_hash").size(), 64u);
  EXPECT_EQ(cell("started_utc"), stored.started_utc);
}

TEST_F(TableExport, HidesNoColumnOfTheAttempt) {
  std::string sql;
  for (const ExportColumn& column : attempts_table().columns) sql += std::string(column.sql) + " ";
  // left out: row numbers, and the process that ran it
  for (const char* column : {"uuid",
                             "exercise_id",
                             "exercise_version",
                             "ruleset_sha256",
                             "level",
                             "seed",
                             "board",
                             "hand",
                             "organ_name",
                             "organ_source",
                             "organ_sha256",
                             "organ_synthetic",
                             "organ_credit",
                             "program",
                             "started_utc",
                             "status",
                             "integrity",
                             "finished_utc",
                             "recording_path",
                             "recording_sha256",
                             "state_hash",
                             "device_backend",
                             "device_rate_hz",
                             "device_ticks",
                             "device_overruns",
                             "saturated_contact_share",
                             "passivity_active_share",
                             "min_energy_j",
                             "kappa",
                             "device_fault",
                             "device_realtime",
                             "device_plant",
                             "hash_version",
                             "chain_position",
                             "prev_hash",
                             "row_hash",
                             "session_id",
                             "calibration_id"}) {
    EXPECT_NE(sql.find(std::string("a.") + column), std::string::npos) << column;
  }
}

TEST_F(TableExport, NumbersKeepTheirBits) {
  const auto out = csv();
  const auto bits = [](const std::string& text) {
    return std::bit_cast<std::uint64_t>(std::strtod(text.c_str(), nullptr));
  };
  EXPECT_EQ(bits(table(out, "events").at(1).at(1)), std::bit_cast<std::uint64_t>(1.0 / 3));
  EXPECT_EQ(bits(table(out, "events").at(1).at(9)), std::bit_cast<std::uint64_t>(1e-17));
  EXPECT_EQ(bits(table(out, "subscores").at(2).at(2)), std::bit_cast<std::uint64_t>(1.0 / 3));
  EXPECT_EQ(bits(table(out, "metrics").at(2).at(2)), std::bit_cast<std::uint64_t>(2.0 + 81.25 / 100));
}

TEST_F(TableExport, UndefinedIsEmptyAndNeverZero) {
  const auto out = csv();
  const CsvTable metrics = table(out, "metrics");
  EXPECT_EQ(metrics.at(3), (std::vector<std::string>{first_.uuid, "tremor", "", "mm"}));
  EXPECT_EQ(table(out, "subscores").at(2).at(4), "") << "raw";
  EXPECT_EQ(table(out, "events").at(1).at(4), "2");
  EXPECT_EQ(table(out, "events").at(2).at(4), "") << "no object";
}

TEST_F(TableExport, TextOfPeopleIsDefused) {
  const auto out = csv();
  const CsvTable notes = table(out, "notes");
  EXPECT_EQ(cell_of(notes, first_.uuid, "text"), "'=cmd|' /C calc'!A0\nsecond line, \"quoted\"");
  EXPECT_EQ(cell_of(notes, first_.uuid, "author"), "Dr =Teach, \"MD\"");
  EXPECT_EQ(cell_of(table(out, "signatures"), first_.uuid, "note"), "'+49 seen");
  EXPECT_EQ(cell_of(table(out, "signatures"), first_.uuid, "row_hash"),
            cell_of(table(out, "attempts"), first_.uuid, "row_hash"));
  EXPECT_EQ(cell_of(table(out, "overrides"), second_.uuid, "passed"), "1");
  EXPECT_EQ(cell_of(notes, "", "text"), "On the whole: good") << "a note on the trainee has no attempt";
}

TEST_F(TableExport, ADecisionCountsAndTheScoresOwnVerdictStandsBesideIt) {
  const CsvTable before = table(csv(), "attempts");
  EXPECT_EQ(cell_of(before, first_.uuid, "decided_by"), "");
  AssessmentStore(database_).override_verdict(first_.uuid, false, "The assistant did half of it",
                                              {"0192-l", "Dr Late"});
  const CsvTable attempts = table(csv(), "attempts");
  EXPECT_EQ(cell_of(attempts, first_.uuid, "passed"), "0");
  EXPECT_EQ(cell_of(attempts, first_.uuid, "passed_by_score"), "1");
  EXPECT_EQ(cell_of(attempts, first_.uuid, "decided_by"), "Dr Late");
  EXPECT_EQ(cell_of(attempts, first_.uuid, "score_of_100"), "81.25");
  const json one = document({})["attempts"][0];
  EXPECT_EQ(one["passed"], false);
  EXPECT_EQ(one["passed_by_score"], true);
  EXPECT_EQ(one["decided_utc"].get<std::string>().size(), 24u);
}

TEST_F(TableExport, OneAttemptAloneByNumberOrIdentifier) {
  for (const std::string& name : {std::to_string(second_.row), second_.uuid, second_.uuid.substr(20)}) {
    const json all = document({"", "", "", name});
    ASSERT_EQ(all["attempts"].size(), 1u) << name;
    EXPECT_EQ(all["attempts"][0]["attempt_uuid"], second_.uuid);
    EXPECT_TRUE(all["notes"].empty()) << "notes on a trainee are of no attempt";
  }
  EXPECT_THROW(document({"", "", "", "77"}), InputError);
}

TEST_F(TableExport, FiltersByTraineeGroupAndExercise) {
  const auto attempts_of = [&](const ExportFilter& filter) {
    std::vector<std::string> uuids;
    for (const auto& line : table(csv(filter), "attempts")) uuids.push_back(line.at(0));
    return std::vector<std::string>(uuids.begin() + 1, uuids.end());
  };
  EXPECT_EQ(attempts_of({"a", "", ""}), (std::vector<std::string>{first_.uuid, third_.uuid})) << "codes know no case";
  EXPECT_EQ(attempts_of({"", "2026 B", ""}), std::vector<std::string>{second_.uuid});
  EXPECT_EQ(attempts_of({"", "", "surface-touch"}), (std::vector<std::string>{first_.uuid, second_.uuid}));
  EXPECT_EQ(attempts_of({"A", "", "peg-transfer"}), std::vector<std::string>{third_.uuid});
  EXPECT_EQ(table(csv({"B", "", ""}), "notes").size(), 1u) << "notes of others stay out";
  EXPECT_EQ(table(csv({"", "", "peg-transfer"}), "notes").size(), 1u) << "notes on a trainee are of no exercise";
  EXPECT_EQ(table(csv({"", "", "surface-touch"}), "notes").size(), 2u);
}

TEST_F(TableExport, WhatIsUnknownOrEmptyIsRefused) {
  const auto message = [&](const ExportFilter& filter) {
    return message_of<InputError>([&] { choose_attempts(database_, filter); });
  };
  EXPECT_NE(message({"Z", "", ""}).find("no trainee \"Z\""), std::string::npos);
  EXPECT_NE(message({"", "nobody", ""}).find("no group \"nobody\""), std::string::npos);
  EXPECT_NE(message({"", "", "suture"}).find("no exercise \"suture\""), std::string::npos);
  EXPECT_NE(message({"B", "", "peg-transfer"}).find("nothing to export"), std::string::npos);
  EXPECT_NE(message({"' OR 1 --", "", ""}).find("no trainee"), std::string::npos);
  Database empty(":memory:");
  EXPECT_THROW(choose_attempts(empty, {}), InputError);
}

TEST_F(TableExport, TheDocumentHoldsTheSame) {
  const json all = document();
  EXPECT_EQ(all["schema"], "trocar-export");
  EXPECT_EQ(all["schema_version"], kExportSchema);
  ASSERT_EQ(all["attempts"].size(), 3u);
  const json& one = all["attempts"][0];
  EXPECT_EQ(one["attempt_uuid"], first_.uuid);
  EXPECT_EQ(one["score_of_100"], 81.25);
  EXPECT_EQ(one["passed"], true);
  EXPECT_TRUE(one["session_uuid"].is_null());
  EXPECT_EQ(one["metrics"][0], (json{{"metric", "time_s"}, {"value", 41.5}, {"unit", "s"}}));
  EXPECT_TRUE(one["metrics"][2]["value"].is_null());
  EXPECT_EQ(one["events"][0]["t_s"], 1.0 / 3);
  EXPECT_EQ(one["subscores"].size(), 2u);
  EXPECT_EQ(one["caps"][0]["reason"], "critical event: at most 49");
  EXPECT_EQ(one["notes"][0]["text"], "=cmd|' /C calc'!A0\nsecond line, \"quoted\"") << "JSON needs no apostrophe";
  EXPECT_EQ(one["signatures"][0]["signer"], kTeacher.printed);
  EXPECT_EQ(all["attempts"][1]["overrides"][0]["passed"], true);
  ASSERT_EQ(all["notes"].size(), 1u);
  EXPECT_EQ(all["notes"][0]["text"], "On the whole: good");
  const json some = document({"", "", "peg-transfer"});
  EXPECT_EQ(some["filter"]["exercise"], "peg-transfer");
  EXPECT_TRUE(some["notes"].empty());
}

TEST_F(TableExport, TheSameDatabaseGivesTheSameBytes) {
  const auto one = csv(), other = csv();
  for (const std::string& name : kFiles) EXPECT_EQ(bytes_of_file(one / name), bytes_of_file(other / name)) << name;
}

TEST_F(TableExport, NobodysNameGetsOut) {
  ASSERT_EQ(run_outside(folder_ / "named.db", "SELECT 1"), "");
  Database named(folder_ / "named.db");
  store_attempt(named, sample_start("A"), sample_result());
  ASSERT_EQ(run_outside(folder_ / "named.db", "UPDATE person SET name = 'Jane Secret', email = 'jane@secret.example'"),
            "");
  std::ostringstream out;
  write_json(named, choose_attempts(named, {}), out);
  EXPECT_EQ(out.str().find("ecret"), std::string::npos);
}

TEST_F(TableExport, ACohortComesOutWhole) {
  Database database(":memory:");
  test::CohortPlan plan;
  plan.attempts = 60;
  plan.metrics = 12;
  plan.events = 9;
  fill_cohort(database, plan);
  PendingExport pending(folder_ / "cohort", PendingExport::Shape::kFolder);
  const sql::ReadSnapshot snapshot(database.connection());
  const ExportChoice choice = choose_attempts(database, {});
  write_csv_files(database, choice, pending);
  pending.commit();
  const CsvTable metrics = table(folder_ / "cohort", "metrics"), events = table(folder_ / "cohort", "events");
  std::size_t at = 1, event_at = 1;
  for (const std::int64_t row : choice.attempts) {
    const AttemptResult result = AttemptStore(database).load(row);
    for (const Metric& metric : result.grade.metrics) {
      ASSERT_EQ(metrics.at(at).at(0), result.uuid);
      ASSERT_EQ(metrics.at(at).at(1), metric.name);
      const std::string& cell = metrics.at(at++).at(2);
      ASSERT_EQ(cell.empty(), !metric.value);
      ASSERT_TRUE(cell.empty() || std::strtod(cell.c_str(), nullptr) == *metric.value) << cell;
    }
    for (const Event& event : result.events) ASSERT_EQ(events.at(event_at++).at(2), event.type);
  }
  EXPECT_EQ(at, metrics.size());
  EXPECT_EQ(event_at, events.size());
}

}  // namespace
}  // namespace trocar::table_export_test
