// `trocar export` and `trocar score --jigsaws` from options to files: what stands there, what is refused, what is left
// out.
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/cli/records/export_command.h"
#include "app/session/recording/recording_reader.h"
#include "haptics/digest/digest.h"
#include "scenarios/scoring/metrics.h"
#include "tests/app/cli/command_samples.h"
#include "tests/app/session/recording/recording_samples.h"
#include "tests/trainees/exchange/export/export_samples.h"
#include "tests/trainees/records/store_samples.h"
#include "trainees/exchange/export/jigsaws.h"
#include "trainees/exchange/export/xapi.h"

namespace trocar::export_command_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::bytes_of_file;
using test::names_in;

class ExportCommand : public TemporaryFolder {
 protected:
  ExportCommand() : file_(folder_ / "t.db") {
    Database database(file_);
    recorded_ = store(database, "A", "expert", small_recording(3, 1000, 5));
    plain_ = store_attempt(database, sample_start("B"), sample_result(60));
  }

  AttemptId store(Database& database, const std::string& trainee, const std::string& hand,
                  const std::string& recording) {
    AttemptStart start = sample_start(trainee);
    start.hand = hand;
    start.exercise_text = testing_support::small_exercise();
    const AttemptId id = AttemptStore(database).begin_attempt(start);
    fs::create_directories(id.recording.parent_path());
    std::ofstream(id.recording, std::ios::binary) << recording;
    AttemptResult result = sample_result();
    result.recording_path = id.recording;
    result.recording_sha256 = digest::of_bytes(recording);
    AttemptStore(database).finish_attempt(id, result);
    return id;
  }

  int run(const std::string& format, const fs::path& out, const ExportFilter& filter = {}) {
    out_.str("");
    err_.str("");
    ExportOptions options;
    options.format = format;
    options.out = out;
    options.filter = filter;
    options.database = file_;
    return export_command(options, out_, err_);
  }

  fs::path file_;
  AttemptId recorded_, plain_;
  std::ostringstream out_, err_;
};

TEST_F(ExportCommand, CsvAndJsonHoldEveryAttempt) {
  EXPECT_EQ(run("csv", folder_ / "tables"), 0);
  EXPECT_EQ(names_in(folder_ / "tables").size(), 10u);
  EXPECT_EQ(test::read_csv(bytes_of_file(folder_ / "tables/attempts.csv")).size(), 3u);
  EXPECT_EQ(out_.str(), "2 attempts in " + (folder_ / "tables").string() + "\n");
  EXPECT_EQ(run("json", folder_ / "all.json", {"B", "", ""}), 0);
  EXPECT_EQ(json::parse(bytes_of_file(folder_ / "all.json"))["attempts"].size(), 1u);
  EXPECT_EQ(out_.str(), "1 attempt in " + (folder_ / "all.json").string() + "\n");
}

TEST_F(ExportCommand, WhatWasChangedIsExportedAndTold) {
  EXPECT_EQ(run("csv", folder_ / "tables"), 0);
  EXPECT_EQ(err_.str().find("not as when finished"), std::string::npos) << err_.str();
  ASSERT_EQ(run_without_triggers(file_, "UPDATE score SET value = 99 WHERE value = 60"), "");
  EXPECT_EQ(run("json", folder_ / "all.json"), 0);
  EXPECT_EQ(err_.str(), "trocar: attempt " + plain_.uuid +
                            ": not as when finished, or the entry is not signed; exported as the database has it, see "
                            "trocar db check\n");
}

TEST_F(ExportCommand, StatementsCarryThePassMarkOfTheirRuleset) {
  EXPECT_EQ(run("xapi", folder_ / "s.json"), 0);
  const json statements = json::parse(bytes_of_file(folder_ / "s.json"));
  ASSERT_EQ(statements.size(), 2u);
  for (const json& statement : statements) EXPECT_TRUE(xapi_problems(statement.dump()).empty());
  EXPECT_EQ(statements[0]["context"]["extensions"]["https://w3id.org/xapi/cmi5/context/extensions/masteryscore"], 0.75);
  EXPECT_FALSE(statements[1]["context"].contains("extensions")) << "its ruleset cannot be read any more";
}

