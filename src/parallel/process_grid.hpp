#pragma once
/// How many ranks share each axis of a grid.
#include "base/vec.hpp"

namespace mudlark {

/// Ranks per axis: blocks of at least `minimum_width` cells along each axis that is split, with the
/// smallest cuts. Throws InputError when so many ranks do not fit.
template <int D>
Index<D> choose_processes(int size, const Index<D>& cells, int minimum_width);

}  // namespace mudlark
