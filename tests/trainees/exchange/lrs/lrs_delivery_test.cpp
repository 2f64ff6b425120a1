// Every statement reaches the store once, whatever the store, the line and the program do on the way.
#include "trainees/exchange/lrs/lrs_delivery.h"

#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/trainees/exchange/lrs/record_store_sample.h"
#include "tests/trainees/records/store_samples.h"
#include "trainees/records/assessments.h"
#include "trainees/records/demo_record.h"

namespace trocar::lrs_delivery_test {
namespace {

using nlohmann::json;

const Author kTeacher{"0192-teacher", "Ida Adler"};

class LrsDelivery : public TemporaryFolder {
 protected:
  LrsDelivery() {
    Database database(folder_ / "t.db");
    for (int i = 0; i < 7; ++i) {
      AttemptStart start = sample_start("T-a");
      start.board = i;
      attempts_.push_back(store_attempt(database, start, sample_result(80)));
    }
  }
  Database database() { return Database(folder_ / "t.db"); }
  DeliveryReport deliver(Database& database) {
    DeliveryOptions options;
    options.lrs = {store_.url(), "key"};
    options.lrs.password_file = folder_ / "password";
    std::ofstream(options.lrs.password_file) << "a:secret\n";
    chmod(options.lrs.password_file.c_str(), 0600);
    options.setting.home_page = "https://hospital.example/";
    options.at_once = 3;
    options.patience = patience_;
    options.log = [this](const std::string& line) { log_.push_back(line); };
    options.wait = [this](std::chrono::milliseconds time) { waits_.push_back(time.count()); };
    return deliver_to_lrs(database, choose_attempts(database, {}), {}, options);
  }
  DeliveryReport deliver() {
    Database opened = database();
    return deliver(opened);
  }
  std::vector<json> kept(const std::string& verb) const {
    std::vector<json> found;
    for (const auto& [id, text] : store_.kept()) {
      json statement = json::parse(text);
      if (statement["verb"]["display"]["en"] == verb) found.push_back(std::move(statement));
    }
    return found;
  }

