#pragma once
/// One cycle of hypre's structured multigrid (PFMG), for the level at which our own multigrid ends.
/// Ashby & Falgout (1996), Nucl. Sci. Eng. 124; Falgout & Jones (2000).
#include <memory>

#include "numerics/multigrid_level.hpp"

namespace mudlark {

template <int D>
class Pfmg {
 public:
  /// Along an axis with a period the ends are neighbours (hypre wants a power of two); 0 if not.
  Pfmg(MPI_Comm comm, const IndexBox<D>& owned, const Index<D>& period);
  ~Pfmg();
  Pfmg(const Pfmg&) = delete;
  Pfmg& operator=(const Pfmg&) = delete;

  /// Builds the hierarchy for the operator of a level of that shape. Collective.
  void build(const MultigridLevel<D>& level);
  /// solution = one symmetric cycle for the level's right side. Collective.
  void apply(MultigridLevel<D>& level);

 private:
  struct Hypre;  // keeps hypre's headers (and macros) out of everybody else's sight
  template <class Body>
  void for_each_run(const MultigridLevel<D>& level, Body&& body);

  MPI_Comm comm_;
  IndexBox<D> owned_;
  std::unique_ptr<Hypre> hypre_;
  std::vector<double> buffer_;  ///< of all owned cells
};

extern template class Pfmg<2>;
extern template class Pfmg<3>;

}  // namespace mudlark
