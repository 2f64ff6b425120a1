// The built program as a child process: arguments in, exit code and both streams out.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace trocar::test {

struct Outcome {
  int exit_code = -1;  ///< -1 when a signal ended it
  int signal = 0;
  std::string out, err;
};

struct Launch {
  std::vector<std::string> arguments;              ///< without the program's name
  std::filesystem::path folder;                    ///< the child's working folder
  std::map<std::string, std::string> environment;  ///< set on top of the test's own; "" removes
  std::filesystem::path program = TROCAR_PROGRAM;
  std::filesystem::path input = "/dev/null";  ///< standard input
};

/// A started program. Its streams go to files in `launch.folder`'s hidden ".streams", so that no pipe can fill up.
class RunningProgram {
 public:
  explicit RunningProgram(const Launch& launch);
  ~RunningProgram();
  RunningProgram(const RunningProgram&) = delete;
  RunningProgram& operator=(const RunningProgram&) = delete;

  bool running();
  void interrupt();     ///< SIGINT: Ctrl-C
  void kill_at_once();  ///< SIGKILL: no destructor, no handler
  void ask_to_end();    ///< SIGTERM
  std::string out_so_far() const;
  Outcome wait();

 private:
  pid_t pid_ = -1;
  bool ended_ = false;
  int status_ = 0;
  std::filesystem::path out_, err_;
};

Outcome run_program(const Launch& launch);

}  // namespace trocar::test
