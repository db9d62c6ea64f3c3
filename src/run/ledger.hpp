#pragma once
/// What must be conserved, and how far it is off.
#include <string>
#include <utility>
#include <vector>

#include "base/vec.hpp"

namespace mudlark {

template <int D>
class World;

/// Sums at the start of a run, kept through checkpoints.
template <int D>
struct Ledger {
  double grain_mass = 0.0;      ///< [kg]
  Vec<D> momentum{};            ///< of water, pore water and grains [kg m/s]
  double momentum_scale = 0.0;  ///< mass times root-mean-square speed at the start [kg m/s]

  template <class Archive>
  void archive(Archive& a) {
    a.number("ledger/grain mass", grain_mass);
    a.number("ledger/momentum scale", momentum_scale);
    for (int axis = 0; axis < D; ++axis)
      a.number("ledger/momentum " + std::to_string(axis), momentum[axis]);
  }
};

/// Opens the ledger with the present state. Collective.
template <int D>
Ledger<D> open_ledger(World<D>& world);

/// Relative errors by name: "water" (initial - outflow - present, over initial), "grains" (the same
/// for the mass of the grains, with what stages placed and took out), "momentum" (change over mass
/// times speed at the start; only where nothing acts from outside: axes that are periodic and
/// without gravity; otherwise NaN, written as null). Collective.
template <int D>
std::vector<std::pair<std::string, double>> conservation_errors(World<D>& world);

}  // namespace mudlark
