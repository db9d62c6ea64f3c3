#pragma once
/// Viscous force where viscosity varies from place to place: two fluids, turbulence.
#include <array>
#include <vector>

#include "grid/field.hpp"

namespace mudlark {

enum class Mean { arithmetic, harmonic };

template <int D>
class ViscousForce {
 public:
  explicit ViscousForce(const Grid<D>& grid);

  /// (1/theta_f) div(theta mu (grad v + grad v^T)) of one component [N/m3] on bounding faces: per
  /// volume of fluid (NUMERICS B1). On edges mu is the harmonic mean of the four cells around:
  /// layers that are sheared upon each other carry the same stress. `eddy` [Pa s], if any, is
  /// added; on edges its mean is harmonic, too, where two fluids meet, else arithmetic. Ghosts of
  /// all inputs are valid.
  void find(int component, const CellField<D>& viscosity, const CellField<D>* eddy, Mean mean,
            const CellField<D>& porosity, const FaceVector<D>& velocity, FaceField<D>& force) const;

 private:
  const Grid<D>* grid_;
  /// 1/d [1/m] by local index along each axis, d the width of a cell and the distance between the
  /// centres of the cells beside a face.
  std::array<std::vector<double>, D> inverse_width_, inverse_gap_;
};

extern template class ViscousForce<2>;
extern template class ViscousForce<3>;

}  // namespace mudlark
