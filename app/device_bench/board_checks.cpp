#include "app/device_bench/board_checks.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>

#include "app/device_bench/board_run.h"

namespace trocar {
namespace {

using Outcome = BoardCheck::Outcome;

constexpr double kCommandShare = 0.15;  // of full scale, on one channel at a time
constexpr double kCommandS = 0.040;
constexpr std::int32_t kLeastMotion = 5;  // counts between the two signs of a command
constexpr std::int32_t kEnough = 20;      // counts: beyond it an end stop may throw a channel back
constexpr double kPinchS = 500e-6;        // in which the pinch at full scale makes more than kSlack counts
constexpr std::int32_t kSlack = 1;        // counts: phase of the disc
constexpr double kActS = 0.100;           // when the bench acts
constexpr int kAllChannels = (1 << kChannels) - 1;

std::string channel_words(int i) { return i == kPinchChannel ? "pinch" : "joint " + std::to_string(i + 1); }
std::string join(const std::string& list, const std::string& word) { return list.empty() ? word : list + ", " + word; }

BoardCheck passed(const std::string& detail) { return {"", Outcome::kPassed, detail}; }
BoardCheck failed(const std::string& detail) { return {"", Outcome::kFailed, detail}; }
BoardCheck left_out() { return {"", Outcome::kLeftOut, "this bench cannot do it"}; }
BoardCheck verdict(const std::string& faults, const std::string& detail) {
  return faults.empty() ? passed(detail) : failed(faults);
}

BoardCheck capabilities(BoardBench& bench) {
  const auto board = bench.open({});
  const DaqCapabilities c = board->capabilities();
  const bool sane = c.name && std::strlen(c.name) > 0 && c.rate_hz >= 100 && c.rate_hz <= 10000 && c.dac_bits >= 8 &&
                    c.dac_bits <= 24;
  const std::string words = std::string(c.name ? c.name : "no name") + ", " + std::to_string(std::lround(c.rate_hz)) +
                            " Hz, " + std::to_string(c.dac_bits) + " bits";
  return sane ? passed(words) : failed(words + ": a name, 100 to 10000 Hz and 8 to 24 bits are expected");
}

BoardCheck every_sync(BoardBench& bench) {
  BoardRun run(bench, {});
  run.rest(0.200);
  for (std::size_t k = 0; k < run.samples().size(); ++k) {
    const std::uint32_t periods = run.samples()[k].elapsed_periods;
    if (periods != 1)
      return failed("read " + std::to_string(k) + " says that " + std::to_string(periods) + " periods have elapsed");
  }
  return passed(std::to_string(run.samples().size()) + " reads, a period each");
}

BoardCheck valid_bits(BoardBench& bench) {
  BoardRun run(bench, {});
  run.rest(0.200);
  int down = 0;
  for (const DaqSample& sample : run.samples()) down |= kAllChannels & ~sample.valid;
  std::string faults;
  for (int i = 0; i < kChannels; ++i) {
    if (down >> i & 1) faults = join(faults, channel_words(i));
  }
  for (const DaqSample& sample : run.samples()) {
    if (sample.valid & ~kAllChannels) return failed("a bit of a channel that does not exist is set");
  }
  return verdict(faults.empty() ? "" : "not latched: " + faults, "all seven channels latched");
}

BoardCheck quiet_inputs(BoardBench& bench) {
  BoardRun run(bench, {});
  run.rest(0.200);
  std::uint32_t seen = 0;
  for (const DaqSample& sample : run.samples()) seen |= sample.digital_in;
  std::string faults;
  if (seen & kEmergencyStop) faults = join(faults, "emergency stop");
  if (seen & kWatchdogFired) faults = join(faults, "watchdog");
  for (int i = 0; i < kChannels; ++i) {
    if (channel_input(seen, kDriveFault, i)) faults = join(faults, "drive fault of " + channel_words(i));
    if (channel_input(seen, kDriveHot, i)) faults = join(faults, "over-temperature of " + channel_words(i));
  }
  return verdict(faults.empty() ? "" : "already there: " + faults, "no stop, fault or over-temperature");
}

BoardCheck rest_in_jig(BoardBench& bench) {
  BoardRun run(bench, {});
  run.rest(0.200);
  std::string faults;
  for (int i = 0; i < kChannels; ++i) {
    if (run.span(i) > kSlack)
      faults = join(faults, channel_words(i) + " by " + std::to_string(run.span(i)) + " counts");
  }
  const bool beam = (run.samples().back().digital_in & kHomeBeam) != 0;
  if (!beam) faults = join(faults, "no light in the home beam");
  return verdict(faults.empty() ? "" : "moved in the jig: " + faults, "counters still, home beam received");
}

/// What the two signs of a command on one channel make of its counts, sample by sample.
std::vector<std::int32_t> response(BoardBench& bench, const BoardActs& acts, int channel, double share, double seconds,
                                   const std::function<void(BoardRun&)>& before) {
  std::vector<std::int32_t> difference;
  BoardRun up(bench, acts), down(bench, acts);
  for (BoardRun* run : {&up, &down}) {
    before(*run);
    run->forget();
    run->command(channel, run == &up ? share : -share, seconds);
  }
  for (std::size_t k = 0; k < up.samples().size(); ++k)
    difference.push_back(up.moved(k, channel) - down.moved(k, channel));
  return difference;
}

void release(BoardRun& run) { run.arm_in_jig(); }

BoardCheck counts_follow(BoardBench& bench) {
  std::string faults, detail;
  for (int i = 0; i < kChannels; ++i) {
    const std::vector<std::int32_t> d = response(bench, {}, i, kCommandShare, kCommandS, release);
    std::int32_t highest = 0;
    bool back = false;
    for (const std::int32_t value : d) {
      back = back || (highest < kEnough && value < highest - 2 * kSlack);
      highest = std::max(highest, value);
    }
    detail = join(detail, std::to_string(highest));
    if (highest < kLeastMotion)
      faults = join(faults, channel_words(i) + " made " + std::to_string(highest) + " counts");
    else if (back)
      faults = join(faults, channel_words(i) + " ran back under a steady command");
  }
  return verdict(faults, "counts between the two signs: " + detail);
}

BoardCheck counter_wrap(BoardBench& bench) {
  constexpr std::int32_t kBeforeWrap = INT32_MAX - 2, kFromZero = 0;
  if (!bench.open({kBeforeWrap, {}, {}, false})) return left_out();
  std::string faults;
  for (int i = 0; i < kChannels; ++i) {
    const auto wrapped = response(bench, {kBeforeWrap, {}, {}, false}, i, kCommandShare, kCommandS, release);
    const auto plain = response(bench, {kFromZero, {}, {}, false}, i, kCommandShare, kCommandS, release);
    for (std::size_t k = 0; k < wrapped.size(); ++k) {
      if (std::abs(wrapped[k] - plain[k]) <= 2 * kSlack) continue;
      faults = join(faults, channel_words(i));
      break;
    }
  }
  return verdict(faults.empty() ? "" : "motion differs across 2^31: " + faults, "motion across 2^31 as from zero");
}

/// First read after the write whose counts show it: the second, as codes act from the next SYNC on; later by as many
/// periods as the pinch takes to make a count.
BoardCheck delay(BoardBench& bench) {
  const std::vector<std::int32_t> d = response(bench, {}, kPinchChannel, 1.0, kCommandS, release);
  const auto seen = std::find_if(d.begin(), d.end(), [](std::int32_t v) { return v > kSlack; });
  if (seen == d.end()) return failed("the pinch did not follow its command");
  const auto reads = seen - d.begin() + 1;
  const std::string words = "first shown in read " + std::to_string(reads) + " after the write";
  const auto latest = 1 + std::lround(std::ceil(kPinchS * bench.open({})->capabilities().rate_hz));
  if (reads >= 2 && reads <= latest) return passed(words + ": one period");
  return failed(words + ", read " + (latest > 2 ? "2 to " : "") + std::to_string(latest) + " is expected");
}

BoardCheck disarm(BoardBench& bench) {
  const auto inhibited = [](BoardRun& run) {
    run.arm_in_jig();
    run.board().arm(false);
  };
  std::string faults;
  for (int i = 0; i < kChannels; ++i) {
    const auto d = response(bench, {}, i, kCommandShare, kCommandS, inhibited);
    if (std::abs(d.back()) > 2 * kSlack) faults = join(faults, channel_words(i));
  }
  return verdict(faults.empty() ? "" : "inhibited amplifiers follow the codes: " + faults,
                 "no channel follows a command");
}

BoardCheck readback(BoardBench& bench) {
  BoardRun run(bench, {});
  run.arm_in_jig();
  run.forget();
  run.vary(0.100);
  std::uint32_t seen = 0;
  for (const DaqSample& sample : run.samples()) seen |= sample.digital_in;
  std::string faults;
  for (int i = 0; i < kChannels; ++i) {
    if (channel_input(seen, kDacMismatch, i)) faults = join(faults, channel_words(i));
  }
  return verdict(faults.empty() ? "" : "a DAC holds another code than was written: " + faults,
                 "every code read back as written");
}

BoardCheck watchdog(BoardBench& bench) {
  constexpr double kPatienceS = 0.200, kSoonestS = 0.003;
  const auto starve = [](BoardRun& run) {
    run.arm_in_jig();
    run.starve(kPatienceS, kWatchdogFired);
  };
  BoardRun run(bench, {});
  run.arm_in_jig();
  run.forget();
  run.starve(kPatienceS, kWatchdogFired);
  const double after_s = static_cast<double>(run.samples().size()) * run.period_s();
  const std::string words = std::to_string(std::lround(1e3 * after_s)) + " ms after the last write";
  if (!(run.samples().back().digital_in & kWatchdogFired)) return failed("did not fire within 200 ms without a write");
  if (after_s < kSoonestS) return failed("fires too soon: " + words);
  const auto d = response(bench, {}, kPinchChannel, kCommandShare, kCommandS, starve);
  if (std::abs(d.back()) > 2 * kSlack)
    return failed("fired " + words + ", but codes written later act without a disarm");
  run.board().arm(false);
  run.forget();
  run.arm_in_jig();
  if (run.samples().back().digital_in & kWatchdogFired) return failed("stays fired after arm(false)");
  return passed("fires " + words + ", zeroes, and is cleared by a disarm");
}

/// An act of the bench that must take the current away though the amplifiers stay armed.
BoardCheck chain(BoardBench& bench, const BoardActs& acts,
                 const std::function<std::string(const BoardRun&)>& input_fault) {
  if (!bench.open(acts)) return left_out();
  BoardRun seen(bench, acts);
  seen.rest(2 * kActS);
  if (const std::string fault = input_fault(seen); !fault.empty()) return failed(fault);
  const auto until_cut = [](BoardRun& run) {
    run.arm_in_jig();
    run.hold_zero(2 * kActS - run.time_s());
  };
  std::string faults;
  for (int i = 0; i < kChannels; ++i) {
    const auto d = response(bench, acts, i, kCommandShare, kCommandS, until_cut);
    if (std::abs(d.back()) > 2 * kSlack) faults = join(faults, channel_words(i));
  }
  return verdict(faults.empty() ? "" : "armed amplifiers still follow the codes: " + faults,
                 "input seen, no channel follows a command");
}

BoardCheck emergency_stop(BoardBench& bench) {
  return chain(bench, {{}, kActS, {}, false}, [](const BoardRun& run) -> std::string {
    const bool before = run.samples().front().digital_in & kEmergencyStop,
               after = run.samples().back().digital_in & kEmergencyStop;
    if (before) return "pressed before it was";
    return after ? "" : "pressed, and not seen";
  });
}

BoardCheck enabling_switch(BoardBench& bench) {
  return chain(bench, {{}, {}, kActS, true}, [](const BoardRun& run) -> std::string {
    const auto closed = [](const DaqSample& s) { return (s.digital_in & kDeadman) != 0; };
    if (!std::any_of(run.samples().begin(), run.samples().end(), closed))
      return "held and pressed, and not seen closed";
    return closed(run.samples().back()) ? "opened, and still seen closed" : "";
  });
}

BoardCheck determinism(BoardBench& bench) {
  if (!bench.repeatable()) return {"", Outcome::kLeftOut, "a real arm never moves twice alike"};
  BoardRun first(bench, {}), second(bench, {});
  for (BoardRun* run : {&first, &second}) {
    run->arm_in_jig();
    run->vary(0.300);
  }
  for (std::size_t k = 0; k < first.samples().size(); ++k) {
    const DaqSample &a = first.samples()[k], &b = second.samples()[k];
    if (a.counts != b.counts || a.valid != b.valid || a.digital_in != b.digital_in ||
        a.elapsed_periods != b.elapsed_periods) {
      return failed("two runs treated alike differ from read " + std::to_string(k) + " on");
    }
  }
  return passed("two runs treated alike agree to the bit");
}

}  // namespace

std::vector<BoardCheck> check_board(BoardBench& bench) {
  constexpr std::pair<const char*, BoardCheck (*)(BoardBench&)> kChecks[] = {{"capabilities", capabilities},
                                                                             {"every-sync", every_sync},
                                                                             {"valid-bits", valid_bits},
                                                                             {"quiet-inputs", quiet_inputs},
                                                                             {"rest-in-jig", rest_in_jig},
                                                                             {"counts-follow", counts_follow},
                                                                             {"counter-wrap", counter_wrap},
                                                                             {"delay", delay},
                                                                             {"disarm", disarm},
                                                                             {"dac-readback", readback},
                                                                             {"watchdog", watchdog},
                                                                             {"emergency-stop", emergency_stop},
                                                                             {"enabling-switch", enabling_switch},
                                                                             {"determinism", determinism}};
  std::vector<BoardCheck> all;
  for (const auto& [name, check] : kChecks) {
    all.push_back(check(bench));
    all.back().name = name;
  }
  return all;
}

const char* outcome_name(Outcome outcome) {
  switch (outcome) {
    case Outcome::kPassed:
      return "pass";
    case Outcome::kFailed:
      return "FAIL";
    case Outcome::kLeftOut:
      return "left out";
  }
  return "unknown";
}

}  // namespace trocar
