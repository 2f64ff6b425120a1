// A learning record store of the test's own, on this machine: keeps what it is given as the standard asks, and fails in
// the ways that it is told to.
#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace trocar::test {

class RecordStoreSample {
 public:
  RecordStoreSample();
  ~RecordStoreSample();
  RecordStoreSample(const RecordStoreSample&) = delete;
  RecordStoreSample& operator=(const RecordStoreSample&) = delete;

  std::string url() const { return "http://127.0.0.1:" + std::to_string(port_) + "/xapi"; }

  /// What a request for statements gets instead of an answer of a store, given how many there were before it: a whole
  /// answer of HTTP; "" nothing, the line is cut; "." that of a store; "!" it is kept, and then the line is cut.
  std::function<std::string(int request)> instead = [](int) { return "."; };
  std::string versions = R"(["1.0.3"])";
  /// Statements with this in them are refused.
  std::string refuses = "\n";

  std::map<std::string, std::string> kept() const;  ///< by identifier
  int doubled() const { return doubled_; }          ///< statements that came again
  std::vector<std::string> heads() const;           ///< of each request, in order

 private:
  void serve();
  void talk(int line);
  std::string answer(const std::string& head, const std::string& body);
  std::string take(const std::string& body, bool many);

  int listener_ = -1, port_ = 0;
  std::atomic<bool> ends_{false};
  std::atomic<int> doubled_{0}, requests_{0};
  mutable std::mutex mutex_;
  std::map<std::string, std::string> kept_;
  std::vector<std::string> heads_;
  std::thread thread_;
};

}  // namespace trocar::test
