#pragma once
/// How solvers show their state to checkpoints. A solver has one member template
///
///   template <class Archive> void archive(Archive& a) {
///     a.number("time", time_);                    // double&
///     a.number_if_known("volume", volume_);       // the same for what a run may gain when resumed
///     a.integer("step", step_);                   // std::int64_t&
///     a.cells("water fraction", water_);          // CellField<D>&
///     a.faces("velocity", velocity_);             // FaceVector<D>&
///     a.points("position", positions_, D);        // std::vector<double>&, values per point
///     a.point_ids("id", ids_);                    // std::vector<std::int64_t>&, one per point
///   }
///
/// that serves saving and loading alike, so a new quantity is added once. Names are unique in a
/// checkpoint.
///
/// Ghost values are not stored: after loading, the owner of each field restores them (halo
/// exchange, walls) before anything reads them. Archives: CheckpointWriter (`loading` = false) and
/// CheckpointReader
/// (`loading` = true) in output/checkpoint.hpp.
