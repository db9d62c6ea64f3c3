#include "input/text_columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/errors.hpp"

namespace mudlark {
namespace {

constexpr std::string_view blanks = " \t\r";

}  // namespace

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  text = text.substr(first, text.find_last_not_of(blanks) - first + 1);
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"')
    text = text.substr(1, text.size() - 2);
  return text;
}

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

std::string unit_in(std::string_view title) {
  const std::size_t open = title.find('['), close = title.rfind(']');
  if (open == std::string_view::npos || close == std::string_view::npos || close < open) return {};
  return std::string(trimmed(title.substr(open + 1, close - open - 1)));
}

std::string_view name_in(std::string_view title) {
  return trimmed(title.substr(0, title.find('[')));
}

bool TextLines::next(std::string_view& text) {
  while (std::getline(stream_, line_)) {
    ++number_;
    text = line_;
    if (number_ == 1 && text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
    text = trimmed(text);
    if (!text.empty() && text.front() != '#') return true;
  }
  if (!stream_.eof()) fail_in_file("it cannot be read to its end");
  return false;
}

void TextLines::fail_at(int line, const std::string& problem) const {
  throw InputError(fmt::format("{}:{}: {}", file_.string(), line, problem));
}

void TextLines::fail_in_file(const std::string& problem) const {
  throw InputError(fmt::format("{}: {}", file_.string(), problem));
}

double TextLines::number_in(std::string_view text) const {
  if (const auto value = number_of(text)) return *value;
  fail(fmt::format("\"{}\" is not a number",
                   text.substr(0, std::min<std::size_t>(text.size(), 30))));
}

}  // namespace mudlark
