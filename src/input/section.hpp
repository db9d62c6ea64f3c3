#pragma once
/// Strict reader of one table of a case file: it reports what is wrong with a key and goes on with
/// the rest, remembers which keys it was asked for, and records every value that holds.
#include <array>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/varying.hpp"
#include "grid/shape.hpp"
#include "input/quantity.hpp"
#include "input/record.hpp"
#include "input/report.hpp"
#include "input/value.hpp"

namespace mudlark {

/// The values that a number may take, and what to tell a user who wrote another.
struct Bounds {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  bool lower_included = true, upper_included = true;
  std::string reason = {}, cure = {};

  bool admits(double value) const {
    return (lower_included ? value >= lower : value > lower) &&
           (upper_included ? value <= upper : value < upper);
  }
};
inline Bounds positive(std::string reason, std::string cure = {}) {
  return {
      .lower = 0.0, .lower_included = false, .reason = std::move(reason), .cure = std::move(cure)};
}
inline Bounds not_negative(std::string reason, std::string cure = {}) {
  return {.lower = 0.0, .reason = std::move(reason), .cure = std::move(cure)};
}

/// One of the words that a key may hold.
template <class T>
struct Choice {
  std::string name;
  T value;
};

/// What all sections of one case file share.
struct Reading {
  Report report;
  Units units;
  int dimension = 2;
  std::optional<BoxShape> domain;   ///< [m], once it is known
  std::array<double, 3> spacing{};  ///< [m] of the cells along x, y, z
  double end = 0.0;                 ///< [s] of simulated time
};

class Section {
 public:
  using Words = std::vector<std::string>;

  /// `table` may be null: a section that is missing and has only defaults.
  Section(const Table* table, Place place, std::string path, Reading& reading, Record& record);

  bool has(std::string_view key);
  Place place(std::string_view key) const;
  const std::string& path() const { return path_; }
  Reading& reading() { return *reading_; }
  Record& record() { return *record_; }
  std::string name_of(std::string_view key) const;

  /// Without `fallback` the key must be there. After a mistake the result is the fallback or NaN.
  double number(std::string_view key, const Quantity& quantity, const Bounds& bounds,
                std::optional<double> fallback = {});
  std::optional<double> number_if_set(std::string_view key, const Quantity& quantity,
                                      const Bounds& bounds);
  /// The same for a key that the caller resolves into another one; NaN after a mistake.
  double number_unrecorded(std::string_view key, const Quantity& quantity, const Bounds& bounds);
  int integer(std::string_view key, const Bounds& bounds, std::optional<int> fallback = {});
  bool flag(std::string_view key, bool fallback);
  std::string text(std::string_view key, std::optional<std::string> fallback = {});
  /// `count` 0: any number of entries. Empty after a mistake.
  std::vector<double> numbers(std::string_view key, const Quantity& quantity, std::size_t count,
                              const std::optional<std::vector<double>>& fallback = {});
  std::vector<std::array<double, 2>> pairs(std::string_view key, const Quantity& quantity);
  Varying varying(std::string_view key, const Quantity& quantity, const Bounds& bounds,
                  std::optional<double> fallback = {});
  /// As components x, y, z, whatever the number of axes.
  std::array<Varying, 3> varying_per_axis(std::string_view key, const Quantity& quantity);
  /// The path of a file that exists. A relative one belongs to the folder of the case file, or else
  /// to the working directory; what is recorded holds from everywhere. Empty after a mistake.
  std::filesystem::path file(std::string_view key, std::string_view kind, std::string_view example);

  /// `later`: words that a later version will know.
  template <class T>
  T choice(std::string_view key, const std::vector<Choice<T>>& choices,
           std::optional<T> fallback = {}, const Words& later = {}) {
    Words names;
    std::optional<std::size_t> preset;
    for (const auto& choice : choices) {
      if (fallback && choice.value == *fallback) preset = names.size();
      names.push_back(choice.name);
    }
    return choices[word(key, names, preset, later)].value;
  }

  /// The table below `key`; a table without entries when it is missing and `required` is false.
  Section table(std::string_view key, Record::Form form, bool required = false,
                std::string_view unit = {});
  /// All tables of [[key]].
  std::vector<Section> tables(std::string_view key);
  /// The value itself, for what has more than one form; the caller records it.
  const Value* raw(std::string_view key);
  /// A section over a table that raw() gave.
  Section over(const Table& table, const Place& at, std::string_view key, Record& record);

  void fail(std::string_view key, const std::string& reason, const std::string& cure = {});
  void missing(std::string_view key, const std::string& reason);
  /// Refuses a key that makes no sense beside the others.
  void forbid(std::string_view key, const std::string& reason);
  /// Reports every key that nobody asked for.
  void finish();

  /// One number, text with unit or, reported under `name`, a mistake.
  std::optional<double> si(const Value& value, const std::string& name, const Quantity& quantity);

 private:
  const Value* find(std::string_view key);
  std::size_t word(std::string_view key, const Words& names, std::optional<std::size_t> preset,
                   const Words& later);
  std::optional<Varying> varying_value(const Value& value, const std::string& name,
                                       const Quantity& quantity, const Bounds& bounds,
                                       std::string& recorded);
  std::optional<Varying> table_of_times(const Table& table, const Value& value,
                                        const std::string& name, const Quantity& quantity,
                                        const Bounds& bounds);
  std::optional<Varying> record_of_times(const Table& table, const Value& value,
                                         const std::string& name, const Quantity& quantity,
                                         const Bounds& bounds);
  bool check(const Value& value, const std::string& name, double number, const Bounds& bounds);

  const Table* table_;
  Place place_;
  std::string path_;
  Reading* reading_;
  Record* record_;
  std::vector<std::string> asked_;
  bool unknown_kind_ = false;  ///< `type` is none that exists: which keys it needs nobody knows
};

}  // namespace mudlark
