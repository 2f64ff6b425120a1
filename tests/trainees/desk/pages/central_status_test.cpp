// What pages of a desk for many stations say of the centre, and of recordings that are elsewhere.
#include <gtest/gtest.h>

#include "haptics/digest/digest.h"
#include "tests/trainees/desk/pages/page_checker.h"
#include "tests/trainees/desk/pages/page_samples.h"
#include "tests/trainees/records/store_samples.h"
#include "trainees/desk/queries/desk_views.h"
#include "trainees/files/write_file.h"
#include "trainees/records/replica_facts.h"

namespace trocar::review::central_status_test {
namespace {

bool holds(const std::string& page, const std::string& part) { return page.find(part) != std::string::npos; }

Frame frame_with(const ReplicaStatus& central) {
  Frame frame = sample_frame();
  frame.now_utc = "2026-11-22T13:05:20.000Z";
  frame.central = central;
  return frame;
}

TEST(ReplicaStatus, IsAtTheFootOfThePage) {
  const std::string page = document(frame_with({"central.example/trocar", "2026-11-22T13:05:09.123Z"}), "<h1>x</h1>");
  EXPECT_TRUE(holds(page,
                    "Central record as of <time datetime=\"2026-11-22T13:05:09.123Z\">13:05:09</time> UTC"
                    " from central.example/trocar."));
  EXPECT_FALSE(holds(page, "cannot be reached"));
  EXPECT_FALSE(holds(page, "class=\"central\""));
  EXPECT_EQ(check_page(page).problems, std::vector<std::string>{});
}

TEST(ReplicaStatus, IsNotOnThePagesOfAStationsOwnDesk) {
  EXPECT_FALSE(holds(document(frame_with({}), "<h1>x</h1>"), "Central record"));
}

TEST(ReplicaStatus, ALostCentreIsToldBeforeAnythingElse) {
  ReplicaStatus lost{"central.example/trocar", "2026-11-21T23:59:58.000Z", "2026-11-22T00:00:03.000Z", "no route", 2};
  const std::string page = document(frame_with(lost), "<h1>x</h1>");
  EXPECT_TRUE(holds(page, "<strong>The centre central.example/trocar cannot be reached</strong> since"));
  EXPECT_TRUE(holds(page, ">00:00:03</time> UTC.")) << "today: the clock alone";
  EXPECT_TRUE(holds(page, ">21 Nov 2026, 23:59:58</time> UTC.")) << "another day: with it";
  EXPECT_TRUE(holds(page, "2 things written at this desk are kept here and not at the centre yet."));
  EXPECT_LT(page.find("cannot be reached"), page.find("<h1>x</h1>"));
  EXPECT_EQ(check_page(page).problems, std::vector<std::string>{});
  lost.waiting = 1;
  EXPECT_TRUE(
      holds(document(frame_with(lost), ""), "1 thing written at this desk is kept here and not at the centre yet."));
}

TEST(ReplicaStatus, WhatWaitsIsToldAlsoWhileTheCentreIsThere) {
  const std::string page = document(frame_with({"central.example/trocar", "2026-11-22T13:05:09.123Z", "", "", 1}), "");
  EXPECT_TRUE(holds(page, "1 thing written at this desk"));
  EXPECT_FALSE(holds(page, "cannot be reached"));
}

TEST(ReplicaStatus, AHostIsTextAndNothingElse) {
  const std::string utc = "2026-11-22T13:05:09.123Z";
  const std::string page = document(frame_with({"<script>x</script>", utc, utc, "<b>", 0}), "");
  EXPECT_FALSE(holds(page, "<script>x"));
}

class ElsewhereRecorded : public TemporaryFolder {};

TEST_F(ElsewhereRecorded, AnAttemptOfAStationSaysWhereItsRecordingIs) {
  Database database(folder_ / "desk.db");
  AttemptStart start = sample_start("T-a");
  start.recording = folder_ / "never-made.trec";
  const AttemptId id = store_attempt(database, start, sample_result());
  Desk desk{database};
  EXPECT_FALSE(holds(attempt_view(desk, {}, id.uuid).no_trace, "at station")) << "an attempt of one's own";
  ASSERT_EQ(run_outside(folder_ / "desk.db",
                        "INSERT INTO station VALUES ('s-1', 'north', 0); INSERT INTO replica SELECT id, 's-1', 1, ''"
                        " FROM attempt"),
            "");
  EXPECT_TRUE(holds(attempt_view(desk, {}, id.uuid).no_trace, "The recording is at station north"));
  EXPECT_FALSE(attempt_view(desk, {}, id.uuid).picture);
}

TEST_F(ElsewhereRecorded, AnotherFileInItsPlaceSaysNothingOfTheAttempt) {
  Database database(folder_ / "desk.db");
  AttemptStart start = sample_start("T-a");
  start.recording = folder_ / "a.trec";
  AttemptResult result = sample_result();
  result.recording_sha256 = digest::of_bytes("as it was kept");
  Desk desk{database};
  desk.sources.trace = [](const std::filesystem::path&) { return Trace{}; };
  write_file(*start.recording, "as it was kept");
  const AttemptId id = store_attempt(database, start, result);
  EXPECT_TRUE(attempt_view(desk, {}, id.uuid).trace);
  write_file(*start.recording, "another");
  EXPECT_FALSE(attempt_view(desk, {}, id.uuid).trace);
  EXPECT_TRUE(holds(attempt_view(desk, {}, id.uuid).no_trace, "Another file lies in the place of its recording"));
}

TEST_F(ElsewhereRecorded, TheFrameAsksHowTheCentreStands) {
  Database database(folder_ / "desk.db");
  Desk desk{database};
  EXPECT_EQ(frame_of({}, desk).central.host, "");
  desk.sources.central = [] { return ReplicaStatus{"central.example/trocar", "2026-11-22T13:05:09.123Z"}; };
  EXPECT_EQ(frame_of({}, desk).central.host, "central.example/trocar");
}

}  // namespace
}  // namespace trocar::review::central_status_test
