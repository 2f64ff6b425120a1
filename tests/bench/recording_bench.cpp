// Budget: recording of 60 s at 1 kHz within 0.6 MiB, encoded within 20 ms.
#include <benchmark/benchmark.h>

#include "app/session/recording/recording_reader.h"
#include "tests/app/session/recording/recording_samples.h"

namespace {

void encode_a_minute(benchmark::State& state) {
  const auto rows = trocar::realistic_ticks(60000, 1);
  double bytes = 0;
  for (auto step : state) {
    trocar::MemorySink sink;
    trocar::RecordingWriter writer(sink, "{}", 1000);
    for (const auto& row : rows) writer.append(row);
    writer.close({});
    bytes = static_cast<double>(sink.bytes().size());
  }
  state.counters["MiB"] = bytes / (1 << 20);
}
BENCHMARK(encode_a_minute)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->Repetitions(5);

void decode_a_minute(benchmark::State& state) {
  trocar::MemorySink sink;
  trocar::RecordingWriter writer(sink, "{}", 1000);
  for (const auto& row : trocar::realistic_ticks(60000, 1)) writer.append(row);
  writer.close({});
  for (auto step : state) benchmark::DoNotOptimize(trocar::parse_recording(sink.bytes(), "memory"));
}
BENCHMARK(decode_a_minute)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->Repetitions(5);

}  // namespace

BENCHMARK_MAIN();
