#include "soil/point_report.hpp"

#include <fmt/format.h>

namespace mudlark {

template <int D>
std::string place_of(const SoilParticles<D>& points, std::size_t p) {
  const Point3 x = to_point3(points.position_of(p));
  return fmt::format("({:.6g}, {:.6g}, {:.6g}) m", x[0], x[1], x[2]);
}

template <int D>
std::string state_of(const SoilParticles<D>& points, std::size_t p) {
  const SymTensor s = get_tensor(points.stress, p);
  std::string text =
      fmt::format("point {}: effective stress xx {:.4g}, yy {:.4g}, zz {:.4g}, zx {:.4g} Pa",
                  points.id[p], s.xx, s.yy, s.zz, s.zx);
  for (std::size_t h = 0; h < points.history.size(); ++h)
    text += fmt::format(", {} {:.4g}", points.history_names[h], points.history[h][p]);
  return text;
}

template std::string place_of(const SoilParticles<2>&, std::size_t);
template std::string place_of(const SoilParticles<3>&, std::size_t);
template std::string state_of(const SoilParticles<2>&, std::size_t);
template std::string state_of(const SoilParticles<3>&, std::size_t);

}  // namespace mudlark
