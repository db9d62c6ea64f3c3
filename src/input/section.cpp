#include "input/section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace mudlark {
namespace {

const Table no_entries;

}  // namespace

Section::Section(const Table* table, Place place, std::string path, Reading& reading,
                 Record& record)
    : table_(table ? table : &no_entries),
      place_(std::move(place)),
      path_(std::move(path)),
      reading_(&reading),
      record_(&record) {}

const Value* Section::find(std::string_view key) {
  asked_.emplace_back(key);
  const Entry* entry = find_entry(*table_, key);
  return entry ? &entry->value : nullptr;
}

const Value* Section::raw(std::string_view key) { return find(key); }

bool Section::has(std::string_view key) { return find(key) != nullptr; }

Place Section::place(std::string_view key) const {
  const Entry* entry = find_entry(*table_, key);
  return entry ? entry->place : place_;
}

std::string Section::name_of(std::string_view key) const {
  return path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key);
}

void Section::fail(std::string_view key, const std::string& reason, const std::string& cure) {
  const Entry* entry = find_entry(*table_, key);
  if (!entry) return missing(key, reason + (cure.empty() ? "" : ". " + cure));
  reading_->report.add_impossible(entry->place, name_of(key), entry->value.written, reason, cure);
}

void Section::missing(std::string_view key, const std::string& reason) {
  if (unknown_kind_) return;
  reading_->report.add(
      place_, fmt::format("{} is missing\n  ({}).", name_of(key), without_full_stop(reason)));
}

void Section::forbid(std::string_view key, const std::string& reason) {
  if (has(key)) fail(key, reason, "Leave it out.");
}

void Section::finish() {
  if (unknown_kind_) return;
  for (const Entry& entry : *table_) {
    if (std::find(asked_.begin(), asked_.end(), entry.key) != asked_.end()) continue;
    const std::string near = nearest_word(entry.key, asked_);
    std::vector<std::string> known = asked_;
    std::sort(known.begin(), known.end());
    known.erase(std::unique(known.begin(), known.end()), known.end());
    reading_->report.add(
        entry.place,
        fmt::format("unknown key {}. {}", name_of(entry.key),
                    near.empty() ? "Known here: " + fmt::format("{}", quoted_list(known)) + "."
                                 : "Did you mean " + near + "?"));
  }
}

bool Section::check(const Value& value, const std::string& name, double number,
                    const Bounds& bounds) {
  if (bounds.admits(number)) return true;
  reading_->report.add_impossible(value.place, name, value.written, bounds.reason, bounds.cure);
  return false;
}

std::optional<double> Section::si(const Value& value, const std::string& name,
                                  const Quantity& quantity) {
  const std::string wish = fmt::format("{} [{}] is expected, for example {}", quantity.name,
                                       quantity.unit, quantity.example);
  std::string problem = wish;
  if (const auto* integer = std::get_if<std::int64_t>(&value.data))
    return static_cast<double>(*integer);
  if (const auto* real = std::get_if<double>(&value.data)) {
    if (std::isfinite(*real)) return *real;
    problem = "not a finite number; " + wish;
  }
  if (const auto* text = std::get_if<std::string>(&value.data)) {
    const auto result = reading_->units.read(*text, quantity);
    if (result && result->value) return result->value;
    if (result) problem = result->problem;
  }
  reading_->report.add_impossible(value.place, name, value.written, problem);
  return {};
}

double Section::number_unrecorded(std::string_view key, const Quantity& quantity,
                                  const Bounds& bounds) {
  const Value* value = find(key);
  const auto number = value ? si(*value, name_of(key), quantity) : std::nullopt;
  if (!number || !check(*value, name_of(key), *number, bounds))
    return std::numeric_limits<double>::quiet_NaN();
  return *number;
}

std::optional<double> Section::number_if_set(std::string_view key, const Quantity& quantity,
                                             const Bounds& bounds) {
  if (!has(key)) return {};
  const double number = number_unrecorded(key, quantity, bounds);
  record_->value(key, toml_number(number), quantity.unit);
  return number;
}

double Section::number(std::string_view key, const Quantity& quantity, const Bounds& bounds,
                       std::optional<double> fallback) {
  if (const auto set = number_if_set(key, quantity, bounds)) return *set;
  if (fallback) {
    record_->value(key, toml_number(*fallback), quantity.unit);
    return *fallback;
  }
  missing(key, fmt::format("{} [{}] is needed, for example {} = {}", quantity.name, quantity.unit,
                           key, quantity.example));
  return std::numeric_limits<double>::quiet_NaN();
}

