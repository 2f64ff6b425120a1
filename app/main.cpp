// The program: which commands there are, in the order of the help, and what an error becomes.
#include <csignal>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>
#include <vector>

#include <CLI/CLI.hpp>

#include "app/cli/command.h"
#include "app/cli/command_texts.h"
#include "haptics/input_error.h"

namespace trocar {
namespace {

/// Commands of the program itself, or of one group of it.
struct Commands {
  std::vector<AddCommand*> add;
  const char* group = nullptr;  ///< none: of the program itself
  const char* help = nullptr;
};

const std::vector<Commands>& commands() {
  static const std::vector<Commands> table{
      {{add_practice, add_run, add_test, add_sweep, add_replay, add_score, add_demo, add_bench, add_study, add_version,
        add_picture, add_exercises, add_check}},
      {{add_device_forward, add_device_boards, add_device_calibrate, add_device_card, add_device_faults,
        add_device_selftest, add_device_home, add_device_pinch, add_device_sensor, add_device_monitor, add_device_stop,
        add_device_plant, add_device_eval, add_device_ik, add_device_identify},
       "device",
       "Models of the device, its back-end on the bench"},
      {{add_organ_import, add_organ_inspect, add_organ_info, add_organ_render, add_organ_export, add_organ_package,
        add_organ_phantom},
       "organ",
       "Organs from images and surfaces"},
      {{add_trainee_people, add_trainee_many, add_trainee_rights}, "trainee", "Trainees of a database"},
      {{add_programme}, "programme", "What people have to do by when"},
      {{add_cohort}},
      {{add_db_upkeep, add_db_retention}, "db", "The database itself"},
      {{add_sync}},
      {{add_review_serve, add_review_account, add_review_demo, add_review_report}, "review", "The instructor's desk"},
      {{add_export, add_doctor, add_completion, add_manual}},
  };
  return table;
}

/// What was printed has to have arrived: a full disk behind a redirection is no success.
int printed(int code) {
  if (std::cout.flush()) return code;
  std::cerr << "trocar: standard output could not be written\n";
  return code == 0 ? 3 : code;
}

int fail(const std::exception& error, int code) {
  std::cerr << "trocar: " << error.what() << '\n';
  return code;
}

/// @return exit code: 0 done, 1 below the pass mark, 2 bad usage or input, 3 environment, 4 device fault.
int run_program(int argc, char** argv) {
  CommandAction chosen;
  CLI::App program{"Trocar: laparoscopic surgery training simulator round a 6-DOF haptic device"};
  program.require_subcommand(1);
  program.set_version_flag("--version", "trocar " TROCAR_VERSION, "Version of the program");
  for (const Commands& some : commands()) {
    CLI::App& parent = some.group ? *add_group(program, some.group, some.help) : program;
    for (AddCommand* add : some.add) add(parent, chosen);
  }
  try {
    program.parse(argc, argv);
    return printed(chosen());
  } catch (const CLI::ParseError& error) {
    // CLI11 asks for what is missing before it looks at the word that is none.
    const bool help = error.get_exit_code() == 0;
    const std::string said = help ? "" : misspelt(program, {argv + 1, argv + argc});
    if (!said.empty()) std::cerr << "trocar: " << said << '\n';
    return program.exit(error) == 0 ? 0 : 2;
  } catch (const InputError& error) {
    return fail(error, 2);
  } catch (const EnvironmentError& error) {
    return fail(error, 3);
  } catch (const std::filesystem::filesystem_error& error) {
    return fail(error, 3);
  } catch (const std::bad_alloc& error) {
    return fail(error, 3);
  } catch (const std::exception& error) {
    return fail(error, 2);
  }
}

}  // namespace
}  // namespace trocar

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is a full disk: told, and its pieces taken away
  return trocar::run_program(argc, argv);
}
