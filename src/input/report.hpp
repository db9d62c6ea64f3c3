#pragma once
/// Collects every mistake of a case file, so that the user sees all of them at once.
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "input/value.hpp"

namespace mudlark {

class Report {
 public:
  /// "PLACE: text"
  void add(const Place& place, const std::string& text);
  /// "PLACE: name = written is not possible" and, indented, "(reason). cure"
  void add_impossible(const Place& place, const std::string& name, const std::string& written,
                      const std::string& reason, const std::string& cure = {});

  bool empty() const { return mistakes_.empty(); }
  std::size_t size() const { return mistakes_.size(); }
  /// All mistakes in the order of their lines.
  std::string text() const;

 private:
  struct Mistake {
    Place place;
    std::string text;
  };
  std::vector<Mistake> mistakes_;
};

/// Without the full stop at its end: messages put reasons into brackets.
std::string_view without_full_stop(std::string_view text);

/// The known word nearest to what was written; empty when none is near (Damerau-Levenshtein
/// distance).
std::string nearest_word(std::string_view written, std::span<const std::string> known);

/// `text` between double quotes as a TOML basic string.
std::string toml_text(std::string_view text);

/// "a", "b", "c"
std::string quoted_list(std::span<const std::string> words);

}  // namespace mudlark
