// The device's receipt in a recording: back to the bit, or refused with a name.
#include "app/session/grading/recorded_result.h"

#include <gtest/gtest.h>

#include "haptics/input_error.h"
#include "tests/tissue/support/temporary_folder.h"

namespace trocar::recorded_result_test {
namespace {

TEST(RecordedResult, TheReceiptComesBackToTheBit) {
  DeviceReceipt receipt;
  receipt.backend = "simulated";
  receipt.rate_hz = 1000;
  receipt.ticks = 60001;
  receipt.overruns = 3;
  receipt.min_energy_j = -1.0 / 3;
  receipt.kappa = 0.1 + 0.2;
  receipt.fault = "encoder-jump";
  receipt.realtime = R"({"policy":"fifo","missed":2})";
  const DeviceReceipt back = parse_receipt(receipt_json(receipt), "a.trec");
  EXPECT_EQ(std::tie(back.backend, back.rate_hz, back.ticks, back.overruns, back.min_energy_j, back.kappa, back.fault,
                     back.realtime),
            std::tie(receipt.backend, receipt.rate_hz, receipt.ticks, receipt.overruns, receipt.min_energy_j,
                     receipt.kappa, receipt.fault, receipt.realtime));
}

TEST(RecordedResult, AnUnreadableReceiptNamesItsRecording) {
  for (const char* text : {"{", "{}", "[]", R"({"backend": 3})"}) {
    EXPECT_CONTAINS(test::message_of<InputError>([&] { parse_receipt(text, "a.trec"); }),
                    "a.trec: the device's receipt");
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
