// The command line in other forms, made from the one definition of its options: manual page and shell completion.
//
// Sees CLI11 in the source only. What is printed names every subcommand and flag, because it is read off them.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace trocar {

/// trocar(1) in roff, man macros. @param version of the program.
std::string manual_page(const CLI::App& app, const std::string& version);

/// "not understood: --hnad; did you mean '--hand'?": the first word that is no command and no option where it stands.
/// Empty: none.
/// @param words the arguments, without the program's name.
std::string misspelt(const CLI::App& app, const std::vector<std::string>& words);

/// Completion for "bash", "zsh" or "fish". @throws InputError for another shell.
std::string completion_script(const CLI::App& app, const std::string& shell);

}  // namespace trocar
