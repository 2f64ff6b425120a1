// Stands between a station and the server and cuts the line after so many bytes: a connection that drops at any step.
#pragma once

#include <atomic>
#include <filesystem>
#include <limits>
#include <mutex>
#include <thread>
#include <vector>

#include "tests/trainees/exchange/sync/postgres_server.h"

namespace trocar::test {

class CuttingProxy {
 public:
  explicit CuttingProxy(const PostgresServer& server);
  ~CuttingProxy();
  CuttingProxy(const CuttingProxy&) = delete;
  CuttingProxy& operator=(const CuttingProxy&) = delete;

  /// The same database, by way of the proxy.
  CentralAddress through(const CentralAddress& address) const;
  /// Lets so many more bytes pass, of both directions together, then cuts every line; new ones are cut at once.
  void cut_after(long bytes) { left_ = bytes; }
  void mend() { left_ = kEndless; }
  /// Bytes that have passed so far.
  long passed() const { return passed_; }

 private:
  static constexpr long kEndless = std::numeric_limits<long>::max();
  void listen();
  void relay(int client);
  bool pass(int from, int to);

  std::filesystem::path server_, folder_;
  int listener_ = -1;
  std::atomic<long> left_{kEndless}, passed_{0};
  std::atomic<bool> ends_{false};
  std::thread thread_;
  std::vector<std::thread> relays_;
};

}  // namespace trocar::test
