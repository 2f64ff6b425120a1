// A command on the command line. Beside each command's code stands the function that adds it: its name, its options,
// its help. app/main.cpp lists them in the order of the help.
//
// Only sources see CLI11.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace CLI {
class App;
class Validator;
}  // namespace CLI

namespace trocar {

/// What a command does, its options read. @return exit code: docs/commands.md
using CommandAction = std::function<int()>;

/// Adds a subcommand of `parent`; when it is the one given, `action` becomes `chosen`. `chosen` outlives the program.
CLI::App* add_command(CLI::App& parent, const char* name, const char* help, CommandAction& chosen,
                      CommandAction action);

/// Adds a subcommand that asks for one of its own.
CLI::App* add_group(CLI::App& parent, const char* name, const char* help);

/// A path to be written: not empty, its folder is there.
CLI::Validator writable_path();
/// A file to be read: not empty.
CLI::Validator file_name();
CLI::Validator seed_range();

/// How an organ is named, for the help of --organ.
constexpr const char* kCardForms =
    "Of --backend hostmot2: address of the card (default: 192.168.1.121); of mc4000: the boards' folders in "
    "/sys/bus/pci/devices or their /dev/uio, with a comma";
constexpr const char* kSensorForms =
    "A real force sensor at the stylus: net-ft:ADDRESS, serial:/dev/ttyUSB0 or "
    "serial-binary:/dev/ttyUSB0";
constexpr const char* kOrganForms =
    "NAME.organ.toml, NAME.scene.toml (#ORGAN behind it: another subject) or a shipped organ";

/// --calibration and --device, as read_device_files() takes them.
void add_device_file_options(CLI::App& command, std::filesystem::path& calibration, std::filesystem::path& device);

/// --tissue: one of kTissueWords, empty unless given.
void add_tissue_option(CLI::App& command, std::string& tissue);

/// Adds one or more subcommands of `parent`.
using AddCommand = void(CLI::App& parent, CommandAction& chosen);

AddCommand add_practice;
AddCommand add_run;
AddCommand add_sweep;
AddCommand add_test;
AddCommand add_replay;
AddCommand add_score;
AddCommand add_demo;
AddCommand add_bench;
AddCommand add_study;
AddCommand add_picture;
AddCommand add_exercises;
AddCommand add_check;
AddCommand add_doctor;
AddCommand add_export;

AddCommand add_device_forward;
AddCommand add_device_home;
AddCommand add_device_pinch;
AddCommand add_device_boards;
AddCommand add_device_calibrate;
AddCommand add_device_faults;
AddCommand add_device_card;
AddCommand add_device_selftest;
AddCommand add_device_sensor;
AddCommand add_device_monitor;
AddCommand add_device_stop;
AddCommand add_device_plant;
AddCommand add_device_eval;
AddCommand add_device_ik;
AddCommand add_device_identify;

AddCommand add_organ_import;
AddCommand add_organ_inspect;
AddCommand add_organ_info;
AddCommand add_organ_render;
AddCommand add_organ_export;
AddCommand add_organ_package;
AddCommand add_organ_phantom;

AddCommand add_trainee_people;  ///< add, list, show, edit
AddCommand add_trainee_many;    ///< import, group, deactivate, reactivate
AddCommand add_trainee_rights;  ///< note, export, consent, erase
AddCommand add_programme;
AddCommand add_cohort;
AddCommand add_db_upkeep;  ///< check, backup, migrate, anchor, rubric
AddCommand add_db_retention;
AddCommand add_sync;

AddCommand add_review_serve;
AddCommand add_review_account;
AddCommand add_review_demo;
AddCommand add_review_report;

AddCommand add_version;
AddCommand add_completion;
AddCommand add_manual;

}  // namespace trocar