int Section::integer(std::string_view key, const Bounds& bounds, std::optional<int> fallback) {
  const Value* value = find(key);
  int result = fallback.value_or(0);
  if (!value && !fallback) {
    missing(key, "a whole number is needed");
    return result;
  }
  if (value) {
    const auto* given = std::get_if<std::int64_t>(&value->data);
    if (!given || std::abs(*given) > std::numeric_limits<int>::max()) {
      fail(key, bounds.reason.empty() ? "a whole number is expected" : bounds.reason, bounds.cure);
      return result;
    }
    if (!check(*value, name_of(key), static_cast<double>(*given), bounds)) return result;
    result = static_cast<int>(*given);
  }
  record_->value(key, fmt::format("{}", result));
  return result;
}

bool Section::flag(std::string_view key, bool fallback) {
  const Value* value = find(key);
  bool result = fallback;
  if (value) {
    if (const auto* given = std::get_if<bool>(&value->data))
      result = *given;
    else
      fail(key, "true or false is expected");
  }
  record_->value(key, result ? "true" : "false");
  return result;
}

std::string Section::text(std::string_view key, std::optional<std::string> fallback) {
  const Value* value = find(key);
  std::string result = fallback.value_or("");
  if (!value && !fallback)
    missing(key, fmt::format("a text is needed, for example {} = \"...\"", key));
  if (value) {
    if (const auto* given = std::get_if<std::string>(&value->data))
      result = *given;
    else
      fail(key, "a text between quotes is expected");
  }
  record_->value(key, toml_text(result));
  return result;
}

std::size_t Section::word(std::string_view key, const Words& names,
                          std::optional<std::size_t> preset, const Words& later) {
  const Value* value = find(key);
  const std::string available = quoted_list(names);
  std::size_t result = preset.value_or(0);
  if (!value && !preset) {
    missing(key, "available: " + available);
    return result;
  }
  if (value) {
    const auto* given = std::get_if<std::string>(&value->data);
    const auto found = given ? std::find(names.begin(), names.end(), *given) : names.end();
    if (found == names.end()) {
      const bool known = given && std::find(later.begin(), later.end(), *given) != later.end();
      const std::string near = given && !known ? nearest_word(*given, names) : "";
      fail(key, (known ? "not available yet; available: " : "available: ") + available,
           near.empty() ? "" : "Did you mean " + toml_text(near) + "?");
      unknown_kind_ = unknown_kind_ || key == "type";
      return result;
    }
    result = static_cast<std::size_t>(found - names.begin());
  }
  record_->value(key, toml_text(names[result]));
  return result;
}

Section Section::over(const Table& table, const Place& at, std::string_view key, Record& record) {
  return {&table, at, name_of(key), *reading_, record};
}

Section Section::table(std::string_view key, Record::Form form, bool required,
                       std::string_view unit) {
  const Value* value = find(key);
  const Table* table = value ? std::get_if<Table>(&value->data) : nullptr;
  if (value && !table)
    fail(key, form == Record::Form::block ? fmt::format("a table is expected: [{}]", name_of(key))
                                          : "a table is expected: { ... }");
  if (!value && required)
    reading_->report.add(
        place_, fmt::format("{} is missing\n  (a case needs it; see the "
                            "description of the case file).",
                            path_.empty() ? fmt::format("section [{}]", key) : name_of(key)));
  Record& record = record_->child(key, form, unit);
  return {table, place(key), name_of(key), *reading_, record};
}

std::vector<Section> Section::tables(std::string_view key) {
  const Value* value = find(key);
  std::vector<Section> sections;
  if (!value) return sections;
  const auto* list = std::get_if<List>(&value->data);
  if (!list) {
    fail(key, fmt::format("a list of tables is expected, each under its own [[{}]]", name_of(key)));
    return sections;
  }
  for (std::size_t i = 0; i < list->size(); ++i) {
    const Value& item = (*list)[i];
    const std::string path =
        list->size() == 1 ? name_of(key) : fmt::format("{}.{}", name_of(key), i);
    const auto* table = std::get_if<Table>(&item.data);
    if (!table) {
      reading_->report.add_impossible(item.place, path, item.written, "a table is expected");
      continue;
    }
    Record& record = record_->child(key, Record::Form::block_list_item);
    sections.emplace_back(table, item.place, path, *reading_, record);
  }
  return sections;
}

}  // namespace mudlark
