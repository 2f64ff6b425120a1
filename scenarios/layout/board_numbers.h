// Which boards are for practice, and which are drawn by the seed so that nobody has practised on them.
//
// A board's number and the exercise's level say what is laid out; the
// seed does so only through the number. Exams have a range of their own: no run at another level shows an exam's board.
#pragma once

#include <cstdint>

namespace trocar {

inline constexpr int kPracticeBoards = 20;             ///< 0 to 19, chosen by their number
inline constexpr int kUnseenBoards = 1000;             ///< first board of runs that name none
inline constexpr int kExamBoards = 2000000;            ///< first board of exams
inline constexpr std::int64_t kDrawnBoards = 1000000;  ///< of either kind: seeds that far apart draw the same board

inline constexpr int kProvedUnseen = 20;  ///< of those, how many `trocar check` proves unless told otherwise

/// Board that a seed draws; remainders of negative seeds are made positive.
inline int drawn_board(std::int64_t seed, bool exam) {
  return (exam ? kExamBoards : kUnseenBoards) + static_cast<int>((seed % kDrawnBoards + kDrawnBoards) % kDrawnBoards);
}

}  // namespace trocar
