// The command line's part for trainees and the database. Sees CLI11 in the source only.
#pragma once

#include <functional>
#include <memory>

namespace CLI {
class App;
}

namespace trocar {

struct TraineeCommandLine;

/// Adds `trainee`, `cohort` and `db`. @param choose is called with the action when one was given.
/// @return what the options are read into: keep it.
std::shared_ptr<TraineeCommandLine> add_trainee_commands(CLI::App& app,
                                                         const std::function<void(std::function<int()>)>& choose);

}  // namespace trocar
