/// Did a result change? Gauges of a coupled run against the stored numbers of norms.json.
///
/// Renew them, when a change of results is meant, with
///   MUDLARK_RENEW_NORMS=1 build/release/bin/regression_run_norms
/// (or wherever the program lies) and give the reason in the commit.
#include <fmt/format.h>

#include <cstdlib>

#include "regression/run/runs.hpp"

namespace mudlark {
namespace {

class Norms : public RunTest {
 protected:
  static fs::path file() {
    return fs::path(MUDLARK_SOURCE_DIR) / "tests/regression/run/norms.json";
  }

  /// Last value, largest size and root mean square of every column.
  std::map<std::string, double> norms_of(const std::string& into) const {
    std::map<std::string, double> norms;
    for (const auto& [name, path] : gauge_files(results(into))) {
      const Series series = series_of(path);
      for (std::size_t c = 1; c < series.columns.size(); ++c) {
        double largest = 0.0, squares = 0.0;
        for (const auto& row : series.rows) {
          largest = std::max(largest, std::abs(row[c]));
          squares += row[c] * row[c];
        }
        const std::string key = name + ": " + series.columns[c];
        norms[key + ", last"] = series.rows.back()[c];
        norms[key + ", largest"] = largest;
        norms[key + ", rms"] = std::sqrt(squares / static_cast<double>(series.rows.size()));
      }
    }
    return norms;
  }
  static void store(const std::map<std::string, double>& norms) {
    std::ofstream stream(file());
    stream << "{\n  \"case\": \"dam_on_bed_2d\",\n  \"tolerance\": 1e-9,\n"
           << "  \"renew\": \"MUDLARK_RENEW_NORMS=1 build/release/bin/regression_run_norms\"";
    for (const auto& [key, value] : norms)
      stream << fmt::format(",\n  \"{}\": {:.17g}", key, value);
    stream << "\n}\n";
  }
  static double stored(const std::string& text, const std::string& key) {
    const std::string mark = "\"" + key + "\": ";
    const std::size_t at = text.find(mark);
    return at == std::string::npos ? std::nan("") : std::stod(text.substr(at + mark.size()));
  }
};

TEST_F(Norms, OfADamBreakOverAMoundOfSoilAreThoseStored) {
  const Result result = run("dam_on_bed_2d", 1, "out");
  ASSERT_EQ(result.code, 0) << result.output;
  const auto norms = norms_of("out");
  ASSERT_GT(norms.size(), 30u);
  if (std::getenv("MUDLARK_RENEW_NORMS")) store(norms);
  const std::string text = text_of(file());
  const double tolerance = stored(text, "tolerance");
  ASSERT_EQ(tolerance, 1e-9);
  for (const auto& [key, value] : norms) {
    // The last value is judged by the largest of its column: it may be near zero.
    const double scale = norms.at(key.substr(0, key.rfind(',')) + ", largest");
    EXPECT_NEAR(value, stored(text, key), tolerance * scale) << key;
  }
}

}  // namespace
}  // namespace mudlark
