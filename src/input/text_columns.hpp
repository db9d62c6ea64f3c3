#pragma once
/// Columns of numbers in text files.
#include <filesystem>
#include <fstream>
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

/// Reads a file line by line and says where something is wrong. All failures throw InputError.
class TextLines {
 public:
  explicit TextLines(const std::filesystem::path& file) : file_(file), stream_(file) {}

  /// The next line that holds something; lines that begin with # do not. False at the end.
  bool next(std::string_view& text);
  int number() const { return number_; }  ///< of the last line, from 1
  [[noreturn]] void fail(const std::string& problem) const { fail_at(number_, problem); }
  [[noreturn]] void fail_at(int line, const std::string& problem) const;
  [[noreturn]] void fail_in_file(const std::string& problem) const;
  double number_in(std::string_view text) const;

 private:
  std::filesystem::path file_;
  std::ifstream stream_;
  std::string line_;
  int number_ = 0;
};

}  // namespace mudlark
