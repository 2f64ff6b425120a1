// The command line's part for the instructor's desk. Sees CLI11 in the source only.
#pragma once

#include <functional>
#include <memory>

namespace CLI {
class App;
}

namespace trocar {

struct ReviewCommandLine;

/// Adds `review`. @param choose is called with the action when it was given. @return what its options are read into:
/// keep it.
std::shared_ptr<ReviewCommandLine> add_review_command(CLI::App& app,
                                                      const std::function<void(std::function<int()>)>& choose);

}  // namespace trocar
