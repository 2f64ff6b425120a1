#include "app/cli/attempts/test_command.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <memory>
#include <optional>
#include <sstream>

#include <CLI/CLI.hpp>

#include "app/cli/attempts/scenario_test.h"
#include "app/cli/command.h"
#include "app/cli/in_parallel.h"
#include "app/session/grading/recorded_result.h"
#include "haptics/device/backends/make_backend.h"
#include "haptics/input_error.h"

namespace trocar {
namespace {

/// One file, and what came of it.
struct Outcome {
  std::filesystem::path file;
  std::optional<ScenarioTest> test;
  std::string unreadable;  ///< why it is no test
  std::vector<std::string> unmet;
  double run_s = 0, took_s = 0;  ///< loop time; wall clock
  bool passed() const { return unreadable.empty() && unmet.empty(); }
};

std::vector<std::filesystem::path> files_of(const std::vector<std::filesystem::path>& paths) {
  std::vector<std::filesystem::path> files;
  for (const std::filesystem::path& path : paths) {
    if (std::filesystem::is_regular_file(path)) {
      files.push_back(path);
      continue;
    }
    if (!std::filesystem::is_directory(path)) throw InputError(path.string() + ": no such file or folder");
    std::vector<std::filesystem::path> found;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(path))
      if (entry.is_regular_file() && entry.path().filename().string().ends_with(".test.toml"))
        found.push_back(entry.path());
    if (found.empty()) throw InputError(path.string() + ": no *.test.toml in it");
    std::sort(found.begin(), found.end());
    files.insert(files.end(), found.begin(), found.end());
  }
  return files;
}

void run(Outcome& outcome, const AssetRoots& assets) {
  const auto began = std::chrono::steady_clock::now();
  try {
    const AttemptSetup setup = attempt_setup(outcome.test->run, assets);
    const Scene scene = build_scene(setup, assets, backend_capabilities(setup.backend, setup.rate_hz));
    const Recording recording = record_session(scene, assets, {}).second;
    outcome.unmet = unmet(*outcome.test, recorded_result(recording, ""));
    if (!recording.ticks.empty()) outcome.run_s = static_cast<double>(recording.ticks.back().tick) / recording.rate_hz;
  } catch (const std::exception& error) {  // of this test; the others are run all the same
    outcome.unreadable = error.what();
  }
  outcome.took_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
}

std::string name_of(const Outcome& outcome) { return outcome.test ? outcome.test->name : outcome.file.string(); }

void print(const Outcome& outcome, std::ostream& out) {
  out << (outcome.passed() ? "pass  " : outcome.unreadable.empty() ? "FAIL  " : "BAD   ") << outcome.file.string();
  if (outcome.test) out << ": " << outcome.test->name;
  if (outcome.unreadable.empty())
    out << std::fixed << std::setprecision(1) << "  (" << outcome.run_s << " s in " << outcome.took_s << " s)";
  out << '\n';
  for (const std::string& line : outcome.unmet) out << "        " << line << '\n';
  if (!outcome.unreadable.empty()) out << "        " << outcome.unreadable << '\n';
}

/// Of text and of attributes. Control characters have no place in XML.
std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += static_cast<unsigned char>(c) < 0x20 && c != '\n' ? ' ' : c;
    }
  }
  return out;
}

/// The form that CI systems read: a suite, a case a test.
void write_junit(const std::vector<Outcome>& outcomes, std::ostream& out) {
  const auto count = [&](auto what) { return std::count_if(outcomes.begin(), outcomes.end(), what); };
  double took_s = 0;
  for (const Outcome& outcome : outcomes) took_s += outcome.took_s;
  out << std::fixed << std::setprecision(3)
      << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuite name=\"trocar test\" tests=\"" << outcomes.size()
      << "\" failures=\"" << count([](const Outcome& o) { return !o.unmet.empty(); }) << "\" errors=\""
      << count([](const Outcome& o) { return !o.unreadable.empty(); }) << "\" time=\"" << took_s << "\">\n";
  for (const Outcome& outcome : outcomes) {
    out << "  <testcase classname=\"" << escaped(outcome.file.parent_path().string()) << "\" name=\""
        << escaped(name_of(outcome)) << "\" file=\"" << escaped(outcome.file.string()) << "\" time=\"" << outcome.took_s
        << '"';
    if (outcome.passed()) {
      out << "/>\n";
      continue;
    }
    const bool bad = !outcome.unreadable.empty();
    out << ">\n    <" << (bad ? "error" : "failure") << " message=\""
        << escaped(bad ? outcome.unreadable : outcome.unmet.front()) << "\">";
    for (const std::string& line : outcome.unmet) out << escaped(line) << '\n';
    out << "</" << (bad ? "error" : "failure") << ">\n  </testcase>\n";
  }
  out << "</testsuite>\n";
}

}  // namespace

int test_command(const TestOptions& options, std::ostream& out, std::ostream& err) {
  const AssetRoots assets = find_assets();
  std::vector<Outcome> outcomes;
  for (const std::filesystem::path& file : files_of(options.paths)) {
    Outcome outcome;
    outcome.file = file;
    try {
      outcome.test = read_scenario_test(file, assets);
    } catch (const InputError& error) {
      outcome.unreadable = error.what();
    }
    if (file.string().find(options.filter) != std::string::npos ||
        name_of(outcome).find(options.filter) != std::string::npos)
      outcomes.push_back(std::move(outcome));
  }
  if (outcomes.empty()) throw InputError("--filter " + options.filter + ": no test has this in its file or name");
  if (options.list) {
    for (const Outcome& outcome : outcomes) out << outcome.file.string() << ": " << name_of(outcome) << '\n';
    return 0;
  }
  std::ofstream junit;  // before minutes of work
  if (!options.junit.empty()) junit.open(options.junit, std::ios::binary);
  if (!options.junit.empty() && !junit) throw EnvironmentError(options.junit.string() + ": cannot be written");
  in_parallel(outcomes.size(), options.jobs, [&](std::size_t i) {
    if (outcomes[i].test) run(outcomes[i], assets);
  });
  for (const Outcome& outcome : outcomes) print(outcome, out);
  if (junit.is_open()) {
    write_junit(outcomes, junit);
    if (!junit.flush()) throw EnvironmentError(options.junit.string() + ": cannot be written");
  }
  const auto passed = std::count_if(outcomes.begin(), outcomes.end(), [](const Outcome& o) { return o.passed(); });
  const bool bad =
      std::any_of(outcomes.begin(), outcomes.end(), [](const Outcome& o) { return !o.unreadable.empty(); });
  err << "trocar: " << passed << " of " << outcomes.size() << " passed, on the simulated plant\n";
  return bad ? 2 : passed == static_cast<std::ptrdiff_t>(outcomes.size()) ? 0 : 1;
}

void add_test(CLI::App& parent, CommandAction& chosen) {
  const auto given = std::make_shared<TestOptions>();
  TestOptions& o = *given;
  CLI::App* test = add_command(parent, "test", "Scripted attempts that say what must come of them: a folder of them",
                               chosen, [given] { return test_command(*given, std::cout, std::cerr); });
  test->add_option("path", o.paths, "Folders with *.test.toml, or such files")->required();
  test->add_option("--filter", o.filter, "Only tests with this in their file or name");
  test->add_option("--junit", o.junit, "Writes the results as JUnit XML too")->check(writable_path());
  test->add_option("--jobs", o.jobs, "Tests at once (0: one a processor)")
      ->capture_default_str()
      ->check(CLI::Range(0, 256));
  test->add_flag("--list", o.list, "Names them, runs nothing");
}

}  // namespace trocar
