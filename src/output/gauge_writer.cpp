#include "output/gauge_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "base/errors.hpp"
#include "output/files.hpp"

namespace mudlark {
namespace {

bool fit_for_a_file_name(const std::string& name) {
  return !name.empty() && name.front() != '.' &&
         std::all_of(name.begin(), name.end(), [](unsigned char c) {
           return std::isalnum(c) || c == ' ' || c == '.' || c == '_' || c == '-';
         });
}

/// Numbers of one line; empty when it is not a complete row.
std::vector<double> numbers_of(const std::string& line, std::size_t expected) {
  std::vector<double> numbers;
  const char* at = line.c_str();
  while (numbers.size() < expected) {
    char* end = nullptr;
    numbers.push_back(std::strtod(at, &end));
    const bool last = numbers.size() == expected;
    if (end == at || (last ? *end != '\0' : *end != ',')) return {};
    at = end + 1;
  }
  return numbers;
}

}  // namespace

GaugeWriter::GaugeWriter(MPI_Comm comm, const std::filesystem::path& folder, std::string name,
                         std::vector<std::string> columns, std::optional<double> resumed_at)
    : comm_(comm),
      file_path_(folder / "gauges" / (name + ".csv")),
      name_(std::move(name)),
      columns_(std::move(columns)) {
  MPI_Comm_rank(comm_, &rank_);
  if (!fit_for_a_file_name(name_))
    throw InputError(fmt::format(
        "the gauge name \"{}\" cannot be a file name.\n  Use letters, digits, blank, '.', '_' "
        "and '-' only, and no '.' first.",
        name_));
  prepare_folder(folder / "gauges", comm_);
  on_rank_zero(comm_, [&] { start(resumed_at.has_value(), resumed_at.value_or(0.0)); });
}

std::string GaugeWriter::header() const {
  std::string line = "time [s]";
  for (const std::string& column : columns_) line += "," + column;
  return line + "\n";
}

void GaugeWriter::start(bool resume, double resumed_at) {
  const std::string rows = resume ? keep_rows(resumed_at) : "";
  try {
    write_atomically(file_path_, header() + rows);
  } catch (const std::runtime_error& error) {
    throw InputError(fmt::format("{}.\n  Name another folder with -o DIR.", error.what()));
  }
  file_.reset(std::fopen(file_path_.c_str(), "a"));
  if (!file_)
    throw InputError(
        fmt::format("cannot write {} ({})", file_path_.string(), std::strerror(errno)));
}

std::string GaugeWriter::keep_rows(double resumed_at) {
  std::ifstream stream(file_path_, std::ios::binary);
  const std::string all{std::istreambuf_iterator<char>(stream), {}};
  std::string kept;
  std::size_t at = all.find('\n');
  if (at == std::string::npos) return kept;
  if (all.substr(0, at + 1) != header())
    throw InputError(
        fmt::format("{} was written with other columns than this case has, so it cannot be "
                    "continued.\n  Resume with the case "
                    "file that the run was started with, or start anew without --resume.",
                    file_path_.string()));
  // A row without its line end is the one during which the earlier run was killed.
  for (++at; at < all.size();) {
    const std::size_t end = all.find('\n', at);
    if (end == std::string::npos) break;
    const std::string line = all.substr(at, end - at);
    const auto numbers = numbers_of(line, columns_.size() + 1);
    if (numbers.empty() || numbers[0] > resumed_at) break;
    note(numbers[0], std::span(numbers).subspan(1));
    kept += line + "\n";
    at = end + 1;
  }
  return kept;
}

void GaugeWriter::note(double time, std::span<const double> values) {
  if (!extremes_) {
    const std::vector<double> first(values.begin(), values.end());
    extremes_ = GaugeExtremes{time, first, first, first};
    return;
  }
  extremes_->time = time;
  for (std::size_t i = 0; i < values.size(); ++i) {
    extremes_->last[i] = values[i];
    // Numbers win against those that are not known.
    extremes_->smallest[i] = std::fmin(extremes_->smallest[i], values[i]);
    extremes_->largest[i] = std::fmax(extremes_->largest[i], values[i]);
  }
}

void GaugeWriter::sample(double time, std::span<const double> values) {
  if (rank_ != 0 || (extremes_ && time <= extremes_->time)) return;
  std::string row = fmt::format("{:.17g}", time);
  for (const double value : values) row += fmt::format(",{:.17g}", value);
  row += '\n';
  if (std::fwrite(row.data(), 1, row.size(), file_.get()) != row.size() && problem_.empty())
    problem_ = fmt::format("cannot write {} ({})", file_path_.string(), std::strerror(errno));
  note(time, values);
}

void GaugeWriter::flush() {
  on_rank_zero(comm_, [&] {
    if (std::fflush(file_.get()) != 0 && problem_.empty())
      problem_ = fmt::format("cannot write {} ({})", file_path_.string(), std::strerror(errno));
    if (!problem_.empty()) throw std::runtime_error(problem_);
  });
}

}  // namespace mudlark
