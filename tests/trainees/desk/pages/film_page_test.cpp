// Films and maps on the desk: what the pages say, parts of a file, who may ask.
#include "trainees/desk/pages/film_page.h"

#include <gtest/gtest.h>

#include "haptics/input_error.h"
#include "tests/trainees/desk/pages/page_checker.h"
#include "tests/trainees/desk/pages/page_samples.h"
#include "tests/trainees/records/cohort_samples.h"
#include "trainees/desk/pages/attempt_parts.h"
#include "trainees/desk/pages/pages.h"
#include "trainees/desk/routes/page_routes.h"
#include "trainees/desk/routes/route_table.h"
#include "trainees/records/attempt_store.h"

namespace trocar::review::film_page_test {
namespace {

using Stage = FilmState::Stage;

TEST(FilmPage, EveryStageHasItsPage) {
  AttemptView view = sample_attempt();
  EXPECT_EQ(check_page(film_page(view, sample_frame())).all("form").size(), 2U) << "sign out, make";
  view.film = {Stage::kMaking, 0.4, "Pictures are made.", 0};
  const std::string making = film_page(view, sample_frame());
  EXPECT_EQ(check_page(making).problems, std::vector<std::string>{});
  EXPECT_NE(making.find("<noscript><meta http-equiv=\"refresh\""), std::string::npos) << "progress without script";
  EXPECT_NE(making.find("<progress max=\"100\" value=\"40\">40 %</progress>"), std::string::npos);
  EXPECT_EQ(check_page(making).by_id("live")->of("data-every"), "2");
  view.film = {Stage::kReady, 0, "", 12345678};
  const CheckedPage ready = check_page(film_page(view, sample_frame()));
  EXPECT_EQ(ready.problems, std::vector<std::string>{});
  EXPECT_EQ(ready.all("video").size(), 1U);
  EXPECT_NE(ready.by_id("film")->text.find("12.3 MB"), std::string::npos);
  EXPECT_EQ(ready.by_id("live")->of("data-every"), "") << "nothing changes any more";
  view.film = {Stage::kFailed, 0, "no room left", 0};
  EXPECT_NE(check_page(film_page(view, sample_frame())).by_id("film")->text.find("no room leftTry again"),
            std::string::npos);
}

TEST(FilmPage, WhereNoneCanBeMadeASentenceSaysWhy) {
  AttemptView view = sample_attempt();
  view.no_film = kHostile;
  view.film.words = kHostile;
  const CheckedPage page = check_page(film_page(view, sample_frame()));
  EXPECT_EQ(page.problems, std::vector<std::string>{});
  EXPECT_EQ(page.all("form").size(), 1U);
  view.film.stage = Stage::kReady;
  EXPECT_EQ(check_page(film_page(view, sample_frame())).all("video").size(), 1U)
      << "one that was made before can be watched";
  EXPECT_NE(film_section(view, sample_frame()).find("Watch the film"), std::string::npos);
  view.trace.reset();
  EXPECT_EQ(film_section(view, sample_frame()), "");
}

TEST(ByteRanges, AreThoseOfRfc9110) {
  const auto of = [](const std::string& header, std::uint64_t size) {
    bool whole = false;
    const std::optional<ByteRange> range = asked_range(header, size, whole);
    return std::pair(range, whole);
  };
  const auto part = [](std::uint64_t from, std::uint64_t count) {
    return std::pair(std::optional(ByteRange{from, count}), false);
  };
  EXPECT_EQ(of("bytes=0-499", 10000), part(0, 500));
  EXPECT_EQ(of("bytes=9500-", 10000), part(9500, 500));
  EXPECT_EQ(of("bytes=-500", 10000), part(9500, 500));
  EXPECT_EQ(of("bytes=-50000", 10000), part(0, 10000));
  EXPECT_EQ(of("bytes=9999-99999999", 10000), part(9999, 1));
  EXPECT_EQ(of("bytes=0-", 10 * kMostAtOnce), part(0, kMostAtOnce)) << "the rest is asked for when it is needed";
  for (const char* beyond : {"bytes=10000-", "bytes=10000-10001", "bytes=-0"}) {
    EXPECT_FALSE(of(beyond, 10000).first) << beyond;
    EXPECT_FALSE(of(beyond, 10000).second) << beyond;
  }
  for (const char* none : {"", "bytes", "bytes=", "bytes=-", "bytes=a-b", "bytes=5-2", "bytes=0-1,5-6", "lines=0-1",
                           "bytes=0x1-2", "bytes=99999999999999999999-"})
    EXPECT_EQ(of(none, 10000), std::pair(std::optional(ByteRange{0, 10000}), true)) << none;
}

TEST(HeatSection, AsksForBothViewsAndSaysWhatIsPainted) {
  AttemptView view = sample_attempt();
  EXPECT_EQ(heat_section(view), "") << "a desk without graphics";
  view.heat = true;
  const CheckedPage page = check_page(attempt_page(view, sample_frame()));
  EXPECT_EQ(page.problems, std::vector<std::string>{});
  const auto pictures = page.all("img", "scope patient");
  ASSERT_EQ(pictures.size(), 2U);
  EXPECT_TRUE(pictures[0]->of("src").ends_with("/heat.png?of=time&view=scope"));
  EXPECT_TRUE(pictures[1]->of("src").ends_with("/heat.png?of=time&view=overview"));
  EXPECT_NE(page.by_id("heat")->text.find("seconds for which the tip was within 3 mm"), std::string::npos);
  view.heat_of_force = true;
  EXPECT_NE(heat_section(view).find("of=force&amp;view=scope"), std::string::npos);
  EXPECT_NE(heat_section(view).find("simulated plant"), std::string::npos);
  for (TraceSample& sample : view.trace->samples) sample.contact = false;
  EXPECT_NE(heat_section(view).find("Nothing was touched"), std::string::npos);
  EXPECT_EQ(heat_section(view).find("<img"), std::string::npos);
}

/// A desk whose film is 10 MB of known bytes.
class FilmRoutes : public testing::Test {
 protected:
  FilmRoutes() : database_(":memory:"), desk_{database_, {}, false}, table_(desk_routes()) {
    test::fill_cohort(database_, {});
    attempt_ = AttemptStore(database_).latest()->uuid;
    desk_.sources.film.state = [this](const std::string&) { return film_; };
    desk_.sources.film.make = [this](const std::string& uuid) {
      if (busy_) throw InputError("Another one is being made");
      made_.push_back(uuid);
    };
    desk_.sources.film.part = [](const std::string&, std::uint64_t from, std::uint64_t count) {
      std::string out;
      for (std::uint64_t i = from; i < from + count; ++i) out += static_cast<char>(i % 251);
      return out;
    };
    desk_.sources.heat = [](const std::string&, const HeatQuestion& q, int width) {
      return std::string(q.of_force ? "force " : "time ") + (q.overview ? "overview " : "scope ") +
             std::to_string(width);
    };
  }
  Response ask(const std::string& method, const std::string& path, std::map<std::string, std::string> query = {},
               const std::string& range = "") {
    const RouteTable::Found found = table_.find(method, path);
    Request request;
    request.path = path;
    request.arguments = found.arguments;
    request.query = std::move(query);
    request.range = range;
    request.account = Account{"a-1", "ines", "Dr Ines Okafor", Role::kInstructor};
    return found.route->answer(request, desk_);
  }
  Database database_;
  Desk desk_;
  RouteTable table_;
  std::string attempt_;
  FilmState film_;
  bool busy_ = false;
  std::vector<std::string> made_;
};

TEST_F(FilmRoutes, AreForWhoMaySeeTheAttempt) {
  int films = 0;
  for (const Route& route : film_routes()) {
    EXPECT_EQ(route.audience, Audience::kOwnData) << route.path;
    EXPECT_NE(route.path.find("{attempt}"), std::string::npos) << "the gate judges by it";
    ++films;
  }
  EXPECT_EQ(films, 3);
}

TEST_F(FilmRoutes, IsServedInPartsToPlayersAndWholeToOthers) {
  const std::string file = "/attempt/" + attempt_ + "/film.mp4";
  EXPECT_EQ(ask("GET", file).status, 404) << "not made yet";
  film_ = {Stage::kReady, 0, "", 1000};
  const Response whole = ask("GET", file, {{"save", "1"}});
  EXPECT_EQ(whole.status, 200);
  EXPECT_EQ(whole.body.size(), 1000u);
  EXPECT_TRUE(whole.accept_ranges);
  EXPECT_TRUE(whole.download.ends_with(".mp4"));
  const Response part = ask("GET", file, {}, "bytes=250-259");
  EXPECT_EQ(part.status, 206);
  EXPECT_EQ(part.content_range, "bytes 250-259/1000");
  EXPECT_EQ(part.body[1], '\0') << "byte 251 is the first of the second round";
  const Response beyond = ask("GET", file, {}, "bytes=1000-");
  EXPECT_EQ(beyond.status, 416);
  EXPECT_EQ(beyond.content_range, "bytes */1000");
}

TEST_F(FilmRoutes, MakingLeadsToTheFilmsPageAndARefusalSaysWhy) {
  const std::string page = "/attempt/" + attempt_ + "/film";
  const Response made = ask("POST", page);
  EXPECT_EQ(made.status, 303);
  EXPECT_EQ(made.location, page);
  EXPECT_EQ(made_, std::vector<std::string>{attempt_});
  busy_ = true;
  const Response refused = ask("POST", page);
  EXPECT_EQ(refused.status, 409);
  EXPECT_NE(refused.body.find("Another one is being made"), std::string::npos);
  desk_.sources.film.make = {};
  desk_.sources.no_film = "No film: the program ffmpeg is not on this machine.";
  EXPECT_NE(ask("POST", page).body.find("ffmpeg is not on this machine"), std::string::npos);
  EXPECT_NE(ask("GET", page).body.find("ffmpeg is not on this machine"), std::string::npos);
  EXPECT_EQ(ask("GET", "/attempt/0000-none/film").status, 404);
}

TEST_F(FilmRoutes, MapsAreAskedByNameOnly) {
  const std::string map = "/attempt/" + attempt_ + "/heat.png";
  EXPECT_EQ(ask("GET", map).body, "time scope 800");
  EXPECT_EQ(ask("GET", map, {{"of", "force"}, {"view", "overview"}}).body, "force overview 800");
  for (const auto& odd : std::vector<std::map<std::string, std::string>>{{{"of", "money"}}, {{"view", "../x"}}})
    EXPECT_EQ(ask("GET", map, odd).status, 404);
  desk_.sources.heat = [](const std::string&, const HeatQuestion&, int) -> std::string {
    throw EnvironmentError("ask again in a moment");
  };
  EXPECT_EQ(ask("GET", map).status, 503);
}

}  // namespace
}  // namespace trocar::review::film_page_test
