#include "input/spectrum_file.hpp"

#include <fmt/format.h>

#include "base/errors.hpp"
#include "input/text_columns.hpp"

namespace mudlark {
namespace {

constexpr Quantity frequency{"a frequency", "Hz", "\"0.1 Hz\""};
constexpr Quantity density{"a density of the elevation's variance", "m2 s", "\"1 m2/Hz\""};

class Reader {
 public:
  Reader(const std::filesystem::path& file, const Units& units) : lines_(file), units_(units) {}

  std::vector<std::array<double, 2>> read() {
    std::string_view text;
    while (lines_.next(text)) take(text);
    double highest = 0.0;
    for (const auto& row : rows_) highest = std::max(highest, row[1]);
    if (rows_.size() < 2 || highest <= 0.0)
      lines_.fail_in_file(
          "a spectrum has at least two lines of frequency and density, and one density above 0");
    return std::move(rows_);
  }

 private:
  void take(std::string_view text) {
    const auto fields = fields_of(text, separator_of(text));
    if (fields.size() < 2) lines_.fail("two columns are expected, frequency and density");
    if (!begun_ && !number_of(fields[0])) {
      begun_ = true;
      factors_ = {factor(fields[0], frequency), factor(fields[1], density)};
      return;
    }
    begun_ = true;
    const auto f = number_of(fields[0]), s = number_of(fields[1]);
    if (!f || !s) lines_.fail("two numbers are expected, frequency and density");
    if (*f < 0.0 || *s < 0.0) lines_.fail("frequencies and densities are not negative");
    if (!rows_.empty() && *f * factors_[0] <= rows_.back()[0])
      lines_.fail(fmt::format("the frequency {} is not above the one before", *f));
    rows_.push_back({*f * factors_[0], *s * factors_[1]});
  }

  double factor(std::string_view title, const Quantity& quantity) const {
    const std::string unit = unit_in(title);
    if (unit.empty()) return 1.0;
    const auto reading = units_.read("1 " + unit, quantity);
    if (!reading || !reading->value)
      lines_.fail(fmt::format("the unit \"{}\" of the header does not hold: {}", unit,
                              reading ? reading->problem : "that is no unit"));
    return *reading->value;
  }

  TextLines lines_;
  const Units& units_;
  std::vector<std::array<double, 2>> rows_;
  std::array<double, 2> factors_{1.0, 1.0};
  bool begun_ = false;
};

}  // namespace

std::vector<std::array<double, 2>> read_spectrum_file(const std::filesystem::path& file,
                                                      const Units& units) {
  return Reader(file, units).read();
}

}  // namespace mudlark
