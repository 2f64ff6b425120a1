#include "app/cli/command_texts.h"

#include <algorithm>
#include <functional>
#include <iostream>
#include <iterator>
#include <memory>
#include <sstream>

#include <CLI/CLI.hpp>

#include "app/cli/command.h"
#include "haptics/input_error.h"
#include "scenarios/files/strict_toml.h"

namespace trocar {
namespace {

using Visit = std::function<void(const CLI::App& command, const std::string& path)>;

/// Visits the program ("") and every subcommand ("db check") in the order in which they were added.
void each_command(const CLI::App& app, const std::string& path, const Visit& visit) {
  visit(app, path);
  for (const CLI::App* sub : app.get_subcommands([](const CLI::App*) { return true; })) {
    each_command(*sub, path.empty() ? sub->get_name() : path + " " + sub->get_name(), visit);
  }
}

std::vector<const CLI::Option*> options_of(const CLI::App& command, bool positional) {
  return command.get_options(
      [&](const CLI::Option* option) { return positional ? option->get_positional() : option->nonpositional(); });
}

/// Words that may follow a command: its subcommands and flags.
std::string words_after(const CLI::App& command) {
  std::string words;
  for (const CLI::App* sub : command.get_subcommands([](const CLI::App*) { return true; }))
    words += sub->get_name() + " ";
  for (const CLI::Option* option : options_of(command, false)) {
    for (const std::string& name : option->get_lnames()) words += "--" + name + " ";
    for (const std::string& name : option->get_snames()) words += "-" + name + " ";
  }
  if (!words.empty()) words.pop_back();
  return words;
}

/// Text for roff: a hyphen that stays one, no backslash or leading dot that would be a request.
std::string roff(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else if (c == '\'')
      out += "\\(aq";
    else
      out += c;
  }
  return out.starts_with('.') ? "\\&" + out : out;
}

std::string flags_of(const CLI::Option& option) {
  std::string names;
  for (const std::string& name : option.get_snames()) names += (names.empty() ? "-" : ", -") + name;
  for (const std::string& name : option.get_lnames()) names += (names.empty() ? "--" : ", --") + name;
  return names;
}

void write_options(const CLI::App& command, std::ostream& out) {
  for (const CLI::Option* option : options_of(command, true)) {
    out << ".TP\n\\fI" << roff(option->get_single_name()) << "\\fR\n" << roff(option->get_description()) << '\n';
  }
  for (const CLI::Option* option : options_of(command, false)) {
    out << ".TP\n\\fB" << roff(flags_of(*option)) << "\\fR";
    if (option->get_items_expected_max() > 0) out << " \\fIvalue\\fR";
    out << '\n' << roff(option->get_description());
    if (!option->get_default_str().empty()) out << " (default: " << roff(option->get_default_str()) << ')';
    out << '\n';
  }
}

constexpr const char* kAfterOptions = R"roff(.SH EXIT STATUS
.TP
0
done, and passed where something is graded
.TP
1
graded and below the pass mark; also timed out, aborted or void
.TP
2
bad usage or bad input; a check that found something
.TP
3
the machine lacks something: no EGL, no database, no permission, no room
.TP
4
device fault
.SH ENVIRONMENT
.TP
TROCAR_ASSETS
the only folder to look in for exercises, hands and assets
.TP
XDG_DATA_HOME
where the default database lies (trocar/trocar.db)
.SH FILES
.TP
.I *.trec
a recording, readable to its last whole chunk
.TP
.I *.db, *.db.anchor, *.recordings/
the database, the heads of its audit trail, the recordings of its attempts
)roff";

std::string bash_script(const CLI::App& app) {
  std::ostringstream out;
  out << "# bash completion for trocar, made by: trocar completion bash\n"
         "_trocar() {\n"
         "  local current=${COMP_WORDS[COMP_CWORD]} path='' word words\n"
         "  for word in \"${COMP_WORDS[@]:1:COMP_CWORD-1}\"; do\n"
         "    case \"$path $word\" in\n";
  each_command(app, "", [&](const CLI::App&, const std::string& path) {
    if (!path.empty())
      out << "      '" << (path.find(' ') == std::string::npos ? " " : "") << path << "') path='" << path << "' ;;\n";
  });
  out << "    esac\n  done\n  case \"$path\" in\n";
  each_command(app, "", [&](const CLI::App& command, const std::string& path) {
    out << "    '" << path << "') words='" << words_after(command) << "' ;;\n";
  });
  out << "  esac\n"
         "  COMPREPLY=($(compgen -W \"$words\" -- \"$current\"))\n"
         "}\n"
         "complete -o default -F _trocar trocar\n";
  return out.str();
}

std::string zsh_script(const CLI::App& app) {
  // The same table through zsh's own reading of bash completions.
  return "#compdef trocar\nautoload -U +X bashcompinit && bashcompinit\n" + bash_script(app);
}