TEST_F(ExportCommand, ALaunchIsAnswered) {
  std::ofstream(folder_ / "launch.json") << R"({"activityId":"https://l/a","publisherId":"https://c/a","sessionId":"s",
    "registration":"b22893ae-a13e-406f-abb6-fd463ed7c645","actor":{"homePage":"https://l/","name":"n"}})";
  ExportOptions options;
  options.format = "xapi";
  options.out = folder_ / "cmi5.json";
  options.database = file_;
  options.filter.trainee = "B";
  options.cmi5 = folder_ / "launch.json";
  EXPECT_EQ(export_command(options, out_, err_), 0);
  EXPECT_EQ(json::parse(bytes_of_file(options.out)).size(), 2u);
  EXPECT_EQ(out_.str(), "1 attempt in " + options.out.string() + "\n");
  options.out = folder_ / "more.json";
  options.cmi5 = folder_ / "missing.json";
  EXPECT_THROW(export_command(options, out_, err_), InputError);
  options.cmi5 = folder_ / "launch.json";
  options.home_page = "https://hospital.example/";
  EXPECT_THROW(export_command(options, out_, err_), InputError) << "two home pages";
  EXPECT_FALSE(fs::exists(options.out));
}

TEST_F(ExportCommand, AChangedRecordingIsLeftOut) {
  std::ofstream(recorded_.recording, std::ios::binary) << small_recording(3, 1000, 6);
  EXPECT_NE(message_of<InputError>([&] { run("traces", folder_ / "k"); }).find("none of the attempts"),
            std::string::npos);
  EXPECT_NE(err_.str().find("not the one that was graded"), std::string::npos);
  fs::remove(recorded_.recording);
  EXPECT_THROW(run("traces", folder_ / "k"), InputError);
  EXPECT_FALSE(fs::exists(folder_ / "k"));
}

TEST_F(ExportCommand, RefusesBeforeItBegins) {
  std::ofstream(folder_ / "there") << "mine";
  const auto names = names_in(folder_);
  for (const char* format : {"csv", "json", "xapi", "traces"}) {
    EXPECT_NE(message_of<InputError>([&] { run(format, folder_ / "there"); }).find("exists already"), std::string::npos)
        << format;
    EXPECT_NE(message_of<InputError>([&] { run(format, folder_ / "no/where"); }).find("there is no folder"),
              std::string::npos)
        << format;
    EXPECT_NE(message_of<InputError>([&] {
                run(format, folder_ / "new", {"nobody", "", ""});
              }).find("no trainee"),
              std::string::npos);
  }
  EXPECT_THROW(run("pdf", folder_ / "new"), InputError);
  ExportOptions options;
  options.format = "csv";
  options.out = folder_ / "new";
  options.database = file_;
  options.home_page = "https://hospital.example/";
  EXPECT_THROW(export_command(options, out_, err_), InputError) << "of xapi only";
  options.home_page.clear();
  options.database = folder_ / "missing.db";
  EXPECT_THROW(export_command(options, out_, err_), EnvironmentError);
  EXPECT_EQ(names_in(folder_), names) << "nothing made, nothing left";
  EXPECT_EQ(bytes_of_file(folder_ / "there"), "mine");
}

TEST_F(ExportCommand, KinematicsAreScoredFromAFile) {
  std::ofstream(folder_ / "k.txt") << test::jigsaws_layout(test::sample_motion(30, 10));
  EXPECT_EQ(kinematics_command({folder_ / "k.txt", "right", true}, out_), 0);
  const json result = json::parse(out_.str());
  EXPECT_EQ(result["side"], "right");
  EXPECT_EQ(result["samples"], 301);
  EXPECT_EQ(result["rate_hz"], 30);
  EXPECT_NEAR(result["metrics"]["time_s"]["value"].get<double>(), 10, 1e-9);
  EXPECT_EQ(result["metrics"]["path_m"]["unit"], "m");
  EXPECT_FALSE(result["metrics"].contains("force_max_n"));
  out_.str("");
  EXPECT_EQ(kinematics_command({folder_ / "k.txt", "right", false}, out_), 0);
  EXPECT_NE(out_.str().find("sparc"), std::string::npos);
  EXPECT_THROW(kinematics_command({folder_ / "k.txt", "left", false}, out_), InputError) << "nothing there";
  EXPECT_THROW(kinematics_command({folder_ / "k.txt", "both", false}, out_), InputError);
  EXPECT_THROW(kinematics_command({folder_ / "missing.txt", "right", false}, out_), InputError);
  EXPECT_THROW(kinematics_command({folder_, "right", false}, out_), InputError);
}

}  // namespace
}  // namespace trocar::export_command_test
