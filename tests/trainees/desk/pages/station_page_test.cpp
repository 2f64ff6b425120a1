// The live view and messages: what is shown of every program, what becomes of odd ones, who may see and write.
#include <gtest/gtest.h>

#include "haptics/input_error.h"
#include "tests/trainees/desk/pages/page_checker.h"
#include "tests/trainees/desk/pages/page_samples.h"
#include "tests/trainees/records/store_samples.h"
#include "trainees/desk/routes/page_routes.h"
#include "trainees/desk/routes/route_table.h"
#include "trainees/integrity/audit.h"
#include "trainees/records/assessments.h"
#include "trainees/records/trainee_store.h"

namespace trocar::review::station_page_test {
namespace {

TEST(StationPage, ShowsEveryProgramAndLooksAgain) {
  const std::string html = station_page(sample_stations(), sample_frame());
  const CheckedPage page = check_page(html);
  EXPECT_EQ(page.problems, std::vector<std::string>{});
  EXPECT_NE(html.find("<noscript><meta http-equiv=\"refresh\" content=\"2\"/></noscript>"), std::string::npos)
      << "with script parts are renewed";
  ASSERT_NE(page.by_id("live"), nullptr);
  const std::string now = page.by_id("now-1")->text;
  for (const char* part :
       {"dubois: EX2 Surface touch L2", "Clock1:05 of 2:00", "Done7 of 12", "Force now0.6 N", "Peak force1.3 N",
        "Limit1.5 N", "simulated, active, 1000 Hz, none missed", "Setupboard 3, organ phantom-liver (synthetic)",
        "practice window at lab-3, process 4711", "Write to dubois"})
    EXPECT_NE(now.find(part), std::string::npos) << part << "\n" << now;
  EXPECT_LT(now.find("Too much force"), now.find("Target done")) << "newest first";
  const std::string idle = page.by_id("now-2")->text;
  EXPECT_NE(idle.find("chen: between attempts"), std::string::npos) << idle;
  EXPECT_EQ(idle.find("Clock"), std::string::npos) << "there is none between attempts";
}

TEST(StationPage, NobodyIsWrittenToWhereNothingShowsIt) {
  LiveStations view = sample_stations();
  view.stations[0].told.moment.hears = false;  // as a scripted run
  const CheckedPage page = check_page(station_page(view, sample_frame()));
  EXPECT_EQ(page.by_id("now-1")->text.find("Write to"), std::string::npos);
  EXPECT_NE(page.by_id("now-2")->text.find("Write to chen"), std::string::npos);
}

TEST(StationPage, ShowsTheScopesPictureWhereThereIsOne) {
  const CheckedPage page = check_page(station_page(sample_stations(), sample_frame()));
  const auto pictures = page.all("img", "scene");
  ASSERT_EQ(pictures.size(), 1U) << "the other one is between attempts";
  EXPECT_EQ(pictures[0]->of("src"), "/station/picture/0192-aa.jpg");
  EXPECT_FALSE(pictures[0]->of("alt").empty());
}

TEST(StationPage, ADeadProgramIsNotShownAsRunning) {
  LiveStations view = sample_stations();
  view.stations[0].state = LiveStation::State::kEnded;
  view.stations[0].age_s = 300;
  view.stations[1].state = LiveStation::State::kQuiet;
  view.stations[1].age_s = 12;
  const CheckedPage page = check_page(station_page(view, sample_frame()));
  const std::string dead = page.by_id("now-1")->text, quiet = page.by_id("now-2")->text;
  EXPECT_NE(dead.find("Ended unexpectedly"), std::string::npos) << dead;
  EXPECT_NE(dead.find("5 min ago"), std::string::npos) << dead;
  EXPECT_NE(dead.find("Stateended unexpectedly"), std::string::npos) << dead;
  EXPECT_EQ(dead.find("Write to"), std::string::npos) << "nobody is there to read it";
  EXPECT_NE(quiet.find("Does not answer"), std::string::npos) << quiet;
}

TEST(StationPage, SaysHowOldItIsAndWhatCannotBeRead) {
  LiveStations view = sample_stations();
  view.stations[0].age_s = 20;
  view.unreadable = {"<odd>.json"};
  const CheckedPage page = check_page(station_page(view, sample_frame()));
  EXPECT_EQ(page.problems, std::vector<std::string>{});
  EXPECT_NE(page.by_id("now-1")->text.find("As it was 20 s ago."), std::string::npos);
  EXPECT_NE(page.by_id("live")->text.find("1 file of this desk's live folder cannot be read: <odd>.json"),
            std::string::npos);
  EXPECT_NE(station_page({}, sample_frame()).find("Nothing runs"), std::string::npos);
  const std::string refused = station_page({{}, {}, "x.live belongs to another user"}, sample_frame());
  EXPECT_EQ(refused.find("Nothing runs"), std::string::npos) << "that is not known";
  EXPECT_NE(refused.find("another user"), std::string::npos);
}

TEST(StationPage, HostileAndOddMoments) {
  LiveStations view = sample_stations();
  LiveMoment& now = view.stations[0].told.moment;
  now.program = now.trainee = now.exercise = now.level = now.hand = now.setup = now.phase = now.device =
      now.device_state = kHostile;
  now.events = {{1e300, kHostile, true}, {-5, "", false}};
  now.force_n = -1;
  now.peak_force_n = 1e308;
  now.limit_n = 1e308;
  now.elapsed_s = -4;
  view.stations[0].told.machine = kHostile;
  view.unreadable = {kHostile};
  view.refusal = kHostile;
  EXPECT_EQ(check_page(station_page(view, sample_frame())).problems, std::vector<std::string>{});
  EXPECT_EQ(check_page(station_message_page(kHostile, kHostile, kHostile, kHostile, sample_frame())).problems,
            std::vector<std::string>{});
}

class StationRoutes : public TemporaryFolder {
 protected:
  StationRoutes() : database_(folder_ / "x.db"), desk_{database_, {}, false}, table_(station_routes()) {
    TraineeStore(database_).ensure_trainee("dubois");
    desk_.sources.stations = [] { return sample_stations(); };
  }
  Response ask(const std::string& method, const std::string& path, std::map<std::string, std::string> values = {}) {
    const RouteTable::Found found = table_.find(method, path);
    Request request;
    request.path = path;
    request.arguments = found.arguments;
    (method == "GET" ? request.query : request.form) = std::move(values);
    request.account = Account{"a-1", "ines", "Dr Ines Okafor", Role::kInstructor};
    request.token = "token-4711";
    return found.route->answer(request, desk_);
  }
  std::optional<Note> waiting() { return AssessmentStore(database_).unseen_message("dubois"); }

