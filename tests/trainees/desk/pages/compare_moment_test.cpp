// Two attempts at the same moment: shared marks, shift, pictures side by side, without script.
#include "trainees/desk/pages/compare_moment.h"

#include <gtest/gtest.h>

#include "tests/trainees/desk/pages/page_checker.h"
#include "tests/trainees/desk/pages/page_samples.h"
#include "trainees/desk/pages/pages.h"

namespace trocar::review::compare_moment_test {
namespace {

Event event(double t_s, const std::string& type, Severity severity = Severity::kInfo) {
  Event out;
  out.t_s = t_s;
  out.type = type;
  out.severity = severity;
  return out;
}

/// The right one does everything later: first target by 2 s, second by 5 s.
CompareView sample() {
  CompareView view = sample_compare();
  const double l = view.left.begin_s(), r = view.right.begin_s();
  view.left.result.events = {event(l + 4, "TARGET_HELD"), event(l + 6, "MARKED"), event(l + 9, "TARGET_HELD"),
                             event(l + 11, "EXCESS_FORCE", Severity::kMajor), event(l + 12, "TARGET_HELD")};
  view.right.result.events = {event(r + 6, "TARGET_HELD"), event(r + 7, "MARKED"),
                              event(r + 8, "EXCESS_FORCE", Severity::kMajor), event(r + 14, "TARGET_HELD")};
  view.left.picture = view.right.picture = true;
  return view;
}

TEST(SharedMarks, AreTheNthOfWhatBothDidWell) {
  const CompareView view = sample();
  const std::vector<SharedMark> marks = shared_marks(view.left, view.right);
  ASSERT_EQ(marks.size(), 2u) << "no blame, no person's marks, and only two of three targets are in both";
  EXPECT_EQ(marks[0].words, "Target held 1");
  EXPECT_DOUBLE_EQ(marks[0].left_s, 4);
  EXPECT_DOUBLE_EQ(marks[0].right_s, 6);
  EXPECT_EQ(marks[1].words, "Target held 2");
  EXPECT_DOUBLE_EQ(shift_s(marks, 2), 5);
  for (const int none : {0, 3, -1}) EXPECT_EQ(shift_s(marks, none), 0);
  EXPECT_TRUE(shared_marks(view.left, AttemptView{}).empty());
  EXPECT_EQ(start_mark(marks), 0);
  EXPECT_EQ(start_mark({{"Target lit 1", 1, 1}, {"Start 1", 2, 3}}), 2);
}

TEST(CompareMoment, BothPicturesShowTheSameMomentFromTheirBeginnings) {
  CompareView view = sample();
  view.t_s = 7.5;
  const CheckedPage page = check_page(compare_page(view, sample_frame()));
  EXPECT_EQ(page.problems, std::vector<std::string>{});
  const auto pictures = page.all("img", "scope follows");
  ASSERT_EQ(pictures.size(), 2U);
  EXPECT_EQ(pictures[0]->of("src"), "/attempt/" + view.left.result.uuid + "/picture.png?t=7.50");
  EXPECT_EQ(pictures[1]->of("src"), "/attempt/" + view.right.result.uuid + "/picture.png?t=7.50");
  EXPECT_NE(page.by_id("moment")->text.find("Both from their own beginning."), std::string::npos);
  ASSERT_NE(page.by_id("both"), nullptr);
  EXPECT_EQ(page.by_id("both")->of("value"), "7.5");
}

TEST(CompareMoment, LaidOnASharedMarkTheSecondIsShownLater) {
  CompareView view = sample();
  view.t_s = 9;
  view.aligned = 2;
  const std::string html = compare_page(view, sample_frame());
  const CheckedPage page = check_page(html);
  EXPECT_EQ(page.problems, std::vector<std::string>{});
  EXPECT_NE(page.all("img", "scope follows")[1]->of("src").find("?t=14.00"), std::string::npos);
  EXPECT_NE(page.by_id("moment")->text.find("The second is shown 5.0 s later"), std::string::npos);
  bool keeps = false, back = false;
  for (const PageElement* link : page.all("a")) {
    keeps = keeps || link->of("href").ends_with("?t=10.00&by=2#moment");
    back = back || (link->of("href").ends_with("?t=4.00&by=1#moment") &&
                    link->text.find("both at Target held 1") != std::string::npos);
  }
  EXPECT_TRUE(keeps) << "a step keeps what they lie on";
  EXPECT_TRUE(back);
}

TEST(CompareMoment, SaysWhereOneIsOverOrHasNotBegun) {
  CompareView view = sample();
  view.right.result.events[0].t_s = view.right.begin_s() + 1;  // the right one is 3 s earlier at the first target
  view.aligned = 1;
  view.t_s = 0;
  std::string text = check_page(compare_page(view, sample_frame())).by_id("moment")->text;
  EXPECT_NE(text.find("not begun: its beginning is shown"), std::string::npos) << text;
  view.right.trace->samples.resize(view.right.trace->samples.size() / 2);
  view.aligned = 0;
  view.t_s = 50;
  const CheckedPage page = check_page(compare_page(view, sample_frame()));
  text = page.by_id("moment")->text;
  EXPECT_NE(text.find("its end is shown"), std::string::npos) << text;
  EXPECT_EQ(page.all("img", "scope follows")[1]->of("src").find("?t=50"), std::string::npos);
}

TEST(CompareMoment, WithoutPicturesOrRecordings) {
  CompareView view = sample();
  view.right.picture = false;
  EXPECT_EQ(check_page(compare_page(view, sample_frame())).all("img", "scope follows").size(), 1U);
  view.right.trace.reset();
  EXPECT_EQ(check_page(compare_page(view, sample_frame())).problems, std::vector<std::string>{});
  view.left.trace.reset();
  EXPECT_EQ(check_page(compare_page(view, sample_frame())).by_id("moment"), nullptr);
}

}  // namespace
}  // namespace trocar::review::compare_moment_test
