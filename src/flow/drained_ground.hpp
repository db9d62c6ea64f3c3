#pragma once
/// Fixed ground whose pores are not full: what water there is gets through by its relative
/// permeability.
#include "flow/options.hpp"
#include "grid/field.hpp"

namespace mudlark {

template <int D>
class DrainedGround {
 public:
  DrainedGround(const Grid<D>& grid, const FlowOptions& options);

  /// Takes from `velocity` and `mobility` [m2 s/kg] of a step dt [s] what S / k_r adds to the drag
  /// per water on faces between cells without pressure; with k_r = S that is nothing. Owned and
  /// bounding faces.
  void slow(const CellField<D>& water, const CellField<D>& porosity, const CellField<D>& unknown,
            const FaceVector<D>& added_mass, double dt, FaceVector<D>& velocity,
            FaceVector<D>& mobility) const;

 private:
  const Grid<D>* grid_;
  double density_;
  std::vector<PoreFilling> grounds_;
  FaceVector<D> number_;  ///< of the ground, counted from 1
  bool slows_ = false;
};

extern template class DrainedGround<2>;
extern template class DrainedGround<3>;

}  // namespace mudlark
