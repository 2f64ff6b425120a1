#include <gtest/gtest.h>

#include "tests/trainees/desk/pages/page_checker.h"
#include "tests/trainees/desk/pages/page_samples.h"
#include "trainees/desk/pages/charts.h"

namespace trocar::review::trainee_page_test {
namespace {

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++n;
  return n;
}

TEST(TraineePage, IsSoundAndHasItsParts) {
  const CheckedPage page = check_page(trainee_page(sample_trainee(), sample_frame()));
  EXPECT_EQ(page.problems, std::vector<std::string>{});
  for (const char* id : {"exercises", "curve", "notes", "attempts", "time", "due", "certificates"})
    EXPECT_NE(page.by_id(id), nullptr) << id;
  EXPECT_EQ(page.by_id("curve-h")->text, "Surface touch L2, mouse");
}

TEST(TraineePage, GridHasExercisesByLevelsWithShapeAndScore) {
  const CheckedPage page = check_page(trainee_page(sample_trainee(), sample_frame()));
  const auto cells = page.all("a", "gridcell");
  ASSERT_EQ(cells.size(), 3U);
  EXPECT_EQ(cells[0]->text, "plateau 81.0 16 tries");  // limited grasp stands first, in order of the titles
  EXPECT_EQ(cells[1]->text, "ready 81.0 16 tries");
  EXPECT_EQ(cells[1]->of("href"), "/trainee/bo?exercise=surface-touch&level=L1&hand=mouse&rubric=bbbbbbbbbbbb#curve");
  EXPECT_EQ(cells[2]->of("aria-current"), "true");
}

TEST(TraineePage, CaptionSaysWhereTheBenchmarkComesFrom) {
  const CheckedPage page = check_page(trainee_page(sample_trainee(), sample_frame()));
  const std::string caption = page.all("figcaption")[0]->text;
  EXPECT_NE(caption.find("Benchmark 88.5: mean - 2 SD of input expert, n = 6, 1 Feb 2026."), std::string::npos)
      << caption;
  EXPECT_NE(caption.find("n = 3 to 8"), std::string::npos) << caption;
  TraineeView view = sample_trainee();
  view.chosen = 2;
  const CheckedPage other = check_page(trainee_page(view, sample_frame()));
  EXPECT_NE(other.all("figcaption")[0]->text.find("No benchmark is set"), std::string::npos);
  EXPECT_NE(other.all("figcaption")[0]->text.find("Too few others"), std::string::npos);
}

TEST(TraineePage, JudgementsCarryEvidenceCountAndRule) {
  const CheckedPage page = check_page(trainee_page(sample_trainee(), sample_frame()));
  EXPECT_EQ(page.all("ul", "judgements")[0]->text,
            "plateau +1.2 points over the newest 6 attempts n = 6, reliability not known yet, rules 1");
}

TEST(TraineePage, AScoreFromALoopWithoutRightsIsMarkedInListAndTable) {
  TraineeView view = sample_trainee();
  EXPECT_EQ(trainee_page(view, sample_frame()).find("soft real time"), std::string::npos);
  for (CurvePoint& point : view.curves[view.chosen].points) point.soft_real_time = true;
  const CheckedPage page = check_page(trainee_page(view, sample_frame()));
  EXPECT_EQ(page.problems, std::vector<std::string>{});
  EXPECT_NE(page.by_id("attempts")->text.find("soft real time"), std::string::npos);
  EXPECT_NE(trainee_csv(view).find(",decided_by,soft_real_time"), std::string::npos);
}

TEST(TraineePage, NotesThreadWithForm) {
  const CheckedPage page = check_page(trainee_page(sample_trainee(), sample_frame()));
  const std::string notes = page.by_id("notes")->text;
  EXPECT_LT(notes.find("Traction too strong"), notes.find("Welcome."));
  EXPECT_NE(notes.find("not met yet"), std::string::npos);
  EXPECT_NE(notes.find("met 11 Mar 2026, 08:00"), std::string::npos);
  bool posts = false;
  for (const PageElement* form : page.all("form")) posts = posts || form->of("action") == "/trainee/bo/note";
  EXPECT_TRUE(posts);
}

TEST(TraineePage, ATraineeSeesNoFormsButSignOut) {
  Frame frame = sample_frame();
  frame.may_write = false;
  frame.own_code = "bo";
  const CheckedPage page = check_page(trainee_page(sample_trainee(), frame));
  EXPECT_EQ(page.problems, std::vector<std::string>{});
  ASSERT_EQ(page.all("form").size(), 1U);
  EXPECT_EQ(page.all("form")[0]->of("action"), "/sign-out");
  for (const PageElement* link : page.all("a")) {
    EXPECT_NE(link->of("href"), "/");
    EXPECT_FALSE(link->of("href").starts_with("/?group"));
  }
}

TEST(TraineePage, CertificatesShowEvidenceAndWithdrawal) {
  TraineeView view = sample_trainee();
  view.certificates[0].evidence = R"({"words":"14 passes in a row","n":16,"rules":"1"})";
  const CheckedPage page = check_page(trainee_page(view, sample_frame()));
  const auto all = page.all("article", "certificate");
  ASSERT_EQ(all.size(), 2U);
  EXPECT_NE(all[0]->text.find("14 passes in a row; n 16; rules 1"), std::string::npos) << all[0]->text;
  EXPECT_NE(all[0]->text.find("Dr Ines Okafor"), std::string::npos);
  EXPECT_NE(all[1]->text.find("Withdrawn 3 Feb 2026: Device was out of calibration"), std::string::npos);
  std::size_t forms = 0;
  for (const PageElement* form : page.all("form")) forms += form->of("action") == "/certificate/c1/revoke" ? 1 : 0;
  EXPECT_EQ(forms, 1U);
}

TEST(TraineePage, ACertificateIsCalledByItsExerciseAndNamesAttemptsByNumber) {
  TraineeView view = sample_trainee();
  for (CurvePoint& point : view.curves[0].points) point.number = 100 + std::stoi(point.uuid.substr(5));
  view.certificates[0].evidence =
      R"({"attempt":"uuid-16","row_hash":")" + std::string(64, 'e') +
      R"(","words":"14 passes in a row","n":16,"attempts":["uuid-3","uuid-16"],"overrides":[{"attempt":"uuid-3",)"
      R"("decision":"d1","passed":true,"by":"Dr Brandt","utc":"2026-03-14T10:00:00Z","reason":"stand slipped"}]})";
  view.shaken["c1"] = "decided not passed by Dr Brandt on 2026-03-20: no";
  const std::string html = trainee_page(view, sample_frame());
  const CheckedPage page = check_page(html);
  EXPECT_EQ(page.problems, std::vector<std::string>{});
  const std::string said = page.all("article", "certificate")[0]->text;
  for (const char* words :
       {"Surface touch L1", "Cites attempt no. 116, 25 Mar 2026", "on 20 Mar 2026: no. Look",
        "passed by decision of Dr Brandt, 14 Mar 2026, attempt no. 103, 12 Mar 2026: stand slipped"})
    EXPECT_NE(said.find(words), std::string::npos) << words << "\n" << said;
  EXPECT_EQ(said.find("uuid-"), std::string::npos) << said;
  EXPECT_NE(html.find("<summary>Row hash</summary><p class=\"mono\">eeee"), std::string::npos);
  EXPECT_EQ(count(said, "eeee"), 16U) << "once, folded away";
}

TEST(TraineePage, DueDatesThatAreOverCarryABadge) {
  const CheckedPage page = check_page(trainee_page(sample_trainee(), sample_frame()));
  const std::string due = page.by_id("due")->text;
  EXPECT_EQ(count(due, "retention due"), 1U);
  EXPECT_NE(due.find("15 Mar 2026"), std::string::npos);
  EXPECT_NE(due.find("31 Aug 2026"), std::string::npos);
}

TEST(TraineePage, EmptyAndHostile) {
  TraineeView empty;
  empty.code = "new";
  EXPECT_EQ(check_page(trainee_page(empty, sample_frame())).problems, std::vector<std::string>{});
  TraineeView view = sample_trainee();
  view.code = view.name = view.rules_version = kHostile;
  view.groups = {kHostile};
  CurveView& curve = view.curves[0];
  curve.title = curve.key.exercise_id = curve.key.level = curve.key.hand = curve.key.rubric_sha256 = kHostile;
  for (CurvePoint& point : curve.points) point.uuid = point.utc = point.status = kHostile;
  curve.judgements = {judged(Flag::kStuck, kHostile)};
  curve.benchmark->rule = curve.benchmark->source = curve.benchmark->utc = kHostile;
  for (Note& note : view.notes) note.text = note.author = note.printed = note.attempt_uuid = note.utc = kHostile;
  for (Certificate& c : view.certificates)
    c.uuid = c.exercise_id = c.level = c.evidence = c.printed = c.rule_version = c.utc = kHostile;
  for (DueDate& due : view.due) due.exercise = due.level = due.utc = due.why = kHostile;
  for (auto& week : view.minutes_by_week) week.first = kHostile;
  const std::string html = trainee_page(view, sample_frame());
  EXPECT_EQ(check_page(html).problems, std::vector<std::string>{});
  EXPECT_EQ(html.find("<script>"), std::string::npos);
}

TEST(Curve, PointsAreLinksAndTellPassedFromNot) {
  const std::string svg = curve_svg(sample_trainee().curves[0]);
  EXPECT_EQ(count(svg, "<a href=\"/attempt/uuid-"), 16U);
  EXPECT_EQ(count(svg, "fill=\"#fff\""), 11U);      // hollow: 15 graded, 4 of them passed
  EXPECT_EQ(count(svg, "stroke=\"#5b6570\""), 1U);  // the aborted one
  EXPECT_NE(svg.find("attempt 16, 25 Mar 2026: 81.0, passed"), std::string::npos);
  // 75 of 100 between 252 (0) and 14 (100).
  EXPECT_NE(svg.find("y1=\"73.5\""), std::string::npos);
}

TEST(Curve, TenThousandAttemptsDrawTheNewest) {
  CurveView curve;
  for (int i = 0; i < 10000; ++i)
    curve.points.push_back({"u" + std::to_string(i), "2026-03-01T00:00:00Z", "completed", 50.0, false});
  const std::string svg = curve_svg(curve);
  EXPECT_EQ(count(svg, "<a href"), kPointsDrawn);
  EXPECT_NE(svg.find("/attempt/u9999"), std::string::npos);
  EXPECT_EQ(svg.find("/attempt/u9799\""), std::string::npos);
  EXPECT_LT(svg.size(), 100000U);
}

TEST(Cusum, DrawsOneMarkAnAttemptAndALargeOneWhereItDecided) {
  CurveView curve;
  curve.cusum = cusum(std::vector<bool>(14, true));
  ASSERT_TRUE(curve.cusum.back().decided);
  const std::string svg = cusum_svg(curve);
  EXPECT_EQ(count(svg, "<circle"), 14U);
  EXPECT_EQ(count(svg, "r=\"6.5\""), 1U);
  EXPECT_NE(svg.find(">shown<"), std::string::npos);
  EXPECT_NE(svg.find(">relapse<"), std::string::npos);
}

TEST(Weeks, BarsStandForMinutes) {
  const std::string svg = weeks_svg({{"2026-03-02", 30}, {"2026-03-09", 15}});
  EXPECT_EQ(count(svg, "<rect"), 2U);
  // Bottom 168, top 14: 30 min are the whole height, 15 half of it.
  EXPECT_NE(svg.find("height=\"154.0\""), std::string::npos) << svg;
  EXPECT_NE(svg.find("height=\"77.0\""), std::string::npos) << svg;
  EXPECT_NE(svg.find("week of 9 Mar 2026: 15 min"), std::string::npos);
  std::vector<std::pair<std::string, double>> many(100, {"2026-01-05", 1});
  EXPECT_EQ(count(weeks_svg(many), "<rect"), 26U);
  EXPECT_EQ(count(weeks_svg({}), "<rect"), 0U);
}

TEST(TraineeCsv, OneLineAnAttempt) {
  TraineeView view = sample_trainee();
  view.curves.resize(1);
  view.curves[0].points.resize(1);
  EXPECT_EQ(trainee_csv(view),
            "trainee,exercise,level,input,rules_sha256,try,number,attempt,started_utc,status,score,passed,passed_by_"
            "score,decided_by,soft_real_time\r\n"
            "bo,surface-touch,L2,mouse," +
                std::string(64, 'a') + ",1,0,uuid-1,2026-03-10T09:00:00Z,completed,33,0,0,,0\r\n");
}

}  // namespace
}  // namespace trocar::review::trainee_page_test
