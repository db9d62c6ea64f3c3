#pragma once
/// Columns of numbers in text files.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mudlark {

/// Without blanks around it, and without quotes.
std::string_view trimmed(std::string_view text);
/// What separates the columns of a line: semicolon, comma, tab, or blanks.
char separator_of(std::string_view line);
std::vector<std::string_view> fields_of(std::string_view line, char separator);
/// Nothing when it is not one finite number.
std::optional<double> number_of(std::string_view text);
/// "time [s]": the part between the brackets, and the name before them.
std::string unit_in(std::string_view title);
std::string_view name_in(std::string_view title);

}  // namespace mudlark
