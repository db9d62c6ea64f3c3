/// Lists, and values that vary in space and time.
#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "input/expression.hpp"
#include "input/section.hpp"

namespace mudlark {

std::vector<double> Section::numbers(std::string_view key, const Quantity& quantity,
                                     std::size_t count,
                                     const std::optional<std::vector<double>>& fallback) {
  const Value* value = find(key);
  std::vector<double> result;
  const std::string wish =
      count == 0 ? fmt::format("a list of numbers [{}] is expected", quantity.unit)
                 : fmt::format("a list of {} numbers [{}] is expected, one per axis ({})", count,
                               quantity.unit, count == 2 ? "x, z" : "x, y, z");
  if (!value) {
    if (!fallback) {
      missing(key, wish);
      return result;
    }
    result = *fallback;
  } else {
    const auto* list = std::get_if<List>(&value->data);
    if (!list || (count > 0 && list->size() != count)) {
      fail(key, wish);
      return result;
    }
    for (std::size_t i = 0; i < list->size(); ++i) {
      const auto entry = si((*list)[i], fmt::format("{}[{}]", name_of(key), i), quantity);
      if (entry) result.push_back(*entry);
    }
    if (result.size() != list->size()) return {};
  }
  record_->value(key, toml_numbers(result), quantity.unit);
  return result;
}

std::vector<std::array<double, 2>> Section::pairs(std::string_view key, const Quantity& quantity) {
  const Value* value = find(key);
  std::vector<std::array<double, 2>> result;
  const auto* list = value ? std::get_if<List>(&value->data) : nullptr;
  if (!list) {
    fail(key, "a list of pairs is expected, for example [[0, 0], [1, 0], [1, 2]]");
    return result;
  }
  std::string recorded;
  for (std::size_t i = 0; i < list->size(); ++i) {
    const Value& item = (*list)[i];
    const std::string name = fmt::format("{}[{}]", name_of(key), i);
    const auto* pair = std::get_if<List>(&item.data);
    if (!pair || pair->size() != 2) {
      reading_->report.add_impossible(item.place, name, item.written, "a pair [a, b] is expected");
      return {};
    }
    const auto first = si((*pair)[0], name, quantity), second = si((*pair)[1], name, quantity);
    if (!first || !second) return {};
    result.push_back({*first, *second});
    recorded += (i > 0 ? ", " : "") + toml_numbers({*first, *second});
  }
  record_->value(key, "[" + recorded + "]", quantity.unit);
  return result;
}

std::optional<Varying> Section::table_of_times(const Table& table, const Value& value,
                                               const std::string& name, const Quantity& quantity,
                                               const Bounds& bounds) {
  Record scratch;
  Section section(&table, value.place, name, *reading_, scratch);
  const std::size_t before = reading_->report.size();
  const std::vector<double> times = section.numbers("time", quantity::time, 0);
  const std::vector<double> values = section.numbers("value", quantity, 0);
  section.finish();
  if (reading_->report.size() > before) return {};
  if (times.empty() || times.size() != values.size()) {
    section.fail("value", fmt::format("{} values for {} times", values.size(), times.size()),
                 "Write one value for each time.");
    return {};
  }
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (i > 0 && times[i] <= times[i - 1]) {
      section.fail("time", "times must grow from entry to entry");
      return {};
    }
    if (!check(value, name, values[i], bounds)) return {};
  }
  return interpolate_in_time(
      times, values,
      fmt::format("{{ time = {}, value = {} }}", toml_numbers(times), toml_numbers(values)));
}

std::optional<Varying> Section::varying_value(const Value& value, const std::string& name,
                                              const Quantity& quantity, const Bounds& bounds,
                                              std::string& recorded) {
  if (const auto* table = std::get_if<Table>(&value.data)) {
    auto varying = find_entry(*table, "csv")
                       ? record_of_times(*table, value, name, quantity, bounds)
                       : table_of_times(*table, value, name, quantity, bounds);
    if (varying) recorded = varying->text;
    return varying;
  }
  const auto* text = std::get_if<std::string>(&value.data);
  if (!text || reading_->units.read(*text, quantity)) {
    const auto number = si(value, name, quantity);
    if (!number || !check(value, name, *number, bounds)) return {};
    Varying constant(*number);
    constant.text = recorded = toml_number(*number);
    return constant;
  }
  std::string problem;
  try {
    const Varying varying = parse_expression(*text);
    Point3 centre{};
    if (reading_->domain) {
      for (std::size_t a = 0; a < 3; ++a)
        centre[a] = 0.5 * (reading_->domain->lower[a] + reading_->domain->upper[a]);
      if (reading_->dimension == 2) centre[1] = 0.0;
    }
    const double sample = varying(centre, 0.0);
    recorded = toml_text(*text);
    if (std::isfinite(sample)) return varying;
    problem = "not a finite number in the middle of the domain at time 0";
  } catch (const std::invalid_argument& error) {
    problem = error.what();
  }
  reading_->report.add_impossible(
      value.place, name, value.written, problem,
      fmt::format("Write {} such as {}, an expression of x, y, z, t (sin, exp, min, max, pi, "
                  "condition ? a : b), {{ time = [...], value = [...] }}, or {{ csv = "
                  "\"file.csv\", column = 2 }}.",
                  quantity.name, quantity.example));
  return {};
}

Varying Section::varying(std::string_view key, const Quantity& quantity, const Bounds& bounds,
                         std::optional<double> fallback) {
  const Value* value = find(key);
  if (!value) {
    Varying result(number(key, quantity, bounds, fallback));
    result.text = toml_number(fallback.value_or(0.0));
    return result;
  }
  std::string recorded;
  const auto result = varying_value(*value, name_of(key), quantity, bounds, recorded);
  if (!result) return Varying(0.0);
  record_->value(key, recorded, quantity.unit);
  return *result;
}

std::array<Varying, 3> Section::varying_per_axis(std::string_view key, const Quantity& quantity) {
  const Value* value = find(key);
  std::array<Varying, 3> result;
  const std::string zero(1, '0');
  for (Varying& component : result) component.text = zero;
  const auto axes = static_cast<std::size_t>(reading_->dimension);
  const auto* list = value ? std::get_if<List>(&value->data) : nullptr;
  if (value && (!list || list->size() != axes)) {
    fail(key, fmt::format("a list of {} values [{}] is expected, one per axis ({})", axes,
                          quantity.unit, axes == 2 ? "x, z" : "x, y, z"));
    return result;
  }
  std::string all;
  for (std::size_t i = 0; i < axes; ++i) {
    std::string recorded = zero;
    if (list) {
      auto entry =
          varying_value((*list)[i], fmt::format("{}[{}]", name_of(key), i), quantity, {}, recorded);
      if (entry) result[axes == 2 && i == 1 ? 2 : i] = *entry;  // x, z
    }
    all += (i > 0 ? ", " : "") + recorded;
  }
  record_->value(key, "[" + all + "]", quantity.unit);
  return result;
}

}  // namespace mudlark