  Database database_;
  Desk desk_;
  RouteTable table_;
};

TEST_F(StationRoutes, AreForInstructorsOnly) {
  ASSERT_EQ(table_.routes().size(), 4U);
  for (const Route& route : table_.routes()) EXPECT_EQ(route.audience, Audience::kInstructors) << route.path;
}

TEST_F(StationRoutes, APictureIsGivenOrSaidToBeMissing) {
  EXPECT_EQ(ask("GET", "/station/picture/0192-aa.jpg").status, 400) << "this desk has none";
  desk_.sources.station_picture = [](const std::string& name) {
    return name == "0192-aa.jpg" ? std::optional<std::string>("\xFF\xD8 picture") : std::nullopt;
  };
  EXPECT_EQ(ask("GET", "/station/picture/0192-aa.jpg").type, "image/jpeg");
  EXPECT_EQ(ask("GET", "/station/picture/0192-aa.jpg").body, "\xFF\xD8 picture");
  EXPECT_EQ(ask("GET", "/station/picture/else.jpg").status, 400);
}

TEST_F(StationRoutes, WhoRunsWhatShowsNoMessagesMeetsThemAtTheNextSignIn) {
  desk_.sources.stations = [] {
    LiveStations view = sample_stations();
    view.stations[0].told.moment.hears = false;
    return view;
  };
  EXPECT_NE(ask("GET", "/station/message", {{"trainee", "dubois"}}).body.find("at the next sign-in"),
            std::string::npos);
}

TEST_F(StationRoutes, AMessageIsASealedNoteThatIsKnownAsOne) {
  const Response form = ask("GET", "/station/message", {{"trainee", "dubois"}});
  EXPECT_NE(form.body.find("EX2 Surface touch L2, running."), std::string::npos);
  EXPECT_EQ(form.body.find("refresh"), std::string::npos) << "typing is not cut off";
  const Response sent = ask("POST", "/station/message", {{"trainee", "dubois"}, {"text", "Softer at the edge"}});
  EXPECT_EQ(sent.status, 303);
  EXPECT_EQ(sent.location, "/station?sent=dubois");
  const std::optional<Note> message = waiting();
  ASSERT_TRUE(message);
  EXPECT_EQ(message->text, "Softer at the edge");
  EXPECT_EQ(message->printed, "Dr Ines Okafor");
  EXPECT_TRUE(database_.check().empty()) << database_.check().front();
  EXPECT_NE(ask("GET", "/station", {{"sent", "dubois"}}).body.find("Sent to dubois."), std::string::npos);
}

TEST_F(StationRoutes, MessagesAreMetInOrderOnceAndOrdinaryNotesAreNone) {
  AssessmentStore assessments(database_);
  assessments.add_note("dubois", "", "a long thought for the next lesson", {"a-1", "Ines"});
  EXPECT_FALSE(waiting()) << "a note is no message";
  assessments.add_message("dubois", "one", {"a-1", "Ines"});
  assessments.add_message("dubois", "two", {"a-1", "Ines"});
  ASSERT_EQ(waiting()->text, "one");
  assessments.mark_seen(waiting()->uuid);
  ASSERT_EQ(waiting()->text, "two");
  assessments.mark_seen(waiting()->uuid);
  EXPECT_FALSE(waiting());
  EXPECT_EQ(assessments.newest_unseen("dubois")->text, "a long thought for the next lesson");
}

TEST_F(StationRoutes, WhatCannotBeSentStaysInTheFormWithTheReason) {
  const std::string long_text(AssessmentStore::kLongestMessage + 1, 'x');
  const Response refused = ask("POST", "/station/message", {{"trainee", "dubois"}, {"text", long_text}});
  EXPECT_EQ(refused.status, 400);
  EXPECT_NE(refused.body.find(long_text), std::string::npos);
  EXPECT_NE(refused.body.find("at most 200 characters"), std::string::npos);
  EXPECT_EQ(ask("POST", "/station/message", {{"trainee", "dubois"}, {"text", "two\nlines"}}).status, 400);
  EXPECT_EQ(ask("POST", "/station/message", {{"trainee", "dubois"}, {"text", ""}}).status, 400);
  EXPECT_EQ(ask("POST", "/station/message", {{"trainee", "nobody"}, {"text", "hello"}}).status, 400);
  for (const char* code : {"", "guest", "demonstration"})
    EXPECT_EQ(ask("POST", "/station/message", {{"trainee", code}, {"text", "x"}}).status, 400) << code;
  EXPECT_FALSE(waiting());
}

TEST_F(StationRoutes, WithoutSourcesNothingRuns) {
  desk_.sources.stations = {};
  EXPECT_NE(ask("GET", "/station").body.find("Nothing runs"), std::string::npos);
  EXPECT_NE(ask("GET", "/station/message", {{"trainee", "dubois"}}).body.find("Not at a station"), std::string::npos);
}

}  // namespace
}  // namespace trocar::review::station_page_test
