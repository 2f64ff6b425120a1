#include "tests/trainees/desk/browser/browsed_desk.h"

#include "tests/trainees/desk/browser/page_faults.h"
#include "tests/trainees/desk/pages/page_samples.h"
#include "tests/trainees/records/cohort_samples.h"
#include "trainees/records/accounts.h"

namespace trocar::test {
namespace {

/// One grey dot: what a picture shows is no matter here.
std::string dot() {
  static const unsigned char kBytes[] = {
      0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48, 0x44, 0x52, 0x00,
      0x00, 0x00, 0x01, 0x00, 0x00, 0x00, 0x01, 0x08, 0x00, 0x00, 0x00, 0x00, 0x3a, 0x7e, 0x9b, 0x55, 0x00,
      0x00, 0x00, 0x0a, 0x49, 0x44, 0x41, 0x54, 0x78, 0x9c, 0x63, 0x68, 0x00, 0x00, 0x00, 0x82, 0x00, 0x81,
      0x77, 0xcd, 0x72, 0xb6, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};
  return {reinterpret_cast<const char*>(kBytes), sizeof kBytes};
}

}  // namespace

BrowsedDesk::BrowsedDesk() : file_(folder_ / "desk.db") {
  Database database(file_);
  CohortPlan plan;
  plan.trainees = 11;
  plan.attempts = 110;
  fill_cohort(database, plan);
  for (int i = 0; i < 6; ++i) {
    AttemptStart start = sample_start(kRisky);
    start.hand = "mouse";
    start.board = i;
    AttemptResult result = sample_result(52 + i);
    result.events[0].t_s = 20;
    result.events[1].t_s = 30;  // where the sample trace presses hardest
    attempt_ = store_attempt(database, start, result).uuid;
  }
}

void BrowsedDesk::add_accounts() {
  Database database(file_);
  AccountStore accounts(database);
  accounts.add("adam", "Adam Admin", Role::kAdministrator, "", kDeskPassword, "");
  accounts.add("ines", "Dr Ines Brandt", Role::kInstructor, "", kDeskPassword, "");
  accounts.add("risky", "Rosa Risky", Role::kTrainee, kRisky, kDeskPassword, "");
}

review::DeskServerOptions BrowsedDesk::options() {
  review::DeskServerOptions out;
  out.open = [file = file_] { return Database(file); };
  out.routes = review::desk_routes();
  out.port = 0;
  out.page_threads = 2;
  out.sources.trace = [](const std::filesystem::path&) { return review::sample_trace(6.5); };
  out.sources.picture = [](const std::string&, double, int) { return dot(); };
  out.sources.metric_words = [](const std::string& metric) {
    return "what " + metric + " means, in a sentence of the usual length";
  };
  out.sources.level_facts = [](const std::string&, const std::string&) {
    return review::LevelFacts{{0.4, 0.8, 1.5}, 75};
  };
  out.sources.shipped_rules = "version = \"1\"\n";
  out.sources.program = "0.1.0";
  return out;
}

void BrowsedDesk::serve(review::DeskServerOptions given) {
  server_ = std::make_unique<review::DeskServer>(std::move(given));
  server_->start();
  base_ = server_->addresses().front();
  base_.pop_back();
}

void BrowsedDesk::sign_in(const std::string& login) {
  browser_->type("input[name=login]", login);
  browser_->type("input[name=password]", kDeskPassword);
  browser_->follow("button[type=submit]");
}

void BrowsedDesk::expect_sound(const std::string& page, bool tabs) {
  EXPECT_EQ(faults_of_page(*browser_), std::vector<std::string>{}) << page << " at " << browser_->address();
  if (tabs) {
    EXPECT_EQ(faults_of_tab_order(*browser_), std::vector<std::string>{}) << page << " at " << browser_->address();
  }
}

void BrowsedDesk::expect_quiet(const std::vector<std::string>& expected) {
  EXPECT_EQ(browser_->complaints(expected), std::vector<std::string>{});
  EXPECT_EQ(browser_->requests_outside(base_ + "/"), std::vector<std::string>{});
}

}  // namespace trocar::test
