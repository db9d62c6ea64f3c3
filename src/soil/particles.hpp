#pragma once
/// The material points of one body of soil: a struct of arrays, one array per component.
#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/vec.hpp"

namespace mudlark {

/// One quantity of N components; component c of point p is c-th array, p-th entry.
template <int N>
struct PointQuantity {
  std::array<std::vector<double>, N> component;

  std::vector<double>& operator[](int c) { return component[static_cast<std::size_t>(c)]; }
  const std::vector<double>& operator[](int c) const {
    return component[static_cast<std::size_t>(c)];
  }
};

/// Points first, first + 1 .. last - 1.
struct PointRange {
  std::size_t first = 0, last = 0;
};

/// A cell and the first of the points that were sorted into it.
template <int D>
struct CellRun {
  Index<D> cell;
  std::size_t first = 0;
};

template <int D>
struct SoilParticles {
  bool carries_affine = false;        ///< set once, by the transfer in use
  bool carries_deformation = false;   ///< set once, by the strain measure in use
  bool carries_extent = false;        ///< set once, where points that stretch are split
  bool carries_contact = false;       ///< set once, where there are rigid bodies
  std::vector<std::int64_t> id;       ///< unique in the whole case
  PointQuantity<D> position;          ///< [m]
  PointQuantity<D> start;             ///< position at time zero [m]
  PointQuantity<D> velocity;          ///< grains [m/s]
  PointQuantity<D> water_velocity;    ///< pore water, interstitial [m/s]
  PointQuantity<D * D> affine;        ///< APIC matrix of the grains, row per component [1/s]
  PointQuantity<D * D> water_affine;  ///< the same of the pore water
  PointQuantity<6> stress;   ///< effective Cauchy stress xx yy zz xy yz zx [Pa], tension positive
  PointQuantity<6> elastic;  ///< left Cauchy-Green tensor b_e [-] or initial elastic strain (small)
  PointQuantity<D * D> deformation;  ///< deformation gradient [-]; used by strain = small
  /// F diag(l^2) F^T of the lattice's spacing l, xx zz zx or xx yy zz xy yz zx [m2]: the square of
  /// the space that a point stands for.
  PointQuantity<D*(D + 1) / 2> extent;
  /// Of rigid bodies in the last step [N], and between water and grains along the normal there.
  PointQuantity<D + 1> contact_force;
  std::vector<double> pore_pressure;  ///< [Pa], compression positive
  std::vector<double> grain_mass;     ///< [kg]
  std::vector<double> volume;         ///< bulk volume now [m^D]
  std::vector<double> start_volume;   ///< bulk volume at time zero [m^D]
  /// State variables of the soil law, one array per name; set once, by the law in use.
  std::vector<std::vector<double>> history;
  std::vector<std::string> history_names;  ///< without the unit
  std::vector<std::string> history_units;
  /// Cells in order, as of the last sort: tells the transfers where points of one cell lie side by
  /// side. A hint that makes them fast; where points lie they look up themselves.
  std::vector<CellRun<D>> runs;

  /// Makes room for the state variables "name [unit]" of a law.
  void set_history(std::span<const std::string_view> names) {
    for (const std::string_view name : names) {
      const std::size_t bracket = name.find(" [");
      history_names.emplace_back(name.substr(0, bracket));
      history_units.emplace_back(name.substr(bracket + 2, name.size() - bracket - 3));
    }
    history.resize(names.size());
  }

  std::size_t size() const { return id.size(); }

  /// Visits every array of doubles once: f(name, unit, components, arrays). Migration, sorting,
  /// checkpoints and output all run over this list, so a new quantity is added here and nowhere
  /// else.
  template <class F>
  void for_each_quantity(F&& f) {
    f("position", "m", D, position.component.data());
    f("initial position", "m", D, start.component.data());
    f("velocity", "m/s", D, velocity.component.data());
    f("water velocity", "m/s", D, water_velocity.component.data());
    if (carries_affine) {
      f("affine", "1/s", D * D, affine.component.data());
      f("water affine", "1/s", D * D, water_affine.component.data());
    }
    f("effective stress", "Pa", 6, stress.component.data());
    f("elastic state", "1", 6, elastic.component.data());
    if (carries_deformation) f("deformation gradient", "1", D * D, deformation.component.data());
    if (carries_extent) f("extent", "m2", D * (D + 1) / 2, extent.component.data());
    if (carries_contact) f("contact force", "N", D + 1, contact_force.component.data());
    f("pore pressure", "Pa", 1, &pore_pressure);
    f("grain mass", "kg", 1, &grain_mass);
    f("volume", "m^D", 1, &volume);
    f("initial volume", "m^D", 1, &start_volume);
    for (std::size_t h = 0; h < history.size(); ++h)
      f(history_names[h].c_str(), history_units[h].c_str(), 1, &history[h]);
  }
  /// The same, array by array.
  template <class F>
  void for_each_array(F&& f) {
    for_each_quantity([&](const char*, const char*, int components, std::vector<double>* arrays) {
      for (int c = 0; c < components; ++c) f(arrays[c]);
    });
  }
  void resize(std::size_t count) {
    id.resize(count);
    for_each_array([count](std::vector<double>& array) { array.resize(count, 0.0); });
  }
  template <class Archive>
  void archive(Archive& a, const std::string& body) {
    a.point_ids(body + "/id", id);
    for_each_quantity(
        [&](const char* name, const char*, int components, std::vector<double>* arrays) {
          for (int c = 0; c < components; ++c)
            a.points(body + "/" + name + " " + std::to_string(c), arrays[c], 1);
        });
  }

  /// Points from `first` on, up to about `most` of them, whole cells as last sorted.
  PointRange block(std::size_t first, std::size_t most) const {
    if (size() - first <= most) return {first, size()};
    const auto next =
        std::upper_bound(runs.begin(), runs.end(), first + most,
                         [](std::size_t p, const CellRun<D>& run) { return p < run.first; });
    if (next == runs.begin() || (next - 1)->first <= first) return {first, first + most};
    return {first, (next - 1)->first};
  }

  Vec<D> position_of(std::size_t p) const {
    Vec<D> x;
    for (int a = 0; a < D; ++a) x[a] = position[a][p];
    return x;
  }
};

/// Symmetric tensor of a point, from and to the arrays.
inline SymTensor get_tensor(const PointQuantity<6>& q, std::size_t p) {
  return {q[0][p], q[1][p], q[2][p], q[3][p], q[4][p], q[5][p]};
}
inline void set_tensor(PointQuantity<6>& q, std::size_t p, const SymTensor& t) {
  q[0][p] = t.xx, q[1][p] = t.yy, q[2][p] = t.zz, q[3][p] = t.xy, q[4][p] = t.yz, q[5][p] = t.zx;
}

}  // namespace mudlark