  test::RecordStoreSample store_;
  std::vector<AttemptId> attempts_;
  std::chrono::seconds patience_{300};
  std::vector<std::string> log_;
  std::vector<long> waits_;
};

TEST_F(LrsDelivery, GoesOnceAndAgainChangesNothing) {
  const DeliveryReport first = deliver();
  EXPECT_EQ(first.delivered, 7);
  EXPECT_EQ(store_.kept().size(), 7u);
  const std::size_t asked = store_.heads().size();
  const DeliveryReport again = deliver();
  EXPECT_EQ(again.delivered, 0);
  EXPECT_EQ(again.before, 7);
  EXPECT_EQ(store_.heads().size(), asked) << "nothing to send, nobody asked";
  struct stat about {};
  ASSERT_EQ(stat((folder_ / "t.db.lrs").c_str(), &about), 0);
  EXPECT_EQ(about.st_mode & 0777, 0600u);
  Database database = this->database();
  EXPECT_EQ(database.check(), std::vector<std::string>{}) << "the record knows nothing of it";
}

TEST_F(LrsDelivery, SpeaksAsTheStoreDoesWithAPasswordForItAlone) {
  store_.versions = R"(["0.95", "1.0.0", "1.0.3", "2.0.0"])";
  deliver();
  const std::vector<std::string> heads = store_.heads();
  EXPECT_EQ(heads[0].find("Authorization"), std::string::npos) << heads[0];
  EXPECT_NE(heads[1].find("Authorization: Basic a2V5OmE6c2VjcmV0"), std::string::npos) << heads[1];
  EXPECT_NE(heads[1].find("X-Experience-API-Version: 2.0.0"), std::string::npos) << heads[1];
}

TEST_F(LrsDelivery, ALostRecordOfItSendsAgainAndDoublesNothing) {
  deliver();
  std::filesystem::remove(folder_ / "t.db.lrs");
  const DeliveryReport again = deliver();
  EXPECT_EQ(again.delivered, 7);
  EXPECT_EQ(store_.kept().size(), 7u);
  EXPECT_GE(store_.doubled(), 7);
}

TEST_F(LrsDelivery, TriesAgainLaterAndLongerWhileTheStoreHasAFault) {
  store_.instead = [](int request) {
    const char* faults[] = {"HTTP/1.1 503 Busy\r\nRetry-After: 7\r\nContent-Length: 0\r\n\r\n",
                            "HTTP/1.1 500 Fault\r\nContent-Length: 0\r\n\r\n", "", "!", "HTTP/1.1 200 OK\r\nContent-"};
    return std::string(request < 5 ? faults[request] : ".");
  };
  EXPECT_EQ(deliver().delivered, 7);
  EXPECT_EQ(store_.kept().size(), 7u);
  EXPECT_EQ(waits_, (std::vector<long>{7000, 1000, 2000, 4000, 8000}));
  EXPECT_EQ(log_.size(), 5u);
  EXPECT_NE(log_[0].find("HTTP 503; tries again in 7 s"), std::string::npos) << log_[0];
}

TEST_F(LrsDelivery, GivesUpWhenThePatienceIsAtItsEndAndGoesOnFromThere) {
  store_.instead = [](int request) { return request < 1 ? "." : "HTTP/1.1 502 Bad\r\nContent-Length: 0\r\n\r\n"; };
  const std::string told = message_of<EnvironmentError>([&] { deliver(); });
  EXPECT_NE(told.find("HTTP 502; 3 statements were delivered and stay"), std::string::npos) << told;
  EXPECT_EQ(store_.kept().size(), 3u);
  store_.instead = [](int) { return "."; };
  const DeliveryReport rest = deliver();
  EXPECT_EQ(rest.before, 3);
  EXPECT_EQ(rest.delivered, 4);
  EXPECT_EQ(store_.doubled(), 0);
}

TEST_F(LrsDelivery, WhatAStoreSaysSteersNoTerminal) {
  store_.instead = [](int) { return "HTTP/1.1 404 None\r\nContent-Length: 9\r\n\r\n\x1b[2J\xc2\x9bOK\n"; };
  const std::string told = message_of<InputError>([&] { deliver(); });
  EXPECT_NE(told.find("HTTP 404: ?[2J??OK?"), std::string::npos) << told;
}

TEST_F(LrsDelivery, TheTimeThatAStoreTakesToFailCountsAsWaited) {
  store_.instead = [](int) {
    std::this_thread::sleep_for(std::chrono::milliseconds(600));
    return std::string("HTTP/1.1 502 Bad\r\nContent-Length: 0\r\n\r\n");
  };
  patience_ = std::chrono::seconds(2);
  EXPECT_THROW(deliver(), EnvironmentError);
  EXPECT_EQ(waits_, std::vector<long>{500}) << "0.6 s, 0.5 s waited, 0.6 s: not another second";
}

TEST_F(LrsDelivery, WhatIsRefusedIsNamedAndTheRestGoes) {
  Database database = this->database();
  store_.refuses = json::parse(xapi_statement(read_xapi_attempt(database, attempts_[4].row, {})))["id"];
  const DeliveryReport report = deliver(database);
  EXPECT_EQ(report.delivered, 6);
  ASSERT_EQ(report.refused.size(), 1u);
  EXPECT_EQ(report.refused[0], "attempt " + attempts_[4].uuid + ": HTTP 400: {\"error\":\"no such thing\"}");
  EXPECT_TRUE(waits_.empty()) << "a refusal is no fault that passes";
  store_.refuses = "\n";
  EXPECT_EQ(deliver(database).delivered, 1);
}

TEST_F(LrsDelivery, StopsAtOnceWhereNothingCanGo) {
  const std::pair<const char*, const char*> answers[]{
      {"HTTP/1.1 401 Who\r\nContent-Length: 0\r\n\r\n", "user or password is refused"},
      {"HTTP/1.1 403 No\r\nContent-Length: 0\r\n\r\n", "may not write"},
      {"HTTP/1.1 404 None\r\nContent-Length: 0\r\n\r\n", "takes no statements"},
      {"HTTP/1.1 302 There\r\nLocation: http://127.0.0.1:1/\r\nContent-Length: 0\r\n\r\n", "points to another address"},
      {"HTTP/1.1 200 OK\r\nContent-Length: 22\r\n\r\n<html>Welcome!</html>\n", "does not say that it took"}};
  for (const auto& [answer, words] : answers) {
    store_.instead = [text = std::string(answer)](int) { return text; };
    const std::string told = message_of<InputError>([&] { deliver(); });
    EXPECT_NE(told.find(words), std::string::npos) << words << ": " << told;
    EXPECT_EQ(told.find("secret"), std::string::npos);
  }
  store_.versions = R"(["0.95"])";
  EXPECT_NE(message_of<InputError>([&] { deliver(); }).find("speaks neither"), std::string::npos);
  EXPECT_TRUE(store_.kept().empty());
}

TEST_F(LrsDelivery, AKilledProgramLosesAndDoublesNothing) {
  for (int kill_at = 0; kill_at < 6; ++kill_at) {
    const pid_t child = fork();
    if (child == 0) {
      store_.instead = [](int) { return "."; };
      Database opened = database();
      DeliveryOptions options;
      options.lrs = {store_.url()};
      options.setting.home_page = "https://hospital.example/";
      options.at_once = 1;
      options.going = [kill_at](std::size_t done, std::size_t) {
        if (static_cast<int>(done) > kill_at % 2) raise(SIGKILL);
      };
      try {
        deliver_to_lrs(opened, choose_attempts(opened, {}), {}, options);
      } catch (...) {
      }
      _exit(0);
    }
    int status = 0;
    waitpid(child, &status, 0);
  }
  deliver();
  EXPECT_EQ(store_.kept().size(), 7u);
  EXPECT_EQ(store_.doubled(), 0) << "killed after the answer was written down";
}

TEST_F(LrsDelivery, ALaterDecisionTakesTheEarlierStatementBack) {
  deliver();
  Database database = this->database();
  AssessmentStore(database).override_verdict(attempts_[2].uuid, false, "The camera was knocked over", kTeacher);
  const DeliveryReport report = deliver(database);
  EXPECT_EQ(report.delivered, 2);
  EXPECT_EQ(report.taken_back, 1);
  ASSERT_EQ(kept("voided").size(), 1u);
  const std::string old = kept("voided")[0]["object"]["id"];
  EXPECT_EQ(json::parse(store_.kept().at(old))["verb"]["display"]["en"], "passed");
  EXPECT_EQ(kept("failed").size(), 1u);
  EXPECT_EQ(deliver(database).delivered, 0) << "once";
}

TEST_F(LrsDelivery, ACertificateIsEarnedQuestionedAndTakenBackWhenItIsWithdrawn) {
  Database database = this->database();
  AssessmentStore said(database);
  const Certificate certificate =
      said.certify("T-a", "surface-touch", "L1", "1", json{{"attempt", attempts_[6].uuid}}.dump(), kTeacher);
  deliver(database);
  ASSERT_EQ(kept("earned").size(), 1u);
  const json earned = kept("earned")[0];
  EXPECT_EQ(earned["object"]["id"], "https://trocar.invalid/xapi/certificate/" + certificate.uuid);
  EXPECT_EQ(earned["context"]["instructor"]["account"]["name"], kTeacher.account_uuid);
  EXPECT_EQ(earned.dump().find("Adler"), std::string::npos);
  said.override_verdict(attempts_[6].uuid, false, "Somebody else held the camera", kTeacher);
  deliver(database);
  ASSERT_EQ(kept("has in question").size(), 1u);
  EXPECT_EQ(kept("has in question")[0]["context"]["statement"]["id"], earned["id"]);
  said.override_verdict(attempts_[6].uuid, true, "It was not so after all", kTeacher);
  EXPECT_EQ(deliver(database).taken_back, 2) << "the question, and the attempt that had failed";
  said.revoke(certificate.uuid, "Given to the wrong person", kTeacher);
  const DeliveryReport withdrawn = deliver(database);
  EXPECT_EQ(withdrawn.delivered, 1);
  bool voids = false;
  for (const json& one : kept("voided")) voids = voids || one["object"]["id"] == earned["id"];
  EXPECT_TRUE(voids);
  EXPECT_EQ(deliver(database).delivered, 0);
}

TEST_F(LrsDelivery, ADemoAndAddressesThatShowThePasswordAreRefused) {
  Database demo(folder_ / "demo.db");
  mark_demo(demo);
  EXPECT_THROW(deliver_to_lrs(demo, {}, {}, {}), InputError);
  Database database = this->database();
  const auto refusal = [&](const LrsAddress& lrs) {
    DeliveryOptions options;
    options.lrs = lrs;
    return message_of<InputError>([&] { deliver_to_lrs(database, choose_attempts(database, {}), {}, options); });
  };
  EXPECT_NE(refusal({"https://key:secret@lrs.example/xapi"}).find("holds a password"), std::string::npos);
  EXPECT_NE(refusal({"http://lrs.example/xapi"}).find("--allow-plain-http"), std::string::npos);
  EXPECT_NE(refusal({"lrs.example"}).find("no address"), std::string::npos);
  EXPECT_NE(refusal({"file:///etc/passwd"}).find("no address"), std::string::npos);
  EXPECT_NE(refusal({"https://lrs.example/xapi?x=1"}).find("ends before"), std::string::npos);
  EXPECT_NE(refusal({"https://lrs.example/xapi", "key", folder_ / "none"}).find("no such file"), std::string::npos);
}

}  // namespace
}  // namespace trocar::lrs_delivery_test
