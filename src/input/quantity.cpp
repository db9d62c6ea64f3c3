#include "input/quantity.hpp"

#include <fmt/format.h>
#include <udunits2.h>

#include <cctype>
#include <charconv>
#include <cmath>

#include "base/errors.hpp"

namespace mudlark {
namespace {

using Unit = std::unique_ptr<ut_unit, void (*)(ut_unit*)>;

Unit parse_unit(ut_system* system, std::string_view text) {
  return {ut_parse(system, std::string(text).c_str(), UT_UTF8), ut_free};
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.front())))
    text.remove_prefix(1);
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())))
    text.remove_suffix(1);
  return text;
}

bool may_be_unit(std::string_view text) {
  const auto first = static_cast<unsigned char>(text.front());
  return std::isalpha(first) || first == '%' || first >= 0x80u || text.starts_with("1/");
}

/// UDUNITS calls s and Hz convertible; only a ratio without dimension is the same dimension.
bool same_dimension(const Unit& left, const Unit& right) {
  const Unit ratio(ut_divide(left.get(), right.get()), ut_free);
  return ratio && ut_is_dimensionless(ratio.get());
}

}  // namespace

Units::Units() : system_(nullptr, ut_free_system) {
  ut_set_error_message_handler(ut_ignore);
  system_.reset(ut_read_xml(nullptr));
  if (!system_) throw std::runtime_error("the database of units (UDUNITS-2) cannot be read");
}

std::optional<Units::Reading> Units::read(std::string_view text, const Quantity& quantity) const {
  text = trimmed(text);
  if (text.starts_with('+')) text.remove_prefix(1);
  double number = 0.0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error == std::errc::result_out_of_range)
    return Reading{{}, "the number is too large or too small for the computer"};
  if (error != std::errc{}) return {};
  const auto used = static_cast<std::size_t>(stop - text.data());
  const std::string_view rest = trimmed(text.substr(used));
  const std::string wish = fmt::format("{} [{}] is expected, for example {}", quantity.name,
                                       quantity.unit, quantity.example);
  if (rest.empty()) {
    if (!std::isfinite(number)) return Reading{{}, "not a finite number; " + wish};
    return Reading{number, {}};
  }
  if (!may_be_unit(rest)) return {};
  const Unit unit = parse_unit(system_.get(), rest);
  if (!unit)
    return Reading{{}, fmt::format("\"{}\" is no unit that UDUNITS-2 knows; {}", rest, wish)};
  const Unit target = parse_unit(system_.get(), quantity.unit);
  if (!same_dimension(unit, target)) {
    const bool minutes = quantity.unit == "s" && (rest == "m" || rest == "M");
    return Reading{{},
                   fmt::format("\"{}\" has the wrong dimension{}; {}", rest,
                               minutes ? ", minutes are \"min\"" : "", wish)};
  }
  const std::unique_ptr<cv_converter, void (*)(cv_converter*)> convert(
      ut_get_converter(unit.get(), target.get()), cv_free);
  if (!convert) return Reading{{}, fmt::format("\"{}\" cannot be converted; {}", rest, wish)};
  const double si = cv_convert_double(convert.get(), number);
  if (!std::isfinite(si)) return Reading{{}, "not a finite number; " + wish};
  return Reading{si, {}};
}

double read_quantity(const std::string& name, const std::string& text, const Quantity& quantity) {
  const auto reading = Units().read(text, quantity);
  if (reading && reading->value) return *reading->value;
  throw InputError(fmt::format("{} = {} is not possible\n  ({})", name, text,
                               reading
                                   ? reading->problem
                                   : fmt::format("{} [{}] is expected, for example {}",
                                                 quantity.name, quantity.unit, quantity.example)));
}

}  // namespace mudlark
