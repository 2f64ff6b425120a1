// A display of its own for a test (Xvfb), and hands at it (xdotool). Skips are loud: a machine without both tests no
// window.
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "tests/system/program.h"

namespace trocar::testing_support {

/// Asks until it is so; gives up after a minute and a half, which is a failure of the caller's expectation.
inline bool comes_true(const std::function<bool()>& so) {
  for (int i = 0; i < 900; ++i) {
    if (so()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  return false;
}

class XDisplay {
 public:
  /// Program that is missing, empty when none is.
  static std::string missing() {
    for (const char* needed : {"Xvfb", "xdotool"})
      if (!std::filesystem::exists(std::filesystem::path("/usr/bin") / needed)) return needed;
    return "";
  }

  /// @param folder of the test. name() is empty when no display came.
  explicit XDisplay(const std::filesystem::path& folder) : folder_(folder), server_folder_(folder / "server") {
    std::filesystem::create_directories(server_folder_);
    // By default the server starts over whenever its last client leaves, and refuses whoever connects in that moment:
    // 61 of 1500 connections beside a second client that came and went, none with -noreset.
    test::Launch launch{
        {"-displayfd", "1", "-screen", "0", "1280x720x24", "-nolisten", "tcp", "-noreset"}, server_folder_, {}};
    launch.program = "/usr/bin/Xvfb";
    server_ = std::make_unique<test::RunningProgram>(launch);
    comes_true([this] { return !number().empty() || !server_->running(); });
    if (!number().empty()) name_ = ":" + number();
  }
  ~XDisplay() {
    if (!server_->running()) return;
    server_->ask_to_end();  // killed, it would leave its lock and socket behind
    server_->wait();
  }

  const std::string& name() const { return name_; }

  test::Outcome xdotool(const std::vector<std::string>& arguments) const {
    test::Launch launch{arguments, folder_, {{"DISPLAY", name_}}};
    launch.program = "/usr/bin/xdotool";
    return test::run_program(launch);
  }
  /// First visible window of that name, empty when there is none.
  std::string window(const std::string& title) const {
    const test::Outcome found = xdotool({"search", "--onlyvisible", "--name", "^" + title + "$"});
    return found.exit_code == 0 ? found.out.substr(0, found.out.find('\n')) : "";
  }

 private:
  std::string number() const {
    for (const auto& entry : std::filesystem::directory_iterator(server_folder_ / ".streams")) {
      if (entry.path().extension() != ".out") continue;
      std::ifstream in(entry.path());
      std::string text{std::istreambuf_iterator<char>(in), {}};
      if (!text.ends_with('\n')) return "";
      text.pop_back();
      return text;
    }
    return "";
  }

  std::filesystem::path folder_, server_folder_;
  std::unique_ptr<test::RunningProgram> server_;
  std::string name_;
};

}  // namespace trocar::testing_support
