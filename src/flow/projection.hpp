#pragma once
/// Pressure projection with a ghost-fluid free surface in a porous medium.
#include "flow/options.hpp"
#include "flow/porous_medium.hpp"
#include "numerics/interface_advection.hpp"
#include "numerics/near_water.hpp"
#include "numerics/pressure_solver.hpp"

namespace mudlark {

template <int D>
class Projection {
 public:
  Projection(const Grid<D>& grid, const NearWater<D>& near, const FlowOptions& options);

  /// Finds the cells with a pressure unknown (alpha >= 1/2) and, for each of their faces, the
  /// distance over which the pressure falls, in mean cells: that of the centres between two
  /// unknowns, xi to the surface (where p = 0), half a cell to an open wall, or to a closed one
  /// where it `passes` water (1; null: nowhere). `alpha` needs valid ghosts.
  void find_surface(const CellField<D>& water, const CellField<D>& porosity,
                    const FaceVector<D>& capacity, const CellField<D>& alpha,
                    const InterfaceAdvection<D>& interface, const FaceVector<D>* passes = nullptr);

  /// Without a surface: every cell with room has a pressure unknown. In a closed box its mean,
  /// weighted by `reference`, is zero.
  void cover_all(const CellField<D>& porosity, const CellField<D>& reference);

  /// Makes div(theta_f v) = target - give_way (p - p_old) in the unknown cells by v -= mobility
  /// grad p. Gibou et al. (2002), J. Comput. Phys. 176, for the surface rows. Throws
  /// DivergenceError when the solver does not reach `tolerance` [1/s]. `capacity` is theta_f.
  /// Velocity ghosts are stale afterwards, p's valid.
  SolveReport project(const FaceVector<D>& capacity, const FaceVector<D>& mobility,
                      const CellField<D>& target, const CellField<D>& give_way,
                      CellField<D>& pressure, FaceVector<D>& velocity, double tolerance);

  /// velocity -= mobility grad p, with the distances to the surface of find_surface(), on owned and
  /// bounding faces.
  void push(const FaceVector<D>& mobility, const CellField<D>& pressure,
            FaceVector<D>& velocity) const;

  /// What a surface at -suction instead of zero adds to push(): menisci between grains pull at the
  /// water.
  void pull(const FaceVector<D>& mobility, const CellField<D>& suction,
            FaceVector<D>& velocity) const;
  /// What they pull at the grains with, on which the water hangs [N/m3]: `suction` per area of the
  /// surface, spread as points spread a jump of their stress. Adds to faces of neighbours too.
  void hang(const CellField<D>& suction, FaceVector<D>& force) const;

  /// Distance over which the pressure falls at a face, in mean cells; 0: no pressure acts on it.
  const FaceVector<D>& reach() const { return distance_; }
  const CellField<D>& unknown() const { return unknown_; }  ///< 1 in cells with a pressure unknown

 private:
  double distance(const double* alpha, std::ptrdiff_t wet, int axis, int direction,
                  const InterfaceAdvection<D>& interface) const;
  double in_mean_cells(double xi, std::ptrdiff_t wet, int axis, int direction) const;
  double in_mean_cells(std::ptrdiff_t face, int axis) const;
  void find_wall_distances(const FaceVector<D>* passes);
  template <class Body>
  void for_each_meniscus(int axis, IndexBox<D> faces, const CellField<D>& suction,
                         Body&& body) const;
  void assemble(const FaceVector<D>& capacity, const FaceVector<D>& mobility,
                const CellField<D>& give_way);
  bool assemble_faces(const FaceVector<D>& capacity, const FaceVector<D>& mobility);
  double find_divergence(const FaceVector<D>& capacity, const CellField<D>& target,
                         const CellField<D>& give_way, const FaceVector<D>& velocity);
  void fix_constant(CellField<D>& pressure);

  const Grid<D>* grid_;
  const CellRuns<D>*near_, *beside_;
  double density_;
  Ghosts<D> ghosts_;
  CellField<D> unknown_;
  FaceVector<D> distance_;     ///< in mean cells; 0: no pressure acts on the face
  CellField<D> rise_, risen_;  ///< of the pressure in this pass, and in all of this projection [Pa]
  const CellField<D>* reference_ = nullptr;  ///< where pressure is zero in the mean, if given
  PressureSystem<D> system_;
  PressureSolver<D> solver_;
};

extern template class Projection<2>;
extern template class Projection<3>;

}  // namespace mudlark
