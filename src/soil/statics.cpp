#include "soil/statics.hpp"

#include <cmath>
#include <utility>

#include "soil/soil_solver.hpp"

namespace mudlark {
namespace {

/// Takes stress and pore pressure from points for its own life.
template <int D>
class WithoutStress {
 public:
  explicit WithoutStress(std::vector<SoilParticles<D>>& bodies) : bodies_(&bodies) {
    for (auto& points : bodies) {
      stress_.push_back(points.stress);
      pressure_.push_back(points.pore_pressure);
      for (int c = 0; c < 6; ++c) points.stress[c].assign(points.size(), 0.0);
      points.pore_pressure.assign(points.size(), 0.0);
    }
  }
  ~WithoutStress() {
    for (std::size_t b = 0; b < bodies_->size(); ++b) {
      (*bodies_)[b].stress = std::move(stress_[b]);
      (*bodies_)[b].pore_pressure = std::move(pressure_[b]);
    }
  }
  WithoutStress(const WithoutStress&) = delete;
  WithoutStress& operator=(const WithoutStress&) = delete;

 private:
  std::vector<SoilParticles<D>>* bodies_;
  std::vector<decltype(SoilParticles<D>::stress)> stress_;
  std::vector<decltype(SoilParticles<D>::pore_pressure)> pressure_;
};

/// Does a side hold a face: one that lies in it, or one of the row along a side of friction, which
/// takes its share of the force only when momentum is solved?
template <int D>
bool held_by_side(const SoilSides<D>& sides, const Index<D>& face, int component) {
  const Grid<D>& grid = sides.grid();
  for (int a = 0; a < D; ++a)
    for (const int side : {0, 1}) {
      const int last = grid.cells()[a] - (a == component ? 0 : 1);
      if (!grid.touches(a, side) || face[a] != (side == 0 ? 0 : last)) continue;
      if (a == component ? sides.node(a, side, a, face).mirrored
                         : sides.grains(a, side, face) == GrainSide::friction)
        return true;
    }
  return false;
}

}  // namespace

/// Sum of the squared forces on the faces of this rank that no side holds [N2].
template <int D>
double SoilSolver<D>::squared_force_on_free_faces() {
  gather_nodes();
  double sum = 0.0;
  for (int d = 0; d < D; ++d) {
    const NodeSums* sums = sums_[static_cast<std::size_t>(d)].data();
    // Bodies press on soil from outside, as loads do: as hard as in the last step.
    for_each(grid_->owned_faces(d).intersected(active_), [&](const Index<D>& face) {
      if (held_by_side(sides_, face, d)) return;
      const std::ptrdiff_t at = grid_->offset(face);
      const double solid = solid_contact_ ? solid_contact_->force(d, at) : 0.0;
      const double force = sums[at].mixture_force + solid;
      sum += force * force;
    });
  }
  return sum;
}

template <int D>
std::optional<Statics> SoilSolver<D>::statics() {
  if (length_ == 0.0) return {};
  if (travelled_ > 0.0) {
    redistribute();
    surface_.resample(active_);
  }
  std::array<double, 2> squares{}, all{};
  squares[0] = squared_force_on_free_faces();
  {
    const WithoutStress<D> only_loads(points_);
    squares[1] = squared_force_on_free_faces();
  }
  MPI_Allreduce(squares.data(), all.data(), 2, MPI_DOUBLE, MPI_SUM, grid_->comm());
  settle_sums();
  return Statics{share_of(std::sqrt(all[0]), std::sqrt(all[1])),
                 share_of(totals().kinetic_energy, std::abs(energy_.external))};
}

template double SoilSolver<2>::squared_force_on_free_faces();
template double SoilSolver<3>::squared_force_on_free_faces();
template std::optional<Statics> SoilSolver<2>::statics();
template std::optional<Statics> SoilSolver<3>::statics();

}  // namespace mudlark
