// The device's run report in a recording: back to the bit, or refused with a name.
#include "app/session/grading/recorded_result.h"

#include <gtest/gtest.h>

#include "haptics/input_error.h"
#include "tests/tissue/support/temporary_folder.h"

namespace trocar::recorded_result_test {
namespace {

TEST(RecordedResult, TheRunReportComesBackToTheBit) {
  RunReport run_report;
  run_report.backend = "simulated";
  run_report.rate_hz = 1000;
  run_report.ticks = 60001;
  run_report.overruns = 3;
  run_report.min_energy_j = -1.0 / 3;
  run_report.kappa = 0.1 + 0.2;
  run_report.fault = "encoder-jump";
  run_report.realtime = R"({"policy":"fifo","missed":2})";
  const RunReport back = parse_run_report(run_report_json(run_report), "a.trec");
  EXPECT_EQ(std::tie(back.backend, back.rate_hz, back.ticks, back.overruns, back.min_energy_j, back.kappa, back.fault,
                     back.realtime),
            std::tie(run_report.backend, run_report.rate_hz, run_report.ticks, run_report.overruns,
                     run_report.min_energy_j, run_report.kappa, run_report.fault, run_report.realtime));
}

TEST(RecordedResult, AnUnreadableRunReportNamesItsRecording) {
  for (const char* text : {"{", "{}", "[]", R"({"backend": 3})"}) {
    EXPECT_CONTAINS(test::message_of<InputError>([&] { parse_run_report(text, "a.trec"); }), "a.trec: the run report");
  }
}

TEST(RecordedResult, ARecordingThatWasCutOffHasNone) {
  const test::TemporaryFolder folder;
  RecordingWriter(folder / "a.trec", "session", 1000).flush();
  EXPECT_FALSE(regrade_file(folder / "a.trec"));
  EXPECT_CONTAINS(test::message_of<InputError>([&] { regrade_file(folder / "none.trec"); }), "none.trec");
}

}  // namespace
}  // namespace trocar::recorded_result_test
