#include "tests/system/program.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <stdexcept>

namespace trocar::test {
namespace {

namespace fs = std::filesystem;

std::map<std::string, std::string> environment_of(const Launch& launch) {
  std::map<std::string, std::string> merged;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string text = *entry;
    const std::size_t equals = text.find('=');
    if (equals != std::string::npos) merged[text.substr(0, equals)] = text.substr(equals + 1);
  }
  for (const auto& [name, value] : launch.environment) {
    if (value.empty())
      merged.erase(name);
    else
      merged[name] = value;
  }
  return merged;
}

std::vector<char*> pointers(std::vector<std::string>& words) {
  std::vector<char*> out;
  for (std::string& word : words) out.push_back(word.data());
  out.push_back(nullptr);
  return out;
}

std::string contents(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

int next_number() {
  static int number = 0;
  return ++number;
}

}  // namespace

RunningProgram::RunningProgram(const Launch& launch) {
  const fs::path streams = launch.folder / ".streams";
  fs::create_directories(streams);
  const std::string number = std::to_string(next_number());
  out_ = streams / (number + ".out");
  err_ = streams / (number + ".err");

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, launch.input.c_str(), O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, out_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, err_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  posix_spawn_file_actions_addchdir_np(&actions, launch.folder.c_str());

  std::vector<std::string> arguments{launch.program.string()}, variables;
  arguments.insert(arguments.end(), launch.arguments.begin(), launch.arguments.end());
  for (const auto& [name, value] : environment_of(launch)) variables.push_back(name + "=" + value);
  const int error = posix_spawn(&pid_, launch.program.c_str(), &actions, nullptr, pointers(arguments).data(),
                                pointers(variables).data());
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) throw std::runtime_error("cannot start " + launch.program.string());
}

RunningProgram::~RunningProgram() {
  if (ended_) return;
  kill_at_once();
  waitpid(pid_, &status_, 0);
}

bool RunningProgram::running() {
  if (!ended_) ended_ = waitpid(pid_, &status_, WNOHANG) == pid_;
  return !ended_;
}

void RunningProgram::kill_at_once() { ::kill(pid_, SIGKILL); }

void RunningProgram::ask_to_end() { ::kill(pid_, SIGTERM); }

std::string RunningProgram::out_so_far() const { return contents(out_); }

Outcome RunningProgram::wait() {
  if (!ended_) waitpid(pid_, &status_, 0);
  ended_ = true;
  Outcome outcome;
  if (WIFEXITED(status_)) outcome.exit_code = WEXITSTATUS(status_);
  if (WIFSIGNALED(status_)) outcome.signal = WTERMSIG(status_);
  outcome.out = contents(out_);
  outcome.err = contents(err_);
  return outcome;
}

Outcome run_program(const Launch& launch) { return RunningProgram(launch).wait(); }

}  // namespace trocar::test
