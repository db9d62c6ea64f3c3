#pragma once
/// The nodes around a point of an implicit step, for any kernel.
#include <vector>

#include "soil/point_stencil.hpp"

namespace mudlark {

/// Faces of all components, component after component, then cells.
template <int D>
struct ImplicitNodes {
  struct Face {
    int component;
    std::ptrdiff_t at;
    double weight;
    Vec<D> slope;
  };
  struct Cell {
    std::ptrdiff_t at;
    double weight;
  };
  std::vector<Face> faces;
  std::vector<Cell> cells;

  template <class K>
  void find(const Grid<D>& grid, const Vec<D>& per_spacing, const PointSplines<D, K>& splines) {
    faces.clear();
    cells.clear();
    PointSplines<D, K>::template static_for<D>([&]<int Component>() {
      splines.template for_each_node<Component>(
          grid, per_spacing, [&](std::ptrdiff_t at, double w, const Vec<D>& slope, const Vec<D>&) {
            faces.push_back({Component, at, w, slope});
          });
    });
    splines.template for_each_node<-1>(
        grid, per_spacing, [&](std::ptrdiff_t at, double w, const Vec<D>&, const Vec<D>&) {
          cells.push_back({at, w});
        });
  }
  bool same_places(const ImplicitNodes& other) const {
    return !faces.empty() && faces.size() == other.faces.size() &&
           faces.front().at == other.faces.front().at && faces.back().at == other.faces.back().at &&
           cells.front().at == other.cells.front().at;
  }
};

}  // namespace mudlark
