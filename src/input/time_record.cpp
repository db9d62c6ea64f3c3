#include "input/time_record.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>
#include <string_view>

#include "base/errors.hpp"

namespace mudlark {
namespace {

constexpr std::string_view blanks = " \t\r";

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  text = text.substr(first, text.find_last_not_of(blanks) - first + 1);
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"')
    text = text.substr(1, text.size() - 2);
  return text;
}

/// What separates the columns of a line.
char separator_of(std::string_view line) {
  for (const char c : {';', ',', '\t'})
    if (line.find(c) != std::string_view::npos) return c;
  return ' ';
}

std::vector<std::string_view> fields_of(std::string_view line, char separator) {
  std::vector<std::string_view> fields;
  if (separator == ' ') {
    for (std::size_t at = line.find_first_not_of(blanks); at != std::string_view::npos;) {
      const std::size_t end = std::min(line.find_first_of(blanks, at), line.size());
      fields.push_back(line.substr(at, end - at));
      at = line.find_first_not_of(blanks, end);
    }
    return fields;
  }
  for (std::size_t at = 0;;) {
    const std::size_t end = line.find(separator, at);
    fields.push_back(trimmed(line.substr(at, end - at)));
    if (end == std::string_view::npos) return fields;
    at = end + 1;
  }
}

std::optional<double> number_of(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double number = 0.0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || stop != text.data() + text.size() || !std::isfinite(number))
    return {};
  return number;
}

/// "time [s]": the part between the brackets.
std::string unit_in(std::string_view title) {
  const std::size_t open = title.find('['), close = title.rfind(']');
  if (open == std::string_view::npos || close == std::string_view::npos || close < open) return {};
  return std::string(trimmed(title.substr(open + 1, close - open - 1)));
}

std::string_view name_in(std::string_view title) {
  return trimmed(title.substr(0, title.find('[')));
}

/// Reads one file line by line.
class Reader {
 public:
  Reader(const std::filesystem::path& file, const RecordColumns& columns)
      : file_(file), columns_(columns) {}

  TimeRecord read() {
    std::ifstream stream(file_);
    std::string line;
    while (std::getline(stream, line)) {
      ++line_;
      std::string_view text = line;
      if (line_ == 1 && text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
      text = trimmed(text);
      if (!text.empty() && text.front() != '#') take(text);
    }
    if (!stream.eof()) fail_in_file("it cannot be read to its end");
    if (record_.times.empty()) fail_in_file("it holds no line of numbers");
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
      fail(fmt::format("the time {} does not lie after the one before, {}", time,
                       record_.times.back()));
    record_.times.push_back(time);
    record_.values.push_back(value);
    record_.lines.push_back(line_);
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
        fail(fmt::format("there is no column \"{}\" in this line, the header", columns_.name));
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
      fail(fmt::format("column {} is asked for, and the line has {}", column, fields.size()));
    const auto value = number_of(fields[i]);
    if (!value) {
      const bool comma = fields[i].find(',') != std::string_view::npos;
      fail(fmt::format("\"{}\" in column {} is not a number{}",
                       fields[i].substr(0, std::min<std::size_t>(fields[i].size(), 30)), column,
                       comma ? "; write a decimal point, not a comma" : ""));
    }
    return *value;
  }

  [[noreturn]] void fail(const std::string& problem) const {
    throw InputError(fmt::format("{}:{}: {}", file_.string(), line_, problem));
  }
  [[noreturn]] void fail_in_file(const std::string& problem) const {
    throw InputError(fmt::format("{}: {}", file_.string(), problem));
  }

  const std::filesystem::path& file_;
  const RecordColumns& columns_;
  TimeRecord record_;
  int line_ = 0;
  bool begun_ = false;
};

}  // namespace

TimeRecord read_time_record(const std::filesystem::path& file, const RecordColumns& columns) {
  return Reader(file, columns).read();
}

}  // namespace mudlark
