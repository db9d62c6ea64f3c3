#pragma once
/// Water that gives way to pressure, where it shares one with grains.
#include "grid/field.hpp"

namespace mudlark {

/// Volume of water is counted at the pressure that it had at the start: where pressure rises by dp
/// a cell takes in W dp/K more of it than it has room for (NUMERICS C2, the storage of the
/// projection). That surplus is `stored`, by which the transported porosity may exceed what the
/// grains leave.
template <int D>
class WaterStorage {
 public:
  /// `compressibility`: 1/K [1/Pa].
  WaterStorage(const Grid<D>& grid, double compressibility);

  /// What gives way in a step of dt [s], water W added to `give_way` [1/(Pa s)]; keeps the
  /// pressure.
  const CellField<D>& with_water(const CellField<D>& give_way, const CellField<D>& water,
                                 const CellField<D>& pressure, double dt);
  /// Counts what the rise of pressure since then has taken in; nothing is stored where none acts.
  void count(const CellField<D>& water, const CellField<D>& unknown, const CellField<D>& pressure);
  const CellField<D>& stored() const { return stored_; }  ///< per cell volume [-]; own cells

  template <class Archive>
  void archive(Archive& a) {
    a.cells("stored water", stored_);
  }

 private:
  const Grid<D>* grid_;
  double compressibility_;
  CellField<D> stored_, gives_way_, before_;
};

extern template class WaterStorage<2>;
extern template class WaterStorage<3>;

}  // namespace mudlark
