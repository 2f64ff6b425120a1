// The subcommands of `trocar organ` on the command line: options and help. Its source sees CLI11.
#pragma once

#include <functional>
#include <memory>

namespace CLI {
class App;
}

namespace trocar {

/// Options of the organ commands; made by add_organ_commands, kept by the caller until the command has run.
struct OrganCommandLine;

/// Adds `organ import|inspect|info|render|package|phantom` to the program.
/// @param choose told what to run when one of them is chosen
std::shared_ptr<OrganCommandLine> add_organ_commands(CLI::App& app, std::function<void(std::function<int()>)> choose);

}  // namespace trocar
