#include "input/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace mudlark {
namespace {

/// Number of letters to insert, drop, exchange or swap with their neighbour to turn one word into
/// the other (optimal string alignment, Damerau 1964).
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before, last(b.size() + 1), now(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    now[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t exchange = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      now[j] = std::min({last[j] + 1, now[j - 1] + 1, exchange});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        now[j] = std::min(now[j], before[j - 2] + 1);
    }
    before = last;
    last.swap(now);
  }
  return last[b.size()];
}

}  // namespace

void Report::add(const Place& place, const std::string& text) {
  mistakes_.push_back({place, text});
}

void Report::add_impossible(const Place& place, const std::string& name, const std::string& written,
                            const std::string& reason, const std::string& cure) {
  add(place, fmt::format("{} = {} is not possible\n  ({}).{}{}", name, written,
                         without_full_stop(reason), cure.empty() ? "" : " ", cure));
}

std::string Report::text() const {
  std::vector<Mistake> sorted = mistakes_;
  std::stable_sort(sorted.begin(), sorted.end(), [](const Mistake& a, const Mistake& b) {
    const bool file_a = a.place.line > 0, file_b = b.place.line > 0;
    return file_a != file_b ? file_a : a.place.line < b.place.line;
  });
  std::string all;
  for (const Mistake& mistake : sorted) {
    if (!all.empty()) all += '\n';
    all += fmt::format("{}: {}", mistake.place.text(), mistake.text);
  }
  return all;
}

std::string_view without_full_stop(std::string_view text) {
  if (text.ends_with('.') && !text.ends_with("..")) text.remove_suffix(1);
  return text;
}

std::string nearest_word(std::string_view written, std::span<const std::string> known) {
  std::string nearest;
  std::size_t smallest = std::max<std::size_t>(2, written.size() / 3) + 1;
  for (const std::string& word : known) {
    // A word that begins with the other is near too, "cohesion" and "cohesion_strength", but not
    // as near as one with a letter wrong.
    const bool begins = written.size() >= 4 && word.size() >= 4 &&
                        (word.starts_with(written) || written.starts_with(word));
    std::size_t distance = edit_distance(written, word);
    if (begins) distance = std::min<std::size_t>(distance, 2);
    if (distance < smallest && distance < word.size()) smallest = distance, nearest = word;
  }
  return nearest;
}

std::string toml_text(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      out += '\\', out += c;
    else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      out += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    else
      out += c;
  }
  return out + '"';
}

std::string quoted_list(std::span<const std::string> words) {
  std::string out;
  for (const std::string& word : words) out += (out.empty() ? "" : ", ") + toml_text(word);
  return out;
}

}  // namespace mudlark