std::string fish_quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' || c == '\\' ? std::string("\\") + c : std::string(1, c);
  return out + "'";
}

std::string fish_script(const CLI::App& app) {
  std::ostringstream out;
  out << "# fish completion for trocar, made by: trocar completion fish\n";
  each_command(app, "", [&](const CLI::App& command, const std::string& path) {
    std::string when = "__fish_use_subcommand";
    if (!path.empty()) {
      std::istringstream names(path);
      when.clear();
      for (std::string name; names >> name;)
        when += (when.empty() ? "" : "; and ") + ("__fish_seen_subcommand_from " + name);
    }
    const std::string head = "complete -c trocar -n '" + when + "'";
    for (const CLI::App* sub : command.get_subcommands([](const CLI::App*) { return true; })) {
      out << head << " -f -a " << sub->get_name() << " -d " << fish_quoted(sub->get_description()) << '\n';
    }
    for (const CLI::Option* option : options_of(command, false)) {
      out << head;
      for (const std::string& name : option->get_lnames()) out << " -l " << name;
      for (const std::string& name : option->get_snames()) out << " -s " << name;
      if (option->get_items_expected_max() > 0) out << " -r";
      out << " -d " << fish_quoted(option->get_description()) << '\n';
    }
  });
  return out.str();
}

std::string not_understood(const std::string& word, const std::vector<std::string>& known) {
  const std::string near = nearest_word(word, known);
  return "not understood: " + word + (near.empty() ? "" : "; did you mean '" + near + "'?");
}

std::vector<std::string> split(const std::string& words) {
  std::istringstream in(words);
  return {std::istream_iterator<std::string>(in), {}};
}

/// trocar(1) in roff, man macros.
std::string manual_page(const CLI::App& app) {
  std::ostringstream out;
  out << ".TH TROCAR 1 \"\" \"trocar " TROCAR_VERSION "\" \"User Commands\"\n.SH NAME\ntrocar \\- "
      << roff(app.get_description()) << "\n.SH SYNOPSIS\n.B trocar\n.I command\n.RI [ options ]\n.SH DESCRIPTION\n"
      << "Results go to standard output, messages to standard error. This page lists every command and option; what "
         "they\n"
         "mean is told in the document commands.md that is installed with the program.\n.SH COMMANDS\n";
  each_command(app, "", [&](const CLI::App& command, const std::string& path) {
    if (path.empty()) return;
    out << ".SS trocar " << roff(path) << '\n' << roff(command.get_description()) << ".\n";
    write_options(command, out);
  });
  return out.str() + kAfterOptions;
}

/// Completion for "bash", "zsh" or "fish". @throws InputError for another shell.
std::string completion_script(const CLI::App& app, const std::string& shell) {
  if (shell == "bash") return bash_script(app);
  if (shell == "zsh") return zsh_script(app);
  if (shell == "fish") return fish_script(app);
  throw InputError("completion " + shell + ": bash, zsh and fish are known");
}

}  // namespace

std::string misspelt(const CLI::App& app, const std::vector<std::string>& words) {
  const CLI::App* command = &app;
  for (std::size_t i = 0; i < words.size() && words[i] != "--"; ++i) {
    const std::string word = words[i].substr(0, words[i].find('='));
    if (word.size() > 1 && word[0] == '-') {
      const CLI::Option* option = command->get_option_no_throw(word);
      if (!option) return not_understood(word, split(words_after(*command)));
      if (option->get_items_expected_max() > 0 && word == words[i]) ++i;  // its value, whatever that looks like
      continue;
    }
    const auto below = command->get_subcommands([](const CLI::App*) { return true; });
    if (below.empty()) continue;
    const auto found =
        std::find_if(below.begin(), below.end(), [&](const CLI::App* sub) { return sub->get_name() == words[i]; });
    if (found == below.end()) return not_understood(words[i], split(words_after(*command)));
    command = *found;
  }
  return "";
}

void add_version(CLI::App& program, CommandAction& chosen) {
  add_command(program, "version", "Version of the program", chosen, [] {
    std::cout << "trocar " TROCAR_VERSION "\n";
    return 0;
  });
}

void add_completion(CLI::App& program, CommandAction& chosen) {
  const auto shell = std::make_shared<std::string>();
  CLI::App* completion =
      add_command(program, "completion", "Shell completion, as it is installed", chosen, [&program, shell] {
        std::cout << completion_script(program, *shell);
        return 0;
      });
  completion->add_option("shell", *shell, "bash, zsh or fish")->required();
}

void add_manual(CLI::App& program, CommandAction& chosen) {
  add_command(program, "manual", "Manual page in roff, as it is installed", chosen, [&program] {
    std::cout << manual_page(program);
    return 0;
  });
}

}  // namespace trocar
