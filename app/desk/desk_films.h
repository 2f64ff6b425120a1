// Films of stored attempts for the desk: made one at a time in the background, kept beside the database for its owner
// alone.
//
// NAME.films/<uuid>.mp4, folder 0700, files 0600. A film goes when its attempt's recording has gone (an erasure), and
// the oldest go when all together are larger than kMostBytes. The end of the desk ends the film that is being made, and
// nothing of it stays. Thread: any may ask.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "app/session/setup/scene.h"
#include "trainees/desk/queries/film_state.h"
#include "trainees/store/database.h"

namespace trocar {

class DeskFilms {
 public:
  static constexpr std::uintmax_t kMostBytes = std::uintmax_t{2} << 30U;
  static constexpr int kWidth = 960, kHeight = 540, kFps = 20;

  /// @param database its file. @param open it, for the thread that asks and the one that makes. @throws
  /// EnvironmentError: the folder cannot be made, or is another user's.
  DeskFilms(AssetRoots assets, const std::filesystem::path& database, std::function<Database()> open);
  /// Ends what is being made.
  ~DeskFilms();
  DeskFilms(const DeskFilms&) = delete;
  DeskFilms& operator=(const DeskFilms&) = delete;

  /// Why no film can be made on this machine, a sentence; "" when it can: ffmpeg and graphics are there.
  static std::string refusal();

  review::FilmState state(const std::string& attempt_uuid);
  /// Begins one; one that is there or being made is left. @throws InputError: no such attempt, no recording, another
  /// one is being made.
  void make(const std::string& attempt_uuid);
  /// @throws InputError: there is none.
  std::string part(const std::string& attempt_uuid, std::uint64_t from, std::uint64_t count);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace trocar
