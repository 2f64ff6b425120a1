// The command line in other forms, made from the one definition of its options: manual page and shell completion, and
// what was misspelt. What is printed names every subcommand and flag, because it is read off them.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace trocar {

/// "not understood: --hnad; did you mean '--hand'?": the first word that is no command and no option where it stands.
/// Empty: none.
/// @param words the arguments, without the program's name.
std::string misspelt(const CLI::App& app, const std::vector<std::string>& words);

}  // namespace trocar
