// `trocar check`: proves that the device can do what an exercise asks for, draws where, and shows what a port does.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "app/session/setup/workspace_proof.h"
#include "scenarios/layout/board_numbers.h"

namespace trocar {

struct CheckOptions {
  std::vector<std::string> subjects;  ///< exercise ids or files
  std::string organ = "phantom-liver";
  int unseen = kProvedUnseen;       ///< boards that seeds from 0 on draw, besides the practice boards 0 to 19
  std::filesystem::path map;        ///< SVG of the renderable force; empty: none
  std::filesystem::path inversion;  ///< folder of the picture pair; empty: none
  std::vector<std::string> levels;  ///< empty: every level of the exercise
  bool play = false;                ///< the expert plays boards too (board_play.h)
  bool json = false;
};

/// @return 0 when every level of every subject is sound and, if it was played, was passed on every board, else 2.
int check_command(const CheckOptions& options, std::ostream& out, std::ostream& err);

/// One panel a level: renderable force over the board region, targets of the practice boards.
std::string room_map_svg(const std::vector<LevelProof>& proofs, const std::vector<Scene>& scenes);

/// The same motion of the handle, 30 mm to the right, with and without a port: inversion-direct.png and
/// inversion-fulcrum.png in `folder`. The ghost shows where the instrument was. @throws EnvironmentError.
void paint_inversion(const Exercise& exercise, const Organ& organ, const AssetRoots& assets,
                     const std::filesystem::path& folder);

}  // namespace trocar
