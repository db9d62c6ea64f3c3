#include "output/output_series.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "base/errors.hpp"
#include "output/files.hpp"

namespace mudlark {
namespace {

StoredOutput read_output(Hdf5File& file, const std::string& group) {
  StoredOutput output{group,
                      file.number(group, "time"),
                      file.integer(group, "step"),
                      file.integer(group, "count"),
                      {}};
  for (const std::string& dataset : file.names_in(group)) {
    const std::string path = group + "/" + dataset;
    output.arrays.push_back({dataset, file.text(path, "name"), file.text(path, "unit"),
                             static_cast<int>(file.integer(path, "components")),
                             file.holds_integers(path)});
  }
  return output;
}

}  // namespace

std::string dataset_name(const std::string& quantity) {
  std::string name = quantity;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == ' ' || c == '/'; }, '_');
  return name;
}

OutputSeries::OutputSeries(std::filesystem::path folder, std::string name, MPI_Comm comm,
                           std::optional<double> resumed_at, Describe describe)
    : folder_(std::move(folder)),
      name_(std::move(name)),
      comm_(comm),
      describe_(std::move(describe)) {
  prepare_folder(folder_, comm_);
  bool there = false;
  on_rank_zero(comm_, [&] { there = std::filesystem::exists(data_path()); });
  MPI_Bcast(&there, 1, MPI_CXX_BOOL, 0, comm_);
  if (resumed_at && there)
    pick_up(*resumed_at);
  else
    start_empty();
  write_xdmf();
}

void OutputSeries::start_empty() {
  try {
    Hdf5File file(data_path(), Hdf5File::Mode::create, comm_);
    file.close();
  } catch (const std::runtime_error& error) {
    throw InputError(fmt::format(
        "cannot write the results ({}).\n  Name another folder with -o DIR.", error.what()));
  }
}

void OutputSeries::pick_up(double time) {
  try {
    Hdf5File file(data_path(), Hdf5File::Mode::append, comm_);
    for (const std::string& name : file.names_in("/")) {
      outputs_.push_back(read_output(file, "/" + name));
      next_number_ = std::max(next_number_, static_cast<std::int64_t>(std::stoll(name)) + 1);
    }
    // A group without all its attributes is the output during which the earlier run was killed.
    if (file.failed()) throw std::runtime_error("an output is not complete");
    remove_outputs(file, [&](const StoredOutput& output) { return output.time > time; });
    file.close();
  } catch (const std::exception&) {
    // The earlier run died while it wrote: keep what is there for the user, go on in a new file.
    outputs_.clear();
    next_number_ = 0;
    on_rank_zero(comm_,
                 [&] { std::filesystem::rename(data_path(), folder_ / (name_ + "-damaged.h5")); });
    start_empty();
  }
}

void OutputSeries::remove_outputs(Hdf5File& file,
                                  const std::function<bool(const StoredOutput&)>& unwanted) {
  for (const StoredOutput& output : outputs_)
    if (unwanted(output)) file.remove(output.group);
  std::erase_if(outputs_, unwanted);
}

void OutputSeries::write(double time, std::int64_t step, const Fill& fill) {
  Hdf5File file(data_path(), Hdf5File::Mode::append, comm_);
  remove_outputs(file, [&](const StoredOutput& output) { return output.time >= time; });
  StoredOutput output{fmt::format("/{:06d}", next_number_), time, step, 0, {}};
  file.make_group(output.group);
  file.set_attribute(output.group, "time", time);
  file.set_attribute(output.group, "step", step);
  fill(file, output);
  file.set_attribute(output.group, "count", output.count);
  file.close();
  outputs_.push_back(std::move(output));
  ++next_number_;
  write_xdmf();
}

void OutputSeries::write_xdmf() const {
  on_rank_zero(comm_, [&] { write_atomically(folder_ / (name_ + ".xdmf"), describe_(outputs_)); });
}

template <class T>
void store_array(Hdf5File& file, StoredOutput& output, StoredArray array, const Slab& slab,
                 const T* values) {
  array.dataset = dataset_name(array.name);
  array.integers = std::is_same_v<T, std::int64_t>;
  const std::string path = output.group + "/" + array.dataset;
  file.write(path, slab, values);
  file.set_attribute(path, "name", array.name);
  file.set_attribute(path, "unit", array.unit);
  file.set_attribute(path, "components", static_cast<std::int64_t>(array.components));
  output.arrays.push_back(std::move(array));
}

template void store_array(Hdf5File&, StoredOutput&, StoredArray, const Slab&, const double*);
template void store_array(Hdf5File&, StoredOutput&, StoredArray, const Slab&, const std::int64_t*);

}  // namespace mudlark
