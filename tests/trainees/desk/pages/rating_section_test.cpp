// Ratings on the attempt's page: the form has every item and may leave it out, the table sums whole sheets only,
// trainees only read.
#include <gtest/gtest.h>

#include "tests/trainees/desk/pages/page_checker.h"
#include "tests/trainees/desk/pages/page_samples.h"
#include "tests/trainees/desk/server/desk_samples.h"
#include "trainees/desk/pages/attempt_parts.h"
#include "trainees/desk/routes/page_routes.h"
#include "trainees/records/assessments.h"
#include "trainees/records/rating_scales.h"

namespace trocar::review::rating_section_test {
namespace {

std::vector<Rating> rated(const std::string& rater, double value) {
  std::vector<Rating> out;
  for (const RatingItem& item : goals_scale().items)
    out.push_back({"", "", rater, "GOALS", item.name, "2026-11-22T10:00:00Z", value});
  return out;
}

std::string text_of(const AttemptView& view, const Frame& frame) {
  const CheckedPage page = check_page(attempt_page(view, frame));
  EXPECT_EQ(page.problems, std::vector<std::string>{});
  const PageElement* part = page.by_id("ratings");
  return part == nullptr ? "" : part->text;
}

TEST(RatingSection, TheFormOffersEveryItemAndTheWayOut) {
  AttemptView view = sample_attempt();
  view.ratings.clear();
  const CheckedPage page = check_page(attempt_page(view, sample_frame()));
  EXPECT_EQ(page.problems, std::vector<std::string>{});
  EXPECT_EQ(page.all("fieldset", "rate").size(), 5U);
  int radios = 0, unrated = 0;
  for (const PageElement* input : page.all("input")) {
    if (input->of("type") != "radio") continue;
    ++radios;
    if (input->of("value").empty() && input->of("checked") == "checked") ++unrated;
  }
  EXPECT_EQ(radios, 30);
  EXPECT_EQ(unrated, 5);
}

TEST(RatingSection, SumsWholeSheetsAndSaysHowManyRaters) {
  AttemptView view = sample_attempt();
  view.ratings = rated("Ida", 3);
  EXPECT_EQ(text_of(view, sample_frame()).find("raters"), std::string::npos);
  for (const Rating& rating : rated("Otto", 4)) view.ratings.push_back(rating);
  EXPECT_NE(text_of(view, sample_frame()).find("Mean sum 17.5, from 15 to 20, n = 2 raters."), std::string::npos);
  view.ratings.pop_back();
  EXPECT_NE(text_of(view, sample_frame()).find("not all items"), std::string::npos);
  EXPECT_EQ(text_of(view, sample_frame()).find("raters."), std::string::npos);
}

TEST(RatingSection, ATraineeReadsAndWritesNothing) {
  AttemptView view = sample_attempt();
  view.ratings = rated(kHostile, 3);
  Frame frame = sample_frame();
  frame.may_write = false;
  EXPECT_EQ(check_page(attempt_page(view, frame)).all("fieldset", "rate").size(), 0U);
  EXPECT_NE(text_of(view, frame), "");
  view.ratings.clear();
  EXPECT_EQ(text_of(view, frame), "");
}

TEST(RatingSection, OtherScalesStayAsTheyWereGiven) {
  AttemptView view = sample_attempt();
  view.ratings = {{"", "", "Ida", "OSATS", "flow", "2026-11-22T10:00:00Z", 3.5}};
  EXPECT_NE(text_of(view, sample_frame()).find("Other scales"), std::string::npos);
}

class RatingRoute : public DeskTest {
 protected:
  RatingRoute() {
    add_accounts();
    make_gate({}, assessment_routes());
  }
  Answer rate(const std::string& login, const std::string& body) {
    const Visitor visitor = signed_in(login);
    return ask("POST", "/attempt/" + annas_ + "/rate", visitor, "token=" + visitor.token + "&scale=GOALS" + body);
  }
  std::vector<Rating> kept() { return AssessmentStore(database_).ratings_of(annas_); }
};

TEST_F(RatingRoute, KeepsWhatWasChosenUnderTheRatersName) {
  EXPECT_EQ(rate("ines", "&efficiency=4&autonomy=&tissue+handling=2").response.status, 303);
  ASSERT_EQ(kept().size(), 2U);
  EXPECT_EQ(kept()[0].item, "efficiency");
  EXPECT_EQ(kept()[0].value, 4);
  EXPECT_EQ(kept()[1].item, "tissue handling");
  EXPECT_NE(kept()[0].account_uuid, "");
}

TEST_F(RatingRoute, RefusesTraineesAndWhatIsNoValue) {
  EXPECT_EQ(rate("anna", "&efficiency=4").response.status, 403);
  for (const char* body :
       {"", "&efficiency=6", "&efficiency=0", "&efficiency=four", "&efficiency=4.5", "&efficiency=-1", "&charm=4"})
    EXPECT_EQ(rate("ines", body).response.status, 400) << body;
  EXPECT_TRUE(kept().empty());
}

}  // namespace
}  // namespace trocar::review::rating_section_test
