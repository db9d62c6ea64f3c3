#include "grid/space.hpp"

namespace mudlark {

template <int D>
Space<D>::Space(const Grid<D>& grid)
    : volume(grid, "open volume", "1", 1.0), aperture(grid, "aperture", "1", 1.0) {
  if (!grid.stretched()) return;
  for_each(grid.local(), [&](const Index<D>& index) {
    for (int a = 0; a < D; ++a) {
      const double size = grid.width(a, index[a]) / grid.spacing()[a];
      volume[index] *= size;
      for (int across = 0; across < D; ++across)
        if (across != a) aperture[across][index] *= size;
    }
  });
}

template struct Space<2>;
template struct Space<3>;

}  // namespace mudlark
