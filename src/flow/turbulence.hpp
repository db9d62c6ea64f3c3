#pragma once
/// Turbulence that the grid does not resolve, as an eddy viscosity (docs/methods/turbulence.md).
#include "flow/options.hpp"
#include "flow/porous_medium.hpp"
#include "numerics/ghosts.hpp"

namespace mudlark {

/// Constants of the k-epsilon model (Launder & Spalding 1974, Comput. Methods Appl. Mech. Eng. 3).
struct KEpsilonConstants {
  static constexpr double c_mu = 0.09, c1 = 1.44, c2 = 1.92, sigma_k = 1.0, sigma_epsilon = 1.3;
};

/// Turbulent energy k [m2/s2] and its dissipation epsilon [m2/s3].
struct KEpsilon {
  double k, epsilon;
};
/// What a time dt of production [m2/s3] and decay makes of them: half the production, all of the
/// decay (exact: k falls with the power -1/(C2 - 1) of time), half the production.
KEpsilon produce_and_decay(KEpsilon state, double production, double production_of_epsilon,
                           double dt);
/// nu_t = C_mu k^2/epsilon [m2/s], cut where strain exceeds rotation so far that the flow is
/// irrotational: waves would make turbulence without end. Larsen & Fuhrman (2018), J. Fluid Mech.
/// 853, lambda_2 = 0.05; strain2 = 2 S_ij S_ij, rotation2 = 2 Omega_ij Omega_ij [1/s2].
double limited_eddy_viscosity(KEpsilon state, double strain2, double rotation2);

template <int D>
class Turbulence {
 public:
  Turbulence(const Grid<D>& grid, const FlowOptions& options);

  /// Moves k and epsilon with the mass that moved (k-epsilon only). Mass after it is relative to
  /// water that fills the cell, `mass_flux` the share of that which passed each face.
  void move(const CellField<D>& mass, const FaceVector<D>& mass_flux);
  /// Diffusion, production and decay of k and epsilon over dt, with the strain of the last find();
  /// then viscosity() is that of the present densities. Ghosts of alpha and velocity are valid.
  void advance(const PorousMedium<D>& medium, const CellField<D>& alpha,
               const FaceVector<D>& velocity, double dt);
  /// The eddy viscosity of the present velocity, whose ghosts are valid.
  void find(const PorousMedium<D>& medium, const CellField<D>& alpha,
            const FaceVector<D>& velocity);

  /// nu_t and rho nu_t [m2/s, Pa s], ghosts valid; odd at no-slip walls, so zero on them.
  const CellField<D>& eddy_viscosity() const { return eddy_; }
  const CellField<D>& viscosity() const { return dynamic_; }
  double largest() const;  ///< nu_t of all ranks [m2/s]. Collective.
  std::vector<const CellField<D>*> fields() const;

  template <class Archive>
  void archive(Archive& a) {
    a.cells("eddy viscosity", eddy_);
    if (options_.model == TurbulenceModel::k_epsilon) {
      a.cells("turbulent energy", k_);
      a.cells("dissipation", epsilon_);
      a.cells("strain", strain2_);
      a.cells("rotation", rotation2_);
    }
    update_ghosts();
  }

 private:
  void find_grain_size(const FlowOptions& options);
  void find_rates(const FaceVector<D>& velocity);
  void diffuse(const CellField<D>& alpha, double share, double dt, CellField<D>& field);
  void react(const PorousMedium<D>& medium, const CellField<D>& alpha,
             const FaceVector<D>& velocity, double dt);
  void find_wall_row(int axis, int side, const CellField<D>& alpha, const FaceVector<D>& velocity);
  void update_ghosts();
  bool wet(double alpha) const { return everywhere_ || alpha >= 0.5; }
  double speed2(const FaceVector<D>& velocity, std::ptrdiff_t at, int without) const;

  const Grid<D>* grid_;
  TurbulenceOptions options_;
  double density_, gas_density_;
  double viscosity_;  ///< kinematic, of water [m2/s]
  bool everywhere_;   ///< a gas is computed, too
  Ghosts<D> ghosts_;
  CellField<D> eddy_, dynamic_, k_, epsilon_, strain2_, rotation2_, old_;
  CellField<D> wall_production_;  ///< at walls [m2/s3]; negative elsewhere
  CellField<D> wall_distance_;    ///< to the nearest no-slip wall [m]
  CellField<D> grain_size_;       ///< of fixed ground [m]; 0: unknown
};

extern template class Turbulence<2>;
extern template class Turbulence<3>;

}  // namespace mudlark
