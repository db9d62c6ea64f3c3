#include "input/document.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <optional>
#include <sstream>

#include "base/errors.hpp"

namespace mudlark {
namespace {

/// Byte position of a 1-based column, which TOML counts in characters.
std::size_t byte_of_column(std::string_view line, std::size_t column) {
  std::size_t at = 0;
  for (std::size_t seen = 0; at < line.size(); ++at) {
    if ((static_cast<unsigned char>(line[at]) & 0xC0u) != 0x80u && ++seen == column) break;
  }
  return at;
}

/// Copies toml++ nodes into values, with the text that the user wrote for each.
class Converter {
 public:
  Converter(std::string_view text, std::string origin) : origin_(std::move(origin)) {
    std::istringstream stream{std::string(text)};
    for (std::string line; std::getline(stream, line);) lines_.push_back(line);
  }

  Table table(const toml::table& from) const {
    Table out;
    for (const auto& [key, node] : from)
      out.push_back({std::string(key.str()), place(key.source()), value(node)});
    return out;
  }

  Value value(const toml::node& node) const {
    Value out{OtherValue{}, place(node.source()), written(node)};
    if (const auto* v = node.as_boolean()) out.data = v->get();
    if (const auto* v = node.as_integer()) out.data = std::int64_t{v->get()};
    if (const auto* v = node.as_floating_point()) out.data = v->get();
    if (const auto* v = node.as_string()) out.data = v->get();
    if (const auto* v = node.as_table()) out.data = table(*v);
    if (const auto* v = node.as_array()) {
      List list;
      for (const auto& item : *v) list.push_back(value(item));
      out.data = std::move(list);
    }
    return out;
  }

 private:
  Place place(const toml::source_region& region) const {
    return {origin_, lines_.empty() ? 0 : static_cast<int>(region.begin.line)};
  }

  std::string written(const toml::node& node) const {
    const auto& [begin, end, path] = node.source();
    if (begin.line == 0 || begin.line > lines_.size() || node.is_array_of_tables()) return "...";
    const std::string& line = lines_[begin.line - 1];
    const std::size_t from = byte_of_column(line, begin.column);
    const std::size_t to = begin.line == end.line ? byte_of_column(line, end.column) : line.size();
    std::string text = line.substr(from, to > from ? to - from : 0);
    while (!text.empty() && (text.back() == ' ' || text.back() == '\r')) text.pop_back();
    constexpr std::size_t longest = 70;
    if (text.size() > longest || begin.line != end.line)
      text = text.substr(0, byte_of_column(text, longest)) + " ...";
    return text;
  }

  std::string origin_;
  std::vector<std::string> lines_;
};

std::string file_text(const std::filesystem::path& file) {
  std::error_code error;
  if (std::filesystem::is_directory(file, error))
    throw InputError(fmt::format("{}: this is a folder, not a case file", file.string()));
  if (!std::filesystem::exists(file, error))
    throw InputError(fmt::format("{}: there is no such case file", file.string()));
  if (!std::filesystem::is_regular_file(file, error))
    throw InputError(fmt::format("{}: this is not a regular file", file.string()));
  constexpr std::uintmax_t largest = 64u << 20u;
  if (std::filesystem::file_size(file, error) > largest)
    throw InputError(fmt::format("{}: larger than 64 MiB, not a case file", file.string()));
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  if (!stream)
    throw InputError(
        fmt::format("{}: the file cannot be read; check its permissions", file.string()));
  if (text.str().find_first_not_of(" \t\r\n") == std::string::npos)
    throw InputError(fmt::format(
        "{}:1: the case file is empty\n  (\"mudlark cases\" lists cases to start from).",
        file.string()));
  return text.str();
}

Table parse_file(const std::filesystem::path& file) {
  const std::string text = file_text(file);
  try {
    const toml::table parsed = toml::parse(text, file.string());
    return Converter(text, file.string()).table(parsed);
  } catch (const toml::parse_error& error) {
    const auto& at = error.source().begin;
    throw InputError(fmt::format("{}:{}:{}: this is not valid TOML\n  ({}).", file.string(),
                                 at.line, at.column, error.description()));
  }
}

/// The right side of an override: TOML where it is TOML, else text ("time.end=2 h").
Value parse_override(const std::string& text, const std::string& origin) {
  const Place place{origin, 0};
  try {
    const toml::table parsed = toml::parse("v = " + text);
    if (parsed.size() == 1 && !text.empty()) {
      Value value = Converter("", origin).value(parsed.begin()->second);
      value.written = text;
      return value;
    }
  } catch (const toml::parse_error&) {
    // Not TOML: a bare text.
  }
  return {text, place, toml_text(text)};
}

std::optional<std::size_t> list_index(const std::string& text) {
  std::size_t index = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, index);
  if (error != std::errc{} || stop != end) return {};
  return index;
}

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, at);) parts.push_back(part);
  return parts;
}

/// One element of a list by its index; a list of one table needs none ("soil.porosity").
/// `used` tells whether `part` was the index. Null when there is none.
Value* element(List& list, const std::string& part, bool& used) {
  const auto index = list_index(part);
  used = index.has_value();
  if (!index) return list.size() == 1 ? &list.front() : nullptr;
  return *index < list.size() ? &list[*index] : nullptr;
}

/// Walks down to the place that an override names and puts the value there.
void apply(Table& root, const std::string& text, Report& report) {
  const std::string origin = "--set " + text;
  const Place place{origin, 0};
  const std::size_t equals = text.find('=');
  const std::vector<std::string> parts = split(text.substr(0, equals), '.');
  const bool named = !parts.empty() && std::none_of(parts.begin(), parts.end(),
                                                    [](const auto& part) { return part.empty(); });
  if (equals == std::string::npos || !named)
    return report.add(place, "not of the form key=value, for example --set time.end=\"2 h\"");
  Value value = parse_override(text.substr(equals + 1), origin);
  Value top{std::move(root), place, ""};
  Value* at = &top;
  for (std::size_t i = 0; at && i < parts.size();) {
    if (auto* list = std::get_if<List>(&at->data)) {
      bool used = false;
      const std::size_t count = list->size();
      at = element(*list, parts[i], used);
      if (!at)
        report.add(place,
                   fmt::format("there is no {} here; the list has {} entries, counted from 0",
                               parts[i], count));
      if (used) ++i;
      continue;
    }
    auto* table = std::get_if<Table>(&at->data);
    if (!table) {
      at = nullptr;
      report.add(place, fmt::format("{} lies inside a value that is not a table", parts[i]));
      continue;
    }
    Entry* entry = find_entry(*table, parts[i]);
    if (!entry) {
      table->push_back({parts[i], place, Value{Table{}, place, text}});
      entry = &table->back();
    }
    at = &entry->value;
    ++i;
  }
  if (at) *at = std::move(value);
  root = std::move(std::get<Table>(top.data));
}

}  // namespace

Table read_document(const std::filesystem::path& file, std::span<const std::string> overrides,
                    Report& report) {
  Table root = parse_file(file);
  for (const std::string& text : overrides) apply(root, text, report);
  return root;
}

}  // namespace mudlark
