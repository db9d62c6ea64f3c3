#pragma once
/// Runs the real program on the small cases beside this file, ends it in unfriendly ways and
/// compares gauges.
#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "regression/input/program.hpp"

namespace mudlark {

/// One gauge: names of the columns and the rows.
struct Series {
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;
};

inline Series series_of(const fs::path& file) {
  std::ifstream stream(file);
  Series series;
  std::string line, word;
  std::getline(stream, line);
  for (std::istringstream words(line); std::getline(words, word, ',');)
    series.columns.push_back(word);
  while (std::getline(stream, line)) {
    std::vector<double>& row = series.rows.emplace_back();
    for (std::istringstream words(line); std::getline(words, word, ',');)
      row.push_back(std::stod(word));
  }
  return series;
}

inline std::map<std::string, fs::path> gauge_files(const fs::path& results) {
  std::map<std::string, fs::path> files;
  for (const auto& entry : fs::directory_iterator(results / "gauges"))
    files[entry.path().stem().string()] = entry.path();
  return files;
}

/// The number or word after "key": in a summary; empty when it is not there.
inline std::string entry_of(const fs::path& results, const std::string& key) {
  const std::string text = text_of(results / "summary.json"), mark = "\"" + key + "\": ";
  const std::size_t at = text.find(mark);
  if (at == std::string::npos) return "";
  const std::size_t begin = at + mark.size();
  return text.substr(begin, text.find_first_of(",\n", begin) - begin);
}
inline std::string status_of(const fs::path& results) { return entry_of(results, "status"); }

/// The process and all that it started, itself first.
inline std::vector<pid_t> family_of(pid_t parent) {
  std::vector<pid_t> family{parent};
  for (std::size_t next = 0; next < family.size(); ++next)
    for (const auto& entry : fs::directory_iterator("/proc")) {
      const std::string name = entry.path().filename().string();
      if (!std::all_of(name.begin(), name.end(), [](char c) { return c >= '0' && c <= '9'; }))
        continue;
      // pid (name) state parent ...; the name may hold blanks and brackets
      const std::string stat = text_of(entry.path() / "stat");
      const std::size_t behind = stat.rfind(") ");
      if (behind == std::string::npos) continue;
      std::istringstream rest(stat.substr(behind + 2));
      std::string state;
      pid_t of = 0;
      if (rest >> state >> of && of == family[next]) family.push_back(std::stoi(name));
    }
  return family;
}

class RunTest : public ProgramTest {
 protected:
  static fs::path case_file(const std::string& name) {
    return fs::path(MUDLARK_SOURCE_DIR) / "tests/regression/run/cases" / (name + ".toml");
  }
  fs::path results(const std::string& name) const { return folder_ / name; }

  /// The words of the command for a run of a case into a results folder on some ranks.
  std::vector<std::string> words(const std::string& name, int ranks, const std::string& into,
                                 const std::vector<std::string>& more = {}) const {
    std::vector<std::string> all{"run", case_file(name).string(), "--quiet", "-o", into};
    if (ranks > 1) all.insert(all.end(), {"-n", std::to_string(ranks)});
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  /// Runs to the end. Patient: the machine may be busy.
  Result run(const std::string& name, int ranks, const std::string& into,
             const std::vector<std::string>& more = {}) const {
    return wait_patiently(start(words(name, ranks, into, more)));
  }
  Result wait_patiently(pid_t child) const {
    constexpr std::chrono::minutes limit(4);
    const auto begin = std::chrono::steady_clock::now();
    int status = 0;
    while (waitpid(child, &status, WNOHANG) == 0) {
      if (std::chrono::steady_clock::now() - begin > limit) {
        kill_family(child);
        return {-3, text_of(log())};
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -2, text_of(log())};
  }
  /// SIGKILL to the program, its launcher and its ranks. True when it had not ended by itself.
  static bool kill_family(pid_t child) {
    for (const pid_t member : family_of(child)) kill(member, SIGKILL);
    int status = 0;
    waitpid(child, &status, 0);
    return WIFSIGNALED(status);
  }
  /// Waits until the run has saved its first state, from which on it can be resumed.
  void wait_for_state(const std::string& into) const {
    for (int i = 0; i < 60000 && !fs::exists(results(into) / "checkpoint/state-A.h5"); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }

  /// Each value of each gauge within `tolerance` of the largest of its column; 0: the same files.
  /// Returns the largest difference.
  double compare_gauges(const std::string& left, const std::string& right, double tolerance) const {
    const auto expected = gauge_files(results(left)), found = gauge_files(results(right));
    EXPECT_FALSE(expected.empty());
    EXPECT_EQ(expected.size(), found.size());
    double worst = 0.0;
    for (const auto& [name, file] : expected) {
      if (!found.contains(name)) {
        ADD_FAILURE() << "no gauge " << name << " in " << right;
        continue;
      }
      if (tolerance == 0.0)
        EXPECT_EQ(text_of(file), text_of(found.at(name))) << name;
      else
        worst = std::max(
            worst, compare_series(name, series_of(file), series_of(found.at(name)), tolerance));
    }
    return worst;
  }

 private:
  static double compare_series(const std::string& name, const Series& expected, const Series& found,
                               double tolerance) {
    EXPECT_EQ(expected.columns, found.columns) << name;
    EXPECT_GT(expected.rows.size(), 2u) << name;
    EXPECT_EQ(expected.rows.size(), found.rows.size()) << name;
    double worst = 0.0;
    for (std::size_t c = 0; c < expected.columns.size(); ++c) {
      double largest = 0.0, difference = 0.0;
      for (std::size_t r = 0; r < std::min(expected.rows.size(), found.rows.size()); ++r) {
        largest = std::max(largest, std::abs(expected.rows[r].at(c)));
        difference = std::max(difference, std::abs(expected.rows[r].at(c) - found.rows[r].at(c)));
      }
      EXPECT_GT(largest, 0.0) << name << " column " << expected.columns[c] << " is zero throughout";
      EXPECT_LE(difference, tolerance * largest) << name << " column " << expected.columns[c];
      worst = std::max(worst, difference / std::max(largest, 1e-300));
    }
    return worst;
  }
};

}  // namespace mudlark
