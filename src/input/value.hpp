#pragma once
/// A case file as plain nested values, each of which knows where it was written.
#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace mudlark {

/// File and line, or the command-line option, that something was written in.
struct Place {
  std::string origin;
  int line = 0;  ///< 0: no line (command line)

  std::string text() const { return line > 0 ? origin + ":" + std::to_string(line) : origin; }
};

struct Value;
struct Entry;
using List = std::vector<Value>;
using Table = std::vector<Entry>;
/// A kind of TOML value that no key takes (dates, times).
struct OtherValue {};

struct Value {
  std::variant<OtherValue, bool, std::int64_t, double, std::string, List, Table> data;
  Place place;
  std::string written;  ///< as the user wrote it, for messages
};

struct Entry {
  std::string key;
  Place place;
  Value value;
};

inline Entry* find_entry(Table& table, std::string_view key) {
  for (Entry& entry : table)
    if (entry.key == key) return &entry;
  return nullptr;
}
inline const Entry* find_entry(const Table& table, std::string_view key) {
  for (const Entry& entry : table)
    if (entry.key == key) return &entry;
  return nullptr;
}

}  // namespace mudlark
