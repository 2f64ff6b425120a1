// The same work on many things, on as many threads as are wanted.
#pragma once

#include <cstddef>
#include <functional>

namespace trocar {

/// Calls work(0) to work(count - 1), each once, in any order. @param jobs at once; 0: one a processor. @throws the
/// first failure, after all threads have ended; what had not begun by then is left.
void in_parallel(std::size_t count, int jobs, const std::function<void(std::size_t)>& work);

}  // namespace trocar
