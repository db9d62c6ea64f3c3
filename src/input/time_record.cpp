#include "input/time_record.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/errors.hpp"
#include "input/text_columns.hpp"

namespace mudlark {
namespace {

/// Reads one file.
class Reader {
 public:
  Reader(const std::filesystem::path& file, const RecordColumns& columns)
      : lines_(file), columns_(columns) {}

  TimeRecord read() {
    std::string_view text;
    while (lines_.next(text)) take(text);
    if (record_.times.empty()) lines_.fail_in_file("it holds no line of numbers");
    return std::move(record_);
  }

 private:
  void take(std::string_view text) {
    const char separator = separator_of(text);
    const auto fields = fields_of(text, separator);
    if (!begun_) {
      begun_ = true;
      if (take_header(fields)) return;
    }
    const double time = number(fields, columns_.time), value = number(fields, record_.column);
    if (!record_.times.empty() && time <= record_.times.back())
      lines_.fail(fmt::format("the time {} does not lie after the one before, {}", time,
                              record_.times.back()));
    record_.times.push_back(time);
    record_.values.push_back(value);
    record_.lines.push_back(lines_.number());
  }

  /// The first line is a header when it is no row of numbers.
  bool take_header(const std::vector<std::string_view>& titles) {
    record_.column = columns_.value;
    if (!columns_.name.empty()) {
      record_.column = 0;
      for (std::size_t i = 0; i < titles.size(); ++i)
        if (titles[i] == columns_.name || name_in(titles[i]) == columns_.name)
          record_.column = static_cast<int>(i) + 1;
      if (record_.column == 0)
        lines_.fail(
            fmt::format("there is no column \"{}\" in this line, the header", columns_.name));
    }
    const auto title = [&](int column) {
      const auto i = static_cast<std::size_t>(column) - 1;
      return i < titles.size() ? titles[i] : std::string_view{};
    };
    if (number_of(title(columns_.time)) || title(columns_.time).empty()) return false;
    record_.time_unit = unit_in(title(columns_.time));
    record_.unit = unit_in(title(record_.column));
    return true;
  }

  double number(const std::vector<std::string_view>& fields, int column) const {
    const auto i = static_cast<std::size_t>(column) - 1;
    if (i >= fields.size())
      lines_.fail(
          fmt::format("column {} is asked for, and the line has {}", column, fields.size()));
    const auto value = number_of(fields[i]);
    if (!value) {
      const bool comma = fields[i].find(',') != std::string_view::npos;
      lines_.fail(fmt::format("\"{}\" in column {} is not a number{}",
                              fields[i].substr(0, std::min<std::size_t>(fields[i].size(), 30)),
                              column, comma ? "; write a decimal point, not a comma" : ""));
    }
    return *value;
  }

  TextLines lines_;
  const RecordColumns& columns_;
  TimeRecord record_;
  bool begun_ = false;
};

}  // namespace

TimeRecord read_time_record(const std::filesystem::path& file, const RecordColumns& columns) {
  return Reader(file, columns).read();
}

}  // namespace mudlark
