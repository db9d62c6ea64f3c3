#include "output/checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "base/errors.hpp"
#include "output/checkpoint_file.hpp"
#include "output/files.hpp"

namespace mudlark {
namespace {

using checkpoint_file::Header;
using checkpoint_file::state_names;

std::string dataset_of(std::string name) {
  std::replace(name.begin(), name.end(), '/', ':');
  return "/" + name;
}

/// Shape and place of the grid; a state fits no other.
template <int D>
std::int64_t grid_hash(const Grid<D>& grid) {
  std::string text = fmt::format("{}", D);
  for (int a = 0; a < D; ++a)
    text += fmt::format(" {} {:.17g} {:.17g} {}", grid.cells()[a], grid.lower()[a],
                        grid.spacing()[a], grid.periodic(a));
  for (int a = 0; a < D; ++a)
    for (int i = 0; grid.stretched(a) && i < grid.cells()[a]; ++i)
      text += fmt::format(" {:.17g}", grid.face_position(a, i));
  return checkpoint_file::hash_of(text);
}

/// A box of this rank inside an array that begins at index 0 on each axis.
template <int D>
Slab slab_of(const IndexBox<D>& box, const Index<D>& extent) {
  Slab slab;
  for (int a = D - 1; a >= 0; --a) {
    slab.extent.push_back(static_cast<hsize_t>(extent[a]));
    slab.start.push_back(static_cast<hsize_t>(box.lower[a]));
    slab.count.push_back(static_cast<hsize_t>(box.upper[a] - box.lower[a]));
  }
  return slab;
}

template <int D>
Slab cell_slab(const Grid<D>& grid) {
  return slab_of<D>(grid.owned(), grid.cells());
}

template <int D>
Slab face_slab(const Grid<D>& grid, int axis) {
  return slab_of<D>(grid.owned_faces(axis),
                    grid.cells().shifted(axis, grid.periodic(axis) ? 0 : 1));
}

std::string face_name(const std::string& name, int axis) {
  return fmt::format("{} axis {}", name, axis);
}
std::string counts_name(const std::string& name) { return name + " counts"; }

/// A number that only rank 0 stores.
Slab single(int rank) { return Slab::rows(1, 0, rank == 0 ? 1 : 0); }

}  // namespace

template <int D>
CheckpointWriter<D>::CheckpointWriter(const Grid<D>& grid, std::filesystem::path folder,
                                      const std::string& case_text, std::int64_t step, double time)
    : grid_(&grid), folder_(std::move(folder)) {
  prepare_folder(folder_, grid.comm());
  Header header;
  int target = 0;
  std::int64_t oldest = -1;
  for (int i = 0; i < 2; ++i) {
    const auto found = checkpoint_file::header_of(folder_ / state_names[i], grid.comm());
    const std::int64_t sequence = found ? found->sequence : 0;
    if (oldest < 0 || sequence < oldest) oldest = sequence, target = i;
    header.sequence = std::max(header.sequence, sequence + 1);
  }
  target_ = folder_ / state_names[target];
  file_ =
      std::make_unique<Hdf5File>(target_.string() + ".part", Hdf5File::Mode::create, grid.comm());
  header.step = step;
  header.time = time;
  header.ranks = grid.ranks();
  header.case_hash = checkpoint_file::hash_of(case_text);
  header.grid_hash = grid_hash(grid);
  header_ = header;
}

template <int D>
template <class T>
void CheckpointWriter<D>::store(const std::string& name, const Slab& slab, const T* values) {
  const std::string dataset = dataset_of(name);
  file_->write(dataset, slab, values);
  file_->set_attribute(dataset, "checksum", checkpoint_file::checksum(slab, values, grid_->comm()));
  ++header_.datasets;
}

template <int D>
void CheckpointWriter<D>::number(const std::string& name, const double& value) {
  store(name, single(grid_->rank()), &value);
}

template <int D>
void CheckpointWriter<D>::integer(const std::string& name, const std::int64_t& value) {
  store(name, single(grid_->rank()), &value);
}

template <int D>
void CheckpointWriter<D>::cells(const std::string& name, const CellField<D>& field) {
  std::vector<double> values;
  for_each(grid_->owned(), [&](const Index<D>& cell) { values.push_back(field[cell]); });
  store(name, cell_slab(*grid_), values.data());
}

template <int D>
void CheckpointWriter<D>::faces(const std::string& name, const FaceVector<D>& vector) {
  for (int a = 0; a < D; ++a) {
    std::vector<double> values;
    for_each(grid_->owned_faces(a),
             [&](const Index<D>& face) { values.push_back(vector[a][face]); });
    store(face_name(name, a), face_slab(*grid_, a), values.data());
  }
}

template <int D>
template <class T>
void CheckpointWriter<D>::store_points(const std::string& name, const std::vector<T>& values,
                                       int per_point) {
  const auto mine = static_cast<std::int64_t>(values.size()) / per_point;
  std::int64_t through_me = 0, total = 0;
  MPI_Scan(&mine, &through_me, 1, MPI_INT64_T, MPI_SUM, grid_->comm());
  MPI_Allreduce(&mine, &total, 1, MPI_INT64_T, MPI_SUM, grid_->comm());
  store(name, Slab::rows(total, through_me - mine, mine, per_point), values.data());
  store(counts_name(name), Slab::rows(grid_->ranks(), grid_->rank(), 1), &mine);
}

template <int D>
void CheckpointWriter<D>::points(const std::string& name, const std::vector<double>& values,
                                 int per_point) {
  store_points(name, values, per_point);
}

template <int D>
void CheckpointWriter<D>::point_ids(const std::string& name, const std::vector<std::int64_t>& ids) {
  store_points(name, ids, 1);
}

template <int D>
void CheckpointWriter<D>::commit() {
  checkpoint_file::write_header(*file_, header_);
  const std::filesystem::path temporary = target_.string() + ".part";
  try {
    file_->close();
  } catch (const std::runtime_error&) {
    file_.reset();
    on_rank_zero(grid_->comm(), [&] {
      std::error_code ignored;
      std::filesystem::remove(temporary, ignored);
    });
    throw;
  }
  file_.reset();
  on_rank_zero(grid_->comm(), [&] { rename_durably(temporary, target_); });
}

template <int D>
CheckpointReader<D>::CheckpointReader(const Grid<D>& grid, const std::filesystem::path& folder,
                                      const std::string& case_text,
                                      const std::function<void(const std::string&)>& note)
    : grid_(&grid) {
  const auto header = newest_good_state(folder, note);
  if (!header)
    throw InputError(
        fmt::format("there is no good saved state in {}, so the run cannot be resumed.\n  Start it "
                    "anew without --resume.",
                    folder.string()));
  if (header->version != checkpoint_file::format_version)
    throw InputError(
        fmt::format("the saved states in {} are in format {} of another version of Mudlark (this "
                    "one reads format {}).\n  Resume "
                    "with the version that wrote them, or start anew without --resume.",
                    folder.string(), header->version, checkpoint_file::format_version));
  if (header->case_hash != checkpoint_file::hash_of(case_text) ||
      header->grid_hash != grid_hash(grid))
    throw InputError(
        fmt::format("the saved states in {} belong to another case: the case file was changed "
                    "since.\n  Resume with the case file "
                    "that the run was started with (see case.toml in the results folder), or start "
                    "anew without --resume.",
                    folder.string()));
  step_ = header->step;
  time_ = header->time;
  saved_ranks_ = static_cast<int>(header->ranks);
}

template <int D>
std::optional<Header> CheckpointReader<D>::newest_good_state(
    const std::filesystem::path& folder, const std::function<void(const std::string&)>& note) {
  struct State {
    std::filesystem::path path;
    std::int64_t sequence;
  };
  std::vector<State> states;
  for (const char* name : state_names) {
    const auto path = folder / name;
    const auto header = checkpoint_file::header_of(path, grid_->comm());
    states.push_back({path, header ? header->sequence : 0});
  }
  std::stable_sort(states.begin(), states.end(),
                   [](const State& a, const State& b) { return a.sequence > b.sequence; });
  std::optional<Header> good;
  for (const auto& [path, sequence] : states) {
    int there = 0;
    on_rank_zero(grid_->comm(), [&] { there = std::filesystem::exists(path); });
    MPI_Bcast(&there, 1, MPI_INT, 0, grid_->comm());
    if (!there) continue;
    const std::string damage = checkpoint_file::damage_of(path, grid_->comm());
    if (damage.empty()) {
      if (good) continue;
      file_ = std::make_unique<Hdf5File>(path, Hdf5File::Mode::read, grid_->comm());
      good = checkpoint_file::read_header(*file_);
      continue;
    }
    on_rank_zero(grid_->comm(), [&] {
      std::error_code ignored;
      std::filesystem::rename(path, path.string() + ".damaged", ignored);
      if (note)
        note(fmt::format("the saved state {} is damaged ({}); it is passed over", path.string(),
                         damage));
    });
  }
  return good;
}

template <int D>
template <class T>
void CheckpointReader<D>::load_single(const std::string& name, T& value) {
  file_->read(dataset_of(name), Slab::rows(1, 0, 1), &value);
}

template <int D>
void CheckpointReader<D>::number(const std::string& name, double& value) {
  load_single(name, value);
}

template <int D>
void CheckpointReader<D>::number_if_known(const std::string& name, double& value) {
  const auto names = file_->names_in("/");
  if (std::find(names.begin(), names.end(), dataset_of(name).substr(1)) != names.end())
    load_single(name, value);
}

template <int D>
void CheckpointReader<D>::integer(const std::string& name, std::int64_t& value) {
  load_single(name, value);
}

template <int D>
void CheckpointReader<D>::cells(const std::string& name, CellField<D>& field) {
  const Slab slab = cell_slab(*grid_);
  std::vector<double> values(slab.size());
  file_->read(dataset_of(name), slab, values.data());
  std::size_t k = 0;
  for_each(grid_->owned(), [&](const Index<D>& cell) { field[cell] = values[k++]; });
}

template <int D>
void CheckpointReader<D>::faces(const std::string& name, FaceVector<D>& vector) {
  for (int a = 0; a < D; ++a) {
    const Slab slab = face_slab(*grid_, a);
    std::vector<double> values(slab.size());
    file_->read(dataset_of(face_name(name, a)), slab, values.data());
    std::size_t k = 0;
    for_each(grid_->owned_faces(a), [&](const Index<D>& face) { vector[a][face] = values[k++]; });
  }
}

template <int D>
template <class T>
void CheckpointReader<D>::load_points(const std::string& name, std::vector<T>& values,
                                      int per_point) {
  std::vector<std::int64_t> counts(static_cast<std::size_t>(saved_ranks_));
  file_->read(dataset_of(counts_name(name)), Slab::rows(saved_ranks_, 0, saved_ranks_),
              counts.data());
  std::int64_t total = 0, first = 0, mine = 0;
  for (const std::int64_t count : counts) total += count;
  const std::int64_t rank = grid_->rank(), ranks = grid_->ranks();
  if (saved_ranks_ == grid_->ranks()) {
    for (std::int64_t r = 0; r < rank; ++r) first += counts[static_cast<std::size_t>(r)];
    mine = counts[static_cast<std::size_t>(rank)];
  } else {
    first = total * rank / ranks;
    mine = total * (rank + 1) / ranks - first;
  }
  values.resize(static_cast<std::size_t>(mine * per_point));
  file_->read(dataset_of(name), Slab::rows(total, first, mine, per_point), values.data());
}

template <int D>
void CheckpointReader<D>::points(const std::string& name, std::vector<double>& values,
                                 int per_point) {
  load_points(name, values, per_point);
}

template <int D>
void CheckpointReader<D>::point_ids(const std::string& name, std::vector<std::int64_t>& ids) {
  load_points(name, ids, 1);
}

template <int D>
void CheckpointReader<D>::finish() {
  file_->close();
}

void remove_checkpoints(const std::filesystem::path& folder, MPI_Comm comm) {
  on_rank_zero(comm, [&] {
    std::error_code ignored;
    for (const char* name : state_names) {
      std::filesystem::remove(folder / name, ignored);
      std::filesystem::remove(folder / (std::string(name) + ".part"), ignored);
      std::filesystem::remove(folder / (std::string(name) + ".damaged"), ignored);
    }
  });
}

template class CheckpointWriter<2>;
template class CheckpointWriter<3>;
template class CheckpointReader<2>;
template class CheckpointReader<3>;

}  // namespace mudlark
