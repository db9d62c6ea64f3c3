/// Paths of files, and values that vary in time as a file says.
#include <fmt/format.h>

#include <cmath>

#include "base/errors.hpp"
#include "input/expression.hpp"
#include "input/section.hpp"
#include "input/time_record.hpp"

namespace mudlark {
namespace {

namespace fs = std::filesystem;

/// column = 3, or column = "acceleration".
void read_column(Section& section, RecordColumns& columns) {
  const Value* value = section.raw("column");
  if (!value) return;
  if (const auto* name = std::get_if<std::string>(&value->data)) {
    columns.name = *name;
    if (name->empty()) section.fail("column", "the name of a column is expected");
    return;
  }
  columns.value = section.integer(
      "column", {.lower = 1.0, .reason = "columns are counted from 1, or named by the header"},
      columns.value);
}

/// How many SI units a unit of the file is; the file's header may name it, and without any it is
/// SI.
double unit_factor(Section& section, std::string_view key, std::string unit,
                   const Quantity& quantity, std::string& recorded) {
  if (section.has(key)) unit = section.text(key);
  recorded = unit.empty() ? std::string(quantity.unit) : unit;
  if (unit.empty() || unit == "-" || unit == "1") return 1.0;
  const auto reading = section.reading().units.read("1 " + unit, quantity);
  if (reading && reading->value) return *reading->value;
  section.fail(
      section.has(key) ? key : "csv",
      fmt::format("its unit is \"{}\": {}", unit, reading ? reading->problem : "that is no unit"),
      fmt::format("Write {} = \"{}\", or what it is in.", key, quantity.unit));
  return std::nan("");
}

}  // namespace

fs::path Section::file(std::string_view key, std::string_view kind, std::string_view example) {
  const Value* value = raw(key);
  const auto* text = value ? std::get_if<std::string>(&value->data) : nullptr;
  if (!text || text->empty()) {
    fail(key, fmt::format("the path of {} is expected", kind),
         fmt::format("For example {}.", example));
    return {};
  }
  const fs::path beside = fs::path(place(key).origin).parent_path() / *text;
  const fs::path path =
      fs::absolute(fs::exists(beside) ? beside : fs::path(*text)).lexically_normal();
  record().value(key, toml_text(path.string()));
  if (fs::is_regular_file(path)) return path;
  fail(key, "there is no such file, neither beside the case file nor in the working directory");
  return {};
}

std::optional<Varying> Section::record_of_times(const Table& table, const Value& value,
                                                const std::string& name, const Quantity& quantity,
                                                const Bounds& bounds) {
  Record scratch;
  Section section(&table, value.place, name, *reading_, scratch);
  const std::size_t before = reading_->report.size();
  const fs::path path = section.file("csv", "a CSV file", "\"record.csv\"");
  RecordColumns columns;
  const Bounds counted{.lower = 1.0, .reason = "columns are counted from 1"};
  columns.time = section.integer("time_column", counted, columns.time);
  read_column(section, columns);
  const double factor = section.number("factor", mudlark::quantity::number, {}, 1.0);
  for (const std::string_view key : {"unit", "time_unit"}) section.has(key);
  section.finish();
  if (reading_->report.size() > before) return {};
  TimeRecord record;
  try {
    record = read_time_record(path, columns);
  } catch (const InputError& error) {
    section.fail("csv", error.what());
    return {};
  }
  std::string unit, time_unit;
  const double scale = factor * unit_factor(section, "unit", record.unit, quantity, unit);
  const double second =
      unit_factor(section, "time_unit", record.time_unit, mudlark::quantity::time, time_unit);
  if (reading_->report.size() > before) return {};
  for (std::size_t i = 0; i < record.times.size(); ++i) {
    record.times[i] *= second, record.values[i] *= scale;
    if (bounds.admits(record.values[i])) continue;
    section.fail("csv",
                 fmt::format("{}:{}: {} {} is not possible; {}", path.string(), record.lines[i],
                             record.values[i], quantity.unit, bounds.reason),
                 bounds.cure);
    return {};
  }
  return interpolate_in_time(
      std::move(record.times), std::move(record.values),
      fmt::format(
          "{{ csv = {}, column = {}, time_column = {}, unit = {}, time_unit = {}, factor = {} }}",
          toml_text(path.string()), record.column, columns.time, toml_text(unit),
          toml_text(time_unit), toml_number(factor)));
}

}  // namespace mudlark
